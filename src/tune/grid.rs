//! Round numbers from one end of a range to the other.

use crate::ir::tunable::Tunable;

/// The least distance of two values, as a part of the value in use: a value that is as good as nearer ones is not
/// robust for that.
const FINEST: f64 = 0.02;

/// The values of a number that are tried.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// The values in the unit of the number, ascending.
    pub values: Vec<f64>,
    /// Which of them is in use.
    pub used: usize,
}

/// The most values of each of so many numbers.
pub fn most(numbers: usize) -> usize {
    match numbers {
        0 | 1 => 60,
        2 | 3 => 40,
        4..=6 => 24,
        _ => 12,
    }
}

impl Axis {
    /// The multiples of 1, 2 or 5 times a power of ten in the range of a number, the finest of which there are at most
    /// `most` and that are 2 % of the value in use apart or more; the ends of the range; and the value in use.
    pub fn new(tunable: &Tunable, most: usize) -> Self {
        let (low, high) = (tunable.low, tunable.high);
        let least = (FINEST * tunable.value.abs()).min((high - low) / 2.0);
        let step = step(least.max((high - low) / most.max(2) as f64));
        let mut values = vec![low, high, tunable.value];
        let mut multiple = (low / step.size()).ceil();
        while step.times(multiple) <= high {
            values.push(step.times(multiple));
            multiple += 1.0;
        }
        values.sort_by(f64::total_cmp);
        // The ends and the value in use may be multiples, too.
        values.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * step.size());
        let near = |value: &f64| (value - tunable.value).abs() <= 1e-9 * step.size();
        let used = values.iter().position(near).unwrap_or(0);
        Self { values, used }
    }

    /// How round a value is: its decimal digits, less for a last one of 5. The smaller, the rounder.
    pub fn digits(&self, at: usize) -> usize {
        digits(self.values.get(at).copied().unwrap_or(0.0))
    }
}

/// Twice the significant digits of a number, one less if the last is a 5.
fn digits(number: f64) -> usize {
    let text = format!("{:e}", number.abs());
    let mantissa = text.split('e').next().unwrap_or_default();
    let count = mantissa.chars().filter(char::is_ascii_digit).count();
    2 * count - usize::from(mantissa.ends_with('5'))
}

/// 1, 2 or 5 times a power of ten.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Step {
    digit: f64,
    /// The power of ten, or of a tenth where `places` is positive.
    power: f64,
    fraction: bool,
}

impl Step {
    fn size(self) -> f64 {
        self.times(1.0)
    }

    /// A multiple, as the nearest number to its decimal spelling.
    fn times(self, multiple: f64) -> f64 {
        let number = multiple * self.digit;
        match self.fraction {
            true => number / self.power,
            false => number * self.power,
        }
    }
}

/// The least step that is not below `least`.
fn step(least: f64) -> Step {
    let mut power = 1e12;
    let mut fraction = true;
    loop {
        for digit in [1.0, 2.0, 5.0] {
            let step = Step {
                digit,
                power,
                fraction,
            };
            if step.size() >= least * (1.0 - 1e-9) {
                return step;
            }
        }
        match fraction {
            true if power > 1.0 => power /= 10.0,
            true => (power, fraction) = (10.0, false),
            false if power < 1e300 => power *= 10.0,
            false => {
                return Step {
                    digit: 1.0,
                    power,
                    fraction,
                };
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Axis, digits};
    use crate::ir::tunable::{Tunable, Unit};

    fn axis(value: f64, low: f64, high: f64, most: usize) -> Axis {
        let unit = Unit {
            text: "%".to_owned(),
            times: 1.0,
            over: 100.0,
        };
        let name = "low".to_owned();
        let tunable = Tunable {
            name,
            value,
            low,
            high,
            unit,
        };
        Axis::new(&tunable, most)
    }

    #[test]
    fn a_grid_has_round_numbers_the_ends_and_the_value_in_use() {
        let grid = axis(25.0, 5.0, 60.0, 6);
        assert_eq!(grid.values, [5.0, 10.0, 20.0, 25.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(grid.used, 3);
        let fine = axis(0.3, 0.1, 0.5, 4);
        assert_eq!(fine.values, [0.1, 0.2, 0.3, 0.4, 0.5]);
        assert_eq!(fine.used, 2);
        let below = axis(-3.0, -4.0, 1.0, 5);
        assert_eq!(below.values, [-4.0, -3.0, -2.0, -1.0, 0.0, 1.0]);
    }

    #[test]
    fn rounder_numbers_have_fewer_digits() {
        let mut numbers = [14.0, 15.0, 20.0, 0.125, 300.0];
        numbers.sort_by_key(|number| digits(*number));
        assert_eq!(numbers, [20.0, 300.0, 15.0, 14.0, 0.125]);
    }
}
