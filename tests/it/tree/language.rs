//! The smallest trees of the whole language without memory: sequences and selectors of predicates, negated or not, and behaviours, in
//! any order.
//!
//! In such a tree a behaviour may stand before others in a sequence. Where it succeeds, the next is ticked in the same tick,
//! though the policy has not been asked in between. So these trees are only counted here, not looked for.

use super::optimum::{closed, policies};

const NEVER: u8 = 100;
/// Two bits for each minterm say what a node does there: 1 succeeds, 2 fails, 3 decides as the policy; 0 is not reached.
const STATES: usize = 1 << 16;
const LOW: usize = 0x5555;

/// What a node does with success and failure exchanged: what a selector does with its children, a sequence does with these.
fn exchanged(state: usize) -> usize {
    (state & LOW) << 1 | state >> 1 & LOW
}

/// 1 for what a predicate or a behaviour does.
fn leaves(policy: &[Option<usize>; 8]) -> Vec<u8> {
    let leaf = |state: usize| {
        let reached = (0..8)
            .map(|m| (m, state >> (2 * m) & 3))
            .filter(|(_, does)| *does > 0);
        let reached: Vec<(usize, usize)> = reached.collect();
        let asks = |atom: usize, value: usize| {
            reached
                .iter()
                .all(|(m, does)| *does == 2 - usize::from(m >> atom & 1 == value))
        };
        let behaves = reached
            .iter()
            .all(|(m, does)| *does == 3 && policy[*m] == policy[reached[0].0]);
        let asks = (0..3).any(|atom| asks(atom, 0) || asks(atom, 1));
        if behaves || asks { 1 } else { NEVER }
    };
    (0..STATES).map(leaf).collect()
}

/// The nodes of the smallest tree of the language.
fn smallest(policy: &[Option<usize>; 8]) -> usize {
    let care = (0..8)
        .filter(|m| policy[*m].is_some())
        .fold(0, |all, m| all | 3 << (2 * m));
    let leaves = leaves(policy);
    // The children of a sequence.
    let mut nodes = leaves.clone();
    nodes[0] = 0;
    loop {
        let mut changed = false;
        for state in (1..STATES).filter(|state| state & !care == 0) {
            let mut best = nodes[state].min(1 + nodes[exchanged(state)]);
            let (succeeds, ends) = (state & LOW & !(state >> 1), state >> 1 & LOW);
            let mut later = ends;
            loop {
                // The first child succeeds on these, and does what is to be done on the others.
                let passes = later | succeeds;
                let first = passes | (state & (3 * (ends & !later)));
                let rest = state & (3 * passes);
                if rest != 0 && first != state {
                    let first = leaves[first].min(1 + nodes[exchanged(first)]);
                    best = best.min(first + nodes[rest]);
                }
                if later == 0 {
                    break;
                }
                later = (later - 1) & ends;
            }
            if best < nodes[state] {
                nodes[state] = best;
                changed = true;
            }
        }
        if !changed {
            let root = leaves[care].min(1 + nodes[care].min(nodes[exchanged(care)]));
            return usize::from(root);
        }
    }
}

/// Of the 123 policies of three predicates without open rows.
#[test]
fn trees_that_tick_on_after_a_success_would_be_smaller() {
    let (mut smaller, mut sums) = (0, [0, 0]);
    let all = policies(0);
    for policy in &all {
        let (rows, classes) = closed(policy);
        let (found, least) = (rows.found(&classes, 1), smallest(policy));
        assert!(least <= found, "{policy:?}: {found} nodes, {least}");
        smaller += usize::from(least < found);
        sums = [sums[0] + found, sums[1] + least];
    }
    assert_eq!((all.len(), smaller), (123, 91));
    assert_eq!(sums[0] - sums[1], 149);
}
