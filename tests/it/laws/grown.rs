//! Random trees, of every kind of node.

use super::build::{
    condition, decorated, done, failed, leaf, memory_selector, memory_sequence, not, p, parallel,
    selector, sequence, when,
};
use super::random::Random;
use btc::ir::tree::{Decorator, Guard, Node};

/// What a tree may be made of.
#[derive(Clone, Copy)]
pub(crate) struct Soil {
    pub(crate) predicates: usize,
    pub(crate) behaviors: usize,
    /// Whether guards ask `done` and `failed`.
    pub(crate) history: bool,
    /// Whether nodes may have memory.
    pub(crate) memory: bool,
    /// Whether any node is allowed, not only those that have a canonical form.
    pub(crate) wild: bool,
}

impl Soil {
    pub(crate) fn tree(self, random: &mut Random, depth: usize) -> Node {
        if depth == 0 || random.chance(12) {
            return match random.chance(55) {
                true => leaf(random.below(self.behaviors)),
                false => condition(self.guard(random, 2)),
            };
        }
        let memory = self.memory && random.chance(50);
        match random.below(if self.wild { 10 } else { 8 }) {
            0..4 if memory => memory_selector(self.trees(random, depth)),
            0..4 => selector(self.trees(random, depth)),
            4..8 if memory => memory_sequence(self.trees(random, depth)),
            4..8 => sequence(self.trees(random, depth)),
            8 => parallel(1 + random.below(2) as u32, self.trees(random, depth)),
            _ => {
                let kinds = if self.memory { 6 } else { 3 };
                let kind = match random.below(kinds) {
                    0 => Decorator::Invert,
                    1 => Decorator::Succeed,
                    2 => Decorator::Fail,
                    3 => Decorator::Retry(1 + random.below(3) as u32),
                    4 => Decorator::Repeat(1 + random.below(3) as u32),
                    _ => Decorator::Timeout(1 + random.below(2) as u64),
                };
                decorated(kind, self.tree(random, depth - 1))
            }
        }
    }

    /// A tree as people write them: selectors of guarded units to any depth, with chains if there is memory. Most
    /// have a canonical form.
    pub(crate) fn guarded(self, random: &mut Random, depth: usize) -> Node {
        let mut children: Vec<Node> = (0..1 + random.below(3))
            .map(|_| {
                let guard = self.guard(random, 2);
                match random.below(if depth == 0 { 2 } else { 4 }) {
                    0 if self.memory => when(guard, self.chain(random)),
                    0 | 1 => when(guard, leaf(random.below(self.behaviors))),
                    2 => decorated(
                        Decorator::Fail,
                        when(guard, self.guarded(random, depth - 1)),
                    ),
                    _ => when(guard, self.guarded(random, depth - 1)),
                }
            })
            .collect();
        if random.chance(40) {
            children.push(leaf(random.below(self.behaviors)));
        }
        selector(children)
    }

    /// Memory nodes, nested as in Figure 5, over different behaviours.
    fn chain(self, random: &mut Random) -> Node {
        let mut free: Vec<usize> = (0..self.behaviors).collect();
        let mut ends = |random: &mut Random| leaf(free.swap_remove(random.below(free.len())));
        let mut node = ends(random);
        for _ in 0..1 + random.below(self.behaviors - 1) {
            let mut children = vec![node, ends(random)];
            if random.chance(50) {
                children.swap(0, 1);
            }
            node = match random.chance(50) {
                true => memory_sequence(children),
                false => memory_selector(children),
            };
        }
        node
    }

    fn trees(self, random: &mut Random, depth: usize) -> Vec<Node> {
        (0..1 + random.below(3))
            .map(|_| self.tree(random, depth - 1))
            .collect()
    }

    pub(crate) fn guard(self, random: &mut Random, depth: usize) -> Guard {
        let parts = |random: &mut Random| -> Vec<Guard> {
            (0..2).map(|_| self.guard(random, depth - 1)).collect()
        };
        match if depth == 0 { 0 } else { random.below(5) } {
            0 | 1 if self.history && random.chance(30) => match random.chance(50) {
                true => done(random.below(self.behaviors)),
                false => failed(random.below(self.behaviors)),
            },
            0 | 1 => p(random.below(self.predicates)),
            2 => not(self.guard(random, depth - 1)),
            3 => Guard::And(parts(random)),
            _ => Guard::Or(parts(random)),
        }
    }
}
