//! One change after another, each kept if a race says so.

use super::{Grower, add};
use crate::grow::Choice;
use crate::grow::bodies;
use crate::grow::evidence::Sight;
use crate::grow::field::{Aim, Field};
use crate::grow::propose::{Proposal, Proposer, number};
use crate::grow::race::{Harm, Terms};
use crate::grow::step::{Stage, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;
use rustc_hash::{FxHashMap, FxHashSet};

/// Proposals of a round: those of which the counts promise most, others at random, nodes with memory, and behaviours with another to
/// do where they fail.
const BEST: usize = 20;
const RANDOM: usize = 20;
const MEMORIES: usize = 8;
const FALLS: usize = 6;
/// Proposals that do the same in the minterms that matter, at most: where trees change, and where they only get smaller.
const ALIKE: [usize; 2] = [1, 3];
/// The stages of climbing: the part of a node's price, what harm costs, whether trees only get smaller, and the part of the
/// effort after which the stage ends.
const CLIMBS: [(f64, Harm, bool, f64); 4] = [
    (1.0, Harm::Cheap, false, 0.62),
    (0.7, Harm::Middling, false, 0.8),
    (0.5, Harm::Dear, false, 0.93),
    (1.0, Harm::Dear, true, 1.0),
];
/// The stage that begins with the best of all trees so far: from it on harm is dear.
const RECONSIDERED: usize = 2;
/// Races without a better tree before a stage ends.
const FAILURES: usize = 3;
/// The prices, in parts of a node's, at which smaller trees are looked for that cost something.
const DEARER: [f64; 4] = [3.0, 10.0, 30.0, 100.0];

impl<W: World> Grower<'_, '_, '_, W> {
    /// One change, proposed by the counts and by chance, kept if a race says so.
    pub(super) fn climb(&mut self, base: Node, mut stage: Stage) -> (Node, Step) {
        if self.is_attempting() && (stage.failures >= FAILURES || self.has_spent(1.0)) {
            return (base, Step::Attempted);
        }
        let Some((factor, harm, only, until)) = CLIMBS.get(stage.number) else {
            // An attempt in a small world ends where there is nothing left to try.
            let next = match self.is_attempting() {
                true => Step::Attempted,
                false => Step::Refine(Stage::default()),
            };
            return (base, next);
        };
        if stage.failures >= FAILURES || self.spent(*until) {
            return (base, Step::Climb(Stage::of(stage.number + 1)));
        }
        self.report(&base);
        let node = if *only { self.full_price } else { self.price };
        let price = node * factor;
        let terms = Terms::of(price, *harm);
        if stage.number > 0 {
            self.charge(terms);
        }
        let is_first = stage.failures == 0 && stage.tried.is_empty();
        if stage.number == RECONSIDERED && is_first && self.judge.seen.harmed {
            let best = self.reconsidered(base.clone(), terms);
            if best != base {
                return (best, Step::Climb(stage));
            }
        }
        let trees = self.proposals(&base, price, *only, &mut stage.tried);
        if trees.is_empty() {
            return (base, Step::Climb(Stage::of(stage.number + 1)));
        }
        match self.judge.race(&base, trees, terms) {
            Some(found) => (self.taken(found), Step::Climb(Stage::of(stage.number))),
            None => {
                stage.failures += 1;
                (base, Step::Climb(stage))
            }
        }
    }

    /// Smaller trees that cost little, for the front.
    pub(super) fn refine(&mut self, base: Node, stage: Stage) -> (Node, Step) {
        match self.settings.choice {
            Choice::Knee => (base, Step::Done),
            Choice::Nodes(_) | Choice::Loss(_) => self.refined(base, stage, self.settings.effort),
        }
    }

    /// Looks for smaller trees than one that was chosen, with so many ticks more.
    pub fn shrink(&mut self, root: &Node, ticks: u64) {
        let until = self.judge.seen.ticks.saturating_add(ticks);
        let (mut base, mut step) = (root.clone(), Step::Refine(Stage::default()));
        while let Step::Refine(stage) = step {
            (base, step) = self.refined(base, stage, until);
        }
    }

    fn refined(&mut self, base: Node, mut stage: Stage, until: u64) -> (Node, Step) {
        let Some(factor) = DEARER.get(stage.number) else {
            // However few nodes are asked for, there is a tree.
            if let Some(single) = self.best_single() {
                self.visit(&single);
            }
            return (base, Step::Done);
        };
        if self.judge.seen.ticks < until {
            let price = self.full_price * factor;
            let terms = Terms::taking(price);
            self.charge(terms);
            let trees = self.proposals(&base, price, true, &mut stage.tried);
            if let Some(found) = self.judge.race(&base, trees, terms) {
                return (self.taken(found), Step::Refine(stage));
            }
        }
        (base, Step::Refine(Stage::of(stage.number + 1)))
    }

    /// The behaviour that does best by itself.
    fn best_single(&mut self) -> Option<Node> {
        let single = self.single.clone()?;
        let choices = self.ground.choices.iter().map(|id| Node::Behavior(*id));
        let others = choices.filter(|other| *other != single).collect();
        // How long it goes well tells nothing of the episodes of a tree.
        let length = self.judge.seen.length;
        let found = self.judge.race(&single, others, Terms::taking(0.0));
        self.judge.seen.length = length;
        Some(found.map_or(single, |found| found.root))
    }

    /// Trees one change away: those of which the counts promise most, and others.
    pub(super) fn proposals(
        &mut self,
        base: &Node,
        price: f64,
        only: bool,
        tried: &mut FxHashSet<String>,
    ) -> Vec<Node> {
        let mut visits = self.collect(base, 0.05);
        add(&mut visits, self.collect(base, 0.3));
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let sight = if self.random.chance(0.5) {
            Sight::Far
        } else {
            Sight::Learner
        };
        let aim = match self.random.chance(0.5) {
            true => Aim::Of(base),
            false => Aim::Best,
        };
        let field = Field::new(self.ground, &self.evidence, sight, &visits, aim);
        let proposer = Proposer {
            field: &field,
            bodies: &bodies,
            requirements: self.settings.requirements,
            price,
        };
        let Some(now) = field.drives(base) else {
            return Vec::new();
        };
        let mut found = proposer.prunings(base, &now);
        let (mut memories, mut falls) = (Vec::new(), Vec::new());
        if !only {
            found.extend(proposer.insertions(base, &now));
            found.extend(proposer.changes(base, &now));
            found.extend(proposer.moves(base, &now));
            memories = proposer.memories(base);
            let openers = bodies::openers(&self.evidence, self.ground.choices.len());
            falls = proposer.falls(base, &openers);
        }
        let (best, random) = if only { (30, 18) } else { (BEST, RANDOM) };
        let mut trees: Vec<Node> = Vec::new();
        let most = ALIKE.get(usize::from(only)).copied().unwrap_or(1);
        // What does the same as the base is worth a race if it is smaller.
        let (own, nodes) = (number(&now), Size::of(base).nodes);
        let mut alike: FxHashMap<u64, usize> = FxHashMap::default();
        let mut take = |proposal: Proposal, unseen: bool| {
            let same = alike.entry(proposal.does).or_default();
            let other = unseen || *same < most && (proposal.does != own || proposal.nodes < nodes);
            let fresh =
                other && proposal.root != *base && tried.insert(format!("{:?}", proposal.root));
            if fresh {
                *same += 1;
                trees.push(proposal.root);
            }
            fresh
        };
        found.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.nodes.cmp(&b.nodes)));
        let mut rest = Vec::new();
        let mut left = best;
        for proposal in found {
            if left > 0 {
                left -= usize::from(take(proposal, false));
            } else {
                rest.push(proposal);
            }
        }
        let others = [
            (rest, random, false),
            (memories, MEMORIES, true),
            (falls, FALLS, true),
        ];
        for (mut from, count, unseen) in others {
            let mut left = count;
            while left > 0 && !from.is_empty() {
                let at = self.random.below(from.len() as u64) as usize;
                left -= usize::from(take(from.swap_remove(at), unseen));
            }
        }
        trees
    }
}
