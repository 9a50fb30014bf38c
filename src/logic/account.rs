//! Work that may be done.

use std::sync::atomic::{AtomicU64, Ordering};

/// An account of work. Work is counted in words of sets of rows that are read, never timed, so that every machine does the
/// same work and finds the same result.
///
/// What runs on several threads at once draws on a [part](Account::part) each: then no thread sees what another spends.
#[derive(Debug)]
pub struct Account {
    spent: AtomicU64,
    limit: u64,
}

impl Account {
    /// An account of this much work.
    pub fn new(limit: u64) -> Self {
        Self {
            spent: AtomicU64::new(0),
            limit,
        }
    }

    /// An account that is never spent.
    pub fn unlimited() -> Self {
        Self::new(u64::MAX)
    }

    /// Counts work, also beyond the limit.
    pub fn spend(&self, work: u64) {
        self.spent.fetch_add(work, Ordering::Relaxed);
    }

    /// The work that was counted.
    pub fn spent(&self) -> u64 {
        self.spent.load(Ordering::Relaxed)
    }

    /// The work that is left.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.spent())
    }

    /// Whether nothing is left.
    pub fn is_spent(&self) -> bool {
        self.left() == 0
    }

    /// Whether this much is left.
    pub fn affords(&self, work: u64) -> bool {
        work <= self.left()
    }

    /// An account of one of so many equal parts of what is left. What is spent of it counts once it is
    /// [settled](Account::settle).
    #[must_use]
    pub fn part(&self, parts: usize) -> Self {
        Self::new(self.left() / parts.max(1) as u64)
    }

    /// Another account of so many times the work that this one allowed at first.
    #[must_use]
    pub fn again(&self, times: u64) -> Self {
        Self::new(self.limit.saturating_mul(times))
    }

    /// An account of what is left but for one of so many equal parts.
    #[must_use]
    pub fn but(&self, parts: usize) -> Self {
        Self::new(self.left() - self.left() / parts.max(1) as u64)
    }

    /// Counts what was spent of a part.
    pub fn settle(&self, part: &Self) {
        self.spend(part.spent());
    }
}

#[cfg(test)]
mod tests {
    use super::Account;

    #[test]
    fn parts_count_when_they_are_settled() {
        let account = Account::new(100);
        let parts = [account.part(2), account.part(2)];
        parts[0].spend(30);
        parts[1].spend(70);
        assert!(parts[1].is_spent() && !parts[0].is_spent());
        assert_eq!(account.left(), 100);
        parts.iter().for_each(|part| account.settle(part));
        assert!(account.is_spent() && !account.affords(1));
    }
}
