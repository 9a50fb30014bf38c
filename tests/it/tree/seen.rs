//! What a tree was seen to do in a world whose predicates and statuses come at random.

use crate::laws::naive::holds;
use crate::laws::naive::{Memory, tick};
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Node, Status};
use btc::policy::{Minterm, Policy, Row, Transition};
use btc::tree::atoms::{atoms, behaviors};
use std::collections::BTreeMap;

/// The policy and the greedy transitions that a tree shows by itself. Where it selects nothing, or otherwise than before
/// in the same minterm, the episode ends.
pub(crate) fn seen(root: &Node, history: History, random: &mut Random) -> Policy {
    let behaviors: Vec<Id<Behavior>> = behaviors(root).into_iter().collect();
    let kept = |status: Status| match status {
        Status::Success => history.success,
        Status::Failure => history.failure,
        Status::Running => false,
    };
    let mut atoms: Vec<Atom> = atoms(root)
        .into_iter()
        .filter(|atom| matches!(atom, Atom::Predicate(_)))
        .collect();
    let predicates = atoms.len();
    if kept(Status::Success) {
        atoms.extend(behaviors.iter().map(|b| Atom::Done(*b)));
    }
    if kept(Status::Failure) {
        atoms.extend(behaviors.iter().map(|b| Atom::Failed(*b)));
    }
    // Most worlds have behaviours that only succeed, or only fail.
    let (by, other) = match kept(Status::Success) && random.chance(60) || !kept(Status::Failure) {
        true => (Status::Success, Status::Failure),
        false => (Status::Failure, Status::Success),
    };
    let fails = random.chance(30);
    let mut choices: BTreeMap<Minterm, Id<Behavior>> = BTreeMap::new();
    let mut starts: BTreeMap<Minterm, u64> = BTreeMap::new();
    let mut counts: BTreeMap<(Minterm, Id<Behavior>, Status, Option<Minterm>), u64> =
        BTreeMap::new();
    for _ in 0..12 {
        let mut values: Vec<bool> = (0..predicates).map(|_| random.chance(50)).collect();
        let mut window: Vec<Atom> = Vec::new();
        let mut memory = Memory::new();
        let minterm = |values: &[bool], window: &[Atom]| {
            Minterm::new(atoms.iter().enumerate().map(|(i, atom)| match atom {
                Atom::Predicate(_) => values[i],
                shown => window.contains(shown),
            }))
        };
        let mut here = minterm(&values, &window);
        for step in 0..20 {
            let status = match random.below(10) {
                0..5 => by,
                5 if fails => other,
                _ => Status::Running,
            };
            let mut first = Some(status);
            let mut leaf = |_| first.take().unwrap_or(Status::Running);
            let ticked = tick(root, &memory, &holds(&atoms, &here), &mut leaf);
            let Some(does) = ticked.ticked.first().copied() else {
                break;
            };
            if *choices.entry(here.clone()).or_insert(does) != does {
                break;
            }
            if step == 0 {
                *starts.entry(here.clone()).or_default() += 1;
            }
            memory = ticked.memory;
            if kept(status) {
                window.push(match status {
                    Status::Failure => Atom::Failed(does),
                    _ => Atom::Done(does),
                });
                let over = window.len().saturating_sub(history.window);
                window.drain(..over);
            }
            // A chain that has begun is mostly seen to its end.
            if random.chance(if memory.is_empty() { 50 } else { 5 }) && predicates > 0 {
                let changes = random.below(predicates);
                values[changes] ^= true;
            }
            let next = minterm(&values, &window);
            let key = (here, does, status, Some(next.clone()));
            *counts.entry(key).or_default() += 1;
            here = next;
        }
    }
    let transition = |((from, behavior, status, to), count)| Transition {
        from,
        behavior,
        status,
        to,
        count,
    };
    let row = |(minterm, behavior)| Row {
        minterm,
        free: None,
        behavior,
        visits: 1,
        values: vec![None; behaviors.len()],
    };
    Policy {
        fields: Vec::new(),
        rows: choices.into_iter().map(row).collect(),
        starts: starts.into_iter().collect(),
        transitions: counts.into_iter().map(transition).collect(),
        atoms,
        behaviors: behaviors.clone(),
        history,
    }
}
