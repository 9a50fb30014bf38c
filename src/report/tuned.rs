//! Tuned numbers in words, as JSON and as pictures.

use super::episodes::Episodes;
use super::json::{self, Named};
use super::words::{counted, line};
use crate::emit::svg;
use crate::ir::task::Task;
use crate::ir::tunable::Tunable;
use crate::ir::{Id, Name, Program};
use crate::learn::statistics::Mean;
use crate::trial::duel::Duel;
use crate::tune::confirm::Confirmed;
use crate::tune::curve::{Curve, Dot};
use crate::tune::{Options, Tuned};
use serde::Serialize;

/// The most rows of a curve.
const ROWS: usize = 30;
/// The longest bar of a curve.
const BAR: f64 = 32.0;

/// A change of the text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Edit {
    /// The file.
    pub file: String,
    /// The line, from one.
    pub line: usize,
    /// The column in characters, from one.
    pub column: usize,
    /// The half-open range of bytes.
    pub bytes: [u32; 2],
    /// What stands there.
    pub text: String,
    /// What is to stand there.
    pub replacement: String,
}

/// What came of learning again under the values that were found.
#[derive(Clone, Debug)]
pub struct Again {
    /// The tree learned under these values against the one learned under those in use, both under these values.
    pub duel: Duel,
}

/// What was tuned, to be reported.
#[derive(Clone, Debug)]
pub struct Report<'a> {
    /// The program under the values in use.
    pub program: &'a Program,
    /// The task.
    pub task: Id<Task>,
    /// The tree.
    pub tree: &'a Name,
    /// How much was searched.
    pub options: Options,
    /// What was found.
    pub tuned: &'a Tuned,
    /// What came of learning again.
    pub again: Option<Again>,
    /// The changes that give the program the values that were found.
    pub edits: Vec<Edit>,
}

impl Report<'_> {
    fn tunables(&self) -> impl Iterator<Item = (&Tunable, &Curve)> {
        let tunables = self.program.tunables.values();
        tunables.zip(&self.tuned.curves)
    }

    /// The report for a person.
    pub fn human(&self) -> String {
        let (searched, pairs) = self.tuned.pairs;
        let mut text = format!(
            "{} of `{}`, {} ticks",
            counted(self.program.tunables.len(), "number"),
            self.tree,
            self.tuned.ticks
        );
        if pairs > 0 {
            text.push_str(&format!(", {searched} of {}", counted(pairs, "pair")));
        }
        text.push('\n');
        for (tunable, curve) in self.tunables() {
            text.push('\n');
            text.push_str(&drawn(tunable, curve));
        }
        text.push('\n');
        for opinion in &self.tuned.opinions {
            self.opinion(opinion, &mut text);
        }
        if self.tuned.untried {
            text.push_str(
                "values were found, and the effort does not go as far as fresh episodes: give it more `--effort`\n",
            );
        } else if self.tuned.curves.iter().all(|curve| !curve.searched) {
            text.push_str("nothing is searched: give it more `--effort`\n");
        } else if self.tuned.opinions.is_empty() {
            text.push_str("no value does better than those in use, with its neighbours\n");
        } else if self.tuned.better().is_none() {
            text.push_str("nothing is proposed: the values in use stay\n");
        }
        if let Some(again) = &self.again {
            let duel = &again.duel;
            let kept = match duel.is_won() {
                true => "this tree is better",
                false => "the tree learned before is kept",
            };
            let learned = format!("{} against the tree learned before; {kept}", compared(duel));
            text.push_str(&line("learned anew", &learned));
            text.push('\n');
        }
        for edit in &self.edits {
            let Edit {
                file, line, column, ..
            } = edit;
            text.push_str(&format!(
                "{file}:{line}:{column}: replace `{}` with `{}`\n",
                edit.text, edit.replacement
            ));
        }
        text
    }

    /// What became of some values on fresh seeds.
    fn opinion(&self, opinion: &Confirmed, text: &mut String) {
        let duel = &opinion.duel;
        let values: Vec<String> = self.changed(opinion).map(|(_, new)| new).collect();
        let verdict = match opinion.holds() {
            true => "better",
            false => "not better",
        };
        let values = values.join(", ");
        let mut say = |title: &str, said: &str| {
            text.push_str(&line(title, said));
            text.push('\n');
        };
        say(
            verdict,
            &format!(
                "{values}: {} on {} fresh episodes",
                compared(duel),
                duel.after.episodes
            ),
        );
        let rates = duel.before.events.iter().zip(&duel.after.events);
        for (event, (was, is)) in self.program.events.values().zip(rates) {
            if was.count != is.count {
                let rates = format!("{:.3} to {:.3} in 1000 ticks", was.per_1000, is.per_1000);
                say(&event.name.to_string(), &rates);
            }
        }
        let (worse, better) = duel.ended;
        if worse + better > 0 {
            let ended =
                format!("{worse} episodes are ended to its loss by `end on`, {better} no longer");
            say("ended", &ended);
        }
        for claim in &opinion.refuted {
            say("refuted", claim);
        }
    }

    /// The numbers that values change, each with what it is then.
    fn changed(&self, opinion: &Confirmed) -> impl Iterator<Item = (&Tunable, String)> {
        let tunables = self.program.tunables.values().zip(&opinion.values);
        let changed = tunables.filter(|(tunable, value)| **value != tunable.value);
        changed.map(|(tunable, value)| {
            let new = format!("{} {}", tunable.name, tunable.written(*value));
            (tunable, new)
        })
    }

    /// The report as a JSON document.
    pub fn json(&self) -> String {
        json::document(&self.document())
    }

    /// The curve of each number as SVG, with the name of its file.
    pub fn pictures(&self) -> Vec<(String, String)> {
        let all = self.tunables().enumerate();
        let searched = all.filter(|(_, (_, curve))| curve.searched);
        searched
            .map(|(number, (tunable, curve))| {
                let dots = curve.dots.iter().map(|dot| svg::sweep::Dot {
                    value: dot.value,
                    mean: dot.gain.mean,
                    interval: dot.gain.ci95,
                    out: dot.out,
                });
                let picture = svg::sweep::sweep(&svg::sweep::Sweep {
                    dots: dots.collect(),
                    unit: &tunable.unit.text,
                    used: tunable.value,
                    best: curve.dots.get(curve.best).map_or(0.0, |dot| dot.value),
                    flat: curve.flat(),
                    caption: &tunable.name,
                });
                (format!("tune_{}.svg", number + 1), picture)
            })
            .collect()
    }

    fn document(&self) -> Document<'_> {
        let task = &self.program.tasks[self.task];
        let episodes = |duel: &Duel| {
            let before = Episodes::new(self.program, task, duel.before.clone());
            (
                before,
                Episodes::new(self.program, task, duel.after.clone()),
            )
        };
        let fought = |duel: &Duel| {
            let (before, after) = episodes(duel);
            Fought {
                gain: duel.gain,
                ended_to_its_loss: duel.ended.0,
                ended_no_longer: duel.ended.1,
                before,
                after,
            }
        };
        let (searched, of) = self.tuned.pairs;
        Document {
            version: env!("CARGO_PKG_VERSION"),
            tree: self.tree,
            task: &task.name,
            seed: self.options.seed,
            effort: self.options.effort,
            ticks: self.tuned.ticks,
            numbers: self.tunables().map(|(t, c)| Number::new(t, c)).collect(),
            pairs: Pairs { searched, of },
            opinions: self
                .tuned
                .opinions
                .iter()
                .map(|opinion| Opinion {
                    values: self
                        .program
                        .tunables
                        .values()
                        .zip(&opinion.values)
                        .map(|(tunable, value)| (tunable.name.clone(), tunable.written(*value)))
                        .collect(),
                    better: opinion.holds(),
                    refuted: &opinion.refuted,
                    fought: fought(&opinion.duel),
                })
                .collect(),
            learned_anew: self.again.as_ref().map(|again| fought(&again.duel)),
            edits: &self.edits,
        }
    }
}

/// `a gain of 1.06 (95 %: 0.98 to 1.14), 2.0 % of the return of 53.1`
pub(super) fn compared(duel: &Duel) -> String {
    let Mean {
        mean,
        ci95: [low, high],
    } = duel.gain;
    let return_ = duel.before.total.mean;
    let gain = format!("a gain of {mean:.3} (95 %: {low:.3} to {high:.3})");
    match super::grown::is_part_of((low, mean, high), return_) {
        true => format!(
            "{gain}, {:+.1} % of {return_:.3}",
            100.0 * mean / return_.abs()
        ),
        false => format!("{gain}, for a return of {return_:.3}"),
    }
}

/// A curve in lines: each value with its gain and a bar, `#` in the flat part.
fn drawn(tunable: &Tunable, curve: &Curve) -> String {
    let written = |at: usize| {
        let dot = curve.dots.get(at);
        dot.map_or(String::new(), |dot| tunable.written(dot.value))
    };
    if !curve.searched {
        let used = written(curve.used);
        return format!(
            "{}: {used} in use, not searched: the effort does not go so far\n",
            tunable.name
        );
    }
    let flat = match curve.flat() {
        Some((from, to)) if from < to => {
            format!(
                ", flat from {} to {}",
                tunable.written(from),
                tunable.written(to)
            )
        }
        _ => String::new(),
    };
    let mut text = format!(
        "{}: {} in use, best {}{flat}\n",
        tunable.name,
        written(curve.used),
        written(curve.best)
    );
    let shown = shown(curve);
    let [low, high] = limits(&curve.dots);
    let width = shown.iter().map(|at| written(*at).chars().count()).max();
    for at in shown {
        let Some(dot) = curve.dots.get(at) else {
            continue;
        };
        let part = ((dot.gain.mean - low) / (high - low).max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        let bar = if dot.flat { "#" } else { "-" }.repeat((part * BAR).round() as usize);
        let mut remarks = Vec::new();
        if at == curve.used {
            remarks.push("in use");
        }
        if at == curve.best && !dot.out {
            remarks.push("best");
        }
        if dot.out {
            remarks.push("out of the question");
        }
        let row = format!(
            "  {:>width$}  {:>+10.3} ± {:<8.3} {bar:<32} {}",
            written(at),
            dot.gain.mean,
            dot.gain.ci95[1] - dot.gain.mean,
            remarks.join(", "),
            width = width.unwrap_or(0)
        );
        text.push_str(row.trim_end());
        text.push('\n');
    }
    text
}

/// The values that are shown: all, or each of a few, with the one in use and the best with its neighbours.
fn shown(curve: &Curve) -> Vec<usize> {
    let number = curve.dots.len();
    let each = number.div_ceil(ROWS).max(1);
    let near = |at: &usize| at.abs_diff(curve.best) <= 1 || *at == curve.used;
    let shown = (0..number).filter(|at| at % each == 0 || *at + 1 == number || near(at));
    shown.collect()
}

/// The ends of the bars: losses as far as four times from the best to the median.
fn limits(dots: &[Dot]) -> [f64; 2] {
    let mut means: Vec<f64> = dots.iter().map(|dot| dot.gain.mean).collect();
    means.sort_by(f64::total_cmp);
    let median = means.get(means.len() / 2).copied().unwrap_or(0.0);
    match (means.first(), means.last()) {
        (Some(low), Some(high)) => {
            let depth = 4.0 * (high - median).max((high - low) / 16.0);
            [low.max(high - depth), *high]
        }
        _ => [0.0, 1.0],
    }
}

#[derive(Serialize)]
struct Document<'a> {
    version: &'a str,
    tree: &'a Name,
    task: &'a Name,
    seed: u64,
    effort: u64,
    ticks: u64,
    numbers: Vec<Number<'a>>,
    pairs: Pairs,
    opinions: Vec<Opinion<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    learned_anew: Option<Fought>,
    edits: &'a [Edit],
}

#[derive(Serialize)]
struct Number<'a> {
    name: &'a str,
    unit: &'a str,
    used: f64,
    low: f64,
    high: f64,
    best: Option<f64>,
    flat: Option<(f64, f64)>,
    curve: Vec<Row>,
}

#[derive(Serialize)]
struct Row {
    value: f64,
    gain: f64,
    ci95: [f64; 2],
    episodes: usize,
    out: bool,
    flat: bool,
}

#[derive(Serialize)]
struct Pairs {
    searched: usize,
    of: usize,
}

#[derive(Serialize)]
struct Opinion<'a> {
    values: Named<String>,
    better: bool,
    refuted: &'a [String],
    #[serde(flatten)]
    fought: Fought,
}

#[derive(Serialize)]
struct Fought {
    gain: Mean,
    ended_to_its_loss: usize,
    ended_no_longer: usize,
    before: Episodes,
    after: Episodes,
}

impl<'a> Number<'a> {
    fn new(tunable: &'a Tunable, curve: &Curve) -> Self {
        let best = curve.dots.get(curve.best).filter(|_| curve.searched);
        let rows = curve.dots.iter().map(|dot| Row {
            value: dot.value,
            gain: dot.gain.mean,
            ci95: dot.gain.ci95,
            episodes: dot.episodes,
            out: dot.out,
            flat: dot.flat,
        });
        Self {
            name: &tunable.name,
            unit: &tunable.unit.text,
            used: tunable.value,
            low: tunable.low,
            high: tunable.high,
            best: best.map(|dot| dot.value),
            flat: curve.flat(),
            curve: rows.collect(),
        }
    }
}
