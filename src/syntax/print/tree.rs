//! Trees.

use super::columns::Group;
use super::{Printer, flat};
use crate::source::Span;
use crate::syntax::ast::{Node, NodeKind, Tree};

impl Printer<'_> {
    pub(super) fn tree(&mut self, tree: &Tree) {
        self.write(&format!("tree {}", flat::ident(&tree.name)));
        self.params(tree.params.as_ref(), 2);
        if let Some(task) = &tree.task {
            self.write(&format!(" for {}", flat::ident(task)));
        }
        self.write(" = ");
        self.hoist(tree.root.span.range().start);
        self.node(&tree.root, 0);
        self.end_line(Group::None);
    }

    /// A node that `after` more characters follow on its last line.
    pub(super) fn node(&mut self, node: &Node, after: usize) {
        match &node.kind {
            NodeKind::Composite { word, args, .. } => {
                let head = args
                    .as_ref()
                    .and_then(|args| args.last())
                    .map_or(word.span, |arg| arg.span);
                let open = self.mark_after("{", head.range().end);
                self.hoist(open.saturating_sub(1));
            }
            NodeKind::Guarded { guard, node } => {
                self.settle(guard);
                self.hoist_unless(node.span.range().start, |at| {
                    guard.span.range().contains(&at)
                });
            }
            NodeKind::Leaf(_) | NodeKind::Error => {}
        }
        let text = flat::node(node);
        if !is_several(node) && self.fits(&text, node.span, after) {
            self.write(&text);
            return;
        }
        match &node.kind {
            NodeKind::Composite {
                memory,
                word,
                args,
                children,
            } => {
                self.write(&flat::composite_head(
                    memory.is_some(),
                    word.node,
                    args.as_deref(),
                ));
                self.write(" ");
                let head = args
                    .as_ref()
                    .and_then(|args| args.last())
                    .map_or(word.span, |arg| arg.span);
                self.children(children, head, node.span);
            }
            NodeKind::Guarded { guard, node } => {
                self.expr(guard, 4);
                self.write(" => ");
                self.node(node, after);
            }
            NodeKind::Leaf(leaf) => self.expr(leaf, after),
            NodeKind::Error => self.write(&text),
        }
    }

    fn children(&mut self, children: &[Node], head: Span, span: Span) {
        let open = self.mark_after("{", head.range().end);
        self.hoist(open.saturating_sub(1));
        self.open_block(Group::None);
        self.trailing(open);
        for child in children {
            self.entry(child.span, |printer| {
                printer.node(child, 1);
                printer.write(",");
                printer.end_line(Group::None);
            });
        }
        self.rest_of_block(span.range().end.saturating_sub(1));
        self.close_block();
    }
}

/// Whether a node is printed one child a line however short it is: it has several units, or composites within it.
fn is_several(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Composite { children, .. } => {
            let units = children
                .iter()
                .filter(|child| matches!(child.kind, NodeKind::Guarded { .. }))
                .count();
            units > 1 || children.iter().any(holds_composite)
        }
        NodeKind::Guarded { node, .. } => is_several(node),
        _ => false,
    }
}

fn holds_composite(node: &Node) -> bool {
    match &node.kind {
        NodeKind::Composite { .. } => true,
        NodeKind::Guarded { node, .. } => holds_composite(node),
        _ => false,
    }
}
