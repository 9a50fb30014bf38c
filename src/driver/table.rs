//! The tables of a user, read with diagnostics.

use super::load::Loaded;
use super::refused::Refused;
use super::text::Text;
use crate::check;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::ir::task::Task;
use crate::ir::{Id, Program};
use crate::policy::error::{TableError, TableErrorKind};
pub use crate::policy::reader::Format;
use crate::policy::reader::{self, Given};
use crate::policy::table::{self, Table};
use crate::policy::{Policy, decisions, transitions};
use crate::source::{FileId, Span};

/// The record of a process under a policy.
#[derive(Clone, Copy, Debug)]
pub struct Recorded<'t> {
    /// Greedy transitions, with start minterms or without.
    pub transitions: Text<'t>,
    /// Start minterms.
    pub starts: Option<Text<'t>>,
}

/// The policy table in a text of any origin; `from` says how it is written, if that is not to be seen.
///
/// # Errors
/// The mistakes of the text.
pub fn read(text: Text, from: Option<Format>) -> Result<Given, Refused> {
    let format = from.unwrap_or_else(|| Format::of(text.name, text.bytes));
    let read = reader::read(text.bytes, format, &check::unit);
    read.map_err(|errors| refused(text, &errors))
}

/// The policy table in a text, where truth values alone can be compared.
///
/// # Errors
/// The mistakes of the text, or its columns hold something else.
pub fn of_truths(text: Text) -> Result<Table, Refused> {
    match read(text, None)? {
        Given::Truths(table) => Ok(table),
        Given::Values(values) => Err(Refused::text(text, |file| {
            let span = Span::new(file, values.header.start, values.header.end);
            let message =
                "this table holds numbers or words, and here truth values alone are compared";
            vec![
                Diagnostic::new(Code::E0826, span, message)
                    .help("`btc verify FILE TREE TABLE` compares such a table with a tree"),
            ]
        })),
    }
}

/// Adds start minterms and greedy transitions to a policy. A table of starts adds to those that the transitions have.
///
/// # Errors
/// The mistakes of the texts.
pub fn record(policy: &mut Policy, program: &Program, recorded: Recorded) -> Result<(), Refused> {
    let one = |text: Text, read: &mut dyn FnMut(&str) -> Result<(), TableError>| {
        let decoded = std::str::from_utf8(text.bytes).map_err(|_| refused(text, &[]))?;
        read(decoded).map_err(|error| refused(text, &[error]))
    };
    one(recorded.transitions, &mut |text| {
        transitions::read(text, program, policy)
    })?;
    if let Some(starts) = recorded.starts {
        one(starts, &mut |text| {
            transitions::read_starts(text, program, policy)
        })?;
    }
    if policy.starts.is_empty() {
        return Err(Refused::text(recorded.transitions, |file| {
            let start = Span::new(file, 0, 0);
            let message = "no start minterm is given";
            vec![
                Diagnostic::new(Code::E0818, start, message)
                    .label("no row here has the status `start`")
                    .help("give the start minterms in a table of their own, with `--start FILE`"),
            ]
        }));
    }
    Ok(())
}

/// The policy for a task in a table of its decisions.
///
/// # Errors
/// The mistakes of the table.
pub fn policy(program: &Program, text: Text, task: Id<Task>) -> Result<Policy, Refused> {
    let decoded = std::str::from_utf8(text.bytes).map_err(|_| refused(text, &[]))?;
    decisions::read(decoded, program, Some(task)).map_err(|errors| refused(text, &errors))
}

/// The environment in a file of transitions, which a program uses.
///
/// # Errors
/// The mistake of the table.
pub fn environment(loaded: &Loaded, file: FileId, task: Id<Task>) -> Result<Policy, Refused> {
    let program = &loaded.program;
    let text = loaded.sources.get(file).map_or("", |source| &source.text);
    let mut policy = Policy {
        atoms: program.atoms(task),
        behaviors: program.tasks[task].choose.clone(),
        history: program.tasks[task].history,
        ..Policy::default()
    };
    match transitions::read(text, program, &mut policy) {
        Ok(()) => Ok(policy),
        Err(error) => Err(Refused::program(loaded, located_all(file, text, &[error]))),
    }
}

/// Mistakes of one table.
pub(super) fn refused(text: Text, errors: &[TableError]) -> Refused {
    let shown = std::str::from_utf8(text.bytes).unwrap_or_default();
    Refused::text(text, |file| located_all(file, shown, errors))
}

/// Mistakes at their places in a file; the last says so if the reading stopped there.
fn located_all(file: FileId, text: &str, errors: &[TableError]) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = errors
        .iter()
        .map(|error| located(file, text, error))
        .collect();
    if found.len() >= table::MISTAKES
        && let Some(last) = found.pop()
    {
        found.push(last.note("the table may have more mistakes, which are not listed"));
    }
    found
}

fn located(file: FileId, text: &str, error: &TableError) -> Diagnostic {
    let span = |range: &std::ops::Range<usize>| Span::new(file, range.start, range.end);
    let found = Diagnostic::new(code(&error.kind), span(&error.span), error.to_string());
    match &error.kind {
        TableErrorKind::Contradiction { earlier, overlap } => {
            let found = found.also(span(earlier), "this row differs");
            match overlap {
                Some(common) => found.note(format!("both rows cover minterms with {common}")),
                None => found,
            }
        }
        TableErrorKind::Wide => found.help("write out what it leaves open with `-`"),
        TableErrorKind::Disagreement { earlier, rounded } => {
            let found = found.also(span(earlier), "this row differs");
            match rounded {
                Some([one, other]) => {
                    found.note(format!("`{one}` and `{other}` round to one number of 64 bits"))
                }
                None => found,
            }
        }
        TableErrorKind::Empty => found.label("a table has a header and a row for each minterm"),
        TableErrorKind::MissingColumn {
            likely: Some(likely),
            ..
        } => found.help(format!("is it `{likely}`?")),
        TableErrorKind::MissingColumn { name, .. }
            if name == "behavior" && text.starts_with(".i ") =>
        {
            found.help("this is a PLA: `btc minimize` reads it")
        }
        TableErrorKind::MissingColumn { name, .. }
            if name == "behavior" && text.starts_with('#') =>
        {
            found.help("a remark above the header begins with `## `")
        }
        TableErrorKind::MissingColumn { name, .. } if name == "behavior" => {
            found.help("what is done stands under `behavior`, `behaviour` or `action`")
        }
        TableErrorKind::Nameless if text.get(..error.span.start).is_some_and(|before| before.ends_with(',')) => {
            found.help("a comma at the end of a line begins one more column")
        }
        TableErrorKind::Nameless => {
            found.help("a table that pandas has written has a column of row numbers: write it with `index=False`")
        }
        TableErrorKind::Undeclared { header, .. } => found
            .label("a column without a kind holds `0`, `1` or `-`")
            .help(format!("write the kinds into the header: {header}"))
            .note("a number may have a unit, `x:number m`"),
        TableErrorKind::UnknownKind { name, .. } => found.help(format!(
            "the kinds are `{name}:number`, `{name}:number m` with a unit, `{name}:{{a,b}}` with the values, and `{name}` alone for 0 and 1"
        )),
        TableErrorKind::OpenValues(name) => found
            .label("`{` has no `}`")
            .help(format!("the values stand in braces: `{name}:{{a,b}}`")),
        TableErrorKind::UnknownUnit(_) => {
            found.note("the units are those of the language: m, cm, mm, km, s, ms, min, h, deg, rad, Hz, %, and quotients such as m/s")
        }
        TableErrorKind::NoValue { found: word, column, values, cells } => {
            let found = match cells {
                1 => found,
                cells => found.note(format!("{cells} cells hold it")),
            };
            match suggest::nearest(word, values.iter().map(String::as_str)) {
                Some(likely) => found.label(format!("did you mean `{likely}`?")),
                None if word.is_empty() => found.help("`-` stands for any value"),
                None => found.help(format!("the values of `{column}` are {}", suggest::first(values))),
            }
        }
        TableErrorKind::UnknownValue { found: cell, expected } if expected.starts_with("a number") => {
            match number_help(cell) {
                Some(help) => found.help(help),
                None => found,
            }
        }
        TableErrorKind::UnknownValue { found: cell, .. } => match truth_help(cell) {
            Some(help) => found.help(help),
            None => found,
        },
        TableErrorKind::Malformed(_) if text.starts_with('{') => {
            found.help("JSON Lines has an object a line: `{\"low\": true, \"action\": \"charge\"}`")
        }
        TableErrorKind::Foreign { help: Some(help), .. } => found.help(*help),
        TableErrorKind::Numerous { .. } => {
            found.help("numbers that are rounded to fewer values need fewer comparisons")
        }
        TableErrorKind::SharedInput(_) => {
            found.help("the language has one name for one thing: rename the column, or the behaviour")
        }
        TableErrorKind::SharedName(_) => {
            found.help("the language has one name for one thing: rename the column, or the behaviour")
        }
        _ => found,
    }
}

/// What to do about a cell that is to be a number and has more in it.
fn number_help(cell: &str) -> Option<&'static str> {
    let digits = |text: &str| text.trim().parse::<f64>().is_ok();
    let out_of_range = |value: f64| value.is_infinite() || value == 0.0;
    if cell.ends_with(|c: char| c.is_ascii_digit()) && cell.parse().is_ok_and(out_of_range) {
        return Some("the largest is about 1.8e308, the smallest above 0 about 4.9e-324");
    }
    let unit = cell.trim_end_matches(|c: char| c.is_ascii_alphabetic() || matches!(c, '%' | '/'));
    if unit.len() < cell.len() && digits(unit) {
        return Some(
            "the unit stands in the header, `x:number m`, and the cells are plain numbers",
        );
    }
    let minus = ['\u{2212}', '\u{2013}', '\u{2014}'];
    if let Some(rest) = cell.strip_prefix(minus)
        && (rest.is_empty() || digits(rest))
    {
        return Some("this is a dash of printed text: a minus is the `-` of the keyboard");
    }
    let groups: Vec<&str> = cell
        .split([',', ' ', '_', '\'', '\u{a0}', '\u{202f}'])
        .collect();
    let whole = |group: &str| group.bytes().all(|byte| byte.is_ascii_digit());
    let is_group = |group: &&str| group.len() == 3 && whole(group);
    if let [first, rest @ ..] = groups.as_slice()
        && !rest.is_empty()
        && (1..=3).contains(&first.trim_start_matches('-').len())
        && whole(first.trim_start_matches('-'))
        && rest.iter().all(is_group)
    {
        return Some(
            "the digits of a number are not grouped: `1200`; before decimals stands a point: `1.2`",
        );
    }
    let decimal = cell.replace(',', ".");
    if cell.contains(',') && digits(&decimal) {
        return Some("a decimal number has a point: `0.5`");
    }
    (cell.contains('_') && digits(&cell.replace('_', ""))).then_some("digits are not grouped here")
}

/// What to do about a cell that is to be a truth value and is one in other words.
fn truth_help(cell: &str) -> Option<&'static str> {
    let word = cell.to_ascii_lowercase();
    let is = |words: &[&str]| words.contains(&word.as_str());
    match () {
        () if is(&["yes", "y", "t", "on", "1.0"]) => Some("write `1`, or `true`"),
        () if is(&["no", "n", "f", "off", "0.0"]) => Some("write `0`, or `false`"),
        () if is(&["*", "?", "x", "any", "\u{2013}", "\u{2212}", "\u{2014}"]) => {
            Some("`-` stands for either")
        }
        () => None,
    }
}

fn code(kind: &TableErrorKind) -> Code {
    match kind {
        TableErrorKind::NoText => Code::E0130,
        TableErrorKind::Malformed(_) | TableErrorKind::Empty => Code::E0811,
        TableErrorKind::Ragged { .. }
        | TableErrorKind::MissingKey(_)
        | TableErrorKind::UnknownKey(_) => Code::E0812,
        TableErrorKind::RepeatedColumn(_)
        | TableErrorKind::SecondBehavior(_)
        | TableErrorKind::MissingColumn { .. }
        | TableErrorKind::Separator(_)
        | TableErrorKind::Nameless => Code::E0813,
        TableErrorKind::UnknownValue { .. } | TableErrorKind::NoValue { .. } => Code::E0814,
        TableErrorKind::Contradiction { .. }
        | TableErrorKind::Disagreement { .. }
        | TableErrorKind::Wide
        | TableErrorKind::Open(_) => Code::E0815,
        TableErrorKind::UnusableName { .. }
        | TableErrorKind::SharedName(_)
        | TableErrorKind::SharedInput(_) => Code::E0816,
        TableErrorKind::Undeclared { .. }
        | TableErrorKind::UnknownKind { .. }
        | TableErrorKind::UnknownUnit(_)
        | TableErrorKind::OpenValues(_)
        | TableErrorKind::NoValues(_)
        | TableErrorKind::RepeatedValue(_) => Code::E0824,
        TableErrorKind::Foreign { .. } => Code::E0825,
        TableErrorKind::Several => Code::E0823,
        TableErrorKind::Numerous { .. } => Code::E0826,
        TableErrorKind::UnknownColumn(_)
        | TableErrorKind::UnknownBehavior(_)
        | TableErrorKind::Unseen => Code::E0610,
    }
}
