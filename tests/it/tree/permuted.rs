//! Theorem 2: a canonical tree in any order of its behaviours.

use crate::laws::build::{leaf, not, p, selector, when};
use crate::laws::grown::Soil;
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Guard, Node};
use btc::tree::canonicalise::{Canonical, CanonicalUnit, canonicalise};
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::permute::{Unordered, permute};
use btc::tree::reading::Reading;

fn unit(guard: Guard, behavior: usize) -> CanonicalUnit {
    CanonicalUnit {
        guard,
        behavior: Id::new(behavior),
    }
}

fn ids(order: &[usize]) -> Vec<Id<Behavior>> {
    order.iter().copied().map(Id::new).collect()
}

fn shuffled(canonical: &Canonical, random: &mut Random) -> Vec<Id<Behavior>> {
    let mut order: Vec<Id<Behavior>> = canonical.units.iter().map(|unit| unit.behavior).collect();
    for i in (1..order.len()).rev() {
        order.swap(i, random.below(i + 1));
    }
    order
}

fn equal(left: &Node, right: &Node) -> bool {
    let history = History {
        window: 1,
        success: true,
        failure: true,
    };
    let environment = Environment::Any(history);
    let verdict = compare(Side::Tree(left), Side::Tree(right), environment).unwrap();
    matches!(verdict, Verdict::Equal(_))
}

#[test]
fn a_unit_that_is_shifted_gets_the_negation_of_the_guard_that_shifts_it() {
    // Equation 5 with two behaviours: the second stood to the left of the first.
    let canonical = Canonical {
        units: vec![unit(p(1), 1), unit(p(0), 0)],
    };
    let permuted = permute(&canonical, &ids(&[0, 1])).unwrap();
    let shifted = Guard::And(vec![not(p(1)), p(0)]);
    assert_eq!(permuted.units, [unit(shifted, 0), unit(p(1), 1)]);
    // Behind the other unit, it does not ask for what that one has taken.
    let back = permute(&permuted, &ids(&[1, 0])).unwrap();
    assert_eq!(back, canonical);
}

#[test]
fn the_last_unit_takes_what_is_left() {
    let root = selector(vec![when(p(0), leaf(0)), when(p(1), leaf(1)), leaf(2)]);
    let canonical = canonicalise(&root, Reading::Furthest).unwrap();
    let permuted = permute(&canonical, &ids(&[0, 1, 2])).unwrap();
    assert_eq!(permuted.tree(), root);
    let permuted = permute(&canonical, &ids(&[2, 1, 0])).unwrap();
    let neither = Guard::And(vec![not(p(0)), not(p(1))]);
    let expected = [
        unit(neither, 2),
        unit(not(p(0)), 1),
        unit(Guard::Const(true), 0),
    ];
    assert_eq!(permuted.units, expected);
}

#[test]
fn every_order_of_a_random_tree_selects_as_the_tree() {
    let mut orders = 0;
    for seed in 1..=300 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 5,
            behaviors: 5,
            history: random.chance(40),
            memory: false,
            wild: false,
        };
        let root = soil.guarded(random, 2);
        // A guard that always holds may leave a behaviour before the last child.
        let Ok(canonical) = canonicalise(&root, Reading::Furthest) else {
            continue;
        };
        let order = shuffled(&canonical, random);
        let permuted = permute(&canonical, &order).unwrap();
        let found: Vec<Id<Behavior>> = permuted.units.iter().map(|unit| unit.behavior).collect();
        assert_eq!(found, order);
        assert!(equal(&root, &permuted.tree()), "seed {seed}: {root:?}");
        orders += usize::from(order.len() > 2);
    }
    assert!(orders > 100, "{orders}");
}

#[test]
fn guards_that_overlap_may_stand_in_any_order_too() {
    for seed in 1..=200 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 8,
            behaviors: 6,
            history: true,
            memory: false,
            wild: false,
        };
        let units = (0..6).map(|b| unit(soil.guard(random, 3), b)).collect();
        let list = Canonical { units };
        let permuted = permute(&list, &shuffled(&list, random)).unwrap();
        assert!(equal(&list.tree(), &permuted.tree()), "seed {seed}");
    }
}

#[test]
fn an_order_of_other_behaviours_is_an_error() {
    let canonical = Canonical {
        units: vec![unit(p(0), 0), unit(p(1), 1)],
    };
    let mismatch = |order: &[usize], behavior| {
        let found = permute(&canonical, &ids(order));
        assert_eq!(found, Err(Unordered::Mismatch(Id::new(behavior))));
    };
    mismatch(&[0], 1);
    mismatch(&[0, 1, 2], 2);
    mismatch(&[0, 0], 0);
}
