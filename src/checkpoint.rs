//! What a long run keeps of itself, so that it can go on where it was stopped.
//!
//! A run is a chain of *parts*: each seed that learns, the policy that is improved, its roll-outs, the tree that grows. A
//! part is a function of the program, the options and the parts before it, and so is every state on its way. So the state
//! of any part, at any time, leads to the same end, and parts are kept each for itself.

use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt;

/// Where states are kept.
pub trait Keeper: Sync + fmt::Debug {
    /// The state that was kept of a part, if any.
    fn load(&self, part: &str) -> Option<Vec<u8>>;

    /// Whether anything is kept at all.
    fn keeps(&self) -> bool;

    /// Whether it is time to keep the state of a part that goes on.
    fn is_due(&self, part: &str) -> bool;

    /// Keeps the state of a part in place of the one before.
    fn save(&self, part: &str, state: &[u8]);

    /// Keeps a text that is of use by itself, under the name of a file.
    fn publish(&self, name: &str, text: &str);
}

/// Keeps nothing.
#[derive(Clone, Copy, Debug)]
pub struct Forgetful;

impl Keeper for Forgetful {
    fn load(&self, _: &str) -> Option<Vec<u8>> {
        None
    }

    fn keeps(&self) -> bool {
        false
    }

    fn is_due(&self, _: &str) -> bool {
        false
    }

    fn save(&self, _: &str, _: &[u8]) {}

    fn publish(&self, _: &str, _: &str) {}
}

/// Keeps the parts of a run that is itself a part of another, under names of their own. Texts are those of the other run
/// alone.
#[derive(Clone, Copy, Debug)]
pub struct Under<'k> {
    keeper: &'k dyn Keeper,
    name: &'k str,
}

impl<'k> Under<'k> {
    /// The parts that are kept under this name.
    pub fn new(keeper: &'k dyn Keeper, name: &'k str) -> Self {
        Self { keeper, name }
    }

    fn of(&self, part: &str) -> String {
        format!("{}-{part}", self.name)
    }
}

impl Keeper for Under<'_> {
    fn load(&self, part: &str) -> Option<Vec<u8>> {
        self.keeper.load(&self.of(part))
    }

    fn keeps(&self) -> bool {
        self.keeper.keeps()
    }

    fn is_due(&self, part: &str) -> bool {
        self.keeper.is_due(&self.of(part))
    }

    fn save(&self, part: &str, state: &[u8]) {
        self.keeper.save(&self.of(part), state);
    }

    fn publish(&self, _: &str, _: &str) {}
}

/// A part of a run.
#[derive(Clone, Debug)]
pub struct Part<'k> {
    keeper: &'k dyn Keeper,
    name: String,
}

impl<'k> Part<'k> {
    /// The part of this name.
    pub fn new(keeper: &'k dyn Keeper, name: impl Into<String>) -> Self {
        Self {
            keeper,
            name: name.into(),
        }
    }

    /// The state that was kept, if there is one.
    pub fn resume<T: DeserializeOwned>(&self) -> Option<T> {
        decode(&self.keeper.load(&self.name)?)
    }

    /// Keeps the state if it is time for that.
    pub fn keep<T: Serialize>(&self, state: impl FnOnce() -> T) {
        if self.keeper.is_due(&self.name) {
            self.save(state);
        }
    }

    /// Keeps the state.
    pub fn save<T: Serialize>(&self, state: impl FnOnce() -> T) {
        if self.keeper.keeps()
            && let Some(state) = encode(&state())
        {
            self.keeper.save(&self.name, &state);
        }
    }

    /// What was kept of the whole part, or else what comes of it now, which is kept.
    pub fn whole<T: Serialize + DeserializeOwned>(&self, make: impl FnOnce() -> T) -> T {
        self.resume().unwrap_or_else(|| {
            let made = make();
            self.save(|| &made);
            made
        })
    }
}

/// A state as bytes.
pub fn encode<T: Serialize>(state: &T) -> Option<Vec<u8>> {
    postcard::to_stdvec(state).ok()
}

/// The state in bytes, if it is one.
pub fn decode<T: DeserializeOwned>(bytes: &[u8]) -> Option<T> {
    postcard::from_bytes(bytes).ok()
}
