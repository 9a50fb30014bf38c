//! Names of columns with the kinds behind them: `x:number`, `x:number m`, `mode:{a,b}`, `carrying`.

use super::Units;
use crate::ir::input::Measure;
use crate::policy::error::TableErrorKind;
use crate::policy::names::AtomName;
use crate::policy::table::BEHAVIOR;
use crate::policy::valued::Builder;
use crate::spelling::bare;
use std::ops::Range;
use strsim::osa_distance;

/// What other languages call the kinds of columns.
const FOREIGN: [&str; 15] = [
    "float",
    "int",
    "integer",
    "double",
    "real",
    "numeric",
    "num",
    "string",
    "str",
    "enum",
    "category",
    "categorical",
    "text",
    "boolean",
    "bool",
];

/// The mistakes that a word for `number` may have.
const NEARLY: usize = 2;

/// What a column says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// In what state a row is, by the number of the column.
    State(usize),
    /// What is done.
    Behavior,
    /// How many decisions stand behind the row.
    Visits,
    /// Nothing that is said of a table of values.
    Ignored,
    /// Nothing that can be told: a list of values without an end takes in the columns behind it.
    Open,
}

/// The name of a column and the kind that stands behind it.
pub(super) fn divided(column: &str) -> Option<(&str, &str)> {
    let is_quoted = column.starts_with('`') && column.ends_with('`');
    if column.starts_with("q:") || is_quoted {
        return None;
    }
    column.match_indices(':').find_map(|(at, _)| {
        let (name, kind) = (column.get(..at)?.trim(), column.get(at + 1..)?.trim());
        let word: String = kind.chars().take_while(|c| c.is_alphanumeric()).collect();
        let word = word.to_ascii_lowercase();
        let known = word == "number"
            || kind.is_empty()
            || kind.starts_with('{')
            || FOREIGN.contains(&word.as_str())
            || osa_distance(&word, "number") <= NEARLY;
        (known && !name.is_empty()).then_some((name, kind))
    })
}

/// Whether a column of this name says something else than whether a predicate of this name holds.
pub(in crate::policy) fn is_special(name: &str) -> bool {
    let word = BEHAVIOR.contains(&name) || matches!(name, "visits" | "q_gap");
    let value = name.starts_with("q:") || divided(name).is_some();
    word || value || AtomName::read(name) != AtomName::Predicate(name.to_owned())
}

/// Whether a list of values begins and does not end.
pub(super) fn is_open(kind: &str) -> bool {
    kind.starts_with('{') && !kind.ends_with('}')
}

/// What is assumed of a column without a kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Assumed {
    Truth,
    Number,
    Category,
}

/// The role of a column; mistakes are reported.
pub(super) fn role(
    builder: &mut Builder,
    (column, place): (&str, &Range<usize>),
    assumed: Assumed,
    units: Units,
) -> Role {
    if BEHAVIOR.contains(&column) {
        return Role::Behavior;
    }
    match column {
        "" => {
            builder.report(place, TableErrorKind::Nameless);
            return Role::Ignored;
        }
        "visits" => return Role::Visits,
        "q_gap" => return Role::Ignored,
        _ if column.starts_with("q:") => return Role::Ignored,
        _ => {}
    }
    let Some((name, kind)) = divided(column) else {
        return Role::State(match assumed {
            Assumed::Truth => builder.truth(column, place),
            Assumed::Number => builder.number(column, place, Measure::plain()),
            Assumed::Category => builder.category(column, place, Vec::new()),
        });
    };
    let unknown = || TableErrorKind::UnknownKind {
        name: name.to_owned(),
        found: kind.to_owned(),
    };
    if is_open(kind) {
        builder.report(place, TableErrorKind::OpenValues(name.to_owned()));
        return Role::Open;
    }
    if let Some(values) = kind.strip_prefix('{') {
        let values = values.strip_suffix('}').unwrap_or(values).split(',');
        let values = values.map(|value| bare(value.trim().trim_matches('"')).to_owned());
        let values: Vec<String> = values.filter(|value| !value.is_empty()).collect();
        if values.is_empty() {
            builder.report(place, TableErrorKind::NoValues(name.to_owned()));
            return Role::Ignored;
        }
        return Role::State(builder.category(name, place, values));
    }
    let Some(unit) = kind.strip_prefix("number").map(str::trim) else {
        if kind == "bool" {
            return Role::State(builder.truth(name, place));
        }
        builder.report(place, unknown());
        return Role::Ignored;
    };
    let measure = match unit {
        "" => Some(Measure::plain()),
        unit => units(unit),
    };
    match measure {
        Some(measure) => Role::State(builder.number(name, place, measure)),
        None => {
            builder.report(place, TableErrorKind::UnknownUnit(unit.to_owned()));
            Role::Ignored
        }
    }
}

/// Reports a table that does not say what is done, or says it twice.
pub(super) fn decides(builder: &mut Builder, roles: &[(Role, String)], header: &Range<usize>) {
    let mut deciding = roles.iter().filter(|(role, _)| *role == Role::Behavior);
    match (deciding.next(), deciding.next()) {
        (None, _) if roles.iter().any(|(role, _)| *role == Role::Open) => {}
        (None, _) => builder.report(
            header,
            TableErrorKind::MissingColumn {
                name: "behavior".to_owned(),
                likely: None,
            },
        ),
        (Some(_), Some((_, second))) => {
            builder.report(header, TableErrorKind::SecondBehavior(second.clone()));
        }
        (Some(_), None) => {}
    }
}
