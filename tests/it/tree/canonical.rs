//! The canonical forms of the paper's section IV, and what has none.

use super::random::policy;
use super::walk::read;
use crate::laws::build::{
    asked, condition, decorated, done, failed, leaf, memory_selector, memory_sequence, not, p,
    parallel, selector, sequence, when,
};
use crate::laws::grown::Soil;
use crate::laws::naive::holds;
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Composite, Decorator, Guard, Node};
use btc::tree::canonicalise::canonicalise;
use btc::tree::decanonicalise::{Care, Method, decanonicalise};
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::reading::{Reading, Reason};

/// The units of a tree have guards that are equal to these under every valuation, and no longer.
fn check(root: &Node, units: &[(Guard, usize)]) {
    let canonical = canonicalise(root, Reading::Furthest).unwrap();
    let found: Vec<usize> = canonical.units.iter().map(|u| u.behavior.index()).collect();
    let expected: Vec<usize> = units.iter().map(|(_, b)| *b).collect();
    assert_eq!(found, expected);
    for (unit, (guard, _)) in canonical.units.iter().zip(units) {
        assert!(literals(&unit.guard) <= literals(guard), "{unit:?}");
        for bits in 0..1_u32 << 12 {
            let mut holds = |atom: Atom| {
                let bit = match atom {
                    Atom::Predicate(id) => id.index(),
                    Atom::Done(id) => 4 + id.index(),
                    Atom::Failed(id) => 8 + id.index(),
                };
                bits >> bit & 1 == 1
            };
            assert_eq!(
                unit.guard.eval(&mut holds),
                guard.eval(&mut holds),
                "{:?} is not {guard:?} in {bits:b}",
                unit.guard
            );
        }
    }
}

fn and(guards: Vec<Guard>) -> Guard {
    Guard::And(guards)
}

fn literals(guard: &Guard) -> usize {
    let mut count = 0;
    guard.visit_atoms(&mut |_| count += 1);
    count
}

#[test]
fn figure_3_conditions_at_several_levels() {
    let root = sequence(vec![
        condition(p(0)),
        selector(vec![
            condition(p(1)),
            sequence(vec![condition(p(2)), condition(p(3))]),
        ]),
        leaf(0),
    ]);
    let guard = and(vec![p(0), Guard::Or(vec![p(1), and(vec![p(2), p(3)])])]);
    check(&root, &[(guard.clone(), 0)]);
    // It reads as in the figure.
    let canonical = canonicalise(&root, Reading::Furthest).unwrap();
    assert_eq!(canonical.tree(), when(guard, leaf(0)));
}

#[test]
fn figure_4_a_memory_sequence() {
    let root = when(p(0), memory_sequence(vec![leaf(0), leaf(1)]));
    check(
        &root,
        &[
            (and(vec![p(0), not(done(0))]), 0),
            (and(vec![p(0), done(0)]), 1),
        ],
    );
}

#[test]
fn a_memory_selector_goes_by_failures() {
    let root = when(p(0), memory_selector(vec![leaf(0), leaf(1), leaf(2)]));
    check(
        &root,
        &[
            (and(vec![p(0), not(failed(0)), not(failed(1))]), 0),
            (and(vec![p(0), failed(0), not(failed(1))]), 1),
            (and(vec![p(0), failed(1)]), 2),
        ],
    );
}

#[test]
fn figure_5_nested_memory_nodes() {
    let root = when(
        p(0),
        memory_sequence(vec![memory_selector(vec![leaf(0), leaf(1)]), leaf(2)]),
    );
    let past = Guard::Or(vec![done(0), done(1)]);
    check(
        &root,
        &[
            (and(vec![p(0), not(past.clone()), not(failed(0))]), 0),
            (and(vec![p(0), not(past.clone()), failed(0)]), 1),
            (and(vec![p(0), past]), 2),
        ],
    );
}

#[test]
fn occurrences_of_one_behaviour_become_one_unit() {
    let root = selector(vec![when(p(0), leaf(0)), when(p(1), leaf(1)), leaf(0)]);
    check(
        &root,
        &[
            (Guard::Or(vec![p(0), not(p(1))]), 0),
            (and(vec![not(p(0)), p(1)]), 1),
        ],
    );
}

#[test]
fn decorators_without_counts_exchange_answers() {
    let unless = decorated(Decorator::Invert, condition(p(0)));
    let root = sequence(vec![
        unless,
        decorated(Decorator::Succeed, when(p(1), leaf(0))),
    ]);
    check(&root, &[(and(vec![not(p(0)), p(1)]), 0)]);
}

#[test]
fn what_depends_on_more_than_predicates_is_an_error_with_a_place() {
    let cases: Vec<(Node, Vec<usize>, Reason)> = vec![
        (
            selector(vec![when(p(0), leaf(0)), leaf(1), leaf(2)]),
            vec![1],
            Reason::Status(Composite::Selector),
        ),
        (
            when(p(0), sequence(vec![leaf(0), leaf(1)])),
            vec![1, 0],
            Reason::Status(Composite::Sequence),
        ),
        (
            selector(vec![parallel(1, vec![leaf(0)]), leaf(1)]),
            vec![0],
            Reason::Parallel,
        ),
        (
            when(p(0), decorated(Decorator::Retry(3), leaf(0))),
            vec![1],
            Reason::Counting(Decorator::Retry(3)),
        ),
        (
            memory_sequence(vec![condition(p(0)), leaf(0)]),
            vec![0],
            Reason::Passed(Composite::Sequence),
        ),
        (
            memory_selector(vec![leaf(0), when(p(0), leaf(1)), leaf(2)]),
            vec![1],
            Reason::Passed(Composite::Selector),
        ),
        (
            memory_sequence(vec![leaf(0), leaf(1), leaf(0)]),
            vec![2],
            Reason::Twice(Id::new(0)),
        ),
        (
            // Which of the two has failed, and whether the other was ticked after it, the history does not show.
            memory_selector(vec![
                selector(vec![when(p(0), leaf(0)), when(not(p(0)), leaf(1))]),
                leaf(2),
            ]),
            vec![0],
            Reason::Failure,
        ),
        (
            when(p(0), decorated(Decorator::Repeat(2), leaf(0))),
            vec![1],
            Reason::Counting(Decorator::Repeat(2)),
        ),
        (
            when(p(0), decorated(Decorator::Timeout(2), leaf(0))),
            vec![1],
            Reason::Counting(Decorator::Timeout(2)),
        ),
        (entangled(60), vec![], Reason::Large(Id::new(13))),
    ];
    for (root, path, reason) in cases {
        let found = canonicalise(&root, Reading::Furthest).unwrap_err();
        assert_eq!((&found.path, found.reason), (&path, reason));
        assert!(!found.message().is_empty());
    }
}

/// A nesting in which each level needs both answers of the one below: written out, guards grow as Fibonacci's numbers.
fn entangled(levels: usize) -> Node {
    let mut node = selector(vec![when(p(0), leaf(0)), condition(p(1))]);
    for level in 1..levels {
        let below = sequence(vec![node, condition(p(2 * level))]);
        let beside = when(p(2 * level + 1), leaf(level));
        node = decorated(Decorator::Invert, selector(vec![below, beside]));
    }
    node
}

#[test]
fn a_deep_tree_has_short_guards() {
    let mut node = leaf(0);
    for level in 0..100 {
        node = match level % 2 {
            0 => sequence(vec![condition(p(level % 7)), node]),
            _ => selector(vec![when(p(level % 5), leaf(1)), node]),
        };
    }
    let canonical = canonicalise(&node, Reading::Furthest).unwrap();
    let lengths = canonical.units.iter().map(|unit| literals(&unit.guard));
    assert!(lengths.max() <= Some(14), "{canonical:?}");
}

#[test]
fn canonical_forms_of_random_trees_select_as_the_trees_read() {
    let mut units = 0;
    for seed in 1..=300 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 3,
            behaviors: 4,
            history: random.chance(30),
            memory: true,
            wild: false,
        };
        let root = match random.chance(70) {
            true => soil.guarded(random, 2),
            false => soil.tree(random, 3),
        };
        let by = match seed % 2 {
            0 => Reading::Furthest,
            _ => Reading::Unfinished,
        };
        let Ok(canonical) = canonicalise(&root, by) else {
            continue;
        };
        units += canonical.units.len();
        for bits in 0..1_u32 << 11 {
            let holds = |atom: Atom| {
                let bit = match atom {
                    Atom::Predicate(id) => id.index(),
                    Atom::Done(id) => 3 + id.index(),
                    Atom::Failed(id) => 7 + id.index(),
                };
                bits >> bit & 1 == 1
            };
            let reads = read(&root, by, &holds).ok();
            let selects: Vec<Id<Behavior>> = canonical
                .units
                .iter()
                .filter(|unit| unit.guard.eval(&mut |atom| holds(atom)))
                .map(|unit| unit.behavior)
                .collect();
            // One unit a behaviour, and no two guards at a time.
            assert_eq!(selects, Vec::from_iter(reads), "seed {seed}: {root:?}");
        }
    }
    assert!(units > 500, "{units}");
}

#[test]
fn canonical_forms_of_trees_without_memory_are_equal_whatever_happens() {
    let mut compared = 0;
    for seed in 1..=200 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 6,
            behaviors: 5,
            history: true,
            memory: false,
            wild: false,
        };
        let root = soil.guarded(random, 2);
        // A guard that always holds may leave a behaviour before the last child.
        if canonicalise(&root, Reading::Furthest).is_err() {
            continue;
        }
        compared += 1;
        let history = History {
            window: 1 + random.below(2),
            success: true,
            failure: true,
        };
        let verdict = with_canonical(&root, history);
        assert!(
            matches!(verdict, Verdict::Equal(_)),
            "{verdict:?}: {root:?}"
        );
    }
    assert!(compared > 120, "{compared}");
}

#[test]
fn decanonicalised_and_canonicalised_again_a_policy_is_what_it_was() {
    for seed in 1..=150 {
        let policy = policy(seed);
        for method in [Method::Paper, Method::Search] {
            let found = decanonicalise(&policy, &asked(method, Care::Seen)).unwrap();
            let canonical = canonicalise(&found.root, Reading::Furthest).unwrap();
            for row in &policy.rows {
                let here = holds(&policy.atoms, &row.minterm);
                let selects = canonical.select(&mut |atom| here(atom));
                assert_eq!(selects, Some(row.behavior), "seed {seed}, {method:?}: P1");
            }
            let compared = compare(
                Side::Tree(&canonical.tree()),
                Side::Policy(&policy),
                Environment::Greedy(&policy),
            );
            let equal = matches!(compared, Ok(Verdict::Equal(_)));
            assert!(equal, "seed {seed}, {method:?}: P2 {compared:?}");
        }
    }
}

/// Compares a tree with its canonical form where anything may happen.
fn with_canonical(root: &Node, history: History) -> Verdict {
    let canonical = canonicalise(root, Reading::Furthest).unwrap().tree();
    let environment = Environment::Any(history);
    compare(Side::Tree(root), Side::Tree(&canonical), environment).unwrap()
}

#[test]
fn without_memory_the_canonical_form_is_equal_whatever_happens() {
    let root = selector(vec![
        when(
            p(0),
            selector(vec![when(p(1), leaf(0)), when(not(p(2)), leaf(1))]),
        ),
        when(done(0), leaf(2)),
        leaf(0),
    ]);
    let verdict = with_canonical(
        &root,
        History {
            window: 2,
            success: true,
            failure: false,
        },
    );
    assert!(matches!(verdict, Verdict::Equal(_)), "{verdict:?}");
}

#[test]
fn with_memory_it_parts_where_the_history_outlasts_the_memory() {
    let root = selector(vec![
        when(p(0), memory_sequence(vec![leaf(0), leaf(1)])),
        leaf(2),
    ]);
    let verdict = with_canonical(
        &root,
        History {
            window: 1,
            success: true,
            failure: false,
        },
    );
    let Verdict::Differ(trace) = verdict else {
        panic!("{verdict:?}");
    };
    assert_eq!(
        trace.steps.len(),
        0,
        "a window may already hold the success"
    );
    assert_eq!(
        (trace.left, trace.right),
        (Some(Id::new(0)), Some(Id::new(1)))
    );
}

#[test]
fn many_predicates_are_only_asked_where_they_matter() {
    let rules = |order: &dyn Fn(usize) -> usize| {
        let rule = |i| when(p(order(i)), leaf(order(i) % 5));
        selector((0..200).map(rule).chain([leaf(9)]).collect())
    };
    let history = History::default();
    let (left, right) = (rules(&|i| i), rules(&|i| i));
    let verdict = compare(
        Side::Tree(&left),
        Side::Tree(&right),
        Environment::Any(history),
    );
    assert!(matches!(verdict, Ok(Verdict::Equal(_))));
    let swapped = rules(&|i| {
        if i == 7 {
            8
        } else if i == 8 {
            7
        } else {
            i
        }
    });
    let verdict = compare(
        Side::Tree(&left),
        Side::Tree(&swapped),
        Environment::Any(history),
    );
    let Ok(Verdict::Differ(trace)) = verdict else {
        panic!("{verdict:?}");
    };
    assert_eq!(trace.valuation.values().filter(|v| *v).count(), 2);
}
