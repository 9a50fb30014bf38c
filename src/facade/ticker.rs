//! Trees in a loop of one's own.

use crate::ir::Program;
use crate::ir::history::Window;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Node, Status};
use crate::tree::Runner;
use crate::tree::atoms;

/// What a tree asks and drives: a robot, a character of a game, a simulation.
pub trait Robot {
    /// Whether a predicate holds; `predicate` is its name as the language writes it, such as `battery_low` or `vis(A)`.
    fn holds(&mut self, predicate: &str) -> bool;

    /// One tick of a behaviour, such as `goto(A)`.
    fn tick(&mut self, behavior: &str) -> Status;
}

/// A tree with its memory, to be ticked.
///
/// What a tree asks of the history, `done(…)` and `failed(…)`, the ticker answers from the statuses that behaviours
/// return; the robot is not asked for it.
#[derive(Clone, Debug)]
pub struct Ticker {
    runner: Runner,
    /// What the guards ask: atom i is bit i of the valuation. A predicate has its name.
    asked: Vec<(Atom, String)>,
    /// The names of the behaviours, by their ids.
    behaviors: Vec<String>,
    window: Window,
    valuation: Vec<u64>,
}

impl Ticker {
    pub(super) fn new(program: &Program, root: &Node, history: History) -> Self {
        let asked: Vec<Atom> = atoms::atoms(root).into_iter().collect();
        let name = |&atom: &Atom| match atom {
            Atom::Predicate(id) => program.predicates[id].name.to_string(),
            Atom::Done(id) | Atom::Failed(id) => program.behaviors[id].name.to_string(),
        };
        let behaviors = program.behaviors.values();
        Self {
            runner: runner(root, &asked),
            valuation: vec![0; asked.len().div_ceil(64)],
            asked: asked.iter().map(|atom| (*atom, name(atom))).collect(),
            behaviors: behaviors
                .map(|behavior| behavior.name.to_string())
                .collect(),
            window: Window::new(history),
        }
    }

    /// One tick from the root.
    ///
    /// The robot is asked for the predicates first, so that all guards read the state before the tick; then it ticks the
    /// behaviours that the tick reaches.
    pub fn tick(&mut self, robot: &mut impl Robot) -> Status {
        self.valuation.fill(0);
        for (at, (atom, name)) in self.asked.iter().enumerate() {
            let holds = match atom {
                Atom::Predicate(_) => robot.holds(name),
                Atom::Done(_) | Atom::Failed(_) => self.window.shows(*atom),
            };
            if let Some(word) = self.valuation.get_mut(at / 64) {
                *word |= u64::from(holds) << (at % 64);
            }
        }
        let (behaviors, window) = (&self.behaviors, &mut self.window);
        self.runner.tick(&self.valuation, |behavior| {
            let name = behaviors.get(behavior.index());
            let status = robot.tick(name.map_or("", String::as_str));
            window.record(behavior, status);
            status
        })
    }

    /// Halts every node: the next tick starts with fresh memory and an empty history.
    pub fn halt(&mut self) {
        self.runner.reset();
        self.window.clear();
    }
}

/// A tree with fresh memory, over the atoms that its own guards ask.
#[allow(
    clippy::expect_used,
    reason = "an error is an atom of the tree that is not among those of the tree"
)]
fn runner(root: &Node, asked: &[Atom]) -> Runner {
    Runner::new(root, asked).expect("the atoms are those of the tree")
}
