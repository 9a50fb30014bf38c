//! A second interpreter of ticks, written for plainness: it walks the tree as it stands and clones its memory.
//!
//! It shares no code with the one under test; what the two agree on is what `semantics.md` says.

use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::tree::{Atom, Composite, Decorator, Node, Status};
use btc::policy::Minterm;
use std::collections::BTreeMap;

/// The memory of a tree: what each node that was reached by the last tick remembers, by its path from the root.
pub(crate) type Memory = BTreeMap<Vec<usize>, u64>;

/// The answer to one tick.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Tick {
    pub(crate) status: Status,
    /// Every behaviour that was ticked, in order; the first is the one that the tree selects.
    pub(crate) ticked: Vec<Id<Behavior>>,
    pub(crate) memory: Memory,
}

/// Whether an atom holds in a minterm.
pub(crate) fn holds<'a>(atoms: &'a [Atom], minterm: &'a Minterm) -> impl Fn(Atom) -> bool + 'a {
    move |atom| {
        let at = atoms.iter().position(|a| *a == atom);
        at.is_some_and(|i| minterm.get(i))
    }
}

/// Ticks `node` once with the memory that the last tick left.
pub(crate) fn tick(
    node: &Node,
    memory: &Memory,
    holds: &dyn Fn(Atom) -> bool,
    leaf: &mut dyn FnMut(Id<Behavior>) -> Status,
) -> Tick {
    let mut ticked = Vec::new();
    let mut next = Memory::new();
    let mut recording = |behavior| {
        ticked.push(behavior);
        leaf(behavior)
    };
    let status = visit(node, &mut vec![], memory, &mut next, holds, &mut recording).0;
    Tick {
        status,
        ticked,
        memory: next,
    }
}

/// The status of a node, and whether a behaviour was ticked in it.
fn visit(
    node: &Node,
    path: &mut Vec<usize>,
    old: &Memory,
    new: &mut Memory,
    holds: &dyn Fn(Atom) -> bool,
    leaf: &mut dyn FnMut(Id<Behavior>) -> Status,
) -> (Status, bool) {
    use Status::{Failure, Running, Success};
    let mut child_of = |i: usize, child: &Node, path: &mut Vec<usize>, new: &mut Memory| {
        path.push(i);
        let answer = visit(child, path, old, new, holds, &mut *leaf);
        path.pop();
        answer
    };
    match node {
        Node::Condition(guard) => {
            let truth = guard.eval(&mut |atom| holds(atom));
            (if truth { Success } else { Failure }, false)
        }
        Node::Behavior(behavior) => (leaf(*behavior), true),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let onward = match kind {
                Composite::Sequence => Success,
                Composite::Selector => Failure,
            };
            let first = if *memory {
                old.get(path).copied().unwrap_or(0) as usize
            } else {
                0
            };
            let mut any = false;
            for (i, child) in children.iter().enumerate().skip(first) {
                let (status, drove) = child_of(i, child, path, new);
                any |= drove;
                if status == Running {
                    if *memory {
                        new.insert(path.clone(), i as u64);
                    }
                    return (Running, any);
                }
                if status != onward {
                    return (status, any);
                }
                if *memory && drove && i + 1 < children.len() {
                    new.insert(path.clone(), i as u64 + 1);
                    return (Running, any);
                }
            }
            (onward, any)
        }
        Node::Parallel {
            successes,
            children,
        } => {
            let mut any = false;
            let mut answers = vec![];
            for (i, child) in children.iter().enumerate() {
                let (status, drove) = child_of(i, child, path, new);
                any |= drove;
                answers.push(status);
            }
            let count = |s: Status| answers.iter().filter(|a| **a == s).count();
            let needed = *successes as usize;
            if count(Success) >= needed {
                new.retain(|key, _| !key.starts_with(path));
                (Success, any)
            } else if count(Success) + count(Running) < needed {
                new.retain(|key, _| !key.starts_with(path));
                (Failure, any)
            } else {
                (Running, any)
            }
        }
        Node::Decorator { kind, child } => {
            let count = old.get(path).copied().unwrap_or(0);
            if let Decorator::Timeout(ticks) = kind
                && count >= *ticks
            {
                return (Failure, false);
            }
            let (status, drove) = child_of(0, child, path, new);
            let mut keep = |value: u64| {
                new.insert(path.clone(), value);
                Running
            };
            let status = match (kind, status) {
                (Decorator::Invert, Success) => Failure,
                (Decorator::Invert, Failure) => Success,
                (Decorator::Succeed, Failure) => Success,
                (Decorator::Fail, Success) => Failure,
                (Decorator::Timeout(_), Running) => keep(count + 1),
                (Decorator::Retry(_) | Decorator::Repeat(_), Running) => keep(count),
                (Decorator::Retry(n), Failure) if count + 1 < u64::from(*n) => keep(count + 1),
                (Decorator::Repeat(n), Success) if count + 1 < u64::from(*n) => keep(count + 1),
                (_, status) => status,
            };
            (status, drove)
        }
    }
}

/// Every way in which a tick can go when the selected behaviour answers `first` and further ones may answer anything.
pub(crate) fn all_ticks(
    node: &Node,
    memory: &Memory,
    holds: &dyn Fn(Atom) -> bool,
    first: Status,
) -> Vec<Tick> {
    let mut found = vec![];
    let mut open: Vec<Vec<Status>> = vec![vec![]];
    while let Some(further) = open.pop() {
        let mut calls = 0;
        let tick = tick(node, memory, holds, &mut |_| {
            calls += 1;
            match calls {
                1 => first,
                n => further.get(n - 2).copied().unwrap_or(Status::Running),
            }
        });
        if calls > further.len() + 1 {
            for status in [Status::Success, Status::Failure, Status::Running] {
                let mut longer = further.clone();
                longer.push(status);
                open.push(longer);
            }
        } else {
            found.push(tick);
        }
    }
    found
}
