//! `btc learn`: from a checked program to a learned, proved, printed tree.

mod files;
mod places;
mod warnings;

use super::load::Loaded;
use super::refused::Refused;
use super::{target, world};
use crate::diagnostic::{Code, Diagnostic};
use crate::grow::{self, Choice, Grown, Starts, grow};
use crate::ir::Id;
use crate::ir::task::Learner;
use crate::ir::tree::{Node, Tree};
use crate::learn::curve::Point;
use crate::learn::experiment::{Experiment, Run};
use crate::learn::extract;
use crate::learn::improve::Improved;
use crate::learn::simulated::Purpose;
use crate::policy::Policy;
use crate::report::results::{Results, Trees};
use crate::tree::decanonicalise::{self, Care, Method};
use crate::tree::prove::Refuted;
use crate::trial::{Unplayable, learned};
use std::sync::atomic::{AtomicU64, Ordering};

/// The ticks of a search for a tree, if nothing else is said.
pub const EFFORT: u64 = 60_000_000;

/// The tree that is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Shape {
    /// The tree that decides exactly as the policy, proved
    Exact,
    /// A small tree that returns as much or more, tested
    Grown,
}

/// What a user may set.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// The learner, if there are several.
    pub learner: Option<&'o str>,
    /// The first seed, instead of the learner's.
    pub seed: Option<u64>,
    /// The number of runs, one for each seed from the first on; the best is taken.
    pub seeds: u64,
    /// The number of episodes, instead of the learner's.
    pub episodes: Option<u64>,
    /// The fewest decisions by which a minterm counts as learned; below, it is a don't-care.
    pub evidence: u64,
    /// The method that finds the tree.
    pub method: Method,
    /// In which minterms the tree takes the policy's decisions.
    pub care: Care,
    /// The tree that is wanted.
    pub shape: Shape,
    /// Which of the grown trees is wanted.
    pub choice: Choice,
    /// Whether the report lists the front of trees.
    pub front: bool,
    /// About how many ticks the search for a tree may simulate.
    pub effort: u64,
    /// The number of greedy episodes that show the transitions of the policy.
    pub roll_outs: u64,
    /// The number of episodes that test the tree.
    pub tests: u64,
    /// The path of the source from the folder of the results.
    pub source: &'o str,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            learner: None,
            seed: None,
            seeds: 1,
            episodes: None,
            evidence: 10,
            method: Method::Search,
            care: Care::Reachable,
            shape: Shape::Grown,
            choice: Choice::Knee,
            front: false,
            effort: EFFORT,
            roll_outs: 2000,
            tests: 0,
            source: "program.bt",
        }
    }
}

/// How far the learning has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning: the episodes that are done, and all of them, over all runs.
    Learning(u64, u64),
    /// Finding the best of several runs.
    Validating,
    /// Improving the policy.
    Improving,
    /// Rolling the greedy policy out.
    RollingOut,
    /// Turning the policy into a tree, and proving it.
    Proving,
    /// Growing a tree: the ticks that are done, and all of them.
    Growing(u64, u64),
    /// Testing the tree.
    Testing,
}

/// What was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The tree as an item of the language.
    pub text: String,
    /// The files to write, by name.
    pub files: Vec<(&'static str, String)>,
    /// The report on the tree that is printed, in five lines.
    pub headline: Vec<String>,
    /// What to know of the result before it is trusted, at its places in the program.
    pub warnings: Vec<Diagnostic>,
    /// The whole report, in lines.
    pub report: Vec<String>,
    /// The tree, with its documentation.
    pub tree: Tree,
    /// The policy.
    pub policy: Policy,
    /// The learner.
    pub learner: Id<Learner>,
    /// The learning curve of each run, by its seed.
    pub curves: Vec<(u64, Vec<Point>)>,
}

/// Learns, decanonicalises, proves.
///
/// # Errors
/// There is no learner, the world cannot be built, nothing was learned, or the tree was refuted.
pub fn learn(
    loaded: &Loaded,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Learned, Refused> {
    let program = &loaded.program;
    let id = target::learner(loaded, options.learner)?;
    let experiment = Experiment::new(program, id, options.episodes, options.evidence)
        .map_err(|error| world::unplayable(loaded, error))?;
    let seed = options.seed.unwrap_or(experiment.learner.seed);
    let mut runs = learn_all(&experiment, seed, options.seeds, progress);
    progress(Stage::Validating);
    let (best, validated) = experiment.elect(&runs, seed);
    let mut improved = Improved::default();
    if options.shape == Shape::Grown
        && let Some(run) = runs.get_mut(best)
    {
        progress(Stage::Improving);
        improved = grow::improve(&experiment, run, options.effort);
    }
    let Some(run) = runs.get(best) else {
        return Err(nothing(loaded, options.evidence));
    };
    progress(Stage::RollingOut);
    let stream = (Purpose::RollOut, run.seed);
    let (met, summary) = experiment.roll_out(&run.decisions, options.roll_outs, stream);
    let atoms = program.atoms(experiment.learner.task);
    let thin = extract::thin(&run.table, options.evidence, atoms.len());
    let policy = extract::policy(&run.decisions, &run.table, &met, experiment.task, atoms);
    let mut values = policy
        .rows
        .iter()
        .flat_map(|row| row.values.iter().flatten());
    if values.any(|value| !value.q.is_finite()) {
        return Err(without_value(loaded));
    }
    progress(Stage::Proving);
    let trees = trees(&policy, options).map_err(|why| refuted(loaded, &why, options.evidence))?;
    let exact = &trees.chosen().root;
    let unplayable = |why: Unplayable| world::unplayable(loaded, why);
    let grown = match options.shape {
        Shape::Exact => None,
        Shape::Grown => {
            Some(grown(&experiment, exact, (options, seed), progress).map_err(unplayable)?)
        }
    };
    let tested = if options.tests > 0 {
        progress(Stage::Testing);
        let care = learned::care_set(options.care, &run.decisions, &met);
        let tested = learned::test(&experiment, exact, &care, options.tests, seed);
        Some(tested.map_err(|atom| unplayable(Unplayable::Unknown(atom)))?)
    } else {
        None
    };
    let results = Results {
        experiment: &experiment,
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
    };
    files::written(loaded, options, id, results)
}

/// The runs of all seeds.
fn learn_all(
    experiment: &Experiment,
    seed: u64,
    seeds: u64,
    progress: &(dyn Fn(Stage) + Sync),
) -> Vec<Run> {
    let all = experiment.episodes.saturating_mul(seeds);
    let done = AtomicU64::new(0);
    experiment.learn_all(seed, seeds, || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(Stage::Learning(done, all));
    })
}

/// The tree that grows from the exact one and those of the program.
fn grown(
    experiment: &Experiment,
    exact: &Node,
    (options, seed): (&Options, u64),
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Grown, Unplayable> {
    let Experiment {
        program,
        task,
        learner,
        ..
    } = *experiment;
    let ground = grow::ground(experiment, seed);
    let played = |tree: &&Tree| tree.task.is_none_or(|task| task == learner.task);
    let others = program
        .trees
        .values()
        .filter(played)
        .map(|tree| tree.root.clone());
    let starts = Starts {
        exact: exact.clone(),
        others: others.collect(),
    };
    let requirements = grow::requirements(program, task);
    let settings = grow::Settings {
        effort: options.effort,
        requirements: &requirements,
        choice: options.choice,
        front: options.front || options.choice != Choice::Knee,
    };
    let heard = |heard: grow::Progress| progress(Stage::Growing(heard.ticks, heard.of));
    grow(&ground, &starts, &settings, &heard).map_err(Unplayable::Unknown)
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

/// No tree is printed that is not proved.
fn refuted(loaded: &Loaded, refuted: &Refuted, evidence: u64) -> Refused {
    if *refuted == Refuted::Empty {
        return nothing(loaded, evidence);
    }
    let message = format!("the tree that was found is not equal to the policy: {refuted}");
    let at = target::end_of_file(loaded);
    let diagnostic = Diagnostic::new(Code::E0609, at, message)
        .note("this is a mistake of btc itself; please report it with the program");
    Refused::program(loaded, [diagnostic])
}

/// A reward such as 0 / 0 makes every comparison of values void.
fn without_value(loaded: &Loaded) -> Refused {
    let why = "the rewards are not finite";
    let help =
        "look for a division by zero, or a root or logarithm of a negative number, under `reward`";
    nothing_learned(loaded, why, help)
}

fn nothing(loaded: &Loaded, evidence: u64) -> Refused {
    let why = format!("no minterm has {evidence} completed decisions");
    let help = "let there be more episodes, or longer ones, or ask for less `--evidence`";
    nothing_learned(loaded, &why, help)
}

fn nothing_learned(loaded: &Loaded, why: &str, help: &str) -> Refused {
    let message = format!("nothing was learned: {why}");
    let diagnostic = Diagnostic::new(Code::E0505, target::end_of_file(loaded), message);
    Refused::program(loaded, [diagnostic.help(help)])
}
