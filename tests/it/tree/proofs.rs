//! Trees of random policies hold by the naive interpreter, and mutations of them are refuted or equal.

use super::random::policy;
use super::seen::seen;
use super::walk::{parts_after, read, replay};
use crate::laws::build::{self, asked, condition, leaf, not, p, when};
use crate::laws::grown::Soil;
use crate::laws::naive::holds;
use crate::laws::random::Random;
use btc::ir::task::History;
use btc::ir::tree::{Guard, Node};
use btc::policy::Policy;
use btc::tree::Size;
use btc::tree::canonicalise::canonicalise;
use btc::tree::decanonicalise::{Care, Decanonicalised, Method, decanonicalise};
use btc::tree::equivalence::{Environment, Side, Verdict, compare};
use btc::tree::prove::prove;
use btc::tree::reading::{Reading, Reason};

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
            Ok(row.behavior),
            "seed {seed}: P1 of {:?}",
            found.root
        );
    }
    assert_eq!(parts_after(&found.root, policy), None, "seed {seed}: P2");
    assert_eq!(Size::of(&found.root), found.size);
    let canonical = canonicalise(&found.root, found.proof.reading).unwrap();
    assert_eq!(
        parts_after(&canonical.tree(), policy),
        None,
        "seed {seed}: canonical form"
    );
    found
}

/// A chain with memory under a guard, often with a last child that may end the chain at once, and what else there is.
fn with_chain(random: &mut Random, soil: Soil) -> Node {
    let mut free: Vec<usize> = (0..soil.behaviors).collect();
    let length = 2 + random.below(soil.behaviors - 2);
    let mut links: Vec<Node> = (0..length)
        .map(|_| leaf(free.swap_remove(random.below(free.len()))))
        .collect();
    let sequence = random.chance(60);
    if random.chance(50) {
        let last = links.pop().unwrap();
        let rarely = Guard::And((0..soil.predicates).map(p).collect());
        links.push(match sequence {
            true => build::selector(vec![condition(rarely), last]),
            false => build::sequence(vec![condition(not(rarely)), last]),
        });
    }
    let chain = match sequence {
        true => build::memory_sequence(links),
        false => build::memory_selector(links),
    };
    let chain = when(p(0), chain);
    build::selector(vec![chain, leaf(free[0])])
}

#[test]
fn what_is_proved_canonicalises_to_the_table_that_it_was_proved_on() {
    let (mut furthest, mut unfinished, mut at_once, mut drives_on) = (0, 0, 0, 0);
    for seed in 1..=1_500 {
        let random = &mut Random::new(seed);
        let soil = Soil {
            predicates: 2 + random.below(2),
            behaviors: 3 + random.below(3),
            history: random.chance(20),
            memory: true,
            wild: false,
        };
        let root = match random.chance(70) {
            true => with_chain(random, soil),
            false => soil.guarded(random, 2),
        };
        let history = History {
            window: 1 + random.below(3),
            success: random.chance(90),
            failure: random.chance(60),
        };
        let policy = seen(&root, history, random);
        let Ok(proof) = prove(&root, &policy) else {
            continue;
        };
        let canonical = match canonicalise(&root, proof.reading) {
            Ok(canonical) => canonical,
            // It selects as the policy does, and where that fails it drives on in the same tick, as no unit can.
            Err(why) => {
                assert!(
                    matches!(why.reason, Reason::Status(_)),
                    "seed {seed}: {why:?}"
                );
                drives_on += 1;
                continue;
            }
        };
        for row in &policy.rows {
            let here = holds(&policy.atoms, &row.minterm);
            let selects = canonical.select(&mut |atom| here(atom));
            assert_eq!(selects, Some(row.behavior), "seed {seed}: {root:?}");
        }
        if root.remembers() {
            furthest += usize::from(proof.reading == Reading::Furthest);
            unfinished += usize::from(proof.reading == Reading::Unfinished);
            at_once += usize::from(ends_at_once(&root));
        }
    }
    let summary = format!("{furthest} {unfinished}, {at_once} at once, {drives_on} drive on");
    assert!(
        furthest > 100 && unfinished > 10 && at_once > 50,
        "{summary}"
    );
}

/// Whether the last child of a memory node may end it without a behaviour.
fn ends_at_once(node: &Node) -> bool {
    let below = node.children().last();
    let ends = |last: &Node| matches!(last.children().first(), Some(Node::Condition(_)));
    matches!(node, Node::Composite { memory: true, .. }) && below.is_some_and(ends)
        || node.children().iter().any(ends_at_once)
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
