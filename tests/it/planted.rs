//! Planted problems: tables of random minterms whose labels come from a decision list that is known.

use btc::logic::{Bits, Columns, Cover, Cube, Literal};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;

/// Behaviours of a planted list, the last without a guard.
pub const BEHAVIORS: usize = 8;

/// A table with the list that labels it.
pub struct Planted {
    /// The table.
    pub columns: Columns,
    /// The rows of each behaviour.
    pub classes: Vec<Bits>,
    /// The guards of all behaviours but the last.
    pub guards: Vec<Cover>,
    /// The rows in machine words, atom 0 in the lowest bit of the first.
    pub rows: Vec<Box<[u64]>>,
}

/// `rows` random minterms over `atoms` atoms under a random list: guards of 1–3 cubes of 2–4 literals.
pub fn planted(atoms: usize, rows: usize, seed: u64) -> Planted {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let guards: Vec<Cover> = (1..BEHAVIORS)
        .map(|_| {
            let cubes = 1 + below(&mut random, 3);
            Cover::new((0..cubes).map(|_| {
                let literals = 2 + below(&mut random, 3);
                cube(&mut random, atoms, literals)
            }))
        })
        .collect();
    let rows: Vec<Box<[u64]>> = (0..rows).map(|_| minterm(&mut random, atoms)).collect();
    let mut classes = vec![Bits::empty(rows.len()); BEHAVIORS];
    for (r, row) in rows.iter().enumerate() {
        let value = |atom: usize| row[atom / 64] >> (atom % 64) & 1 == 1;
        let first = guards.iter().position(|guard| guard.holds(value));
        classes[first.unwrap_or(BEHAVIORS - 1)].insert(r);
    }
    Planted {
        columns: Columns::new(atoms, rows.iter().map(|row| &**row)),
        classes,
        guards,
        rows,
    }
}

impl Planted {
    /// Cubes and literals of the guards.
    pub fn size(&self) -> (usize, usize) {
        size(&self.guards)
    }
}

/// Cubes and literals of covers.
pub fn size(covers: &[Cover]) -> (usize, usize) {
    let cubes = covers.iter().map(|cover| cover.cubes().len()).sum();
    (cubes, covers.iter().map(Cover::literals).sum())
}

/// A random number below `bound`.
pub fn below(random: &mut impl Rng, bound: usize) -> usize {
    (random.next_u64() % bound as u64) as usize
}

/// A random cube of this many literals.
pub fn cube(random: &mut impl Rng, atoms: usize, literals: usize) -> Cube {
    let mut found: Vec<Literal> = Vec::new();
    while found.len() < literals {
        let atom = below(random, atoms);
        if found.iter().all(|literal| literal.atom != atom) {
            let positive = random.next_u64() & 1 == 1;
            found.push(Literal { atom, positive });
        }
    }
    Cube::new(found)
}

/// A random minterm; bits past the last atom are 0.
pub fn minterm(random: &mut impl Rng, atoms: usize) -> Box<[u64]> {
    let mut words: Box<[u64]> = (0..atoms.div_ceil(64)).map(|_| random.next_u64()).collect();
    if let (Some(last), 1..) = (words.last_mut(), atoms % 64) {
        *last &= (1 << (atoms % 64)) - 1;
    }
    words
}
