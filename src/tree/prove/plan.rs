//! A tree made ready to be read: each memory node knows by which terminations its children end.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node, Status};
use crate::tree::canonicalise::{Irreducible, Reason};
use std::collections::BTreeSet;

/// A node whose choice follows from predicates and history.
#[derive(Clone, Debug)]
pub(super) enum Plan<'a> {
    Condition(&'a Guard),
    Behavior(Id<Behavior>),
    Reactive(Composite, Vec<Plan<'a>>),
    /// A memory node, each child with the history atoms that say that it has ended.
    Resuming(Composite, Vec<(Plan<'a>, Vec<Atom>)>),
    Decorated(Decorator, Box<Plan<'a>>),
}

/// Where a memory node stands, as the history window shows it. With a window of one termination the two are the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reading {
    /// After the furthest child that has ended (paper, Figures 4 and 5).
    Furthest,
    /// After the first child that has ended while the next has not: so a longer window, which still holds how the node
    /// ended the last time, shows a node that has started over.
    Unfinished,
}

impl Plan<'_> {
    /// Whether a node remembers anything from tick to tick.
    pub(super) fn remembers(&self) -> bool {
        match self {
            Plan::Condition(_) | Plan::Behavior(_) => false,
            Plan::Reactive(_, children) => children.iter().any(Plan::remembers),
            Plan::Resuming(..) => true,
            Plan::Decorated(_, child) => child.remembers(),
        }
    }
}

/// The plan of a tree.
///
/// # Errors
/// A node whose choice depends on more than predicates and the history.
pub(super) fn plan(root: &Node) -> Result<Plan<'_>, Irreducible> {
    made(root, &mut Vec::new()).map(|(plan, _)| plan)
}

/// Terminations of behaviours.
type Ends = BTreeSet<(Id<Behavior>, Status)>;

/// How a node may answer.
#[derive(Clone, Debug)]
struct Answers {
    /// Whether it may select a behaviour.
    drives: bool,
    success: Answer,
    failure: Answer,
}

/// One of the two answers.
#[derive(Clone, Debug)]
struct Answer {
    /// It may be given without a behaviour.
    at_once: bool,
    /// The terminations by which it is given; `None` where they do not tell.
    by: Option<Ends>,
}

impl Answer {
    fn at_once(at_once: bool) -> Self {
        Self {
            at_once,
            by: Some(Ends::new()),
        }
    }

    fn or(self, other: Self) -> Self {
        Self {
            at_once: self.at_once || other.at_once,
            by: self.by.zip(other.by).map(|(mut a, b)| {
                a.extend(b);
                a
            }),
        }
    }
}

impl Answers {
    fn inverted(self) -> Self {
        Self {
            success: self.failure,
            failure: self.success,
            ..self
        }
    }

    /// A selector is a sequence with success and failure exchanged, inside and outside.
    fn seen_from(self, kind: Composite) -> Self {
        match kind {
            Composite::Sequence => self,
            Composite::Selector => self.inverted(),
        }
    }
}

fn made<'a>(node: &'a Node, path: &mut Vec<usize>) -> Result<(Plan<'a>, Answers), Irreducible> {
    match node {
        Node::Condition(guard) => {
            let answers = Answers {
                drives: false,
                success: Answer::at_once(*guard != Guard::Const(false)),
                failure: Answer::at_once(*guard != Guard::Const(true)),
            };
            Ok((Plan::Condition(guard), answers))
        }
        Node::Behavior(behavior) => {
            let by = |status| Answer {
                at_once: false,
                by: Some(Ends::from([(*behavior, status)])),
            };
            let answers = Answers {
                drives: true,
                success: by(Status::Success),
                failure: by(Status::Failure),
            };
            Ok((Plan::Behavior(*behavior), answers))
        }
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let mut parts = Vec::new();
            for (i, child) in children.iter().enumerate() {
                path.push(i);
                let (plan, answers) = made(child, path)?;
                path.pop();
                parts.push((plan, answers.seen_from(*kind)));
            }
            let (plan, answers) = if *memory {
                resuming(parts, *kind, path)?
            } else {
                let answers = reactive(parts.iter().map(|(_, answers)| answers));
                let plans = parts.into_iter().map(|(plan, _)| plan).collect();
                (Plan::Reactive(*kind, plans), answers)
            };
            Ok((plan, answers.seen_from(*kind)))
        }
        Node::Parallel { .. } => Err(irreducible(path, None, Reason::Parallel)),
        Node::Decorator { kind, child } => {
            path.push(0);
            let (plan, inner) = made(child, path)?;
            path.pop();
            let always = |answers: Answers| Answers {
                drives: answers.drives,
                success: answers.success.or(answers.failure),
                failure: Answer::at_once(false),
            };
            let answers = match kind {
                Decorator::Invert => inner.inverted(),
                Decorator::Succeed => always(inner),
                Decorator::Fail => always(inner).inverted(),
                Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_) => {
                    return Err(irreducible(path, None, Reason::Counting(*kind)));
                }
            };
            Ok((Plan::Decorated(*kind, Box::new(plan)), answers))
        }
    }
}

fn irreducible(path: &[usize], child: Option<usize>, reason: Reason) -> Irreducible {
    Irreducible {
        path: path.iter().copied().chain(child).collect(),
        reason,
    }
}

/// The answers of a reactive sequence of these.
fn reactive<'a>(parts: impl ExactSizeIterator<Item = &'a Answers>) -> Answers {
    let last = parts.len().saturating_sub(1);
    let mut whole = Answers {
        drives: false,
        success: Answer::at_once(true),
        failure: Answer::at_once(false),
    };
    for (i, part) in parts.enumerate() {
        // It is reached at once only where all before it succeed at once.
        let reached = whole.success.at_once;
        let mut failure = part.failure.clone();
        if whole.drives && failure.at_once {
            // It fails after a success in the same tick, which the history shows as a success.
            failure.by = None;
        }
        failure.at_once &= reached;
        whole.failure = whole.failure.or(failure);
        whole.success.at_once &= part.success.at_once;
        if part.drives {
            let tells = i == last && (!whole.drives || !part.success.at_once);
            whole.success.by = part.success.by.clone().filter(|_| tells);
            whole.drives = true;
        }
    }
    whole
}

/// A memory sequence of these.
fn resuming<'a>(
    parts: Vec<(Plan<'a>, Answers)>,
    kind: Composite,
    path: &[usize],
) -> Result<(Plan<'a>, Answers), Irreducible> {
    let several = parts.len() > 1;
    let last = parts.len().saturating_sub(1);
    let mut known: BTreeSet<Id<Behavior>> = BTreeSet::new();
    let mut whole = Answers {
        drives: false,
        success: Answer::at_once(false),
        failure: Answer::at_once(false),
    };
    let mut children = Vec::new();
    for (i, (plan, answers)) in parts.into_iter().enumerate() {
        // A last child that answers at once ends the node, and passes nothing.
        if answers.success.at_once && i < last {
            return Err(irreducible(path, Some(i), Reason::Passed(kind)));
        }
        let Some(ends) = answers.success.by.clone() else {
            return Err(irreducible(path, Some(i), Reason::Failure));
        };
        for (behavior, _) in &ends {
            if !known.insert(*behavior) && several {
                return Err(irreducible(path, Some(i), Reason::Twice(*behavior)));
            }
        }
        let ended = ends.iter().map(|(behavior, status)| match status {
            Status::Failure => Atom::Failed(*behavior),
            _ => Atom::Done(*behavior),
        });
        children.push((plan, ended.collect()));
        whole.drives |= answers.drives;
        whole.success = Answer {
            at_once: answers.success.at_once,
            by: Some(ends),
        };
        whole.failure = whole.failure.or(answers.failure);
    }
    Ok((Plan::Resuming(kind, children), whole))
}
