//! btc, BehaviorTree.CPP and py_trees side by side: random trees of every node in random environments, tick by tick.
//!
//! The variable `BTC_TRACES` says how many are played, 1000 if it is not set. Trace n is made of seed n, so that each can
//! be played again: `BTC_TRACES=100000 cargo test export::traces -- --ignored --nocapture`

use super::play::{Play, Tick};
use super::trees::{Grower, Kinds, atoms};
use super::{library, names, python, script, written};
use crate::laws::random::Random;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::tree::{Guard, Node};
use serde_json::Value;
use std::collections::BTreeMap;
use std::ops::Range;

/// The ticks of a trace.
const TICKS: usize = 40;
/// How many traces are given to the libraries at once.
const AT_ONCE: usize = 5000;

/// The nodes that trees have, and what their conditions are made of.
const NODES: [&str; 18] = [
    "and",
    "behavior",
    "condition",
    "fail",
    "false",
    "invert",
    "memory selector",
    "memory sequence",
    "not",
    "or",
    "parallel",
    "repeat",
    "retry",
    "selector",
    "sequence",
    "succeed",
    "timeout",
    "true",
];

/// The tree of a seed, and what it meets. Every other one is such as are learned.
fn trace(program: &Program, seed: usize) -> (Node, Play) {
    let random = &mut Random::new(seed as u64);
    let atoms = atoms(program);
    let learned = seed % 2 == 1;
    let mut grower = Grower {
        random,
        atoms: &atoms,
        behaviors: program.behaviors.len(),
        kinds: Kinds {
            counters: true,
            timeouts: true,
            all: true,
        },
    };
    let root = match learned {
        false => grower.plain(4),
        true => grower.learned(2),
    };
    (root, Play::new(random, atoms.len(), TICKS, learned))
}

/// What the traces of these seeds are in all three.
struct Played {
    cases: Vec<(Node, Play)>,
    btcpp: Vec<Vec<Tick>>,
    py_trees: Vec<Vec<Tick>>,
}

fn played(program: &Program, seeds: Range<usize>) -> Played {
    let cases: Vec<(Node, Play)> = seeds.map(|seed| trace(program, seed)).collect();
    let job = |form: TreeForm, what: &str| -> Vec<Value> {
        let exported = |(root, play): &(Node, Play)| {
            let text = written(program, root, form).unwrap();
            play.as_json(what, &text)
        };
        cases.iter().map(exported).collect()
    };
    let mut for_btcpp = library::job(program);
    for_btcpp["plays"] = job(TreeForm::BtCpp, "file").into();
    let mut for_py_trees = python::job(program);
    for_py_trees["plays"] = job(TreeForm::PyTrees, "module").into();
    let run = |command, job: &Value| script::plays(&script::run(command, job));
    let (btcpp, py_trees) = std::thread::scope(|scope| {
        let btcpp = scope.spawn(|| run(script::btcpp("play"), &for_btcpp));
        let py_trees = run(script::py_trees("play_py_trees.py"), &for_py_trees);
        (btcpp.join().unwrap(), py_trees)
    });
    Played {
        cases,
        btcpp,
        py_trees,
    }
}

/// The words of the nodes that a tree has.
fn words(node: &Node, found: &mut BTreeMap<String, usize>) {
    let word = match node {
        Node::Condition(guard) => {
            questions(guard, found);
            "condition".to_owned()
        }
        Node::Behavior(_) => "behavior".to_owned(),
        Node::Composite { kind, memory, .. } => kind.word(*memory).to_owned(),
        Node::Parallel { .. } => "parallel".to_owned(),
        Node::Decorator { kind, .. } => kind.word().to_owned(),
    };
    *found.entry(word).or_default() += 1;
    node.children().iter().for_each(|child| words(child, found));
}

fn questions(guard: &Guard, found: &mut BTreeMap<String, usize>) {
    let (word, parts) = match guard {
        Guard::Atom(_) => return,
        Guard::Const(value) => (value.to_string(), [].as_slice()),
        Guard::Not(part) => ("not".to_owned(), std::slice::from_ref(&**part)),
        Guard::And(parts) => ("and".to_owned(), parts.as_slice()),
        Guard::Or(parts) => ("or".to_owned(), parts.as_slice()),
    };
    *found.entry(word).or_default() += 1;
    parts.iter().for_each(|part| questions(part, found));
}

#[test]
#[ignore = "needs the programs of BehaviorTree.CPP and py_trees, which BTC_BTCPP and BTC_PY_TREES name"]
fn all_three_do_the_same_in_each_tick() {
    let traces = std::env::var("BTC_TRACES").map_or(1000, |number| number.parse().unwrap());
    assert!(traces > 0);
    let program = names().program;
    let (mut calls, mut different) = (0, [0; 2]);
    let mut nodes = BTreeMap::new();
    for first in (0..traces).step_by(AT_ONCE) {
        let seeds = first..traces.min(first + AT_ONCE);
        let played = played(&program, seeds.clone());
        assert_eq!(played.btcpp.len(), seeds.len());
        assert_eq!(played.py_trees.len(), seeds.len());
        for (at, (root, play)) in played.cases.iter().enumerate() {
            words(root, &mut nodes);
            let here = play.by_btc(&program, root);
            assert_eq!(here.len(), TICKS);
            calls += here.iter().map(|tick| tick.calls.len()).sum::<usize>();
            let there = [&played.btcpp[at], &played.py_trees[at]];
            let names = ["BehaviorTree.CPP", "py_trees"];
            for ((there, name), different) in there.into_iter().zip(names).zip(&mut different) {
                if *there != here {
                    *different += 1;
                    let tick = here
                        .iter()
                        .zip(there)
                        .position(|(here, there)| here != there);
                    println!("seed {}: {name} differs in tick {tick:?}", first + at);
                }
            }
        }
        println!(
            "{} traces of {TICKS} ticks, {calls} ticks of behaviours; different: {} in BehaviorTree.CPP, {} in py_trees",
            seeds.end, different[0], different[1]
        );
    }
    println!("nodes:");
    nodes
        .iter()
        .for_each(|(word, number)| println!("  {number:>8} {word}"));
    assert_eq!(different, [0, 0]);
    assert_eq!(nodes.keys().collect::<Vec<_>>(), NODES);
    assert!(calls > 10 * traces);
}
