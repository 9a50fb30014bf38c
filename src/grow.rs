//! Growing a small tree: a search among trees, judged by paired simulation.
//!
//! Minterms are an abstraction, and an exact tree repeats its noise. So trees are searched for directly. Counts of
//! what decisions lead to say which changes of a tree look good ([`evidence`], [`field`], [`propose`]), races on fresh
//! seeds say which are ([`race`]). A tree replaces another if it does less harm, or else if it returns more for its nodes.
//! What it does alike with fewer nodes costs no simulation at all. Effort is counted in ticks, not in time.

mod alone;
pub mod bodies;
mod cell;
pub mod chart;
pub mod cover;
pub mod evidence;
pub mod field;
pub mod front;
mod gathered;
pub mod ground;
mod grower;
pub mod guards;
pub mod iterate;
pub mod place;
pub mod probe;
pub mod propose;
pub mod race;
pub mod reader;
mod step;
mod survey;
mod tested;
mod trim;

use crate::checkpoint::{Keeper, Part};
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::episode::Episode;
use crate::learn::experiment::Experiment;
use crate::learn::extract::Decisions;
use crate::learn::greedy;
use crate::learn::improve::{Improved, Improver};
use crate::learn::process::{Key, World};
use crate::learn::run::Run;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::tree::prune::Requirement;
pub use front::{Choice, Grown, Point};
use ground::Ground;
use grower::Grower;
use iterate::{Iteration, Pace};
use serde::{Deserialize, Serialize};
pub use tested::{Beside, Figures};

/// What a search starts from.
#[derive(Clone, Debug)]
pub struct Starts {
    /// The exact tree of the policy.
    pub exact: Node,
    /// Other trees by their names, such as those that a person wrote.
    pub others: Vec<(String, Node)>,
    /// The minterms of the policy.
    pub minterms: Vec<Key>,
    /// Trees that were found where episodes end early.
    pub found: Vec<Node>,
}

/// How a search is done.
#[derive(Clone, Debug)]
pub struct Settings<'a> {
    /// About how many ticks may be simulated.
    pub effort: u64,
    /// The predicate that each behaviour requires, where it requires just that.
    pub requirements: &'a [Requirement],
    /// Which tree of the front is wanted.
    pub choice: Choice,
    /// Whether the front is to be shown: then smaller trees that cost something are looked for, too, once a tree is chosen.
    pub front: bool,
}

/// How far the search has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The nodes of the current tree.
    pub nodes: usize,
    /// Ticks simulated so far.
    pub ticks: u64,
    /// The most ticks.
    pub of: u64,
}

/// Where the trees of a learner grow.
pub fn ground<'w, W: World>(experiment: &'w Experiment<W>, seed: u64) -> Ground<'w, W> {
    let task = experiment.task;
    Ground {
        world: &experiment.world,
        choices: &task.choose,
        observed: experiment.program.atoms(experiment.learner.task).len(),
        patience: task.patience,
        start: experiment.measured(Purpose::Grow, seed),
        exploring: experiment.exploring(),
        discounting: experiment.discounting(),
        ends: task.end_on.len(),
        history: task.history,
        never: experiment
            .never()
            .iter()
            .map(|event| event.index())
            .collect(),
        seed,
    }
}

/// The part of the effort that goes into the policy, by iteration and then decision by decision.
const ITERATING: f64 = 0.35;
const IMPROVING: f64 = 0.05;
/// The part that goes into the tree.
const GROWING: f64 = 0.6;

/// Improves the policy of a run by simulation.
pub fn improve<W: World>(
    experiment: &Experiment<W>,
    (run, others): (&mut Run, &[Decisions]),
    effort: u64,
    keeper: &dyn Keeper,
) -> Improved {
    let part = Part::new(keeper, "improved");
    let (decisions, table, improved) = part.whole(|| {
        let part = Part::new(keeper, "policy");
        let improved = improve_from(experiment, (run, others), effort, &part);
        (run.decisions.clone(), run.table.clone(), improved)
    });
    (run.decisions, run.table) = (decisions, table);
    improved
}

fn improve_from<W: World>(
    experiment: &Experiment<W>,
    (run, others): (&mut Run, &[Decisions]),
    effort: u64,
    part: &Part,
) -> Improved {
    let ground = ground(experiment, run.seed);
    let unseen = greedy::unseen(experiment.program, experiment.learner.task);
    let iteration = Iteration {
        ground: &ground,
        unseen,
        least: experiment.evidence,
        effort: share(effort, ITERATING),
        pace: Pace::THOROUGH,
        others,
    };
    let iterated = iteration.run(&run.decisions, part);
    let ticks = iterated.ticks;
    let changed = iterated.apply(&mut run.decisions, &mut run.table);
    let improver = Improver {
        world: ground.world,
        choices: ground.choices,
        unseen,
        patience: ground.patience,
        start: ground.episodes(Purpose::Improve, 0),
        effort: share(effort, IMPROVING),
        harm: |episode: &Episode| ground.harm(episode),
    };
    let improved = improver.improve(&mut run.decisions, &run.table);
    Improved {
        changed: changed + improved.changed,
        ticks: ticks + improved.ticks,
    }
}

/// The part of the effort of a search that is kept for choosing among its trees, and for testing the one that is chosen.
const CHOOSING: f64 = 0.2;
/// As large a part of the effort, beyond it, looks for a tree that does less harm, where any was met.
const MENDING: f64 = 0.08;
/// As large a part of the effort, beyond it, looks for smaller trees that cost something, once a tree is found.
const SHRINKING: f64 = 0.08;

/// The part of the effort of learning that a search for a tree gets, with what the policy has left of its own.
pub fn growing(effort: u64, improved: &Improved) -> u64 {
    let policy = share(effort, ITERATING + IMPROVING);
    share(effort, GROWING) + policy.saturating_sub(improved.ticks)
}

/// The runs of learning from which the best is taken where nobody says how many.
const RUNS: u64 = 3;
/// The most that the further ones may take, as a part of the effort.
const RUNNING: f64 = 0.15;

/// How many further runs of learning pay: policies differ much from run to run, and a search that begins with a better one
/// finds a better tree. But they and their comparison have to be a small part of the effort.
pub fn more_runs<W: World>(experiment: &Experiment<W>, effort: u64, first: &Run) -> u64 {
    let counts = first.counts;
    let length = counts.ticks / counts.episodes.max(1);
    let validated = experiment.validations().saturating_mul(length);
    let left = share(effort, RUNNING).saturating_sub(validated);
    let each = counts.ticks.saturating_add(validated);
    (left / each.max(1)).min(RUNS - 1)
}

/// What is left of the effort after the runs beyond the first, and the comparison of all.
pub fn left_by(effort: u64, runs: &[Run], validated: &[Summary]) -> u64 {
    let further = runs.iter().skip(1).map(|run| run.counts.ticks);
    let compared = validated.iter().map(|summary| summary.ticks);
    effort.saturating_sub(further.chain(compared).sum())
}

/// The policies of the other runs whose ways are worth to be known: of many, those that return most.
pub fn others(runs: &[Run], validated: &[Summary], best: usize) -> Vec<Decisions> {
    let returns: Vec<f64> = validated.iter().map(|it| it.total.mean).collect();
    let others = next_best(&returns, best).into_iter();
    let others = others.filter_map(|at| runs.get(at));
    others.map(|run| run.decisions.clone()).collect()
}

/// The places of the greatest returns beside the best, in their order.
fn next_best(returns: &[f64], best: usize) -> Vec<usize> {
    let others = returns.iter().enumerate().filter(|(at, _)| *at != best);
    let mut others: Vec<(usize, &f64)> = others.collect();
    others.sort_by(|(_, a), (_, b)| b.total_cmp(a));
    others.truncate(RUNS as usize - 1);
    let mut places: Vec<usize> = others.into_iter().map(|(at, _)| at).collect();
    places.sort_unstable();
    places
}

fn share(effort: u64, part: f64) -> u64 {
    (effort as f64 * part) as u64
}

/// The predicate that each behaviour of the task requires, where it requires just that.
pub fn requirements(program: &Program, task: &Task) -> Vec<Requirement> {
    let required = task.choose.iter().filter_map(|&behavior| {
        let requires = program.behaviors[behavior].law.as_ref()?.requires;
        let same = |&&id: &&Id<_>| program.predicates[id].when == Some(requires);
        let predicate = task.observe.iter().find(same)?;
        Some((behavior, Atom::Predicate(*predicate)))
    });
    required.collect()
}

/// Grows a tree.
///
/// # Errors
/// The exact tree asks an atom that the world does not know.
pub fn grow<W: World>(
    ground: &Ground<W>,
    starts: &Starts,
    settings: &Settings,
    keeper: &dyn Keeper,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Grown, Atom> {
    let whole = Part::new(keeper, "grown");
    if let Some(grown) = whole.resume() {
        return Ok(grown);
    }
    let early = match is_long(ground, &starts.exact)? {
        true => early(ground, starts, settings, keeper, progress)?,
        false => Early::default(),
    };
    let starts = &Starts {
        found: early.found.clone(),
        ..starts.clone()
    };
    let settings = &Settings {
        effort: settings.effort.saturating_sub(early.ticks),
        ..settings.clone()
    };
    let part = Part::new(keeper, "tree");
    let searching = Settings {
        effort: share(settings.effort, 1.0 - CHOOSING),
        ..settings.clone()
    };
    let mut grower = Grower::new(ground, &searching, progress);
    let found = grower.run(starts, &part)?;
    let found = grower.mend(&found, share(settings.effort, MENDING));
    let ways = grower.visited.len();
    grower.shrink(&found, share(settings.effort, SHRINKING));
    let candidates = front::candidates(grower.visited.split_at(ways), starts);
    let mut grown = front::choose(&mut grower, candidates.clone(), starts, settings)?;
    if settings.front && settings.choice == Choice::Knee {
        grown.front = front::drawn(&mut grower, candidates, starts, settings, &grown.root);
        grown.ticks = grower.judge.seen.ticks;
    }
    grown.ticks += early.ticks;
    whole.save(|| &grown);
    Ok(grown)
}

/// The most ticks of an episode that ends early. Episodes are ended so if they have more than so many times as many, on average.
const EARLY: u64 = 3_000;
const LONGER: u64 = 2;
/// The part of the effort that is spent on such episodes.
const EARLIER: f64 = 0.4;

/// What a search has found where episodes end early.
#[derive(Debug, Default, Serialize, Deserialize)]
struct Early {
    found: Vec<Node>,
    ticks: u64,
}

/// What is found where long episodes end early: a search plays thousands of them, of which the effort has too few if they are long.
fn early<W: World>(
    ground: &Ground<W>,
    starts: &Starts,
    settings: &Settings,
    keeper: &dyn Keeper,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Early, Atom> {
    let early = Part::new(keeper, "early");
    if let Some(early) = early.resume() {
        return Ok(early);
    }
    let ground = ground.until(EARLY);
    let of = settings.effort;
    let settings = Settings {
        effort: share(of, EARLIER),
        ..settings.clone()
    };
    let progress = |told: Progress| progress(Progress { of, ..told });
    let mut grower = Grower::new(&ground, &settings, &progress);
    let found = grower.run(starts, &Part::new(keeper, "early tree"))?;
    let found = Early {
        found: vec![found],
        ticks: grower.judge.seen.ticks,
    };
    early.save(|| &found);
    Ok(found)
}

/// Whether the episodes of a tree are long.
fn is_long<W: World>(ground: &Ground<W>, tree: &Node) -> Result<bool, Atom> {
    const SHOWN: usize = 4;
    if ground.start.limit <= LONGER * EARLY {
        return Ok(false);
    }
    let trials = ground.trials(Purpose::Grow, 0);
    let mut contender = trials.contender(tree)?;
    trials.play(&mut [&mut contender], SHOWN, None);
    Ok(contender.length() > LONGER * EARLY)
}

#[cfg(test)]
mod tests {
    use super::next_best;

    #[test]
    fn the_ways_of_the_two_next_best_runs_are_known() {
        assert_eq!(next_best(&[3.0, 1.0, 9.0, 5.0, -2.0], 2), [0, 3]);
        assert_eq!(next_best(&[1.0, 2.0, 3.0], 0), [1, 2]);
        assert_eq!(next_best(&[1.0, 2.0], 1), [0]);
        assert!(next_best(&[], 0).is_empty());
    }
}
