//! Intervals of numbers.

/// An interval of numbers; an end that is open does not belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    low_open: bool,
    high: f64,
    high_open: bool,
}

impl Interval {
    /// Every number, and infinity.
    pub const ALL: Self = Self::between(f64::NEG_INFINITY, f64::INFINITY);

    /// From one number to another, both of them included.
    pub const fn between(low: f64, high: f64) -> Self {
        Self {
            low,
            low_open: false,
            high,
            high_open: false,
        }
    }

    /// What is less than a number, or this number too unless it is open.
    pub fn below(high: f64, high_open: bool) -> Self {
        Self {
            high,
            high_open,
            ..Self::ALL
        }
    }

    /// What is more than a number, or this number too unless it is open.
    pub fn above(low: f64, low_open: bool) -> Self {
        Self {
            low,
            low_open,
            ..Self::ALL
        }
    }

    /// One number.
    pub fn just(value: f64) -> Self {
        Self::between(value, value)
    }

    /// Its ends.
    pub fn ends(self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// Whether no number is in it.
    pub fn is_empty(self) -> bool {
        self.low > self.high || self.low == self.high && (self.low_open || self.high_open)
    }

    /// Whether a number is in it.
    pub fn contains(self, value: f64) -> bool {
        let above = value > self.low || value == self.low && !self.low_open;
        above && (value < self.high || value == self.high && !self.high_open)
    }

    /// What is in both.
    #[must_use]
    pub fn and(self, other: Self) -> Self {
        let (low, low_open) = if (other.low, other.low_open) > (self.low, self.low_open) {
            (other.low, other.low_open)
        } else {
            (self.low, self.low_open)
        };
        let (high, high_open) = if (other.high, self.high_open) < (self.high, other.high_open) {
            (other.high, other.high_open)
        } else {
            (self.high, self.high_open)
        };
        Self {
            low,
            low_open,
            high,
            high_open,
        }
    }

    /// What is no farther from it than so much.
    #[must_use]
    pub fn wider(self, by: f64) -> Self {
        Self::between(self.low - by, self.high + by)
    }

    /// Whether all of the other one is in it.
    pub fn covers(self, other: Self) -> bool {
        self.and(other) == other
    }
}
