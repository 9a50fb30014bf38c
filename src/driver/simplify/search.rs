//! The search for smaller trees.
//!
//! What plays every known path alike costs nothing and is taken first. The rest race: most candidates are given up
//! after an episode or a few (successive halving: Karnin, Koren and Somekh 2013), and of those that stay within the
//! loss the one that saves most nodes for its price is taken. Effort is counted in ticks, not timed.

use super::bench::{Bench, Player, error, within};
use super::trace::Paths;
use super::{Progress, Step};
use crate::ir::tree::Node;
use crate::tree::Size;
use crate::tree::prune::{self, Candidate, Cost, Requirement};

/// Episodes to which the candidates of a round play, and how many of them stay in the race then.
const STAGES: [(usize, usize); 4] = [(1, 32), (4, 12), (16, 5), (64, 3)];
/// Episodes of a candidate that is taken.
const EPISODES: usize = 160;
/// Ticks that all descents together may simulate.
const BUDGET: u64 = 40_000_000;
/// Steps of a descent.
const STEPS: usize = 200;
/// Standard errors by which a mean loss has to exceed the limit for a candidate to be given up early.
const HOPELESS: f64 = 2.0;
/// The part of the limit that halves the worth of a saved node.
const PRICE: f64 = 0.125;

/// A tree that was held.
pub(super) struct Held {
    pub(super) root: Node,
    pub(super) steps: Vec<Step>,
    player: Player,
}

/// When a tree of the same size is taken for its plainness.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Plain {
    /// Where nothing smaller is left.
    Last,
    /// As soon as it plays alike.
    Early,
}

/// A candidate in the race.
struct Runner {
    candidate: Candidate,
    player: Player,
}

pub(super) struct Search<'a> {
    pub(super) ticks: u64,
    bench: Bench,
    possible: &'a [Requirement],
    loss: f64,
    progress: &'a (dyn Fn(Progress) + Sync),
}

/// What candidates have to hold against.
struct Measure<'a> {
    exact: &'a Player,
    best: &'a Player,
    now: &'a Player,
    /// What the tree that is held now costs to read, in nodes.
    nodes: usize,
    /// The loss that is allowed.
    limit: f64,
    /// The standard deviation of a return.
    spread: f64,
}

impl<'a> Search<'a> {
    pub(super) fn new(
        bench: Bench,
        possible: &'a [Requirement],
        loss: f64,
        progress: &'a (dyn Fn(Progress) + Sync),
    ) -> Self {
        Self {
            ticks: 0,
            bench,
            possible,
            loss,
            progress,
        }
    }

    pub(super) fn into_bench(self) -> Bench {
        self.bench
    }

    /// Trees that are within the loss, the smallest first, of equal size the plainest, then the best.
    pub(super) fn trees(&mut self, root: &Node) -> Vec<Held> {
        let Some(mut exact) = self.bench.player(root) else {
            return Vec::new();
        };
        self.ticks += self.bench.play(&mut [&mut exact], EPISODES, None);
        let start = Held {
            root: root.clone(),
            steps: Vec::new(),
            player: exact.clone(),
        };
        let mut held = self.descend(&start, &exact, Plain::Last);
        held.extend(self.descend(&start, &exact, Plain::Early));
        if let Some(flat) = self.flat(root, &exact) {
            let further = self.descend(&flat, &exact, Plain::Early);
            held.push(flat);
            held.extend(further);
        }
        held.sort_by(|a, b| {
            let key = |held: &Held| {
                let cost = Cost::of(&held.root, self.possible);
                let cost = (cost.nodes, cost.unasked, cost.literals);
                (cost, prune::negated_literals(&held.root))
            };
            let returns = |held: &Held| held.player.returns().mean;
            let better = returns(b).total_cmp(&returns(a));
            key(a).cmp(&key(b)).then(better)
        });
        held.dedup_by(|a, b| a.root == b.root);
        held
    }

    /// The best tree of one unit a behaviour, if any of them stays within the loss.
    fn flat(&mut self, root: &Node, exact: &Player) -> Option<Held> {
        let candidates = prune::flat(root, self.bench.atoms(), &exact.decided(), self.possible);
        let largest = candidates
            .iter()
            .map(|candidate| candidate.cost.nodes)
            .max();
        let measure = Measure {
            exact,
            best: exact,
            now: exact,
            nodes: largest?,
            limit: self.limit(exact),
            spread: exact.spread(),
        };
        let runners = self.runners(candidates.into_iter());
        let Runner { candidate, player } = self.race(runners, &measure)?;
        Some(Held {
            steps: vec![Step {
                change: candidate.change,
                size: candidate.size,
                loss: player.loss(exact),
            }],
            root: candidate.root,
            player,
        })
    }

    /// The loss that is allowed, in return.
    fn limit(&self, exact: &Player) -> f64 {
        self.loss * exact.returns().mean.abs()
    }

    /// The way down from a tree.
    fn descend(&mut self, from: &Held, exact: &Player, plain: Plain) -> Vec<Held> {
        let mut held: Vec<Held> = Vec::new();
        let mut steps = from.steps.clone();
        let (mut now, mut root, mut best) = (from.player.clone(), from.root.clone(), exact.clone());
        if now.loss(&best).ci95[1] < 0.0 {
            best = now.clone();
        }
        let mut paths = now.paths();
        while self.ticks < BUDGET && steps.len() < STEPS {
            (self.progress)(Progress {
                nodes: Size::of(&root).nodes,
                ticks: self.ticks,
                of: BUDGET,
            });
            let measure = Measure {
                exact,
                best: &best,
                now: &now,
                nodes: Cost::of(&root, self.possible).nodes,
                limit: self.limit(exact),
                spread: exact.spread(),
            };
            let known = |c: &Candidate| !held.iter().any(|held| held.root == c.root);
            let smaller = prune::candidates(&root, self.possible).into_iter();
            let mut smaller = self.runners(smaller.filter(known));
            let plainer = prune::plainer(&root, self.possible).into_iter();
            let mut plainer = self.runners(plainer.filter(known));
            let mut regained = None;
            let mut free = alike(&mut smaller, &measure, &paths);
            if free.is_none() && plain == Plain::Early {
                free = alike(&mut plainer, &measure, &paths);
            }
            let next = match free {
                Some(next) => next,
                None => {
                    let raced = self.race(smaller, &measure).or_else(|| {
                        // To read plainly is worth what was gained on the way.
                        let next = self.race(plainer, &measure.of(exact))?;
                        regained = Some(next.player.clone());
                        Some(next)
                    });
                    let Some(next) = raced else {
                        break;
                    };
                    paths = next.player.paths();
                    next
                }
            };
            now = next.player;
            root = next.candidate.root;
            if let Some(player) = regained {
                best = player;
            } else if now.loss(&best).ci95[1] < 0.0 {
                best = now.clone();
            }
            steps.push(Step {
                change: next.candidate.change,
                size: next.candidate.size,
                loss: now.loss(exact),
            });
            held.push(Held {
                root: root.clone(),
                steps: steps.clone(),
                player: now.clone(),
            });
        }
        held
    }

    fn runners(&self, candidates: impl Iterator<Item = Candidate>) -> Vec<Runner> {
        let ready = candidates.filter_map(|candidate| {
            let player = self.bench.player(&candidate.root)?;
            Some(Runner { candidate, player })
        });
        ready.collect()
    }

    /// The best candidate that stays within the limit.
    fn race(&mut self, mut runners: Vec<Runner>, measure: &Measure) -> Option<Runner> {
        for (episodes, stay) in STAGES {
            self.play(&mut runners, episodes, measure.now);
            runners.retain(|runner| measure.hopes(runner, episodes));
            // Stable: of equal worth, the first stays.
            runners.sort_by(|a, b| measure.worth(b).total_cmp(&measure.worth(a)));
            runners.truncate(stay);
        }
        self.play(&mut runners, EPISODES, measure.now);
        runners.sort_by(|a, b| measure.worth(b).total_cmp(&measure.worth(a)));
        runners.into_iter().find(|runner| measure.passes(runner))
    }

    fn play(&mut self, runners: &mut [Runner], episodes: usize, now: &Player) {
        let players = runners.iter_mut().map(|runner| &mut runner.player);
        let mut players: Vec<&mut Player> = players.collect();
        self.ticks += self.bench.play(&mut players, episodes, Some(now));
    }
}

/// The smallest of the candidates that do on every path what the tree does that is held now; it needs not play.
fn alike(runners: &mut Vec<Runner>, measure: &Measure, paths: &Paths) -> Option<Runner> {
    runners.sort_by_key(|runner| runner.candidate.cost);
    let at = runners
        .iter_mut()
        .position(|runner| runner.player.agrees(paths))?;
    let mut found = runners.remove(at);
    found.player = found.player.standing_for(measure.now);
    Some(found)
}

impl<'a> Measure<'a> {
    /// The same against another best tree.
    fn of(&self, best: &'a Player) -> Self {
        Self { best, ..*self }
    }

    /// Whether a candidate that has played so many episodes may still come within the limit.
    fn hopes(&self, runner: &Runner, episodes: usize) -> bool {
        [self.exact, self.best].into_iter().all(|other| {
            let loss = runner.player.loss(other);
            let error = error(&loss).max(self.spread / (episodes as f64).sqrt());
            loss.mean - HOPELESS * error <= self.limit && runner.player.ended_more(other) <= 0
        })
    }

    fn passes(&self, runner: &Runner) -> bool {
        let mut against = [self.exact, self.best].into_iter();
        against.all(|other| within(&runner.player, other, self.limit))
    }

    /// Nodes saved, the less worth the more return they cost against the tree that is held now, and the more worth the
    /// more they gain.
    fn worth(&self, runner: &Runner) -> f64 {
        // A move that saves no node is worth something, too.
        let saved = self.nodes as f64 - runner.candidate.cost.nodes as f64 + 0.1;
        let price = (PRICE * self.limit).max(1e-9);
        let lost = runner.player.loss(self.now).mean / price;
        if lost <= 0.0 {
            saved * (1.0 - lost)
        } else {
            saved / (1.0 + lost)
        }
    }
}
