//! A grown tree in words and figures.

use super::ends::{EndLine, Ended};
use super::episodes::Episodes;
use super::words::{line, numbered};
use crate::emit::svg;
use crate::grow::{Figures, Grown, Point};
use crate::ir::Program;
use crate::ir::task::Task;
use crate::learn::statistics::{Mean, ROUNDING};
use crate::tree::Size;
use serde::Serialize;

/// The second line of the tree's doc comment, after what was proved of the exact tree.
pub fn doc(grown: &Grown, program: &Program, task: &Task) -> String {
    let (before, after) = (&grown.before, &grown.after);
    if grown.is_exact() {
        return format!(
            "No better tree was found in {} ticks than this one, the exact one.",
            grown.ticks
        );
    }
    let ended = ended(program, task, after);
    let ended: Vec<String> = ended
        .iter()
        .map(|ended| {
            format!(
                "{} ended by {} ({})",
                ended.count,
                ended.name,
                ended.bound()
            )
        })
        .collect();
    let ended = match ended.is_empty() {
        true => String::new(),
        false => format!("; {}", ended.join(", ")),
    };
    let [alike, all] = grown.alike;
    format!(
        "That is the exact tree, of {}. This one, of {}, was grown and selects the same as the exact one in {alike} of \
         {all} minterms. It is tested, not proved: on {} fresh episodes it returns {:.2}, the exact tree {:.2}, {}{ended}.",
        numbered(before.size.nodes as u64, "node"),
        after.size.nodes,
        after.summary.episodes,
        after.summary.total.mean,
        before.summary.total.mean,
        verdict(grown),
    )
}

/// `a gain of 0.42 % (95 %: 0.30 to 0.54 %)`, `a loss of 0.1 % (95 %: a gain of 0.2 to a loss of 0.4 %)`.
fn verdict(grown: &Grown) -> String {
    change(grown.gain, grown.before.summary.total.mean)
}

/// Whether a gain, with the ends of its interval, is well said as a part of a return: a part of one near zero, or of one that is
/// left far behind, says nothing.
pub(super) fn is_part_of((low, mean, high): (f64, f64, f64), over: f64) -> bool {
    over.abs() >= 10.0 * (high - low) / 2.0 && mean.abs() <= over.abs()
}

/// A gain over this return, or a loss.
fn change(gain: Mean, over: f64) -> String {
    let total = over.abs();
    let least = ROUNDING * total;
    if gain.mean.abs() <= least && gain.ci95.iter().all(|end| end.abs() <= least) {
        return "no difference in any of them".to_owned();
    }
    let (word, other, sign) = if gain.mean < 0.0 {
        ("loss", "gain", -1.0)
    } else {
        ("gain", "loss", 1.0)
    };
    let mut ends = gain.ci95.map(|end| sign * end);
    ends.sort_by(f64::total_cmp);
    let [low, high] = ends;
    let mean = sign * gain.mean;
    let (scale, places, percent) = match is_part_of((low, mean, high), total) {
        true => (100.0 / total, 2, " %"),
        false => (1.0, 3, ""),
    };
    let figure = |value: f64| format!("{:.places$}", scale * value);
    let (mean, high) = (figure(mean), figure(high));
    let between = match low < 0.0 {
        true => format!("a {other} of {} to a {word} of {high}", figure(-low)),
        false => format!("{} to {high}", figure(low)),
    };
    format!("a {word} of {mean}{percent} (95 %: {between}{percent})")
}

/// What the best tree of the file does on the same episodes: `hand, of 18 nodes, returns 137.240; against it, a loss of …`.
pub fn beside(grown: &Grown, program: &Program, task: &Task) -> Option<String> {
    let beside = grown.beside.as_ref()?;
    let figures = &beside.figures;
    let total = &figures.summary.total;
    let ends = ended(program, task, figures);
    let often = Ended::often(&ends, "its episodes").map(|often| format!(", and {often}"));
    let often: Vec<String> = often.collect();
    Some(format!(
        "`{}`, of {}, returns {:.3}{}; against it, {}",
        beside.name,
        numbered(figures.size.nodes as u64, "node"),
        total.mean,
        often.concat(),
        change(beside.gain, total.mean)
    ))
}

/// Lines for a person.
pub fn lines(grown: &Grown, program: &Program, task: &Task) -> Vec<String> {
    let (before, after) = (&grown.before, &grown.after);
    let found = match grown.kept {
        true => "no tree, the exact one is kept".to_owned(),
        false => format!(
            "{}, the exact tree has {}; {}, the exact tree has {}; tested, not proved",
            numbered(after.size.nodes as u64, "node"),
            before.size.nodes,
            numbered(after.size.literals as u64, "literal"),
            before.size.literals,
        ),
    };
    let returns = format!(
        "{:.3}, the exact tree {:.3}, {}, in {} fresh episodes",
        after.summary.total.mean,
        before.summary.total.mean,
        verdict(grown),
        after.summary.episodes
    );
    let mut lines = vec![
        line(
            "grown",
            &format!("{found}; {} ticks of search", grown.ticks),
        ),
        line("return", &returns),
    ];
    let rates = before.summary.events.iter().zip(&after.summary.events);
    for (event, (was, is)) in program.events.values().zip(rates) {
        let text = format!(
            "{:.3} in 1000 ticks, the exact tree {:.3}",
            is.per_1000, was.per_1000
        );
        lines.push(line(&event.name.to_string(), &text));
    }
    let (was, is) = (ended(program, task, before), ended(program, task, after));
    for (was, is) in was.iter().zip(is) {
        let text = format!(
            "{} of {} by {}, {}, the exact tree {}",
            is.count,
            is.episodes,
            is.name,
            is.bound(),
            was.count
        );
        lines.push(line("ended", &text));
    }
    lines
}

/// The front as a table: the smallest tree first, the one that was taken marked.
pub fn front(grown: &Grown) -> Vec<String> {
    let row = |point: &Point| {
        let [low, high] = point.returns.ci95;
        let text = format!(
            "{:>9.3}, 95 % [{low:.3}, {high:.3}], {} of {} harmed{}",
            point.returns.mean,
            point.harms,
            numbered(point.episodes, "episode"),
            match (point.taken, grown.is_exact()) {
                (false, _) => "",
                (true, false) => "; taken",
                (true, true) => "; taken, the proved tree",
            }
        );
        line(&numbered(point.size.nodes as u64, "node"), &text)
    };
    grown.front.iter().map(row).collect()
}

/// The front as a picture.
pub fn picture(grown: &Grown, name: &str) -> String {
    let dots = grown.front.iter().map(|point| svg::front::Dot {
        nodes: point.size.nodes,
        mean: point.returns.mean,
        interval: point.returns.ci95,
        taken: point.taken,
    });
    svg::front::front(&dots.collect::<Vec<_>>(), name, grown.is_exact())
}

/// A grown tree in `metrics.json`.
#[derive(Serialize)]
pub(super) struct Document<'a> {
    before: Measured,
    after: Measured,
    gain: &'a Mean,
    ticks: u64,
    #[serde(skip_serializing_if = "Option::is_none")]
    beside: Option<Other<'a>>,
    front: Vec<PointFigures<'a>>,
}

#[derive(Serialize)]
struct Other<'a> {
    tree: &'a str,
    #[serde(flatten)]
    measured: Measured,
    gain: &'a Mean,
}

#[derive(Serialize)]
struct Measured {
    #[serde(flatten)]
    size: Size,
    harmed: u64,
    ran: Episodes,
}

#[derive(Serialize)]
struct PointFigures<'a> {
    #[serde(flatten)]
    size: Size,
    r#return: &'a Mean,
    harmed: u64,
    episodes: u64,
    taken: bool,
}

impl<'a> Document<'a> {
    pub(super) fn new(grown: &'a Grown, program: &Program, task: &Task) -> Self {
        let measured = |figures: &Figures| Measured {
            size: figures.size,
            harmed: figures.harms,
            ran: Episodes::new(program, task, figures.summary.clone()),
        };
        let front = grown.front.iter().map(|point| PointFigures {
            size: point.size,
            r#return: &point.returns,
            harmed: point.harms,
            episodes: point.episodes,
            taken: point.taken,
        });
        Self {
            before: measured(&grown.before),
            after: measured(&grown.after),
            gain: &grown.gain,
            beside: grown.beside.as_ref().map(|beside| Other {
                tree: &beside.name,
                measured: measured(&beside.figures),
                gain: &beside.gain,
            }),
            ticks: grown.ticks,
            front: front.collect(),
        }
    }
}

/// The episodes that each line of `end on` ended.
fn ended(program: &Program, task: &Task, figures: &Figures) -> Vec<Ended> {
    Ended::all(&EndLine::all(program, task), &figures.summary)
}
