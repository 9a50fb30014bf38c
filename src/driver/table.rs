//! Tables of the user's, read with located mistakes.

use super::load::Loaded;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Id;
use crate::ir::task::Task;
use crate::policy::sheet::{TableError, TableErrorKind};
use crate::policy::{Policy, decisions, transitions};
use crate::source::{FileId, Span};

/// The policy in a file of decisions.
///
/// # Errors
/// What is wrong with the table, with its place.
pub fn policy(loaded: &Loaded, file: FileId, task: Id<Task>) -> Result<Policy, Vec<Diagnostic>> {
    let text = loaded.sources.get(file).map_or("", |source| &source.text);
    decisions::read(text, &loaded.program, Some(task)).map_err(|error| vec![located(file, &error)])
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
        Err(error) => Err(vec![located(file, &error)]),
    }
}

fn located(file: FileId, error: &TableError) -> Diagnostic {
    let span = |range: &std::ops::Range<usize>| Span::new(file, range.start, range.end);
    let diagnostic = Diagnostic::new(Code::E0610, span(&error.span), error.to_string());
    match &error.kind {
        TableErrorKind::Contradiction { earlier } => {
            diagnostic.also(span(earlier), "this row says otherwise")
        }
        _ => diagnostic,
    }
}
