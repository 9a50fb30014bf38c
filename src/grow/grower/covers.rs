//! Smaller trees that decide as the base does where it matters.

use super::{Grower, add};
use crate::grow::cover;
use crate::grow::evidence::Sight;
use crate::grow::field::{Aim, Field};
use crate::grow::race::Terms;
use crate::grow::step::{Cover, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// The fewest nodes of a tree that is covered by smaller ones, and the part of an attempt after which no more are made.
const COVERED: usize = 20;
const COVERS: f64 = 0.2;
/// The most nodes of a base: to change a larger one takes too long, so the best tree that covers it takes its place, better or not.
const LARGE: usize = 300;
/// What a decision of a tree that covers another may cost an episode, in prices of a node; and how often such trees are made, each
/// time knowing where those before went.
const SLACKS: [f64; 4] = [0.1, 0.5, 2.0, 8.0];
const PERMITTING: usize = 2;
/// The races of the trees that cover another.
const RUNS: usize = 2;

impl<W: World> Grower<'_, '_, '_, W> {
    /// Whether there is anything to gain from smaller trees that decide as the base does.
    pub(super) fn begin_covers(&mut self, base: Node) -> (Node, Step) {
        let nodes = Size::of(&base).nodes;
        let Some(tree) = self.single.clone().filter(|_| nodes > COVERED) else {
            return (base, Step::Sprout(0));
        };
        let mut visits = self.collect(&base, 0.05);
        add(&mut visits, self.collect(&base, 0.2));
        let cover = Cover {
            tree,
            visits,
            kept: FxHashMap::default(),
            trees: Vec::new(),
        };
        (base, Step::Cover(cover))
    }

    /// More trees that decide as the base does where it matters, from few of its decisions to all; then a race.
    pub(super) fn cover(&mut self, base: Node, mut cover: Cover) -> (Node, Step) {
        if !self.has_spent(COVERS) && self.covers_more(&base, &mut cover) {
            return (base, Step::Cover(cover));
        }
        for _ in 0..PERMITTING {
            self.permit(&base, &mut cover);
        }
        let mut best = self.best_of(base, cover.trees.clone(), RUNS);
        if Size::of(&best).nodes > LARGE {
            best = self.best_small(cover.trees).unwrap_or(best);
        }
        (best, Step::Sprout(0))
    }

    /// Adds trees that decide otherwise where that costs little.
    fn permit(&mut self, base: &Node, cover: &mut Cover) {
        let aim = Aim::Of(base);
        let field = Field::new(self.ground, &self.evidence, Sight::Far, &cover.visits, aim);
        let slacks = SLACKS.into_par_iter();
        let found = slacks
            .filter_map(|slack| cover::permitting(self.ground, &field, base, slack * self.price));
        let found: Vec<Node> = found.collect();
        for tree in found {
            if !cover.trees.contains(&tree) {
                let met = self.collect(&tree, 0.05);
                add(&mut cover.visits, met);
                cover.trees.push(tree);
            }
        }
    }

    /// The best of these trees that are not large.
    fn best_small(&mut self, mut trees: Vec<Node>) -> Option<Node> {
        trees.retain(|tree| Size::of(tree).nodes <= LARGE);
        let terms = Terms::searching(self.price);
        let found = self.judge.best(&trees, terms)?;
        Some(self.taken(found))
    }

    /// Adds trees, if there are more to add.
    fn covers_more(&mut self, base: &Node, cover: &mut Cover) -> bool {
        self.report(&cover.tree);
        let aim = Aim::Of(base);
        let field = Field::new(self.ground, &self.evidence, Sight::Far, &cover.visits, aim);
        let most = (cover.kept.len() / 5).max(2);
        let before = cover.kept.len();
        let missed = cover::missed(&field, &cover.tree, base, most);
        cover.kept.extend(missed);
        if cover.kept.len() == before {
            return false;
        }
        let next = cover::trees(self.ground, &cover.kept);
        let Some(smallest) = next.first() else {
            return false;
        };
        cover.tree = smallest.clone();
        if Size::of(&cover.tree).nodes * 5 > Size::of(base).nodes * 4 {
            return false;
        }
        // Where the trees before went still counts, less and less.
        cover.visits.values_mut().for_each(|weight| *weight *= 0.6);
        let met = self.collect(&cover.tree, 0.05);
        add(&mut cover.visits, met);
        for tree in next {
            if !cover.trees.contains(&tree) {
                cover.trees.push(tree);
            }
        }
        true
    }
}
