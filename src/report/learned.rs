//! The report of `btc learn`.

use super::ends::{EndLine, Ended};
use super::results::Results;
use super::value::Value;
use super::words::{self, numbered};
use crate::learn::binomial::upper95;
use crate::learn::bootstrap::quantile;
use crate::learn::curve::pooled;
use crate::learn::statistics::{Mean, Summary};
use crate::policy::Minterm;
use crate::tree::decanonicalise::{Care, Decanonicalised};

/// The most minterms to list.
const LISTED: usize = 10;

/// The part of a return by which that of a tree differs from that of its policy.
const PART: f64 = 0.02;

/// The report in lines.
pub fn lines<W>(results: &Results<W>) -> Vec<String> {
    let mut report = Report {
        results,
        lines: Vec::new(),
    };
    report.seeds();
    report.learned();
    report.evidence();
    report.tree();
    report.worth();
    report.figures(&results.summary, "greedy episodes");
    report.outside(&results.summary, "in minterms never learned");
    if let Some(grown) = &results.grown {
        let experiment = results.experiment;
        let lines = super::grown::lines(grown, experiment.program, experiment.task);
        report.lines.extend(lines);
        let beside = super::grown::beside(grown, experiment.program, experiment.task);
        if let Some(beside) = beside {
            report.line("beside", beside);
        }
        report.other_than_policy(&grown.before.summary);
    }
    if let Some(tested) = &results.tested {
        report.line(
            "test",
            "the tree on episodes that nothing was chosen by".to_owned(),
        );
        report.figures(tested, "test episodes");
        report.outside(tested, "outside of the care set");
        report.other_than_policy(tested);
    }
    report.failing();
    report.lines
}

struct Report<'a, W> {
    results: &'a Results<'a, W>,
    lines: Vec<String>,
}

impl<W> Report<'_, W> {
    fn line(&mut self, title: &str, text: String) {
        self.lines.push(words::line(title, &text));
    }

    fn minterm(&self, minterm: &Minterm) -> String {
        let results = self.results;
        words::minterm(results.experiment.program, &results.policy.atoms, minterm)
    }

    /// How the runs compare; nothing for a single one.
    fn seeds(&mut self) {
        let results = self.results;
        if results.runs.len() < 2 {
            return;
        }
        let points = pooled(&results.curves());
        let quarters = (1..=4).filter_map(|i| points.get((points.len() * i / 4).checked_sub(1)?));
        for point in quarters {
            let [low, high] = point.total.ci95;
            let text = format!(
                "{:.3}, 95 % [{low:.3}, {high:.3}], after {} episodes: interquartile mean of {} seeds",
                point.total.mean,
                point.episodes,
                point.totals.len()
            );
            self.line("curve", text);
        }
        let runs = results.runs.iter().zip(&results.validated).enumerate();
        for (at, (run, validated)) in runs {
            let [low, high] = validated.total.ci95;
            let ended: u64 = validated.ended.iter().sum();
            let taken = if at == results.best { "; taken" } else { "" };
            let text = format!(
                "{:.3}, 95 % [{low:.3}, {high:.3}], {ended} of {} ended, {} minterms{taken}",
                validated.total.mean,
                validated.episodes,
                run.decisions.len(),
            );
            self.line(&format!("seed {}", run.seed), text);
        }
        self.agreement();
    }

    fn agreement(&mut self) {
        let Some(agreement) = self.results.agreement() else {
            return;
        };
        let text = format!(
            "{:.1} % of the seeds, decision by decision; all in {} of {} reached minterms",
            100.0 * agreement.share,
            agreement.unanimous,
            agreement.reached
        );
        self.line("agreement", text);
        let experiment = self.results.experiment;
        let atoms = self.results.policy.atoms.len();
        for disputed in agreement.disputed.iter().take(LISTED) {
            let votes = disputed.votes.iter();
            let votes = votes.map(|(choice, n)| format!("{} {n}", experiment.choice_name(*choice)));
            let text = format!(
                "{} in {}",
                votes.collect::<Vec<_>>().join(", "),
                self.minterm(&Minterm::of_key(disputed.key, atoms))
            );
            self.line("disputed", text);
        }
    }

    fn learned(&mut self) {
        let Some(run) = self.results.run() else {
            return;
        };
        let text = format!(
            "{} minterms in {} decisions, {} ticks, {} episodes",
            self.results.policy.rows.len(),
            run.counts.decisions,
            run.counts.ticks,
            run.counts.episodes
        );
        self.line("learned", text);
        let improved = self.results.improved;
        if improved.changed > 0 {
            let text = format!(
                "{} decisions changed by simulation, {} ticks",
                improved.changed, improved.ticks
            );
            self.line("improved", text);
        }
    }

    /// The evidence for the policy.
    fn evidence(&mut self) {
        let rows = &self.results.policy.rows;
        let of = |mut values: Vec<f64>| {
            values.sort_by(f64::total_cmp);
            [0.0, 0.5, 1.0].map(|share| quantile(&values, share))
        };
        let [least, median, most] = of(rows.iter().map(|row| row.visits as f64).collect());
        let [small, middle, large] = of(rows.iter().filter_map(|row| row.q_gap()).collect());
        let text = format!(
            "{least:.0} to {most:.0} decisions a minterm, median {median:.0}; Q-gap {small:.3} to {large:.3}, median \
             {middle:.3}"
        );
        self.line("evidence", text);
        let thin = &self.results.thin;
        for (minterm, visits) in thin.iter().take(LISTED) {
            let text = format!(
                "{visits} of {} decisions in {}: a don't-care",
                self.results.experiment.evidence,
                self.minterm(minterm)
            );
            self.line("thin", text);
        }
        if thin.len() > LISTED {
            let text = format!("and {} more, see metrics.json", thin.len() - LISTED);
            self.line("thin", text);
        }
    }

    fn tree(&mut self) {
        let trees = &self.results.trees;
        let found = trees.chosen();
        let alone = found.paper_size.map_or_else(String::new, |paper| {
            format!(
                " (Algorithm 1 alone: {})",
                numbered(paper.nodes as u64, "node")
            )
        });
        let text = format!(
            "{}, depth {}{alone}",
            words::size(&found.size),
            found.size.depth
        );
        self.line("tree", text);
        let of = |found: &Decanonicalised| {
            let (minterms, size) = (found.proof.minterms, &found.size);
            let alone = found.paper_size.map_or_else(String::new, |paper| {
                format!(" (Algorithm 1 alone: {})", paper.nodes)
            });
            let nodes = numbered(size.nodes as u64, "node");
            format!("{minterms} minterms, {nodes}{alone}")
        };
        let (own, other) = match trees.care {
            Care::Seen => ("seen", ("reachable", &trees.reachable)),
            Care::Reachable => ("reachable", ("seen", &trees.seen)),
        };
        let text = format!("{own}: {}; {}: {}", of(found), other.0, of(other.1));
        self.line("care", text);
        self.line("proved", format!("on {}", self.results.proved()));
    }

    /// What the policy is worth, predicted and simulated.
    fn worth(&mut self) {
        let value = Value::of(self.results);
        self.line("value", value.text());
        for why in value.why {
            self.line("", why);
        }
    }

    fn figures(&mut self, summary: &Summary, what: &str) {
        let [low, high] = summary.total.ci95;
        let text = format!(
            "{:.3}, 95 % [{low:.3}, {high:.3}], in {} {what}",
            summary.total.mean, summary.episodes
        );
        self.line("return", text);
        let program = self.results.experiment.program;
        for (event, rate) in program.events.values().zip(&summary.events) {
            let [low, high] = rate.ci95;
            let text = format!(
                "{:.3}, 95 % [{low:.3}, {high:.3}], in 1000 ticks",
                rate.per_1000
            );
            self.line(&event.name.to_string(), text);
        }
        let lines = EndLine::all(program, self.results.experiment.task);
        for end in Ended::all(&lines, summary) {
            let text = format!(
                "{} of {} by {}, {}",
                end.count,
                end.episodes,
                end.name,
                end.bound()
            );
            self.line("ended", text);
        }
    }

    fn outside(&mut self, summary: &Summary, what: &str) {
        if summary.outside > 0 {
            let upper = 100.0 * upper95(summary.outside, summary.ticks);
            let text = format!(
                "{} of {} ticks {what}, at most {upper:.3} % (95 %)",
                summary.outside, summary.ticks
            );
            self.line("outside", text);
        }
    }

    /// That the exact tree surely returns other than the policy whose decisions it takes.
    fn other_than_policy(&mut self, exact: &Summary) {
        let [policy, exact] = [&self.results.summary.total, &exact.total];
        let half = |mean: &Mean| (mean.ci95[1] - mean.ci95[0]) / 2.0;
        let apart = (policy.mean - exact.mean).abs();
        let least = PART * policy.mean.abs().max(exact.mean.abs());
        if self.results.trees.chosen().failing.is_empty()
            || apart <= (2.0 * (half(policy) + half(exact))).max(least)
        {
            return;
        }
        let text = format!(
            "the exact tree returns {:.3} for the {:.3} of its policy: where what both select fails at once, the policy waits for \
             the next tick, and the tree goes on to its next child",
            exact.mean, policy.mean
        );
        self.line("differs", text);
    }

    /// Where the policy was seen to fail outright.
    fn failing(&mut self) {
        let program = self.results.experiment.program;
        let all = &self.results.trees.chosen().failing;
        let tree = match self.results.is_grown() {
            true => "the exact tree",
            false => "the tree",
        };
        for failing in all.iter().take(LISTED) {
            let text = words::failing(program, &self.results.policy, failing, tree);
            self.line("fails", text);
        }
        if let Some(more @ 1..) = all.len().checked_sub(LISTED) {
            let text = format!("and in {} more; `metrics.json` has all of them", more);
            self.line("fails", text);
        }
    }
}
