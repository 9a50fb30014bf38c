//! Tables whose rows are cubes: their trees hold in every minterm, and a tree that does not is refuted by one.

use crate::laws::build::{leaf, not, p, selector, when};
use crate::laws::naive::holds;
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::tree::{Atom, Node};
use btc::policy::{Minterm, Policy, Row};
use btc::tree::canonicalise::canonicalise;
use btc::tree::decanonicalise::{Method, Options, Order, decanonicalise};
use btc::tree::prove::{Prover, Refuted, prove};
use btc::tree::reading::Reading;

/// A table over predicates, a row a cube as `01-`.
fn table(rows: &[(&str, usize)]) -> Policy {
    let atoms = rows[0].0.len();
    let row = |(cube, behavior): &(&str, usize)| Row {
        minterm: Minterm::new(cube.bytes().map(|b| b == b'1')),
        free: Some(Minterm::new(cube.bytes().map(|b| b == b'-'))).filter(|_| cube.contains('-')),
        behavior: Id::new(*behavior),
        visits: 0,
        values: vec![],
    };
    let mut rows: Vec<Row> = rows.iter().map(row).collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    Policy {
        atoms: (0..atoms).map(|i| Atom::Predicate(Id::new(i))).collect(),
        behaviors: (0..4).map(Id::new).collect(),
        rows,
        ..Policy::default()
    }
}

#[test]
fn a_row_is_decided_alike_in_all_of_its_minterms() {
    let policy = table(&[("1--", 0), ("01-", 1), ("00-", 2)]);
    let right = selector(vec![when(p(0), leaf(0)), when(p(1), leaf(1)), leaf(2)]);
    assert!(Prover::new(&policy).proves(&right));
    // Wrong in one minterm of the second row alone.
    let wrong = selector(vec![
        when(p(0), leaf(0)),
        when(btc::tree::guard::and([p(1), not(p(2))]), leaf(1)),
        leaf(2),
    ]);
    let Err(Refuted::Decides {
        minterm,
        policy: does,
        tree,
    }) = prove(&wrong, &policy)
    else {
        panic!("it is wrong in 011");
    };
    assert_eq!(minterm, Minterm::new([false, true, true]));
    assert_eq!((does, tree), (Id::new(1), Some(Id::new(2))));
    // Nothing is selected in 001.
    let silent = selector(vec![
        when(p(0), leaf(0)),
        when(p(1), leaf(1)),
        when(not(p(2)), leaf(2)),
    ]);
    assert!(matches!(
        prove(&silent, &policy),
        Err(Refuted::Decides { tree: None, .. })
    ));
}

/// Disjoint random cubes: the leaves of a random decision tree, some of them left out.
fn split(random: &mut Random, cube: &mut Vec<u8>, rows: &mut Vec<(String, usize)>) {
    let free: Vec<usize> = (0..cube.len()).filter(|i| cube[*i] == b'-').collect();
    if free.is_empty() || random.chance(20) && free.len() < cube.len() {
        if random.chance(85) {
            rows.push((String::from_utf8(cube.clone()).unwrap(), random.below(4)));
        }
        return;
    }
    let atom = free[random.below(free.len())];
    for value in [b'0', b'1'] {
        cube[atom] = value;
        split(random, cube, rows);
    }
    cube[atom] = b'-';
}

fn random_cubes(seed: u64, atoms: usize) -> Policy {
    let random = &mut Random::new(seed);
    let mut rows = Vec::new();
    split(random, &mut vec![b'-'; atoms], &mut rows);
    let rows: Vec<(&str, usize)> = rows.iter().map(|(cube, b)| (&**cube, *b)).collect();
    match rows.is_empty() {
        true => table(&[("1----", 0)]),
        false => table(&rows),
    }
}

/// What the tree selects in every minterm of every row is what the row says.
fn hold(root: &Node, policy: &Policy) {
    let canonical = canonicalise(root, Reading::Furthest).unwrap();
    let atoms = policy.atoms.len();
    for row in &policy.rows {
        for values in 0..1_usize << atoms {
            let minterm = Minterm::new((0..atoms).map(|i| values >> i & 1 == 1));
            let free = |i: usize| row.free.as_ref().is_some_and(|free| free.get(i));
            if (0..atoms).all(|i| free(i) || row.minterm.get(i) == minterm.get(i)) {
                let selected = canonical.select(&mut holds(&policy.atoms, &minterm));
                assert_eq!(selected, Some(row.behavior), "{root:?} in {minterm:?}");
            }
        }
    }
}

#[test]
fn trees_of_random_cubes_hold_in_all_of_their_minterms() {
    for seed in 1..=60 {
        let policy = random_cubes(seed, 5);
        for method in [Method::Paper, Method::Search] {
            for order in [Order::Learned, Order::Given, Order::Rarest] {
                let asked = Options {
                    method,
                    order,
                    effort: 1,
                    ..Options::default()
                };
                let found = decanonicalise(&policy, &asked).unwrap();
                hold(&found.root, &policy);
            }
        }
    }
}
