//! One tick of an environment: what holds and how behaviours end, chosen as it is asked.
//!
//! Both sides tick in the same moment, and nothing moves in between: an atom has one value, and a behaviour one status,
//! whoever asks and however often. What nobody asks is not chosen.

use super::environment::{Consequence, Place, TableCube, TableEnvironment};
use super::oracle::Oracle;
use super::window::shows;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::policy::Minterm;

/// A moment in which the environment stands in one of its minterms.
pub(super) struct Moment<'a> {
    environment: &'a TableEnvironment<'a>,
    oracle: &'a mut Oracle,
    place: Place,
    /// The number of the minterm, or of the cube.
    pub(super) minterm: usize,
    cube: &'a TableCube<'a>,
    /// The values of the free atoms that were asked, a word at a time: which are known, and which of these hold.
    asked: Vec<(u64, u64)>,
    /// The behaviour that was ticked first, and what comes of it.
    selected: Option<(Id<Behavior>, Consequence)>,
    /// How the others end that were ticked after it.
    further: Vec<(Id<Behavior>, Status)>,
}

impl<'a> Moment<'a> {
    /// A moment in this place, `None` before the first tick; `None` where no minterm is possible.
    pub(super) fn new(
        environment: &'a TableEnvironment<'a>,
        place: Option<&Place>,
        oracle: &'a mut Oracle,
    ) -> Option<Self> {
        let (minterm, place) = environment.find(place, oracle)?;
        Some(Self {
            environment,
            place,
            minterm,
            cube: environment.minterms.get(minterm)?,
            asked: Vec::new(),
            oracle,
            selected: None,
            further: Vec::new(),
        })
    }

    /// Whether the bits of `mask` in this word of the valuation are those of `value`.
    pub(super) fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
        let of = |minterm: &Minterm| minterm.words().get(word).copied().unwrap_or(0);
        let free = self.cube.free.map_or(0, of) & mask;
        of(self.cube.minterm) & mask & !free == value & !free
            && (0..64)
                .filter(|bit| free >> bit & 1 == 1)
                .all(|bit| self.free(word * 64 + bit) == (value >> bit & 1 == 1))
    }

    /// The value of an atom that the row leaves free.
    fn free(&mut self, bit: usize) -> bool {
        if let Some(atom) = self.environment.atoms.get(bit)
            && self.environment.remembers(*atom)
        {
            return self.is_shown(*atom);
        }
        let (word, mask) = (bit / 64, 1u64 << (bit % 64));
        if self.asked.len() <= word {
            self.asked.resize(word + 1, (0, 0));
        }
        let Some((known, value)) = self.asked.get_mut(word) else {
            return false;
        };
        if *known & mask == 0 {
            *known |= mask;
            if self.oracle.choose(2) == 1 {
                *value |= mask;
            }
        }
        *value & mask != 0
    }

    /// Whether the window makes an atom true.
    fn is_shown(&self, atom: Atom) -> bool {
        matches!(&self.place, Place::Window(window) if shows(window, atom))
    }

    /// How a behaviour ends. The first that is asked for is the one that is selected, and what comes of it is up to the
    /// environment; others may end in any way.
    pub(super) fn status(&mut self, behavior: Id<Behavior>) -> Status {
        match &self.selected {
            None => {
                let consequence = self.follow(Some(behavior));
                let status = consequence.status;
                self.selected = Some((behavior, consequence));
                status
            }
            Some((selected, consequence)) if *selected == behavior => consequence.status,
            Some(_) => {
                let mut known = self.further.iter();
                if let Some((_, status)) = known.find(|(known, _)| *known == behavior) {
                    return *status;
                }
                let status = self.oracle.status();
                self.further.push((behavior, status));
                status
            }
        }
    }

    /// The values of this moment, false where nobody asked.
    pub(super) fn valuation(&self) -> Minterm {
        if self.cube.free.is_none() {
            return self.cube.minterm.clone();
        }
        let atoms = self.environment.atoms.iter().enumerate();
        Minterm::new(atoms.map(|(i, atom)| {
            let (_, value) = self.asked.get(i / 64).copied().unwrap_or_default();
            self.cube.minterm.get(i) || self.is_shown(*atom) || value >> (i % 64) & 1 == 1
        }))
    }

    /// What comes of the moment, in which this was selected.
    pub(super) fn consequence(mut self, selected: Option<Id<Behavior>>) -> Consequence {
        match self.selected.take() {
            Some((_, consequence)) => consequence,
            None => self.follow(selected),
        }
    }

    fn follow(&mut self, selected: Option<Id<Behavior>>) -> Consequence {
        self.environment
            .consequence(&self.place, selected, self.oracle)
    }
}
