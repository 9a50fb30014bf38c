//! `metrics.json`: every figure of the report, and those that are too many for it.

use super::agreed::Agreement;
use super::bench::Bench;
use super::results::Results;
use super::{Options, minterm_text};
use crate::driver::load::Loaded;
use crate::driver::run::{self, Ran};
use crate::ir::task;
use crate::learn::binomial::upper95;
use crate::learn::statistics::{Mean, Summary};
use crate::policy::Minterm;
use crate::tree::Size;
use crate::tree::decanonicalise::{Care, Decanonicalised, Method};
use serde_json::{Value, json};
use sha2::{Digest, Sha256};

/// The figures as text.
pub(super) fn text(bench: &Bench, loaded: &Loaded, options: &Options, results: &Results) -> String {
    let json = Writer { bench, results }.all(loaded, options);
    let mut text = serde_json::to_string_pretty(&json).unwrap_or_default();
    text.push('\n');
    text
}

struct Writer<'a> {
    bench: &'a Bench<'a>,
    results: &'a Results,
}

impl Writer<'_> {
    fn all(&self, loaded: &Loaded, options: &Options) -> Value {
        let Self { bench, results } = *self;
        let found = results.trees.chosen();
        let counts = results
            .run()
            .map_or_else(Default::default, |run| run.counts);
        let [predicted, simulated] = results.worth();
        let mut all = json!({
            "btc": env!("CARGO_PKG_VERSION"),
            "source": options.source,
            "sha256": hashes(loaded),
            "task": bench.task.name,
            "learner": bench.learner.name,
            "learning": match bench.learner.method {
                task::Method::QLearning => "q_learning",
                task::Method::DoubleQ => "double_q",
                task::Method::Model => "model",
            },
            "seed": results.run().map(|run| run.seed),
            "episodes": counts.episodes,
            "decisions": counts.decisions,
            "ticks": counts.ticks,
            "roll_outs": options.roll_outs,
            "method": match options.method {
                Method::Paper => "paper",
                Method::Search => "search",
            },
            "care": match options.care {
                Care::Seen => "seen",
                Care::Reachable => "reachable",
            },
            "minterms": results.policy.rows.len(),
            "starts": results.policy.starts.len(),
            "transitions": results.policy.transitions.len(),
            "tree": size(&found.size),
            "paper_tree": found.paper_size.as_ref().map(size),
            "proof": {
                "minterms": found.proof.minterms,
                "transitions": found.proof.transitions,
                "closed": found.proof.closed,
            },
            "care_sets": {
                "seen": sizes(&results.trees.seen),
                "reachable": sizes(&results.trees.reachable),
            },
            "simplified": results
                .simplified
                .as_ref()
                .map(|simplified| simplified.json(self.bench.program, self.bench.learner.task)),
            "greedy": self.ran(&results.summary),
            "value": { "predicted": mean(&predicted), "simulated": mean(&simulated) },
            "outside": outside(&results.summary),
            "evidence": self.evidence(options.evidence),
            "failing": found.failing.iter().map(|failing| json!({
                "minterm": self.minterm(&failing.minterm),
                "behavior": bench.program.behaviors[failing.behavior].name,
                "count": failing.count,
                "repeated": failing.repeated,
            })).collect::<Vec<_>>(),
        });
        if let (Some(tested), Some(all)) = (&results.tested, all.as_object_mut()) {
            let mut figures = self.ran(tested);
            if let Some(figures) = figures.as_object_mut() {
                figures.insert("outside".to_owned(), outside(tested));
            }
            all.insert("test".to_owned(), figures);
        }
        if let (true, Some(all)) = (results.runs.len() > 1, all.as_object_mut()) {
            all.insert("seeds".to_owned(), self.seeds());
            all.insert("agreement".to_owned(), self.agreement());
        }
        all
    }

    fn minterm(&self, minterm: &Minterm) -> String {
        minterm_text(self.bench.program, &self.results.policy, minterm)
    }

    fn ran(&self, summary: &Summary) -> Value {
        let program = self.bench.program;
        let ran = Ran {
            summary: summary.clone(),
            events: program
                .events
                .values()
                .map(|e| e.name.to_string())
                .collect(),
            ends: run::end_names(program, self.bench.task),
        };
        ran.json()
    }

    /// What stands behind each minterm; those with too little of it.
    fn evidence(&self, least: u64) -> Value {
        let rows = self.results.policy.rows.iter().map(|row| {
            json!({
                "minterm": self.minterm(&row.minterm),
                "behavior": self.bench.program.behaviors[row.behavior].name,
                "visits": row.visits,
                "q_gap": row.q_gap(),
            })
        });
        let thin =
            self.results.thin.iter().map(
                |(minterm, visits)| json!({ "minterm": self.minterm(minterm), "visits": visits }),
            );
        json!({
            "least": least,
            "thin": thin.collect::<Vec<_>>(),
            "minterms": rows.collect::<Vec<_>>(),
        })
    }

    /// Each run with what it came to where the best was taken.
    fn seeds(&self) -> Value {
        let runs = self.results.runs.iter().zip(&self.results.validated);
        let runs = runs.map(|(run, validated)| {
            json!({
                "seed": run.seed,
                "minterms": run.decisions.len(),
                "decisions": run.counts.decisions,
                "ticks": run.counts.ticks,
                "validation": self.ran(validated),
            })
        });
        Value::Array(runs.collect())
    }

    fn agreement(&self) -> Value {
        let Some(agreement) = Agreement::of(self.bench, self.results) else {
            return Value::Null;
        };
        let disputed = agreement.disputed.iter().map(|disputed| {
            let votes = disputed.votes.iter();
            let votes = votes.map(|(name, count)| (name.clone(), Value::from(*count)));
            json!({
                "minterm": self.minterm(&disputed.minterm),
                "decisions": disputed.count,
                "votes": Value::Object(votes.collect()),
            })
        });
        json!({
            "reached": agreement.reached,
            "unanimous": agreement.unanimous,
            "share": agreement.share,
            "disputed": disputed.collect::<Vec<_>>(),
        })
    }
}

fn size(size: &Size) -> Value {
    json!({ "nodes": size.nodes, "literals": size.literals, "depth": size.depth })
}

/// The sizes on one care set.
fn sizes(found: &Decanonicalised) -> Value {
    json!({
        "minterms": found.proof.minterms,
        "tree": size(&found.size),
        "paper_tree": found.paper_size.as_ref().map(size),
    })
}

fn mean(mean: &Mean) -> Value {
    json!({ "mean": mean.mean, "ci95": mean.ci95 })
}

fn outside(summary: &Summary) -> Value {
    json!({
        "ticks": summary.outside,
        "upper95": upper95(summary.outside, summary.ticks.max(1)),
    })
}

/// The SHA-256 of every file of the program, by its name without folders.
fn hashes(loaded: &Loaded) -> Value {
    let files = loaded.files.iter().filter_map(|id| loaded.sources.get(*id));
    let hashes = files.map(|source| {
        let name = source
            .name
            .rsplit('/')
            .next()
            .unwrap_or_default()
            .to_owned();
        let digest = Sha256::digest(source.text.as_bytes());
        let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        (name, Value::String(hex))
    });
    Value::Object(hashes.collect())
}
