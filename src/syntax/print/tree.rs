//! Trees.

use super::Printer;
use super::doc::{Brackets, Break, Doc, Entry, row};
use super::names::ident;
use crate::syntax::ast::{Node, NodeKind, Tree};

impl Printer<'_> {
    pub(super) fn tree<'a>(&self, tree: &'a Tree) -> Doc<'a> {
        let params = self.params(tree.params.as_ref()).room(" =".len());
        let task = match &tree.task {
            Some(task) => row![" for ", ident(task)],
            None => Doc::nothing(),
        };
        let comments = Doc::hoist(tree.root.span.range().start);
        row![
            "tree ",
            ident(&tree.name),
            params,
            task,
            " = ",
            comments,
            self.node(&tree.root)
        ]
    }

    pub(super) fn node<'a>(&self, node: &'a Node) -> Doc<'a> {
        match &node.kind {
            NodeKind::Composite {
                memory,
                word,
                args,
                children,
            } => {
                let memory = if memory.is_some() { "memory " } else { "" };
                let last = args.as_ref().and_then(|args| args.last());
                let head = last.map_or(word.span, |arg| arg.span).range().end;
                let args = match args {
                    Some(args) => self.args(args, node.span).flat(),
                    None => Doc::nothing(),
                };
                let children = children
                    .iter()
                    .map(|child| Entry::new(child.span, self.node(child)))
                    .collect();
                let inside = self.braces_after(head, node.span);
                let list = Doc::list(Brackets::BRACES, inside, children);
                let doc = row![memory, word.node.spelling(), args, " ", list];
                row![
                    Doc::hoist(inside.range().start),
                    doc.grouped(node.span, Break::always_if(is_several(node)))
                ]
            }
            NodeKind::Guarded { guard, node: inner } => {
                // A guard is broken before the arguments of what it guards.
                let (guard, guarded) = (self.expr(guard), self.node(inner));
                let leaf = matches!(inner.kind, NodeKind::Leaf(_));
                let behind = if leaf { guarded.width + 1 } else { 0 };
                row![guard.room(" => ".len() + behind), " => ", guarded]
                    .grouped(node.span, Break::always_if(is_several(inner)))
                    .settled(inner.span.range().start)
            }
            NodeKind::Leaf(leaf) => self.expr(leaf).grouped(node.span, Break::TooLong),
            NodeKind::Error => Doc::from("`?`"),
        }
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
