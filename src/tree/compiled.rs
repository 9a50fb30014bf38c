//! The compiled form of a tree: nodes in pre-order, guards as jumps between masked comparisons.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node};

/// A tree in pre-order: the children of a node follow it, each up to its own `end`.
#[derive(Clone, Debug)]
pub(super) struct CompiledTree {
    pub(super) nodes: Vec<Placed>,
    pub(super) tests: Vec<Test>,
    /// The memory of all nodes together, in numbers.
    pub(super) slots: usize,
}

/// A node with the extent of its subtree.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placed {
    pub(super) op: Op,
    /// One past the last node of the subtree.
    pub(super) end: usize,
    /// The memory of the subtree: its slots are `slots.0 .. slots.1`, the node's own is the first.
    pub(super) slots: (usize, usize),
}

/// What a node does.
#[derive(Clone, Copy, Debug)]
pub(super) enum Op {
    Condition(Jump),
    Behavior(Id<Behavior>),
    Composite { kind: Composite, memory: bool },
    Parallel { needed: u32, children: u32 },
    Decorator(Decorator),
}

/// Where a guard goes on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Jump {
    Answer(bool),
    Test(usize),
}

/// Whether the masked bits of one word have a value.
#[derive(Clone, Copy, Debug)]
pub(super) struct Test {
    pub(super) word: usize,
    pub(super) mask: u64,
    pub(super) value: u64,
    pub(super) yes: Jump,
    pub(super) no: Jump,
}

impl CompiledTree {
    /// Compiles a tree over these atoms; the error is an atom that is not among them.
    pub(super) fn new(root: &Node, atoms: &[Atom]) -> Result<Self, Atom> {
        let mut tree = Self {
            nodes: Vec::new(),
            tests: Vec::new(),
            slots: 0,
        };
        tree.node(root, atoms)?;
        Ok(tree)
    }

    fn node(&mut self, node: &Node, atoms: &[Atom]) -> Result<(), Atom> {
        let op = match node {
            Node::Condition(guard) => {
                Op::Condition(self.guard(guard, atoms, Jump::Answer(true), Jump::Answer(false))?)
            }
            Node::Behavior(behavior) => Op::Behavior(*behavior),
            Node::Composite { kind, memory, .. } => Op::Composite {
                kind: *kind,
                memory: *memory,
            },
            Node::Parallel {
                successes,
                children,
            } => Op::Parallel {
                needed: *successes,
                children: u32::try_from(children.len()).unwrap_or(u32::MAX),
            },
            Node::Decorator { kind, .. } => Op::Decorator(*kind),
        };
        let at = self.nodes.len();
        let first = self.slots;
        let remembers = matches!(
            op,
            Op::Composite { memory: true, .. }
                | Op::Decorator(Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_))
        );
        self.slots += usize::from(remembers);
        let placed = Placed {
            op,
            end: at + 1,
            slots: (first, self.slots),
        };
        self.nodes.push(placed);
        for child in node.children() {
            self.node(child, atoms)?;
        }
        let (end, slots) = (self.nodes.len(), self.slots);
        if let Some(placed) = self.nodes.get_mut(at) {
            placed.end = end;
            placed.slots.1 = slots;
        }
        Ok(())
    }

    /// Compiles a guard that goes on at `yes` or `no`, and says where it starts.
    fn guard(&mut self, guard: &Guard, atoms: &[Atom], yes: Jump, no: Jump) -> Result<Jump, Atom> {
        match guard {
            Guard::Const(value) => Ok(if *value { yes } else { no }),
            Guard::Atom(atom) => self.all(&[(*atom, true)], atoms, yes, no),
            Guard::Not(guard) => self.guard(guard, atoms, no, yes),
            Guard::And(guards) => {
                let (literals, rest) = split(guards);
                let mut next = yes;
                for guard in rest.into_iter().rev() {
                    next = self.guard(guard, atoms, next, no)?;
                }
                self.all(&literals, atoms, next, no)
            }
            Guard::Or(guards) => {
                // a or b is not (not a and not b).
                let (literals, rest) = split(guards);
                let negated: Vec<_> = literals
                    .iter()
                    .map(|(atom, value)| (*atom, !value))
                    .collect();
                let mut next = no;
                for guard in rest.into_iter().rev() {
                    next = self.guard(guard, atoms, yes, next)?;
                }
                self.all(&negated, atoms, next, yes)
            }
        }
    }

    /// Compiles a conjunction of literals: one comparison per word.
    fn all(
        &mut self,
        literals: &[(Atom, bool)],
        atoms: &[Atom],
        yes: Jump,
        no: Jump,
    ) -> Result<Jump, Atom> {
        let mut words: Vec<(usize, u64, u64)> = Vec::new();
        for (atom, value) in literals {
            let bit = atoms.iter().position(|a| a == atom).ok_or(*atom)?;
            let (word, mask) = (bit / 64, 1 << (bit % 64));
            let wanted = if *value { mask } else { 0 };
            match words.iter_mut().find(|(w, ..)| *w == word) {
                // An atom and its negation never hold together.
                Some((_, m, v)) if *m & mask != 0 && *v & mask != wanted => return Ok(no),
                Some((_, m, v)) => {
                    *m |= mask;
                    *v |= wanted;
                }
                None => words.push((word, mask, wanted)),
            }
        }
        let mut next = yes;
        for (word, mask, value) in words.into_iter().rev() {
            self.tests.push(Test {
                word,
                mask,
                value,
                yes: next,
                no,
            });
            next = Jump::Test(self.tests.len() - 1);
        }
        Ok(next)
    }
}

/// The literals of a list of guards, and what is left.
fn split(guards: &[Guard]) -> (Vec<(Atom, bool)>, Vec<&Guard>) {
    let mut literals = Vec::new();
    let mut rest = Vec::new();
    for guard in guards {
        match guard {
            Guard::Atom(atom) => literals.push((*atom, true)),
            Guard::Not(inner) if matches!(**inner, Guard::Atom(_)) => {
                if let Guard::Atom(atom) = **inner {
                    literals.push((atom, false));
                }
            }
            _ => rest.push(guard),
        }
    }
    (literals, rest)
}
