//! Episodes line by line, as CSV and as JSON Lines.

use super::words::end_names;
use crate::geometry::Point;
use crate::ir::law::Behavior;
use crate::ir::program::{Event, ValueKind};
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Status};
use crate::ir::{Id, Name, Program};
use crate::world::End;
use serde_json::{Map, Value, json};

/// The world at the beginning of a line.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// How many ticks of the episode have passed.
    pub tick: u64,
    /// Where the robot's centre is, in metres.
    pub position: Point,
    /// Where it looks, in radians.
    pub heading: f64,
    /// The same of the other robots, in the order of the program.
    pub others: Vec<(Point, f64)>,
    /// The states, in the order of the program.
    pub states: Vec<f64>,
    /// The atoms, a bit each.
    pub atoms: u128,
}

/// A decision, the part of one in which the same behaviour drove, or a tick.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// The number of the episode.
    pub episode: u64,
    /// What the decision found.
    pub found: Found,
    /// How many ticks it took.
    pub ticks: u64,
    /// The behaviour that drove the robot at its end, with its answer; where none did, the first that went on or was ticked last.
    pub behavior: Option<(Id<Behavior>, Status)>,
    /// The other behaviours that were ticked at its end, in order, with their answers.
    pub beside: Vec<(Id<Behavior>, Status)>,
    /// The reward of the decision, in the line that it ends with.
    pub reward: Option<f64>,
    /// What happened.
    pub events: Vec<Id<Event>>,
    /// Why the episode ended, if it did.
    pub end: Option<End>,
}

impl Line {
    /// A line in which nothing has happened yet.
    pub fn new(episode: u64, found: Found) -> Self {
        Self {
            episode,
            found,
            ticks: 0,
            behavior: None,
            beside: Vec::new(),
            reward: None,
            events: Vec::new(),
            end: None,
        }
    }
}

/// The lines of some episodes, with the names that they need.
#[derive(Clone, Debug)]
pub struct Trace {
    /// The lines, in order.
    pub lines: Vec<Line>,
    tick: f64,
    others: Vec<Name>,
    states: Vec<(Name, ValueKind)>,
    atoms: Vec<Name>,
    behaviors: Vec<Name>,
    events: Vec<Name>,
    ends: Vec<String>,
}

impl Trace {
    /// A trace of a task without lines.
    pub fn new(program: &Program, task: &Task) -> Self {
        let states = program.states.values();
        let behaviors = program.behaviors.values();
        let events = program.events.values();
        Self {
            lines: Vec::new(),
            tick: program.world.as_ref().map_or(1.0, |world| world.tick),
            others: program.world.as_ref().map_or_else(Vec::new, |world| {
                let others = world.others.values();
                others.map(|other| other.robot.name.clone()).collect()
            }),
            states: states
                .map(|state| (state.name.clone(), state.kind.clone()))
                .collect(),
            atoms: Vec::new(),
            behaviors: behaviors.map(|it| it.name.clone()).collect(),
            events: events.map(|event| event.name.clone()).collect(),
            ends: end_names(program, task),
        }
    }

    /// Says which atoms the bits of [`Found::atoms`] mean.
    pub fn asks(&mut self, program: &Program, atoms: &[Atom]) {
        if self.atoms.len() != atoms.len() {
            let names = atoms.iter().map(|atom| program.atom_name(*atom));
            self.atoms = names.collect();
        }
    }

    /// Comma-separated values, with a header. Truth values are 0 and 1, several events are separated by `;`.
    pub fn csv(&self) -> String {
        let mut text = String::new();
        let mut header: Vec<String> = ["episode", "time_s", "x_m", "y_m", "heading_deg"]
            .map(str::to_owned)
            .to_vec();
        for name in &self.others {
            let name = name.bare();
            header.extend(["x_m", "y_m", "heading_deg"].map(|what| format!("{name}.{what}")));
        }
        header.extend(self.states.iter().map(|(name, _)| name.bare()));
        header.extend(self.atoms.iter().map(Name::bare));
        let last = [
            "behavior", "status", "beside", "ticks", "reward", "events", "end",
        ];
        header.extend(last.map(str::to_owned));
        push_row(&mut text, &header);
        for line in &self.lines {
            let found = &line.found;
            let mut cells = vec![
                line.episode.to_string(),
                number(self.seconds(found.tick)),
                number(found.position[0]),
                number(found.position[1]),
                number(found.heading.to_degrees()),
            ];
            for (position, heading) in &found.others {
                cells.extend([position[0], position[1], heading.to_degrees()].map(number));
            }
            let states = self.states.iter().zip(&found.states);
            cells.extend(states.map(|((_, kind), value)| match kind {
                ValueKind::Enum(variants) => variant(variants, *value),
                ValueKind::Bool | ValueKind::Quantity => number(*value),
            }));
            let bits = 0..self.atoms.len();
            cells.extend(bits.map(|bit| (found.atoms >> bit & 1).to_string()));
            let (behavior, status) = self.done(line);
            let beside = self.beside(line).join(";");
            let reward = line.reward.map_or_else(String::new, number);
            cells.extend([behavior, status.to_owned(), beside]);
            cells.extend([line.ticks.to_string(), reward]);
            cells.push(self.happened(line).join(";"));
            cells.push(self.end(line).unwrap_or_default());
            push_row(&mut text, &cells);
        }
        text
    }

    /// A JSON document a line.
    pub fn json_lines(&self) -> String {
        let mut text = String::new();
        for line in &self.lines {
            let found = &line.found;
            let states = self.states.iter().zip(&found.states);
            let states = states.map(|((name, kind), value)| {
                let value = match kind {
                    ValueKind::Bool => Value::from(*value != 0.0),
                    ValueKind::Quantity => Value::from(rounded(*value)),
                    ValueKind::Enum(variants) => Value::from(variant(variants, *value)),
                };
                (name.bare(), value)
            });
            let others = self.others.iter().zip(&found.others);
            let others = others.map(|(name, (position, heading))| {
                let pose = json!({
                    "x_m": rounded(position[0]),
                    "y_m": rounded(position[1]),
                    "heading_deg": rounded(heading.to_degrees()),
                });
                (name.bare(), pose)
            });
            let atoms = self.atoms.iter().enumerate();
            let atoms = atoms.map(|(bit, name)| {
                let holds = found.atoms >> bit & 1 == 1;
                (name.bare(), Value::from(holds))
            });
            let (behavior, status) = self.done(line);
            let document = json!({
                "episode": line.episode,
                "time_s": rounded(self.seconds(found.tick)),
                "x_m": rounded(found.position[0]),
                "y_m": rounded(found.position[1]),
                "heading_deg": rounded(found.heading.to_degrees()),
                "robots": others.collect::<Map<_, _>>(),
                "states": states.collect::<Map<_, _>>(),
                "predicates": atoms.collect::<Map<_, _>>(),
                "behavior": behavior,
                "status": status,
                "beside": self.beside(line),
                "ticks": line.ticks,
                "reward": line.reward.map(rounded),
                "events": self.happened(line),
                "end": self.end(line),
            });
            text.push_str(&document.to_string());
            text.push('\n');
        }
        text
    }

    /// Lines for a person: when, what held, what was done and what happened. What goes on in the same way is told once.
    pub fn told(&self) -> Vec<String> {
        let mut told: Vec<(f64, String)> = Vec::new();
        for line in &self.lines {
            let held = self.atoms.iter().enumerate();
            let held = held.filter(|(bit, _)| line.found.atoms >> bit & 1 == 1);
            let held: Vec<String> = held.map(|(_, name)| name.to_string()).collect();
            let (behavior, status) = self.done(line);
            let mut text = format!("{{{}}}: {behavior} {status}", held.join(", "));
            let beside = self.beside(line);
            if !beside.is_empty() {
                text.push_str(&format!(" beside {}", beside.join(", ")));
            }
            let happened = self.happened(line);
            if !happened.is_empty() {
                text.push_str(&format!("; {}", happened.join(", ")));
            }
            if told.last().is_none_or(|(_, last)| *last != text) {
                told.push((self.seconds(line.found.tick), text));
            }
        }
        let told = told.into_iter();
        told.map(|(seconds, text)| format!("{seconds:.1} s {text}"))
            .collect()
    }

    fn seconds(&self, ticks: u64) -> f64 {
        ticks as f64 * self.tick
    }

    fn done(&self, line: &Line) -> (String, &'static str) {
        line.behavior
            .map_or_else(|| (String::new(), ""), |answered| self.answered(answered))
    }

    /// `wait(1 s) running`, for each behaviour that was ticked beside.
    fn beside(&self, line: &Line) -> Vec<String> {
        let answered = line.beside.iter().map(|answered| self.answered(*answered));
        answered
            .map(|(behavior, status)| format!("{behavior} {status}"))
            .collect()
    }

    fn answered(&self, (behavior, status): (Id<Behavior>, Status)) -> (String, &'static str) {
        let name = self.behaviors.get(behavior.index());
        (name.map_or_else(String::new, Name::bare), status.name())
    }

    fn happened(&self, line: &Line) -> Vec<String> {
        let names = line.events.iter().map(|id| self.events.get(id.index()));
        names.flatten().map(Name::bare).collect()
    }

    fn end(&self, line: &Line) -> Option<String> {
        match line.end? {
            End::On(line) => self.ends.get(line).cloned(),
            End::Cut => Some("limit".to_owned()),
        }
    }
}

/// A number to six digits behind the point: far finer than anything in a world, and the same on every machine.
fn rounded(value: f64) -> f64 {
    (value * 1e6).round() / 1e6 + 0.0
}

fn number(value: f64) -> String {
    rounded(value).to_string()
}

/// The name of a variant, or of a target.
fn variant(variants: &[Name], index: f64) -> String {
    let known = (index >= 0.0).then_some(index as usize);
    let variant = known.and_then(|index| variants.get(index));
    variant.map_or_else(|| "nowhere".to_owned(), Name::bare)
}

/// A row of cells; one with a comma or a quote stands in quotes.
fn push_row(text: &mut String, cells: &[String]) {
    for (i, cell) in cells.iter().enumerate() {
        if i > 0 {
            text.push(',');
        }
        if cell.contains([',', '"', '\n']) {
            text.push_str(&format!("\"{}\"", cell.replace('"', "\"\"")));
        } else {
            text.push_str(cell);
        }
    }
    text.push('\n');
}
