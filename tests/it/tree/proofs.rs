//! Trees of random policies hold by the naive interpreter, and mutations of them are told apart.

use super::build::asked;
use super::random::{Random, policy};
use super::walk::{Reads, holds, parts_after, read, replay};
use btc::ir::tree::{Guard, Node};
use btc::policy::Policy;
use btc::tree::Size;
use btc::tree::canonicalise::canonicalise;
use btc::tree::decanonicalise::{Care, Decanonicalised, Method, decanonicalise};
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::prove::Reading;

fn checked(policy: &Policy, method: Method, seed: u64) -> Decanonicalised {
    let found = decanonicalise(policy, &asked(method, Care::Seen))
        .unwrap_or_else(|refuted| panic!("seed {seed}, {method:?}: {refuted:?}"));
    for row in &policy.rows {
        let reads = read(
            &found.root,
            found.proof.reading,
            &holds(&policy.atoms, &row.minterm),
        );
        assert_eq!(
            reads,
            Reads::Behavior(row.behavior),
            "seed {seed}: P1 of {:?}",
            found.root
        );
    }
    assert_eq!(parts_after(&found.root, policy), None, "seed {seed}: P2");
    assert_eq!(Size::of(&found.root), found.size);
    // Canonical forms read memory as one termination shows it.
    if let (Ok(canonical), Reading::Furthest) = (canonicalise(&found.root), found.proof.reading) {
        assert_eq!(
            parts_after(&canonical.tree(), policy),
            None,
            "seed {seed}: canonical form"
        );
    }
    found
}

#[test]
fn trees_of_random_policies_take_their_decisions() {
    let (mut memory, mut paper_nodes, mut search_nodes) = (0, 0, 0);
    let seeds = 1..=400;
    for seed in seeds.clone() {
        let policy = policy(seed);
        let paper = checked(&policy, Method::Paper, seed);
        let search = checked(&policy, Method::Search, seed);
        assert_eq!(Some(paper.size), search.paper_size);
        assert!(
            search.size <= paper.size,
            "seed {seed}: {:?} > {:?}",
            search.size,
            paper.size
        );
        memory += usize::from(format!("{:?}", search.root).contains("memory: true"));
        paper_nodes += paper.size.nodes;
        search_nodes += search.size.nodes;
    }
    let saved = 100 * (paper_nodes - search_nodes) / paper_nodes;
    let summary = format!("{memory} trees with memory, {saved} % of {paper_nodes} nodes saved");
    assert!(memory >= 20 && saved >= 5, "{summary}");
    println!("{summary}");
}

#[test]
fn mutations_are_refuted_or_equal() {
    let (mut refuted, mut equal) = (0, 0);
    for seed in 1..=200 {
        let policy = policy(seed);
        let found = decanonicalise(&policy, &asked(Method::Search, Care::Seen)).unwrap();
        for mutant in mutants(&found.root, &mut Random::new(seed)) {
            let compared = compare(
                Side::Tree(&mutant),
                Side::Policy(&policy),
                Environment::Greedy(&policy),
            );
            match compared.unwrap() {
                Verdict::Differ(trace) => {
                    replay(&mutant, &policy, &trace);
                    assert_eq!(
                        parts_after(&mutant, &policy),
                        Some(trace.steps.len()),
                        "seed {seed}"
                    );
                    refuted += 1;
                }
                Verdict::Equal(_) => {
                    assert_eq!(parts_after(&mutant, &policy), None, "seed {seed}");
                    equal += 1;
                }
                Verdict::Undecided(_) => panic!("seed {seed}: undecided"),
            }
        }
    }
    assert!(
        refuted > 300 && equal > 50,
        "{refuted} refuted, {equal} equal"
    );
}

/// The tree with one thing changed, for every thing.
fn mutants(root: &Node, random: &mut Random) -> Vec<Node> {
    let mut found = vec![];
    let mut at = 0;
    loop {
        let mut mutant = root.clone();
        let mut left = at;
        if !change(&mut mutant, &mut left, random) {
            return found;
        }
        if mutant != *root {
            found.push(mutant);
        }
        at += 1;
    }
}

/// Makes the change with number `left`; false if there are fewer.
fn change(node: &mut Node, left: &mut usize, random: &mut Random) -> bool {
    let mut mine = || {
        let hit = *left == 0;
        *left = left.wrapping_sub(1);
        hit
    };
    match node {
        Node::Condition(guard) => {
            if mine() {
                *guard = Guard::Not(Box::new(guard.clone()));
                return true;
            }
            if mine() {
                *guard = Guard::Const(true);
                return true;
            }
            if let Guard::And(parts) | Guard::Or(parts) = guard {
                if mine() {
                    let i = random.below(parts.len());
                    parts[i] = Guard::Not(Box::new(parts[i].clone()));
                    return true;
                }
                if mine() {
                    let i = random.below(parts.len());
                    parts.remove(i);
                    return true;
                }
            }
            false
        }
        Node::Composite {
            memory, children, ..
        } => {
            if mine() {
                *memory = !*memory;
                return true;
            }
            for i in 1..children.len() {
                if mine() {
                    children.swap(i - 1, i);
                    return true;
                }
            }
            children.iter_mut().any(|child| change(child, left, random))
        }
        _ => false,
    }
}
