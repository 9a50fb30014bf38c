//! Planted lists that return to a behaviour: trees are no larger than the list, nor than a decision tree (CART) as a tree.

use super::falls::Falls;
use super::scale::{searched, table};
use crate::laws::random::Random;
use btc::logic::Order;
use btc::policy::{Minterm, Policy};

/// A list of rules over `atoms` predicates with three behaviours, each row decided by it; with the nodes of the list as a tree.
fn planted(seed: u64, atoms: usize, rows: usize, rules: usize, falls: Falls) -> (Policy, usize) {
    let random = &mut Random::new(seed);
    let rules: Vec<(Vec<(usize, bool)>, usize)> = (0..rules)
        .map(|at| {
            let literals = if at < 3 { 2 } else { 1 } + random.below(2);
            let mut cube: Vec<(usize, bool)> = Vec::new();
            while cube.len() < literals {
                let atom = random.below(atoms);
                if cube.iter().all(|(known, _)| *known != atom) {
                    cube.push((atom, random.chance(50)));
                }
            }
            (cube, random.below(3))
        })
        .collect();
    let last = random.below(3);
    let rows: Vec<(Minterm, usize)> = falls
        .rows(random, atoms, rows)
        .into_iter()
        .map(|values| {
            let minterm = Minterm::new(values);
            let holds = |rule: &&(Vec<(usize, bool)>, usize)| {
                rule.0
                    .iter()
                    .all(|(atom, value)| minterm.get(*atom) == *value)
            };
            let does = rules.iter().find(holds).map_or(last, |rule| rule.1);
            (minterm, does)
        })
        .collect();
    let nodes = 2 + rules.iter().map(|(cube, _)| 2 + cube.len()).sum::<usize>();
    (table(atoms, 3, rows.into_iter()), nodes)
}

/// The nodes of a decision tree by the Gini impurity, each division a unit and what follows it: leaves, sequences and literals, and a
/// selector for each division that does not follow another.
fn cart(rows: &[(Minterm, usize)], atoms: usize) -> (usize, bool) {
    let classes = 1 + rows.iter().map(|row| row.1).max().unwrap_or(0);
    let impurity = |side: &[&(Minterm, usize)]| {
        let count = |class| side.iter().filter(|row| row.1 == class).count() as f64;
        let all = side.len() as f64;
        all - (0..classes).map(|class| count(class).powi(2)).sum::<f64>() / all.max(1.0)
    };
    if rows.iter().all(|row| row.1 == rows[0].1) {
        return (1, false);
    }
    let divided = |atom: usize| -> [Vec<&(Minterm, usize)>; 2] {
        [false, true].map(|value| rows.iter().filter(|row| row.0.get(atom) == value).collect())
    };
    let mixed = |atom: &usize| {
        let [zero, one] = divided(*atom);
        let divides = !zero.is_empty() && !one.is_empty();
        divides.then(|| impurity(&zero) + impurity(&one))
    };
    let atom = (0..atoms)
        .filter(|atom| mixed(atom).is_some())
        .min_by(|a, b| mixed(a).partial_cmp(&mixed(b)).unwrap())
        .unwrap();
    let parts = divided(atom).map(|part| {
        let part: Vec<(Minterm, usize)> = part.into_iter().cloned().collect();
        cart(&part, atoms)
    });
    let [(zero, divides_zero), (one, divides_one)] = parts;
    // The selector of one divided part goes on in that of the whole.
    (
        2 + zero + one + usize::from(divides_zero && divides_one),
        true,
    )
}

fn check(seeds: u64, effort: u64) -> (usize, usize) {
    let (mut found, mut known) = (0, 0);
    for seed in 0..seeds {
        let (policy, planted) = planted(seed, 24, 250, 6, Falls::Evenly);
        let rows: Vec<(Minterm, usize)> = policy
            .rows
            .iter()
            .map(|row| (row.minterm.clone(), row.behavior.index()))
            .collect();
        let divided = 1 + cart(&rows, 24).0;
        let size = searched(&policy, Order::Learned, effort).size.nodes;
        println!("seed {seed}: {size} nodes, {planted} planted, {divided} by CART");
        assert!(
            size <= divided,
            "seed {seed}: {size} nodes, {divided} by CART"
        );
        found += size;
        known += planted;
    }
    (found, known)
}

#[test]
fn lists_that_return_come_out_as_small_as_they_were_planted() {
    let (found, planted) = check(4, 10);
    assert!(found <= planted, "{found} nodes for {planted}");
}

/// The tables with these numbers whose trees are larger than the lists that were planted in them; and the nodes of all trees, and of
/// all lists.
fn larger(numbers: impl Iterator<Item = u64>) -> (Vec<String>, [usize; 2]) {
    let (mut larger, mut sums) = (Vec::new(), [0, 0]);
    for number in numbers {
        let of = |choices: [usize; 3], by: u64| choices[(number / by) as usize % 3];
        let (atoms, rows) = (of([24, 64, 128], 1), of([300, 1000, 10_000], 3));
        let rules = of([8, 10, 12], 9);
        let falls = [Falls::Evenly, Falls::Skewed, Falls::Together][(number / 27) as usize % 3];
        let (policy, planted) = planted(number, atoms, rows, rules, falls);
        let started = std::time::Instant::now();
        let nodes = searched(&policy, Order::Learned, 20).size.nodes;
        let table = format!("{number}: {atoms} × {rows}, {rules} rules, {falls:?}");
        println!(
            "{table}: {nodes} nodes, {planted} planted, {:.1} s",
            started.elapsed().as_secs_f64()
        );
        sums = [sums[0] + nodes, sums[1] + planted];
        if nodes > planted {
            larger.push(format!("{table}: {nodes} nodes, {planted} planted"));
        }
    }
    (larger, sums)
}

#[test]
fn lists_over_many_predicates_and_rows_are_found() {
    let (larger, _) = larger([1, 6, 29, 60].into_iter());
    assert!(larger.is_empty(), "{larger:?}");
}

/// `cargo test --release --test it -- --ignored --nocapture two_hundred_lists`
#[test]
#[ignore = "minutes"]
fn two_hundred_lists_that_return() {
    let (larger, [found, planted]) = larger(0..200);
    println!(
        "{} of 200 are larger than planted: {larger:#?}; {found} nodes for {planted} planted",
        larger.len()
    );
    assert!(found <= planted);
    assert!(larger.len() <= 4);
}

/// Without any structure a tree is no larger than a decision tree.
#[test]
fn tables_without_structure_are_no_larger_than_by_cart() {
    for (seed, rows, behaviors) in [(0, 60, 60), (1, 200, 3), (2, 120, 2)] {
        let random = &mut Random::new(seed);
        let rows: Vec<(Minterm, usize)> = (0..rows)
            .map(|row| {
                let values: Vec<bool> = (0..12).map(|_| random.chance(50)).collect();
                let does = if behaviors == rows {
                    row
                } else {
                    random.below(behaviors)
                };
                (Minterm::new(values), does)
            })
            .collect();
        let policy = table(12, behaviors, rows.into_iter());
        let rows: Vec<(Minterm, usize)> = policy
            .rows
            .iter()
            .map(|row| (row.minterm.clone(), row.behavior.index()))
            .collect();
        let divided = 1 + cart(&rows, 12).0;
        let size = searched(&policy, Order::Learned, 4).size.nodes;
        assert!(
            size <= divided,
            "seed {seed}: {size} nodes, {divided} by CART"
        );
    }
}

/// Effort binds: a table without structure has a tree at once, and the report says what was left.
#[test]
fn a_tree_is_held_from_the_beginning() {
    let random = &mut Random::new(7);
    let rows: Vec<(Minterm, usize)> = (0..600)
        .map(|_| {
            let values: Vec<bool> = (0..14).map(|_| random.chance(50)).collect();
            (Minterm::new(values), random.below(4))
        })
        .collect();
    let policy = table(14, 4, rows.into_iter());
    let [none, some] = [0, 8].map(|effort| searched(&policy, Order::Learned, effort));
    assert!(!none.unfinished.is_empty());
    assert!(some.size <= none.size, "{:?} {:?}", some.size, none.size);
}
