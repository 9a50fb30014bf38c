//! The smallest formulas of conjunctions, disjunctions and literals for all sets of a few rows.

use crate::ir::tree::{Atom, Guard};
use crate::logic::Literal;
use crate::tree::guard::{and, literal, not};

/// Formulas of more nodes are not sought: larger guards are parted among units.
const LARGEST: usize = 14;

/// The nodes of what has no formula: more than any formula here has, and few enough that some of them can be added.
pub(super) const NEVER: u8 = u8::MAX / 4;

/// How a formula is made, as a child of a conjunction.
#[derive(Clone, Copy, Debug)]
enum Made {
    Not,
    Literal(Literal),
    /// Of two sets.
    And(usize, usize),
    /// The negation of a conjunction: a disjunction of what is negated in it.
    Or,
}

/// The smallest formula for each set of rows: one that holds on these and on no others. Bit r of a set is the r-th row.
pub(super) struct Formulas {
    rows: usize,
    nodes: Vec<u8>,
    made: Vec<Made>,
}

impl Formulas {
    /// Those over atoms that hold in these sets of so many rows.
    ///
    /// By their size: a formula of n nodes is a conjunction of two smaller ones that have n nodes together, or a disjunction,
    /// whose negation as a conjunction has n - 1. Negation exchanges the two and changes no size (De Morgan).
    pub(super) fn new(rows: usize, columns: &[usize]) -> Self {
        let mut found = Self {
            rows,
            nodes: vec![NEVER; 1 << rows],
            made: vec![Made::Not; 1 << rows],
        };
        let mut levels: Vec<Vec<usize>> = vec![Vec::new(); LARGEST + 1];
        for (atom, column) in columns.iter().enumerate() {
            for positive in [true, false] {
                let set = if positive {
                    *column
                } else {
                    found.negated(*column)
                };
                let literal = Literal { atom, positive };
                found.add(set, 1, Made::Literal(literal), &mut levels);
            }
        }
        for nodes in 2..=LARGEST {
            // None and all of the rows have no formula.
            if found.nodes.iter().filter(|nodes| **nodes == NEVER).count() <= 2 {
                break;
            }
            let negations = levels.get(nodes - 1).cloned().unwrap_or_default();
            for set in negations {
                found.add(found.negated(set), nodes, Made::Or, &mut levels);
            }
            for fewer in 1..=nodes / 2 {
                let of = |nodes: usize| levels.get(nodes).cloned().unwrap_or_default();
                let (first, second) = (of(fewer), of(nodes - fewer));
                for a in &first {
                    for b in &second {
                        found.add(a & b, nodes, Made::And(*a, *b), &mut levels);
                    }
                }
            }
        }
        found
    }

    fn negated(&self, set: usize) -> usize {
        !set & ((1 << self.rows) - 1)
    }

    fn add(&mut self, set: usize, nodes: usize, made: Made, levels: &mut [Vec<usize>]) {
        let constant = set == 0 || self.negated(set) == 0;
        let (Some(known), Some(how)) = (self.nodes.get_mut(set), self.made.get_mut(set)) else {
            return;
        };
        if !constant && nodes < usize::from(*known) {
            *known = nodes as u8;
            *how = made;
            if let Some(level) = levels.get_mut(nodes) {
                level.push(set);
            }
        }
    }

    /// The nodes of the smallest formula under a sequence, or [`NEVER`].
    pub(super) fn nodes(&self, set: usize) -> u8 {
        self.nodes.get(set).copied().unwrap_or(NEVER)
    }

    /// The smallest formula.
    pub(super) fn guard(&self, set: usize, atoms: &[Atom]) -> Guard {
        match self.made.get(set).copied().unwrap_or(Made::Not) {
            Made::Not => Guard::Const(false),
            Made::Literal(found) => literal(found, atoms),
            Made::And(a, b) => and([a, b].map(|part| self.guard(part, atoms))),
            Made::Or => not(self.guard(self.negated(set), atoms)),
        }
    }
}
