//! Several searches from the same tree, the best of which goes on.
//!
//! What a search finds hangs on what it happened to count and to race first: two on the same policy may end with trees of
//! 45 nodes and of 150. So there are several, each of which knows what was counted before, and what came of them races. Where
//! the file has trees, they begin with the best of these and with the exact tree in turn.
//!
//! An attempt ends with the tree that returns most where harm costs little. One on the way may have returned nearly as much
//! and done none. So all trees on all ways race where harm is dear.

use super::{Grower, Visited};
use crate::grow::race::{ENOUGH, Terms};
use crate::grow::step::{Detour, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;
use std::mem;

/// The most attempts, and the part of the effort that two of them take.
const ATTEMPTS: usize = 4;
const ATTEMPTED: f64 = 0.6;
/// The part of the effort after which no third or fourth begins.
const MORE: f64 = 0.35;
/// The part of the return that a tree lacks which falls short of the exact one, and the part of their price that nodes then cost.
const SHORT: f64 = 0.01;
const CHEAPER: f64 = 0.25;
/// The most trees of all ways that race in the end, the later ones.
const RACING: usize = 48;

impl<W: World> Grower<'_, '_, '_, W> {
    /// Begins an attempt.
    pub(super) fn attempt(&mut self, first: Node) -> (Node, Step) {
        self.attempts.begun = Some(self.judge.seen.ticks);
        (first, Step::Begun)
    }

    /// Whether an attempt is under way.
    pub(super) fn is_attempting(&self) -> bool {
        self.attempts.begun.is_some()
    }

    /// The ticks of an attempt, or of the whole search when they are over.
    pub(super) fn share(&self) -> f64 {
        let effort = self.settings.effort as f64;
        let attempted = effort * ATTEMPTED;
        match (self.is_attempting(), self.is_sparing()) {
            (true, true) => attempted,
            (true, false) => attempted / 2.0,
            (false, _) => effort,
        }
    }

    /// Whether there is only one attempt.
    pub(super) fn is_sparing(&self) -> bool {
        self.settings.effort < ENOUGH
    }

    /// Whether the attempt at hand has spent this part of its ticks.
    pub(super) fn has_spent(&self, part: f64) -> bool {
        let spent = self.judge.seen.ticks - self.attempts.begun.unwrap_or_default();
        spent as f64 >= part * self.share()
    }

    /// Begins the next attempt, or goes on with the best tree of all of them.
    pub(super) fn again(&mut self, base: Node, exact: &Node) -> (Node, Step) {
        self.visit(&base);
        self.attempts.found.push(mem::take(&mut self.visited));
        self.attempts.begun = None;
        if let Some(first) = self.next_start() {
            self.visit(&first);
            return self.attempt(first);
        }
        let mut found = mem::take(&mut self.attempts.found);
        self.visited = found.iter().flatten().cloned().collect();
        let base = self.reconsidered(base, Terms::taking(self.price));
        let has_best = |trees: &Vec<Visited>| trees.iter().any(|tree| tree.root == base);
        found.sort_by_key(has_best);
        self.visited = found.into_iter().flatten().collect();
        self.visit(&base);
        self.reprice(&base, exact);
        (base, Step::Detour(Detour::default()))
    }

    /// Lets nodes cost less if the tree that was found falls short of the exact one, which has more of them: what brought so
    /// little that it was left out may be what it lacks.
    fn reprice(&mut self, base: &Node, exact: &Node) {
        let [small, large] = [base, exact].map(|root| Size::of(root).nodes);
        if large <= small {
            return;
        }
        let terms = Terms::taking(SHORT * self.scale / (large - small) as f64);
        if self.judge.race(base, vec![exact.clone()], terms).is_some() {
            self.price *= CHEAPER;
        }
    }

    /// What the next attempt begins with, if there is one.
    fn next_start(&self) -> Option<Node> {
        let made = self.attempts.found.len();
        let goes_on = match made {
            _ if self.is_sparing() => false,
            0 | 1 => true,
            _ => made < ATTEMPTS && !self.spent(MORE),
        };
        let mut starts = self.attempts.starts.iter().cycle();
        goes_on.then(|| starts.nth(made).cloned()).flatten()
    }

    /// The best on these terms of the trees that were the best of their time.
    pub(super) fn reconsidered(&mut self, base: Node, terms: Terms) -> Node {
        let mut trees: Vec<Node> = Vec::new();
        for visited in self.visited.iter().rev() {
            if trees.len() < RACING && visited.root != base && !trees.contains(&visited.root) {
                trees.push(visited.root.clone());
            }
        }
        if trees.is_empty() {
            return base;
        }
        let found = self.judge.race(&base, trees, terms);
        found.map_or(base, |found| self.taken(found))
    }
}
