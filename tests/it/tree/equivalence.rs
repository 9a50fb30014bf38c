//! Equivalence of trees, beside plain enumeration with the naive interpreter.

use crate::laws::build::{leaf, memory_sequence, p, selector, when};
use crate::laws::grown::Soil;
use crate::laws::lockstep::{Lockstep, Window, asked};
use crate::laws::naive::Memory;
use crate::laws::proof::agrees;
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Guard, Node, Status};
use btc::policy::{Minterm, Policy, Row};
use btc::tree::equivalence::{Environment, Means, Onward, Side, Verdict, compare};

fn any(left: &Node, right: &Node, history: History) -> Verdict {
    let environment = Environment::Any(history);
    compare(Side::Tree(left), Side::Tree(right), environment).unwrap()
}

fn history(random: &mut Random) -> History {
    History {
        window: random.below(3),
        success: random.chance(80),
        failure: random.chance(60),
    }
}

#[test]
fn without_memory_the_least_valuation_is_found_that_enumeration_finds() {
    let (mut equal, mut onward, mut different) = (0, 0, 0);
    for seed in 1..=400 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 1 + random.below(5),
            behaviors: 3,
            history: random.chance(60),
            memory: false,
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.chance(50) {
            true => soil.tree(random, 3),
            false => selector(vec![left.clone(), leaf(0)]),
        };
        let history = history(random);
        match agrees(&left, &right, history).unwrap() {
            (Verdict::Equal(explored), goes_on) => {
                assert!(matches!(explored.means, Means::Table { .. }));
                equal += 1;
                onward += usize::from(goes_on != Onward::Alike);
            }
            _ => different += 1,
        }
    }
    assert!(
        equal > 50 && onward > 5 && different > 150,
        "{equal} {onward} {different}"
    );
}

#[test]
fn with_memory_the_shortest_trace_is_found_that_enumeration_finds() {
    let (mut equal, mut onward, mut different, mut longest) = (0, 0, 0, 0);
    for seed in 1..=250 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 1 + random.below(2),
            behaviors: 2 + random.below(2),
            history: random.chance(40),
            memory: true,
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.below(3) {
            0 => soil.tree(random, 3),
            1 => left.clone(),
            _ => forgetful(&left, &mut random.below(4)),
        };
        let history = history(random);
        match agrees(&left, &right, history) {
            Some((Verdict::Differ(trace), _)) => {
                different += 1;
                longest = longest.max(trace.steps.len());
            }
            Some((_, goes_on)) => {
                equal += 1;
                onward += usize::from(goes_on != Onward::Alike);
            }
            None => {}
        }
    }
    assert!(
        equal > 50 && onward > 0 && different > 60 && longest >= 3,
        "{equal} {onward} {different} {longest}"
    );
}

/// The tree with one of its memory nodes made reactive, or one that was not with memory.
fn forgetful(node: &Node, left: &mut usize) -> Node {
    match node {
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let hit = *left == 0;
            *left = left.wrapping_sub(1);
            Node::Composite {
                kind: *kind,
                memory: *memory != hit,
                children: children.iter().map(|c| forgetful(c, left)).collect(),
            }
        }
        Node::Decorator { kind, child } => Node::Decorator {
            kind: *kind,
            child: Box::new(forgetful(child, left)),
        },
        other => other.clone(),
    }
}

#[test]
fn a_row_that_leaves_all_free_is_any_environment() {
    let (mut equal, mut different) = (0, 0);
    for seed in 1..=200 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 3,
            behaviors: 3,
            history: random.chance(50),
            memory: random.chance(60),
            wild: true,
        };
        let left = soil.tree(random, 3);
        let right = match random.chance(50) {
            true => soil.tree(random, 3),
            false => forgetful(&left, &mut random.below(4)),
        };
        let history = history(random);
        let atoms = asked(&left, &right);
        // What the window does not remember never holds.
        let free = |atom: &Atom| match atom {
            Atom::Predicate(_) => true,
            Atom::Done(_) => history.window > 0 && history.success,
            Atom::Failed(_) => history.window > 0 && history.failure,
        };
        let policy = Policy {
            rows: vec![Row {
                minterm: Minterm::new(atoms.iter().map(|_| false)),
                free: Some(Minterm::new(atoms.iter().map(free))),
                behavior: Id::new(0),
                visits: 0,
                values: vec![],
            }],
            atoms,
            history,
            ..Policy::default()
        };
        let environment = Environment::Observed(&policy);
        let observed = compare(Side::Tree(&left), Side::Tree(&right), environment).unwrap();
        match (any(&left, &right, history), observed) {
            (Verdict::Equal(_), Verdict::Equal(_)) => equal += 1,
            (Verdict::Differ(a), Verdict::Differ(b)) => {
                assert_eq!(a.steps.len(), b.steps.len(), "seed {seed}");
                different += 1;
            }
            found => panic!("seed {seed}: {found:?}\n{left:?}\n{right:?}"),
        }
    }
    assert!(equal > 30 && different > 50, "{equal} {different}");
}

#[test]
fn a_tree_is_equal_to_itself_even_where_it_drives_on_after_a_failure() {
    let root = selector(vec![
        when(p(0), leaf(0)),
        memory_sequence(vec![leaf(1), leaf(2)]),
    ]);
    let verdict = any(&root, &root, History::default());
    assert!(matches!(verdict, Verdict::Equal(_)), "{verdict:?}");
}

/// A decision list: rule i asks two of the predicates.
fn rules(count: usize, predicates: usize, seed: u64) -> Vec<Node> {
    let random = &mut Random::new(seed);
    (0..count)
        .map(|_| {
            let literal = |random: &mut Random| match random.chance(50) {
                true => p(random.below(predicates)),
                false => Guard::Not(Box::new(p(random.below(predicates)))),
            };
            let guard = Guard::And((0..3).map(|_| literal(random)).collect());
            when(guard, leaf(random.below(8)))
        })
        .collect()
}

#[test]
fn more_predicates_than_a_table_takes_are_asked_of_a_solver() {
    let list = rules(120, 64, 1);
    let left = selector(list.clone());
    // The same rules, grouped: a different tree with the same decisions.
    let groups = list.chunks(7).map(|rules| selector(rules.to_vec()));
    let right = selector(groups.collect());
    let none = History::default();
    match any(&left, &right, none) {
        Verdict::Equal(explored) => assert_eq!(explored.means, Means::Table { atoms: 0 }),
        other => panic!("{other:?}"),
    }
    // Guards that hold nowhere else than before, written otherwise.
    let doubled = list.iter().map(|rule| match rule {
        Node::Composite { children, .. } => selector(vec![
            crate::laws::build::sequence(vec![rule.clone()]),
            crate::laws::build::sequence(vec![
                crate::laws::build::condition(p(0)),
                crate::laws::build::sequence(children.clone()),
            ]),
        ]),
        _ => unreachable!("every rule is a sequence"),
    });
    let right = selector(doubled.collect());
    match any(&left, &right, none) {
        Verdict::Equal(explored) => assert_eq!(explored.means, Means::Solver { atoms: 64 }),
        other => panic!("{other:?}"),
    }
    let mut shuffled = list.clone();
    shuffled.swap(40, 90);
    let right = selector(shuffled);
    let Verdict::Differ(trace) = any(&left, &right, none) else {
        panic!("rules 40 and 90 overlap and differ");
    };
    let both = Lockstep {
        statuses: vec![(0..8).map(|b| (Id::new(b), Status::Running)).collect()],
        sides: [&left, &right],
        atoms: asked(&left, &right),
        history: none,
    };
    let fresh = (Memory::new(), Memory::new(), Window::new());
    let selected = both.ticks(&fresh, &trace.valuation).remove(0).selected;
    assert_eq!(selected, [trace.left, trace.right]);
    assert_ne!(trace.left, trace.right);
    // No true atom of it could be false.
    for bit in (0..64).filter(|bit| trace.valuation.get(*bit)) {
        let lower = Minterm::new((0..64).map(|i| i != bit && trace.valuation.get(i)));
        let selected = both.ticks(&fresh, &lower).remove(0).selected;
        assert_eq!(selected[0], selected[1], "bit {bit}");
    }
}
