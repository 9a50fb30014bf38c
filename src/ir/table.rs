//! Vectors that are indexed by ids of their own.

use super::name::Name;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};
use std::fmt;
use std::hash::{Hash, Hasher};
use std::marker::PhantomData;
use std::ops::{Index, IndexMut};

/// The index of a `T` in the [`Table`] that made it.
#[derive(Serialize, Deserialize)]
#[serde(bound = "")]
pub struct Id<T>(u32, PhantomData<fn() -> T>);

impl<T> Id<T> {
    /// The id of the `index`-th entry.
    pub fn new(index: usize) -> Self {
        Self(u32::try_from(index).unwrap_or(u32::MAX), PhantomData)
    }

    /// The position in the table.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}

impl<T> Clone for Id<T> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<T> Copy for Id<T> {}
impl<T> PartialEq for Id<T> {
    fn eq(&self, other: &Self) -> bool {
        self.0 == other.0
    }
}
impl<T> Eq for Id<T> {}
impl<T> PartialOrd for Id<T> {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl<T> Ord for Id<T> {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.cmp(&other.0)
    }
}
impl<T> Hash for Id<T> {
    fn hash<H: Hasher>(&self, state: &mut H) {
        self.0.hash(state);
    }
}
impl<T> fmt::Debug for Id<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "#{}", self.0)
    }
}

/// What a table may find by its name.
pub trait Named {
    /// What the program calls it; `None` if it has no name of its own.
    fn name(&self) -> Option<&Name>;
}

/// A vector indexed by [`Id`]s.
#[derive(Clone)]
pub struct Table<T> {
    entries: Vec<T>,
    /// The first entry that was pushed under each name.
    by_name: FxHashMap<Name, Id<T>>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self {
            entries: Vec::new(),
            by_name: FxHashMap::default(),
        }
    }
}

impl<T: PartialEq> PartialEq for Table<T> {
    fn eq(&self, other: &Self) -> bool {
        self.entries == other.entries
    }
}

impl<T: Named> Table<T> {
    /// Adds an entry.
    pub fn push(&mut self, entry: T) -> Id<T> {
        let id = Id::new(self.entries.len());
        if let Some(name) = entry.name() {
            self.by_name.entry(name.clone()).or_insert(id);
        }
        self.entries.push(entry);
        id
    }

    /// The first entry that was pushed under a name, whatever it is called now.
    pub fn named(&self, name: &Name) -> Option<Id<T>> {
        self.by_name.get(name).copied()
    }
}

impl<T> Table<T> {
    /// The number of entries.
    pub fn len(&self) -> usize {
        self.entries.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.entries.is_empty()
    }

    /// The entries with their ids, in order.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = (Id<T>, &T)> + ExactSizeIterator {
        self.entries
            .iter()
            .enumerate()
            .map(|(i, entry)| (Id::new(i), entry))
    }

    /// The ids, in order.
    pub fn ids(&self) -> impl DoubleEndedIterator<Item = Id<T>> + ExactSizeIterator + use<T> {
        (0..self.entries.len()).map(Id::new)
    }

    /// The entries, in order.
    pub fn values(&self) -> std::slice::Iter<'_, T> {
        self.entries.iter()
    }

    /// The first id whose entry passes.
    pub fn find(&self, test: impl FnMut(&T) -> bool) -> Option<Id<T>> {
        self.entries.iter().position(test).map(Id::new)
    }
}

impl<T: fmt::Debug> fmt::Debug for Table<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.entries.fmt(f)
    }
}

#[allow(
    clippy::indexing_slicing,
    reason = "an id is made by the push of its own table and entries are never removed"
)]
impl<T> Index<Id<T>> for Table<T> {
    type Output = T;
    fn index(&self, id: Id<T>) -> &T {
        &self.entries[id.index()]
    }
}

#[allow(
    clippy::indexing_slicing,
    reason = "an id is made by the push of its own table and entries are never removed"
)]
impl<T> IndexMut<Id<T>> for Table<T> {
    fn index_mut(&mut self, id: Id<T>) -> &mut T {
        &mut self.entries[id.index()]
    }
}

impl<T: Named> FromIterator<T> for Table<T> {
    fn from_iter<I: IntoIterator<Item = T>>(iter: I) -> Self {
        let mut table = Self::default();
        for entry in iter {
            table.push(entry);
        }
        table
    }
}

/// Says of types with a field `name` that it is their name.
macro_rules! named {
    ($($type:ty),* $(,)?) => {
        $(impl Named for $type {
            fn name(&self) -> Option<&Name> {
                Some(&self.name)
            }
        })*
    };
}

named!(
    super::expr::Local,
    super::expr::Temp,
    super::input::Input,
    super::law::Behavior,
    super::program::Event,
    super::program::Predicate,
    super::program::State,
    super::task::Learner,
    super::task::Task,
    super::tree::Tree,
    super::world::Place,
    super::world::Sensor,
    super::world::Wall,
);

impl Named for super::world::Scripted {
    fn name(&self) -> Option<&Name> {
        Some(&self.robot.name)
    }
}

/// Where a number to be tuned stands is not its name alone.
impl Named for super::tunable::Tunable {
    fn name(&self) -> Option<&Name> {
        None
    }
}
