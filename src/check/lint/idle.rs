//! Nodes that change nothing: decorators around what they do not touch, children that are there already, guards that hold
//! where they are asked, trees that drive nothing.

use super::cases::{Cases, of_guard};
use super::mentions::Mentions;
use super::tree::when;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::tree::{Composite, Decorator, Guard, Node, Status};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind, NodeKind, Tree};
use crate::syntax::print;

impl<'a> Checker<'a> {
    /// Warns of a decorator that its child gives nothing to do.
    pub fn decorates_nothing(&mut self, at: Span, kind: Decorator, child: &Node) {
        if let (Decorator::Succeed | Decorator::Fail, Node::Condition(_)) = (kind, child) {
            let answer = match kind {
                Decorator::Succeed => "succeeds",
                _ => "fails",
            };
            let message = format!("`{}` asks for nothing here", kind.word());
            self.warning(Code::W0605, at, message)
                .label(format!("it {answer} whether this holds or not"));
            return;
        }
        let never = |status| when(&self.program, child, status).is_never();
        let (fails, succeeds) = (!never(Status::Failure), !never(Status::Success));
        let why = match kind {
            Decorator::Retry(1) | Decorator::Repeat(1) => "its child is ticked once anyway",
            Decorator::Invert if !fails && !succeeds => "its child never ends",
            Decorator::Invert if is_inverted(child) => {
                "its child is inverted already, and twice is not at all"
            }
            Decorator::Retry(_) | Decorator::Succeed if !fails => "its child never fails",
            Decorator::Repeat(_) | Decorator::Fail if !succeeds => "its child never succeeds",
            Decorator::Timeout(_) if is_instant(child) => "its child answers at once",
            Decorator::Timeout(ticks) if self.is_timed_out(at, ticks, child) => return,
            _ => return,
        };
        let message = format!("`{}` changes nothing here", kind.word());
        self.warning(Code::W0605, at, message).label(why);
    }

    /// Warns of a child of a node without memory that stands before it already: what has answered once in a tick answers
    /// the same again.
    pub fn stands_twice(&mut self, written: &'a [ast::Node], nodes: &[Node], at: usize) -> bool {
        let Some(node) = nodes.get(at).filter(|node| node.answers_again()) else {
            return false;
        };
        let first = nodes.iter().take(at).position(|other| other == node);
        let (Some(first), Some(here)) = (first.and_then(|at| written.get(at)), written.get(at))
        else {
            return false;
        };
        self.warning(Code::W0606, here.span, "this child is there already")
            .label("it answers as it did before in this tick")
            .also(first.span, "the same as this one");
        true
    }

    /// Warns of a guard, or of a part of one, that what stands around it has asked already.
    pub fn asked_already(&mut self, written: &'a Expr, guard: &Guard, held: &Cases) {
        // What holds always is told where it is said.
        let asked = |guard: &Guard| {
            let always = of_guard(&self.program, guard, false).is_never();
            !always && held.implies(&of_guard(&self.program, guard, true))
        };
        let mut places = Vec::new();
        if asked(guard) {
            places.push(written.span);
        } else if let Guard::And(parts) = guard {
            let conjuncts = written.conjuncts();
            if conjuncts.len() == parts.len() {
                let of = conjuncts.iter().zip(parts);
                places.extend(of.filter(|(_, part)| asked(part)).map(|(at, _)| at.span));
            }
        }
        for at in places {
            self.warning(Code::W0604, at, "this holds wherever it is asked")
                .label("what stands around it, or before it, has asked it already");
        }
    }

    /// Warns of a tree that is no part of another and runs no behaviour, or none where a condition holds.
    pub fn drives_nothing(&mut self, tree: &'a Tree, root: &Node, of_trees: &Mentions) {
        if of_trees.read.contains(tree.name.name.as_str()) {
            return;
        }
        if runs_something(root) && self.program.tasks.is_empty() {
            return;
        }
        if runs_something(root) {
            return self.stands_where_a_condition_holds(&tree.root, root);
        }
        let message = format!("the tree `{}` runs no behaviour", tree.name.name);
        self.warning(Code::W0607, tree.name.span, message)
            .label("it asks, and the robot stands")
            .help("say what is to be done: `GUARD => BEHAVIOR`");
    }
}

impl<'a> Checker<'a> {
    /// Warns of a condition that stands as a child of a selector with which the tick is over: where it holds, nothing
    /// runs.
    fn stands_where_a_condition_holds(&mut self, written: &'a ast::Node, node: &Node) {
        let (children, nodes, kind) = match (&written.kind, node) {
            (NodeKind::Guarded { node: inner, .. }, Node::Composite { children, .. }) => {
                if let [_, node] = children.as_slice() {
                    self.stands_where_a_condition_holds(inner, node);
                }
                return;
            }
            (
                NodeKind::Composite { children, .. },
                Node::Composite {
                    kind,
                    children: nodes,
                    ..
                },
            ) => (children, nodes, *kind),
            _ => return,
        };
        let mut children = children.iter().zip(nodes);
        if kind == Composite::Sequence {
            if let Some((written, node)) = children.next_back() {
                self.stands_where_a_condition_holds(written, node);
            }
            return;
        }
        for (written, node) in children {
            // What a guard lets answer answers for the selector as well.
            let (written, node, holds) = match (&written.kind, node) {
                (NodeKind::Guarded { node: inner, .. }, Node::Composite { children, .. })
                    if matches!(inner.kind, NodeKind::Leaf(_)) =>
                {
                    let last = children.last().unwrap_or(node);
                    (inner.as_ref(), last, "where this holds behind its guard")
                }
                _ => (written, node, "where this holds"),
            };
            if let (NodeKind::Leaf(asked), Node::Condition(_), false) =
                (&written.kind, node, is_switch(written))
            {
                let text = print::expr(asked);
                let message = format!("the tree runs nothing {holds}");
                self.warning(Code::W0607, asked.span, message)
                    .label("it answers for the selector, and no other child is ticked")
                    .help(format!("write what is to be done: `{text} => BEHAVIOR`"));
            } else {
                self.stands_where_a_condition_holds(written, node);
            }
        }
    }
}

fn runs_something(node: &Node) -> bool {
    let mut runs = false;
    node.visit_behaviors(&mut |_| runs = true);
    runs
}

/// Whether a node never runs.
fn is_instant(node: &Node) -> bool {
    let waits = matches!(
        node,
        Node::Decorator {
            kind: Decorator::Retry(_) | Decorator::Repeat(_),
            ..
        }
    );
    let runs = matches!(node, Node::Behavior(_));
    !waits && !runs && node.children().iter().all(is_instant)
}

/// Whether a node is written as a mere `true` or `false`: whoever writes that has switched something off on purpose.
pub fn is_switch(node: &ast::Node) -> bool {
    matches!(&node.kind, NodeKind::Leaf(leaf) if matches!(leaf.kind, ExprKind::Bool(_)))
}

fn is_inverted(node: &Node) -> bool {
    matches!(
        node,
        Node::Decorator {
            kind: Decorator::Invert,
            ..
        }
    )
}
