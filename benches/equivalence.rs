//! How long it takes to tell that two trees are equal, and to bring one to canonical form.
//!
//! The peers' figures for two decision lists, in ms, on a machine of two cores: 11 predicates 0.007 (bit-parallel truth
//! table), 24 predicates 31 (table) and 9 (SAT), 64 predicates and 400 rules 70 (rustsat with BatSat).
#![allow(
    clippy::unwrap_used,
    clippy::panic,
    reason = "a bench fails where it goes wrong"
)]

use btc::ir::Id;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Composite, Guard, Node};
use btc::policy::{Minterm, Policy, Row};
use btc::random::Random;
use btc::tree::canonicalise::canonicalise;
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::permute::permute;
use btc::tree::reading::Reading;
use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;

/// A rule: a guard and the behaviour behind it.
type Rule = (Guard, usize);

struct Dice(Random);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0.below(n as u64) as usize
    }
}

fn rules(count: usize, predicates: usize, seed: u64) -> Vec<Rule> {
    let mut dice = Dice(Random::new(seed, 0, 0));
    let mut literal = || {
        let atom = Guard::Atom(Atom::Predicate(Id::new(dice.below(predicates))));
        match dice.below(2) {
            0 => Guard::Not(Box::new(atom)),
            _ => atom,
        }
    };
    let guards: Vec<Guard> = (0..count)
        .map(|_| Guard::And(vec![literal(), literal(), literal()]))
        .collect();
    let behaviors = guards.into_iter().enumerate();
    behaviors.map(|(i, guard)| (guard, i % 8)).collect()
}

fn composite(kind: Composite, memory: bool, children: Vec<Node>) -> Node {
    Node::Composite {
        kind,
        memory,
        children,
    }
}

fn list(rules: &[Rule]) -> Node {
    let unit = |(guard, behavior): &Rule| {
        let leaf = Node::Behavior(Id::new(*behavior));
        composite(
            Composite::Sequence,
            false,
            vec![Node::Condition(guard.clone()), leaf],
        )
    };
    let children = rules.iter().map(unit);
    let default = Node::Behavior(Id::new(8));
    composite(
        Composite::Selector,
        false,
        children.chain([default]).collect(),
    )
}

/// The same decisions otherwise: of each two rules the second stands first, where the first does not hold.
fn exchanged(rules: &[Rule]) -> Vec<Rule> {
    let pairs = rules.chunks(2).flat_map(|pair| match pair {
        [(g, a), (h, b)] => {
            let unless = Guard::And(vec![h.clone(), Guard::Not(Box::new(g.clone()))]);
            vec![(unless, *b), (g.clone(), *a)]
        }
        rest => rest.to_vec(),
    });
    pairs.collect()
}

fn equal(left: &Node, right: &Node, environment: Environment) {
    let verdict = compare(Side::Tree(left), Side::Tree(right), environment).unwrap();
    assert!(matches!(verdict, Verdict::Equal(_)), "{verdict:?}");
}

fn decision_lists(c: &mut Criterion) {
    let mut group = c.benchmark_group("two decision lists are equal");
    group.sample_size(10);
    for (predicates, count) in [(11, 8), (20, 40), (24, 40), (64, 400)] {
        let rules = rules(count, predicates, 1);
        let (left, right) = (list(&rules), list(&exchanged(&rules)));
        let any = Environment::Any(History::default());
        group.bench_function(format!("{predicates} predicates, {count} rules"), |b| {
            b.iter(|| equal(black_box(&left), black_box(&right), any));
        });
    }
    group.finish();
}

/// Chains of three behaviours under guards, and a default.
fn chains(rules: &[Rule]) -> Node {
    let chain = |(i, (guard, _)): (usize, &Rule)| {
        let links = (0..3).map(|k| Node::Behavior(Id::new(3 * i + k)));
        let chain = composite(Composite::Sequence, true, links.collect());
        composite(
            Composite::Sequence,
            false,
            vec![Node::Condition(guard.clone()), chain],
        )
    };
    let children = rules.iter().enumerate().map(chain);
    let default = Node::Behavior(Id::new(99));
    composite(
        Composite::Selector,
        false,
        children.chain([default]).collect(),
    )
}

fn memory(c: &mut Criterion) {
    let mut group = c.benchmark_group("trees with memory are equal");
    group.sample_size(10);
    let rules = rules(6, 30, 2);
    let tree = chains(&rules);
    let negated = |(guard, behavior): &Rule| {
        let twice = Guard::Not(Box::new(Guard::Not(Box::new(guard.clone()))));
        (Guard::And(vec![twice.clone(), twice]), *behavior)
    };
    let other = chains(&rules.iter().map(negated).collect::<Vec<_>>());
    let history = History {
        window: 1,
        success: true,
        failure: false,
    };
    group.bench_function(
        "six chains of three over 30 predicates, anything may happen",
        |b| {
            b.iter(|| equal(black_box(&tree), &other, Environment::Any(history)));
        },
    );
    for rows in [1_000, 10_000] {
        let table = table(rows, 30);
        group.bench_function(format!("the same, on a table of {rows} rows"), |b| {
            b.iter(|| equal(black_box(&tree), &other, Environment::Observed(&table)));
        });
    }
    group.finish();
}

/// A table of random minterms over this many predicates.
fn table(rows: usize, predicates: usize) -> Policy {
    let mut dice = Dice(Random::new(3, 0, 0));
    let minterms = (0..rows).map(|_| Minterm::new((0..predicates).map(|_| dice.below(2) == 1)));
    let mut minterms: Vec<Minterm> = minterms.collect();
    minterms.sort();
    minterms.dedup();
    let row = |minterm| Row {
        minterm,
        free: None,
        behavior: Id::new(0),
        visits: 0,
        values: Vec::new(),
    };
    Policy {
        atoms: (0..predicates)
            .map(|i| Atom::Predicate(Id::new(i)))
            .collect(),
        rows: minterms.into_iter().map(row).collect(),
        ..Policy::default()
    }
}

fn forms(c: &mut Criterion) {
    let mut group = c.benchmark_group("canonical forms");
    group.sample_size(10);
    for (predicates, count) in [(11, 8), (24, 40)] {
        let tree = list(&rules(count, predicates, 1));
        group.bench_function(
            format!("of {count} rules over {predicates} predicates"),
            |b| {
                b.iter(|| canonicalise(black_box(&tree), Reading::Furthest).unwrap());
            },
        );
        let canonical = canonicalise(&tree, Reading::Furthest).unwrap();
        let order: Vec<_> = canonical.units.iter().rev().map(|u| u.behavior).collect();
        group.bench_function(
            format!("… from the right to the left, {predicates} predicates"),
            |b| {
                b.iter(|| permute(black_box(&canonical), &order).unwrap());
            },
        );
    }
    group.finish();
}

criterion_group!(benches, decision_lists, memory, forms);
criterion_main!(benches);
