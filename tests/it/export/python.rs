//! py_trees itself ticks the exported modules; what it does is compared with what btc does.
//!
//! The variable `BTC_PY_TREES` names a Python that can import py_trees, so these tests run where they are asked for:
//! `BTC_PY_TREES=… cargo test export::python -- --ignored`

use super::file::is_of_another_robot;
use super::play::{Play, Tick};
use super::script;
use super::trees::{Grower, Kinds, atoms, subjects};
use super::{names, written};
use crate::examples::{self, example};
use crate::laws::build::{decorated, leaf, parallel};
use crate::laws::random::Random;
use btc::driver::compile;
use btc::driver::compile::Form;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::tree::{Decorator, Node, Status};
use serde_json::{Value, json};

/// The module of a tree.
fn module(program: &Program, root: &Node) -> String {
    written(program, root, TreeForm::PyTrees).unwrap()
}

/// A job that has the modules of single leaves alone: by what they call, the leaves of other modules are known.
pub(super) fn job(program: &Program) -> Value {
    // The place of a leaf of another robot stays empty: it has the name of one of ours.
    let module_of = |node: &Node| match is_of_another_robot(program, node) {
        true => String::new(),
        false => module(program, node),
    };
    let modules = |nodes: Vec<Node>| -> Vec<String> { nodes.iter().map(module_of).collect() };
    let (asked, done) = subjects(program);
    json!({
        "conditions": modules(asked),
        "behaviors": modules(done),
        "plays": [],
        "programs": [],
    })
}

/// What py_trees does in each play, and what the programs print.
fn run(
    program: &Program,
    plays: &[(String, Play)],
    programs: &[String],
) -> (Vec<Vec<Tick>>, Vec<String>) {
    let plays: Vec<Value> = plays
        .iter()
        .map(|(module, play)| play.as_json("module", module))
        .collect();
    let mut asked = job(program);
    asked["plays"] = plays.into();
    asked["programs"] = programs.into();
    let answer = script::run(script::py_trees("play_py_trees.py"), &asked);
    let drawn = answer["drawn"].as_array().unwrap().iter();
    let drawn = drawn.map(|text| text.as_str().unwrap().to_owned());
    (script::plays(&answer), drawn.collect())
}

/// Compares the plays of trees with btc's.
fn compare(program: &Program, cases: Vec<(Node, Play)>) {
    let plays: Vec<(String, Play)> = cases
        .iter()
        .map(|(root, play)| (module(program, root), play.clone()))
        .collect();
    let (there, _) = run(program, &plays, &[]);
    let mut calls = 0;
    for (((root, play), there), (text, _)) in cases.iter().zip(&there).zip(&plays) {
        let here = play.by_btc(program, root);
        if let Some(at) = (0..here.len()).find(|&at| here[at] != there[at]) {
            panic!(
                "tick {at}: {:?} here, {:?} there\n{text}",
                here[at], there[at]
            );
        }
        calls += here.iter().map(|tick| tick.calls.len()).sum::<usize>();
    }
    assert!(calls > 10 * cases.len(), "{calls} calls");
}

/// Random trees of these kinds with their plays.
fn random(program: &Program, kinds: Kinds, learned: bool) -> Vec<(Node, Play)> {
    let atoms = atoms(program);
    let cases = (0..300).map(|seed| {
        let random = &mut Random::new(seed);
        let mut grower = Grower {
            random,
            atoms: &atoms,
            behaviors: program.behaviors.len(),
            kinds,
        };
        let root = match learned {
            false => grower.plain(4),
            true => grower.learned(2),
        };
        let play = Play::new(random, atoms.len(), 40, learned);
        (root, play)
    });
    cases.collect()
}

/// Trees of every node, tick by tick.
#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn plain_trees_do_the_same_in_each_tick() {
    let kinds = Kinds {
        counters: true,
        timeouts: true,
        all: true,
    };
    let loaded = names();
    compare(&loaded.program, random(&loaded.program, kinds, false));
}

#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn learned_trees_do_the_same_in_each_tick() {
    let kinds = Kinds {
        counters: true,
        timeouts: false,
        all: false,
    };
    let loaded = names();
    compare(&loaded.program, random(&loaded.program, kinds, true));
}

#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn examples_do_the_same() {
    for name in examples::names() {
        let program = example(&name).program;
        let atoms = atoms(&program);
        let mut cases = Vec::new();
        for tree in program.trees.values() {
            for seed in 0..20 {
                let play = Play::new(&mut Random::new(seed), atoms.len(), 60, false);
                cases.push((tree.root.clone(), play));
            }
        }
        compare(&program, cases);
    }
}

/// A `parallel` in which every child has to succeed asks its conditions anew in each tick.
#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn a_parallel_does_the_same() {
    let loaded = names();
    let program = &loaded.program;
    let (asked, _) = subjects(program);
    let atoms = atoms(program);
    let cases = (0..40).map(|seed| {
        let random = &mut Random::new(seed);
        let low = asked[random.below(2)].clone();
        let root = parallel(2, vec![leaf(random.below(3)), low]);
        (root, Play::new(random, atoms.len(), 40, false))
    });
    compare(program, cases.collect());
}

/// A timeout fails in the tick in which btc's does, without another tick of its child.
#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn a_timeout_fails_in_the_same_tick() {
    let loaded = names();
    let program = &loaded.program;
    let root = decorated(Decorator::Timeout(3), leaf(1));
    let play = Play::new(&mut Random::new(1), atoms(program).len(), 80, false).all_running();
    let here = play.by_btc(program, &root);
    let failures = here.iter().filter(|tick| tick.status == Status::Failure);
    assert_eq!(failures.count(), 20);
    compare(program, vec![(root, play)]);
}

/// A module keeps the history that its tree asks as btc does: what ends in a tick is asked for from the next one on.
#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn modules_remember_what_their_trees_did() {
    let loaded = names();
    let program = &loaded.program;
    let history = program.tasks.values().next().unwrap().history;
    let kinds = Kinds {
        counters: true,
        timeouts: false,
        all: true,
    };
    let cases = [false, true].map(|learned| random(program, kinds, learned));
    let cases = cases.into_iter().flatten();
    compare(
        program,
        cases
            .map(|(root, play)| (root, play.remembering(history)))
            .collect(),
    );
}

/// Run as a program, a module draws its tree.
#[test]
#[ignore = "needs py_trees, in the Python that BTC_PY_TREES names"]
fn modules_draw_themselves() {
    let loaded = names();
    let form = Form::Tree(TreeForm::PyTrees);
    let text = compile::emit(&loaded, form, Some("everything")).unwrap();
    let (_, drawn) = run(&loaded.program, &[], &[text]);
    crate::snapshot::check("names.everything.py.drawn", &drawn[0]);
}
