//! Rules: cubes that may stand before a subunit.

use super::minimiser::{Minimiser, Priced};
use super::subunit::Subunit;
use crate::logic::{Bits, Cover, Cube, Literal};
use std::collections::BTreeSet;

/// The most literals of cubes that are all made rules.
const SHORT: usize = 3;
/// The most short cubes that are made rules; reading them all may take this part of the work.
const MOST: usize = 600;
const SHARE: u64 = 1024;

/// The most rules.
const ALL: usize = 3_000;

/// A cube with its rows.
#[derive(Clone, Debug)]
pub(super) struct Rule {
    pub(super) cube: Cube,
    pub(super) rows: Bits,
}

/// A rule that applies among the rows left: all of them that it lets through belong to one subunit.
#[derive(Clone, Debug)]
pub(super) struct Applied {
    pub(super) rule: usize,
    pub(super) subunit: usize,
    /// The rows left that it decides.
    pub(super) rows: Bits,
}

/// The cubes of covers that were found, and short ones.
#[derive(Default)]
pub(super) struct Rules {
    rules: Vec<Rule>,
    known: BTreeSet<Cube>,
    asked: BTreeSet<usize>,
}

impl Rules {
    /// The rules of these covers, these cubes, and the short cubes over their atoms.
    pub(super) fn new(minimiser: &Minimiser, covers: &[&Cover], cubes: &[&Cube]) -> Self {
        let mut rules = Self::default();
        covers
            .iter()
            .for_each(|cover| rules.learn(minimiser, cover));
        cubes.iter().for_each(|cube| rules.add(minimiser, cube));
        // What is left of a cube without a literal may stand in a group behind that literal.
        for cube in cubes {
            for literal in cube.literals() {
                rules.add(minimiser, &cube.without(*literal));
            }
        }
        let words = minimiser.words();
        let columns = minimiser.problem.columns();
        // Where all atoms are too many, those that the covers ask.
        let every: Vec<usize> = (0..columns.atoms()).collect();
        let asked: Vec<usize> = rules.asked.iter().copied().collect();
        for atoms in [every, asked] {
            for length in (1..=SHORT).rev() {
                let count = count_short(atoms.len(), length);
                if count <= MOST
                    && minimiser
                        .account
                        .affords((count as u64).saturating_mul(words).saturating_mul(SHARE))
                {
                    rules.add_short(minimiser, &atoms, length);
                    return rules;
                }
            }
        }
        rules
    }

    /// Adds the cubes of a cover.
    pub(super) fn learn(&mut self, minimiser: &Minimiser, cover: &Cover) {
        for cube in cover.cubes() {
            self.add(minimiser, cube);
        }
    }

    fn add(&mut self, minimiser: &Minimiser, cube: &Cube) {
        if cube.literals().is_empty() || self.rules.len() >= ALL || self.known.contains(cube) {
            return;
        }
        let problem = minimiser.problem;
        minimiser
            .account
            .spend(minimiser.words() * cube.literals().len() as u64);
        let rows = problem.columns().cube_rows(cube, &problem.all());
        self.known.insert(cube.clone());
        let atoms = cube.literals().iter().map(|literal| literal.atom);
        self.asked.extend(atoms);
        if !rows.is_empty() {
            self.rules.push(Rule {
                cube: cube.clone(),
                rows,
            });
        }
    }

    /// Adds all cubes of up to `length` literals over these atoms.
    fn add_short(&mut self, minimiser: &Minimiser, atoms: &[usize], length: usize) {
        let mut open: Vec<(usize, Vec<Literal>)> = vec![(0, Vec::new())];
        for _ in 0..length {
            let mut longer = Vec::new();
            for (from, literals) in &open {
                for (i, atom) in atoms.iter().enumerate().skip(*from) {
                    for positive in [true, false] {
                        let more = Literal {
                            atom: *atom,
                            positive,
                        };
                        let literals: Vec<Literal> =
                            literals.iter().copied().chain([more]).collect();
                        self.add(minimiser, &Cube::new(literals.clone()));
                        longer.push((i + 1, literals));
                    }
                }
            }
            open = longer;
        }
    }

    fn get(&self, rule: usize) -> Option<&Rule> {
        self.rules.get(rule)
    }

    /// The number of literals of a rule.
    pub(super) fn literals(&self, rule: usize) -> usize {
        self.get(rule).map_or(0, |rule| rule.cube.literals().len())
    }

    /// Both literals of each atom that rules ask.
    pub(super) fn literals_asked(&self) -> Vec<Literal> {
        let atoms = self.asked.iter();
        atoms
            .flat_map(|&atom| [true, false].map(|positive| Literal { atom, positive }))
            .collect()
    }

    /// The rules that apply among the rows left; `owners` are the subunits of all rows.
    pub(super) fn applied(
        &self,
        minimiser: &Minimiser,
        subunits: &[Subunit],
        owners: &[usize],
        left: &Bits,
    ) -> Vec<Applied> {
        minimiser
            .account
            .spend(self.rules.len() as u64 * 2 * minimiser.words());
        let applied = self.rules.iter().enumerate().filter_map(|(at, rule)| {
            let first = rule.rows.first_of_both(left)?;
            let number = *owners.get(first)?;
            let subunit = subunits.get(number)?;
            if subunit.guards_itself || !rule.rows.both_within(left, &subunit.rows) {
                return None;
            }
            // A memory node stands in one place.
            let whole = subunit.is_behavior() || subunit.rows.both_within(left, &rule.rows);
            whole.then(|| Applied {
                rule: at,
                subunit: number,
                rows: rule.rows.and(left),
            })
        });
        applied.collect()
    }

    /// Rules among these that together decide all of these rows, chosen greedily by the rows that they decide for their
    /// literals, none superfluous; `None` where they do not suffice.
    pub(super) fn covering(&self, applied: &[&Applied], rows: &Bits) -> Option<Vec<usize>> {
        let worth = |a: &Applied, left: &Bits| {
            Self::per_node(a.rows.count_both(left), 1 + self.literals(a.rule))
        };
        let mut chosen: Vec<&Applied> = Vec::new();
        let mut left = rows.clone();
        while !left.is_empty() {
            let best = applied
                .iter()
                .map(|a| (worth(a, &left), *a))
                .max_by_key(|(worth, a)| (*worth, std::cmp::Reverse(a.rule)));
            let (_, best) = best.filter(|(worth, _)| *worth > 0)?;
            left.subtract(&best.rows);
            chosen.push(best);
        }
        let mut at = 0;
        while let Some(one) = chosen.get(at) {
            let others = chosen.iter().filter(|a| a.rule != one.rule);
            let covered = others.fold(Bits::empty(rows.bound()), |all, a| all.or(&a.rows));
            match rows.is_subset(&covered) {
                true => drop(chosen.remove(at)),
                false => at += 1,
            }
        }
        Some(chosen.into_iter().map(|a| a.rule).collect())
    }

    /// Rows by nodes, in 2520ths: small numbers of nodes divide 2520.
    pub(super) fn per_node(rows: usize, nodes: usize) -> usize {
        rows * 2520 / nodes
    }

    /// These rules as one guard.
    pub(super) fn guard(&self, minimiser: &Minimiser, rules: &[usize]) -> Priced {
        let cubes = rules.iter().filter_map(|rule| self.get(*rule));
        minimiser.factored(&Cover::new(cubes.map(|rule| rule.cube.clone())))
    }
}

/// The number of cubes of one to `length` literals.
fn count_short(atoms: usize, length: usize) -> usize {
    let mut all = 0_usize;
    let mut of_length = 1_usize;
    for i in 0..length.min(atoms) {
        of_length = of_length.saturating_mul(2 * (atoms - i)) / (i + 1);
        all = all.saturating_add(of_length);
    }
    all
}
