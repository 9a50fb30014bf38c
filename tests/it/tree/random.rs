//! Random policies with random transitions that are consistent with a history window.

use crate::laws::naive::{Memory, holds, tick};
use crate::laws::random::Random;
use btc::ir::Id;
use btc::ir::law::Behavior;
use btc::ir::task::History;
use btc::ir::tree::{Atom, Composite, Guard, Node, Status};
use btc::policy::{Minterm, Policy, Row, Transition};
use std::collections::BTreeMap;

type Window = Vec<(usize, Status)>;

/// A rule of the planted policy: where these atoms have these values, this behaviour.
type Rule = (Vec<(usize, bool)>, usize);

/// A policy of up to 12 predicates: what a planted list of rules does in a world whose predicates change at random.
pub(crate) fn policy(seed: u64) -> Policy {
    let random = &mut Random::new(seed);
    let predicates = random.below(if seed.is_multiple_of(7) { 13 } else { 6 });
    let behaviors = 1 + random.below(7);
    let history = History {
        window: [0, 1, 1, 1, 1, 2, 3][random.below(7)],
        success: !random.chance(10),
        failure: random.chance(35),
    };
    let mut atoms: Vec<Atom> = (0..predicates)
        .map(|p| Atom::Predicate(Id::new(p)))
        .collect();
    if history.window > 0 && history.success {
        atoms.extend((0..behaviors).map(|b| Atom::Done(Id::new(b))));
    }
    if history.window > 0 && history.failure {
        atoms.extend((0..behaviors).map(|b| Atom::Failed(Id::new(b))));
    }
    let rules = rules(random, &atoms, predicates, behaviors);
    let tree = seed
        .is_multiple_of(3)
        .then(|| tree(random, predicates, behaviors));
    let minterm = |values: &[bool], window: &Window| {
        Minterm::new(atoms.iter().map(|atom| match atom {
            Atom::Predicate(p) => values[p.index()],
            Atom::Done(b) => window.contains(&(b.index(), Status::Success)),
            Atom::Failed(b) => window.contains(&(b.index(), Status::Failure)),
        }))
    };
    let by_rules = |m: &Minterm| {
        let rule = rules
            .iter()
            .find(|(c, _)| c.iter().all(|(a, v)| m.get(*a) == *v));
        rule.map_or(0, |(_, b)| *b)
    };
    // Few valuations, so that paths meet again.
    let pool: Vec<Vec<bool>> = (0..1 + random.below(10))
        .map(|_| (0..predicates).map(|_| random.chance(50)).collect())
        .collect();
    let mut starts: BTreeMap<Minterm, u64> = BTreeMap::new();
    let mut counts: BTreeMap<(Minterm, Id<Behavior>, Status, Option<Minterm>), u64> =
        BTreeMap::new();
    let loose = if random.chance(70) { 0 } else { 50 };
    let mut choices: BTreeMap<Minterm, usize> = BTreeMap::new();
    let never_fails: Vec<bool> = (0..behaviors).map(|_| random.chance(60)).collect();
    for _ in 0..1 + random.below(8) {
        let mut values = pool[random.below(pool.len())].clone();
        let mut window = Window::new();
        if random.chance(25) && history.window > 0 && history.success {
            window.push((random.below(behaviors), Status::Success));
        }
        let mut m = minterm(&values, &window);
        let mut memory = Memory::new();
        for step in 0..random.below(60) {
            // A tree with memory may choose differently in one minterm; no policy can, so the walk ends there.
            let does = match &tree {
                Some(tree) => selects(tree, &memory, &atoms, &m),
                None => by_rules(&m),
            };
            if *choices.entry(m.clone()).or_insert(does) != does {
                break;
            }
            if step == 0 {
                *starts.entry(m.clone()).or_default() += 1;
            }
            let status = match random.below(10) {
                0..5 => Status::Success,
                5..7 if !never_fails[does] => Status::Failure,
                _ => Status::Running,
            };
            if let Some(tree) = &tree {
                let mut first = Some(status);
                let mut leaf = |_| first.take().unwrap_or(Status::Running);
                memory = tick(tree, &memory, &holds(&atoms, &m), &mut leaf).memory;
            }
            let kept = match status {
                Status::Success => history.success,
                Status::Failure => history.failure,
                Status::Running => false,
            };
            if kept {
                window.push((does, status));
                let over = window.len().saturating_sub(history.window);
                window.drain(..over);
            }
            // A chain that has begun is mostly seen to its end.
            if random.chance(if memory.is_empty() { 60 } else { loose }) {
                values = pool[random.below(pool.len())].clone();
            }
            let next = minterm(&values, &window);
            let to = (step != 58).then(|| next.clone());
            *counts.entry((m, Id::new(does), status, to)).or_default() += 1;
            m = next;
        }
    }
    // Some minterms that exploration has seen and the greedy policy does not reach.
    for values in &pool {
        if random.chance(30) {
            let m = minterm(values, &Window::new());
            let does = match &tree {
                Some(tree) => selects(tree, &Memory::new(), &atoms, &m),
                None => by_rules(&m),
            };
            choices.entry(m).or_insert(does);
        }
    }
    if choices.is_empty() {
        let m = minterm(&pool[0], &Window::new());
        choices.insert(m, 0);
    }
    Policy {
        fields: Vec::new(),
        rows: choices
            .into_iter()
            .map(|(minterm, does)| Row {
                behavior: Id::new(does),
                minterm,
                free: None,
                visits: 1,
                values: vec![None; behaviors],
            })
            .collect(),
        starts: starts.into_iter().collect(),
        transitions: counts
            .into_iter()
            .map(|((from, behavior, status, to), count)| Transition {
                from,
                behavior,
                status,
                to,
                count,
            })
            .collect(),
        atoms,
        behaviors: (0..behaviors).map(Id::new).collect(),
        history,
    }
}

/// Rules over a few literals, and often a pair of behaviours that follow each other.
fn rules(random: &mut Random, atoms: &[Atom], predicates: usize, behaviors: usize) -> Vec<Rule> {
    let mut rules: Vec<Rule> = vec![];
    let position = |atom: Atom| atoms.iter().position(|a| *a == atom);
    if behaviors >= 2 && random.chance(75) {
        let shared: Vec<(usize, bool)> = (0..predicates.min(1))
            .map(|_| (random.below(predicates), random.chance(60)))
            .collect();
        let (i, j) = (random.below(behaviors), random.below(behaviors));
        let k = random.below(behaviors);
        let link = |from: usize, fails: bool| {
            position(match fails {
                true => Atom::Failed(Id::new(from)),
                false => Atom::Done(Id::new(from)),
            })
        };
        let fails = random.chance(40);
        if random.chance(30)
            && let Some(c) = link(j, fails)
        {
            rules.push(([shared.clone(), vec![(c, true)]].concat(), k));
        }
        if let Some(c) = link(i, fails) {
            let mut second = shared.clone();
            if predicates > 0 && random.chance(30) {
                second = vec![(random.below(predicates), random.chance(50))];
            }
            second.push((c, true));
            rules.push((second, j));
        }
        rules.push((shared, i));
        // What else there is stands under a literal, as in a tree that was written by hand.
        if predicates > 0 && random.chance(60) {
            let other = random.below(behaviors);
            rules.insert(
                0,
                (vec![(random.below(predicates), random.chance(30))], other),
            );
        }
    }
    for _ in 0..random.below(5) {
        let guard = (0..1 + random.below(3))
            .filter(|_| !atoms.is_empty())
            .map(|_| (random.below(atoms.len()), random.chance(50)));
        rules.push((guard.collect(), random.below(behaviors)));
    }
    rules.push((vec![], random.below(behaviors)));
    rules
}

/// A tree as a person would write it: a few guarded behaviours and chains with memory, and a default.
fn tree(random: &mut Random, predicates: usize, behaviors: usize) -> Node {
    let mut free: Vec<usize> = (0..behaviors).collect();
    let mut children = vec![];
    let leaf = |b: usize| Node::Behavior(Id::new(b));
    while free.len() > 1 && children.len() < 4 && predicates > 0 {
        let length = 1 + random.below(3).min(free.len() - 1);
        let links: Vec<Node> = (0..length)
            .map(|_| leaf(free.swap_remove(random.below(free.len()))))
            .collect();
        let body = match links.as_slice() {
            [one] => one.clone(),
            _ => Node::Composite {
                kind: if random.chance(20) {
                    Composite::Selector
                } else {
                    Composite::Sequence
                },
                memory: true,
                children: links,
            },
        };
        let literal = Guard::Atom(Atom::Predicate(Id::new(random.below(predicates))));
        let guard = if random.chance(30) {
            Guard::Not(Box::new(literal))
        } else {
            literal
        };
        children.push(Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children: vec![Node::Condition(guard), body],
        });
    }
    children.push(leaf(random.below(behaviors)));
    Node::Composite {
        kind: Composite::Selector,
        memory: false,
        children,
    }
}

/// What a tree selects.
fn selects(tree: &Node, memory: &Memory, atoms: &[Atom], minterm: &Minterm) -> usize {
    let ticked = tick(tree, memory, &holds(atoms, minterm), &mut |_| {
        Status::Running
    })
    .ticked;
    ticked[0].index()
}
