//! Events where something that lasts is meant: an event happens in one tick.

use crate::check::Checker;
use crate::check::names::Decl;
use crate::diagnostic::Code;
use crate::syntax::ast::{
    AspectKind, BinaryOp, Expr, ExprKind, Item, ItemKind, Paid, Trigger, UnaryOp,
};
use crate::syntax::print;
use std::collections::BTreeSet;

/// How deep conditions are looked into, and the events that they ask for.
const DEEP: usize = 16;

impl<'a> Checker<'a> {
    /// Warns of prices for the time of an event, and of what waits for an event that does not happen.
    pub fn moments_that_last(&mut self, items: impl Iterator<Item = &'a Item>) {
        for item in items {
            match &item.kind {
                ItemKind::On(on) => {
                    if let Trigger::Expr(condition) = &on.trigger {
                        self.waits_for_nothing(condition, "its effects happen", &BTreeSet::new());
                    }
                }
                ItemKind::Task(task) => {
                    let ends = task.aspects.iter().filter_map(|aspect| match &aspect.kind {
                        AspectKind::EndOn(event) => Some(print::expr(event)),
                        _ => None,
                    });
                    let ends: BTreeSet<String> = ends.collect();
                    for aspect in &task.aspects {
                        self.moments_of(&aspect.kind, &ends);
                    }
                }
                _ => {}
            }
        }
    }

    fn moments_of(&mut self, aspect: &AspectKind, ends: &BTreeSet<String>) {
        if let AspectKind::EndOn(condition) = aspect {
            self.waits_for_nothing(condition, "the episode ends", ends);
        }
        let AspectKind::Reward { lines, .. } = aspect else {
            return;
        };
        for line in lines {
            match &line.paid {
                Paid::On(condition) => self.waits_for_nothing(condition, "this is paid", ends),
                Paid::Per { during, .. } => during.iter().for_each(|during| self.priced(during)),
            }
        }
    }

    /// `while docked, per 1 s: -1`
    fn priced(&mut self, during: &Expr) {
        if !self.is_moment(during, DEEP) {
            return;
        }
        let name = print::expr(during);
        self.warning(Code::W0521, during.span, "an event lasts for one tick only")
            .label("so this is paid for one tick each time")
            .help(format!("what happens has a reward: `on {name}: …`"))
            .help(
                "a price is for something that lasts: a predicate, or a state that the event sets",
            );
    }

    /// `on not docked { … }`; what ends the episode, by `ends`, happens in one tick of it at most.
    fn waits_for_nothing(&mut self, condition: &Expr, then: &str, ends: &BTreeSet<String>) {
        if !self.is_absence(condition, ends) {
            return;
        }
        let message = "what does not happen is true of nearly every tick";
        self.warning(Code::W0521, condition.span, message)
            .label(format!("{then} in every tick without it"))
            .help("wait for something that happens, or ask a state that the event sets: `and not STATE`");
    }

    /// Whether a condition holds only in a tick in which something happens.
    fn is_moment(&self, condition: &Expr, deep: usize) -> bool {
        let Some(deep) = deep.checked_sub(1) else {
            return false;
        };
        match &condition.kind {
            ExprKind::Paren(inner) => self.is_moment(inner, deep),
            ExprKind::Binary { op, left, right } => {
                let (left, right) = (self.is_moment(left, deep), self.is_moment(right, deep));
                match op.node {
                    BinaryOp::And => left || right,
                    BinaryOp::Or => left && right,
                    _ => false,
                }
            }
            ExprKind::Ref(asked) => match self.names.value(&asked.name.name, false) {
                Some((Decl::Event(event), _)) => self.is_moment(&event.value, deep),
                Some(_) => false,
                None => matches!(asked.name.name.as_str(), "success" | "failure"),
            },
            _ => false,
        }
    }

    /// Whether a condition asks for nothing but that something does not happen.
    fn is_absence(&self, condition: &Expr, ends: &BTreeSet<String>) -> bool {
        match &condition.kind {
            ExprKind::Paren(inner) => self.is_absence(inner, ends),
            ExprKind::Unary { op, operand } => {
                op.node == UnaryOp::Not
                    && (self.is_moment(operand, DEEP) || ends.contains(&print::expr(operand)))
            }
            ExprKind::Binary { op, left, right } => {
                matches!(op.node, BinaryOp::And | BinaryOp::Or)
                    && self.is_absence(left, ends)
                    && self.is_absence(right, ends)
            }
            _ => false,
        }
    }
}
