//! Reading, checking and printing cost twice as much for twice as much text, right or wrong.
//!
//! Work is counted in instructions, by Valgrind: `cargo test --test it scaling -- --ignored`. A case is a file of
//! `tests/cases/scaling/`. Its first line says what btc is asked, of `FILE`; in the rest, each group of lines that begin with
//! `*` stands n times, with the number of the copy for `§`, and `SMALL` is the small delivery.

use std::fs;
use std::path::Path;
use std::process::Command;

const SMALL: &str = include_str!("../../examples/delivery_small.bt");

/// The fewest copies of the lines that are written many times.
const COPIES: usize = 120;

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
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(env!("CARGO_BIN_EXE_btc"))
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

#[test]
#[ignore = "needs Valgrind, and takes minutes"]
fn twice_the_text_takes_twice_the_work() {
    let only = std::env::var("BTC_SCALING").unwrap_or_default();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/scaling");
    let entries = fs::read_dir(folder).unwrap();
    let mut files: Vec<_> = entries.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let mut slow = Vec::new();
    let mut asked = 0;
    for file in files {
        let name = file.file_name().unwrap().to_str().unwrap();
        if !name.contains(&only) {
            continue;
        }
        let case = fs::read_to_string(&file).unwrap();
        let commands = case.lines().next().unwrap().trim_start_matches("// ");
        let place = tempfile::tempdir().unwrap();
        for command in commands.split("; ") {
            let arguments: Vec<&str> = command
                .split(' ')
                .map(|word| if word == "FILE" { name } else { word })
                .collect();
            let works = [1, 2, 4].map(|times| {
                fs::write(place.path().join(name), with_copies(&case, COPIES * times)).unwrap();
                let (work, code) = instructions(&arguments, place.path());
                let expected = i32::from(name.starts_with("wrong"));
                assert!(
                    code == Some(expected) || arguments[0] == "fmt",
                    "{name}, {command}: {code:?}"
                );
                work
            });
            let growth = (works[2] - works[1]) / (works[1] - works[0]);
            let each = (works[1] - works[0]) / COPIES as f64;
            println!("{growth:5.2} {each:>10.0} a copy: {name}, {command}");
            if growth > LIMIT {
                slow.push(format!("{growth:.2}: {name}, {command}"));
            }
            asked += 1;
        }
    }
    assert!(asked > 0, "there are cases");
    assert!(slow.is_empty(), "{}", slow.join("\n"));
}
