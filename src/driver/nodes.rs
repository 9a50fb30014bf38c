//! Where the nodes of a tree are written.

use super::load::Loaded;
use super::target;
use crate::ir::tree::Node;
use crate::report::coverage::{Coverage, Place};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind, NodeKind};
use crate::syntax::print;
use crate::trial::test::Answers;
use std::collections::BTreeMap;

/// Where the nodes of a tree are written, by their places in pre-order.
#[derive(Default)]
pub(super) struct Found {
    /// Of each node; those of a subtree stand in its own text.
    pub(super) spans: Vec<Span>,
    /// Where subtrees are called, and how: of the nodes that they begin with.
    pub(super) calls: BTreeMap<usize, (Span, String)>,
}

/// The places of the nodes of a tree of this name; `named` is the place of those of a tree that no file has.
pub(super) fn of(loaded: &Loaded, name: &str, named: Span, root: &Node) -> Found {
    let mut places = Places {
        loaded,
        found: Vec::new(),
        calls: BTreeMap::new(),
    };
    match target::written(loaded, name) {
        Some(tree) => places.node(&tree.root, root),
        None => places.all(root, named),
    }
    Found {
        spans: places.found,
        calls: places.calls,
    }
}

impl Found {
    /// What has been ticked of a tree, under the name that it has there.
    pub(super) fn covered(
        &self,
        loaded: &Loaded,
        (tree, root): (&str, &Node),
        answers: &[Answers],
    ) -> Coverage {
        let written = |at: usize| {
            let called = self.calls.get(&at);
            let span = called.map(|(span, _)| *span);
            let span = span.or_else(|| self.spans.get(at).copied());
            let place = span.and_then(|span| place(loaded, span));
            (place, called.map(|(_, text)| text.clone()))
        };
        Coverage::of(&loaded.program, tree, root, answers, written)
    }
}

/// The file, the line and the column, counted from one.
fn place(loaded: &Loaded, span: Span) -> Option<Place> {
    let source = loaded.sources.get(span.file)?;
    let (line, column) = source.position(span.start);
    Some(Place {
        file: source.name.clone(),
        line: line + 1,
        column: column + 1,
    })
}

struct Places<'l> {
    loaded: &'l Loaded,
    found: Vec<Span>,
    calls: BTreeMap<usize, (Span, String)>,
}

impl<'l> Places<'l> {
    fn node(&mut self, written: &'l ast::Node, node: &Node) {
        match (&written.kind, node.children()) {
            (NodeKind::Guarded { guard, node: inner }, [asked, rest]) => {
                let at = self.found.len();
                self.found.push(written.span);
                self.all(asked, guard.span);
                let below = self.found.len();
                self.node(inner, rest);
                if let Some((_, call)) = self.calls.get(&below) {
                    let text = format!("{} => {call}", print::expr(guard));
                    self.calls.insert(at, (written.span, text));
                }
            }
            (
                NodeKind::Composite {
                    memory,
                    word,
                    children,
                    ..
                },
                nodes,
            ) if children.len() == nodes.len() => {
                self.found
                    .push(memory.map_or(word.span, |memory| memory.to(word.span)));
                for (written, node) in children.iter().zip(nodes) {
                    self.node(written, node);
                }
            }
            (NodeKind::Leaf(leaf), _) => {
                match called(leaf).and_then(|name| target::written(self.loaded, name)) {
                    Some(tree) => {
                        // What one subtree calls at once is its own matter.
                        let at = self.found.len();
                        let call = (written.span, print::expr(leaf));
                        self.node(&tree.root, node);
                        self.calls.insert(at, call);
                    }
                    None => self.all(node, written.span),
                }
            }
            _ => self.all(node, written.span),
        }
    }

    /// Gives a node and all under it one place.
    fn all(&mut self, node: &Node, place: Span) {
        self.found.push(place);
        for child in node.children() {
            self.all(child, place);
        }
    }
}

/// The name that a leaf refers by.
fn called(leaf: &Expr) -> Option<&str> {
    match &leaf.kind {
        ExprKind::Ref(reference) => Some(&reference.name.name),
        ExprKind::Paren(inner) => called(inner),
        _ => None,
    }
}
