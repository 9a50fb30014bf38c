//! Trees that grow by the counts alone.

use super::{Grower, add};
use crate::grow::Starts;
use crate::grow::bodies;
use crate::grow::evidence::{Sight, Visits};
use crate::grow::field::{Aim, Field};
use crate::grow::propose::Proposer;
use crate::grow::step::{Stage, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;
use rustc_hash::FxHashSet;

/// The most nodes of a tree that others are grown from in place of a single behaviour.
const STEM: usize = 70;
/// The most changes of a tree that the counts alone are asked for.
const STEPS: usize = 40;
/// The part of the effort after which no more is grown from the start.
const SPROUTS: f64 = 0.5;
/// Rounds of growing from the start.
const ROUNDS: usize = 4;
/// How often a tree is grown anew, counted under what came of it before.
const PASSES: usize = 4;
/// What is left of the weight of visits after each of them.
const KEPT: f64 = 0.6;
/// The prices at which trees are grown from the best one, in parts of a node's.
const PRICES: [f64; 3] = [1.0, 3.0, 1.0 / 3.0];

impl<W: World> Grower<'_, '_, '_, W> {
    /// Trees grown by the counts alone, from a single behaviour and from the best tree, raced; several times.
    pub(super) fn sprout(&mut self, base: Node, round: usize, starts: &Starts) -> (Node, Step) {
        if round >= ROUNDS || self.spent(SPROUTS) {
            return (base, Step::Climb(Stage::default()));
        }
        self.report(&base);
        let mut visits = self.collect(&base, 0.1);
        let wider = self.collect(&base, 0.3);
        self.collect(&base, 0.8);
        if round == 0 {
            // Where the other trees go.
            for other in starts.others.iter().chain([&starts.exact]) {
                if *other != base {
                    add(&mut visits, self.collect(other, 0.1));
                }
            }
        }
        add(&mut visits, wider);
        let (sight, aim) = match round {
            0 => (Sight::Far, Aim::Of(&base)),
            1 => (Sight::Learner, Aim::Best),
            2 => (Sight::Far, Aim::Best),
            _ => (Sight::Learner, Aim::Of(&base)),
        };
        let mut trees = self.anew(sight, aim, &mut visits);
        let field = Field::new(self.ground, &self.evidence, sight, &visits, aim);
        let bodies = bodies::bodies(self.ground, &self.evidence);
        for factor in PRICES {
            if Size::of(&base).nodes <= STEM {
                let price = self.price * factor;
                trees.extend(sprouts(
                    &self.proposer(&field, &bodies, price),
                    base.clone(),
                ));
            }
        }
        let mut seen = FxHashSet::default();
        trees.retain(|tree| *tree != base && seen.insert(format!("{tree:?}")));
        let found = self.best_of(base.clone(), trees, 1);
        // Where both sights have found nothing, change by change finds more.
        let next = match round > 0 && found == base {
            true => Step::Climb(Stage::default()),
            false => Step::Sprout(round + 1),
        };
        (found, next)
    }

    /// Trees grown from a single behaviour. What looks good and is not shows when it is played, so each pass knows more.
    fn anew(&mut self, sight: Sight, aim: Aim, visits: &mut Visits) -> Vec<Node> {
        let mut trees = Vec::new();
        for _ in 0..PASSES {
            let bodies = bodies::bodies(self.ground, &self.evidence);
            let field = Field::new(self.ground, &self.evidence, sight, visits, aim);
            let Some(stem) = single(&field, &bodies) else {
                break;
            };
            let found = sprouts(&self.proposer(&field, &bodies, self.price), stem);
            if let Some(last) = found.last() {
                visits.values_mut().for_each(|weight| *weight *= KEPT);
                let met = self.collect(last, 0.1);
                add(visits, met);
            }
            trees.extend(found);
        }
        trees
    }

    fn proposer<'p, 'f>(
        &'p self,
        field: &'p Field<'f>,
        bodies: &'p [Node],
        price: f64,
    ) -> Proposer<'p, 'f> {
        Proposer {
            field,
            bodies,
            requirements: self.settings.requirements,
            price,
        }
    }
}

/// The body that is worth most by itself.
fn single(field: &Field, bodies: &[Node]) -> Option<Node> {
    let worth = |body: &&Node| {
        let drives = field.drives(body).unwrap_or_default();
        let spots = field.spots.iter().zip(&drives);
        spots
            .map(|(spot, drive)| spot.weight * spot.worth(*drive))
            .sum::<f64>()
    };
    let best = bodies.iter().map(|body| (worth(&body), body));
    let best = best.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, body)| body.clone())
}

/// The trees on the way from one tree by the change that the counts promise most of.
fn sprouts(proposer: &Proposer, stem: Node) -> Vec<Node> {
    let mut trees = vec![stem.clone()];
    let mut root = stem;
    for _ in 0..STEPS {
        let Some(now) = proposer.field.drives(&root) else {
            break;
        };
        let mut found = proposer.insertions(&root, &now);
        found.extend(proposer.prunings(&root, &now));
        let best = found.into_iter().reduce(|best, next| {
            let better =
                next.score > best.score || next.score == best.score && next.nodes < best.nodes;
            if better { next } else { best }
        });
        let Some(best) = best.filter(|best| best.score > 0.0 && !trees.contains(&best.root)) else {
            break;
        };
        root = best.root.clone();
        trees.push(best.root);
    }
    trees
}
