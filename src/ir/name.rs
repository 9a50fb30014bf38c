//! Names as data: what stands in a family, with which arguments.

use crate::spelling::spelled;
use serde::{Serialize, Serializer};
use std::fmt;

/// What the program calls something, such as `low` or `goto(A, margin = 5 cm)`.
///
/// Only `check` and `policy` make names, from what a person wrote; [`fmt::Display`] gives the language's spelling.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Name {
    /// The word, or the name of the family, without backquotes.
    pub family: String,
    /// The parameters of the family, as declared, each with what it is given.
    pub arguments: Vec<Argument>,
    /// Which coordinate of a point this is.
    coordinate: Option<Coordinate>,
    /// The robot whose it is, where it is not the acting one's.
    robot: Option<String>,
}

/// A parameter of a family, with what it is given.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Argument {
    /// The name of the parameter, without backquotes.
    pub parameter: String,
    /// What it is given; `None` if it has its default.
    pub value: Option<Given>,
}

/// What a parameter is given.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Given {
    /// Something that has a name: a place, a wall, a sensor, a behaviour, a variant.
    Name(Name),
    /// Any other expression, as the language writes it.
    Text(String),
    /// A number that may be tuned.
    Tuned {
        /// With the range, as the language writes it.
        written: String,
        /// The value in use.
        value: String,
    },
}

/// A coordinate of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Coordinate {
    /// The first.
    X,
    /// The second.
    Y,
}

impl Name {
    /// Whether the two are of one family and one robot and have the same arguments but for numbers.
    pub fn differs_in_numbers(&self, other: &Self) -> bool {
        let is_number = |given: &Given| match given {
            Given::Name(_) => false,
            Given::Text(text) => text.starts_with(|c: char| c.is_ascii_digit() || c == '-'),
            Given::Tuned { .. } => true,
        };
        let rest = |name: &Self| -> Vec<Option<Given>> {
            let given = name.arguments.iter().map(|argument| &argument.value);
            let rest = given.map(|given| given.clone().filter(|given| !is_number(given)));
            rest.collect()
        };
        self.family == other.family && self.robot == other.robot && rest(self) == rest(other)
    }

    /// A name without arguments.
    pub fn word(word: impl Into<String>) -> Self {
        Self {
            family: word.into(),
            ..Self::default()
        }
    }

    /// What is of a family, with these arguments.
    pub fn instance(family: impl Into<String>, arguments: Vec<Argument>) -> Self {
        Self {
            arguments,
            ..Self::word(family)
        }
    }

    /// What the history says of a behaviour: `done(goto(A))`, `failed(goto(A))`.
    pub fn history(outcome: &str, behavior: &Name) -> Self {
        let argument = Argument {
            parameter: "behavior".to_owned(),
            value: Some(Given::Name(behavior.clone())),
        };
        Self::instance(outcome, vec![argument])
    }

    /// A coordinate of the point of this name.
    #[must_use]
    pub fn coordinate(&self, coordinate: Coordinate) -> Self {
        Self {
            coordinate: Some(coordinate),
            ..self.clone()
        }
    }

    /// The same of another robot.
    #[must_use]
    pub fn of_robot(&self, robot: &Name) -> Self {
        Self {
            robot: Some(robot.family.clone()),
            ..self.clone()
        }
    }

    /// The same of the acting robot.
    #[must_use]
    pub fn of_acting(&self) -> Self {
        Self {
            robot: None,
            ..self.clone()
        }
    }

    /// The robot whose it is, where it is not the acting one's.
    pub fn robot(&self) -> Option<&str> {
        self.robot.as_deref()
    }

    /// The values that are given, each with its parameter if it stands by name: by position as long as none is left out.
    pub fn given(&self) -> impl Iterator<Item = (Option<&str>, &Given)> {
        let mut left_out = false;
        self.arguments.iter().filter_map(move |argument| {
            left_out |= argument.value.is_none();
            let parameter = left_out.then_some(argument.parameter.as_str());
            Some((parameter, argument.value.as_ref()?))
        })
    }

    /// The word, if there is nothing to the name but a word.
    pub fn as_word(&self) -> Option<&str> {
        let alone = self.given().next().is_none();
        let alone = alone && self.coordinate.is_none() && self.robot.is_none();
        alone.then_some(self.family.as_str())
    }

    /// The name as tables and other programs have it: a word alone needs no backquotes there.
    pub fn bare(&self) -> String {
        self.as_word()
            .map_or_else(|| self.to_string(), str::to_owned)
    }

    /// Whether a person means this name by a text, with or without backquotes.
    pub fn is(&self, text: &str) -> bool {
        self.as_word() == Some(text) || self.to_string() == text
    }
}

/// Names in a row, with commas.
pub fn list<'n>(names: impl IntoIterator<Item = &'n Name>) -> String {
    let names: Vec<String> = names.into_iter().map(Name::to_string).collect();
    names.join(", ")
}

impl From<&str> for Name {
    fn from(word: &str) -> Self {
        Self::word(word)
    }
}

impl fmt::Display for Name {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut text = spelled(&self.family).into_owned();
        let given = self.given().map(|(parameter, value)| match parameter {
            Some(parameter) => format!("{} = {value}", spelled(parameter)),
            None => value.to_string(),
        });
        let by = self.robot.as_ref();
        let by = by.map(|robot| format!("by = {}", spelled(robot)));
        let given: Vec<String> = given.chain(by).collect();
        if !given.is_empty() {
            text.push_str(&format!("({})", given.join(", ")));
        }
        match self.coordinate {
            Some(Coordinate::X) => text.push_str(".x"),
            Some(Coordinate::Y) => text.push_str(".y"),
            None => {}
        }
        f.pad(&text)
    }
}

impl Serialize for Name {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl fmt::Display for Given {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Given::Name(name) => name.fmt(f),
            Given::Text(text) => f.pad(text),
            Given::Tuned { written, .. } => f.pad(written),
        }
    }
}
