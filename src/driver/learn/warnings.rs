//! What a person should know of a result before they trust it.

use super::places::Places;
use crate::check;
use crate::diagnostic::{Code, Diagnostic};
use crate::driver::load::Loaded;
use crate::driver::target;
use crate::ir::law::Behavior;
use crate::ir::program::Event;
use crate::ir::task::{RewardLine, Task};
use crate::ir::tree::Tree;
use crate::ir::{Expr, ExprId, Id, Program};
use crate::learn::curve::Point;
use crate::learn::poisson::interval95;
use crate::learn::statistics::Mean;
use crate::report::ends::{EndLine, Ended};
use crate::report::results::Results;
use crate::report::words;

/// Decisions for a behaviour that are enough to see whether it ever succeeds.
const TRIED: u64 = 20;

/// How much more frequent an end has to be than in training.
const MORE: f64 = 3.0;

/// The part of ticks or decisions without evidence that is too much.
const UNKNOWN: f64 = 0.01;

/// The part of the last return that the last quarter of a curve may gain.
const RISE: f64 = 0.02;

/// The warnings on what was learned, each at its place in the program.
pub(super) fn warnings(loaded: &Loaded, results: &Results) -> Vec<Diagnostic> {
    let experiment = results.experiment;
    let warner = Warner {
        program: experiment.program,
        task: experiment.task,
        places: Places::of(loaded, experiment.learner, experiment.task),
        results,
    };
    let Some(run) = results.run() else {
        return Vec::new();
    };
    // What training never met may be met since.
    let total = &results.printed().summary.total;
    let pays = total.mean != 0.0 || total.ci95 != [0.0, 0.0];
    if !run.record.rewarded && !pays {
        return vec![warner.worthless()];
    }
    let mut found = warner.never_succeeded();
    found.extend(warner.never_happened());
    found.extend(warner.given_up());
    found.extend(warner.more_ends());
    found.extend(warner.little_evidence());
    found.extend(warner.rising(&run.points));
    found.extend(warner.repeated());
    if results.grown.is_some() {
        found.extend(warner.left_out());
    }
    found
}

struct Warner<'a> {
    program: &'a Program,
    task: &'a Task,
    places: Places<'a>,
    results: &'a Results<'a>,
}

impl Warner<'_> {
    fn worthless(&self) -> Diagnostic {
        let message = "no transition had a reward other than 0, so any tree is as good as this one";
        Diagnostic::new(Code::W0505, self.places.rewards(), message)
            .label("nothing here was ever paid")
    }

    /// Behaviours that could succeed and never did.
    fn never_succeeded(&self) -> Vec<Diagnostic> {
        let record = self.results.run().map(|run| &run.record);
        let tried = record.map_or(&[][..], |record| &record.tried);
        let behaviors = self.task.choose.iter().zip(tried).enumerate();
        let never = behaviors.filter(|(_, (id, tried))| {
            let law = self.program.behaviors[**id].law.as_ref();
            let succeeds = law.is_some_and(|law| !self.is_false(law.succeed));
            succeeds && tried.count >= TRIED && tried.succeeded == 0
        });
        let warning = |(at, (id, tried)): (usize, (&Id<_>, &crate::learn::record::Tried))| {
            let name = &self.program.behaviors[*id].name;
            let message = format!(
                "`{name}` was tried {} times in training and never succeeded",
                tried.count
            );
            let others = tried.count - tried.failed;
            Diagnostic::new(Code::W0502, self.places.choice(at), message)
                .label("the robot may be unable to do this")
                .note(format!(
                    "it failed {} times; {others} times another decision was due before it had ended",
                    tried.failed
                ))
        };
        never.map(warning).collect()
    }

    fn is_false(&self, id: ExprId) -> bool {
        matches!(self.program.pool.get(id), Expr::Bool(false))
    }

    /// The lines that pay for an event, with the event.
    fn paying(&self) -> impl Iterator<Item = (usize, &RewardLine, Id<Event>)> {
        let lines = self.task.reward.iter().enumerate();
        lines.filter_map(|(at, line)| {
            let pays = match self.program.pool.get(line.value) {
                Expr::Num(value) => value > 0.0,
                _ => check::least(self.program, line.value) >= 0.0,
            };
            match self.program.pool.get(line.event) {
                Expr::Event(event) if pays => Some((at, line, event)),
                _ => None,
            }
        })
    }

    /// How often an event happened in training, and under the tree.
    fn happened(&self, event: Id<Event>) -> [u64; 2] {
        let run = self.results.run();
        let trained = run.and_then(|run| run.record.events.get(event.index()));
        let under = self.results.printed().summary.events.get(event.index());
        [
            trained.copied().unwrap_or(0),
            under.map_or(0, |rate| rate.count),
        ]
    }

    /// Events that would be rewarded and never happened at all.
    fn never_happened(&self) -> Vec<Diagnostic> {
        let never = self
            .paying()
            .filter(|(_, _, event)| self.happened(*event) == [0, 0]);
        let warning = |(at, _, event): (usize, &RewardLine, Id<Event>)| {
            let name = &self.program.events[event].name;
            let ends = self.task.end_on.iter();
            let mut ends = ends.map(|id| self.program.pool.get(*id) == Expr::Event(event));
            let code = Code::W0503;
            match ends.position(|is| is) {
                Some(line) => {
                    let message = format!(
                        "no episode reached `{name}`, neither in training nor under the tree"
                    );
                    Diagnostic::new(code, self.places.end(line), message)
                        .label("no start that was met leads to this goal")
                }
                None => {
                    let message =
                        format!("`{name}` never happened, neither in training nor under the tree");
                    Diagnostic::new(code, self.places.reward(at), message)
                        .label("this reward was never paid")
                }
            }
        };
        never.map(warning).collect()
    }

    /// Events that would be rewarded, happened in training, and do not happen under the tree.
    fn given_up(&self) -> Vec<Diagnostic> {
        let paying: Vec<(usize, Id<Event>, [u64; 2])> = self
            .paying()
            .map(|(at, _, event)| (at, event, self.happened(event)))
            .collect();
        let given_up = paying
            .iter()
            .filter(|(.., [trained, under])| *trained > 0 && *under == 0);
        let summary = &self.results.printed().summary;
        let warning = |(at, event, [trained, _]): &(usize, Id<Event>, [u64; 2])| {
            let name = &self.program.events[*event].name;
            let message = format!(
                "`{name}` happened {trained} times in training and never in {} episodes of the tree",
                summary.episodes
            );
            Diagnostic::new(Code::W0504, self.places.reward(*at), message)
        };
        let given_up = given_up.map(warning);
        let earns = summary.total.mean > 0.0 || paying.iter().any(|(.., [_, under])| *under > 0);
        if earns {
            let label = |it: Diagnostic| it.label("the tree gives this reward up");
            return given_up.map(label).collect();
        }
        // Where it is given up as a whole, that is one thing to know.
        let mut given_up = given_up;
        let Some(first) = given_up.next() else {
            return Vec::new();
        };
        let others = given_up.map(|it| it.message);
        let first = first.label("the tree earns nothing");
        let all = others.fold(first, Diagnostic::note);
        let help = "learning begins with the trees of the file, too: a simple one by hand that earns something shows it a way";
        vec![all.help(help)]
    }

    /// Ends that are far more frequent than they were in training.
    fn more_ends(&self) -> Vec<Diagnostic> {
        let summary = self.results.printed().summary;
        let Some(run) = self.results.run() else {
            return Vec::new();
        };
        let record = &run.record;
        let lines = EndLine::all(self.program, self.task);
        let ends = Ended::all(&lines, summary);
        let ends = ends.iter().enumerate().filter(|(_, end)| !end.is_goal);
        let warning = |(at, end): (usize, &Ended)| {
            let trained = record.ended.get(at).copied().unwrap_or(0);
            let least = interval95(end.count)[0] / summary.ticks.max(1) as f64;
            let most = interval95(trained)[1] / record.ticks.max(1) as f64;
            (least > MORE * most).then(|| {
                let message = format!(
                    "`{}` ended {} of {} episodes under the tree, and {trained} in training",
                    end.name, end.count, end.episodes,
                );
                Diagnostic::new(Code::W0506, self.places.end(at), message)
                    .label("training hardly met this")
                    .note(format!(
                        "{} and {} ticks were simulated for these figures",
                        summary.ticks, record.ticks
                    ))
                    .help("let episodes of training be longer, or start nearer to this end")
            })
        };
        ends.filter_map(warning).collect()
    }

    /// Ticks and decisions in minterms of which too little is known.
    fn little_evidence(&self) -> Vec<Diagnostic> {
        let results = self.results;
        let mut found = Vec::new();
        let mut warn = |message: String, label: &str| {
            let warning = Diagnostic::new(Code::W0507, self.places.learner, message);
            found.push(warning.label(label));
        };
        let summary = &results.summary;
        let outside = summary.outside as f64 / summary.ticks.max(1) as f64;
        if outside > UNKNOWN {
            let message = format!(
                "the policy spends {:.1} % of its ticks in minterms that were not learned",
                100.0 * outside
            );
            warn(message, "there it does what `unseen` says");
        }
        let met = results.met.decisions();
        let all: u64 = met.values().sum();
        let least = results.experiment.evidence;
        let thin: u64 = results
            .policy
            .rows
            .iter()
            .filter(|row| {
                let behaviors = &results.policy.behaviors;
                let choice = behaviors.iter().position(|id| *id == row.behavior);
                let value = choice.and_then(|at| row.values.get(at)?.as_ref());
                value.is_some_and(|value| value.visits < least)
            })
            .filter_map(|row| met.get(&row.minterm.key()))
            .sum();
        let part = thin as f64 / all.max(1) as f64;
        if part > UNKNOWN {
            let message = format!(
                "{:.1} % of the policy's decisions rest on fewer than {least} of training each",
                100.0 * part
            );
            warn(message, "more episodes, or more exploration, would tell");
        }
        found
    }

    /// A curve that still rises as learning ends.
    fn rising(&self, points: &[Point]) -> Option<Diagnostic> {
        let quarter = points.len() / 4;
        let quarter = (quarter >= 2).then_some(quarter)?;
        let last = points.get(points.len() - quarter..)?;
        let before = points.get(points.len() - 2 * quarter..points.len() - quarter)?;
        let mean =
            |points: &[Point]| Mean::of(&points.iter().map(|p| p.total.mean).collect::<Vec<_>>());
        let (before, last) = (mean(before), mean(last));
        let rise = last.mean - before.mean;
        let sure = last.ci95[0] > before.ci95[1];
        (sure && rise > RISE * last.mean.abs()).then(|| {
            let message = format!(
                "the curve still rises: {:.3} in the last quarter of the episodes, {:.3} in the one before",
                last.mean, before.mean
            );
            Diagnostic::new(Code::W0507, self.places.learner, message)
                .label("more episodes may learn more")
        })
    }

    /// Behaviours that fail again and again while nothing changes that the policy could see. A grown tree decides otherwise,
    /// and goes on to something else where one fails.
    fn repeated(&self) -> Vec<Diagnostic> {
        let exact = &self.results.trees.chosen().root;
        let grown = self.results.grown.as_ref().map(|grown| &grown.root);
        if self.task.history.failure || grown.is_some_and(|grown| grown != exact) {
            return Vec::new();
        }
        let failing = self.results.trees.chosen().failing.iter();
        let often = self.results.summary.episodes.max(TRIED);
        let repeated: Vec<_> = failing.filter(|it| it.repeated >= often).collect();
        let warning = |(at, behavior): (usize, &Id<Behavior>)| {
            let of_it = || repeated.iter().filter(|it| it.behavior == *behavior);
            let failing = of_it().rev().max_by_key(|it| it.repeated)?;
            let name = &self.program.behaviors[failing.behavior].name;
            let message = format!(
                "`{name}` failed {} times in {} with nothing changed that the policy sees",
                failing.repeated,
                words::minterm(self.program, &self.results.policy.atoms, &failing.minterm),
            );
            let diagnostic = Diagnostic::new(Code::W0508, self.places.choice(at), message)
                .label("the policy tries this again at once")
                .help(format!(
                    "with `history last {} success, failure` it can see that this has failed",
                    self.task.history.window.max(1)
                ));
            Some(match of_it().count() - 1 {
                0 => diagnostic,
                others => diagnostic.note(format!(
                    "so it does in {}",
                    words::counted(others, "other minterm")
                )),
            })
        };
        let choices = self.task.choose.iter().enumerate();
        choices.filter_map(warning).collect()
    }

    /// Trees for the task that do what its policy cannot. A part of another tree is told with that.
    fn left_out(&self) -> Vec<Diagnostic> {
        let of = self.results.experiment.learner.task;
        let trees = self.program.trees.values();
        let parts = target::used_trees(self.places.loaded);
        let whole = |tree: &&Tree| !parts.contains(&tree.name.family.as_str());
        let trees = trees.filter(|tree| tree.task == Some(of)).filter(whole);
        let warning = |tree: &Tree| {
            let behavior = &self.program.behaviors[self.task.lacks(tree)?].name;
            let name = &tree.name;
            if let Some((_, stand_ins)) = self.task.fitted(self.program, tree) {
                let (lacking, other) = *stand_ins.first()?;
                let [lacking, other] = [lacking, other].map(|id| &self.program.behaviors[id].name);
                let message = format!("learning takes `{other}` for `{lacking}` in `{name}`");
                return Some(
                    Diagnostic::new(Code::W0523, self.places.tree(name), message)
                        .label(format!(
                            "it does `{lacking}`, which the task does not choose among"
                        ))
                        .note("so it is changed where trees grow from it and where it is compared")
                        .help(format!("list `{lacking}` under `choose`")),
                );
            }
            let message = format!("learning leaves `{name}` out");
            let label = format!("it does `{behavior}`, which the task does not choose among");
            Some(
                Diagnostic::new(Code::W0523, self.places.tree(name), message)
                    .label(label)
                    .note("no tree grows from it, and what is learned is not compared with it")
                    .help(format!("list `{behavior}` under `choose`")),
            )
        };
        trees.filter_map(warning).collect()
    }
}
