//! Commands that are refused, one in each folder of `tests/cases/refused`: `command` has the arguments of `btc`, and
//! its files stand beside it.

use btc::diagnostic::Code;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// What stands in a folder of the project, in the order of the names.
fn entries(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    paths
}

/// Runs a case in a copy of its folder.
fn refused(case: &Path) -> String {
    let folder = tempfile::tempdir().unwrap();
    for file in fs::read_dir(case).unwrap() {
        let file = file.unwrap();
        fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
    }
    let arguments = fs::read_to_string(case.join("command")).unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments.split_whitespace())
        .current_dir(&folder)
        .stdin(Stdio::null())
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", case.display());
    assert!(output.stdout.is_empty(), "{}", case.display());
    String::from_utf8(output.stderr).unwrap()
}

#[test]
fn a_refused_command_says_why() {
    for case in entries("tests/cases/refused") {
        let name = case.file_name().unwrap().to_str().unwrap();
        crate::snapshot::check(&format!("refused@{name}"), &refused(&case));
    }
}

/// Every code has a case: a snapshot of what a person is shown. The other tests keep the snapshots true.
#[test]
fn every_code_has_a_snapshot() {
    let texts = entries("snapshots").into_iter();
    let texts: Vec<String> = texts
        .map(|path| fs::read_to_string(path).unwrap())
        .collect();
    let shown = |code: &Code| {
        let head = format!("[{code}]: ");
        texts.iter().any(|text| text.contains(&head))
    };
    let without: Vec<&Code> = Code::ALL.iter().filter(|code| !shown(code)).collect();
    // A tree that is not equal to its policy is a bug of btc: its test stands beside `driver::decanonicalize`. That a
    // program has changed, the tests of results tell; what is too large, those of limits.
    let elsewhere = [Code::E0132, Code::E0609, Code::W0203];
    assert_eq!(without, elsewhere.iter().collect::<Vec<_>>());
}
