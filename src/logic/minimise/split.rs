//! ON cubes as their minterms.
//!
//! A cube that lies in no prime, or only in costly ones, may be covered by several together. Where there are few minterms
//! in all, they take the places of the cubes; where there are many, each ON cube is covered by one prime.

use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::packed::Packed;
use std::collections::BTreeSet;

/// The most minterms that take the place of cubes.
const MINTERMS: usize = 2_048;

/// The same problem with minterms for ON rows; `None` where they are minterms already, or too many.
pub(super) fn split(columns: &Columns, on: &Bits, off: &Bits) -> Option<(Columns, Bits, Bits)> {
    let atoms = columns.atoms();
    let cube = |row| {
        let mut cube = Packed::universe(atoms);
        for literal in columns.literals_of(row) {
            cube.set(literal.atom, Some(literal.positive));
        }
        cube
    };
    let ons: Vec<Packed> = on.iter().map(cube).collect();
    let mut all: usize = 0;
    for cube in &ons {
        let free = u32::try_from(atoms - cube.literals()).ok()?;
        all = all.checked_add(1_usize.checked_shl(free)?)?;
        if all > MINTERMS {
            return None;
        }
    }
    if all == ons.len() {
        return None;
    }
    let mut minterms: BTreeSet<Packed> = BTreeSet::new();
    for cube in ons {
        minterms.extend((0..atoms).fold(vec![cube], |parts, atom| {
            parts
                .into_iter()
                .flat_map(|part| halves(part, atom))
                .collect()
        }));
    }
    let ones = minterms.len();
    let rows: Vec<Packed> = minterms.into_iter().chain(off.iter().map(cube)).collect();
    let set = |range| Bits::collect(rows.len(), range);
    Some((
        Columns::of(atoms, &rows),
        set(0..ones),
        set(ones..rows.len()),
    ))
}

/// The cube where the atom is 0, and where it is 1.
fn halves(cube: Packed, atom: usize) -> Vec<Packed> {
    match cube.get(atom) {
        Some(_) => vec![cube],
        None => [false, true]
            .map(|value| {
                let mut half = cube.clone();
                half.set(atom, Some(value));
                half
            })
            .into(),
    }
}
