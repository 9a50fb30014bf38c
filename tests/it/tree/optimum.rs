//! Trees of few predicates against the smallest there are, which a dynamic program over all sets of minterms finds.

use super::scale::{searched, table};
use btc::logic::Order;
use btc::policy::Minterm;

const ATOMS: usize = 3;
const MINTERMS: usize = 1 << ATOMS;
const SETS: usize = 1 << MINTERMS;
const NEVER: usize = 1000;

/// The nodes of the smallest formula of each function as a child of a sequence. A disjunction is a selector; as a child of one it
/// costs what its negation costs as a child of a sequence.
fn formulas() -> Vec<usize> {
    let mut nodes = vec![NEVER; SETS];
    for atom in 0..ATOMS {
        let literal: usize = (0..MINTERMS)
            .filter(|m| m >> atom & 1 == 1)
            .map(|m| 1 << m)
            .sum();
        nodes[literal] = 1;
        nodes[SETS - 1 - literal] = 1;
    }
    loop {
        let before = nodes.clone();
        for a in 1..SETS - 1 {
            nodes[a] = nodes[a].min(1 + before[SETS - 1 - a]);
            for b in 1..SETS - 1 {
                if a & b != 0 {
                    nodes[a & b] = nodes[a & b].min(before[a] + before[b]);
                }
            }
        }
        if nodes == before {
            return nodes;
        }
    }
}

/// The nodes of the smallest tree for a class of each minterm: units that each decide some of the minterms left.
fn smallest(formulas: &[usize], classes: &[usize]) -> usize {
    let alike = |set: usize| {
        let mut own = (0..MINTERMS)
            .filter(|m| set >> m & 1 == 1)
            .map(|m| classes[m]);
        let first = own.next();
        own.all(|class| Some(class) == first)
    };
    let least = |set: usize, part: usize| {
        let fitting = (1..SETS - 1).filter(|guard| guard & set == part);
        fitting.map(|guard| formulas[guard]).min().unwrap_or(NEVER)
    };
    let mut children = vec![0; SETS];
    for set in 1..SETS {
        if alike(set) {
            children[set] = 1;
            continue;
        }
        let parts = (1..set).filter(|part| part & set == *part);
        let nodes = parts.map(|part| {
            let selector = usize::from(!alike(part));
            1 + least(set, part) + selector + children[part] + children[set - part]
        });
        children[set] = nodes.min().unwrap();
    }
    children[SETS - 1] + usize::from(!alike(SETS - 1))
}

/// Every seventh policy of two behaviours, and of three; parity is among them.
#[test]
fn policies_of_three_predicates_have_the_smallest_tree() {
    let formulas = formulas();
    let two = (0..1 << 7).step_by(7).map(|n| (2, n));
    let three = (0..3_usize.pow(7)).step_by(151).map(|n| (3, n));
    let parity = (0..MINTERMS).fold(0, |all, m| all | (m.count_ones() as usize & 1) << m);
    for (behaviors, number) in two.chain(three).chain([(2, parity)]) {
        let power = |m: usize| behaviors_to(behaviors, m);
        let classes: Vec<usize> = (0..MINTERMS)
            .map(|m| number / power(m) % behaviors)
            .collect();
        let rows = (0..MINTERMS).map(|m| {
            let values = Minterm::new((0..ATOMS).map(|i| m >> i & 1 == 1));
            (values, classes[m])
        });
        let policy = table(ATOMS, behaviors, rows);
        let found = searched(&policy, Order::Learned, 1).size.nodes;
        let least = smallest(&formulas, &classes);
        assert!(
            found <= least,
            "{classes:?}: {found} nodes, {least} are enough"
        );
        if number == parity && behaviors == 2 {
            assert_eq!(found, 17);
        }
    }
}

fn behaviors_to(behaviors: usize, power: usize) -> usize {
    behaviors.pow(power as u32)
}
