//! Parts of conditions that change nothing beside the others: `battery <= 30% and battery <= 0%`, `a or (a and b)`.

use super::cases::{Cases, of_expr, of_guard};
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::ExprId;
use crate::ir::name::Given;
use crate::ir::tree::Guard;
use crate::source::Span;
use crate::syntax::ast::{BinaryOp, Expr, ExprKind};
use std::collections::{BTreeMap, BTreeSet};

/// The most parts of one chain that are held against each other.
const MOST: usize = 12;

/// Both sides of an `and` or an `or`.
#[derive(Clone, Copy, Debug)]
pub struct Joint {
    op: BinaryOp,
    sides: [(Span, ExprId); 2],
    /// Whether any robot may ask it.
    of_any_robot: bool,
}

/// What `and` and `or` join, by where the whole stands: several, where a text stands for several members.
pub type Joints = BTreeMap<Span, Vec<Joint>>;

/// A part that changes nothing, and the one that says why, if it is one.
struct Idle {
    at: Span,
    beside: Option<Span>,
}

impl<'a> Checker<'a> {
    /// Notes an `and` or an `or`. Where it depends on a number that is given, nothing is said.
    pub fn joint(&mut self, op: BinaryOp, at: Span, sides: [(&'a Expr, Option<ExprId>); 2]) {
        let number =
            |given: &Option<Given>| matches!(given, Some(Given::Text(_) | Given::Tuned { .. }));
        let mut scope = self.context.scope.iter();
        if self.context.library || scope.any(|bound| number(&bound.given)) {
            return;
        }
        let [(left, Some(a)), (right, Some(b))] = sides else {
            return;
        };
        let joint = Joint {
            op,
            sides: [(left.span, a), (right.span, b)],
            of_any_robot: !self.context.region.of_the_learner(),
        };
        self.joints.entry(at).or_default().push(joint);
    }

    /// Warns of the parts of conditions without which they would say the same.
    pub fn parts_without_effect(&mut self) {
        let joints = &std::mem::take(&mut self.joints);
        let told = self.told();
        let alone = self.has_one_robot();
        let all = joints.values().filter_map(|of| of.first());
        let sides = all.flat_map(|joint| joint.sides.map(|(at, _)| (joint.op, at)));
        let inner = sides.filter(|(op, at)| op_at(joints, *at) == Some(*op));
        let inner: BTreeSet<Span> = inner.map(|(_, at)| at).collect();
        for (at, of) in joints {
            let Some(op) = of.first().map(|joint| joint.op) else {
                continue;
            };
            let unsure = of.iter().any(|joint| joint.of_any_robot && !alone);
            if inner.contains(at) || unsure || told.overlap(*at) {
                continue;
            }
            let mut found: Option<Vec<Idle>> = None;
            for (member, joint) in of.iter().enumerate() {
                let mut parts = Vec::new();
                chain(joints, (joint, member), &mut parts);
                let parts = parts.into_iter();
                let parts = parts.map(|(at, id)| (at, of_expr(&self.program, id, true)));
                let idle = idle(joint.op, parts.collect());
                found = Some(match found {
                    None => idle,
                    Some(found) => {
                        let also = |it: &Idle| idle.iter().any(|other| other.at == it.at);
                        found.into_iter().filter(also).collect()
                    }
                });
            }
            for idle in found.into_iter().flatten() {
                self.changes_nothing(op, &idle);
            }
        }
    }

    /// Warns of the parts of a guard without which it would say the same.
    pub fn parts_of_guard(&mut self, written: &'a Expr, guard: &Guard) {
        let mut open = vec![(written, guard)];
        while let Some((written, guard)) = open.pop() {
            let (op, parts) = match guard {
                Guard::And(parts) => (BinaryOp::And, parts),
                Guard::Or(parts) => (BinaryOp::Or, parts),
                Guard::Not(inner) => {
                    if let ExprKind::Unary { operand, .. } = &unwrapped(written).kind {
                        open.push((operand, inner));
                    }
                    continue;
                }
                _ => continue,
            };
            let texts = operands(op, written);
            if texts.len() != parts.len() {
                continue;
            }
            let cases = |part| of_guard(&self.program, part, true);
            let of = texts.iter().zip(parts);
            let of = of.map(|(text, part)| (text.span, cases(part)));
            let idle = idle(op, of.collect());
            if idle.is_empty() {
                open.extend(texts.into_iter().zip(parts));
                continue;
            }
            let told = self.told();
            for idle in idle.iter().filter(|idle| !told.overlap(idle.at)) {
                self.changes_nothing(op, idle);
            }
        }
    }

    fn changes_nothing(&mut self, op: BinaryOp, idle: &Idle) {
        let (message, label, beside) = match op {
            BinaryOp::Or => (
                "this alternative adds nothing",
                "wherever it holds, the rest holds without it",
                "wherever the other holds, this does",
            ),
            _ => (
                "this part of the condition asks nothing more",
                "it holds wherever the rest does",
                "wherever this holds, the other does",
            ),
        };
        let draft = self.warning(Code::W0604, idle.at, message).label(label);
        if let Some(at) = idle.beside {
            draft.also(at, beside);
        }
    }
}

/// The operator of what stands at a place.
fn op_at(joints: &Joints, at: Span) -> Option<BinaryOp> {
    Some(joints.get(&at)?.first()?.op)
}

/// The parts of a chain of one operator, for one member of those that the text stands for.
fn chain(joints: &Joints, (joint, member): (&Joint, usize), parts: &mut Vec<(Span, ExprId)>) {
    for (at, id) in joint.sides {
        let inner = joints.get(&at).and_then(|of| of.get(member));
        match inner.filter(|inner| inner.op == joint.op) {
            Some(inner) => chain(joints, (inner, member), parts),
            None => parts.push((at, id)),
        }
    }
}

/// The operands of a chain of one operator.
fn operands(op: BinaryOp, written: &Expr) -> Vec<&Expr> {
    match &unwrapped(written).kind {
        ExprKind::Binary {
            op: joins,
            left,
            right,
        } if joins.node == op => [operands(op, left), operands(op, right)].concat(),
        _ => vec![written],
    }
}

fn unwrapped(mut written: &Expr) -> &Expr {
    while let ExprKind::Paren(inner) = &written.kind {
        written = inner;
    }
    written
}

/// The parts without which the whole says the same; of two that say the same, the later one.
fn idle(op: BinaryOp, parts: Vec<(Span, Cases)>) -> Vec<Idle> {
    if parts.len() > MOST {
        return Vec::new();
    }
    let follows = |one: &Cases, other: &Cases| match op {
        BinaryOp::And => one.implies(other),
        _ => other.implies(one),
    };
    let mut left = parts;
    let mut found = Vec::new();
    for at in (0..left.len()).rev() {
        let (span, own) = left.remove(at);
        let first = Cases::constant(op == BinaryOp::And);
        let rest = left.iter().fold(first, |rest, (_, part)| match op {
            BinaryOp::And => rest.and(part),
            _ => rest.or(part),
        });
        // What always or never holds has a warning of its own.
        let tells = !own.is_always() && !own.is_never() && !rest.is_never() && !left.is_empty();
        if tells && follows(&rest, &own) {
            let mut others = left.iter();
            let beside = others.find(|(_, other)| follows(other, &own));
            let beside = beside.map(|(at, _)| *at);
            found.push(Idle { at: span, beside });
        } else {
            left.insert(at, (span, own));
        }
    }
    found
}
