//! The smallest formulas of conjunctions, disjunctions and literals for all functions of a few atoms.

use crate::ir::tree::{Atom, Guard};
use crate::logic::Literal;
use crate::tree::guard::{and, literal, not};

/// Formulas of more nodes are not sought: a unit more costs less.
const LARGEST: usize = 8;

/// The nodes of what has no formula: more than any tree here has, and few enough that some of them can be added.
pub(super) const NEVER: u8 = u8::MAX / 4;

/// How a formula is made, as a child of a conjunction.
#[derive(Clone, Copy, Debug)]
enum Made {
    Not,
    Literal(Literal),
    /// Of two functions.
    And(usize, usize),
    /// The negation of a conjunction: a disjunction of what is negated in it.
    Or,
}

/// The smallest formula for each function. A function is a number whose bit m is its value in minterm m, and bit i of m is the
/// value of the i-th atom.
pub(super) struct Formulas {
    atoms: usize,
    nodes: Vec<u8>,
    made: Vec<Made>,
}

impl Formulas {
    /// Those of this many atoms, at most four.
    ///
    /// By their size: a formula of n nodes is a conjunction of two smaller ones that have n nodes together, or a disjunction,
    /// whose negation as a conjunction has n - 1. Negation exchanges the two and changes no size (De Morgan).
    pub(super) fn new(atoms: usize) -> Self {
        let minterms = 1_usize << atoms;
        let mut found = Self {
            atoms,
            nodes: vec![NEVER; 1 << minterms],
            made: vec![Made::Not; 1 << minterms],
        };
        let mut levels: Vec<Vec<usize>> = vec![Vec::new(); LARGEST + 1];
        for atom in 0..atoms {
            for positive in [true, false] {
                let holds = |minterm: &usize| (minterm >> atom & 1 == 1) == positive;
                let function = (0..minterms).filter(holds).fold(0, |all, m| all | 1 << m);
                let literal = Literal { atom, positive };
                found.add(function, 1, Made::Literal(literal), &mut levels);
            }
        }
        for nodes in 2..=LARGEST {
            let negations = levels.get(nodes - 1).cloned().unwrap_or_default();
            for function in negations {
                found.add(found.negated(function), nodes, Made::Or, &mut levels);
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

    fn negated(&self, function: usize) -> usize {
        !function & ((1 << (1_usize << self.atoms)) - 1)
    }

    fn add(&mut self, function: usize, nodes: usize, made: Made, levels: &mut [Vec<usize>]) {
        let constant = function == 0 || self.negated(function) == 0;
        let (Some(known), Some(how)) = (self.nodes.get_mut(function), self.made.get_mut(function))
        else {
            return;
        };
        if !constant && nodes < usize::from(*known) {
            *known = nodes as u8;
            *how = made;
            if let Some(level) = levels.get_mut(nodes) {
                level.push(function);
            }
        }
    }

    /// The number of atoms.
    pub(super) fn atoms(&self) -> usize {
        self.atoms
    }

    /// The nodes of the smallest formula under a sequence, or [`NEVER`].
    pub(super) fn nodes(&self, function: usize) -> u8 {
        self.nodes.get(function).copied().unwrap_or(NEVER)
    }

    /// The smallest formula.
    pub(super) fn guard(&self, function: usize, atoms: &[Atom]) -> Guard {
        match self.made.get(function).copied().unwrap_or(Made::Not) {
            Made::Not => Guard::Const(false),
            Made::Literal(found) => literal(found, atoms),
            Made::And(a, b) => and([a, b].map(|part| self.guard(part, atoms))),
            Made::Or => not(self.guard(self.negated(function), atoms)),
        }
    }
}
