//! Trees that grow by the counts alone.

use super::{Grower, add};
use crate::grow::Starts;
use crate::grow::bodies;
use crate::grow::chart::{Chart, Followed};
use crate::grow::evidence::{Sight, Visits};
use crate::grow::field::{Aim, Field};
use crate::grow::propose::Proposer;
use crate::grow::step::{Stage, Step};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::Size;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// The most nodes of a tree that others are grown from in place of a single behaviour.
const STEM: usize = 70;
/// The most changes of a tree that the counts alone are asked for.
const STEPS: usize = 40;
/// The part of an attempt after which no more is grown from the start.
const SPROUTS: f64 = 0.7;
/// Rounds of growing from the start.
const ROUNDS: usize = 4;
/// The decisions by which counts are doubted, in turn.
const DOUBTS: [f64; 3] = [2.0, 6.0, 15.0];
/// How often a tree is grown anew, counted under what came of it before; by turns as a whole and by its decisions.
const PASSES: usize = 8;
/// What is left of the weight of visits after each of them.
const KEPT: f64 = 0.6;
/// The bodies that those begin with that are followed as a whole, in turn.
const STEMS: usize = 3;
/// Changes that are looked at closely: those of which single decisions promise most.
const CLOSELY: usize = 40;
/// The prices at which trees are grown from the best one, in parts of a node's.
const PRICES: [f64; 3] = [1.0, 3.0, 1.0 / 3.0];

impl<'w, W: World> Grower<'_, 'w, '_, W> {
    /// Trees grown in the counted process, from a single behaviour and from the best tree, raced; several times.
    pub(super) fn sprout(&mut self, base: Node, round: usize, starts: &Starts) -> (Node, Step) {
        if round >= ROUNDS || self.has_spent(SPROUTS) {
            return (base, Step::Climb(Stage::default()));
        }
        self.report(&base);
        let mut visits = self.collect(&base, 0.1);
        let wider = self.collect(&base, 0.3);
        self.collect(&base, 0.8);
        if round == 0 {
            // Where the other trees go.
            let others = self.attempts.theirs.clone();
            for other in others.iter().chain([&starts.exact]) {
                if *other != base {
                    add(&mut visits, self.collect(other, 0.1));
                }
            }
        }
        add(&mut visits, wider);
        let mut trees = self.anew(round, &base, &mut visits);
        if Size::of(&base).nodes <= STEM {
            let bodies = bodies::bodies(self.ground, &self.evidence);
            let chart = self.chart(round);
            let field = self.field(round, &base, &visits);
            for factor in PRICES {
                let price = self.price * factor;
                let whole = |root: &Node| self.worthier(&chart, &bodies, price, root);
                let single = |root: &Node| self.promising(&field, &bodies, price, root);
                trees.extend(sprouts(base.clone(), whole));
                trees.extend(sprouts(base.clone(), single));
            }
        }
        let mut seen = FxHashSet::default();
        trees.retain(|tree| *tree != base && seen.insert(format!("{tree:?}")));
        let found = self.best_of(base.clone(), trees, 1);
        // Where two rounds have found nothing, change by change finds more.
        let next = match round > 0 && found == base {
            true => Step::Climb(Stage::default()),
            false => Step::Sprout(round + 1),
        };
        (found, next)
    }

    /// Trees grown from a single body. What looks good and is not shows when it is played, so each pass knows more.
    fn anew(&mut self, round: usize, base: &Node, visits: &mut Visits) -> Vec<Node> {
        let mut trees = Vec::new();
        for pass in 0..PASSES {
            let found = match pass % 2 {
                0 => self.as_wholes(round + pass / 2),
                _ => self.by_decisions(round, base, visits),
            };
            if let Some(last) = found.last() {
                visits.values_mut().for_each(|weight| *weight *= KEPT);
                let met = self.collect(last, 0.1);
                add(visits, met);
            }
            trees.extend(found);
        }
        trees
    }

    fn as_wholes(&self, turn: usize) -> Vec<Node> {
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let chart = self.chart(turn);
        let stem = stem(&chart, &bodies, turn % STEMS);
        let next = |root: &Node| self.worthier(&chart, &bodies, self.price, root);
        stem.map_or_else(Vec::new, |stem| sprouts(stem, next))
    }

    fn by_decisions(&self, round: usize, base: &Node, visits: &Visits) -> Vec<Node> {
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let field = self.field(round, base, visits);
        let next = |root: &Node| self.promising(&field, &bodies, self.price, root);
        single(&field, &bodies).map_or_else(Vec::new, |stem| sprouts(stem, next))
    }

    /// What decisions are worth, near-sighted and far-sighted, under the best ones and under the base, in turn.
    fn field(&self, round: usize, base: &Node, visits: &Visits) -> Field<'w> {
        let (sight, aim) = match round {
            0 => (Sight::Far, Aim::Of(base)),
            1 => (Sight::Learner, Aim::Best),
            2 => (Sight::Far, Aim::Best),
            _ => (Sight::Learner, Aim::Of(base)),
        };
        Field::new(self.ground, &self.evidence, sight, visits, aim)
    }

    fn chart(&self, turn: usize) -> Chart<'w> {
        let doubt = DOUBTS.iter().cycle().nth(turn % DOUBTS.len());
        let doubt = doubt.copied().unwrap_or_default();
        Chart::new(self.ground, &self.evidence, doubt, self.judge.seen.length)
    }

    /// The tree one change away of whose decisions the counts promise most, if it is more than those of this one.
    fn promising(
        &self,
        field: &Field<'w>,
        bodies: &[Node],
        price: f64,
        root: &Node,
    ) -> Option<Node> {
        let proposer = self.proposer(field, bodies, price);
        let now = field.drives(root)?;
        let mut found = proposer.insertions(root, &now);
        found.extend(proposer.prunings(root, &now));
        let best = found.into_iter().reduce(|best, next| {
            let better =
                next.score > best.score || next.score == best.score && next.nodes < best.nodes;
            if better { next } else { best }
        });
        best.filter(|best| best.score > 0.0).map(|best| best.root)
    }

    /// The tree one change away that is worth most as a whole, if it is worth more than this one.
    fn worthier(
        &self,
        chart: &Chart<'w>,
        bodies: &[Node],
        price: f64,
        root: &Node,
    ) -> Option<Node> {
        let followed = chart.follow(root)?;
        let field = chart.field(self.ground, &self.evidence, &followed);
        let proposer = self.proposer(&field, bodies, price);
        let now = field.drives(root)?;
        let mut found = proposer.insertions(root, &now);
        found.extend(proposer.prunings(root, &now));
        found.extend(proposer.changes(root, &now));
        found.extend(proposer.moves(root, &now));
        found.retain(|proposal| proposal.root != *root);
        found.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.nodes.cmp(&b.nodes)));
        found.truncate(CLOSELY);
        let nodes = Size::of(root).nodes as f64;
        let gains: Vec<Option<(f64, Node)>> = found
            .into_par_iter()
            .map(|proposal| {
                let gain = chart.follow_near(&proposal.root, &followed)?.value - followed.value;
                let gain = gain - price * (proposal.nodes as f64 - nodes);
                (gain > 0.0).then_some((gain, proposal.root))
            })
            .collect();
        let gains = gains.into_iter().flatten();
        let best = gains.reduce(|best, next| if next.0 > best.0 { next } else { best });
        best.map(|(_, root)| root)
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

/// The trees on the way from one tree to the next, and on.
fn sprouts(stem: Node, next: impl Fn(&Node) -> Option<Node>) -> Vec<Node> {
    let mut trees = vec![stem];
    while trees.len() <= STEPS {
        let next = trees.last().and_then(&next);
        let Some(next) = next.filter(|next| !trees.contains(next)) else {
            break;
        };
        trees.push(next);
    }
    trees
}

/// The body whose decisions are worth most by themselves.
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

/// The body in this place, the one that is worth most by itself first.
fn stem(chart: &Chart, bodies: &[Node], place: usize) -> Option<Node> {
    let worths = bodies
        .iter()
        .map(|body| chart.follow(body).filter(Followed::acts));
    let mut worths: Vec<(f64, &Node)> = worths
        .zip(bodies)
        .filter_map(|(followed, body)| Some((followed?.value, body)))
        .collect();
    worths.sort_by(|a, b| b.0.total_cmp(&a.0));
    worths.get(place).map(|(_, body)| (*body).clone())
}
