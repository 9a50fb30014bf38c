//! Rows of changes that begin with a worse tree: iterated local search (Lourenço, Martin and Stützle 2003).
//!
//! Climbing takes what is better at once. It never gets to a behaviour that pays only together with another change: a far
//! place that is dangerous until the way back is guarded. So a behaviour that the best tree does not use is put into it by
//! force, the tree is changed further while it keeps that behaviour, and what comes of it races with the best tree.

use super::{Grower, add};
use crate::grow::bodies;
use crate::grow::evidence::{Sight, Visits};
use crate::grow::field::{Aim, Field};
use crate::grow::place::Place;
use crate::grow::propose::{Proposal, Proposer};
use crate::grow::race::Terms;
use crate::grow::step::{Detour, Stage, Step};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Guard, Node};
use crate::learn::process::World;
use crate::tree::guard::not;
use crate::tree::unit::guarded;

/// The part of the effort after which no detour begins, and the part that one takes.
const DETOURS: f64 = 0.6;
const LENGTH: f64 = 0.1;
/// Races without a better tree before a detour ends.
const FAILURES: usize = 2;
/// The trees that a detour may begin with: those of which the counts promise most, and others at random.
const BEST: usize = 24;
const RANDOM: usize = 12;

impl<W: World> Grower<'_, '_, '_, W> {
    /// One race of a detour; the next one begins where one has ended.
    pub(super) fn detour(&mut self, base: Node, mut detour: Detour) -> (Node, Step) {
        let Some(tree) = detour.tree.take() else {
            return self.departure(base, detour.tried);
        };
        self.report(&tree);
        let mut terms = Terms::searching(self.price);
        let spent = (self.judge.seen.ticks - detour.begun) as f64;
        let over = spent > LENGTH * self.settings.effort as f64;
        let mut trees = Vec::new();
        if !over && detour.stage.failures < FAILURES {
            trees = self.proposals(&tree, self.price, false, &mut detour.stage.tried);
            trees.retain(|new| *new != base);
        }
        if trees.is_empty() {
            let found = self.judge.race(&base, vec![tree], terms);
            let base = found.map_or(base, |found| self.taken(found));
            let next = Detour {
                tried: detour.tried,
                ..Detour::default()
            };
            return (base, Step::Detour(next));
        }
        terms.kept = detour.kept;
        match self.judge.race(&tree, trees, terms) {
            Some(found) => {
                detour.tree = Some(self.pruned(&found.root, &found));
                detour.stage.failures = 0;
            }
            None => {
                detour.tree = Some(tree);
                detour.stage.failures += 1;
            }
        }
        (base, Step::Detour(detour))
    }

    /// Begins a detour: with the best tree that a behaviour makes of the base when it is put in by force.
    fn departure(&mut self, base: Node, mut tried: Vec<usize>) -> (Node, Step) {
        let next = (!self.spent(DETOURS)).then(|| self.next(&base, &tried));
        let Some((choice, kept, trees)) = next.flatten() else {
            return (base, Step::Climb(Stage::default()));
        };
        let begun = self.judge.seen.ticks;
        let mut terms = Terms::searching(self.price);
        terms.kept = Some(kept);
        let best = self.judge.best(&trees, terms);
        tried.push(choice);
        let detour = Detour {
            tried,
            tree: best.map(|best| self.pruned(&best.root, &best)),
            kept: Some(kept).filter(|kept| !uses(&base, *kept)),
            begun,
            stage: Stage::default(),
        };
        (base, Step::Detour(detour))
    }

    /// The next behaviour to put in, with its number, and the trees that it makes: one that the base does not use, if there
    /// is any left.
    fn next(&mut self, base: &Node, tried: &[usize]) -> Option<(usize, Id<Behavior>, Vec<Node>)> {
        let mut visits = self.collect(base, 0.05);
        add(&mut visits, self.collect(base, 0.3));
        let choices = self.ground.choices.iter().copied().enumerate();
        let left = choices.filter(|(choice, _)| !tried.contains(choice));
        let mut found: Vec<(usize, Id<Behavior>, Vec<Proposal>)> = left
            .map(|(choice, id)| (choice, id, self.put_in(base, id, &visits)))
            .collect();
        let promise = |trees: &[Proposal]| trees.first().map_or(f64::NEG_INFINITY, |it| it.score);
        found.sort_by(|a, b| {
            let used = uses(base, a.1).cmp(&uses(base, b.1));
            used.then(promise(&b.2).total_cmp(&promise(&a.2)))
        });
        let (choice, behavior, trees) = found.into_iter().next()?;
        let mut trees: Vec<Node> = trees.into_iter().map(|it| it.root).collect();
        trees.extend(self.at_random(base, behavior));
        trees.retain(|tree| tree != base);
        Some((choice, behavior, trees))
    }

    /// The base with a behaviour, or a body that has it, in any place, the best by the counts first.
    fn put_in(&self, base: &Node, behavior: Id<Behavior>, visits: &Visits) -> Vec<Proposal> {
        let bodies = self.bodies_with(behavior);
        let mut found: Vec<Proposal> = Vec::new();
        for aim in [Aim::Of(base), Aim::Best] {
            let field = Field::new(self.ground, &self.evidence, Sight::Far, visits, aim);
            let Some(now) = field.drives(base) else {
                continue;
            };
            let proposer = Proposer {
                field: &field,
                bodies: &bodies,
                requirements: self.settings.requirements,
                price: self.price,
            };
            found.extend(proposer.insertions(base, &now));
        }
        found.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.nodes.cmp(&b.nodes)));
        let mut roots: Vec<Node> = Vec::new();
        found.retain(|proposal| {
            let fresh = roots.len() < BEST && !roots.contains(&proposal.root);
            if fresh {
                roots.push(proposal.root.clone());
            }
            fresh
        });
        found
    }

    /// The base with such a body in random places, under random literals: the counts may be wrong.
    fn at_random(&mut self, base: &Node, behavior: Id<Behavior>) -> Vec<Node> {
        let bodies = self.bodies_with(behavior);
        let places = Place::all(base);
        let mut any = |count: usize| self.random.below(count.max(1) as u64) as usize;
        let atoms = self.ground.atoms();
        let trees = (0..RANDOM).filter_map(|_| {
            let place = places.get(any(places.len()))?;
            let body = bodies.get(any(bodies.len()))?;
            let atom = Guard::Atom(*atoms.get(any(atoms.len()))?);
            let guard = if any(2) == 0 { atom } else { not(atom) };
            Some(place.put(base, &guarded(guard, body.clone())))
        });
        trees.collect()
    }

    fn bodies_with(&self, behavior: Id<Behavior>) -> Vec<Node> {
        let mut bodies = bodies::bodies(self.ground, &self.evidence);
        bodies.retain(|body| uses(body, behavior));
        bodies
    }
}

fn uses(tree: &Node, behavior: Id<Behavior>) -> bool {
    let mut uses = false;
    tree.visit_behaviors(&mut |other| uses |= other == behavior);
    uses
}
