//! Chains with memory come out again from what a tree with them was seen to do.

use super::walk::parts_after;
use crate::laws::naive::holds;
use crate::laws::naive::{Memory, tick};
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Composite, Guard, Node, Status};
use btc::policy::{Minterm, Policy, Row, Transition};
use btc::tree::Size;
use btc::tree::decanonicalise::{Options, decanonicalise};
use btc::tree::reading::Reading;
use std::collections::BTreeMap;

/// `selector { p => memory … { 0, 1, … }, n }` with `links` behaviours in the memory node.
fn planted(kind: Composite, links: usize) -> Node {
    let leaf = |b: usize| Node::Behavior(Id::new(b));
    let node = |kind, memory, children| Node::Composite {
        kind,
        memory,
        children,
    };
    let chain = node(kind, true, (0..links).map(leaf).collect());
    let p = Node::Condition(Guard::Atom(Atom::Predicate(Id::new(0))));
    let unit = node(Composite::Sequence, false, vec![p, chain]);
    node(Composite::Selector, false, vec![unit, leaf(links)])
}

/// What the planted tree does in a world whose first predicate changes only between chains, the second at any time.
fn walked(kind: Composite, links: usize, window: usize, seed: u64) -> Policy {
    let random = &mut Random::new(seed);
    let tree = planted(kind, links);
    let history = History {
        window,
        success: kind == Composite::Sequence,
        failure: kind == Composite::Selector,
    };
    // The termination by which a chain goes on.
    let by = match kind {
        Composite::Sequence => Status::Success,
        Composite::Selector => Status::Failure,
    };
    let behaviors: Vec<Id<_>> = (0..=links).map(Id::new).collect();
    let remembered = |b: &Id<_>| match kind {
        Composite::Sequence => Atom::Done(*b),
        Composite::Selector => Atom::Failed(*b),
    };
    let predicates = (0..2).map(|p| Atom::Predicate(Id::new(p)));
    let atoms: Vec<Atom> = predicates.chain(behaviors.iter().map(remembered)).collect();
    let mut choices: BTreeMap<Minterm, usize> = BTreeMap::new();
    let mut starts: BTreeMap<Minterm, u64> = BTreeMap::new();
    let mut counts: BTreeMap<(Minterm, usize, Status, Option<Minterm>), u64> = BTreeMap::new();
    for _ in 0..40 {
        let mut values = [random.chance(50), random.chance(50)];
        let mut past: Vec<usize> = Vec::new();
        let mut memory = Memory::new();
        let minterm = |values: &[bool; 2], past: &[usize]| {
            let held = (0..=links).map(|b| past.contains(&b));
            Minterm::new(values.iter().copied().chain(held))
        };
        let mut here = minterm(&values, &past);
        *starts.entry(here.clone()).or_default() += 1;
        for _ in 0..60 {
            let status = match random.chance(60) {
                true => by,
                false => Status::Running,
            };
            let mut first = Some(status);
            let mut leaf = |_| first.take().unwrap_or(Status::Running);
            let ticked = tick(&tree, &memory, &holds(&atoms, &here), &mut leaf);
            let does = ticked.ticked[0].index();
            if *choices.entry(here.clone()).or_insert(does) != does {
                break;
            }
            let running = status == Status::Running;
            if !running {
                past.push(does);
                let over = past.len().saturating_sub(window);
                past.drain(..over);
            }
            memory = ticked.memory;
            let between = !values[0] || !running && does + 1 == links;
            values[1] = random.chance(50);
            if between {
                values[0] = random.chance(50);
            }
            let next = minterm(&values, &past);
            let key = (here, does, status, Some(next.clone()));
            *counts.entry(key).or_default() += 1;
            here = next;
        }
        // Where the walk ends is decided as well.
        let mut leaf = |_| Status::Running;
        let ticked = tick(&tree, &memory, &holds(&atoms, &here), &mut leaf);
        choices.entry(here).or_insert(ticked.ticked[0].index());
    }
    Policy {
        fields: Vec::new(),
        rows: choices
            .into_iter()
            .map(|(minterm, does)| Row {
                minterm,
                free: None,
                behavior: Id::new(does),
                visits: 1,
                values: vec![None; links + 1],
            })
            .collect(),
        starts: starts.into_iter().collect(),
        transitions: counts
            .into_iter()
            .map(|((from, does, status, to), count)| Transition {
                from,
                behavior: Id::new(does),
                status,
                to,
                count,
            })
            .collect(),
        atoms,
        behaviors,
        history,
    }
}

/// Whether a tree has the planted memory node.
fn has(tree: &Node, chain: &Node) -> bool {
    tree == chain || tree.children().iter().any(|child| has(child, chain))
}

fn comes_out(kind: Composite, links: usize, window: usize) {
    let planted = planted(kind, links);
    let chain = &planted.children()[0].children()[1];
    for seed in 1..=5 {
        let policy = walked(kind, links, window, seed);
        let found = decanonicalise(&policy, &Options::default()).unwrap();
        let what = format!("{links} links, window {window}, seed {seed}: {found:?}");
        assert_eq!(parts_after(&found.root, &policy), None, "{what}");
        assert!(has(&found.root, chain), "{what}");
        assert!(found.size <= Size::of(&planted), "{what}");
        assert!(found.proof.recorded && found.proof.explored.states > 0);
        // After a chain, a longer window still holds how it ended, and the next has begun.
        let expected = match window {
            1 => Reading::Furthest,
            _ => Reading::Unfinished,
        };
        assert_eq!(found.proof.reading, expected, "{what}");
    }
}

#[test]
fn sequences_of_three_and_four_come_out_under_a_window_of_one() {
    comes_out(Composite::Sequence, 3, 1);
    comes_out(Composite::Sequence, 4, 1);
}

#[test]
fn sequences_of_three_and_four_come_out_under_longer_windows() {
    comes_out(Composite::Sequence, 3, 2);
    comes_out(Composite::Sequence, 4, 2);
    comes_out(Composite::Sequence, 4, 3);
}

#[test]
fn selectors_come_out_where_the_window_holds_failures() {
    for links in 2..=4 {
        comes_out(Composite::Selector, links, 1);
    }
    comes_out(Composite::Selector, 3, 2);
}
