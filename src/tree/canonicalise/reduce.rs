//! Nodes to units.
//!
//! Every node is reduced to the behaviours that it may select, each with when it does, and to when it answers without a
//! behaviour. Memory nodes are read from the history: a memory sequence stands at the child after the last one whose
//! success the window holds, a memory selector likewise with failures (Figures 4 and 5).

use super::{Irreducible, Reason};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Node, Status};
use crate::tree::circuit::Signal;
use crate::tree::circuit::guards::Guards;
use std::collections::BTreeSet;

/// Terminations of behaviours.
type Ends = BTreeSet<(Id<Behavior>, Status)>;

/// A node reduced. Exactly one of the units, `success` and `failure` holds.
pub(super) struct Reduced {
    /// When each behaviour is selected, by leaf, from the left.
    pub(super) units: Vec<(Id<Behavior>, Signal)>,
    /// When it succeeds without a behaviour.
    success: Signal,
    /// When it fails without a behaviour.
    failure: Signal,
    /// The terminations by which it succeeds.
    succeeded: Option<Ends>,
    /// The terminations by which it fails; `None` where they do not tell.
    failed: Option<Ends>,
}

/// Reduces a node that stands at this path.
pub(super) fn reduce(
    node: &Node,
    path: &mut Vec<usize>,
    guards: &mut Guards,
) -> Result<Reduced, Irreducible> {
    match node {
        Node::Condition(guard) => {
            let holds = guards.signal(guard);
            Ok(Reduced {
                units: Vec::new(),
                success: holds,
                failure: !holds,
                succeeded: Some(Ends::new()),
                failed: Some(Ends::new()),
            })
        }
        Node::Behavior(behavior) => Ok(Reduced {
            units: vec![(*behavior, Signal::TRUE)],
            success: Signal::FALSE,
            failure: Signal::FALSE,
            succeeded: Some(Ends::from([(*behavior, Status::Success)])),
            failed: Some(Ends::from([(*behavior, Status::Failure)])),
        }),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let mut parts = Vec::new();
            for (i, child) in children.iter().enumerate() {
                path.push(i);
                parts.push(reduce(child, path, guards)?.seen_from(*kind));
                path.pop();
            }
            let whole = if *memory {
                resuming(parts, *kind, path, guards)?
            } else {
                reactive(parts, *kind, path, guards)?
            };
            Ok(whole.seen_from(*kind))
        }
        Node::Parallel { .. } => Err(irreducible(path, Reason::Parallel)),
        Node::Decorator { kind, child } => {
            path.push(0);
            let inner = reduce(child, path, guards)?;
            path.pop();
            match kind {
                Decorator::Invert => Ok(inner.inverted()),
                Decorator::Succeed => Ok(inner.always(guards)),
                Decorator::Fail => Ok(inner.inverted().always(guards).inverted()),
                Decorator::Retry(_) | Decorator::Repeat(_) | Decorator::Timeout(_) => {
                    Err(irreducible(path, Reason::Counting(*kind)))
                }
            }
        }
    }
}

fn irreducible(path: &[usize], reason: Reason) -> Irreducible {
    Irreducible {
        path: path.to_vec(),
        reason,
    }
}

fn below(path: &[usize], child: usize, reason: Reason) -> Irreducible {
    let mut found = irreducible(path, reason);
    found.path.push(child);
    found
}

impl Reduced {
    fn inverted(self) -> Self {
        Self {
            success: self.failure,
            failure: self.success,
            succeeded: self.failed,
            failed: self.succeeded,
            units: self.units,
        }
    }

    /// Under `succeed`.
    fn always(self, guards: &mut Guards) -> Self {
        let either = self.succeeded.zip(self.failed);
        Self {
            success: guards.circuit.or(self.success, self.failure),
            failure: Signal::FALSE,
            succeeded: either.map(|(a, b)| a.union(&b).copied().collect()),
            failed: Some(Ends::new()),
            units: self.units,
        }
    }

    /// A selector is a sequence with success and failure exchanged, inside and outside; so only sequences are reduced.
    fn seen_from(self, kind: Composite) -> Self {
        match kind {
            Composite::Sequence => self,
            Composite::Selector => self.inverted(),
        }
    }
}

/// The units where also `when` holds.
fn guarded(
    units: Vec<(Id<Behavior>, Signal)>,
    when: Signal,
    guards: &mut Guards,
) -> impl Iterator<Item = (Id<Behavior>, Signal)> {
    let guarded = units.into_iter();
    guarded.map(move |(behavior, unit)| (behavior, guards.circuit.and(when, unit)))
}

/// A reactive sequence of these.
fn reactive(
    parts: Vec<Reduced>,
    kind: Composite,
    path: &[usize],
    guards: &mut Guards,
) -> Result<Reduced, Irreducible> {
    let last = parts.len().saturating_sub(1);
    let mut driven = false;
    let mut units = Vec::new();
    let mut failure = Signal::FALSE;
    let mut passed = Signal::TRUE;
    let mut succeeded = Some(Ends::new());
    let mut failed = Some(Ends::new());
    for (i, part) in parts.into_iter().enumerate() {
        if i < last && !part.units.is_empty() && part.success == Signal::FALSE {
            return Err(below(path, i, Reason::Status(kind)));
        }
        let before = passed;
        let fails = guards.circuit.and(before, part.failure);
        failure = guards.circuit.or(failure, fails);
        passed = guards.circuit.and(before, part.success);
        if driven && part.failure != Signal::FALSE {
            // It fails after a success in the same tick, which the history shows as a success.
            failed = None;
        }
        failed = failed
            .zip(part.failed)
            .map(|(a, b)| a.union(&b).copied().collect());
        if !part.units.is_empty() {
            let tells = i == last && (!driven || part.success == Signal::FALSE);
            succeeded = part.succeeded.filter(|_| tells);
            driven = true;
        }
        units.extend(guarded(part.units, before, guards));
    }
    Ok(Reduced {
        units,
        success: passed,
        failure,
        succeeded,
        failed,
    })
}

/// A memory sequence of these.
fn resuming(
    parts: Vec<Reduced>,
    kind: Composite,
    path: &[usize],
    guards: &mut Guards,
) -> Result<Reduced, Irreducible> {
    let mut ends: Vec<Ends> = Vec::new();
    let mut known: BTreeSet<Id<Behavior>> = BTreeSet::new();
    for (i, part) in parts.iter().enumerate() {
        if part.success != Signal::FALSE {
            return Err(below(path, i, Reason::Passed(kind)));
        }
        let Some(end) = part.succeeded.clone() else {
            return Err(below(path, i, Reason::Failure));
        };
        for (behavior, _) in &end {
            if !known.insert(*behavior) && parts.len() > 1 {
                return Err(below(path, i, Reason::Twice(*behavior)));
            }
        }
        ends.push(end);
    }
    let last = parts.len().saturating_sub(1);
    let succeeded = ends.last().cloned();
    let ended: Vec<Signal> = ends.iter().map(|end| in_window(end, guards)).collect();
    let mut failed = Some(Ends::new());
    let mut units = Vec::new();
    let mut failure = Signal::FALSE;
    for (i, part) in parts.into_iter().enumerate() {
        // It stands at this child when the one before has ended, and none from here on has.
        let before = i.checked_sub(1).and_then(|b| ended.get(b)).copied();
        let later = ended.iter().take(last).skip(i).map(|end| !*end);
        let stands = guards.circuit.all(before.into_iter().chain(later));
        let fails = guards.circuit.and(stands, part.failure);
        failure = guards.circuit.or(failure, fails);
        failed = failed
            .zip(part.failed)
            .map(|(a, b)| a.union(&b).copied().collect());
        units.extend(guarded(part.units, stands, guards));
    }
    Ok(Reduced {
        units,
        success: Signal::FALSE,
        failure,
        succeeded,
        failed,
    })
}

/// When one of these terminations is in the window.
fn in_window(ends: &Ends, guards: &mut Guards) -> Signal {
    ends.iter().fold(Signal::FALSE, |any, (behavior, status)| {
        let atom = guards.atom(match status {
            Status::Failure => Atom::Failed(*behavior),
            _ => Atom::Done(*behavior),
        });
        guards.circuit.or(any, atom)
    })
}
