//! The trees that none beats in both nodes and return, and the one of them that is taken.

use super::grower::Found;
use super::race::{Entrant, RANSOM};
use super::{Settings, Starts};
use crate::ir::tree::{Atom, Node};
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::{Mean, Summary};
use crate::tree::Size;
use crate::trial::paired::error;
use serde::{Deserialize, Serialize};

/// Episodes by which a tree of the front is chosen.
const CONFIRMING: usize = 200;
/// The most trees that are looked at for the front.
const LOOKED_AT: usize = 16;
/// Fresh episodes that measure the tree that was chosen.
const FRESH: usize = 500;
/// The effort that these numbers are for; for less of it they are less.
const WHOLE: f64 = 36e6;
/// The fewest episodes, whatever the effort.
const FEWEST: usize = 40;
/// A tree that is proved gives way to one that is only tested for a gain of so many prices of a node.
const PROVED: f64 = 3.4;

/// Which tree of the front is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// The one from where on a node more brings less than its price.
    Knee,
    /// The best of at most so many nodes.
    Nodes(usize),
    /// The smallest that loses at most this part of the return of the best.
    Loss(f64),
}

/// The figures of a tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Its size.
    pub size: Size,
    /// The figures of its episodes.
    pub summary: Summary,
    /// Harms in these: ends that cost, events that are claimed never to happen.
    pub harms: u64,
}

/// A tree of the front.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The tree.
    pub root: Node,
    /// Its size.
    pub size: Size,
    /// Its return.
    pub returns: Mean,
    /// Harms.
    pub harms: u64,
    /// Of so many episodes.
    pub episodes: u64,
    /// Whether it is the one that was taken.
    pub taken: bool,
}

/// A grown tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grown {
    /// The tree; the exact one if none was better.
    pub root: Node,
    /// The exact tree on fresh seeds.
    pub before: Figures,
    /// This tree on the same seeds.
    pub after: Figures,
    /// Its mean gain of return an episode over the exact tree on these seeds, paired.
    pub gain: Mean,
    /// Whether this is the exact tree.
    pub kept: bool,
    /// The front, the smallest tree first.
    pub front: Vec<Point>,
    /// Ticks that the search simulated.
    pub ticks: u64,
}

impl Grown {
    /// Whether the exact tree was kept.
    pub fn is_exact(&self) -> bool {
        self.kept
    }
}

/// Chooses a tree among those that were the best of their time.
///
/// # Errors
/// The exact tree asks an atom that the world does not know.
pub(super) fn choose<W: World>(
    found: Found<'_, '_, W>,
    starts: &Starts,
    settings: &Settings,
) -> Result<Grown, Atom> {
    let Found {
        mut judge,
        mut visited,
        price,
    } = found;
    // The later ones are the better ones; of the same size the last.
    visited.reverse();
    let mut trees: Vec<Node> = Vec::new();
    let mut sizes: Vec<usize> = Vec::new();
    for tree in visited {
        if !sizes.contains(&tree.nodes) && trees.len() < LOOKED_AT {
            sizes.push(tree.nodes);
            trees.push(tree.root);
        }
    }
    let race = judge.fresh();
    let trials = judge.ground.trials(Purpose::Confirm, race);
    let mut exact = vec![Entrant {
        root: starts.exact.clone(),
        nodes: Size::of(&starts.exact).nodes,
        contender: trials.contender(&starts.exact)?,
    }];
    let part = (settings.effort as f64 / WHOLE).min(1.0);
    let of = |episodes: usize| ((episodes as f64 * part) as usize).max(FEWEST);
    let episodes = judge.scaled(of(CONFIRMING));
    judge.play(&trials, &mut exact, episodes, None);
    let ready = trees.iter().filter_map(|root| judge.entrant(&trials, root));
    let mut entrants: Vec<Entrant> = ready.collect();
    judge.play(&trials, &mut entrants, episodes, exact.first());
    entrants.retain(|entrant| exact.iter().all(|exact| exact.root != entrant.root));
    entrants.extend(exact);
    let harms = |entrant: &Entrant| judge.harms(entrant);
    let last = entrants.len().saturating_sub(1);
    let chosen = chosen(&entrants, last, &harms, settings.choice, price);
    let front = points(&entrants, chosen, &harms);
    let root = entrants
        .get(chosen)
        .map_or_else(|| starts.exact.clone(), |entrant| entrant.root.clone());
    drop(entrants);
    let race = judge.fresh();
    let trials = judge.ground.trials(Purpose::Measure, race);
    let fresh = judge.scaled(of(FRESH));
    let mut before = trials.contender(&starts.exact)?;
    let mut after = trials.contender(&root)?;
    let mut ticks = trials.play(&mut [&mut before], fresh, None);
    ticks += trials.play(&mut [&mut after], fresh, Some(&before));
    let figures = |contender: &crate::trial::paired::Contender, root: &Node| Figures {
        size: Size::of(root),
        harms: contender
            .each(|episode| judge.ground.harm(episode))
            .into_iter()
            .sum(),
        summary: Summary::of(&contender.results(), judge.ground.ends),
    };
    let loss = after.loss(&before);
    let [low, high] = loss.ci95;
    Ok(Grown {
        before: figures(&before, &starts.exact),
        after: figures(&after, &root),
        gain: Mean {
            mean: -loss.mean,
            ci95: [-high, -low],
        },
        kept: root == starts.exact,
        root,
        front,
        ticks: judge.seen.ticks + ticks,
    })
}

/// The place of the tree that is taken; the exact one stands last.
fn chosen(
    entrants: &[Entrant],
    exact: usize,
    harms: &impl Fn(&Entrant) -> u64,
    choice: Choice,
    price: f64,
) -> usize {
    let Some(base) = entrants.get(exact) else {
        return exact;
    };
    let mean = |entrant: &Entrant| entrant.contender.returns().mean;
    let safe: Vec<(usize, &Entrant)> = entrants
        .iter()
        .enumerate()
        .filter(|(_, entrant)| harms(entrant) <= harms(base))
        .collect();
    let by = |worth: &dyn Fn(&Entrant) -> f64, from: Vec<(usize, &Entrant)>| {
        let best = from.into_iter().reduce(|best, next| {
            if worth(next.1) > worth(best.1) {
                next
            } else {
                best
            }
        });
        best.map_or(exact, |(at, _)| at)
    };
    match choice {
        Choice::Knee => {
            let good = |(at, entrant): &(usize, &Entrant)| {
                let loss = entrant.contender.loss(&base.contender);
                let ransom = RANSOM * mean(base).abs();
                *at == exact
                    || harms(entrant) < harms(base) && loss.mean <= ransom
                    || loss.mean <= error(&loss)
            };
            let least = safe
                .iter()
                .map(|(_, entrant)| harms(entrant))
                .min()
                .unwrap_or(0);
            // Less harm stands before more return, where the difference is more than chance.
            let few = |entrant: &Entrant| {
                let more = harms(entrant) - least;
                (more as f64) <= ((harms(entrant) + least) as f64).sqrt()
            };
            let worth = |entrant: &Entrant| mean(entrant) - price * entrant.nodes as f64;
            let from = safe.into_iter().filter(|c| good(c) && few(c.1)).collect();
            let best = by(&worth, from);
            let gives_way = entrants.get(best).is_some_and(|entrant| {
                let safer = harms(entrant) < harms(base) && !few(base);
                safer || worth(entrant) - worth(base) > PROVED * price
            });
            if gives_way { best } else { exact }
        }
        Choice::Nodes(most) => {
            let from = entrants.iter().enumerate();
            by(&mean, from.filter(|(_, e)| e.nodes <= most).collect())
        }
        Choice::Loss(part) => {
            let best = safe
                .iter()
                .map(|(_, e)| mean(e))
                .fold(f64::NEG_INFINITY, f64::max);
            let least = best - part * best.abs();
            let from = safe.into_iter().filter(|(_, e)| mean(e) >= least).collect();
            by(&|entrant| -(entrant.nodes as f64), from)
        }
    }
}

/// The trees that none beats in both nodes and return, and the one that was taken.
fn points(entrants: &[Entrant], chosen: usize, harms: &impl Fn(&Entrant) -> u64) -> Vec<Point> {
    let mut points: Vec<Point> = entrants
        .iter()
        .enumerate()
        .map(|(at, entrant)| Point {
            size: Size::of(&entrant.root),
            returns: entrant.contender.returns(),
            harms: harms(entrant),
            episodes: entrant.contender.episodes() as u64,
            taken: at == chosen,
            root: entrant.root.clone(),
        })
        .collect();
    points.sort_by(|a, b| {
        let nodes = a.size.nodes.cmp(&b.size.nodes);
        let better = b.returns.mean.total_cmp(&a.returns.mean);
        nodes.then(better).then(b.taken.cmp(&a.taken))
    });
    let mut best = f64::NEG_INFINITY;
    points.retain(|point| {
        let stands = point.returns.mean > best;
        best = best.max(point.returns.mean);
        stands || point.taken
    });
    points
}
