//! Several searches from the same tree, the best of which goes on.
//!
//! What a search finds hangs on what it happened to count and to race first: two on the same policy may end with trees of
//! 45 nodes and of 150. So there are several, each of which knows what was counted before, and what came of them races. Where
//! the file has trees, one begins with the best of these and one with the exact tree.

use super::{Grower, Visited};
use crate::grow::race::{ENOUGH, Terms};
use crate::grow::step::{Detour, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use std::mem;

/// The attempts, and the part of the effort that they take.
const ATTEMPTS: usize = 2;
const ATTEMPTED: f64 = 0.6;
/// The trees that are kept of an attempt that was not the best.
const KEPT: usize = 3;

impl<W: World> Grower<'_, '_, '_, W> {
    /// Begins an attempt.
    pub(super) fn attempt(&mut self, first: Node) -> (Node, Step) {
        self.attempts.first = Some(first.clone());
        self.attempts.begun = self.judge.seen.ticks;
        (first, Step::Begun)
    }

    /// Whether an attempt is under way.
    pub(super) fn is_attempting(&self) -> bool {
        self.attempts.first.is_some()
    }

    /// How many attempts there are.
    fn most(&self) -> usize {
        match self.settings.effort < ENOUGH {
            true => 1,
            false => ATTEMPTS,
        }
    }

    /// The ticks of an attempt, or of the whole search when they are over.
    pub(super) fn share(&self) -> f64 {
        let effort = self.settings.effort as f64;
        match self.is_attempting() {
            true => effort * ATTEMPTED / self.most() as f64,
            false => effort,
        }
    }

    /// Whether the attempt at hand has spent this part of its ticks.
    pub(super) fn has_spent(&self, part: f64) -> bool {
        let spent = self.judge.seen.ticks - self.attempts.begun;
        spent as f64 >= part * self.share()
    }

    /// Begins the next attempt, or goes on with the best tree of all of them.
    pub(super) fn again(&mut self, base: Node) -> (Node, Step) {
        self.visit(&base);
        self.attempts.found.push(mem::take(&mut self.visited));
        let first = self.attempts.first.take();
        if let Some(first) = first.filter(|_| self.attempts.found.len() < self.most()) {
            let first = self.attempts.other.take().unwrap_or(first);
            self.visit(&first);
            return self.attempt(first);
        }
        let mut found = mem::take(&mut self.attempts.found);
        let tops = found.iter().filter_map(|trees| trees.last());
        let tops = tops.map(|top| top.root.clone()).filter(|top| *top != base);
        let tops: Vec<Node> = tops.collect();
        let terms = Terms::taking(self.price);
        let race = (!tops.is_empty()).then(|| self.judge.race(&base, tops, terms));
        let best = race.flatten();
        let base = best.map_or(base, |best| best.root);
        let is_best = |trees: &Vec<Visited>| trees.last().is_some_and(|top| top.root == base);
        found.sort_by_key(is_best);
        let kept = found.into_iter().flat_map(|trees| {
            let kept = if is_best(&trees) { trees.len() } else { KEPT };
            let from = trees.len().saturating_sub(kept);
            trees.into_iter().skip(from)
        });
        self.visited = kept.collect();
        (base, Step::Detour(Detour::default()))
    }
}
