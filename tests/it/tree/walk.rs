//! Walks through the transitions of a policy with the naive interpreter.

use crate::naive::{Memory, all_ticks};
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::tree::{Atom, Composite, Node, Status};
use btc::policy::{Minterm, Policy};
use btc::tree::equivalence::Trace;
use btc::tree::prove::Reading;
use btc::tree::tick::Runner;
use std::collections::{BTreeSet, VecDeque};

/// Whether an atom holds in a minterm.
pub(crate) fn holds<'a>(atoms: &'a [Atom], minterm: &'a Minterm) -> impl Fn(Atom) -> bool + 'a {
    move |atom| {
        let at = atoms.iter().position(|a| *a == atom);
        at.is_some_and(|i| minterm.get(i))
    }
}

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

/// What a node does where memory nodes stand as the history says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reads {
    Behavior(Id<Behavior>),
    Answer(bool),
}

/// P1's reading of a learned tree: a memory node stands behind the last child whose end the window holds, or behind the
/// first that has ended while the next has not.
pub(crate) fn read(node: &Node, by: Reading, holds: &dyn Fn(Atom) -> bool) -> Reads {
    match node {
        Node::Condition(guard) => Reads::Answer(guard.eval(&mut |a| holds(a))),
        Node::Behavior(b) => Reads::Behavior(*b),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let onward = *kind == Composite::Sequence;
            if *memory {
                let ended = |child: &Node| match onward {
                    true => holds(Atom::Done(last(child))),
                    false => holds(Atom::Failed(last(child))),
                };
                let stands = match by {
                    Reading::Furthest => {
                        (1..children.len()).rev().find(|i| ended(&children[i - 1]))
                    }
                    Reading::Unfinished => (1..children.len())
                        .find(|i| ended(&children[i - 1]) && !ended(&children[*i])),
                };
                return read(&children[stands.unwrap_or(0)], by, holds);
            }
            for child in children {
                match read(child, by, holds) {
                    Reads::Answer(answer) if answer == onward => {}
                    other => return other,
                }
            }
            Reads::Answer(onward)
        }
        other => panic!("not in a learned tree: {other:?}"),
    }
}

fn last(node: &Node) -> Id<Behavior> {
    match node {
        Node::Behavior(b) => *b,
        Node::Composite { children, .. } => last(children.last().unwrap()),
        other => panic!("ends no child of a memory node: {other:?}"),
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
