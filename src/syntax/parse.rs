//! The way from a text to its tree.

use super::ast::{File, Item, ItemKind, Lost};
use super::build::Builder;
use super::comments::comments;
use super::follow_ups;
use super::grammar::{self, Rule};
use super::nesting;
use super::tokens::tokens;
use crate::diagnostic::{self, Code, Diagnostic};
use crate::source::{FileId, Span};

/// The syntax tree of `text`, and all that is wrong with it.
///
/// There is always a tree: what could not be understood stands in it as an `Error` node, each of them with at least
/// one diagnostic. Time is linear in the length of the text; the depth of the tree is bounded, so that nothing that
/// recurses over it runs out of stack.
pub fn parse(file: FileId, text: &str) -> (File, Vec<Diagnostic>) {
    let tokens = tokens(text);
    let comments = comments(file, text, &tokens);
    let deep =
        nesting::too_deep(text, &tokens).map(|token| Span::new(file, token.start, token.end));
    let parsed = match deep {
        Some(place) => Err(place),
        None => grammar::parse(Rule::file, text).map_err(|stop| Span::new(file, stop.at, stop.at)),
    };
    let (mut tree, mut diagnostics) = match parsed.map(|mut pairs| pairs.next()) {
        Ok(Some(node)) => Builder::new(file, text, &tokens, &comments).file(node),
        Ok(None) => (File::default(), Vec::new()),
        Err(place) => {
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
        }
    };
    diagnostic::sort(&mut diagnostics);
    let diagnostics = follow_ups::left_out(text, &mut tree, diagnostics);
    (tree, diagnostics)
}

fn too_deep(place: Span) -> Diagnostic {
    Diagnostic::new(Code::E0104, place, "the nesting is too deep")
        .label("the file is read up to here only")
        .help("give the inner parts names of their own, with `let`, `predicate` or `tree`")
}
