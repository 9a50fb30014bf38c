//! Tables that are small once some atoms are asked last: comparisons of two numbers with a further condition, parities, and parts of a
//! table that are so.

use super::scale::{searched, table};
use btc::logic::Order;
use btc::policy::{Minterm, Policy};
use btc::tree::decanonicalise::Options;
use btc::tree::prove::prove;

/// What an elevator does: its door is a further condition.
const OPENS: usize = 0;
const WAITS: usize = 1;
const CLOSES: usize = 2;
const UP: usize = 3;
const DOWN: usize = 4;

fn elevator(floor: usize, target: usize, open: bool) -> usize {
    match (floor.cmp(&target), open) {
        (std::cmp::Ordering::Equal, false) => OPENS,
        (std::cmp::Ordering::Equal, true) => WAITS,
        (_, true) => CLOSES,
        (std::cmp::Ordering::Less, false) => UP,
        (std::cmp::Ordering::Greater, false) => DOWN,
    }
}

/// The table of two numbers below `floors` and of further conditions; the atoms compare each number with the values that it may have.
fn compared(
    floors: usize,
    conditions: usize,
    decides: impl Fn(usize, usize, &[bool]) -> usize,
) -> Policy {
    let mut rows = Vec::new();
    for row in 0..(floors * floors) << conditions {
        let further: Vec<bool> = (0..conditions).map(|bit| row >> bit & 1 == 1).collect();
        let number = row >> conditions;
        let (floor, target) = (number / floors, number % floors);
        let cuts = |value: usize| (0..floors - 1).map(move |cut| value <= cut);
        let values = cuts(floor).chain(cuts(target)).chain(further.clone());
        rows.push((Minterm::new(values), decides(floor, target, &further)));
    }
    table(2 * (floors - 1) + conditions, 8, rows.into_iter())
}

fn nodes(policy: &Policy) -> usize {
    let found = searched(policy, Order::Learned, Options::default().effort);
    prove(&found.root, policy).unwrap();
    found.size.nodes
}

#[test]
fn a_door_is_asked_behind_the_comparison_of_two_floors() {
    // Without such trees 48 and 104.
    for (floors, most) in [(5, 39), (10, 69)] {
        let policy = compared(floors, 1, |floor, target, further| {
            elevator(floor, target, further[0])
        });
        let nodes = nodes(&policy);
        assert!(nodes <= most, "{floors} floors: {nodes} nodes");
    }
}

/// In one part of the table the door is a further condition, in the other it is not.
#[test]
fn a_part_of_a_table_is_a_table() {
    let policy = compared(6, 2, |floor, target, further| match further {
        [open, true] => elevator(floor, target, *open),
        [open, _] => match (floor + usize::from(*open), target > 2) {
            (4.., _) if *open => 5,
            (4.., _) => 6,
            (_, true) => 7,
            (_, false) => WAITS,
        },
        _ => unreachable!(),
    });
    let nodes = nodes(&policy);
    assert!(nodes <= 59, "{nodes} nodes");
}

/// A parity of six is that of four where that of two is even.
#[test]
fn a_parity_is_divided() {
    let rows = (0..64_usize).map(|row| {
        let minterm = Minterm::new((0..6).map(|bit| row >> bit & 1 == 1));
        (minterm, row.count_ones() as usize % 2)
    });
    let nodes = nodes(&table(6, 2, rows));
    assert!(nodes <= 51, "{nodes} nodes");
}
