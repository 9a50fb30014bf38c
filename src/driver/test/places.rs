//! Where the nodes of a tested tree are written.

use crate::driver::load::Loaded;
use crate::ir::tree::Node;
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind, ItemKind, NodeKind};

/// The places of the nodes of a tree, in pre-order; those of a subtree stand in its own text.
pub(super) fn of(loaded: &Loaded, test: &ast::Test, root: &Node) -> Vec<Span> {
    let mut places = Places {
        loaded,
        found: Vec::new(),
    };
    match places.tree(&test.tree.name.name) {
        Some(tree) => places.node(&tree.root, root),
        None => places.all(root, test.tree.span),
    }
    places.found
}

struct Places<'l> {
    loaded: &'l Loaded,
    found: Vec<Span>,
}

impl<'l> Places<'l> {
    /// The tree of that name; one of a file goes before one of the files that it uses.
    fn tree(&self, name: &str) -> Option<&'l ast::Tree> {
        let named = |ast: &'l ast::File| {
            ast.items.iter().find_map(|item| match &item.kind {
                ItemKind::Tree(tree) if tree.name.name == name => Some(tree),
                _ => None,
            })
        };
        let used: Vec<&ast::File> = self.loaded.asts().skip(1).collect();
        let own = named(&self.loaded.ast);
        own.or_else(|| used.into_iter().rev().find_map(named))
    }

    fn node(&mut self, written: &'l ast::Node, node: &Node) {
        match (&written.kind, node.children()) {
            (NodeKind::Guarded { guard, node: inner }, [asked, rest]) => {
                self.found.push(written.span);
                self.all(asked, guard.span);
                self.node(inner, rest);
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
            (NodeKind::Leaf(leaf), _) => match called(leaf).and_then(|name| self.tree(name)) {
                Some(tree) => self.node(&tree.root, node),
                None => self.all(node, written.span),
            },
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
