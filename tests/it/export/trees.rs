//! Random trees over the names of a program.

use crate::laws::build::{composite, condition, decorated, leaf, parallel, sequence, when};
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::Program;
use btc::ir::tree::{Atom, Composite, Decorator, Guard, Node};

/// What the trees of a kind have.
#[derive(Clone, Copy)]
pub(super) struct Kinds {
    /// `retry`, `repeat`
    pub(super) counters: bool,
    /// `timeout`
    pub(super) timeouts: bool,
    /// `parallel` where every child has to succeed, or where all of them are conditions.
    pub(super) all: bool,
}

/// The atoms that the trees ask.
pub(super) fn atoms(program: &Program) -> Vec<Atom> {
    let predicates = program.predicates.ids().map(Atom::Predicate);
    let done = program.behaviors.ids().map(Atom::Done);
    let failed = program.behaviors.ids().map(Atom::Failed);
    predicates.chain(done).chain(failed).collect()
}

pub(super) struct Grower<'a> {
    pub(super) random: &'a mut Random,
    pub(super) atoms: &'a [Atom],
    pub(super) behaviors: usize,
    pub(super) kinds: Kinds,
}

impl Grower<'_> {
    pub(super) fn guard(&mut self, depth: usize) -> Guard {
        let atom = Guard::Atom(self.atoms[self.random.below(self.atoms.len())]);
        if depth == 0 {
            return atom;
        }
        let several = |grower: &mut Self| {
            let number = 2 + grower.random.below(2);
            (0..number).map(|_| grower.guard(depth - 1)).collect()
        };
        match self.random.below(12) {
            0..4 => atom,
            4..6 => Guard::Not(Box::new(self.guard(depth - 1))),
            6..9 => Guard::And(several(self)),
            9..11 => Guard::Or(several(self)),
            _ => Guard::Const(self.random.chance(50)),
        }
    }

    fn leaf(&mut self) -> Node {
        leaf(self.random.below(self.behaviors))
    }

    /// A condition, or some nodes of conditions.
    fn asks(&mut self, depth: usize) -> Node {
        let guard = self.guard(2);
        if depth == 0 || self.random.chance(60) {
            return condition(guard);
        }
        let children = vec![self.asks(depth - 1), condition(guard)];
        match self.random.below(4) {
            0 => decorated(Decorator::Invert, self.asks(depth - 1)),
            1 if self.kinds.all => parallel(2, children),
            2 => composite(Composite::Selector, self.random.chance(50), children),
            _ => composite(Composite::Sequence, self.random.chance(50), children),
        }
    }

    /// Any tree.
    pub(super) fn plain(&mut self, depth: usize) -> Node {
        if depth == 0 {
            return if self.random.chance(75) {
                self.leaf()
            } else {
                condition(self.guard(1))
            };
        }
        let kind = match self.random.below(2) {
            0 => Composite::Selector,
            _ => Composite::Sequence,
        };
        match self.random.below(12) {
            0..4 => {
                let number = 1 + self.random.below(4);
                let children = (0..number).map(|_| self.plain(depth - 1)).collect();
                composite(kind, false, children)
            }
            4..6 => when(self.guard(2), self.plain(depth - 1)),
            6 => {
                let number = self.random.below(3);
                let mut children: Vec<Node> = (0..number).map(|_| self.asks(1)).collect();
                children.push(self.plain(depth - 1));
                composite(kind, true, children)
            }
            7 => {
                let number = 2 + self.random.below(3);
                let children = (0..number).map(|_| self.plain(depth - 1)).collect();
                composite(kind, true, children)
            }
            8 if self.kinds.all => {
                let children = vec![self.plain(depth - 1)];
                parallel(1, children)
            }
            9 if self.kinds.timeouts => {
                let ticks = 1 + self.random.below(4) as u64;
                decorated(Decorator::Timeout(ticks), self.plain(depth - 1))
            }
            10 if self.kinds.counters => {
                let times = 1 + self.random.below(3) as u32;
                let kind = match self.random.below(2) {
                    0 => Decorator::Retry(times),
                    _ => Decorator::Repeat(times),
                };
                decorated(kind, self.plain(depth - 1))
            }
            _ => {
                let kinds = [Decorator::Invert, Decorator::Succeed, Decorator::Fail];
                decorated(kinds[self.random.below(3)], self.plain(depth - 1))
            }
        }
    }

    /// A tree as it is learned: conditions alone select, and what they select drives on to its end. Behaviours of odd
    /// number may fail, those of even number do not.
    pub(super) fn learned(&mut self, depth: usize) -> Node {
        let number = 1 + self.random.below(4);
        let mut children = Vec::new();
        for _ in 0..number {
            let guard = self.guard(2);
            let node = if depth > 0 && self.random.chance(30) {
                self.learned(depth - 1)
            } else {
                self.drive(2)
            };
            children.push(when(guard, node));
        }
        if self.random.chance(80) {
            children.push(self.drive(2));
        }
        composite(Composite::Selector, false, children)
    }

    /// Behaviours one after the other, which do not fail on the whole.
    fn drive(&mut self, depth: usize) -> Node {
        let steady = leaf(2 * self.random.below(self.behaviors.div_ceil(2)));
        let shaky = leaf(2 * self.random.below(self.behaviors / 2) + 1);
        if depth == 0 {
            return steady;
        }
        match self.random.below(8) {
            0..2 => steady,
            2..5 => {
                let number = 1 + self.random.below(3);
                let children = (0..number).map(|_| self.drive(depth - 1)).collect();
                composite(Composite::Sequence, true, children)
            }
            5 => {
                let children = vec![shaky, self.drive(depth - 1)];
                composite(Composite::Selector, true, children)
            }
            6 if self.kinds.counters => {
                let times = 1 + self.random.below(3) as u32;
                let shaky = decorated(Decorator::Retry(times), shaky);
                decorated(Decorator::Succeed, shaky)
            }
            7 if self.kinds.counters => {
                let times = 1 + self.random.below(3) as u32;
                decorated(Decorator::Repeat(times), self.drive(depth - 1))
            }
            _ => decorated(Decorator::Succeed, sequence(vec![shaky])),
        }
    }
}

/// Every atom alone, then every behaviour alone.
pub(super) fn subjects(program: &Program) -> (Vec<Node>, Vec<Node>) {
    let asked = atoms(program).into_iter();
    let asked = asked.map(|atom| condition(Guard::Atom(atom))).collect();
    let done = (0..program.behaviors.len()).map(|b| Node::Behavior(Id::new(b)));
    (asked, done.collect())
}
