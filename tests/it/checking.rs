//! `btc check`: its forms, its folders and its fixes.

use crate::command::{btc, err, out};
use crate::snapshot;
use std::fs;
use std::process::{Command, Stdio};

const WRONG: &str = "use std\n\nlet half: ratio = 3 m\nlet whole: number = 1,\n";

/// A folder with a wrong program, a sound one deeper down, and what is no program.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::create_dir_all(path.join("more/.hidden")).unwrap();
    fs::write(path.join("wrong.bt"), WRONG).unwrap();
    fs::write(path.join("more/sound.bt"), "let half: ratio = 50%\n").unwrap();
    fs::write(path.join("more/.hidden/x.bt"), "no program").unwrap();
    fs::write(path.join("more/notes.txt"), "no program").unwrap();
    folder
}

#[test]
fn diagnostics_have_forms_for_programs() {
    let folder = folder();
    for form in ["short", "github", "json"] {
        let output = btc(folder.path(), &["check", "--format", form, "wrong.bt"]);
        assert_eq!(output.status.code(), Some(1));
        assert_eq!(err(&output), "");
        snapshot::check(&format!("checked@{form}"), out(&output));
    }
    let output = btc(folder.path(), &["check", "--format", "sarif", "wrong.bt"]);
    let log: serde_json::Value = serde_json::from_str(out(&output)).unwrap();
    let run = &log["runs"][0];
    let results = run["results"].as_array().unwrap();
    let rules: Vec<&str> = results
        .iter()
        .map(|result| result["ruleId"].as_str().unwrap())
        .collect();
    assert_eq!(rules, ["E0301", "E0118"]);
    let region = &results[0]["locations"][0]["physicalLocation"]["region"];
    assert_eq!(region["startLine"], 3);
    assert_eq!(region["startColumn"], 19);
    let known = run["tool"]["driver"]["rules"].as_array().unwrap();
    assert!(known.iter().any(|rule| rule["id"] == "E0301"));
}

#[test]
fn a_file_that_is_not_there_is_a_diagnostic() {
    let folder = folder();
    let output = btc(folder.path(), &["check", "--format", "json", "none.bt"]);
    assert_eq!(output.status.code(), Some(1));
    let found: serde_json::Value = serde_json::from_str(out(&output)).unwrap();
    assert_eq!(found["code"], "E0208");
    assert_eq!(found["labels"].as_array().unwrap().len(), 0);
}

#[test]
fn folders_are_walked() {
    let folder = folder();
    let output = btc(folder.path(), &["check", "."]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out(&output), "./more/sound.bt: ok\n");
    assert!(err(&output).ends_with("\n2 errors\n"), "{}", err(&output));
}

/// A file that others use may need what they declare: it is checked as a part of them, while one of them is sound.
#[test]
fn a_used_file_is_checked_with_those_that_use_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("part.bt"), "let quarter: ratio = half / 2\n").unwrap();
    let whole = "use \"part.bt\"\n\nlet half: ratio = 50%\n";
    fs::write(path.join("whole.bt"), whole).unwrap();
    let alone = btc(path, &["check", "part.bt"]);
    assert_eq!(alone.status.code(), Some(1));
    let together = btc(path, &["check", "."]);
    assert_eq!(out(&together), "ok\n");
    assert_eq!(together.status.code(), Some(0), "{}", err(&together));
    fs::write(path.join("whole.bt"), whole.replace("50%", "5 m")).unwrap();
    let broken = btc(path, &["check", "."]);
    assert_eq!(broken.status.code(), Some(1));
    assert!(err(&broken).contains("part.bt:1:22"), "{}", err(&broken));
}

#[test]
fn safe_fixes_are_applied() {
    let folder = folder();
    let output = btc(folder.path(), &["check", "--fix", "wrong.bt"]);
    assert_eq!(output.status.code(), Some(1));
    let text = fs::read_to_string(folder.path().join("wrong.bt")).unwrap();
    assert_eq!(text, WRONG.replace("1,", "1"));
    assert!(err(&output).ends_with("\n1 error\n"), "{}", err(&output));
}

#[test]
fn standard_input_can_have_a_name() {
    let folder = folder();
    let arguments = [
        "check",
        "-",
        "--stdin-file-path",
        "here.bt",
        "--format",
        "short",
    ];
    let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    std::io::Write::write_all(&mut pipe, b"use \"wrong.bt\"\nlet x = 1 m + 1 s\n").unwrap();
    drop(pipe);
    let output = child.wait_with_output().unwrap();
    assert!(
        out(&output).contains("here.bt:2:15: error[E0301]"),
        "{}",
        out(&output)
    );
    assert!(
        out(&output).contains("wrong.bt:3:19: error[E0301]"),
        "{}",
        out(&output)
    );
}
