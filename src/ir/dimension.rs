//! Dimensions.

use std::fmt;

/// The exponents of the base dimensions.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Dim {
    /// Of length, in metres.
    pub length: i32,
    /// Of time, in seconds.
    pub time: i32,
    /// Of angle, in radians.
    pub angle: i32,
}

impl Dim {
    /// A plain number.
    pub const NONE: Dim = Dim::new(0, 0, 0);
    /// m
    pub const LENGTH: Dim = Dim::new(1, 0, 0);
    /// s
    pub const TIME: Dim = Dim::new(0, 1, 0);
    /// rad
    pub const ANGLE: Dim = Dim::new(0, 0, 1);
    /// m/s
    pub const SPEED: Dim = Dim::new(1, -1, 0);
    /// rad/s
    pub const TURN_RATE: Dim = Dim::new(0, -1, 1);
    /// 1/s
    pub const FREQUENCY: Dim = Dim::new(0, -1, 0);

    /// The dimension with these exponents.
    pub const fn new(length: i32, time: i32, angle: i32) -> Self {
        Self {
            length,
            time,
            angle,
        }
    }

    /// Of a product with `power` factors of `other`.
    #[must_use]
    pub fn times(self, other: Self, power: i32) -> Self {
        let sum = |a: i32, b: i32| a.saturating_add(b.saturating_mul(power));
        Self {
            length: sum(self.length, other.length),
            time: sum(self.time, other.time),
            angle: sum(self.angle, other.angle),
        }
    }

    /// Of the square root, if the exponents are even.
    pub fn root(self) -> Option<Self> {
        let even = self.length % 2 == 0 && self.time % 2 == 0 && self.angle % 2 == 0;
        even.then(|| Self::new(self.length / 2, self.time / 2, self.angle / 2))
    }

    /// A unit of this dimension as the language writes it. `None` unless its numerator has exactly one factor.
    pub fn unit(self) -> Option<String> {
        let one_above = [self.length, self.angle, self.time]
            .iter()
            .filter(|&&exponent| exponent > 0)
            .count()
            == 1;
        (self == Self::FREQUENCY || one_above).then(|| self.in_si())
    }

    /// The factors of the type, above the line and below it.
    pub fn factors(self) -> u64 {
        let powers = [self.length, self.angle, self.time];
        powers
            .iter()
            .map(|power| u64::from(power.unsigned_abs()))
            .sum()
    }

    /// The dimension in SI units, as a person reads it: `rad·s/m^2`, `1/m`.
    fn in_si(self) -> String {
        if self == Self::FREQUENCY {
            return "Hz".to_owned();
        }
        let factors = [("m", self.length), ("rad", self.angle), ("s", self.time)];
        let power = |(name, exponent): (&str, i32)| match exponent.abs() {
            1 => name.to_owned(),
            n => format!("{name}^{n}"),
        };
        let chosen = |above: bool| {
            let side = factors
                .into_iter()
                .filter(move |&(_, e)| e != 0 && (e > 0) == above);
            side.map(power).collect::<Vec<_>>()
        };
        let mut text = match chosen(true).as_slice() {
            [] => "1".to_owned(),
            above => above.join("·"),
        };
        for factor in chosen(false) {
            text.push('/');
            text.push_str(&factor);
        }
        text
    }
}

impl Dim {
    /// The type of quantities of this dimension, as the language writes it.
    pub fn written(self) -> String {
        let named = match self {
            Dim::NONE => "number",
            Dim::LENGTH => "length",
            Dim::TIME => "time",
            Dim::ANGLE => "angle",
            Dim::SPEED => "speed",
            Dim::TURN_RATE => "turn_rate",
            Dim::FREQUENCY => "frequency",
            _ => return self.product(),
        };
        named.to_owned()
    }

    fn product(self) -> String {
        let factors = [
            ("length", self.length),
            ("angle", self.angle),
            ("time", self.time),
        ];
        let side = |above: bool| {
            let side = factors.into_iter();
            let side = side.filter(move |(_, power)| (*power > 0) == above);
            side.flat_map(|(name, power)| std::iter::repeat_n(name, power.unsigned_abs() as usize))
        };
        let above: Vec<&str> = side(true).collect();
        let mut text = match above.is_empty() {
            true => "number".to_owned(),
            false => above.join("*"),
        };
        for name in side(false) {
            text.push('/');
            text.push_str(name);
        }
        text
    }
}

impl fmt::Display for Dim {
    /// The dimension as a person names it: `a speed (m/s)`.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let named = match *self {
            Dim::NONE => return f.write_str("a plain number"),
            Dim::LENGTH => Some("a length"),
            Dim::TIME => Some("a time"),
            Dim::ANGLE => Some("an angle"),
            Dim::SPEED => Some("a speed"),
            Dim::TURN_RATE => Some("a turn rate"),
            Dim::FREQUENCY => Some("a frequency"),
            _ => None,
        };
        match named {
            Some(name) => write!(f, "{name} ({})", self.in_si()),
            None => write!(f, "a quantity in {}", self.in_si()),
        }
    }
}
