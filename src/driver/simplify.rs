//! `--simplify`: a smaller tree that simulation tells is worth nearly as much as the exact one.
//!
//! A local search over the moves of [`prune`], judged on common seeds: both trees play the same episodes, and the
//! differences of their returns are what counts. What plays every known path alike costs nothing and is taken first;
//! of the rest, most are given up after an episode or two (successive halving: Karnin, Koren and Somekh 2013), and the
//! best of those that stay within the loss is taken.

mod bench;
mod trace;

use super::load::Loaded;
use crate::diagnostic::Diagnostic;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::statistics::{Mean, Summary};
use crate::tree::Size;
use crate::tree::prune::{self, Candidate, Change, Possible};
use crate::world::Start;
use bench::{Bench, Player};
use trace::Paths;

/// Seeds of the search, of the second opinion on what it found, and of the final measurement; no other purpose has them.
const SEARCH: u64 = 16;
const CONFIRM: u64 = 17;
const MEASURE: u64 = 18;

/// Episodes to which the candidates of a round play, and how many of them stay in the race then.
const STAGES: [(usize, usize); 4] = [(1, 32), (4, 12), (16, 5), (64, 3)];
/// Episodes of a candidate that is taken.
const EPISODES: usize = 160;
/// Episodes of the second opinion.
const CONFIRMING: usize = 320;
/// Fresh episodes before and after.
const FRESH: usize = 1000;
/// Ticks that the search may simulate.
const BUDGET: u64 = 80_000_000;
/// How many standard errors beyond the limit a mean loss has to be for a candidate to be given up early.
const HOPELESS: f64 = 2.5;

/// A tree with what it is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Its size.
    pub size: Size,
    /// What its episodes came to.
    pub summary: Summary,
}

/// A change that was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What was done.
    pub change: Change,
    /// The size after it.
    pub size: Size,
    /// The mean loss of return an episode against the exact tree, on the seeds of the search.
    pub loss: Mean,
}

/// A simplified tree.
#[derive(Clone, Debug)]
pub struct Simplified {
    /// The tree; the exact one if nothing smaller came within the loss.
    pub root: Node,
    /// The exact tree on fresh seeds.
    pub before: Figures,
    /// This tree on the same seeds.
    pub after: Figures,
    /// Its mean loss of return an episode on these seeds, paired.
    pub loss: Mean,
    /// The greatest loss that was allowed, as a part of the exact tree's return.
    pub allowed: f64,
    /// How it was found.
    pub steps: Vec<Step>,
    /// Ticks that the search simulated.
    pub ticks: u64,
}

/// How far the search has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The nodes of the tree that is held now.
    pub nodes: usize,
    /// Ticks that were simulated.
    pub ticks: u64,
    /// Ticks that may be.
    pub of: u64,
}

/// Simplifies the exact tree of a task while the mean paired loss of return stays below `loss`, a part of the exact
/// tree's return, with 95 % confidence, and no line of `end on` ends more episodes to the robot's loss.
///
/// # Errors
/// The world cannot be built.
pub fn simplify(
    loaded: &Loaded,
    task: Id<Task>,
    root: &Node,
    loss: f64,
    seed: u64,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Simplified, Diagnostic> {
    let ends = loaded.program.tasks[task].end_on.len();
    let start = Start {
        seed,
        stream: SEARCH,
        limit: loaded.program.tasks[task].end_after,
        ..Start::default()
    };
    let bench = Bench::new(loaded, task, root, start)?;
    let mut search = Search {
        possible: possible(&loaded.program, task),
        bench,
        loss,
        ticks: 0,
        progress,
    };
    let path = search.descend(root);
    let mut bench = search.bench.from(CONFIRM);
    let kept = confirmed(&bench, root, &path, loss);
    let taken = path.get(..kept).unwrap_or_default();
    let simple = taken.last().map_or(root, |held| &held.root);
    bench = bench.from(MEASURE);
    let figures = |player: &Player, root: &Node| Figures {
        size: Size::of(root),
        summary: Summary::of(&player.results(), ends),
    };
    let (mut before, mut after) = match (bench.player(root), bench.player(simple)) {
        (Some(before), Some(after)) => (before, after),
        _ => return Err(super::run::internal(loaded, "a guard")),
    };
    bench.play(&mut [&mut before], FRESH, None);
    bench.play(&mut [&mut after], FRESH, Some(&before));
    Ok(Simplified {
        root: simple.clone(),
        before: figures(&before, root),
        after: figures(&after, simple),
        loss: after.loss(&before),
        allowed: loss,
        steps: taken.iter().map(|held| held.step.clone()).collect(),
        ticks: search.ticks,
    })
}

/// The predicate that each behaviour of the task requires, where it requires just that.
fn possible(program: &Program, task: Id<Task>) -> Vec<Possible> {
    let task = &program.tasks[task];
    let required = task.choose.iter().filter_map(|&behavior| {
        let requires = program.behaviors[behavior].law.as_ref()?.requires;
        let same = |&&id: &&Id<_>| program.predicates[id].when == Some(requires);
        let predicate = task.observe.iter().find(same)?;
        Some((behavior, Atom::Predicate(*predicate)))
    });
    required.collect()
}

/// How many steps of the way hold on seeds of their own: the last ones are given up until one does.
fn confirmed(bench: &Bench, root: &Node, path: &[Held], loss: f64) -> usize {
    let Some(mut exact) = bench.player(root) else {
        return 0;
    };
    bench.play(&mut [&mut exact], CONFIRMING, None);
    let limit = loss * exact.mean().abs();
    for kept in (1..=path.len()).rev() {
        let held = kept.checked_sub(1).and_then(|at| path.get(at));
        let Some(mut player) = held.and_then(|held| bench.player(&held.root)) else {
            continue;
        };
        bench.play(&mut [&mut player], CONFIRMING, Some(&exact));
        if within(&player, &exact, limit) {
            return kept;
        }
    }
    0
}

/// Whether a tree loses at most so much, and ends no more episodes.
fn within(player: &Player, exact: &Player, limit: f64) -> bool {
    player.loss(exact).ci95[1] <= limit && player.ended_more(exact) <= 0
}

/// A tree on the way.
struct Held {
    root: Node,
    step: Step,
}

/// A candidate in the race.
struct Runner {
    candidate: Candidate,
    player: Player,
}

struct Search<'a> {
    possible: Vec<Possible>,
    bench: Bench,
    loss: f64,
    ticks: u64,
    progress: &'a (dyn Fn(Progress) + Sync),
}

impl Search<'_> {
    /// The way down from the exact tree, each step smaller than the one before.
    fn descend(&mut self, root: &Node) -> Vec<Held> {
        let mut path: Vec<Held> = Vec::new();
        let Some(mut exact) = self.bench.player(root) else {
            return path;
        };
        self.ticks += self.bench.play(&mut [&mut exact], EPISODES, None);
        let limit = self.loss * exact.mean().abs();
        let (mut now, mut root) = (exact.clone(), root.clone());
        let mut best = exact.clone();
        let mut paths = now.paths();
        while self.ticks < BUDGET {
            (self.progress)(Progress {
                nodes: Size::of(&root).nodes,
                ticks: self.ticks,
                of: BUDGET,
            });
            let mut candidates = prune::candidates(&root, &self.possible);
            candidates.extend(prune::turned(&root));
            let mut runners: Vec<Runner> = candidates
                .into_iter()
                .filter_map(|candidate| {
                    let player = self.bench.player(&candidate.root)?;
                    Some(Runner { candidate, player })
                })
                .collect();
            let next = match alike(&mut runners, &paths) {
                Some(mut same) => {
                    same.player = same.player.standing_for(&now);
                    same
                }
                None => match self.race(runners, &now, &[&exact, &best], Size::of(&root), limit) {
                    Some(next) => {
                        paths = next.player.paths();
                        next
                    }
                    None => break,
                },
            };
            now = next.player;
            if now.loss(&best).ci95[1] < 0.0 {
                best = now.clone();
            }
            root = next.candidate.root;
            path.push(Held {
                root: root.clone(),
                step: Step {
                    change: next.candidate.change,
                    size: next.candidate.size,
                    loss: now.loss(&exact),
                },
            });
        }
        path
    }

    /// The best candidate that stays within the limit.
    fn race(
        &mut self,
        mut runners: Vec<Runner>,
        now: &Player,
        against: &[&Player],
        size: Size,
        limit: f64,
    ) -> Option<Runner> {
        let floor = limit / 8.0;
        for (episodes, stay) in STAGES {
            self.play(&mut runners, episodes, now);
            runners.retain(|runner| {
                against.iter().all(|other| {
                    let loss = runner.player.loss(other);
                    let error = (loss.ci95[1] - loss.mean) / 1.96;
                    let error = error.max(2.0 * limit / (episodes as f64).sqrt());
                    loss.mean - HOPELESS * error <= limit && runner.player.ended_more(other) <= 0
                })
            });
            if std::env::var("VV").is_ok() { eprintln!("stage {episodes}: {} left", runners.len()); }
            runners.sort_by(|a, b| {
                let worth = |runner: &Runner| worth(runner, now, size, floor);
                worth(b).total_cmp(&worth(a))
            });
            runners.truncate(stay);
        }
        self.play(&mut runners, EPISODES, now);
        runners.retain(|runner| against.iter().all(|other| within(&runner.player, other, limit)));
            if std::env::var("VV").is_ok() { eprintln!("{} passed", runners.len()); }
        // The sort is stable, and the last is the best.
        runners.reverse();
        runners.sort_by(|a, b| {
            let worth = |runner: &Runner| worth(runner, now, size, floor);
            worth(a).total_cmp(&worth(b))
        });
        runners.pop()
    }

    fn play(&mut self, runners: &mut [Runner], episodes: usize, now: &Player) {
        let mut players: Vec<&mut Player> =
            runners.iter_mut().map(|runner| &mut runner.player).collect();
        self.ticks += self.bench.play(&mut players, episodes, Some(now));
    }
}

/// The smallest of the candidates that do on every path what was done.
fn alike(runners: &mut Vec<Runner>, paths: &Paths) -> Option<Runner> {
    let mut order: Vec<usize> = (0..runners.len()).collect();
    order.sort_by_key(|&i| runners.get(i).map(|runner| runner.candidate.size));
    let found = order.into_iter().find(|&i| {
        let runner = runners.get_mut(i);
        runner.is_some_and(|runner| runner.player.agrees(paths))
    });
    found.map(|i| runners.swap_remove(i))
}

/// Nodes saved, the dearer the more return they cost against the tree that is held now; gains make them cheaper.
fn worth(runner: &Runner, now: &Player, size: Size, floor: f64) -> f64 {
    let saved = size.nodes as f64 - runner.candidate.size.nodes as f64 + 0.1;
    let lost = runner.player.loss(now).mean;
    if lost <= 0.0 {
        saved * (floor - lost) / floor.max(f64::MIN_POSITIVE)
    } else {
        saved * floor / (floor + lost)
    }
}
