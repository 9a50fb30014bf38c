//! What the policy is worth: by the learner, by the decisions of its own roll-outs, and simulated; and why these differ.

use super::results::Results;
use crate::ir::task::{Method, Objective};
use crate::learn::on_policy::OnPolicy;
use crate::learn::rate::ratio;
use crate::learn::statistics::Mean;
use serde::Serialize;

/// The value of an episode at its start, discounted, or the average reward of a time.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Value {
    /// What it is a value of.
    pub objective: String,
    /// What the learner predicts.
    pub learner: f64,
    /// What the frequencies of the policy's own decisions predict.
    pub on_policy: f64,
    /// What the episodes came to.
    pub simulated: Mean,
    /// Whether the tree that is printed is not that of the policy.
    pub is_other: bool,
    /// Why what is predicted and what is simulated differ, where they do.
    pub why: Vec<String>,
}

/// Differences below this part of a value are not explained.
const SLIGHT: f64 = 0.02;

/// The part of the learner's decisions above which cut ones are mentioned.
const MANY_CUT: f64 = 0.01;

impl Value {
    /// The values of the policy that was learned.
    pub fn of<W>(results: &Results<W>) -> Self {
        let learner = results.experiment.learner;
        let own = OnPolicy::of(&results.met, learner.initial);
        let mut value = match learner.objective {
            Objective::Discounted(_) => discounted(results, &own),
            Objective::Average(span) => average(results, &own, span),
        };
        value.why = value.reasons(results);
        value.is_other = results.is_grown();
        value
    }

    /// The values in a line.
    pub fn text(&self) -> String {
        let [low, high] = self.simulated.ci95;
        let whose = match self.is_other {
            true => "; of the policy, not of the tree",
            false => "",
        };
        format!(
            "{:.3} simulated, 95 % [{low:.3}, {high:.3}]; predicted {:.3} on-policy, {:.3} by the learner; {}{whose}",
            self.simulated.mean, self.on_policy, self.learner, self.objective
        )
    }

    /// Whether a prediction is outside of the simulated interval, and by more than a slight part.
    fn differs(&self, predicted: f64) -> bool {
        let Mean { mean, ci95 } = self.simulated;
        let half = ci95[1] - mean;
        (predicted - mean).abs() > half.max(SLIGHT * mean.abs())
    }

    fn reasons<W>(&self, results: &Results<W>) -> Vec<String> {
        let mut why = Vec::new();
        if self.differs(self.on_policy) {
            why.push(
                "what follows a minterm depends on the way there, so that no values of minterms are exact"
                    .to_owned(),
            );
        }
        if self.differs(self.learner) {
            let causes = causes(results).join(", ");
            why.push(format!(
                "the learner met its minterms otherwise than its policy does: {causes}"
            ));
        }
        why
    }
}

/// How learning differs from what the policy does from the task's own starts.
fn causes<W>(results: &Results<W>) -> Vec<String> {
    let (learner, task) = (results.experiment.learner, results.experiment.task);
    let mut causes = Vec::new();
    if learner.start != task.start {
        causes.push("it started elsewhere".to_owned());
    }
    causes.push("it chose at random at times".to_owned());
    if learner.method != Method::Model {
        causes.push("its values are averages over earlier policies, too".to_owned());
    }
    if learner.dwell > 0 {
        causes.push("it kept its choices for longer".to_owned());
    }
    let counts = results.run().map(|run| run.counts).unwrap_or_default();
    let cut = counts.cut as f64 / (counts.cut + counts.decisions).max(1) as f64;
    if cut > MANY_CUT {
        causes.push(format!(
            "the limit of {} ticks cut {:.1} % of its decisions, long ones most",
            learner.episode_ticks,
            100.0 * cut
        ));
    }
    causes
}

fn discounted<W>(results: &Results<W>, own: &OnPolicy) -> Value {
    let worth = &results.met.worth;
    let mean = |value: Vec<f64>| Mean::of(&value);
    let simulated = worth.iter().map(|worth| {
        // What the tick limit cut would have gone on.
        let rest = worth
            .rest
            .map_or(0.0, |(key, weight)| weight * own.value(key));
        worth.simulated + rest
    });
    Value {
        objective: "discounted from the start".to_owned(),
        learner: mean(worth.iter().map(|worth| worth.predicted).collect()).mean,
        on_policy: mean(worth.iter().map(|worth| own.value(worth.start)).collect()).mean,
        simulated: mean(simulated.collect()),
        why: Vec::new(),
        is_other: false,
    }
}

fn average<W>(results: &Results<W>, own: &OnPolicy, span: f64) -> Value {
    let scale = span / results.experiment.tick();
    let episodes = results.met.episodes.iter();
    let simulated = ratio(episodes.map(|e| (e.total, e.ticks as f64)));
    Value {
        objective: format!("average per {span} s"),
        learner: scale * results.run().map_or(0.0, |run| run.table.gain),
        on_policy: scale * own.gain(),
        simulated: Mean {
            mean: scale * simulated.mean,
            ci95: simulated.ci95.map(|end| scale * end),
        },
        why: Vec::new(),
        is_other: false,
    }
}
