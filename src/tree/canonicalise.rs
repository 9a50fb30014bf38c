//! Trees to canonical form (paper, section IV): a selector of units `guard => behaviour`, one per behaviour.
//!
//! Every node is reduced to the behaviours that it may select, each with the guard under which it does, and to the
//! guards under which it answers without a behaviour. Memory nodes are read from the history: a memory sequence stands
//! at the child after the last one whose success the window holds, a memory selector likewise with failures
//! (Figures 4 and 5).

mod table;

pub use table::Decided;

use super::formula::{and, guarded, not, or, selector};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node, Status};
use std::collections::BTreeSet;

/// A canonical behaviour tree: from the left, the first unit whose guard holds drives.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Canonical {
    /// The units, one per behaviour; no two guards hold together.
    pub units: Vec<Unit>,
}

/// A guard and the behaviour that it lets through.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unit {
    /// When the behaviour is selected.
    pub guard: Guard,
    /// The behaviour.
    pub behavior: Id<Behavior>,
}

/// Why a tree has no canonical form, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Irreducible {
    /// The way to the node from the root: the numbers of children. `guard => node` is a sequence of two.
    pub path: Vec<usize>,
    /// Why it cannot be reduced.
    pub reason: Reason,
}

/// What more than predicates and the history a node depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// What follows this child is reached only by the status of its behaviour in the same tick.
    Status(Composite),
    /// Several children at a time.
    Parallel,
    /// A count.
    Counting(Decorator),
    /// A child of a memory node that answers without a behaviour: the history does not tell that it was passed.
    Passed(Composite),
    /// Two children of a memory node end with the same behaviour: the history does not tell which one it was.
    Twice(Id<Behavior>),
    /// A memory node goes by the failure of a selector whose next child is ticked in the same tick.
    Failure,
}

impl Irreducible {
    /// Why, in words.
    pub fn message(&self) -> &'static str {
        match self.reason {
            Reason::Status(Composite::Selector) => {
                "what follows is reached only when this behaviour fails, in the same tick"
            }
            Reason::Status(Composite::Sequence) => {
                "what follows is reached only when this behaviour succeeds, in the same tick"
            }
            Reason::Parallel => "`parallel` ticks several children at a time",
            Reason::Counting(Decorator::Timeout(_)) => {
                "`timeout` counts ticks, which no predicate tells"
            }
            Reason::Counting(_) => "the decorator counts, which no predicate tells",
            Reason::Passed(_) => "no predicate tells that a memory node has passed a condition",
            Reason::Twice(_) => {
                "the behaviour ends two children of a memory node, and the history does not tell which"
            }
            Reason::Failure => {
                "the history does not tell that a selector of several behaviours has failed"
            }
        }
    }
}

impl Canonical {
    /// The units as a tree.
    pub fn tree(&self) -> Node {
        let units = self.units.iter();
        selector(
            units
                .map(|unit| guarded(unit.guard.clone(), Node::Behavior(unit.behavior)))
                .collect(),
        )
    }

    /// The behaviour that is selected where the atoms have these values.
    pub fn select(&self, holds: &mut impl FnMut(Atom) -> bool) -> Option<Id<Behavior>> {
        let mut units = self.units.iter();
        units
            .find(|unit| unit.guard.eval(holds))
            .map(|unit| unit.behavior)
    }
}

/// The canonical form of a tree.
///
/// # Errors
/// A node whose choice depends on more than predicates and history, with the reason.
pub fn canonicalise(root: &Node) -> Result<Canonical, Irreducible> {
    let reduced = reduce(root, &mut Vec::new())?;
    let mut units: Vec<Unit> = Vec::new();
    for unit in reduced.units {
        if unit.guard == Guard::Const(false) {
            continue;
        }
        match units.iter_mut().find(|u| u.behavior == unit.behavior) {
            Some(same) => same.guard = or([same.guard.clone(), unit.guard]),
            None => units.push(unit),
        }
    }
    Ok(Canonical { units })
}

/// Terminations of behaviours.
type Ends = BTreeSet<(Id<Behavior>, Status)>;

/// A node reduced. Exactly one of the units' guards, `success` and `failure` holds.
struct Reduced {
    units: Vec<Unit>,
    /// It succeeds without a behaviour.
    success: Guard,
    /// It fails without a behaviour.
    failure: Guard,
    /// The terminations by which it succeeds.
    succeeded: Option<Ends>,
    /// The terminations by which it fails; `None` where they do not tell.
    failed: Option<Ends>,
}

fn reduce(node: &Node, path: &mut Vec<usize>) -> Result<Reduced, Irreducible> {
    let none = Guard::Const(false);
    match node {
        Node::Condition(guard) => Ok(Reduced {
            units: Vec::new(),
            success: guard.clone(),
            failure: not(guard.clone()),
            succeeded: Some(BTreeSet::new()),
            failed: Some(BTreeSet::new()),
        }),
        Node::Behavior(behavior) => Ok(Reduced {
            units: vec![Unit {
                guard: Guard::Const(true),
                behavior: *behavior,
            }],
            success: none.clone(),
            failure: none,
            succeeded: Some(BTreeSet::from([(*behavior, Status::Success)])),
            failed: Some(BTreeSet::from([(*behavior, Status::Failure)])),
        }),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let mut parts = Vec::new();
            for (i, child) in children.iter().enumerate() {
                path.push(i);
                parts.push(reduce(child, path)?.seen_from(*kind));
                path.pop();
            }
            let whole = if *memory {
                resuming(parts, *kind, path)?
            } else {
                reactive(parts, *kind, path)?
            };
            Ok(whole.seen_from(*kind))
        }
        Node::Parallel { .. } => Err(irreducible(path, Reason::Parallel)),
        Node::Decorator { kind, child } => {
            path.push(0);
            let inner = reduce(child, path)?;
            path.pop();
            match kind {
                Decorator::Invert => Ok(inner.inverted()),
                Decorator::Succeed => Ok(inner.always()),
                Decorator::Fail => Ok(inner.inverted().always().inverted()),
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
    fn always(self) -> Self {
        let either = self.succeeded.zip(self.failed);
        Self {
            success: or([self.success, self.failure]),
            failure: Guard::Const(false),
            succeeded: either.map(|(a, b)| a.union(&b).copied().collect()),
            failed: Some(BTreeSet::new()),
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

    fn guarded_by(self, guard: &Guard) -> impl Iterator<Item = Unit> {
        let guard = guard.clone();
        self.units.into_iter().map(move |unit| Unit {
            guard: and([guard.clone(), unit.guard]),
            behavior: unit.behavior,
        })
    }
}

/// A reactive sequence of these.
fn reactive(parts: Vec<Reduced>, kind: Composite, path: &[usize]) -> Result<Reduced, Irreducible> {
    let last = parts.len().saturating_sub(1);
    let never = Guard::Const(false);
    let mut driven = false;
    let mut units = Vec::new();
    let mut failure = Vec::new();
    let mut passed = Guard::Const(true);
    let mut succeeded = Some(Ends::new());
    let mut failed = Some(Ends::new());
    for (i, part) in parts.into_iter().enumerate() {
        if i < last && !part.units.is_empty() && part.success == never {
            return Err(below(path, i, Reason::Status(kind)));
        }
        failure.push(and([passed.clone(), part.failure.clone()]));
        let before = passed.clone();
        passed = and([passed, part.success.clone()]);
        if driven && part.failure != never {
            // It fails after a success in the same tick, which the history shows as a success.
            failed = None;
        }
        failed = failed
            .zip(part.failed.clone())
            .map(|(a, b)| a.union(&b).copied().collect());
        if !part.units.is_empty() {
            let tells = i == last && (!driven || part.success == never);
            succeeded = part.succeeded.clone().filter(|_| tells);
            driven = true;
        }
        units.extend(part.guarded_by(&before));
    }
    Ok(Reduced {
        units,
        success: passed,
        failure: or(failure),
        succeeded,
        failed,
    })
}

/// A memory sequence of these.
fn resuming(parts: Vec<Reduced>, kind: Composite, path: &[usize]) -> Result<Reduced, Irreducible> {
    let mut ends: Vec<Ends> = Vec::new();
    let mut known: BTreeSet<Id<Behavior>> = BTreeSet::new();
    for (i, part) in parts.iter().enumerate() {
        if part.success != Guard::Const(false) {
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
    let mut failed = Some(Ends::new());
    let mut units = Vec::new();
    let mut failure = Vec::new();
    for (i, part) in parts.into_iter().enumerate() {
        // It stands at this child when the one before has ended, and none from here on has.
        let before = i.checked_sub(1).and_then(|b| ends.get(b)).map(ended);
        let later = ends.iter().take(last).skip(i).map(|end| not(ended(end)));
        let stands = and(before.into_iter().chain(later));
        failure.push(and([stands.clone(), part.failure.clone()]));
        failed = failed
            .zip(part.failed.clone())
            .map(|(a, b)| a.union(&b).copied().collect());
        units.extend(part.guarded_by(&stands));
    }
    Ok(Reduced {
        units,
        success: Guard::Const(false),
        failure: or(failure),
        succeeded,
        failed,
    })
}

/// One of these terminations is in the window.
fn ended(by: &Ends) -> Guard {
    or(by.iter().map(|(behavior, status)| {
        Guard::Atom(match status {
            Status::Failure => Atom::Failed(*behavior),
            _ => Atom::Done(*behavior),
        })
    }))
}
