//! Trees that grow in the counted process alone.

use super::Grower;
use crate::grow::Starts;
use crate::grow::bodies;
use crate::grow::chart::Chart;
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
/// The part of the effort after which no more is grown from the start.
const SPROUTS: f64 = 0.5;
/// Rounds of growing from the start.
const ROUNDS: usize = 4;
/// The decisions by which counts are doubted, in turn.
const DOUBTS: [f64; 3] = [2.0, 6.0, 15.0];
/// How often a tree is grown anew, counted under what came of it before.
const PASSES: usize = 6;
/// The bodies that these begin with, in turn.
const STEMS: usize = 3;
/// Changes that are looked at closely: those of which single decisions promise most.
const CLOSELY: usize = 40;
/// The prices at which trees are grown from the best one, in parts of a node's.
const PRICES: [f64; 3] = [1.0, 3.0, 1.0 / 3.0];

impl<'w, W: World> Grower<'_, 'w, '_, W> {
    /// Trees grown in the counted process, from a single behaviour and from the best tree, raced; several times.
    pub(super) fn sprout(&mut self, base: Node, round: usize, starts: &Starts) -> (Node, Step) {
        if round >= ROUNDS || self.spent(SPROUTS) {
            return (base, Step::Climb(Stage::default()));
        }
        self.report(&base);
        for explore in [0.1, 0.3, 0.8] {
            self.collect(&base, explore);
        }
        if round == 0 {
            // Where the other trees go.
            for other in starts.others.iter().chain([&starts.exact]) {
                if *other != base {
                    self.collect(other, 0.1);
                }
            }
        }
        let mut trees = self.anew(round);
        if Size::of(&base).nodes <= STEM {
            let bodies = bodies::bodies(self.ground, &self.evidence);
            let chart = self.chart(round);
            for factor in PRICES {
                trees.extend(self.sprouts(&chart, &bodies, self.price * factor, base.clone()));
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
    fn anew(&mut self, round: usize) -> Vec<Node> {
        let mut trees = Vec::new();
        for pass in 0..PASSES {
            let bodies = bodies::bodies(self.ground, &self.evidence);
            let chart = self.chart(round + pass);
            let Some(stem) = stem(&chart, &bodies, pass % STEMS) else {
                break;
            };
            let found = self.sprouts(&chart, &bodies, self.price, stem);
            if let Some(last) = found.last() {
                self.collect(last, 0.1);
            }
            trees.extend(found);
        }
        trees
    }

    fn chart(&self, turn: usize) -> Chart<'w> {
        let doubt = DOUBTS.iter().cycle().nth(turn % DOUBTS.len());
        let doubt = doubt.copied().unwrap_or_default();
        Chart::new(self.ground, &self.evidence, doubt, self.judge.seen.length)
    }

    /// The trees on the way from one tree, each by the change after which the tree is worth most.
    fn sprouts(&self, chart: &Chart<'w>, bodies: &[Node], price: f64, stem: Node) -> Vec<Node> {
        let mut trees = vec![stem];
        while trees.len() <= STEPS {
            let root = trees.last();
            let next = root.and_then(|root| self.sprouted(chart, bodies, price, root));
            let Some(next) = next.filter(|next| !trees.contains(next)) else {
                break;
            };
            trees.push(next);
        }
        trees
    }

    /// The tree one change away that is worth most, if it is worth more than this one.
    fn sprouted(
        &self,
        chart: &Chart<'w>,
        bodies: &[Node],
        price: f64,
        root: &Node,
    ) -> Option<Node> {
        let followed = chart.follow(root)?;
        let field = chart.field(self.ground, &self.evidence, &followed);
        let proposer = Proposer {
            field: &field,
            bodies,
            requirements: self.settings.requirements,
            price,
        };
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
}

/// The body in this place, the one that is worth most by itself first.
fn stem(chart: &Chart, bodies: &[Node], place: usize) -> Option<Node> {
    let worths = bodies.iter().map(|body| chart.follow(body));
    let mut worths: Vec<(f64, &Node)> = worths
        .zip(bodies)
        .filter_map(|(followed, body)| Some((followed?.value, body)))
        .collect();
    worths.sort_by(|a, b| b.0.total_cmp(&a.0));
    worths.get(place).map(|(_, body)| (*body).clone())
}
