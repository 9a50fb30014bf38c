//! Trees of more atoms than a truth table takes, equal and nearly equal. Under test the solver has each of its answers that nothing
//! can hold checked by unit propagation (`tree::circuit::rup`).

use super::{Means, SymbolicSearch};
use crate::ir::Id;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::tree::guard::{and, not, or};
use crate::tree::unit::{guarded, selector};

const ATOMS: usize = 60;

/// Numbers below a bound, the same for each seed.
fn drawn(seed: u64) -> impl FnMut(usize) -> usize {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    move |bound| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as usize % bound
    }
}

fn literal(below: &mut impl FnMut(usize) -> usize) -> Guard {
    let atom = Guard::Atom(Atom::Predicate(Id::new(below(ATOMS))));
    match below(2) {
        0 => atom,
        _ => not(atom),
    }
}

/// A list of rules, and a tree that asks other questions: the guards divided by another atom, and each rule at the end of a selector
/// whose first child does what follows it. In the second the rule `changed` has another body.
fn pair(seed: u64, memory: bool, changed: Option<usize>) -> [Node; 2] {
    let below = &mut drawn(seed);
    let mut rules = Vec::new();
    for _ in 0..10 {
        let guard = or([0, 1].map(|_| and([0, 1].map(|_| literal(below)))));
        let bodies = [0, 1].map(|_| Node::Behavior(Id::new(below(3))));
        let body = match memory && below(2) == 0 {
            true => Node::Composite {
                kind: Composite::Sequence,
                memory: true,
                children: bodies.into(),
            },
            false => bodies[0].clone(),
        };
        rules.push((guard, body));
    }
    let last = Node::Behavior(Id::new(3));
    let units = rules
        .iter()
        .map(|(guard, body)| guarded(guard.clone(), body.clone()));
    let left = selector(units.chain([last.clone()]));
    let mut right = last;
    for (at, (guard, body)) in rules.into_iter().enumerate().rev() {
        let by = literal(below);
        let divided = or([
            and([by.clone(), guard.clone()]),
            and([not(by), guard.clone()]),
        ]);
        let body = match changed {
            Some(changed) if changed == at => Node::Behavior(Id::new(4)),
            _ => body,
        };
        // Of memory nodes both trees tick the same one.
        right = match memory {
            true => selector([guarded(divided, body), right]),
            false => selector([guarded(not(divided), right), body]),
        };
    }
    [left, right]
}

/// Whether the two are equal, how that was found, and how many learned clauses were checked on the way.
fn compared(trees: &[Node; 2]) -> (bool, Means, usize) {
    let [left, right] = trees;
    let mut search = SymbolicSearch::new((left, right), (History::default(), &[])).unwrap();
    let equal = search.run().unwrap().is_none();
    (equal, search.explored.means, search.solver.checked())
}

#[test]
fn equal_trees_of_many_atoms_are_proved_equal_twice() {
    let mut checked = 0;
    for seed in 1..=12 {
        let (equal, means, clauses) = compared(&pair(seed, false, None));
        assert!(equal, "{seed}");
        assert!(matches!(means, Means::Solver { .. }), "{seed}: {means:?}");
        checked += clauses;
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn trees_with_memory_are_proved_equal_twice() {
    let mut checked = 0;
    for seed in 1..=4 {
        let (equal, means, clauses) = compared(&pair(seed, true, None));
        assert!(equal, "{seed}");
        assert_eq!(means, Means::Paths, "{seed}");
        checked += clauses;
    }
    assert!(checked > 100, "{checked}");
}

#[test]
fn a_change_of_one_rule_is_found_among_many_atoms() {
    for seed in 1..=12 {
        let (equal, ..) = compared(&pair(seed, false, Some(seed as usize % 10)));
        assert!(!equal, "{seed}");
    }
}
