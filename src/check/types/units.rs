//! Units.

pub use crate::ir::dimension::Dim;
use crate::ir::tunable::Unit;
use crate::syntax::ast;
use std::f64::consts::PI;

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
