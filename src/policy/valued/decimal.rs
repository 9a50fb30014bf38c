//! Numbers as they are written in decimal.

use std::fmt;

/// The most digits of a number.
const DIGITS: usize = 64;

/// The largest exponent of a number that is written with all its zeros.
const PLAIN: i32 = 20;

/// A finite decimal number: `digits` · 10^`exponent`, without zeros at either end of the digits.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Decimal {
    negative: bool,
    digits: String,
    exponent: i32,
}

impl Decimal {
    /// The number that a text writes, if it is one that a program can hold.
    pub fn parse(text: &str) -> Option<Self> {
        let (negative, text) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (whole, fraction) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits = format!("{whole}{fraction}");
        let is_digit = |c: char| c.is_ascii_digit();
        if digits.is_empty() || digits.len() > DIGITS || !digits.chars().all(is_digit) {
            return None;
        }
        let number = Self::of(
            negative,
            &digits,
            exponent.checked_sub(fraction.len() as i32)?,
        );
        let value = number.value();
        (value.is_finite() && (value != 0.0 || number.digits.is_empty())).then_some(number)
    }

    /// What a text is not that does not [parse](Self::parse).
    pub fn wanted(text: &str) -> &'static str {
        let text = text.strip_prefix(['-', '+']).unwrap_or(text);
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let exponent = exponent.strip_prefix(['-', '+']).unwrap_or(exponent);
        let digits = mantissa.replacen('.', "", 1);
        let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
        match is_number(&digits) && is_number(exponent) {
            true if digits.len() > DIGITS => "a number of at most 64 digits",
            true => "a number that 64 bits hold",
            false => "a number, or `-` for any",
        }
    }

    fn of(negative: bool, digits: &str, exponent: i32) -> Self {
        let kept = digits.trim_end_matches('0');
        let zeros = (digits.len() - kept.len()) as i32;
        let kept = kept.trim_start_matches('0');
        Self {
            negative: negative && !kept.is_empty(),
            exponent: match kept {
                "" => 0,
                _ => exponent.saturating_add(zeros),
            },
            digits: kept.to_owned(),
        }
    }

    /// The nearest number of a machine.
    pub fn value(&self) -> f64 {
        let sign = if self.negative { "-" } else { "" };
        let text = format!("{sign}0{}e{}", self.digits, self.exponent);
        text.parse().unwrap_or(f64::NAN)
    }

    /// The shortest number that is at least this one and below another; this one itself where the two are of very
    /// different size.
    pub fn up_to(&self, other: &Self) -> Self {
        let exponent = self.exponent.min(other.exponent);
        let (Some(low), Some(high)) = (self.scaled(exponent), other.scaled(exponent)) else {
            return self.clone();
        };
        let steps = (0..=37).rev().map(|power| 10_i128.pow(power));
        for step in steps {
            let first = -(-low).div_euclid(step);
            let last = (high - 1).div_euclid(step);
            if first <= last {
                let middle = first + (last - first) / 2;
                let number = if first <= 0 && last >= 0 { 0 } else { middle } * step;
                let digits = number.unsigned_abs().to_string();
                return Self::of(number < 0, &digits, exponent);
            }
        }
        self.clone()
    }

    /// The whole number of 10^`exponent` that it is, with room for another factor.
    fn scaled(&self, exponent: i32) -> Option<i128> {
        let zeros = usize::try_from(self.exponent.checked_sub(exponent)?).ok()?;
        if self.digits.is_empty() {
            return Some(0);
        }
        if self.digits.len() + zeros > 36 {
            return None;
        }
        let number: i128 = format!("{}{}", self.digits, "0".repeat(zeros))
            .parse()
            .ok()?;
        Some(if self.negative { -number } else { number })
    }
}

impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.negative {
            f.write_str("-")?;
        }
        let digits = self.digits.as_str();
        let length = digits.len() as i32;
        let point = length + self.exponent;
        match digits {
            "" => f.write_str("0"),
            _ if self.exponent >= 0 && point <= PLAIN => {
                let zeros = "0".repeat(self.exponent as usize);
                write!(f, "{digits}{zeros}")
            }
            _ if self.exponent < 0 && point > 0 => {
                let (whole, fraction) = digits.split_at(point as usize);
                write!(f, "{whole}.{fraction}")
            }
            _ if self.exponent < 0 && point > -6 => {
                let zeros = "0".repeat(point.unsigned_abs() as usize);
                write!(f, "0.{zeros}{digits}")
            }
            _ => write!(f, "{digits}e{}", self.exponent),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Decimal;

    fn number(text: &str) -> Decimal {
        Decimal::parse(text).unwrap()
    }

    #[test]
    fn numbers_are_written_as_people_write_them() {
        let pairs = [
            ("3.50", "3.5"),
            ("-0.0", "0"),
            ("007", "7"),
            ("+1200", "1200"),
            ("1e3", "1000"),
            ("2.5E-3", "0.0025"),
            (".5", "0.5"),
            ("1e-9", "1e-9"),
            ("1.25e30", "125e28"),
            ("-12.75", "-12.75"),
        ];
        for (text, shown) in pairs {
            assert_eq!(number(text).to_string(), shown);
            assert_eq!(number(text).value(), text.parse::<f64>().unwrap());
        }
        for text in [
            "", "-", ".", "x", "1e", "1e999", "nan", "inf", "1_000", "1e-999", "0x1",
        ] {
            assert_eq!(Decimal::parse(text), None, "{text}");
        }
    }

    #[test]
    fn what_is_no_number_is_told_from_what_is_too_large() {
        let long = "1".repeat(65);
        for text in ["1e400", "-1e-400", "2.5E+999", "1e99999999999"] {
            assert_eq!(Decimal::parse(text), None);
            assert_eq!(Decimal::wanted(text), "a number that 64 bits hold");
        }
        assert_eq!(Decimal::wanted(&long), "a number of at most 64 digits");
        for text in ["", "x", "1e", "1.2.3", "0x1", "nan"] {
            assert_eq!(Decimal::wanted(text), "a number, or `-` for any");
        }
    }

    #[test]
    fn a_cut_is_the_shortest_number_in_the_gap() {
        let cuts = [
            (("3", "4"), "3"),
            (("3.2", "3.9"), "3.5"),
            (("2", "7"), "4"),
            (("-1", "1"), "0"),
            (("0", "1"), "0"),
            (("-4", "-3"), "-4"),
            (("-3.9", "-3.2"), "-3.6"),
            (("0.30", "0.31"), "0.3"),
            (("0.1234", "0.1236"), "0.1234"),
            (("10", "100"), "50"),
            (("99.5", "100.5"), "100"),
            (("1e-9", "1"), "0.5"),
            (("0.301", "0.309"), "0.304"),
        ];
        for ((low, high), cut) in cuts {
            assert_eq!(
                number(low).up_to(&number(high)).to_string(),
                cut,
                "{low} {high}"
            );
        }
    }
}
