//! Functions of one output with few rows given, of several kinds.

use super::planted::{below, cube, minterm};
use btc::logic::{Cover, Cube};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Where the labels of the rows come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// A disjunction of 2–8 cubes of 2–5 literals.
    Terms,
    /// A list of 8 cubes of 2–4 literals with labels, the first that holds decides.
    List,
    /// A coin.
    Noise,
    /// A coin; the rows are cubes in which each atom is free with a probability of one half.
    Cubes,
}

impl Kind {
    /// Every one.
    pub const ALL: [Self; 4] = [Self::Terms, Self::List, Self::Noise, Self::Cubes];

    /// Its name in a file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Terms => "terms",
            Self::List => "list",
            Self::Noise => "noise",
            Self::Cubes => "cubes",
        }
    }
}

/// The function as a PLA of type `fr`. No row meets one of the other label.
pub fn pla(kind: Kind, atoms: usize, rows: usize, seed: u64) -> String {
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    let mut text = format!(".i {atoms}\n.o 1\n.type fr\n.p {rows}\n");
    let mut line = |row: &str, label: bool| {
        writeln!(text, "{row} {}", u8::from(label)).unwrap();
    };
    if kind == Kind::Cubes {
        for (row, label) in cubes(&mut random, atoms, rows) {
            line(&row, label);
        }
    } else {
        let label = labels(kind, &mut random, atoms);
        let mut seen = BTreeSet::new();
        while seen.len() < rows {
            let row = minterm(&mut random, atoms);
            if seen.insert(row.clone()) {
                let value = |atom: usize| row[atom / 64] >> (atom % 64) & 1 == 1;
                let shown: String = (0..atoms)
                    .map(|a| if value(a) { '1' } else { '0' })
                    .collect();
                line(&shown, label(&mut random, &value));
            }
        }
    }
    text + ".e\n"
}

/// The label of a row, from its values.
type Label = Box<dyn Fn(&mut Xoshiro256PlusPlus, &dyn Fn(usize) -> bool) -> bool>;

fn labels(kind: Kind, random: &mut Xoshiro256PlusPlus, atoms: usize) -> Label {
    match kind {
        Kind::Terms => {
            let terms = 2 + below(random, 7);
            let term = |_| {
                let literals = 2 + below(random, 4);
                cube(random, atoms, literals)
            };
            let cover = Cover::new((0..terms).map(term));
            Box::new(move |_, value| cover.holds(value))
        }
        Kind::List => {
            let rule = |_| {
                let literals = 2 + below(random, 3);
                (cube(random, atoms, literals), coin(random))
            };
            let rules: Vec<(Cube, bool)> = (0..8).map(rule).collect();
            Box::new(move |_, value| {
                let first = rules.iter().find(|(cube, _)| cube.holds(value));
                first.is_some_and(|(_, label)| *label)
            })
        }
        Kind::Noise | Kind::Cubes => Box::new(|random, _| coin(random)),
    }
}

fn coin(random: &mut impl Rng) -> bool {
    random.next_u64() >> 63 == 1
}

/// Random cubes with labels, each disjoint from those of the other label.
fn cubes(random: &mut Xoshiro256PlusPlus, atoms: usize, rows: usize) -> Vec<(String, bool)> {
    let mut found: Vec<(String, bool)> = Vec::new();
    while found.len() < rows {
        let value = |_| match below(random, 4) {
            0 => '0',
            1 => '1',
            _ => '-',
        };
        let row: String = (0..atoms).map(value).collect();
        let label = coin(random);
        let apart = |other: &str| {
            let mut pairs = row.chars().zip(other.chars());
            pairs.any(|(a, b)| a != '-' && b != '-' && a != b)
        };
        if found.iter().all(|(other, l)| *l == label || apart(other)) {
            found.push((row, label));
        }
    }
    found
}
