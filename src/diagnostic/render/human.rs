//! Diagnostics for a person at a terminal.

use super::excerpt::Excerpt;
use super::visible::{in_place, on_one_line, visible};
use crate::diagnostic::{Diagnostic, Fix, Severity};
use crate::source::Sources;
use codespan_reporting::diagnostic as report;
use codespan_reporting::files::{Error, Files, column_index};
use codespan_reporting::term::{self, Config, termcolor};
use std::borrow::Cow;
use std::collections::BTreeMap;
use std::ops::Range;

/// The text that shows `diagnostics`, one after another, each with the lines that it is about; with colours as ANSI
/// escapes if `color`.
pub fn human(sources: &Sources, diagnostics: &[Diagnostic], color: bool) -> String {
    let mut buffer = if color {
        termcolor::Buffer::ansi()
    } else {
        termcolor::Buffer::no_color()
    };
    let config = Config {
        tab_width: 4,
        ..Config::default()
    };
    let files = SourceFiles::of(sources);
    for diagnostic in diagnostics.iter().take(SHOWN) {
        // Writing into memory does not fail, and a place outside its file shows no line.
        let _ = match Excerpt::of(sources, diagnostic) {
            None => {
                let report = reported(sources, diagnostic);
                term::emit_to_write_style(&mut buffer, &config, &files, &report)
            }
            Some(excerpt) => {
                let mut files = SourceFiles::of(&excerpt.sources);
                files.cut = Some((&excerpt, sources));
                let report = reported(&excerpt.sources, &excerpt.diagnostic);
                term::emit_to_write_style(&mut buffer, &config, &files, &report)
            }
        };
    }
    let mut text = String::from_utf8_lossy(buffer.as_slice()).into_owned();
    if let more @ 1.. = diagnostics.len().saturating_sub(SHOWN) {
        text.push_str(&format!("… and {more} more, which are not shown\n\n"));
    }
    text
}

/// The most diagnostics that are shown.
const SHOWN: usize = 100;

/// The most characters of a message.
const MESSAGE: usize = 600;

/// A message that can be read, however long the names in it are.
fn told(message: &str) -> String {
    let message = visible(message);
    match message.char_indices().nth(MESSAGE) {
        None => message.into_owned(),
        Some((end, _)) => format!("{}…", message.get(..end).unwrap_or_default()),
    }
}

fn reported(sources: &Sources, diagnostic: &Diagnostic) -> report::Diagnostic<usize> {
    let severity = match diagnostic.severity {
        Severity::Error => report::Severity::Error,
        Severity::Warning => report::Severity::Warning,
    };
    let labels = diagnostic
        .labels
        .iter()
        .enumerate()
        .filter(|(_, label)| sources.get(label.span.file).is_some())
        .map(|(index, label)| {
            let style = if index == 0 {
                report::LabelStyle::Primary
            } else {
                report::LabelStyle::Secondary
            };
            report::Label::new(style, label.span.file.0 as usize, label.span.range())
                .with_message(told(&label.message))
        })
        .collect();
    let notes = diagnostic.notes.iter().map(|note| format!("note: {note}"));
    let help = diagnostic.help.iter().map(|help| format!("help: {help}"));
    let said = diagnostic
        .labels
        .first()
        .map_or("", |label| label.message.as_str());
    let fixes = diagnostic
        .fixes
        .iter()
        .filter_map(|fix| offered(sources, fix, said));
    report::Diagnostic::new(severity)
        .with_code(diagnostic.code)
        .with_message(told(&on_one_line(&diagnostic.message)))
        .with_labels(labels)
        .with_notes(
            notes
                .chain(help)
                .chain(fixes)
                .map(|note| told(&note))
                .collect(),
        )
}

/// How many changes of one fix are told.
const MOST: usize = 6;

/// A fix in words, such as "help: compare twice: insert `and e ` before `< 3`"; without its title if it is `said`
/// already, or says no more than the edit.
fn offered(sources: &Sources, fix: &Fix, said: &str) -> Option<String> {
    // A question that has been asked is not asked again.
    if said.ends_with('?') && fix.edits.iter().all(|(_, new)| said.contains(new.trim())) {
        return None;
    }
    let edits = fix.edits.iter();
    let edits = edits.map(|(span, new)| {
        let old = sources.text(*span);
        let next = sources
            .get(span.file)
            .and_then(|source| source.text.get(span.range().end..))
            .and_then(|rest| rest.lines().next())
            .unwrap_or_default()
            .trim();
        let edit = match (old, new.as_str()) {
            ("", new) if new.contains('\n') => format!("insert `{}`", new.trim()),
            ("", new) if next.is_empty() => format!("insert `{new}` at the end of the line"),
            ("", new) => format!("insert `{new}` before `{}`", shortened(next)),
            (old, "") if old.trim().is_empty() => "delete the blank".to_owned(),
            (old, "") => format!("delete `{old}`"),
            (old, new) => format!("replace `{old}` with `{new}`"),
        };
        (edit, !old.is_empty() && !new.is_empty())
    });
    let mut edits = counted(edits);
    let more = edits.len().saturating_sub(MOST);
    if more > 0 {
        edits.truncate(MOST);
        edits.push(format!("and {more} more like these"));
    }
    let edits = edits.join(", ");
    if fix.title.ends_with('?') {
        return Some(format!("help: {}", fix.title));
    }
    Some(
        if fix.title == said || fix.title.starts_with("write `") || fix.title.starts_with("drop ") {
            format!("help: {edits}")
        } else {
            format!("help: {}: {edits}", fix.title)
        },
    )
}

/// These edits, each with whether it replaces something. What is to be replaced in several places is said once, with their number.
fn counted(edits: impl Iterator<Item = (String, bool)>) -> Vec<String> {
    let mut said: Vec<(String, usize)> = Vec::new();
    let mut known: BTreeMap<String, usize> = BTreeMap::new();
    for (edit, replaces) in edits {
        let at = match replaces {
            true => *known.entry(edit.clone()).or_insert(said.len()),
            false => said.len(),
        };
        match said.get_mut(at) {
            Some((_, places)) => *places += 1,
            None => said.push((edit, 1)),
        }
    }
    let said = said.into_iter();
    said.map(|(edit, places)| match places {
        1 => edit,
        _ => format!("{edit} in {places} places"),
    })
    .collect()
}

/// The beginning of a line, for a hint.
fn shortened(line: &str) -> String {
    const SHOWN: usize = 24;
    if line.chars().count() <= SHOWN {
        return line.to_owned();
    }
    let start: String = line.chars().take(SHOWN).collect();
    format!("{start}…")
}

/// The sources as codespan reads them.
struct SourceFiles<'a> {
    sources: &'a Sources,
    /// What is shown of each.
    texts: Vec<Cow<'a, str>>,
    /// What each is called.
    names: Vec<Cow<'a, str>>,
    /// What was cut from them, with the sources as they were.
    cut: Option<(&'a Excerpt, &'a Sources)>,
}

impl<'a> SourceFiles<'a> {
    fn of(sources: &'a Sources) -> Self {
        let all = || sources.iter().map(|(_, source)| source);
        Self {
            sources,
            texts: all().map(|source| in_place(&source.text)).collect(),
            names: all().map(|source| on_one_line(&source.name)).collect(),
            cut: None,
        }
    }
}

impl SourceFiles<'_> {
    fn source(&self, id: usize) -> Result<&crate::source::Source, Error> {
        let mut files = self.sources.iter();
        files
            .nth(id)
            .map(|(_, source)| source)
            .ok_or(Error::FileMissing)
    }
}

impl<'a> Files<'a> for SourceFiles<'a> {
    type FileId = usize;
    type Name = &'a str;
    type Source = &'a str;

    fn name(&'a self, id: usize) -> Result<&'a str, Error> {
        self.names
            .get(id)
            .map(|name| &**name)
            .ok_or(Error::FileMissing)
    }

    fn source(&'a self, id: usize) -> Result<&'a str, Error> {
        self.texts
            .get(id)
            .map(|text| &**text)
            .ok_or(Error::FileMissing)
    }

    fn line_index(&'a self, id: usize, offset: usize) -> Result<usize, Error> {
        let offset = u32::try_from(offset).unwrap_or(u32::MAX);
        Ok(SourceFiles::source(self, id)?.line(offset).0)
    }

    fn column_number(&'a self, id: usize, line: usize, offset: usize) -> Result<usize, Error> {
        let source = Files::source(self, id)?;
        let range = self.line_range(id, line)?;
        let missing = self.cut.map_or(0, |(cut, all)| cut.missing(all, id, line));
        Ok(column_index(source, range, offset) + 1 + missing)
    }

    fn line_range(&'a self, id: usize, line: usize) -> Result<Range<usize>, Error> {
        let source = SourceFiles::source(self, id)?;
        let start = source.line_start(line).ok_or(Error::LineTooLarge {
            given: line,
            max: source.line_count().saturating_sub(1),
        })?;
        let end = source
            .line_start(line + 1)
            .map_or(source.text.len(), |end| end as usize);
        Ok(start as usize..end)
    }
}
