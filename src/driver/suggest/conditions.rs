//! Conditions that a task could observe besides what it does.

use super::readings::{Kind, Reading, is_taken, refused};
use crate::driver::load::Loaded;
use crate::ir::program::Predicate;
use crate::ir::task::Task;
use crate::ir::tree::Node;
use crate::ir::tunable::Unit;
use crate::ir::{Id, Name, Program};
use crate::learn::episode::Controller;
use crate::learn::experiment::Experiment;
use crate::learn::simulated::Purpose;
use crate::syntax::ast::ItemKind;
use crate::tree::Runner;
use crate::trial::play::Ticked;
use crate::world::Start;

/// The most thresholds of a reading, and about how many conditions there may be in all.
const THRESHOLDS: usize = 12;
const CONDITIONS: usize = 360;
/// The fewest thresholds of a reading.
const FEWEST: usize = 3;
/// Episodes in which the values of states are looked at, and the ticks between two looks.
const EPISODES: u64 = 40;
const APART: u64 = 10;
/// The ticks of a behaviour's turn.
const LASTING: u64 = 50;
/// One in so many values may lie outside the thresholds on either side.
const FEW: usize = 50;

/// A condition.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Condition {
    /// What its predicate is called.
    pub(super) name: String,
    /// The condition itself; `None` for a predicate of the program.
    pub(super) text: Option<String>,
    /// What it asks: of the conditions on one reading, one is tried.
    pub(super) reading: String,
}

impl Condition {
    /// Its predicate as an item of the language.
    pub(super) fn item(&self) -> Option<String> {
        let text = self.text.as_ref()?;
        Some(format!("predicate {} = {text}\n", self.name))
    }

    /// A predicate of the program that a task does not observe.
    fn declared(name: String) -> Self {
        Self {
            reading: name.clone(),
            name,
            text: None,
        }
    }
}

/// All conditions: the predicates that the task leaves out, and each reading at some thresholds.
pub(super) fn conditions(
    loaded: &Loaded,
    task: Id<Task>,
    readings: &[Reading],
    values: &[Vec<f64>],
) -> Vec<Condition> {
    let program = &loaded.program;
    let observed = &program.tasks[task].observe;
    let observed: Vec<String> = observed
        .iter()
        .map(|id| program.predicates[*id].name.to_string())
        .collect();
    let left_out = declared(loaded).filter(|name| !observed.contains(name));
    let mut conditions: Vec<Condition> = left_out.map(Condition::declared).collect();
    let each = (CONDITIONS / readings.len().max(1)).clamp(FEWEST, THRESHOLDS);
    for reading in readings {
        let thresholds = match &reading.kind {
            Kind::Truth => {
                let name = free(loaded, &conditions, &slug(&reading.text));
                conditions.push(Condition {
                    name,
                    text: Some(reading.text.clone()),
                    reading: reading.text.clone(),
                });
                continue;
            }
            Kind::State(state, unit) => {
                let values = values.get(*state).map_or(&[][..], Vec::as_slice);
                (even(values, unit, each), unit)
            }
            Kind::Within(range, unit) => (between(*range, each), unit),
        };
        let (mut thresholds, unit): (Vec<f64>, &Unit) = thresholds;
        thresholds.dedup();
        for threshold in thresholds {
            let number = threshold
                .to_string()
                .replace('-', "minus_")
                .replace('.', "_");
            let slug = slug(&reading.text);
            let slug = slug.strip_prefix("is_").unwrap_or(&slug);
            let name = format!("{slug}_at_most_{number}");
            conditions.push(Condition {
                name: free(loaded, &conditions, &name),
                text: Some(format!("{} <= {}", reading.text, unit.written(threshold))),
                reading: reading.text.clone(),
            });
        }
    }
    let lines: Vec<String> = conditions
        .iter()
        .map(|condition| condition.item().unwrap_or_default())
        .collect();
    let mut refused = refused(loaded, &lines).into_iter();
    conditions.retain(|_| refused.next() != Some(true));
    conditions
}

/// The predicates of the user that need no arguments.
fn declared(loaded: &Loaded) -> impl Iterator<Item = String> {
    let asts = loaded.asts();
    let items = asts
        .filter(|ast| loaded.files.contains(&ast.span.file))
        .flat_map(|ast| &ast.items);
    items.filter_map(|item| match &item.kind {
        ItemKind::Predicate(predicate)
            if predicate.params.is_none() && predicate.value.is_some() =>
        {
            Some(Name::word(&predicate.name.name).to_string())
        }
        _ => None,
    })
}

/// The program with some predicates more in what a task observes.
pub(super) fn observing(program: &Program, task: Id<Task>, seen: &[Id<Predicate>]) -> Program {
    let mut program = program.clone();
    program.tasks[task].observe.extend(seen);
    program
}

/// A name that nothing has yet.
fn free(loaded: &Loaded, conditions: &[Condition], name: &str) -> String {
    let numbered = (2_usize..).map(|number| format!("{name}_{number}"));
    let mut names = std::iter::once(name.to_owned()).chain(numbered);
    let is_free = |name: &String| {
        !is_taken(loaded, name) && !conditions.iter().any(|known| known.name == *name)
    };
    names.find(is_free).unwrap_or_default()
}

/// The words of an expression as a name.
fn slug(text: &str) -> String {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let words = text.replace("==", " is ").replace("abs(bearing", "(aside");
    let words: Vec<&str> = words
        .split(|c| !is_part(c))
        .filter(|w| !w.is_empty())
        .collect();
    let name = words.join("_");
    // A word alone may be one of the language.
    match words.len() {
        1 => format!("is_{name}"),
        _ => name,
    }
}

/// A number with two digits that count.
fn rounded(number: f64) -> f64 {
    let text = format!("{number:.1e}");
    // What was written as a number reads as one.
    text.parse().unwrap_or(number)
}

/// Even values between the least and the greatest but for a few, in their unit and round.
fn even(values: &[f64], unit: &Unit, number: usize) -> Vec<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let few = sorted.len() / FEW;
    let ends = (sorted.get(few), sorted.get((sorted.len().max(1) - 1) - few));
    let (Some(low), Some(high)) = ends else {
        return Vec::new();
    };
    between([unit.of_si(*low), unit.of_si(*high)], number)
}

/// Even round values within a range.
fn between([low, high]: [f64; 2], number: usize) -> Vec<f64> {
    let step = (high - low) / (number + 1) as f64;
    let even = (1..=number).map(|i| low + step * i as f64);
    even.map(rounded).collect()
}

/// Values of each state as they are met: under a tree, and where all behaviours take turns, from the starts of learning.
pub(super) fn values_of_states(experiment: &Experiment, root: &Node, seed: u64) -> Vec<Vec<f64>> {
    let states = &experiment.program.states;
    let mut values = vec![Vec::new(); states.len()];
    let Ok(runner) = Runner::new(root, experiment.world.atoms()) else {
        return values;
    };
    let mut tree = Ticked(runner);
    let mut simulation = experiment.world.simulation();
    let choices = &experiment.task.choose;
    for episode in 0..EPISODES {
        let in_turn = episode % 2 == 1;
        let measured = experiment.measured(Purpose::Probe, seed);
        let from = match in_turn {
            true => experiment.exploring(),
            false => measured,
        };
        simulation.start(Start {
            episode,
            seed,
            stream: measured.stream,
            ..from
        });
        tree.reset();
        loop {
            simulation.begin_tick();
            if in_turn {
                let turn = (episode + simulation.ticks() / LASTING) as usize;
                if let Some(behavior) = choices.get(turn % choices.len().max(1)) {
                    simulation.act(*behavior);
                }
            } else {
                tree.tick(&mut simulation);
            }
            let tick = simulation.end_tick();
            if simulation.ticks() % APART == 1 {
                for (id, values) in states.ids().zip(&mut values) {
                    values.push(simulation.state(id));
                }
            }
            if tick.end.is_some() {
                break;
            }
        }
    }
    values
}
