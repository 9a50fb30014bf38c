//! Scripts of other languages, which play what their job says.

use super::play::Tick;
use btc::ir::tree::Status;
use serde_json::Value;
use std::ffi::{OsStr, OsString};
use std::io::Write;
use std::process::{Command, Stdio};

/// The Python that a variable names.
pub(super) fn python(variable: &str) -> OsString {
    let found = std::env::var_os(variable);
    found.unwrap_or_else(|| panic!("{variable} has to name a Python to run exported trees with"))
}

/// What a script answers to a job.
pub(super) fn run(python: &OsStr, script: &str, job: &Value) -> Value {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/export");
    let mut child = Command::new(python)
        .arg(format!("{folder}/{script}"))
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
