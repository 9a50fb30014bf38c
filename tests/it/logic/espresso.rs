//! Functions that Espresso has minimised: covers are right, and no larger than its by much.
//!
//! `tests/cases/minimise/espresso.csv` has what Espresso 2.3 (the C source in pyeda 0.29.0, `-Dso`) made of functions that
//! are drawn again here, by the hash of their PLAs; seconds are of processor time.

use crate::functions::{Kind, pla};
use btc::logic::packed::Packed;
use btc::logic::pla::read;
use btc::logic::{Columns, Cover, Cube, Effort, minimise_with};
use sha2::{Digest, Sha256};

const RECORDED: &str = include_str!("../../cases/minimise/espresso.csv");

/// The most rows of a function that is minimised in a test.
const ROWS: usize = 300;

/// Whether the cubes of a cover cover a row together.
fn is_covered(columns: &Columns, row: usize, cover: &Cover) -> bool {
    let packed = |cube: &Cube| {
        let mut packed = Packed::universe(columns.atoms());
        for literal in cube.literals() {
            packed.set(literal.atom, Some(literal.positive));
        }
        packed
    };
    let mut left = vec![packed(&Cube::new(columns.literals_of(row)))];
    for cube in cover.cubes() {
        let cube = packed(cube);
        let parts = left.into_iter().flat_map(|part| match part.meets(&cube) {
            true => part.minus(&cube),
            false => vec![part],
        });
        left = parts.collect();
    }
    left.is_empty()
}

#[test]
fn covers_are_smaller_than_those_of_espresso() {
    let (mut ours, mut theirs, mut functions) = (0, 0, 0);
    for line in RECORDED.lines().skip(1) {
        let fields: Vec<&str> = line.split(',').collect();
        let [kind, atoms, rows, seed, hash, _, literals, _] = fields[..] else {
            panic!("{line}");
        };
        let kind = Kind::ALL.into_iter().find(|k| k.name() == kind).unwrap();
        let rows: usize = rows.parse().unwrap();
        if rows > ROWS {
            continue;
        }
        let text = pla(kind, atoms.parse().unwrap(), rows, seed.parse().unwrap());
        let digest = Sha256::digest(text.as_bytes());
        let digest: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(digest, hash, "{line}");

        let pla = read(&text).unwrap();
        let columns = pla.columns();
        let function = pla.function(&columns, 0, 0).unwrap();
        let (on, off) = (&function.on, &function.off);
        let cover = minimise_with(&columns, on, off, &Effort::default()).cover;
        for row in on.minus(&columns.cover_rows(&cover, on)).iter() {
            assert!(is_covered(&columns, row, &cover), "{line}: row {row}");
        }
        assert!(columns.cover_meets(&cover, off).is_empty(), "{line}");

        let literals: usize = literals.parse().unwrap();
        assert!(
            100 * cover.literals() <= 102 * literals,
            "{line}: {}",
            cover.literals()
        );
        ours += cover.literals();
        theirs += literals;
        functions += 1;
    }
    assert!(functions > 50);
    assert!(ours < theirs, "{ours} literals, Espresso {theirs}");
}
