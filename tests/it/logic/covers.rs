//! Minimisation: right, prime, irredundant, and minimal where brute force can tell.

use crate::laws::random::Random;
use btc::logic::{Bits, Columns, Cover, Cube, Literal, minimise};
use std::collections::BTreeMap;

/// A table of `rows` different random rows with an ON and an OFF set; the other rows are free.
fn table(random: &mut Random, atoms: usize, rows: usize) -> (Columns, Bits, Bits) {
    let mut words: Vec<u64> = (0..rows)
        .map(|_| random.next() & ((1 << atoms) - 1))
        .collect();
    words.sort_unstable();
    words.dedup();
    let columns = Columns::new(atoms, words.iter().map(std::slice::from_ref));
    let (mut on, mut off) = (Bits::empty(words.len()), Bits::empty(words.len()));
    for row in 0..words.len() {
        match random.below(5) {
            0..2 => on.insert(row),
            2..4 => off.insert(row),
            _ => {}
        }
    }
    (columns, on, off)
}

fn check(columns: &Columns, on: &Bits, off: &Bits, cover: &Cover) {
    let rows = columns.cover_rows(cover, &on.or(off));
    assert_eq!(rows, *on, "every ON row, no OFF row");
    for (i, cube) in cover.cubes().iter().enumerate() {
        for literal in cube.literals() {
            let larger = columns.cube_rows(&cube.without(*literal), off);
            assert!(!larger.is_empty(), "prime");
        }
        let others = cover.cubes().iter().enumerate().filter(|(j, _)| *j != i);
        let others = Cover::new(others.map(|(_, cube)| cube.clone()));
        assert_ne!(columns.cover_rows(&others, on), *on, "irredundant");
    }
}

#[test]
fn covers_are_right_prime_and_irredundant() {
    for seed in 1..=300 {
        let random = &mut Random::new(seed);
        let atoms = 1 + random.below(16);
        let rows = 1 + random.below(120);
        let (columns, on, off) = table(random, atoms, rows);
        check(&columns, &on, &off, &minimise(&columns, &on, &off));
    }
}

#[test]
fn covers_of_four_atoms_are_minimal() {
    for seed in 1..=500 {
        let random = &mut Random::new(seed);
        let atoms = 1 + random.below(4);
        let (columns, on, off) = table(random, atoms, 16);
        let cover = minimise(&columns, &on, &off);
        let cost = (cover.cubes().len(), cover.literals());
        assert_eq!(
            cost,
            brute_force(&columns, &on, &off),
            "seed {seed}: {cover:?}"
        );
    }
}

/// Fewest cubes, then fewest literals, over all sets of cubes.
fn brute_force(columns: &Columns, on: &Bits, off: &Bits) -> (usize, usize) {
    let mut cubes = vec![Cube::default()];
    for atom in 0..columns.atoms() {
        let shorter = cubes.clone();
        for positive in [true, false] {
            let literal = Literal { atom, positive };
            let longer = |cube: &Cube| Cube::new(cube.literals().iter().copied().chain([literal]));
            cubes.extend(shorter.iter().map(longer));
        }
    }
    let useful: Vec<(Bits, usize)> = cubes
        .iter()
        .filter(|cube| columns.cube_rows(cube, off).is_empty())
        .map(|cube| (columns.cube_rows(cube, on), cube.literals().len()))
        .collect();
    let mut reached = BTreeMap::from([(Bits::empty(on.bound()), 0)]);
    for count in 0.. {
        if let Some(literals) = reached.get(on) {
            return (count, *literals);
        }
        let mut next: BTreeMap<Bits, usize> = BTreeMap::new();
        for (covered, literals) in &reached {
            for (covers, more) in &useful {
                let best = next.entry(covered.or(covers)).or_insert(usize::MAX);
                *best = (*best).min(literals + more);
            }
        }
        reached = next;
    }
    unreachable!()
}

#[test]
fn a_planted_rule_is_found_among_2000_rows_of_24_atoms() {
    for seed in 1..=5 {
        let random = &mut Random::new(seed);
        let rule: Vec<Cube> = (0..3)
            .map(|_| {
                let literals = (0..2 + random.below(3)).map(|_| Literal {
                    atom: random.below(24),
                    positive: random.chance(50),
                });
                let by_atom: BTreeMap<usize, Literal> = literals.map(|l| (l.atom, l)).collect();
                Cube::new(by_atom.into_values())
            })
            .collect();
        let rule = Cover::new(rule);
        let words: Vec<u64> = (0..2000).map(|_| random.next() & 0xff_ffff).collect();
        let columns = Columns::new(24, words.iter().map(std::slice::from_ref));
        let holds = |row: &usize| rule.holds(|atom| words[*row] >> atom & 1 == 1);
        let on = Bits::collect(2000, (0..2000).filter(holds));
        let off = Bits::full(2000).minus(&on);
        let cover = minimise(&columns, &on, &off);
        check(&columns, &on, &off, &cover);
        assert!(
            cover.literals() <= rule.literals(),
            "seed {seed}: {cover:?} for {rule:?}"
        );
    }
}

#[test]
fn more_atoms_than_a_word_has_bits() {
    let random = &mut Random::new(1);
    let rows: Vec<Vec<u64>> = (0..200)
        .map(|_| (0..5).map(|_| random.next()).collect())
        .collect();
    let columns = Columns::new(300, rows.iter().map(Vec::as_slice));
    let on = Bits::collect(200, (0..200).filter(|r| rows[*r][4] >> 40 & 1 == 1));
    let off = Bits::full(200).minus(&on);
    let cover = minimise(&columns, &on, &off);
    check(&columns, &on, &off, &cover);
    assert_eq!(
        cover.cubes()[0].literals()[0],
        Literal {
            atom: 296,
            positive: true
        }
    );
}
