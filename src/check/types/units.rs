//! Dimensions and units.

use crate::ir::tunable::Unit;
use crate::syntax::ast;
use std::f64::consts::PI;
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

    /// The dimension as the language writes it, by the names of types: `length*length/time`. A product of its own begins
    /// with what is above the line.
    pub fn written(self) -> Option<String> {
        let bases = [
            ("length", self.length),
            ("angle", self.angle),
            ("time", self.time),
        ];
        let above = bases.iter().flat_map(|&(name, exponent)| {
            std::iter::repeat_n(name, usize::try_from(exponent).unwrap_or(0))
        });
        let below = bases.iter().flat_map(|&(name, exponent)| {
            std::iter::repeat_n(name, usize::try_from(-i64::from(exponent)).unwrap_or(0))
        });
        let (above, below): (Vec<&str>, Vec<&str>) =
            (above.take(9).collect(), below.take(9).collect());
        if above.len() + below.len() > 8 {
            return None;
        }
        let mut text = match above.as_slice() {
            [] => "number".to_owned(),
            above => above.join("*"),
        };
        for factor in below {
            text.push('/');
            text.push_str(factor);
        }
        Some(text)
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

/// What a literal's number is multiplied and divided by to be in SI base units; two numbers, so that `35%` and `5 cm`
/// come out as the nearest `f64` of what they say.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scale {
    times: f64,
    over: f64,
}

impl Scale {
    /// Of SI base units.
    pub const ONE: Scale = Scale {
        times: 1.0,
        over: 1.0,
    };

    /// Of `%`.
    pub const PERCENT: Scale = Scale {
        times: 1.0,
        over: 100.0,
    };

    /// The scale of a unit as the IR keeps it.
    pub fn of_unit(self, text: &str) -> Unit {
        Unit {
            text: text.to_owned(),
            times: self.times,
            over: self.over,
        }
    }

    /// The number in SI base units.
    pub fn apply(self, number: f64) -> f64 {
        number * self.times / self.over
    }

    fn times(self, other: Self, power: i32) -> Self {
        let factor = if power < 0 {
            Scale {
                times: other.over,
                over: other.times,
            }
        } else {
            other
        };
        (0..power.unsigned_abs()).fold(self, |scale, _| Scale {
            times: scale.times * factor.times,
            over: scale.over * factor.over,
        })
    }
}

/// What a unit says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Meaning {
    /// Its dimension.
    pub dim: Dim,
    /// Its size.
    pub scale: Scale,
    /// Whether it is `%`.
    pub percent: bool,
}

/// The meaning of a unit; `tick` is the length of the world's tick in seconds. `None` if a factor is unknown, or if it
/// counts in ticks and there is no world to say how long they are.
pub fn meaning(unit: &ast::Unit, tick: Option<f64>) -> Option<Meaning> {
    let mut dim = Dim::NONE;
    let mut scale = Scale::ONE;
    let mut percent = false;
    for factor in &unit.factors {
        let (times, over, of) = match factor.name.as_str() {
            "m" => (1.0, 1.0, Dim::LENGTH),
            "cm" => (1.0, 100.0, Dim::LENGTH),
            "mm" => (1.0, 1000.0, Dim::LENGTH),
            "km" => (1000.0, 1.0, Dim::LENGTH),
            "s" => (1.0, 1.0, Dim::TIME),
            "ms" => (1.0, 1000.0, Dim::TIME),
            "min" => (60.0, 1.0, Dim::TIME),
            "h" => (3600.0, 1.0, Dim::TIME),
            "tick" | "ticks" => (tick?, 1.0, Dim::TIME),
            "deg" => (PI, 180.0, Dim::ANGLE),
            "rad" => (1.0, 1.0, Dim::ANGLE),
            "Hz" => (1.0, 1.0, Dim::FREQUENCY),
            "%" => {
                percent = true;
                (1.0, 100.0, Dim::NONE)
            }
            _ => return None,
        };
        dim = dim.times(of, factor.power);
        scale = scale.times(Scale { times, over }, factor.power);
    }
    Some(Meaning {
        dim,
        scale,
        percent: percent && unit.factors.len() == 1,
    })
}
