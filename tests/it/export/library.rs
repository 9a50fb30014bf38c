//! BehaviorTree.CPP itself ticks the exported files; what it does is compared with what btc does.
//!
//! The variable `BTC_BTCPP` names the folder in which the programs of `tests/cases/export/btcpp` are built, so these tests run
//! where they are asked for: `BTC_BTCPP=… cargo test export::library -- --ignored`

use super::cpp::{Case, LEARNED, PLAIN, compare, files, on_examples, random};
use super::file::leaves;
use super::{names, script};
use btc::driver::compile::{self, Form};
use btc::emit::btcpp::RESERVED;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use serde_json::{Value, json};

/// Compares with BehaviorTree.CPP itself.
fn compare_itself(program: &Program, cases: &[Case]) {
    let files = files(program, cases);
    let plays = files.iter().zip(cases);
    let mut job = job(program);
    job["plays"] = plays
        .map(|(text, (_, play))| play.as_json("file", text))
        .collect();
    let answer = script::run(script::btcpp("play"), &job);
    let there = script::plays(&answer);
    assert!(compare(program, cases, &there, &files) > 10 * cases.len());
}

/// A job that has the leaves of a program alone.
pub(super) fn job(program: &Program) -> Value {
    let leaves = leaves(program).into_iter();
    let leaves = leaves.map(|((id, ports), (acts, position))| json!([acts, position, id, ports]));
    json!({ "leaves": leaves.collect::<Vec<_>>(), "plays": [] })
}

#[test]
#[ignore = "needs the programs of BehaviorTree.CPP, in the folder that BTC_BTCPP names"]
fn plain_trees_do_the_same_in_each_tick() {
    let program = names().program;
    compare_itself(&program, &random(&program, 300, PLAIN, false));
}

#[test]
#[ignore = "needs the programs of BehaviorTree.CPP, in the folder that BTC_BTCPP names"]
fn learned_trees_do_the_same_in_each_tick() {
    let program = names().program;
    compare_itself(&program, &random(&program, 300, LEARNED, true));
}

#[test]
#[ignore = "needs the programs of BehaviorTree.CPP, in the folder that BTC_BTCPP names"]
fn examples_do_the_same() {
    on_examples(compare_itself);
}

/// What `docs/book/src/export.md` says of the library, tried with it.
#[test]
#[ignore = "needs the programs of BehaviorTree.CPP, in the folder that BTC_BTCPP names"]
fn it_does_what_the_documentation_says() {
    let text = "behavior go\nbehavior rest\ntree steps = memory sequence { go, rest }\n";
    let steps = crate::program::with_text(std::path::Path::new("steps.bt"), text.to_owned());
    let form = Form::Tree(TreeForm::BtCpp);
    let folder = tempfile::tempdir().unwrap();
    let job = json!({
        "file": compile::emit(&steps, form, Some("steps")).unwrap(),
        "folder": folder.path().to_str().unwrap(),
    });
    let mut answer = script::run(script::btcpp("ask"), &job);
    let ids = answer.as_object_mut().unwrap().remove("ids").unwrap();
    let ids = ids.as_array().unwrap().iter();
    let ids: Vec<&str> = ids.map(|id| id.as_str().unwrap()).collect();
    assert!(ids.len() > 30, "{ids:?}");
    let free: Vec<_> = ids.iter().filter(|id| !RESERVED.contains(id)).collect();
    assert!(free.is_empty(), "{free:?}");
    let both_at_once = json!([[2, "SUCCESS"], [2, "SUCCESS"]]);
    let expected = json!({
        "tickExactlyOnce": [[1, "RUNNING"], [1, "SUCCESS"]],
        "tickOnce": both_at_once,
        "tickWhileRunning": both_at_once,
        "endless": ["RUNNING"],
        "leaving, with an exception": "[ReactiveFallback]: only a single child can return RUNNING.",
        "leaving": "RUNNING",
        "bare": false,
        "in a folder": true,
    });
    assert_eq!(answer, expected);
}

/// The header keeps the history that a tree asks as btc does: what ends in a tick is asked for from the next one on.
#[test]
#[ignore = "needs the programs of BehaviorTree.CPP, in the folder that BTC_BTCPP names"]
fn trees_remember_what_they_did() {
    let program = names().program;
    let history = program.tasks.values().next().unwrap().history;
    let cases = [(PLAIN, false), (LEARNED, true)];
    let cases = cases.map(|(kinds, learned)| random(&program, 300, kinds, learned));
    let cases = cases.into_iter().flatten();
    let cases = cases.map(|(root, play)| (root, play.remembering(history)));
    compare_itself(&program, &cases.collect::<Vec<_>>());
}
