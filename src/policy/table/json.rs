//! JSON Lines: an object a line, flat, with the names of a header as its keys.
//!
//! An atom is `0`, `1`, `false`, `true`, or `"-"` or `null` for either. The values of behaviours may stand in an object
//! under `q`. The first line says which atoms there are; values and visits may be left out in any.

use super::Reading;
use super::columns::Role;
use super::rows::Truth;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::records;
use object::{Object, Value};
use std::collections::BTreeMap;
use std::ops::Range;

pub(in crate::policy) mod object;

pub(super) fn read(text: &[u8], reading: &mut Reading) {
    let mut keys: Option<Keys> = None;
    let mut at = records::start(text);
    while at < text.len() && !reading.is_full() {
        let rest = text.get(at..).unwrap_or_default();
        let length = rest.iter().position(|b| *b == b'\n').unwrap_or(rest.len());
        let line = rest.get(..length).unwrap_or_default();
        let start = at + line.len() - line.trim_ascii_start().len();
        at += length + 1;
        let line = line.trim_ascii();
        if line.is_empty() {
            continue;
        }
        let line = Line { text: line, start };
        let object = match line.object() {
            Ok(object) => object,
            Err(error) => {
                reading.mistake(error);
                continue;
            }
        };
        let keys = keys.get_or_insert_with(|| Keys::of(&object, &line, reading));
        if reading.is_full() {
            return;
        }
        line.row(&object, keys, reading);
    }
}

/// What other languages write for numbers and truth values.
const UNKNOWN: [&str; 6] = ["NaN", "Infinity", "-Infinity", "True", "False", "None"];

/// A line of the text.
pub(in crate::policy) struct Line<'t> {
    pub(in crate::policy) text: &'t [u8],
    pub(in crate::policy) start: usize,
}

/// What the keys of an object say.
struct Keys {
    /// In the order of the first line.
    roles: Vec<(String, Role)>,
    numbers: BTreeMap<String, usize>,
    /// The line in which each was said last.
    said: Vec<usize>,
    lines: usize,
}

impl Keys {
    fn of(object: &Object, line: &Line, reading: &mut Reading) -> Self {
        let names = object
            .fields()
            .filter(|(_, value)| !matches!(value, Value::Object(_)));
        let mut names: Vec<_> = names
            .map(|(name, _)| (name.to_owned(), line.place(name)))
            .collect();
        // A key that appears twice is reported with its row.
        let mut known: Vec<String> = Vec::new();
        names.retain(|(name, _)| {
            let new = !known.contains(name);
            known.push(name.clone());
            new
        });
        let roles = reading.columns(names.clone(), line.whole());
        let roles: Vec<_> = names.into_iter().map(|(name, _)| name).zip(roles).collect();
        let numbers = roles.iter().enumerate();
        Self {
            numbers: numbers.map(|(i, (name, _))| (name.clone(), i)).collect(),
            said: vec![0; roles.len()],
            roles,
            lines: 0,
        }
    }

    /// The number of a key, likely the one that stands `at` in the first line.
    fn number(&self, name: &str, at: usize) -> Option<usize> {
        match self.roles.get(at) {
            Some((likely, _)) if likely == name => Some(at),
            _ => self.numbers.get(name).copied(),
        }
    }

    /// Adds the column of a value.
    fn add(&mut self, name: &str, column: usize) -> usize {
        let number = self.roles.len();
        self.roles.push((name.to_owned(), Role::Value(column)));
        self.numbers.insert(name.to_owned(), number);
        self.said.push(0);
        number
    }
}

impl Line<'_> {
    /// What stands in the line.
    ///
    /// # Errors
    /// It is no object, from the place on where that shows.
    pub(in crate::policy) fn object(&self) -> Result<Object<'_>, TableError> {
        serde_json::from_slice(self.text).map_err(|error| {
            let column = error.column().clamp(1, self.text.len());
            let at = records::character(self.text, column - 1);
            let rest = self.text.get(at..).unwrap_or_default();
            // The message of the library ends in a line and a column of its own.
            let why = error.to_string();
            let why = why.split(" at line ").next().unwrap_or_default();
            let why = match UNKNOWN
                .iter()
                .find(|word| rest.starts_with(word.as_bytes()))
            {
                Some(word) => format!("JSON has no `{word}`"),
                None => why.to_owned(),
            };
            TableError {
                span: self.start + at..self.start + self.text.len(),
                kind: TableErrorKind::Malformed(why),
            }
        })
    }

    pub(in crate::policy) fn whole(&self) -> Range<usize> {
        self.start..self.start + self.text.len()
    }

    fn row(&self, object: &Object, keys: &mut Keys, reading: &mut Reading) {
        keys.lines += 1;
        reading.begin();
        for (at, (name, value)) in object.fields().enumerate() {
            match value {
                Value::Object(values) if name == "q" => {
                    for (behavior, value) in values {
                        let name = format!("q:{behavior}");
                        self.field(&name, behavior, value, at, keys, reading);
                    }
                }
                value => self.field(name, name, value, at, keys, reading),
            }
        }
        for ((name, role), said) in keys.roles.iter().zip(&keys.said) {
            let needed = matches!(role, Role::Atom(_) | Role::Behavior);
            if needed && *said != keys.lines {
                reading.report(&self.whole(), TableErrorKind::MissingKey(name.clone()));
            }
        }
        reading.end(self.start);
    }

    /// A key and its value; `shown` is the key as it stands in the line.
    fn field(
        &self,
        name: &str,
        shown: &str,
        value: &Value,
        at: usize,
        keys: &mut Keys,
        reading: &mut Reading,
    ) {
        let number = keys.number(name, at).or_else(|| {
            let behavior = name.strip_prefix("q:")?;
            let column = reading.another_value(behavior, &self.place(shown))?;
            Some(keys.add(name, column))
        });
        let Some(number) = number else {
            let kind = match value {
                Value::Object(_) => TableErrorKind::UnknownValue {
                    found: value.to_string(),
                    expected: "a truth value, a number, a word or null: objects are flat",
                },
                _ => TableErrorKind::UnknownKey(name.to_owned()),
            };
            return reading.report(&self.place(shown), kind);
        };
        let (Some((_, role)), Some(said)) = (keys.roles.get(number), keys.said.get_mut(number))
        else {
            return;
        };
        if std::mem::replace(said, keys.lines) == keys.lines {
            let kind = TableErrorKind::RepeatedColumn(name.to_owned());
            return reading.report(&self.place(shown), kind);
        }
        let expected = match *role {
            Role::Atom(atom) => match value.truth() {
                Some(truth) => return reading.draft.say(atom, truth),
                None => "0, 1, true, false, null or \"-\"",
            },
            Role::Behavior => match value {
                Value::Text(name) => return reading.decided(name.as_bytes(), &self.place(shown)),
                Value::Number(number) => {
                    let name = number.to_string();
                    return reading.decided(name.as_bytes(), &self.place(shown));
                }
                Value::List(Some(names)) if !names.is_empty() => {
                    return reading.allowed(names, &self.place(shown));
                }
                _ => "a behaviour, or a list of some",
            },
            Role::Visits => match value.number(|number| number.as_u64()) {
                Some(visits) => {
                    reading.draft.visits = visits.unwrap_or(0);
                    return;
                }
                None => "a count",
            },
            Role::Value(column) => match value.number(|number| number.as_f64()) {
                Some(q) if q.is_none_or(f64::is_finite) => {
                    return reading.draft.value(column, q);
                }
                _ => "a finite number",
            },
            Role::Ignored => return,
        };
        let kind = TableErrorKind::UnknownValue {
            found: value.to_string(),
            expected,
        };
        reading.report(&self.place(shown), kind);
    }

    /// The place of a key with its value: the first text of this name before a colon.
    pub(in crate::policy) fn place(&self, key: &str) -> Range<usize> {
        let quoted = serde_json::to_string(key).unwrap_or_default();
        let line = String::from_utf8_lossy(self.text);
        let found = line.match_indices(&quoted).find_map(|(at, _)| {
            let rest = line.get(at + quoted.len()..)?;
            let value = rest.trim_start().strip_prefix(':')?;
            Some((at, line.len() - value.len() + value_length(value)))
        });
        match found {
            // Bytes that are no text would move what stands behind them.
            Some((from, to)) if line.len() == self.text.len() => self.start + from..self.start + to,
            _ => self.whole(),
        }
    }
}

/// How long the value at the start of a text is, with the blanks before it.
fn value_length(text: &str) -> usize {
    let (mut depth, mut quoted, mut escaped) = (0_usize, false, false);
    for (at, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ if quoted => {}
            '{' | '[' => depth += 1,
            '}' | ']' | ',' if depth == 0 => {
                return text.get(..at).unwrap_or_default().trim_end().len();
            }
            '}' | ']' => depth -= 1,
            _ => {}
        }
    }
    text.len()
}

impl Value<'_> {
    fn truth(&self) -> Option<Truth> {
        match self {
            Value::Null => Some(Truth::Either),
            Value::Bool(value) => Some(if *value { Truth::Yes } else { Truth::No }),
            Value::Number(number) => match number.as_f64() {
                Some(0.0) => Some(Truth::No),
                Some(1.0) => Some(Truth::Yes),
                _ => None,
            },
            Value::Text(text) => match text.as_ref() {
                "0" => Some(Truth::No),
                "1" => Some(Truth::Yes),
                "-" => Some(Truth::Either),
                _ => None,
            },
            Value::Object(_) | Value::List(_) => None,
        }
    }

    /// The number, nothing for `null`; `None` if it is something else.
    fn number<T>(&self, read: impl Fn(&serde_json::Number) -> Option<T>) -> Option<Option<T>> {
        match self {
            Value::Null => Some(None),
            Value::Number(number) => read(number).map(Some),
            _ => None,
        }
    }
}
