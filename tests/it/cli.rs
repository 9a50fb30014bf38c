//! The command line: what it writes where, and its exit codes.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SMALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/delivery_small.bt");

fn btc(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn piped(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(input).unwrap();
    drop(pipe);
    child.wait_with_output().unwrap()
}

fn out(output: &Output) -> &str {
    std::str::from_utf8(&output.stdout).unwrap()
}

fn err(output: &Output) -> &str {
    std::str::from_utf8(&output.stderr).unwrap()
}

#[test]
fn a_program_without_mistakes_is_ok() {
    let output = btc(&["check", SMALL]);
    assert_eq!(
        (output.status.code(), out(&output), err(&output)),
        (Some(0), "ok\n", "")
    );
}

#[test]
fn mistakes_give_exit_code_1_and_a_bad_command_line_2() {
    let wrong = b"state battery: ratio = 3 m\n";
    let output = piped(&["check", "-"], wrong);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("<stdin>:1:24"), "{}", err(&output));
    assert_eq!(btc(&["check", "/no/such/file.bt"]).status.code(), Some(1));
    for usage in [
        &["chek", SMALL][..],
        &["check"],
        &["run", SMALL],
        &["run", SMALL, "--tree", "expert", "--episodes", "0"],
        &["verify", SMALL, "expert"],
        &["learn", "-"],
        &["compile", SMALL, "--emit", "pdf"],
        &["explain", "E9999"],
    ] {
        assert_eq!(btc(usage).status.code(), Some(2), "{usage:?}");
    }
}

#[test]
fn what_is_no_text_is_a_located_mistake() {
    let output = piped(&["check", "-"], b"state a: bool = \xff\xfe\n");
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("E0130"), "{}", err(&output));
    assert_eq!(piped(&["fmt", "-"], b"\xff").status.code(), Some(1));
    let nothing = piped(&["check", "-"], b"");
    assert_eq!(nothing.status.code(), Some(0));
}

#[test]
fn names_that_are_not_there_are_offered_likely_ones() {
    let output = btc(&["run", SMALL, "--tree", "exprt"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        err(&output).contains("did you mean `expert`?"),
        "{}",
        err(&output)
    );
}

#[test]
fn formatting_is_a_fixed_point_and_keeps_comments() {
    let text = fs::read(SMALL).unwrap();
    let output = piped(&["fmt", "-"], &text);
    assert_eq!(output.stdout, text);
    assert_eq!(btc(&["fmt", "--check", SMALL]).status.code(), Some(0));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.bt");
    fs::write(&file, "// kept\nstate   a:bool=true // too\n").unwrap();
    let path = file.to_str().unwrap();
    assert_eq!(btc(&["fmt", "--check", path]).status.code(), Some(1));
    assert_eq!(btc(&["fmt", path]).status.code(), Some(0));
    let text = fs::read_to_string(&file).unwrap();
    assert_eq!(text, "// kept\nstate a: bool = true // too\n");
    let broken = piped(&["fmt", "-"], b"state = \n");
    assert_eq!((broken.status.code(), out(&broken)), (Some(1), ""));
}

#[test]
fn learning_writes_whole_files_that_other_commands_take() {
    let folder = tempfile::tempdir().unwrap();
    let learn = |name: &str, threads: &str| {
        let to = folder.path().join(name);
        let output = btc(&[
            "learn",
            SMALL,
            "-o",
            to.to_str().unwrap(),
            "--episodes",
            "100",
            "--roll-outs",
            "50",
            "--threads",
            threads,
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        assert!(out(&output).starts_with("/// Learned from delivery_small.bt, seed 1: "));
        to
    };
    let (one, two) = (learn("one", "1"), learn("two", "2"));
    let files = |folder: &Path| {
        let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap())
            .map(|entry| {
                let name = entry.file_name().into_string().unwrap();
                (name, fs::read(entry.path()).unwrap())
            })
            .collect();
        files.sort();
        files
    };
    let first = files(&one);
    assert_eq!(first, files(&two));
    let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
    for name in [
        "curve.csv",
        "learned.bt",
        "learned.dot",
        "metrics.json",
        "policy.csv",
        "q.csv",
        "transitions.csv",
    ] {
        assert!(names.contains(&name), "{names:?}");
    }
    let program = one.join("learned.bt");
    let program = program.to_str().unwrap();
    let verified = btc(&["verify", program, "learned", "expert"]);
    assert_eq!(verified.status.code(), Some(0), "{}", err(&verified));
    let by_tree = btc(&[
        "run",
        program,
        "--tree",
        "learned",
        "--episodes",
        "5",
        "--format",
        "json",
    ]);
    let policy = one.join("policy.csv");
    let by_policy = btc(&[
        "run",
        program,
        "--policy",
        policy.to_str().unwrap(),
        "--episodes",
        "5",
        "--format",
        "json",
    ]);
    assert_eq!(by_tree.status.code(), Some(0), "{}", err(&by_tree));
    assert_eq!(by_tree.stdout, by_policy.stdout);
}

#[test]
fn a_broken_table_is_a_located_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("policy.csv");
    fs::write(
        &table,
        "carrying_package,battery_low,behavior\n1,0,goto(B)\n1,2,goto(A)\n",
    )
    .unwrap();
    let output = btc(&["run", SMALL, "--policy", table.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("policy.csv:3:3"), "{}", err(&output));
}

#[test]
fn every_code_is_explained() {
    let list = btc(&["explain"]);
    assert!(out(&list).lines().count() > 40);
    let output = btc(&["explain", "e0301"]);
    assert!(out(&output).starts_with("# E0301"));
}
