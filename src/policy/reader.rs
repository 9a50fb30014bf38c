//! Policies as other tools write them, a reader each.

mod dtcontrol;
mod guess;
mod header;
mod kinds;
mod lines;
mod refine_plan;
mod storm;

use super::error::{TableError, TableErrorKind};
use super::records;
use super::table::Table;
use super::valued::Valued;
use crate::ir::input::Measure;
pub(in crate::policy) use header::is_special;

/// How a table is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Format {
    /// Comma-separated text with a header.
    Csv,
    /// JSON Lines.
    Jsonl,
    /// A controller as dtControl reads it, comma-separated.
    Dtcontrol,
    /// A scheduler that Storm has exported as JSON.
    Storm,
    /// A policy of refine-plan, in YAML.
    RefinePlan,
}

impl Format {
    /// The format, by the first characters of the text, or else by the ending of the file's name.
    pub fn of(name: &str, text: &[u8]) -> Self {
        let text = text.get(records::start(text)..).unwrap_or_default();
        let text = text.trim_ascii_start();
        let ends = |endings: &[&str]| {
            endings.iter().any(|ending| {
                let tail = name.len().checked_sub(ending.len());
                let tail = tail.and_then(|at| name.get(at..));
                tail.is_some_and(|tail| tail.eq_ignore_ascii_case(ending))
            })
        };
        if dtcontrol::is_one(text) {
            Self::Dtcontrol
        } else if ends(&[".csv"]) {
            Self::Csv
        } else if ends(&[".jsonl", ".ndjson"]) {
            Self::Jsonl
        } else if ends(&[".yaml", ".yml"]) || refine_plan::is_one(text) {
            Self::RefinePlan
        } else {
            match text.first() {
                Some(b'[') => Self::Storm,
                Some(b'{') => Self::Jsonl,
                _ => Self::Csv,
            }
        }
    }
}

/// What a unit means; `None` for one that the language does not have.
pub type Units<'u> = &'u dyn Fn(&str) -> Option<Measure>;

/// A table, by what its columns hold.
#[derive(Clone, Debug)]
pub enum Given {
    /// Truth values alone.
    Truths(Table),
    /// Numbers and words, too.
    Values(Valued),
}

/// Reads a table.
///
/// # Errors
/// What is wrong with it, sorted by place.
pub fn read(text: &[u8], format: Format, units: Units) -> Result<Given, Vec<TableError>> {
    let values = match format {
        Format::Csv if kinds::are_declared(text) => kinds::read(text, units),
        Format::Csv => {
            let read = Table::read(text, format);
            return read.map(Given::Truths).map_err(|errors| {
                let guess = is_about_truth(&errors).then(|| guess::header(text));
                guess.flatten().map_or(errors, |error| vec![error])
            });
        }
        Format::Jsonl => match Table::read(text, format) {
            Ok(table) if !lines::are_declared(&table) => return Ok(Given::Truths(table)),
            Ok(_) => lines::read(text, units),
            Err(errors) if is_about_truth(&errors) => lines::read(text, units),
            Err(errors) => return Err(errors),
        },
        Format::Dtcontrol => dtcontrol::read(text),
        Format::Storm => storm::read(text),
        Format::RefinePlan => refine_plan::read(text),
    };
    values.map(Given::Values)
}

/// Whether a cell holds something else than a truth value.
fn is_about_truth(errors: &[TableError]) -> bool {
    errors.iter().any(|error| {
        matches!(
            &error.kind,
            TableErrorKind::UnknownValue { expected, .. }
                if expected.starts_with('`') || expected.starts_with('0')
        )
    })
}

/// A text as characters, or where it is none.
fn decoded(text: &[u8]) -> Result<&str, Vec<TableError>> {
    std::str::from_utf8(text).map_err(|error| {
        let at = error.valid_up_to();
        vec![TableError {
            span: at..at + 1,
            kind: TableErrorKind::NoText,
        }]
    })
}
