//! Rules: cubes that may let a subunit through.

use super::covers::{Covers, Priced};
use super::factor::{Cost, factored};
use super::subunit::Subunit;
use crate::logic::{Bits, Cover, Cube, Literal};
use std::collections::BTreeSet;

/// Literals of the cubes that are all tried while there is work left.
const SHORT: usize = 2;
/// The part of the work that looking at every rule once may take.
const SHARE: u64 = 1024;

/// A cube with its rows and what it costs as a guard.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) cube: Cube,
    pub(super) rows: Bits,
    pub(super) literals: usize,
}

/// A rule as it stands among rows that are left.
#[derive(Clone, Debug)]
pub(super) struct Standing {
    pub(super) rule: usize,
    pub(super) subunit: usize,
    /// The rows that are left and that it decides.
    pub(super) rows: Bits,
}

/// Cubes that were found to be of use, and short ones.
#[derive(Default)]
pub(super) struct Rules {
    rules: Vec<Rule>,
    known: BTreeSet<Cube>,
    asked: BTreeSet<usize>,
}

impl Rules {
    /// The rules of these covers and the short cubes over their atoms.
    pub(super) fn new<'c>(covers: &Covers, useful: impl Iterator<Item = &'c Cover>) -> Self {
        let mut rules = Self::default();
        for cover in useful {
            rules.learn(covers, cover);
        }
        let words = covers.words();
        let columns = covers.problem.columns();
        // Where all atoms are too many, those that the covers ask.
        let every: Vec<usize> = (0..columns.atoms()).collect();
        let asked: Vec<usize> = rules.asked.iter().copied().collect();
        for atoms in [every, asked] {
            for length in (1..=SHORT).rev() {
                let count = short(atoms.len(), length);
                if covers.affords((count as u64).saturating_mul(words).saturating_mul(SHARE)) {
                    rules.short(covers, &atoms, length);
                    return rules;
                }
            }
        }
        rules
    }

    /// Adds the cubes of a cover.
    pub(super) fn learn(&mut self, covers: &Covers, cover: &Cover) {
        for cube in cover.cubes() {
            self.add(covers, cube);
        }
    }

    fn add(&mut self, covers: &Covers, cube: &Cube) {
        if cube.literals().is_empty() || self.known.contains(cube) {
            return;
        }
        let problem = covers.problem;
        covers.spend(covers.words() * cube.literals().len() as u64);
        let rows = problem.columns().cube_rows(cube, &problem.all());
        self.known.insert(cube.clone());
        let atoms = cube.literals().iter().map(|literal| literal.atom);
        self.asked.extend(atoms);
        if !rows.is_empty() {
            self.rules.push(Rule {
                literals: cube.literals().len(),
                cube: cube.clone(),
                rows,
            });
        }
    }

    fn short(&mut self, covers: &Covers, atoms: &[usize], length: usize) {
        let literals = atoms.iter().flat_map(|atom| {
            [true, false].map(|positive| Literal {
                atom: *atom,
                positive,
            })
        });
        let literals: Vec<Literal> = literals.collect();
        for (i, first) in literals.iter().enumerate() {
            self.add(covers, &Cube::new([*first]));
            if length > 1 {
                for second in literals.iter().skip(i + 1) {
                    if first.atom != second.atom {
                        self.add(covers, &Cube::new([*first, *second]));
                    }
                }
            }
        }
    }

    /// A rule.
    pub(super) fn get(&self, rule: usize) -> Option<&Rule> {
        self.rules.get(rule)
    }

    /// The atoms that rules ask.
    pub(super) fn asked(&self) -> &BTreeSet<usize> {
        &self.asked
    }

    /// All rules.
    pub(super) fn iter(&self) -> impl Iterator<Item = (usize, &Rule)> {
        self.rules.iter().enumerate()
    }

    /// The rules that decide some of the rows that are left, all in favour of one subunit.
    pub(super) fn standing(
        &self,
        covers: &Covers,
        subunits: &[Subunit],
        left: &Bits,
    ) -> Vec<Standing> {
        covers.spend(self.rules.len() as u64 * 2 * covers.words());
        let standing = self.iter().filter_map(|(at, rule)| {
            let rows = rule.rows.and(left);
            let first = rows.first()?;
            let own = |(_, subunit): &(usize, &Subunit)| subunit.rows.contains(first);
            let (number, subunit) = subunits.iter().enumerate().find(own)?;
            // A memory node stands in one place only.
            let whole = || subunit.is_behavior() || subunit.rows.and(left).is_subset(&rows);
            (rows.is_subset(&subunit.rows) && !subunit.guards_itself && whole()).then_some(
                Standing {
                    rule: at,
                    subunit: number,
                    rows,
                },
            )
        });
        standing.collect()
    }

    /// These rules as one guard.
    pub(super) fn guard(&self, covers: &Covers, rules: &[usize]) -> Priced {
        let cubes = rules.iter().filter_map(|rule| self.get(*rule));
        let cover = Cover::new(cubes.map(|rule| rule.cube.clone()));
        Priced::new(factored(&cover, &covers.problem.policy.atoms))
    }
}

/// How many cubes of up to so many literals there are.
fn short(atoms: usize, length: usize) -> usize {
    let single = 2 * atoms;
    match length {
        1 => single,
        _ => single + single.saturating_mul(single.saturating_sub(2)) / 2,
    }
}

/// The cost of a cube before a body: the sequence and the literals.
pub(super) fn guarding(literals: usize) -> Cost {
    (1 + literals, literals)
}
