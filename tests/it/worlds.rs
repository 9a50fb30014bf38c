//! The sample worlds of `tests/worlds/`, which no part of btc was tuned for: benches learn from them.

use btc::driver::Text;
use btc::driver::format::format;
use btc::{LearnOptions, Program};
use std::fs;
use std::path::{Path, PathBuf};

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let entries = fs::read_dir(folder).unwrap();
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "bt"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

/// The program of a file, which is free of mistakes, and laid out.
fn program(path: &Path) -> Program {
    let program = Program::from_file(path).unwrap();
    let text = fs::read_to_string(path).unwrap();
    let (name, bytes) = ("world.bt", text.as_bytes());
    let laid_out = format(Text { name, bytes }).expect("it parses");
    assert_eq!(text, laid_out, "{path:?} is not laid out");
    program
}

/// A hand tree that earns nothing would be no measure for a learned one.
#[test]
fn hand_trees_earn_something() {
    for path in files("tests/worlds") {
        let program = program(&path);
        assert!(program.warnings().is_empty(), "{path:?} has warnings");
        let episodes = program.run("hand", 10, 1).unwrap();
        assert!(episodes.summary.total.mean > 0.0, "{path:?}");
    }
}

#[test]
fn traps_can_be_learned_from() {
    for path in files("tests/worlds/traps") {
        let options = LearnOptions {
            episodes: Some(40),
            roll_outs: 10,
            ..LearnOptions::default()
        };
        program(&path).learn(&options).unwrap();
    }
}
