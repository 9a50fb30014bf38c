//! The way from a text to its tree.

use super::ast::{File, Item, ItemKind, Lost};
use super::comments::comments;
use super::conflicts::{Conflict, conflicts};
use super::diagnose::{dashed, other_comment};
use super::follow_ups;
use super::nesting;
use super::parens::{Body, bodies};
use super::reparse::{Read, Unread};
use super::tokens::tokens;
use crate::diagnostic::{self, Code, Diagnostic};
use crate::source::{FileId, Span};
use std::collections::BTreeMap;
use std::ops::Range;

/// The syntax tree of `text`, and all that is wrong with it.
///
/// There is always a tree: what could not be understood stands in it as an `Error` node, each of them with at least
/// one diagnostic. Time is linear in the length of the text; the depth of the tree is bounded, so that nothing that
/// recurses over it runs out of stack.
pub fn parse(file: FileId, text: &str) -> (File, Vec<Diagnostic>) {
    parse_after(None, file, text).0
}

/// The texts that were parsed before, by name: of one that has changed, only what has changed is parsed again.
#[derive(Default)]
pub struct Memory {
    read: BTreeMap<String, Read>,
}

impl Memory {
    /// What [`parse`] gives, in less time if much of the text of this name is as it was.
    pub fn parse(&mut self, name: &str, file: FileId, text: &str) -> (File, Vec<Diagnostic>) {
        let (parsed, read) = parse_after(self.read.remove(name).as_ref(), file, text);
        self.read.extend(read.map(|read| (name.to_owned(), read)));
        parsed
    }
}

/// The tree of a text with what is wrong with it, and what to keep of it for the next time.
fn parse_after(
    before: Option<&Read>,
    file: FileId,
    text: &str,
) -> ((File, Vec<Diagnostic>), Option<Read>) {
    let conflicts = conflicts(text);
    if !conflicts.is_empty() {
        // Of a conflict the first side is read.
        let left_out = conflicts.iter().flat_map(Conflict::left_out);
        let edits = left_out.map(|place| {
            let written = blanked(text.get(place.clone()).unwrap_or_default());
            (place, written)
        });
        let told = conflicts.iter().map(|conflict| conflict.told(file));
        return read_as(before, (file, text), edits.collect(), told);
    }
    let dashed = dashed(text);
    if !dashed.is_empty() {
        let edits = dashed.iter().map(|at| (*at..at + 2, "//".to_owned()));
        let marks = dashed.iter().map(|at| Span::new(file, *at, at + 2));
        let told = marks.map(|mark| other_comment(mark, "--"));
        return read_as(before, (file, text), edits.collect(), told);
    }
    let tokens = tokens(text);
    let bodies = bodies(text, &tokens);
    if !bodies.is_empty() {
        let braces = bodies.iter().flat_map(Body::braces);
        let edits = braces.map(|(at, brace)| (at..at + 1, brace.to_owned()));
        let told = bodies.iter().map(|body| body.told(file));
        return read_as(before, (file, text), edits.collect(), told);
    }
    let comments = comments(file, text, &tokens);
    let unread = Unread {
        file,
        text,
        tokens: &tokens,
        comments: &comments,
    };
    let deep =
        nesting::too_deep(text, &tokens).map(|token| Span::new(file, token.start, token.end));
    let again = before.filter(|_| deep.is_none());
    let again = again.and_then(|before| unread.read_again(before));
    let parsed = match (again, deep) {
        (Some(parsed), _) => Ok(parsed),
        (None, Some(place)) => Err(place),
        (None, None) => unread.read().map_err(|at| Span::new(file, at, at)),
    };
    let read = parsed.as_ref().ok();
    let read = read.map(|(tree, found)| Read::new(text.to_owned(), tree, found));
    let (mut tree, mut diagnostics) = parsed.unwrap_or_else(|place| {
        let span = Span::new(file, 0, text.len());
        let item = Item {
            docs: Vec::new(),
            kind: ItemKind::Error,
            span,
        };
        let tree = File {
            items: vec![item],
            comments: comments.clone(),
            span,
            lost: Lost {
                unnamed: true,
                ..Lost::default()
            },
        };
        (tree, vec![too_deep(place)])
    });
    diagnostic::sort(&mut diagnostics);
    let diagnostics = follow_ups::left_out(text, &mut tree, diagnostics);
    ((tree, diagnostics), read)
}

/// The tree of a text as it is meant, and what is told of its writing. Each edit is as long as what it replaces, so places stay.
fn read_as(
    before: Option<&Read>,
    (file, text): (FileId, &str),
    mut edits: Vec<(Range<usize>, String)>,
    told: impl Iterator<Item = Diagnostic>,
) -> ((File, Vec<Diagnostic>), Option<Read>) {
    edits.sort_by_key(|(place, _)| place.start);
    let mut meant = String::with_capacity(text.len());
    let mut end = 0;
    for (place, written) in edits {
        meant += text.get(end..place.start).unwrap_or_default();
        meant += &written;
        end = place.end;
    }
    meant += text.get(end..).unwrap_or_default();
    let ((tree, mut found), read) = parse_after(before, file, &meant);
    found.extend(told);
    diagnostic::sort(&mut found);
    ((tree, found), read)
}

/// Blanks of the length of a text, on as many lines.
fn blanked(text: &str) -> String {
    let blanked = text.bytes().map(|byte| match byte {
        b'\n' => '\n',
        _ => ' ',
    });
    blanked.collect()
}

fn too_deep(place: Span) -> Diagnostic {
    Diagnostic::new(Code::E0104, place, "the nesting is too deep")
        .label("the file is read up to here only")
        .help("give the inner parts names of their own, with `let`, `predicate` or `tree`")
}
