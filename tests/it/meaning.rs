//! What each construct of the language means: a small program for each in `tests/cases/meaning`. Below it stands what it is
//! expected to do, written down by hand from the book, before the program was run.
//!
//! The last comment of a case is a table of columns of the [trace](trace) of its tree `hand`, of each tick or of each
//! decision; columns stand two blanks or more apart. A row is held against the line of its time. A number is met to the digits
//! that it is written with, `7.` to a half; `-` is nothing.

use crate::program;
use btc::driver::Text;
use btc::driver::load::Loaded;
use btc::driver::run::Subject;
use btc::driver::trace::{Step, trace};
use std::path::{Path, PathBuf};

/// The programs, by path.
fn cases() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/meaning");
    let entries = std::fs::read_dir(folder).unwrap();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    assert!(paths.len() > 100);
    paths
}

/// A table that a case expects.
struct Expected {
    step: Step,
    columns: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Expected {
    fn of(text: &str) -> Self {
        let (_, table) = text.rsplit_once("\n// Expected of each ").unwrap();
        let mut lines = table.lines();
        let step = match lines.next().unwrap() {
            "tick:" => Step::Tick,
            "decision:" => Step::Decision,
            other => panic!("what is {other}"),
        };
        let cells = |line: &str| -> Vec<String> {
            let line = line.strip_prefix("// ").unwrap();
            let cells = line.split("  ").map(str::trim);
            let cells = cells.filter(|cell| !cell.is_empty());
            cells.map(str::to_owned).collect()
        };
        let columns = cells(lines.next().unwrap());
        let rows: Vec<Vec<String>> = lines.map(cells).collect();
        assert!(!rows.is_empty() && rows.iter().all(|row| row.len() == columns.len()));
        Self {
            step,
            columns,
            rows,
        }
    }
}

/// The cells of a line of CSV.
fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            other => cells.last_mut().unwrap().push(other),
        }
    }
    cells
}

/// Whether a cell is what was expected.
fn is_met(expected: &str, told: &str) -> bool {
    if let (Ok(expected_number), Ok(told)) = (expected.parse::<f64>(), told.parse::<f64>()) {
        let digits = expected.split_once('.').map(|(_, digits)| digits.len());
        let within = digits.map_or(0.0, |digits| 0.5 * 0.1f64.powi(digits as i32));
        return (expected_number - told).abs() <= within + 1e-6;
    }
    told == if expected == "-" { "" } else { expected }
}

/// The first cell that is not as expected.
fn other_than_expected(loaded: &Loaded, expected: &Expected) -> Option<String> {
    let subject = Subject::tree(loaded, "hand").unwrap();
    let csv = trace(loaded, &subject, 0..1, 1, expected.step)
        .unwrap()
        .csv();
    let mut lines = csv.lines().map(cells);
    let header = lines.next().unwrap();
    let at = |name: &str| header.iter().position(|column| column == name);
    let time = at("time_s").unwrap();
    let lines: Vec<Vec<String>> = lines.collect();
    for row in &expected.rows {
        let Some(line) = lines.iter().find(|line| is_met(&row[0], &line[time])) else {
            return Some(format!("there is no line at {}", row[0]));
        };
        for (name, cell) in expected.columns.iter().zip(row) {
            let Some(column) = at(name) else {
                return Some(format!("there is no column {name}"));
            };
            let told = &line[column];
            if !is_met(cell, told) {
                return Some(format!("at {}: {name} is {told}, not {cell}", row[0]));
            }
        }
    }
    None
}

#[test]
fn constructs_mean_what_the_book_says() {
    let mut wrong = Vec::new();
    for path in cases() {
        let text = std::fs::read_to_string(&path).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        let loaded = program::named(name, &path);
        if loaded.has_errors() {
            wrong.push(program::shown(&loaded));
            continue;
        }
        let found = other_than_expected(&loaded, &Expected::of(&text));
        wrong.extend(found.map(|found| format!("{name}: {found}")));
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Cases are laid out as the formatter does it.
#[test]
fn cases_are_laid_out() {
    for path in cases() {
        let bytes = std::fs::read(&path).unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        let text = Text {
            name,
            bytes: &bytes,
        };
        let laid_out = btc::driver::format::format(text).expect("it parses");
        assert_eq!(laid_out.as_bytes(), bytes, "{name}");
    }
}
