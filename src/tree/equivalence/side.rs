//! A side of a comparison as an automaton: from its memory, in a moment, it selects.

use super::choices::Choices;
use super::environment::TableEnvironment;
use super::moment::Moment;
use super::{Side, Unknown};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::tree::atoms::atoms;
use crate::tree::tick::{Runner, Surroundings};

/// A side made ready for an environment.
pub(super) enum Automaton {
    Tree(Runner),
    /// What a table decides in each minterm of the environment.
    Table(Vec<Option<Id<Behavior>>>),
}

/// The first two different behaviours that a side ticks in a moment. The first is the one that it selects.
#[derive(Clone, Copy, Default)]
pub(super) struct Ticked {
    pub(super) selected: Option<Id<Behavior>>,
    pub(super) then: Option<Id<Behavior>>,
}

impl Automaton {
    pub(super) fn new(side: Side, environment: &TableEnvironment) -> Result<Self, Unknown> {
        match side {
            Side::Policy(policy) => {
                let choices = Choices::new(policy);
                let minterms = environment.minterms.iter();
                let choices = minterms.map(|cube| choices.choice(cube));
                Ok(Automaton::Table(choices.collect()))
            }
            Side::Tree(root) => {
                // What the window does not remember never holds: its bit stands behind those of the minterm.
                let mut known = environment.atoms.to_vec();
                for atom in atoms(root) {
                    let history = !matches!(atom, Atom::Predicate(_));
                    if history && !environment.remembers(atom) && !known.contains(&atom) {
                        known.push(atom);
                    }
                }
                let runner = Runner::new(root, &known);
                runner.map(Automaton::Tree).map_err(Unknown)
            }
        }
    }

    pub(super) fn memory(&self) -> Box<[u64]> {
        match self {
            Automaton::Tree(runner) => runner.memory().into(),
            Automaton::Table(_) => Box::default(),
        }
    }

    /// What it ticks in a moment; `None` if it may tick anything.
    pub(super) fn tick(&mut self, memory: &[u64], moment: &mut Moment) -> Option<Ticked> {
        match self {
            Automaton::Table(choices) => {
                let selected = choices.get(moment.minterm).copied().flatten()?;
                Some(Ticked {
                    selected: Some(selected),
                    then: None,
                })
            }
            Automaton::Tree(runner) => {
                runner.resume(memory);
                let mut watched = Watched {
                    moment,
                    ticked: Ticked::default(),
                    remembers: !memory.is_empty(),
                };
                runner.tick_in(&mut watched);
                Some(watched.ticked)
            }
        }
    }
}

/// A moment in which a tree ticks, with what it has ticked.
struct Watched<'m, 'a> {
    moment: &'m mut Moment<'a>,
    ticked: Ticked,
    /// Whether the tree has memory.
    remembers: bool,
}

impl Surroundings for Watched<'_, '_> {
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        self.moment.matches(word, mask, value)
    }

    fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
        match self.ticked.selected {
            None => {
                self.ticked.selected = Some(behavior);
                return self.moment.status(behavior);
            }
            Some(selected) if selected == behavior => {}
            Some(_) => {
                self.ticked.then.get_or_insert(behavior);
            }
        }
        match self.remembers {
            true => self.moment.status(behavior),
            // Without memory, what comes of further behaviours leaves no trace.
            false => Status::Running,
        }
    }
}
