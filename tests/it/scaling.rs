//! Reading, checking and printing cost twice as much for twice as much text, right or wrong.
//!
//! Work is counted in instructions, by Valgrind: `cargo test --test it scaling -- --ignored`. A case is a file of
//! `tests/cases/scaling/`. Its first line says what btc is asked, of `FILE`; in the rest, each group of lines that begin with
//! `*` stands n times, with the number of the copy for `§`, and `SMALL` is the small delivery.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

const SMALL: &str = include_str!("../../examples/delivery_small.bt");

/// The fewest copies of the lines that are written many times.
const COPIES: usize = 120;

/// The instructions that copies have to cost, so that those of a process, which are never quite the same, do not matter; and the most
/// copies that are made for that.
const TOLD: f64 = 500_000.0;
const MOST: usize = 30_000;

/// By how much the second doubling may cost more than the first: 2 if each copy costs the same, 4 if it costs as much as there
/// are copies.
const LIMIT: f64 = 2.5;

fn with_copies(case: &str, copies: usize) -> String {
    let lines: Vec<&str> = case.lines().skip(1).collect();
    let mut text = String::new();
    for group in lines.chunk_by(|one, next| one.starts_with('*') == next.starts_with('*')) {
        let of_group = |number: &str| -> String {
            let line = |line: &&str| {
                let line = line.strip_prefix("* ").or(line.strip_prefix('*'));
                line.unwrap_or_default().replace('§', number) + "\n"
            };
            group.iter().map(line).collect()
        };
        if group.iter().all(|line| line.starts_with('*')) {
            (0..copies).for_each(|copy| text += &of_group(&copy.to_string()));
        } else {
            group.iter().for_each(|line| {
                text += if *line == "SMALL" { SMALL } else { line };
                text.push('\n');
            });
        }
    }
    text
}

/// The instructions that btc takes, and its exit code.
fn instructions(arguments: &[&str], at: &Path) -> (f64, Option<i32>) {
    let btc = std::env::var_os("BTC").unwrap_or_else(|| env!("CARGO_BIN_EXE_btc").into());
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(btc)
        .args(arguments)
        .current_dir(at)
        .output()
        .expect("Valgrind is there");
    let said = String::from_utf8_lossy(&output.stderr);
    let counted = said.lines().find_map(|line| line.split_once("refs:"));
    let (_, counted) = counted.unwrap_or_else(|| panic!("{arguments:?}: {said}"));
    let counted = counted.trim().replace(',', "");
    (counted.parse().unwrap(), output.status.code())
}

/// By how much the second doubling of a case costs more than the first, and what a copy costs.
fn growth(file: &Path, command: &str) -> (f64, f64) {
    let name = file.file_name().unwrap().to_str().unwrap();
    let case = fs::read_to_string(file).unwrap();
    let place = tempfile::tempdir().unwrap();
    let arguments: Vec<&str> = command
        .split(' ')
        .map(|word| if word == "FILE" { name } else { word })
        .collect();
    let mut copies = COPIES;
    loop {
        let works = [1, 2, 4].map(|times| {
            fs::write(place.path().join(name), with_copies(&case, copies * times)).unwrap();
            let (work, code) = instructions(&arguments, place.path());
            let expected = i32::from(name.starts_with("wrong"));
            assert!(
                code == Some(expected) || arguments[0] == "fmt",
                "{name}, {command}: {code:?}"
            );
            work
        });
        let first = works[1] - works[0];
        if first >= TOLD || copies >= MOST {
            return ((works[2] - works[1]) / first, first / copies as f64);
        }
        copies *= 16;
    }
}

#[test]
#[ignore = "needs Valgrind, and takes minutes"]
fn twice_the_text_takes_twice_the_work() {
    let only = std::env::var("BTC_SCALING").unwrap_or_default();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/scaling");
    let mut files: Vec<PathBuf> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.file_name().unwrap().to_str().unwrap().contains(&only))
        .collect();
    files.sort();
    let asked: Vec<(&PathBuf, String)> = files
        .iter()
        .flat_map(|file| {
            let case = fs::read_to_string(file).unwrap();
            let commands = case.lines().next().unwrap().trim_start_matches("// ");
            let commands = commands
                .split("; ")
                .map(|command| (file, command.to_owned()));
            commands.collect::<Vec<_>>()
        })
        .collect();
    assert!(!asked.is_empty(), "there are cases");
    let (next, slow) = (AtomicUsize::new(0), Mutex::new(Vec::new()));
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some((file, command)) = asked.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let (growth, each) = growth(file, command);
                    let name = file.file_name().unwrap().to_str().unwrap();
                    println!("{growth:5.2} {each:>10.0} a copy: {name}, {command}");
                    if growth > LIMIT {
                        let mut slow = slow.lock().unwrap();
                        slow.push(format!("{growth:.2}: {name}, {command}"));
                    }
                }
            });
        }
    });
    let slow = slow.into_inner().unwrap();
    assert!(slow.is_empty(), "{}", slow.join("\n"));
}
