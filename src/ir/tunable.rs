//! Numbers of the program that may be tuned.

/// A number that may be tuned, in its own unit.
#[derive(Clone, Debug, PartialEq)]
pub struct Tunable {
    /// The item that it stands in, or the parameter that it is given.
    pub name: String,
    /// The value in use.
    pub value: f64,
    /// The least value.
    pub low: f64,
    /// The greatest value.
    pub high: f64,
    /// The unit of these numbers.
    pub unit: Unit,
}

/// A unit as the language writes it.
#[derive(Clone, Debug, PartialEq)]
pub struct Unit {
    /// Its spelling; empty for a plain number.
    pub text: String,
    /// One of the unit in SI base units is `times` / `over`.
    pub times: f64,
    /// See `times`.
    pub over: f64,
}

impl Unit {
    /// A number of this unit in SI base units.
    pub fn si(&self, number: f64) -> f64 {
        number * self.times / self.over
    }

    /// The number of this unit that a number in SI base units is.
    pub fn of_si(&self, number: f64) -> f64 {
        number * self.over / self.times
    }

    /// A number with this unit, as the formatter lays it out.
    pub fn written(&self, number: f64) -> String {
        // There is no minus zero in the language.
        let number = number + 0.0;
        match self.text.as_str() {
            "" => number.to_string(),
            "%" => format!("{number}%"),
            unit => format!("{number} {unit}"),
        }
    }
}

impl Tunable {
    /// A value as the language writes it.
    pub fn written(&self, number: f64) -> String {
        self.unit.written(number)
    }
}
