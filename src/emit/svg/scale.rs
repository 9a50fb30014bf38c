//! Round numbers for axes and scale bars.

/// The least of 1, 2, 5 times a power of ten that is not below `least`, with its decimal places.
pub(super) fn round_up(least: f64) -> (f64, usize) {
    // From the smallest: a table by division would not be exact.
    for places in (0..=12).rev() {
        for digit in [1.0, 2.0, 5.0] {
            let value = digit / power(places);
            if value >= least {
                return (value, places);
            }
        }
    }
    let mut value = 10.0;
    loop {
        for digit in [1.0, 2.0, 5.0] {
            if digit * value >= least {
                return (digit * value, 0);
            }
        }
        if value > 1e300 {
            return (value, 0);
        }
        value *= 10.0;
    }
}

/// Ten to a small power, exactly.
fn power(places: usize) -> f64 {
    (0..places).fold(1.0, |value, _| value * 10.0)
}

/// An axis from one number to another on the page.
pub(super) struct Axis {
    low: f64,
    high: f64,
    from: f64,
    to: f64,
    step: f64,
    places: usize,
}

impl Axis {
    /// Round limits around `low` and `high`, which come to lie at `from` and `to`, with about `marks` marks.
    pub(super) fn new([low, high]: [f64; 2], [from, to]: [f64; 2], marks: f64) -> Self {
        let high = if high > low { high } else { low + 1.0 };
        let (step, places) = round_up((high - low) / marks);
        Self {
            low: (low / step).floor() * step,
            high: (high / step).ceil() * step,
            from,
            to,
            step,
            places,
        }
    }

    /// The axis without round limits.
    pub(super) fn tight(mut self, [low, high]: [f64; 2]) -> Self {
        if high > low {
            (self.low, self.high) = (low, high);
        }
        self
    }

    /// Where a number lies.
    pub(super) fn at(&self, value: f64) -> f64 {
        self.from + (value - self.low) / (self.high - self.low) * (self.to - self.from)
    }

    /// Where the marks lie, and what stands there.
    pub(super) fn marks(&self) -> Vec<(f64, String)> {
        let first = (self.low / self.step).ceil();
        let count = (self.high / self.step - first + 1e-9).floor().max(0.0);
        let mut marks = Vec::new();
        let mut i = 0.0;
        while i <= count {
            let value = (first + i) * self.step;
            marks.push((self.at(value), self.label(value)));
            i += 1.0;
        }
        marks
    }

    /// A number with its thousands and millions short.
    fn label(&self, value: f64) -> String {
        let (unit, name) = if value == 0.0 || self.high < 10_000.0 {
            (1.0, "")
        } else if self.high < 2_000_000.0 {
            (1e3, "\u{a0}k")
        } else {
            (1e6, "\u{a0}M")
        };
        if unit == 1.0 {
            let sign = if value < 0.0 { "−" } else { "" };
            format!("{sign}{:.*}", self.places, value.abs())
        } else {
            let short = value / unit;
            let short = (short * 1000.0).round() / 1000.0;
            format!("{short}{name}")
        }
    }
}
