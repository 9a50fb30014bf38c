//! Tables of the user's, read with located mistakes.

use super::load::{self, Loaded};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::task::Task;
use crate::ir::{Id, Program};
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::table::{self, Format, Table};
use crate::policy::{Policy, decisions, transitions};
use crate::source::{FileId, Sources, Span};

/// A text with a name, as a command is given it.
#[derive(Clone, Copy, Debug)]
pub struct Text<'t> {
    /// As diagnostics call it.
    pub name: &'t str,
    /// What it holds.
    pub bytes: &'t [u8],
}

/// Why a text is refused, with the text.
#[derive(Clone, Debug)]
pub struct Refused {
    /// The texts that it is about.
    pub sources: Sources,
    /// The mistakes, sorted.
    pub diagnostics: Vec<Diagnostic>,
}

impl Refused {
    /// Mistakes of one text, as `located` places them in it.
    pub(super) fn new(text: Text, located: impl FnOnce(FileId) -> Vec<Diagnostic>) -> Self {
        let mut sources = Sources::default();
        let (file, broken) = load::decode(&mut sources, text.name, text.bytes.to_vec());
        // The places are those of the bytes: where these are no text, that alone is told.
        let diagnostics = broken.map_or_else(|| located(file), |broken| vec![broken]);
        Self {
            sources,
            diagnostics,
        }
    }

    /// Mistakes of one table.
    pub(super) fn table(text: Text, errors: &[TableError]) -> Self {
        Self::new(text, |file| all_located(file, errors))
    }
}

/// The policy table in a text, whatever its origin.
///
/// # Errors
/// What is wrong with it, with the places.
pub fn read(text: Text) -> Result<Table, Refused> {
    let format = Format::of(text.name, text.bytes);
    Table::read(text.bytes, format).map_err(|errors| Refused::table(text, &errors))
}

/// Adds start minterms and greedy transitions to a policy. Those of `starts` come to the ones that `recorded` has.
///
/// # Errors
/// What is wrong with them, with the places.
pub fn record(
    policy: &mut Policy,
    program: &Program,
    recorded: Text,
    starts: Option<Text>,
) -> Result<(), Refused> {
    let one = |text: Text, read: &mut dyn FnMut(&str) -> Result<(), TableError>| {
        let refused = |errors: &[TableError]| Refused::table(text, errors);
        let decoded = std::str::from_utf8(text.bytes).map_err(|_| refused(&[]))?;
        read(decoded).map_err(|error| refused(&[error]))
    };
    one(recorded, &mut |text| {
        transitions::read(text, program, policy)
    })?;
    if let Some(starts) = starts {
        one(starts, &mut |text| {
            transitions::read_starts(text, program, policy)
        })?;
    }
    if policy.starts.is_empty() {
        return Err(Refused::new(recorded, |file| {
            let start = Span::new(file, 0, 0);
            let message = "no minterm is said to be one in which an episode starts";
            vec![
                Diagnostic::new(Code::E0818, start, message)
                    .label("no row here has the status `start`")
                    .help("give the start minterms in a table of their own, with `--start FILE`"),
            ]
        }));
    }
    Ok(())
}

/// The policy in a file of decisions.
///
/// # Errors
/// What is wrong with the table, with its places.
pub fn policy(loaded: &Loaded, file: FileId, task: Id<Task>) -> Result<Policy, Vec<Diagnostic>> {
    let text = loaded.sources.get(file).map_or("", |source| &source.text);
    decisions::read(text, &loaded.program, Some(task)).map_err(|errors| all_located(file, &errors))
}

/// The environment in a file of transitions.
///
/// # Errors
/// What is wrong with the table, with its place.
pub fn environment(
    loaded: &Loaded,
    file: FileId,
    task: Id<Task>,
) -> Result<Policy, Vec<Diagnostic>> {
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
        Err(error) => Err(all_located(file, &[error])),
    }
}

/// Mistakes at their places in a file; the last says so if the rest was not looked at.
fn all_located(file: FileId, errors: &[TableError]) -> Vec<Diagnostic> {
    let mut found: Vec<Diagnostic> = errors.iter().map(|error| located(file, error)).collect();
    if found.len() >= table::MISTAKES
        && let Some(last) = found.pop()
    {
        found.push(last.note("the table may have more mistakes, which are not told"));
    }
    found
}

fn located(file: FileId, error: &TableError) -> Diagnostic {
    let span = |range: &std::ops::Range<usize>| Span::new(file, range.start, range.end);
    let told = Diagnostic::new(code(&error.kind), span(&error.span), error.to_string());
    match &error.kind {
        TableErrorKind::Contradiction { earlier, overlap } => {
            let told = told.also(span(earlier), "this row says otherwise");
            match overlap {
                Some(common) => told.note(format!("both rows speak of minterms with {common}")),
                None => told,
            }
        }
        TableErrorKind::Empty => told.label("a table has a header and a row for each minterm"),
        TableErrorKind::MissingColumn {
            likely: Some(likely),
            ..
        } => told.help(format!("is it `{likely}`?")),
        TableErrorKind::MissingColumn { name, .. } if name == "behavior" => {
            told.help("what is done stands under `behavior`, `behaviour` or `action`")
        }
        TableErrorKind::Nameless => {
            told.help("a table that pandas has written has a column of row numbers: write it with `index=False`")
        }
        TableErrorKind::SharedName(_) => {
            told.help("the language has one name for one thing: rename the column, or the behaviour")
        }
        _ => told,
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
        | TableErrorKind::Nameless => Code::E0813,
        TableErrorKind::UnknownValue { .. } => Code::E0814,
        TableErrorKind::Contradiction { .. } | TableErrorKind::Wide => Code::E0815,
        TableErrorKind::UnusableName { .. } | TableErrorKind::SharedName(_) => Code::E0816,
        TableErrorKind::UnknownColumn(_)
        | TableErrorKind::UnknownBehavior(_)
        | TableErrorKind::Unseen => Code::E0610,
    }
}
