//! `btc diff` and `btc test`: which decisions have changed, in words and for tools.

use crate::snapshot;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

fn btc(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn out(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn err(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

fn cases() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/diff")
}

#[test]
fn a_changed_tree_is_told_by_its_decisions() {
    for form in ["human", "markdown", "json", "github"] {
        let output = btc(&cases(), &["diff", "old.bt", "new.bt", "--format", form]);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        snapshot::check(&format!("diff@{form}"), out(&output));
    }
}

#[test]
fn another_shape_is_proved_equal() {
    let output = btc(&cases(), &["diff", "old.bt", "reshaped.bt"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        out(&output),
        "equal: `carry` of reshaped.bt has another shape than `carry` of old.bt and decides the same, both \
         reduce to the same circuit\n"
    );
    let output = btc(&cases(), &["diff", "old.bt", "old.bt"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(out(&output).starts_with("same: "), "{}", out(&output));
}

#[test]
fn tables_are_compared_as_trees_are() {
    let output = btc(&cases(), &["diff", "old.csv", "new.csv"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(
        out(&output).ends_with("\n  not carrying and low: dock → goto_a\n"),
        "{}",
        out(&output)
    );
    let output = btc(&cases(), &["diff", "old.csv", "old.bt"]);
    assert_eq!(output.status.code(), Some(0), "{}", out(&output));
}

/// A world in which two rewards lead to two trees.
fn world(folder: &Path, at_gate: &str) {
    let world = format!(
        "use std

world yard {{
    tick  = 100 ms
    arena = rect((0 m, 0 m), (4 m, 2 m))
    place shed = disc((0.5 m, 1 m), 20 cm)
    place gate = disc((3.5 m, 1 m), 20 cm)
    robot mower {{
        body  = disc(17 cm)
        drive = differential(max_speed = 0.5 m/s, max_turn = 3 rad/s)
    }}
}}

event at_shed = success(goto(shed))
event at_gate = success(goto(gate))
predicate west = position.x < 2 m

task mow {{
    observe west
    choose  goto(shed), goto(gate)
    end on at_shed
    end on at_gate
    end after 1 min
    reward {{
        on at_shed: 1
        on at_gate: {at_gate}
        per 1 s:    -0.01
    }}
}}

learn mow {{ episodes = 300 }}
"
    );
    fs::write(folder.join("yard.bt"), world).unwrap();
}

#[test]
fn learned_trees_are_held_against_snapshots() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let test = |more: &[&str]| {
        let arguments = [
            &["test", ".", "--shape", "exact", "--episodes", "200"],
            more,
        ]
        .concat();
        btc(path, &arguments)
    };
    world(path, "-1");
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("no snapshot yet"), "{}", out(&output));
    let output = test(&["--accept"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        err(&output).lines().last(),
        Some("0 passed, 0 failed, 1 accepted")
    );
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(out(&output), "./yard.learned.bt: ok\n");

    world(path, "5");
    let before = fs::read_to_string(path.join("yard.learned.bt")).unwrap();
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        out(&output).contains("goto(shed) → goto(gate)"),
        "{}",
        out(&output)
    );
    assert!(out(&output).contains("return "), "{}", out(&output));
    let after = fs::read_to_string(path.join("yard.learned.bt")).unwrap();
    assert_eq!(before, after);
    let output = test(&["--review"]);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));
}
