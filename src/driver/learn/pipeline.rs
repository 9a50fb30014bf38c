//! From a learner in any world to its tree: learn, take the best run, improve it, roll it out, decanonicalise, prove, grow,
//! test.

use super::{Options, Shape, Stage};
use crate::checkpoint::{Keeper, Part};
use crate::grow::{self, Grown, Starts, grow};
use crate::ir::Program;
use crate::ir::tree::{Atom, Node, Tree};
use crate::learn::experiment::Experiment;
use crate::learn::extract;
use crate::learn::improve::Improved;
use crate::learn::process::World;
use crate::learn::run::Run;
use crate::learn::simulated::Purpose;
use crate::policy::{Policy, decisions, evidence, transitions};
use crate::report::results::{Results, Trees};
use crate::tree::decanonicalise::{self, Care};
use crate::tree::prove::Refuted;
use crate::trial::learned;
use std::fmt;
use std::sync::atomic::{AtomicU64, Ordering};

/// Why nothing was learned.
#[derive(Clone, Debug, PartialEq)]
pub enum Unlearned {
    /// In no minterm there were enough decisions.
    Nothing,
    /// The rewards are not finite.
    WithoutValue,
    /// The tree is not equal to the policy, which is a mistake of btc itself.
    Refuted(Refuted),
    /// The tree asks an atom that the world does not know.
    Unknown(Atom),
}

impl fmt::Display for Unlearned {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Nothing => f.write_str(
                "nothing was learned: no minterm has enough completed decisions; let there be more episodes, or longer ones",
            ),
            Self::WithoutValue => f.write_str("nothing was learned: the rewards are not finite"),
            Self::Refuted(why) => write!(
                f,
                "the tree that was found is not equal to the policy: {why}"
            ),
            Self::Unknown(_) => f.write_str("the tree asks what the world does not know"),
        }
    }
}

impl std::error::Error for Unlearned {}

/// Learns in a world and turns the policy into a tree.
///
/// # Errors
/// Nothing was learned, or the tree was refuted.
pub fn learn<'e, W: World>(
    experiment: &'e Experiment<'e, W>,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Results<'e, W>, Unlearned> {
    let program = experiment.program;
    let seed = options.seed.unwrap_or(experiment.learner.seed);
    let keeper = options.keeper;
    let mut runs = learn_all(experiment, (seed, options), progress);
    progress(Stage::Validating);
    let (best, validated) = experiment.elect(&runs, seed);
    let effort = match options.seeds {
        Some(_) => options.effort,
        None => grow::left_by(options.effort, &runs, &validated),
    };
    let mut improved = Improved::default();
    let others = grow::others(&runs, &validated, best);
    if options.shape == Shape::Grown
        && let Some(run) = runs.get_mut(best)
    {
        progress(Stage::Improving);
        improved = grow::improve(experiment, (run, &others), effort, keeper);
    }
    let run = runs.get(best).ok_or(Unlearned::Nothing)?;
    progress(Stage::RollingOut);
    let stream = (Purpose::RollOut, run.seed);
    let part = Part::new(keeper, "met");
    let (met, summary) =
        part.whole(|| experiment.roll_out(&run.decisions, options.roll_outs, stream));
    let atoms = program.atoms(experiment.learner.task);
    let thin = extract::thin(&run.table, options.evidence, atoms.len());
    let policy = extract::policy(&run.decisions, &run.table, &met, experiment.task, atoms);
    let mut values = policy
        .rows
        .iter()
        .flat_map(|row| row.values.iter().flatten());
    if values.any(|value| !value.q.is_finite()) {
        return Err(Unlearned::WithoutValue);
    }
    publish(keeper, &policy, program);
    progress(Stage::Proving);
    let trees = trees(&policy, options).map_err(|why| match why {
        Refuted::Empty => Unlearned::Nothing,
        why => Unlearned::Refuted(why),
    })?;
    let exact = &trees.chosen().root;
    let grown = match options.shape {
        Shape::Exact => None,
        Shape::Grown => Some(grown(
            experiment,
            (exact, &policy),
            (options, seed, grow::growing(effort, &improved)),
            progress,
        )?),
    };
    // Where a behaviour fails at once the policy waits, and a tree goes on: its episodes are others.
    let differs = grown.is_none() && !trees.chosen().failing.is_empty();
    let tests = match options.tests {
        0 if differs => options.roll_outs,
        tests => tests,
    };
    let tested = if tests > 0 {
        progress(Stage::Testing);
        let care = learned::care_set(options.care, &run.decisions, &met);
        let tested = learned::test(experiment, exact, &care, tests, seed);
        Some(tested.map_err(Unlearned::Unknown)?)
    } else {
        None
    };
    Ok(Results {
        experiment,
        runs,
        validated,
        best,
        improved,
        thin,
        met,
        summary,
        policy,
        trees,
        grown,
        tested,
    })
}

/// The runs of all seeds: those that were asked for, or one and as many more as pay.
fn learn_all<W: World>(
    experiment: &Experiment<W>,
    (seed, options): (u64, &Options),
    progress: &(dyn Fn(Stage) + Sync),
) -> Vec<Run> {
    let done = AtomicU64::new(0);
    let learn = |first: u64, count: u64, of: u64| {
        let all = experiment.episodes.saturating_mul(of);
        experiment.learn_all((first, count), options.keeper, || {
            let done = done.fetch_add(1, Ordering::Relaxed) + 1;
            progress(Stage::Learning(done, all));
        })
    };
    if let Some(seeds) = options.seeds {
        return learn(seed, seeds, seeds);
    }
    let mut runs = learn(seed, 1, 1);
    if let (Shape::Grown, [first]) = (options.shape, runs.as_slice()) {
        let more = grow::more_runs(experiment, options.effort, first);
        runs.extend(learn(seed.wrapping_add(1), more, 1 + more));
    }
    runs
}

/// Keeps what took longest in the form in which anybody can use it.
fn publish(keeper: &dyn Keeper, policy: &Policy, program: &Program) {
    if keeper.keeps() {
        keeper.publish("policy.csv", &decisions::write(policy, program));
        keeper.publish("q.csv", &evidence::write(policy, program));
        keeper.publish("transitions.csv", &transitions::write(policy, program));
    }
}

/// The tree that grows from the exact one and those of the program.
fn grown<W: World>(
    experiment: &Experiment<W>,
    (exact, policy): (&Node, &Policy),
    (options, seed, effort): (&Options, u64, u64),
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Grown, Unlearned> {
    let Experiment {
        program,
        task,
        learner,
        ..
    } = *experiment;
    let ground = grow::ground(experiment, seed);
    let played = |tree: &&Tree| tree.task.is_none_or(|of| of == learner.task);
    let others = program.trees.values().filter(played).filter_map(|tree| {
        // What is for any task is a part of others.
        let (root, stand_ins) = task.fitted(program, tree)?;
        let fits = tree.task.is_some() || stand_ins.is_empty();
        fits.then(|| (tree.name.to_string(), root))
    });
    let starts = Starts {
        exact: exact.clone(),
        others: others.collect(),
        minterms: policy.rows.iter().map(|row| row.minterm.key()).collect(),
        found: Vec::new(),
    };
    let requirements = grow::requirements(program, task);
    let settings = grow::Settings {
        effort,
        requirements: &requirements,
        choice: options.choice,
        front: options.front,
    };
    let heard = |heard: grow::Progress| progress(Stage::Growing(heard.ticks, heard.of));
    grow(&ground, &starts, &settings, options.keeper, &heard).map_err(Unlearned::Unknown)
}

/// The policy as a tree, on both care sets.
fn trees(policy: &Policy, options: &Options) -> Result<Trees, Refuted> {
    let tree = |care| {
        let options = decanonicalise::Options {
            method: options.method,
            care,
            ..decanonicalise::Options::default()
        };
        decanonicalise::decanonicalise(policy, &options)
    };
    let (seen, reachable) = rayon::join(|| tree(Care::Seen), || tree(Care::Reachable));
    Ok(Trees {
        care: options.care,
        seen: seen?,
        reachable: reachable?,
    })
}
