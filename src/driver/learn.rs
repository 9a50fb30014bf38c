//! `btc learn`: from a checked program to a learned, proved, printed tree.

mod files;
pub mod pipeline;
mod places;
mod warnings;

use super::load::Loaded;
use super::refused::Refused;
use super::{target, world};
use crate::checkpoint::{Forgetful, Keeper};
use crate::diagnostic::{Code, Diagnostic};
use crate::grow::Choice;
use crate::ir::Id;
use crate::ir::task::Learner;
use crate::ir::tree::Tree;
use crate::learn::curve::Point;
use crate::learn::experiment::Experiment;
use crate::policy::Policy;
use crate::report::results::Results;
use crate::tree::decanonicalise::{Care, Method};
use crate::tree::prove::Refuted;
use crate::trial::Unplayable;
pub use pipeline::Unlearned;

/// The ticks of a search for a tree, if nothing else is said.
pub const EFFORT: u64 = 60_000_000;

/// The names of the files that `btc learn` writes; what grows and what is tuned adds others.
pub const NAMES: [&str; 13] = [
    "learned.bt",
    "learned.dot",
    "learned.svg",
    "learned.xml",
    "learned.py",
    "policy.csv",
    "transitions.csv",
    "q.csv",
    "curve.csv",
    "curve.svg",
    "metrics.json",
    "front.svg",
    "tune.json",
];

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
    /// The number of runs, one for each seed from the first on; the best is taken. `None`: one, and for a grown tree as many
    /// more as take a small part of the effort.
    pub seeds: Option<u64>,
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
    /// About how many ticks the search for a tree may simulate, with the runs that nobody asked for.
    pub effort: u64,
    /// The number of greedy episodes that show the transitions of the policy.
    pub roll_outs: u64,
    /// The number of episodes that test the tree.
    pub tests: u64,
    /// The path of the source from the folder of the results.
    pub source: &'o str,
    /// Where the run keeps its states.
    pub keeper: &'o dyn Keeper,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            learner: None,
            seed: None,
            seeds: None,
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
            keeper: &Forgetful,
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
    let results = found(loaded, &experiment, options, progress)?;
    files::written(loaded, options, id, results)
}

/// What a learner of a program finds.
///
/// # Errors
/// Nothing was learned, or the tree was refuted.
pub(super) fn found<'e>(
    loaded: &Loaded,
    experiment: &'e Experiment<'e>,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Results<'e>, Refused> {
    let results = pipeline::learn(experiment, options, progress);
    results.map_err(|why| unlearned(loaded, &why, options.evidence))
}

/// Why nothing was learned, with what may help.
fn unlearned(loaded: &Loaded, why: &Unlearned, evidence: u64) -> Refused {
    match why {
        Unlearned::Nothing => nothing(loaded, evidence),
        Unlearned::WithoutValue => without_value(loaded),
        Unlearned::Refuted(why) => refuted(loaded, why),
        Unlearned::Unknown(atom) => world::unplayable(loaded, Unplayable::Unknown(*atom)),
    }
}

/// No tree is printed that is not proved.
fn refuted(loaded: &Loaded, refuted: &Refuted) -> Refused {
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
    let diagnostic = Diagnostic::new(Code::E0505, target::place_of(loaded, "learn"), message);
    Refused::program(loaded, [diagnostic.help(help)])
}
