//! Random functions of few atoms, against all covers and all minterms.

use crate::planted::{below, cube};
use btc::logic::complement::complement;
use btc::logic::packed::Packed;
use btc::logic::{Bits, Columns, Cover, Cube, Effort, Literal, minimise_with};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

fn random(seed: u64) -> Xoshiro256PlusPlus {
    Xoshiro256PlusPlus::seed_from_u64(seed)
}

/// All cubes over three atoms.
fn cubes() -> Vec<Cube> {
    let cube = |number: usize| {
        let literal = |atom: usize| match number / 3_usize.pow(atom as u32) % 3 {
            0 => None,
            value => Some(Literal {
                atom,
                positive: value == 1,
            }),
        };
        Cube::new((0..3).filter_map(literal))
    };
    (0..27).map(cube).collect()
}

/// Every function of three atoms, with don't-cares: what is said to be smallest is.
#[test]
fn what_is_proved_is_smallest() {
    let cubes = cubes();
    let rows: Vec<[u64; 1]> = (0..8).map(|row| [row]).collect();
    let columns = Columns::new(3, rows.iter().map(|row| &row[..]));
    let all = Bits::full(8);
    let held: Vec<Bits> = cubes
        .iter()
        .map(|cube| columns.cube_rows(cube, &all))
        .collect();
    for number in 0..3_usize.pow(8) {
        let label = |row: usize| number / 3_usize.pow(row as u32) % 3;
        let on = Bits::collect(8, (0..8).filter(|row| label(*row) == 1));
        let off = Bits::collect(8, (0..8).filter(|row| label(*row) == 2));
        let solution = minimise_with(&columns, &on, &off, &Effort::default());
        assert!(solution.proved, "{on:?} {off:?}");
        assert_eq!(columns.cover_rows(&solution.cover, &on), on);
        assert!(columns.cover_meets(&solution.cover, &off).is_empty());
        let cost = (solution.cover.cubes().len(), solution.cover.literals());
        let usable: Vec<usize> = (0..27).filter(|i| held[*i].is_disjoint(&off)).collect();
        // Four cubes cover any function of three atoms; two are enough to compare with.
        let best = |covers: Bits, size: (usize, usize)| {
            assert!(
                !on.is_subset(&covers) || cost <= size,
                "{on:?} {off:?}: {cost:?}"
            );
        };
        best(Bits::empty(8), (0, 0));
        for (n, i) in usable.iter().enumerate() {
            let literals = cubes[*i].literals().len();
            best(held[*i].clone(), (1, literals));
            for j in &usable[..n] {
                best(
                    held[*i].or(&held[*j]),
                    (2, literals + cubes[*j].literals().len()),
                );
            }
        }
    }
}

/// Rows that are cubes: every minterm of an ON row is covered, none of an OFF row is met.
#[test]
fn cubes_are_covered_and_avoided() {
    for seed in 0..200 {
        let mut random = random(seed);
        let mut rows: Vec<(Packed, bool)> = Vec::new();
        for _ in 0..30 {
            let literals = 2 + below(&mut random, 5);
            let row = packed(&cube(&mut random, 8, literals));
            let label = random.next_u64() & 1 == 1;
            if rows
                .iter()
                .all(|(other, l)| *l == label || !other.meets(&row))
            {
                rows.push((row, label));
            }
        }
        let cubes: Vec<Packed> = rows.iter().map(|(row, _)| row.clone()).collect();
        let columns = Columns::of(8, &cubes);
        let set =
            |label| Bits::collect(rows.len(), (0..rows.len()).filter(|r| rows[*r].1 == label));
        let cover = minimise_with(&columns, &set(true), &set(false), &Effort::default()).cover;
        for minterm in 0..256_u64 {
            let point = Packed::new(8, &[minterm], &[]);
            let holds = cover.holds(|atom| minterm >> atom & 1 == 1);
            for (row, label) in &rows {
                assert!(!row.contains(&point) || holds == *label, "seed {seed}");
            }
        }
        assert_prime(&columns, &set(false), &cover);
    }
}

/// No literal can be left out.
fn assert_prime(columns: &Columns, off: &Bits, cover: &Cover) {
    for cube in cover.cubes() {
        for literal in cube.literals() {
            assert!(!columns.cube_meets(&cube.without(*literal), off).is_empty());
        }
    }
}

fn packed(cube: &Cube) -> Packed {
    let mut packed = Packed::universe(8);
    for literal in cube.literals() {
        packed.set(literal.atom, Some(literal.positive));
    }
    packed
}

/// A complement holds where the cover does not.
#[test]
fn complements_are_exact() {
    for seed in 0..300 {
        let mut random = random(seed);
        let cubes: Vec<Packed> = (0..below(&mut random, 12))
            .map(|_| {
                let literals = below(&mut random, 6);
                packed(&cube(&mut random, 8, literals))
            })
            .collect();
        let complement = complement(8, &cubes, 1_000).unwrap();
        for minterm in 0..256 {
            let point = Packed::new(8, &[minterm], &[]);
            let holds = |cubes: &[Packed]| cubes.iter().any(|cube| cube.contains(&point));
            assert_ne!(holds(&cubes), holds(&complement), "seed {seed}, {minterm}");
        }
    }
}

/// Cubes of one literal each leave one cube, however many they are.
#[test]
fn literals_are_complemented_together() {
    let atoms = 3_000;
    let literal = |atom: usize| {
        let mut cube = Packed::universe(atoms);
        cube.set(atom, Some(atom.is_multiple_of(2)));
        cube
    };
    let literals: Vec<Packed> = (0..atoms).map(literal).collect();
    let complement = complement(atoms, &literals, 10_000).unwrap();
    let fixed: Vec<(usize, bool)> = complement.iter().flat_map(Packed::fixed).collect();
    let opposite: Vec<(usize, bool)> = (0..atoms)
        .map(|atom| (atom, !atom.is_multiple_of(2)))
        .collect();
    assert_eq!((complement.len(), fixed), (1, opposite));
}

/// The complement of n disjoint pairs has 2ⁿ cubes.
#[test]
fn a_complement_that_is_too_large_is_refused() {
    let pair = |i: usize| {
        let mut cube = Packed::universe(40);
        cube.set(2 * i, Some(true));
        cube.set(2 * i + 1, Some(true));
        cube
    };
    let pairs: Vec<Packed> = (0..20).map(pair).collect();
    assert_eq!(complement(40, &pairs, 100_000), None);
    assert_eq!(
        complement(40, &pairs[..10], 100_000).unwrap().len(),
        1 << 10
    );
}

/// Where `b` and `c` hold, either `a` or `not a` decides: two cubes cover that row together, however many minterms it has.
#[test]
fn several_primes_cover_a_large_cube_together() {
    let cubes = |rows: &[&[(usize, bool)]], atoms| {
        let row = |row: &&[(usize, bool)]| {
            let mut cube = Packed::universe(atoms);
            row.iter()
                .for_each(|(atom, value)| cube.set(*atom, Some(*value)));
            cube
        };
        rows.iter().map(row).collect::<Vec<Packed>>()
    };
    let (a, b, c) = (0, 1, 2);
    let rows: [&[(usize, bool)]; 5] = [
        &[(b, true), (c, true)],
        &[(a, true), (b, true), (c, false)],
        &[(a, false), (b, false), (c, true)],
        &[(a, true), (b, false)],
        &[(a, false), (c, false)],
    ];
    for atoms in [10, 14, 30, 100] {
        let columns = Columns::of(atoms, &cubes(&rows, atoms));
        let set = |range: std::ops::Range<usize>| Bits::collect(5, range);
        let cover = minimise_with(&columns, &set(0..3), &set(3..5), &Effort::default()).cover;
        assert_eq!(
            (cover.cubes().len(), cover.literals()),
            (2, 4),
            "{atoms} atoms: {cover:?}"
        );
        assert!(columns.cover_meets(&cover, &set(3..5)).is_empty());
    }
}
