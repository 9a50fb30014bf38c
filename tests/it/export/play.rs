//! What happens to a tree, and what it does: the same for btc and for those that run its exports.

use super::trees::atoms;
use crate::laws::random::Random;
use btc::ir::Program;
use btc::ir::history::Window;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Node, Status};
use btc::tree::tick::Runner;
use serde_json::{Value, json};

/// What the robot meets.
#[derive(Clone, Debug)]
pub(super) struct Play {
    /// The values of the atoms in each tick.
    pub(super) valuations: Vec<Vec<bool>>,
    /// How the behaviours answer, call by call; one of even number succeeds where it would fail.
    answers: Vec<Status>,
    /// Whether those of even number do not fail.
    steady: bool,
    /// The history window, where the history is what the tree did and not what the valuations say.
    history: Option<History>,
}

/// A tick: the behaviours that were ticked, in order, and the answer of the tree.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Tick {
    pub(super) calls: Vec<usize>,
    pub(super) status: Status,
}

impl Play {
    /// A random one of this many ticks, in which the atoms change now and then.
    pub(super) fn new(random: &mut Random, atoms: usize, ticks: usize, steady: bool) -> Self {
        let mut values: Vec<bool> = (0..atoms).map(|_| random.chance(50)).collect();
        let mut valuations = Vec::new();
        for _ in 0..ticks {
            if random.chance(30) {
                values = (0..atoms).map(|_| random.chance(50)).collect();
            }
            valuations.push(values.clone());
        }
        let answers = (0..97).map(|_| match random.below(4) {
            0 => Status::Failure,
            1 => Status::Success,
            _ => Status::Running,
        });
        Self {
            valuations,
            answers: answers.collect(),
            steady,
            history: None,
        }
    }

    /// The same where the history is what the tree did.
    pub(super) fn remembering(mut self, history: History) -> Self {
        self.history = Some(history);
        self
    }

    /// The same where nothing ends.
    pub(super) fn all_running(mut self) -> Self {
        self.answers.retain(|answer| *answer == Status::Running);
        self
    }

    /// The play of an exported tree, which is called `what`, for a script.
    pub(super) fn as_json(&self, what: &str, exported: &str) -> Value {
        let digits = |values: &Vec<bool>| -> String {
            values.iter().map(|v| if *v { '1' } else { '0' }).collect()
        };
        let letters = self.answers.iter().map(|answer| match answer {
            Status::Success => 'S',
            Status::Failure => 'F',
            Status::Running => 'R',
        });
        json!({
            what: exported,
            "valuations": self.valuations.iter().map(digits).collect::<Vec<_>>(),
            "answers": letters.collect::<String>(),
            "steady": self.steady,
            "remembers": self.history.is_some(),
        })
    }

    /// The answer of a behaviour at the call of this number.
    pub(super) fn answer(&self, behavior: usize, call: usize) -> Status {
        let answer = self.answers[call % self.answers.len()];
        if self.steady && behavior.is_multiple_of(2) && answer == Status::Failure {
            return Status::Success;
        }
        answer
    }

    /// What btc does.
    pub(super) fn by_btc(&self, program: &Program, root: &Node) -> Vec<Tick> {
        let atoms = atoms(program);
        let mut runner = Runner::new(root, &atoms).unwrap();
        let mut window = self.history.map(Window::new);
        let mut call = 0;
        let ticks = self.valuations.iter().map(|values| {
            let mut values = values.clone();
            if let Some(window) = &window {
                for (value, atom) in values.iter_mut().zip(&atoms) {
                    *value = match atom {
                        Atom::Predicate(_) => *value,
                        asked => window.shows(*asked),
                    };
                }
            }
            let mut words = vec![0; values.len().div_ceil(64)];
            for (i, _) in values.iter().enumerate().filter(|(_, holds)| **holds) {
                words[i / 64] |= 1 << (i % 64);
            }
            let mut calls = Vec::new();
            let mut ended = Vec::new();
            let status = runner.tick(&words, |behavior| {
                let answer = self.answer(behavior.index(), call);
                call += 1;
                calls.push(behavior.index());
                ended.push((behavior, answer));
                answer
            });
            if let Some(window) = &mut window {
                for (behavior, answer) in ended {
                    window.record(behavior, answer);
                }
            }
            Tick { calls, status }
        });
        ticks.collect()
    }
}
