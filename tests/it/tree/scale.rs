//! Sizes of trees: rules come out as they were planted, orders are kept, and nothing is larger than Algorithm 1's.

use super::random::policy;
use super::walk::parts_after;
use crate::laws::random::Random;
use crate::planted::{BEHAVIORS, planted};
use btc::ir::Id;
use btc::ir::tree::{Atom, Node};
use btc::policy::{Minterm, Policy, Row};
use btc::tree::Size;
use btc::tree::decanonicalise::{Decanonicalised, Method, Options, Order, decanonicalise};
use btc::tree::prove::prove;
use rayon::prelude::*;

/// A table over this many predicates.
pub(super) fn table(
    atoms: usize,
    behaviors: usize,
    rows: impl Iterator<Item = (Minterm, usize)>,
) -> Policy {
    let mut rows: Vec<Row> = rows
        .map(|(minterm, does)| Row {
            minterm,
            free: None,
            behavior: Id::new(does),
            visits: 0,
            values: vec![],
        })
        .collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    rows.dedup_by(|a, b| a.minterm == b.minterm);
    Policy {
        atoms: (0..atoms).map(|i| Atom::Predicate(Id::new(i))).collect(),
        behaviors: (0..behaviors).map(Id::new).collect(),
        rows,
        ..Policy::default()
    }
}

/// All 128 minterms under five rules of two literals, a behaviour each, and a default.
fn five_rules(seed: u64) -> Policy {
    let random = &mut Random::new(seed + 1000);
    let rules: Vec<[(usize, bool); 2]> = (0..5)
        .map(|_| {
            let first = random.below(7);
            let second = (first + 1 + random.below(6)) % 7;
            [(first, random.chance(50)), (second, random.chance(50))]
        })
        .collect();
    let rows = (0..128_usize).map(|values| {
        let minterm = Minterm::new((0..7).map(|i| values >> i & 1 == 1));
        let holds = |rule: &[(usize, bool); 2]| rule.iter().all(|(a, v)| minterm.get(*a) == *v);
        let does = rules.iter().position(holds).unwrap_or(5);
        (minterm, does)
    });
    table(7, 6, rows)
}

pub(super) fn searched(policy: &Policy, order: Order, effort: u64) -> Decanonicalised {
    let asked = Options {
        order,
        effort,
        ..Options::default()
    };
    decanonicalise(policy, &asked).unwrap()
}

#[test]
fn five_rules_of_two_literals_have_at_most_22_nodes() {
    let sizes: Vec<Size> = (0..100_u64)
        .into_par_iter()
        .map(|seed| searched(&five_rules(seed), Order::Learned, 1).size)
        .collect();
    let over: Vec<(usize, &Size)> = (0..).zip(&sizes).filter(|(_, s)| s.nodes > 22).collect();
    assert!(over.is_empty(), "{over:?}");
}

fn planted_table(atoms: usize, rows: usize, seed: u64) -> (Policy, usize) {
    let planted = planted(atoms, rows, seed);
    let literals = planted.size().1;
    let does = |r: usize| planted.classes.iter().position(|class| class.contains(r));
    let rows = planted.rows.iter().enumerate().map(|(r, words)| {
        let value = |atom: usize| words[atom / 64] >> (atom % 64) & 1 == 1;
        (Minterm::new((0..atoms).map(value)), does(r).unwrap())
    });
    (table(atoms, BEHAVIORS, rows), literals)
}

#[test]
fn planted_lists_come_out_with_their_literals_or_fewer() {
    for (atoms, rows, seed) in [(11, 61, 0), (11, 61, 1), (24, 10_000, 0), (128, 10_000, 1)] {
        let (policy, literals) = planted_table(atoms, rows, seed);
        let found = searched(&policy, Order::Learned, 20);
        assert!(
            found.size.literals <= literals,
            "{atoms} × {rows}, seed {seed}: {:?}, planted {literals} literals",
            found.size
        );
        prove(&found.root, &policy).unwrap();
    }
}

/// The behaviours of the units of a selector, from the left.
fn units(root: &Node) -> Vec<usize> {
    let mut found = Vec::new();
    root.visit_behaviors(&mut |behavior| found.push(behavior.index()));
    found
}

#[test]
fn an_order_that_is_asked_for_is_kept() {
    for seed in 0..10 {
        let (policy, _) = planted_table(11, 61, seed);
        let mut count = [0; BEHAVIORS];
        for row in &policy.rows {
            count[row.behavior.index()] += 1;
        }
        let there: Vec<usize> = (0..BEHAVIORS).filter(|b| count[*b] > 0).collect();
        let given = searched(&policy, Order::Given, 20);
        assert_eq!(units(&given.root), there, "seed {seed}");
        let mut rarest = there.clone();
        rarest.sort_by_key(|b| count[*b]);
        let found = searched(&policy, Order::Rarest, 20);
        assert_eq!(units(&found.root), rarest, "seed {seed}");
        let learned = searched(&policy, Order::Learned, 20);
        assert!(learned.size <= given.size.min(found.size), "seed {seed}");
    }
}

/// Nodes of both methods, and whether memory was of use.
fn compared(seed: u64, naively: bool) -> (usize, usize, bool) {
    let policy = policy(seed);
    let asked = |method| Options {
        method,
        effort: 2,
        ..Options::default()
    };
    let [paper, search] = [Method::Paper, Method::Search].map(|method| {
        let found = decanonicalise(&policy, &asked(method))
            .unwrap_or_else(|refuted| panic!("seed {seed}: {refuted:?}"));
        if naively {
            assert_eq!(parts_after(&found.root, &policy), None, "seed {seed}");
        }
        found
    });
    assert!(search.size <= paper.size, "seed {seed}");
    let memory = format!("{:?}", search.root).contains("memory: true");
    (paper.size.nodes, search.size.nodes, memory)
}

fn summary(seeds: std::ops::RangeInclusive<u64>, naively: bool) -> (f64, usize) {
    let all: Vec<(usize, usize, bool)> = seeds
        .into_par_iter()
        .map(|seed| compared(seed, naively))
        .collect();
    let paper: usize = all.iter().map(|(paper, ..)| paper).sum();
    let search: usize = all.iter().map(|(_, search, _)| search).sum();
    let memory = all.iter().filter(|(.., memory)| *memory).count();
    let saved = 100.0 * (paper - search) as f64 / paper as f64;
    println!(
        "{} policies: {paper} nodes by Algorithm 1, {search} by the search: {saved:.2} % fewer; \
         {memory} trees with memory",
        all.len()
    );
    (saved, memory)
}

#[test]
fn the_search_is_never_larger_than_algorithm_1() {
    let (saved, memory) = summary(1001..=1300, true);
    assert!(saved > 10.0 && memory > 15, "{saved} %, {memory}");
}

/// `cargo test --release --test it -- --ignored --nocapture a_hundred_thousand`
#[test]
#[ignore = "minutes, in release"]
fn a_hundred_thousand_random_policies_have_equal_trees_never_larger_than_algorithm_1() {
    let (saved, _) = summary(1..=100_000, true);
    assert!(saved > 10.0, "{saved} %");
}
