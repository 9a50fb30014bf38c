//! The ticks that a search may simulate, and those that it has.

/// An account of ticks, on which every stage of a search draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Account {
    /// Ticks simulated so far.
    pub ticks: u64,
    /// How many there may be.
    effort: u64,
}

impl Account {
    /// An account of so many ticks.
    pub(super) fn new(effort: u64) -> Self {
        Self { ticks: 0, effort }
    }

    /// The ticks at which some hundredths of the effort are spent.
    pub(super) fn at(&self, hundredths: u64) -> u64 {
        (u128::from(self.effort) * u128::from(hundredths) / 100) as u64
    }

    /// The ticks that are left.
    pub fn left(&self) -> u64 {
        self.effort.saturating_sub(self.ticks)
    }

    /// Whether this many ticks more are not beyond `until`.
    pub(super) fn affords(&self, ticks: u64, until: u64) -> bool {
        self.ticks.saturating_add(ticks) <= until
    }

    /// Counts ticks that were simulated.
    pub(super) fn spend(&mut self, ticks: u64) {
        self.ticks = self.ticks.saturating_add(ticks);
    }
}
