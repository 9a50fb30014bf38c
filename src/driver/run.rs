//! `btc run`: a tree or a policy in its world.

use super::load::Loaded;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node, Tree};
use crate::ir::{Id, Program};
use crate::learn::binomial::upper95;
use crate::learn::episode::{Controller, Episode, Greedy, play_all};
use crate::learn::process::Key;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Summary;
use crate::policy::Policy;
use crate::tree::Runner;
use crate::world::{Simulation, Simulator, Start};
use rustc_hash::FxHashMap;
use serde_json::{Map, Value, json};
use std::collections::BTreeSet;

/// What runs.
#[derive(Clone, Copy, Debug)]
pub enum Subject<'p> {
    /// A tree of the program.
    Tree(Id<Tree>),
    /// A policy for a task.
    Policy(&'p Policy, Id<Task>),
}

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Ran {
    /// The figures.
    pub summary: Summary,
    /// The names of the events, as in [`Summary::events`].
    pub events: Vec<String>,
    /// The names of what ends episodes, as in [`Summary::ended`].
    pub ends: Vec<String>,
}

/// Runs episodes 0 … n − 1 of a seed, on all threads.
///
/// # Errors
/// The world cannot be built, or something that is used is declared only.
pub fn run(loaded: &Loaded, subject: Subject, episodes: u64, seed: u64) -> Result<Ran, Diagnostic> {
    let program = &loaded.program;
    let task_id = match subject {
        Subject::Tree(tree) => target::task_of(loaded, Some(tree))?,
        Subject::Policy(_, task) => task,
    };
    let task = &program.tasks[task_id];
    let start = Start {
        seed,
        stream: Purpose::Run as u64,
        limit: task.end_after,
        ..Start::default()
    };
    let played = match subject {
        Subject::Tree(tree) => {
            play_tree(loaded, task_id, &program.trees[tree].root, episodes, start)?
        }
        Subject::Policy(policy, _) => {
            let simulator = simulator(loaded, task_id, &[])?;
            let choices = choices(policy);
            let unseen = unseen(program, task_id);
            play_all(episodes, start, task.patience, || {
                (simulator.simulation(), Greedy::new(&choices, unseen))
            })
        }
    };
    Ok(Ran {
        summary: Summary::of(&played, task.end_on.len()),
        events: program
            .events
            .values()
            .map(|event| event.name.to_string())
            .collect(),
        ends: end_names(program, task),
    })
}

/// Plays episodes 0 … n − 1 under a tree, on all threads.
pub(super) fn play_tree(
    loaded: &Loaded,
    task: Id<Task>,
    root: &Node,
    episodes: u64,
    start: Start,
) -> Result<Vec<Episode>, Diagnostic> {
    let (simulator, runner) = ready(loaded, task, root)?;
    let patience = loaded.program.tasks[task].patience;
    Ok(play_all(episodes, start, patience, || {
        (simulator.simulation(), Ticked(runner.clone()))
    }))
}

/// The world of a task and a tree that runs in it.
pub(super) fn ready(
    loaded: &Loaded,
    task: Id<Task>,
    root: &Node,
) -> Result<(Simulator, Runner), Diagnostic> {
    let mut asked = BTreeSet::new();
    root.visit_atoms(&mut |atom| {
        asked.insert(atom);
    });
    let asked: Vec<Atom> = asked.into_iter().collect();
    let simulator = simulator(loaded, task, &asked)?;
    can_run(loaded, root)?;
    let runner = Runner::new(root, simulator.atoms())
        .map_err(|atom| internal(loaded, &loaded.program.atom_name(atom).to_string()))?;
    Ok((simulator, runner))
}

/// A tree as a controller.
#[derive(Clone, Debug)]
pub struct Ticked(pub Runner);

impl Controller for Ticked {
    fn reset(&mut self) {
        self.0.reset();
    }

    fn tick(&mut self, simulation: &mut Simulation) {
        let atoms = simulation.atoms();
        self.0.tick_key(atoms, |behavior| simulation.act(behavior));
    }
}

/// The world of a task, from the task's own starts.
pub(super) fn simulator(
    loaded: &Loaded,
    task: Id<Task>,
    asked: &[Atom],
) -> Result<Simulator, Diagnostic> {
    let start = &loaded.program.tasks[task].start;
    build(loaded, task, &[start], asked)
}

/// The world of a task, from several lists of start lines.
pub(super) fn build(
    loaded: &Loaded,
    task: Id<Task>,
    starts: &[&[crate::ir::task::StartLine]],
    asked: &[Atom],
) -> Result<Simulator, Diagnostic> {
    Simulator::build(&loaded.program, task, starts, asked).map_err(|error| {
        Diagnostic::new(
            Code::E0409,
            target::world_span(loaded),
            format!("the world cannot be built: {error}"),
        )
        .label("of this world")
    })
}

fn can_run(loaded: &Loaded, root: &Node) -> Result<(), Diagnostic> {
    let mut declared: Option<Id<Behavior>> = None;
    root.visit_behaviors(&mut |id| {
        if loaded.program.behaviors[id].law.is_none() {
            declared = declared.or(Some(id));
        }
    });
    match declared {
        None => Ok(()),
        Some(id) => Err(Diagnostic::new(
            Code::E0207,
            target::end_of_file(loaded),
            format!(
                "the behaviour `{}` is declared only and cannot be run",
                loaded.program.behaviors[id].name
            ),
        )
        .label("its definition is missing")),
    }
}

/// The world lacks an atom that it was built for.
pub(super) fn internal(loaded: &Loaded, atom: &str) -> Diagnostic {
    Diagnostic::new(
        Code::E0409,
        target::world_span(loaded),
        format!("the world does not say whether `{atom}` holds"),
    )
}

/// What a policy does by key.
pub(super) fn choices(policy: &Policy) -> FxHashMap<Key, Id<Behavior>> {
    policy
        .rows
        .iter()
        .map(|row| (row.minterm.key(), row.behavior))
        .collect()
}

/// What is done in a minterm that was never seen: what the learner of the task says, else the first choice.
pub(super) fn unseen(program: &Program, task: Id<Task>) -> Id<Behavior> {
    let learner = program
        .learners
        .values()
        .find(|learner| learner.task == task);
    learner
        .and_then(|learner| learner.unseen)
        .or(program.tasks[task].choose.first().copied())
        .unwrap_or(Id::new(0))
}

/// What ends the episodes of a task, by name.
pub(super) fn end_names(program: &Program, task: &Task) -> Vec<String> {
    let name = |(i, id): (usize, &crate::ir::ExprId)| match program.pool.get(*id) {
        crate::ir::Expr::Event(event) => program.events[event].name.to_string(),
        _ => format!("end {}", i + 1),
    };
    task.end_on.iter().enumerate().map(name).collect()
}

impl Ran {
    /// The figures as JSON.
    pub fn json(&self) -> Value {
        let summary = &self.summary;
        let events = self.events.iter().zip(&summary.events);
        let events: Map<String, Value> = events
            .map(|(name, (count, rate))| {
                let figures = json!({
                    "count": count,
                    "per_1000_ticks": rate.mean,
                    "ci95": rate.ci95,
                });
                (name.clone(), figures)
            })
            .collect();
        let mut ended: Map<String, Value> = self
            .ends
            .iter()
            .zip(&summary.ended)
            .map(|(name, count)| {
                let upper = upper95(*count, summary.episodes);
                (name.clone(), json!({ "count": count, "upper95": upper }))
            })
            .collect();
        ended.insert("limit".to_owned(), json!({ "count": summary.cut }));
        json!({
            "episodes": summary.episodes,
            "ticks": summary.ticks,
            "return": { "mean": summary.total.mean, "ci95": summary.total.ci95 },
            "events": events,
            "ended": ended,
        })
    }

    /// The figures for a person.
    pub fn human(&self) -> String {
        let summary = &self.summary;
        let [low, high] = summary.total.ci95;
        let mut text = format!(
            "{} episodes, {} ticks\n\n  {:<16} {:>9.3}   95 % [{:.3}, {:.3}]\n",
            summary.episodes, summary.ticks, "return", summary.total.mean, low, high
        );
        for (name, (count, rate)) in self.events.iter().zip(&summary.events) {
            let [low, high] = rate.ci95;
            text.push_str(&format!(
                "  {name:<16} {:>9.3}   95 % [{low:.3}, {high:.3}] in 1000 ticks, {count} in all\n",
                rate.mean
            ));
        }
        text.push('\n');
        for (name, count) in self.ends.iter().zip(&summary.ended) {
            let upper = 100.0 * upper95(*count, summary.episodes);
            text.push_str(&format!(
                "  {name:<16} {count:>9}   of {} episodes, at most {upper:.2} % (95 %)\n",
                summary.episodes
            ));
        }
        text.push_str(&format!("  {:<16} {:>9}\n", "limit", summary.cut));
        text
    }
}
