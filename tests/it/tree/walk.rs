//! Walks through the transitions of a policy with the naive interpreter.

use crate::laws::naive::{Memory, all_ticks, holds};
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::tree::{Atom, Composite, Decorator, Node, Status};
use btc::policy::{Minterm, Policy};
use btc::tree::equivalence::Trace;
use btc::tree::reading::Reading;
use btc::tree::tick::Runner;
use std::collections::{BTreeSet, VecDeque};

/// P2: the number of ticks after which the tree first does something else than the policy on some path, if it does.
pub(crate) fn parts_after(root: &Node, policy: &Policy) -> Option<usize> {
    let starts = policy
        .starts
        .iter()
        .map(|(m, _)| (Memory::new(), m.clone(), 0));
    let mut open: VecDeque<(Memory, Minterm, usize)> = starts.collect();
    let mut known: BTreeSet<(Memory, Minterm)> = BTreeSet::new();
    while let Some((memory, minterm, depth)) = open.pop_front() {
        if !known.insert((memory.clone(), minterm.clone())) {
            continue;
        }
        let Some(choice) = policy.choice(&minterm) else {
            continue;
        };
        let here = holds(&policy.atoms, &minterm);
        let mut outcomes = vec![(Status::Running, Some(minterm.clone()))];
        for t in &policy.transitions {
            if t.from == minterm && t.behavior == choice {
                outcomes.push((t.status, t.to.clone()));
            }
        }
        for (status, to) in outcomes {
            for tick in all_ticks(root, &memory, &here, status) {
                if tick.ticked.first() != Some(&choice) {
                    return Some(depth);
                }
                if let Some(to) = &to {
                    open.push_back((tick.memory, to.clone(), depth + 1));
                }
            }
        }
    }
    None
}

/// What a tree selects, or else answers, where each memory node stands behind the last of its children that has ended, or
/// behind the first that has while the next has not, as the history shows it.
pub(crate) fn read(
    node: &Node,
    by: Reading,
    holds: &dyn Fn(Atom) -> bool,
) -> Result<Id<Behavior>, bool> {
    match node {
        Node::Condition(guard) => Err(guard.eval(&mut |atom| holds(atom))),
        Node::Behavior(behavior) => Ok(*behavior),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let onward = *kind == Composite::Sequence;
            let ended = |i: usize| ends(&children[i], onward).into_iter().any(holds);
            let mut behind = 1..children.len();
            let first = match (memory, by) {
                (false, _) => None,
                (true, Reading::Furthest) => behind.rev().find(|i| ended(i - 1)),
                (true, Reading::Unfinished) => behind.find(|i| ended(i - 1) && !ended(*i)),
            };
            for child in &children[first.unwrap_or(0)..] {
                match read(child, by, holds) {
                    Err(answer) if answer == onward => {}
                    found => return found,
                }
            }
            Err(onward)
        }
        Node::Decorator { kind, child } => read(child, by, holds).map_err(|answer| match kind {
            Decorator::Invert => !answer,
            Decorator::Succeed => true,
            _ => false,
        }),
        Node::Parallel { .. } => panic!("has no canonical form"),
    }
}

/// The terminations by which a node succeeds, or fails.
fn ends(node: &Node, success: bool) -> Vec<Atom> {
    match node {
        Node::Condition(_) => vec![],
        Node::Behavior(b) if success => vec![Atom::Done(*b)],
        Node::Behavior(b) => vec![Atom::Failed(*b)],
        Node::Composite { kind, children, .. } => {
            let by_last = success == (*kind == Composite::Sequence);
            let from = if by_last { children.len() - 1 } else { 0 };
            let ending = children[from..].iter();
            ending.flat_map(|child| ends(child, success)).collect()
        }
        Node::Decorator { kind, child } => match kind {
            Decorator::Invert => ends(child, !success),
            Decorator::Succeed if success => [ends(child, true), ends(child, false)].concat(),
            Decorator::Fail if !success => [ends(child, true), ends(child, false)].concat(),
            _ => vec![],
        },
        Node::Parallel { .. } => panic!("has no canonical form"),
    }
}

/// Replays a trace against a policy in both interpreters: every step agrees, the last tick parts.
pub(crate) fn replay(root: &Node, policy: &Policy, trace: &Trace) {
    let mut naive = BTreeSet::from([Memory::new()]);
    let mut fast = BTreeSet::from([Runner::new(root, &trace.atoms).unwrap().memory().to_vec()]);
    let mut runner = Runner::new(root, &trace.atoms).unwrap();
    for step in &trace.steps {
        assert_eq!(step.behavior, policy.choice(&step.valuation));
        let here = holds(&trace.atoms, &step.valuation);
        let ticks = naive
            .iter()
            .flat_map(|m| all_ticks(root, m, &here, step.status));
        naive = ticks
            .filter(|tick| tick.ticked.first() == step.behavior.as_ref())
            .map(|tick| tick.memory)
            .collect();
        fast = fast
            .iter()
            .flat_map(|m| run(&mut runner, m, step.valuation.words(), step.status))
            .filter(|(ticked, _)| ticked.first() == step.behavior.as_ref())
            .map(|(_, memory)| memory)
            .collect();
        assert!(!naive.is_empty() && !fast.is_empty(), "the steps agree");
    }
    let here = holds(&trace.atoms, &trace.valuation);
    let selects = |m: &Memory| {
        let tick = &all_ticks(root, m, &here, Status::Running)[0];
        tick.ticked.first().copied()
    };
    assert!(naive.iter().any(|m| selects(m) == trace.left));
    assert!(fast.iter().any(|m| {
        let ticks = run(&mut runner, m, trace.valuation.words(), Status::Running);
        ticks[0].0.first().copied() == trace.left
    }));
    assert_eq!(policy.choice(&trace.valuation), trace.right);
    assert_ne!(trace.left, trace.right);
}

/// Every way in which a tick of the compiled tree can go.
fn run(
    runner: &mut Runner,
    memory: &[u64],
    valuation: &[u64],
    first: Status,
) -> Vec<(Vec<Id<Behavior>>, Vec<u64>)> {
    let mut found = vec![];
    let mut open: Vec<Vec<Status>> = vec![vec![first]];
    while let Some(script) = open.pop() {
        let mut ticked = vec![];
        runner.resume(memory);
        runner.tick(valuation, |behavior| {
            ticked.push(behavior);
            script
                .get(ticked.len() - 1)
                .copied()
                .unwrap_or(Status::Running)
        });
        if ticked.len() > script.len() {
            for status in [Status::Success, Status::Failure, Status::Running] {
                open.push([script.clone(), vec![status]].concat());
            }
        } else {
            found.push((ticked, runner.memory().to_vec()));
        }
    }
    found
}
