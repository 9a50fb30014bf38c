//! A tree made ready to be read: each memory node knows by which terminations its children end.

use super::lattice::{Answer, Answers, Approximation, Ends, shown};
use super::{Irreducible, Reason};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node, Status};
use std::collections::BTreeSet;

/// A node whose choice follows from predicates and history.
#[derive(Clone, Debug)]
pub(in crate::tree) enum Plan<'a> {
    Condition(&'a Guard),
    Behavior(Id<Behavior>),
    Reactive(Composite, Vec<Plan<'a>>),
    /// A memory node, each child with the history atoms that show that it has ended.
    Resuming(Composite, Vec<(Plan<'a>, Vec<Atom>)>),
    Decorated(Decorator, Box<Plan<'a>>),
}

/// What follows a behaviour that has ended, in the same tick.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::tree) enum After {
    /// Anything: what a tree selects is the first behaviour that it ticks.
    Anything,
    /// Nothing: no predicate and no history shows a termination in its own tick.
    Nothing,
}

impl Plan<'_> {
    /// The atoms by which memory nodes go on, those of inner nodes first.
    pub(in crate::tree) fn visit_ended(&self, visit: &mut impl FnMut(&[Atom])) {
        match self {
            Plan::Condition(_) | Plan::Behavior(_) => {}
            Plan::Reactive(_, children) => {
                children.iter().for_each(|child| child.visit_ended(visit));
            }
            Plan::Resuming(_, children) => {
                children
                    .iter()
                    .for_each(|(child, _)| child.visit_ended(visit));
                children.iter().for_each(|(_, ended)| visit(ended));
            }
            Plan::Decorated(_, child) => child.visit_ended(visit),
        }
    }
}

/// The plan of a tree.
///
/// # Errors
/// A node whose choice depends on more than predicates and the history.
pub(in crate::tree) fn plan<'a>(
    root: &'a Node,
    after: After,
    when: &mut impl Approximation,
) -> Result<Plan<'a>, Irreducible> {
    let mut path = Vec::new();
    let mut planner = Planner { when, after };
    planner.node(root, &mut path).map(|made| made.plan)
}

struct Planner<'w, A> {
    when: &'w mut A,
    after: After,
}

/// A node with its abstract value.
struct Made<'a, W> {
    plan: Plan<'a>,
    /// Whether it may tick a behaviour.
    drives: bool,
    answers: Answers<Answer<W>>,
}

impl<A: Approximation> Planner<'_, A> {
    fn node<'a>(
        &mut self,
        node: &'a Node,
        path: &mut Vec<usize>,
    ) -> Result<Made<'a, A::When>, Irreducible> {
        match node {
            Node::Condition(guard) => {
                let Answers { success, failure } = self.when.guard(guard);
                Ok(Made {
                    plan: Plan::Condition(guard),
                    drives: false,
                    answers: Answers {
                        success: Answer::at_once(success),
                        failure: Answer::at_once(failure),
                    },
                })
            }
            Node::Behavior(behavior) => Ok(Made {
                plan: Plan::Behavior(*behavior),
                drives: true,
                answers: Answers {
                    success: Answer::by(*behavior, Status::Success, A::NEVER),
                    failure: Answer::by(*behavior, Status::Failure, A::NEVER),
                },
            }),
            Node::Composite {
                kind,
                memory,
                children,
            } => {
                let mut parts = Vec::new();
                for (i, child) in children.iter().enumerate() {
                    path.push(i);
                    let mut part = self.node(child, path)?;
                    path.pop();
                    part.answers = part.answers.seen_from(*kind);
                    parts.push(part);
                }
                let mut whole = match memory {
                    true => self.resuming(parts, *kind, path)?,
                    false => self.reactive(parts, *kind, path)?,
                };
                whole.answers = whole.answers.seen_from(*kind);
                Ok(whole)
            }
            Node::Parallel { .. } => Err(irreducible(path, None, Reason::Parallel)),
            Node::Decorator {
                kind: kind @ (Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_)),
                child,
            } => {
                path.push(0);
                self.node(child, path)?;
                path.pop();
                Err(irreducible(path, None, Reason::Counting(*kind)))
            }
            Node::Decorator { kind, child } => {
                path.push(0);
                let inner = self.node(child, path)?;
                path.pop();
                let never = Answer::at_once(A::NEVER);
                Ok(Made {
                    plan: Plan::Decorated(*kind, Box::new(inner.plan)),
                    drives: inner.drives,
                    answers: inner
                        .answers
                        .decorated(*kind, never, |a, b| a.join(b, self.when)),
                })
            }
        }
    }

    /// A reactive sequence of these.
    fn reactive<'a>(
        &mut self,
        parts: Vec<Made<'a, A::When>>,
        kind: Composite,
        path: &[usize],
    ) -> Result<Made<'a, A::When>, Irreducible> {
        let last = parts.len().saturating_sub(1);
        let mut plans = Vec::new();
        let mut drives = false;
        let mut success = Answer::at_once(A::ALWAYS);
        let mut failure = Answer::at_once(A::NEVER);
        for (i, part) in parts.into_iter().enumerate() {
            let passes = part.answers.success.at_once != A::NEVER;
            if self.after == After::Nothing && i < last && part.drives && !passes {
                return Err(irreducible(path, Some(i), Reason::Status(kind)));
            }
            let mut fails = part.answers.failure;
            if drives && fails.at_once != A::NEVER {
                // It fails after a success in the same tick, which the history shows as a success.
                fails.by = Ends::Unknown;
            }
            // It is reached at once only where all before it succeed at once.
            fails.at_once = self.when.both(success.at_once, fails.at_once);
            failure = failure.join(fails, self.when);
            let at_once = part.answers.success.at_once;
            success.at_once = self.when.both(success.at_once, at_once);
            if part.drives {
                success.by = match i == last && !(drives && passes) {
                    true => part.answers.success.by,
                    false => Ends::Unknown,
                };
                drives = true;
            }
            plans.push(part.plan);
        }
        Ok(Made {
            plan: Plan::Reactive(kind, plans),
            drives,
            answers: Answers { success, failure },
        })
    }

    /// A memory sequence of these.
    fn resuming<'a>(
        &mut self,
        parts: Vec<Made<'a, A::When>>,
        kind: Composite,
        path: &[usize],
    ) -> Result<Made<'a, A::When>, Irreducible> {
        let several = parts.len() > 1;
        let last = parts.len().saturating_sub(1);
        let mut known: BTreeSet<Id<Behavior>> = BTreeSet::new();
        let mut drives = false;
        let mut success = Answer::at_once(A::NEVER);
        let mut failure = Answer::at_once(A::NEVER);
        let mut children = Vec::new();
        for (i, part) in parts.into_iter().enumerate() {
            // A last child that answers at once ends the node, and passes nothing.
            if part.answers.success.at_once != A::NEVER && i < last {
                return Err(irreducible(path, Some(i), Reason::Passed(kind)));
            }
            success = part.answers.success;
            let Ends::By(ends) = &success.by else {
                return Err(irreducible(path, Some(i), Reason::Failure));
            };
            for (behavior, _) in ends {
                if !known.insert(*behavior) && several {
                    return Err(irreducible(path, Some(i), Reason::Twice(*behavior)));
                }
            }
            let ended: Vec<Atom> = ends.iter().map(shown).collect();
            children.push((part.plan, ended));
            drives |= part.drives;
            failure = failure.join(part.answers.failure, self.when);
        }
        Ok(Made {
            plan: Plan::Resuming(kind, children),
            drives,
            answers: Answers { success, failure },
        })
    }
}

fn irreducible(path: &[usize], child: Option<usize>, reason: Reason) -> Irreducible {
    Irreducible {
        path: path.iter().copied().chain(child).collect(),
        reason,
    }
}
