//! `btc learn`: from a checked program to a learned, proved, printed tree.

mod agreed;
mod bench;
mod drawn;
mod elect;
mod metrics;
mod report;
mod results;

use super::load::Loaded;
use super::{run, simplify, target};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::program::Event;
use crate::ir::task::{ClaimKind, Learner, TreeRef};
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::curve::Point;
use crate::learn::extract;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::policy::Policy;
use crate::tree::decanonicalise::{self, Care, Method};
use bench::{Bench, Run};
use rayon::prelude::*;
use results::{Results, Trees};
use std::sync::atomic::{AtomicU64, Ordering};

/// What a user may say beside the program.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// Which learner, if there are several.
    pub learner: Option<&'o str>,
    /// In the place of the learner's own.
    pub seed: Option<u64>,
    /// How many runs, with this seed and those that follow it; the best is taken.
    pub seeds: u64,
    /// In the place of the learner's own.
    pub episodes: Option<u64>,
    /// The fewest decisions by which a minterm counts as learned; below, it is a don't-care.
    pub evidence: u64,
    /// How the tree is found.
    pub method: Method,
    /// In which minterms the tree takes the policy's decisions.
    pub care: Care,
    /// The part of the exact tree's return that a smaller tree may cost; `None` for the exact tree.
    pub simplify: Option<f64>,
    /// How many greedy episodes show the transitions of the policy.
    pub roll_outs: u64,
    /// How many episodes test the tree.
    pub tests: u64,
    /// The path of the source from the folder of the results.
    pub source: &'o str,
}

/// How far the learning has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning: this many of so many episodes are done, over all runs.
    Learning(u64, u64),
    /// Finding the best of several runs.
    Validating,
    /// Rolling the greedy policy out.
    RollingOut,
    /// Turning it into a tree, and proving.
    Proving,
    /// Simplifying the tree.
    Simplifying,
    /// Testing the tree.
    Testing,
}

/// What was learned.
#[derive(Clone, Debug)]
pub struct Learned {
    /// The tree as an item of the language.
    pub tree: String,
    /// The files to write, by name.
    pub files: Vec<(&'static str, String)>,
    /// What a person wants to know, in lines.
    pub report: Vec<String>,
    /// The tree.
    pub root: Node,
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
) -> Result<Learned, Diagnostic> {
    let program = &loaded.program;
    let learner_id = target::learner(loaded, options.learner)?;
    let learner = &program.learners[learner_id];
    let task = &program.tasks[learner.task];
    let seed = options.seed.unwrap_or(learner.seed);
    let simulator = run::build(loaded, learner.task, &[&learner.start, &task.start], &[])?;
    let bench = Bench {
        program,
        learner,
        task,
        simulator: &simulator,
        episodes: options.episodes.unwrap_or(learner.episodes),
        evidence: options.evidence,
        never: never(program, learner_id),
    };
    let runs = learn_all(&bench, seed, options.seeds, progress);
    progress(Stage::Validating);
    let (best, validated) = best(&bench, seed, &runs);
    let Some(run) = runs.get(best) else {
        return Err(nothing(loaded, options.evidence));
    };
    progress(Stage::RollingOut);
    let stream = (Purpose::RollOut, run.seed);
    let (met, summary) = bench.roll_out(&run.decisions, options.roll_outs, stream);
    let atoms = program.atoms(learner.task);
    let thin = results::thin(run, options.evidence, atoms.len());
    let policy = extract::policy(&run.decisions, &run.table, &met, task, atoms);
    let values = policy
        .rows
        .iter()
        .flat_map(|row| row.values.iter().flatten());
    if values.into_iter().any(|value| !value.q.is_finite()) {
        return Err(without_value(loaded));
    }
    progress(Stage::Proving);
    let tree = |care| {
        let asked = decanonicalise::Options {
            method: options.method,
            care,
            ..decanonicalise::Options::default()
        };
        decanonicalise::decanonicalise(&policy, &asked)
            .map_err(|refuted| refused(loaded, &refuted, options.evidence))
    };
    let (seen, reachable) = rayon::join(|| tree(Care::Seen), || tree(Care::Reachable));
    let trees = Trees {
        care: options.care,
        seen: seen?,
        reachable: reachable?,
    };
    let exact = &trees.chosen().root;
    let simplified = match options.simplify {
        None => None,
        Some(loss) => {
            let heard = |_| progress(Stage::Simplifying);
            Some(simplify::simplify(
                loaded,
                learner.task,
                exact,
                loss,
                seed,
                &heard,
            )?)
        }
    };
    let tested = if options.tests > 0 {
        progress(Stage::Testing);
        let care = results::care_set(options.care, &met, run);
        let tested = bench.test(&trees.chosen().root, &care, options.tests, seed);
        Some(tested.map_err(|atom| run::internal(loaded, &program.atom_name(atom).to_string()))?)
    } else {
        None
    };
    let results = Results {
        runs,
        validated,
        best,
        thin,
        met,
        summary,
        policy,
        trees,
        simplified,
        tested,
    };
    results::write(&bench, loaded, options, learner_id, results)
}

/// The runs of so many seeds, on all threads.
fn learn_all(bench: &Bench, seed: u64, seeds: u64, progress: &(dyn Fn(Stage) + Sync)) -> Vec<Run> {
    let all = bench.episodes.saturating_mul(seeds);
    let done = AtomicU64::new(0);
    let episode = || {
        let done = done.fetch_add(1, Ordering::Relaxed) + 1;
        progress(Stage::Learning(done, all));
    };
    let seeds = seed..seed.saturating_add(seeds);
    seeds
        .into_par_iter()
        .map(|seed| bench.learn(seed, episode))
        .collect()
}

/// The best of several runs on common episodes that none of them learned from; with what each came to there.
fn best(bench: &Bench, seed: u64, runs: &[Run]) -> (usize, Vec<Summary>) {
    if runs.len() < 2 {
        return (0, Vec::new());
    }
    let stream = (Purpose::Validate, seed);
    let validate = |run: &Run| bench.validate(&run.decisions, stream);
    let validated: Vec<Summary> = runs.iter().map(validate).collect();
    (bench.best(&validated), validated)
}

/// The events that the program claims never to happen under what a learner learns.
fn never(program: &Program, learner: Id<Learner>) -> Vec<Id<Event>> {
    let claims = program.claims.iter();
    claims
        .filter_map(|claim| match &claim.kind {
            ClaimKind::Never(occurrence) if claim.tree == TreeRef::Learned(learner) => {
                Some(occurrence.event)
            }
            _ => None,
        })
        .collect()
}

/// The atoms that hold in a minterm.
pub(super) fn minterm_text(
    program: &Program,
    policy: &Policy,
    minterm: &crate::policy::Minterm,
) -> String {
    let held: Vec<String> = policy
        .atoms
        .iter()
        .zip(minterm.values())
        .filter(|(_, holds)| *holds)
        .map(|(atom, _)| program.atom_name(*atom).to_string())
        .collect();
    if held.is_empty() {
        "{}".to_owned()
    } else {
        format!("{{{}}}", held.join(", "))
    }
}

/// Nothing is printed unproved.
fn refused(loaded: &Loaded, refuted: &crate::tree::prove::Refuted, evidence: u64) -> Diagnostic {
    let at = target::end_of_file(loaded);
    match refuted {
        crate::tree::prove::Refuted::Empty => nothing(loaded, evidence),
        other => Diagnostic::new(
            Code::E0609,
            at,
            format!("the tree that was found is not equal to the policy: {other:?}"),
        )
        .note("this is a mistake of btc itself; please report it with the program"),
    }
}

/// A reward such as 0 / 0 makes every comparison of values void.
fn without_value(loaded: &Loaded) -> Diagnostic {
    Diagnostic::new(
        Code::E0505,
        target::end_of_file(loaded),
        "nothing was learned: the rewards come to no finite number",
    )
    .help(
        "look for a division by zero, or a root or logarithm of a negative number, under `reward`",
    )
}

fn nothing(loaded: &Loaded, evidence: u64) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::E0505,
        target::end_of_file(loaded),
        format!("nothing was learned: no minterm has {evidence} completed decisions"),
    );
    diagnostic.help("let there be more episodes, or longer ones, or ask for less `--evidence`")
}
