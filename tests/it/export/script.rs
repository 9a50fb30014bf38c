//! Programs of other languages, which play what their job says.

use super::play::Tick;
use btc::ir::tree::Status;
use serde_json::Value;
use std::io::Write;
use std::path::PathBuf;
use std::process::{Command, Stdio};

/// What a variable names.
fn named(variable: &str) -> PathBuf {
    let found = std::env::var_os(variable);
    let found = found.unwrap_or_else(|| panic!("{variable} has to name what runs exported trees"));
    found.into()
}

/// A script for the Python that has py_trees.
pub(super) fn py_trees(script: &str) -> Command {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/export");
    let mut command = Command::new(named("BTC_PY_TREES"));
    command.arg(format!("{folder}/{script}"));
    command
}

/// A program of the folder in which those of BehaviorTree.CPP are built.
pub(super) fn btcpp(program: &str) -> Command {
    Command::new(named("BTC_BTCPP").join(program))
}

/// What a program answers to a job.
pub(super) fn run(mut command: Command, job: &Value) -> Value {
    let mut child = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut input = child.stdin.take().unwrap();
    input.write_all(job.to_string().as_bytes()).unwrap();
    drop(input);
    let output = child.wait_with_output().unwrap();
    assert!(output.status.success());
    serde_json::from_slice(&output.stdout).unwrap()
}

/// The plays of an answer.
pub(super) fn plays(answer: &Value) -> Vec<Vec<Tick>> {
    let ticks = |play: &Value| play.as_array().unwrap().iter().map(tick).collect();
    answer["plays"]
        .as_array()
        .unwrap()
        .iter()
        .map(ticks)
        .collect()
}

fn tick(value: &Value) -> Tick {
    let calls = value[0].as_array().unwrap().iter();
    Tick {
        calls: calls.map(|call| call.as_u64().unwrap() as usize).collect(),
        status: match value[1].as_str().unwrap() {
            "S" => Status::Success,
            "F" => Status::Failure,
            _ => Status::Running,
        },
    }
}
