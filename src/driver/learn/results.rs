//! Everything that learning came to, and the files that it is written to.

use super::bench::{Bench, Run};
use super::{Learned, Options, drawn, metrics, report};
use crate::diagnostic::Diagnostic;
use crate::driver::export::{self, Runtime};
use crate::driver::load::Loaded;
use crate::driver::simplify::Simplified;
use crate::driver::target;
use crate::emit;
use crate::ir::task::Learner;
use crate::ir::tree::{Node, Tree};
use crate::ir::{Id, Name};
use crate::learn::process::Key;
use crate::learn::rollout::RollOut;
use crate::learn::statistics::{Mean, Summary};
use crate::learn::{curve, extract};
use crate::policy::{Minterm, Policy, decisions, evidence, transitions};
use crate::tree::decanonicalise::{Care, Decanonicalised};
use rustc_hash::FxHashSet;

/// Everything that learning came to.
pub(super) struct Results {
    /// The runs, in the order of their seeds.
    pub runs: Vec<Run>,
    /// What each was worth on the episodes by which the best was taken; empty for a single one.
    pub validated: Vec<Summary>,
    /// The place of the run that was taken.
    pub best: usize,
    /// The minterms with too little evidence, with their decisions.
    pub thin: Vec<(Minterm, u64)>,
    /// The greedy policy at work.
    pub met: RollOut,
    /// What came of it.
    pub summary: Summary,
    /// The policy.
    pub policy: Policy,
    /// The tree on either care set; that of the chosen one is what was learned.
    pub trees: Trees,
    /// The smaller tree that is printed in the place of the exact one, if one was asked for.
    pub simplified: Option<Simplified>,
    /// What the exact tree is worth on test episodes, if there were any.
    pub tested: Option<Summary>,
}

/// The policy as a tree, once for each care set.
pub(super) struct Trees {
    /// The set that the learned tree was made for.
    pub care: Care,
    /// With care for every minterm that was learned.
    pub seen: Decanonicalised,
    /// With care for those that the greedy policy reached.
    pub reachable: Decanonicalised,
}

impl Trees {
    /// The learned tree.
    pub fn chosen(&self) -> &Decanonicalised {
        match self.care {
            Care::Seen => &self.seen,
            Care::Reachable => &self.reachable,
        }
    }
}

impl Results {
    /// The run that was taken.
    pub fn run(&self) -> Option<&Run> {
        self.runs.get(self.best)
    }

    /// Predicted and simulated value of the greedy episodes.
    pub fn worth(&self) -> [Mean; 2] {
        let worth = &self.met.worth;
        let of = |value: fn(&crate::learn::rollout::Worth) -> f64| {
            Mean::of(&worth.iter().map(value).collect::<Vec<_>>())
        };
        [of(|w| w.predicted), of(|w| w.simulated)]
    }

    /// What was proved, in words.
    pub fn proved(&self) -> String {
        let proof = &self.trees.chosen().proof;
        let closed = if proof.closed {
            "closed under them"
        } else {
            "not closed under them"
        };
        let seen = self.policy.rows.len();
        let minterms = if proof.minterms == seen {
            format!("{seen} observed minterms")
        } else {
            format!("{} of {seen} observed minterms", proof.minterms)
        };
        format!("{minterms} and {} transitions, {closed}", proof.transitions)
    }

    /// Where the learned tree comes from, as a doc comment.
    fn origin(&self, file: &str) -> String {
        let seed = self.run().map_or(0, |run| run.seed);
        let among = match self.runs.as_slice() {
            [first, .., last] => format!(", the best of {} to {}", first.seed, last.seed),
            _ => String::new(),
        };
        format!(
            "Learned from {file}, seed {seed}{among}: proved on {}.",
            self.proved()
        )
    }
}

/// The minterms in which the tree takes the policy's decisions.
pub(super) fn care_set(care: Care, met: &RollOut, run: &Run) -> FxHashSet<Key> {
    let learned = |key: &Key| run.decisions.contains_key(key);
    match care {
        Care::Seen => run.decisions.keys().copied().collect(),
        Care::Reachable => {
            let next = met.taken.keys().filter_map(|&(.., to)| to);
            let reached = met.starts.keys().copied().chain(next);
            reached.filter(learned).collect()
        }
    }
}

/// The minterms of a run that have too little evidence.
pub(super) fn thin(run: &Run, evidence: u64, atoms: usize) -> Vec<(Minterm, u64)> {
    let found = extract::thin(&run.table, evidence).into_iter();
    let mut thin: Vec<(Minterm, u64)> = found
        .map(|(key, visits)| (Minterm::of_key(key, atoms), visits))
        .collect();
    thin.sort();
    thin
}

/// The tree as an item, the files, and the report.
///
/// # Errors
/// A robot's library has no counterpart for a node of the tree.
pub(super) fn write(
    bench: &Bench,
    loaded: &Loaded,
    options: &Options,
    learner: Id<Learner>,
    results: Results,
) -> Result<Learned, Diagnostic> {
    let program = bench.program;
    let file = options.source.rsplit('/').next().unwrap_or_default();
    let exact = &results.trees.chosen().root;
    let name = &bench.learner.name;
    let named = |name: &Name, docs: &[String], root: &Node| Tree {
        name: name.clone(),
        docs: docs.to_vec(),
        task: Some(bench.learner.task),
        root: root.clone(),
    };
    let mut program_text = format!(
        "//! Written by `btc learn`. The table is what the greedy policy met; proofs go along its paths.\n\
         use \"{}\"\nuse \"transitions.csv\"\n\n",
        options.source
    );
    let mut docs = vec![results.origin(file)];
    let mut root = exact;
    if let Some(simplified) = &results.simplified {
        let exact_name = Name::word(format!("{}_exact", name.family));
        let exact = named(&exact_name, &docs, exact);
        program_text.push_str(&emit::bt::tree(program, &exact));
        program_text.push('\n');
        docs.push(simplified.doc(program, bench.learner.task));
        root = &simplified.root;
    }
    let learned = named(name, &docs, root);
    let tree = emit::bt::tree(program, &learned);
    program_text.push_str(&tree);
    let curves: Vec<_> = results
        .runs
        .iter()
        .map(|run| (run.seed, run.points.clone()))
        .collect();
    let policy = &results.policy;
    let place = |_: &[usize]| target::end_of_file(loaded);
    let exported = |runtime| export::tree(program, &learned, runtime, place);
    let files = vec![
        ("learned.bt", program_text),
        ("learned.dot", emit::dot::tree(program, &learned)),
        ("learned.svg", emit::svg::tree::tree(program, &learned)),
        ("learned.xml", exported(Runtime::BtCpp)?),
        ("learned.py", exported(Runtime::PyTrees)?),
        ("policy.csv", decisions::write(policy, program)),
        ("transitions.csv", transitions::write(policy, program)),
        ("q.csv", evidence::write(policy, program)),
        ("curve.csv", curve::csv(&curves)),
        (
            "curve.svg",
            drawn::learning_curve(&name.to_string(), &curves),
        ),
        (
            "metrics.json",
            metrics::text(bench, loaded, options, &results),
        ),
    ];
    Ok(Learned {
        tree,
        files,
        report: report::lines(bench, &results),
        root: learned.root,
        learner,
        curves,
        policy: results.policy,
    })
}
