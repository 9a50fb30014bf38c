//! Trees that grow by the counts alone.

use super::{Grower, add};
use crate::grow::Starts;
use crate::grow::bodies;
use crate::grow::evidence::Sight;
use crate::grow::field::{Aim, Field};
use crate::grow::propose::Proposer;
use crate::grow::step::{Stage, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;

/// The most nodes of a tree that others are grown from in place of a single behaviour.
const STEM: usize = 70;
/// The most changes of a tree that the counts alone are asked for.
const STEPS: usize = 40;
/// The part of the effort after which no more is grown from the start.
const SPROUTS: f64 = 0.4;
/// Rounds of growing from the start.
const ROUNDS: usize = 2;

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
        let sight = if round.is_multiple_of(2) {
            Sight::Far
        } else {
            Sight::Learner
        };
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let aim = match round.is_multiple_of(2) {
            true => Aim::Of(&base),
            false => Aim::Best,
        };
        let field = Field::new(self.ground, &self.evidence, sight, &visits, aim);
        let mut trees: Vec<Node> = Vec::new();
        for factor in [1.0, 3.0, 1.0 / 3.0] {
            let proposer = Proposer {
                field: &field,
                bodies: &bodies,
                requirements: self.settings.requirements,
                price: self.price * factor,
            };
            let mut stems: Vec<Node> = single(&field, &bodies).into_iter().collect();
            if Size::of(&base).nodes <= STEM {
                stems.push(base.clone());
            }
            for stem in stems {
                for tree in sprouts(&proposer, stem) {
                    if !trees.contains(&tree) && tree != base {
                        trees.push(tree);
                    }
                }
            }
        }
        (self.best_of(base, trees, 1), Step::Sprout(round + 1))
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
