//! Ticks where no world says how long they are, and the timeouts that ask for it.

use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, Expr, ExprKind, Node, NodeKind, Unit, Word};
use std::collections::BTreeSet;

impl<'a> Checker<'a> {
    /// Reports the timeouts of the trees that claims and tests need, if no world says how long their times are. A file
    /// without a world may leave that to the one that uses it, but what it claims and tests itself is known here.
    pub fn timeouts_without_a_world(&mut self) {
        let needed = std::mem::take(&mut self.needed);
        if self.has_world {
            return;
        }
        let errors = self.diagnostics.iter().filter(|found| found.is_error());
        let wrong: BTreeSet<Span> = errors.map(Diagnostic::span).collect();
        let mut seen = BTreeSet::new();
        for (tree, asked) in needed {
            let mut times = self.timeouts_of(tree, &mut seen);
            times.retain(|time| !wrong.contains(time));
            for time in times {
                self.no_world(time, TIMEOUT, "how many ticks are these?")
                    .also(asked, "they are counted for this")
                    .help("count them: `timeout(50 ticks) { … }`");
            }
        }
    }

    /// The ticks of a timeout, which no world counts: what is not written as a number of them is a time.
    pub(super) fn counted_ticks(&mut self, time: &'a Expr) -> Option<u64> {
        let number = match &time.kind {
            ExprKind::Number(number) => number,
            _ => return self.ticks(time, TIMEOUT),
        };
        match &number.unit {
            None => self
                .error(
                    Code::E0301,
                    time.span,
                    format!("{TIMEOUT} is a time (s), not a plain number"),
                )
                .this_is(Type::NUMBER)
                .fix(
                    "without a world, count ticks",
                    time.span.after(),
                    " ticks",
                    Applicability::Unsafe,
                )
                .none(),
            Some(unit) if is_tick(unit) && number.value <= 0.0 => {
                self.less_than_a_tick(time.span, TIMEOUT, 0.0).none()
            }
            Some(_) => counted(time).or_else(|| self.ticks(time, TIMEOUT)),
        }
    }

    /// The times of the timeouts in a tree and its subtrees, as far as these were not seen.
    fn timeouts_of(&self, tree: &'a ast::Tree, seen: &mut BTreeSet<Span>) -> Vec<Span> {
        let mut times = Vec::new();
        let mut nodes: Vec<&'a Node> = Vec::new();
        if seen.insert(tree.name.span) {
            nodes.push(&tree.root);
        }
        while let Some(node) = nodes.pop() {
            match &node.kind {
                NodeKind::Composite {
                    word,
                    args,
                    children,
                    ..
                } => {
                    let arg = args.as_deref().and_then(<[ast::Arg]>::first);
                    if word.node == Word::Timeout
                        && let Some(ArgKind::Positional(time)) = arg.map(|arg| &arg.kind)
                        && counted(time).is_none()
                    {
                        times.push(time.span);
                    }
                    nodes.extend(children);
                }
                NodeKind::Guarded { node, .. } => nodes.push(node),
                NodeKind::Leaf(leaf) => {
                    let name = plain_ref(leaf).map(|leaf| leaf.name.name.as_str());
                    let named = name.and_then(|name| self.names.value(name, false));
                    if let Some((Decl::Tree(subtree), _)) = named
                        && seen.insert(subtree.name.span)
                    {
                        nodes.push(&subtree.root);
                    }
                }
                NodeKind::Error => {}
            }
        }
        times
    }
}

/// What a `timeout` takes, in messages.
pub(super) const TIMEOUT: &str = "a timeout";

/// Whether a unit counts ticks.
fn is_tick(unit: &Unit) -> bool {
    matches!(unit.text.as_str(), "tick" | "ticks")
}

/// A whole number of ticks, as it is written.
pub(super) fn counted(time: &Expr) -> Option<u64> {
    let ExprKind::Number(number) = &time.kind else {
        return None;
    };
    let unit = number.unit.as_ref()?;
    let whole = number.value.fract() == 0.0 && (1.0..=1e15).contains(&number.value);
    (whole && is_tick(unit)).then_some(number.value as u64)
}
