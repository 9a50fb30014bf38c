//! `metrics.json`: every figure of the report, and those that are too many for it.

use super::episodes::Episodes;
use super::json::{self, Named};
use super::results::Results;
use super::value::Value;
use super::{grown, words};
use crate::ir::{Name, task};
use crate::learn::agreement::Disputed;
use crate::learn::binomial::upper95;
use crate::learn::improve::Improved;
use crate::learn::statistics::Summary;
use crate::learn::train::Counts;
use crate::policy::Minterm;
use crate::tree::Size;
use crate::tree::decanonicalise::{Care, Decanonicalised, Method};
use serde::Serialize;

/// What a user asked for, with the files of the program.
#[derive(Clone, Copy, Debug)]
pub struct Request<'a> {
    /// The path of the source from the folder of the results.
    pub source: &'a str,
    /// The SHA-256 of every file of the program in hexadecimal digits, by its name without folders.
    pub sha256: &'a [(String, String)],
    /// The warnings on the result, each with its code.
    pub warnings: &'a [(String, String)],
    /// The number of greedy episodes that show the transitions of the policy.
    pub roll_outs: u64,
    /// How the tree is found.
    pub method: Method,
    /// In which minterms the tree takes the policy's decisions.
    pub care: Care,
}

#[derive(Serialize)]
struct Metrics<'a> {
    btc: &'static str,
    source: &'a str,
    sha256: Named<&'a str>,
    task: &'a Name,
    learner: &'a Name,
    learning: task::Method,
    seed: Option<u64>,
    #[serde(flatten)]
    counts: Counts,
    /// What simulation changed in the policy, and the ticks that it took.
    improved: Improved,
    roll_outs: u64,
    method: Method,
    care: Care,
    minterms: usize,
    starts: usize,
    transitions: usize,
    tree: Size,
    paper_tree: Option<Size>,
    proof: Proof,
    warnings: Vec<Warning<'a>>,
    care_sets: CareSets,
    grown: Option<grown::Document<'a>>,
    greedy: Episodes,
    value: Value,
    outside: Outside,
    evidence: Evidence<'a>,
    failing: Vec<Failing<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    test: Option<Test>,
    #[serde(skip_serializing_if = "Option::is_none")]
    seeds: Option<Vec<Seed>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    agreement: Option<Agreement>,
}

/// A warning on the result.
#[derive(Serialize)]
struct Warning<'a> {
    code: &'a str,
    message: &'a str,
}

#[derive(Serialize)]
struct Proof {
    minterms: usize,
    transitions: usize,
    closed: bool,
}

#[derive(Serialize)]
struct CareSets {
    seen: CareSet,
    reachable: CareSet,
}

#[derive(Serialize)]
struct CareSet {
    minterms: usize,
    tree: Size,
    paper_tree: Option<Size>,
}

/// Ticks in minterms that were never learned, or outside of the care set.
#[derive(Serialize)]
struct Outside {
    ticks: u64,
    upper95: f64,
}

#[derive(Serialize)]
struct Test {
    #[serde(flatten)]
    figures: Episodes,
    outside: Outside,
}

/// The evidence for each minterm, and the minterms with too little of it.
#[derive(Serialize)]
struct Evidence<'a> {
    least: u64,
    thin: Vec<Thin>,
    minterms: Vec<Row<'a>>,
}

#[derive(Serialize)]
struct Thin {
    minterm: String,
    visits: u64,
}

#[derive(Serialize)]
struct Row<'a> {
    minterm: String,
    behavior: &'a Name,
    visits: u64,
    q_gap: Option<f64>,
}

#[derive(Serialize)]
struct Failing<'a> {
    minterm: String,
    behavior: &'a Name,
    count: u64,
    repeated: u64,
}

/// A run, with its figures where the best was taken.
#[derive(Serialize)]
struct Seed {
    seed: u64,
    minterms: usize,
    decisions: u64,
    ticks: u64,
    validation: Episodes,
}

#[derive(Serialize)]
struct Agreement {
    reached: usize,
    unanimous: usize,
    share: f64,
    disputed: Vec<Dispute>,
}

#[derive(Serialize)]
struct Dispute {
    minterm: String,
    decisions: u64,
    votes: Named<usize>,
}

/// The figures as a document.
pub fn json(results: &Results, request: &Request) -> String {
    let writer = Writer { results };
    json::document(&writer.metrics(request))
}

struct Writer<'a> {
    results: &'a Results<'a>,
}

impl<'a> Writer<'a> {
    fn metrics(&self, request: &Request<'a>) -> Metrics<'a> {
        let results = self.results;
        let experiment = results.experiment;
        let found = results.trees.chosen();
        let run = results.run();
        let hashes = request.sha256.iter();
        let grown = results.grown.as_ref();
        Metrics {
            btc: env!("CARGO_PKG_VERSION"),
            source: request.source,
            sha256: hashes
                .map(|(name, hash)| (name.clone(), hash.as_str()))
                .collect(),
            task: &experiment.task.name,
            learner: &experiment.learner.name,
            learning: experiment.learner.method,
            seed: run.map(|run| run.seed),
            counts: run.map_or_else(Counts::default, |run| run.counts),
            improved: results.improved,
            roll_outs: request.roll_outs,
            method: request.method,
            care: request.care,
            minterms: results.policy.rows.len(),
            starts: results.policy.starts.len(),
            transitions: results.policy.transitions.len(),
            tree: found.size,
            paper_tree: found.paper_size,
            proof: Proof {
                minterms: found.proof.minterms,
                transitions: found.proof.transitions,
                closed: found.proof.closed,
            },
            warnings: request
                .warnings
                .iter()
                .map(|(code, message)| Warning { code, message })
                .collect(),
            care_sets: CareSets {
                seen: care_set(&results.trees.seen),
                reachable: care_set(&results.trees.reachable),
            },
            grown: grown
                .map(|grown| grown::Document::new(grown, experiment.program, experiment.task)),
            greedy: self.episodes(&results.summary),
            value: Value::of(results),
            outside: outside(&results.summary),
            evidence: self.evidence(),
            failing: self.failing(),
            test: results.tested.as_ref().map(|tested| Test {
                figures: self.episodes(tested),
                outside: outside(tested),
            }),
            seeds: (results.runs.len() > 1).then(|| self.seeds()),
            agreement: self.agreement(),
        }
    }

    fn minterm(&self, minterm: &Minterm) -> String {
        let results = self.results;
        words::minterm(results.experiment.program, &results.policy.atoms, minterm)
    }

    fn episodes(&self, summary: &Summary) -> Episodes {
        let experiment = self.results.experiment;
        Episodes::new(experiment.program, experiment.task, summary.clone())
    }

    fn evidence(&self) -> Evidence<'a> {
        let results = self.results;
        let experiment = results.experiment;
        let thin = results.thin.iter().map(|(minterm, visits)| Thin {
            minterm: self.minterm(minterm),
            visits: *visits,
        });
        let rows = results.policy.rows.iter().map(|row| Row {
            minterm: self.minterm(&row.minterm),
            behavior: &experiment.program.behaviors[row.behavior].name,
            visits: row.visits,
            q_gap: row.q_gap(),
        });
        Evidence {
            least: experiment.evidence,
            thin: thin.collect(),
            minterms: rows.collect(),
        }
    }

    fn failing(&self) -> Vec<Failing<'a>> {
        let program = self.results.experiment.program;
        let failing = self.results.trees.chosen().failing.iter();
        let failing = failing.map(|failing| Failing {
            minterm: self.minterm(&failing.minterm),
            behavior: &program.behaviors[failing.behavior].name,
            count: failing.count,
            repeated: failing.repeated,
        });
        failing.collect()
    }

    fn seeds(&self) -> Vec<Seed> {
        let runs = self.results.runs.iter().zip(&self.results.validated);
        let runs = runs.map(|(run, validated)| Seed {
            seed: run.seed,
            minterms: run.decisions.len(),
            decisions: run.counts.decisions,
            ticks: run.counts.ticks,
            validation: self.episodes(validated),
        });
        runs.collect()
    }

    fn agreement(&self) -> Option<Agreement> {
        let agreement = self.results.agreement()?;
        let atoms = self.results.policy.atoms.len();
        let name = |choice| self.results.experiment.choice_name(choice);
        let dispute = |disputed: &Disputed| Dispute {
            minterm: self.minterm(&Minterm::of_key(disputed.key, atoms)),
            decisions: disputed.count,
            votes: disputed
                .votes
                .iter()
                .map(|&(choice, count)| (name(choice), count))
                .collect(),
        };
        Some(Agreement {
            reached: agreement.reached,
            unanimous: agreement.unanimous,
            share: agreement.share,
            disputed: agreement.disputed.iter().map(dispute).collect(),
        })
    }
}

fn care_set(found: &Decanonicalised) -> CareSet {
    CareSet {
        minterms: found.proof.minterms,
        tree: found.size,
        paper_tree: found.paper_size,
    }
}

fn outside(summary: &Summary) -> Outside {
    Outside {
        ticks: summary.outside,
        upper95: upper95(summary.outside, summary.ticks.max(1)),
    }
}
