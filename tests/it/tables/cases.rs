//! Tables as files.

use super::{USUAL, compared, loaded, made, shown, text};
use crate::program::{self, NoFiles};
use crate::snapshot;
use btc::diagnostic::Code;
use btc::driver::canonicalize::{self, Form};
use btc::driver::decanonicalize::Options;
use btc::driver::load::load;
use btc::driver::table::Recorded;
use btc::driver::verify;
use btc::ir::tree::Node;
use btc::tree::unit;
use std::collections::BTreeSet;
use std::path::Path;

/// Goes through the files of a folder of cases, with the name and the bytes of each, and snapshots what is made of it.
fn each(folder: &str, name: &str, of: impl Fn(&str, &[u8]) -> String) {
    let mut settings = crate::snapshot::settings();
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/tables");
    let mut files: Vec<_> = std::fs::read_dir(base.join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .collect();
    files.sort();
    assert!(!files.is_empty());
    for path in files {
        let file = path.file_name().unwrap().to_str().unwrap();
        let bytes = std::fs::read(&path).unwrap();
        settings.set_snapshot_suffix(file);
        settings.bind(|| insta::assert_snapshot!(name, of(file, &bytes)));
    }
}

#[test]
fn wrong_tables_are_told_what_is_wrong() {
    each("broken", "table_broken", |name, bytes| {
        let refused = made(text(name, bytes), None, &USUAL).expect_err(name);
        let mut places = BTreeSet::new();
        for found in &refused.diagnostics {
            let span = found.span();
            let source = refused.sources.get(span.file).unwrap();
            assert!(source.text.get(span.range()).is_some(), "{name}: {found:?}");
            let place = (span.start, span.end, found.message.clone());
            assert!(places.insert(place), "{name}: told twice: {found:?}");
        }
        shown(&refused)
    });
}

/// Whether a guard stands before nothing but another guard: `a => b => c`.
fn has_a_chain(node: &Node) -> bool {
    let chained = unit::parts(node).is_some_and(|(_, body)| unit::parts(body).is_some());
    chained || node.children().iter().any(has_a_chain)
}

#[test]
fn good_tables_become_trees_that_are_equal_to_them() {
    each("good", "table_good", |name, bytes| {
        let table = text(name, bytes);
        let made = made(table, None, &USUAL).unwrap_or_else(|r| panic!("{}", shown(&r)));
        let proved = compared(&made, table);
        assert!(proved.holds(), "{}", proved.text);
        // The program is laid out as the formatter does it.
        let formatted = btc::driver::format::format(text(name, made.text.as_bytes()));
        assert_eq!(formatted.unwrap(), made.text);
        assert_eq!(made.warnings, Vec::<String>::new());
        let root = &made.program.trees[made.tree].root;
        assert!(!has_a_chain(root), "{}", made.text);
        format!("{}\n{}\n{}", made.text, made.report.join("\n"), proved.text)
    });
}

/// The rest of a row's cells does not matter: order of rows, of columns, repetition.
#[test]
fn the_order_of_rows_changes_nothing_but_that_of_the_behaviours() {
    let there = "a,b,c,behavior,q:x,q:y\n1,0,-,x,1,0\n0,1,-,y,0,1\n0,0,0,x,1,0\n1,1,-,y,0,1\n";
    let mut rows: Vec<&str> = there.lines().skip(1).collect();
    rows.reverse();
    rows.push(rows[1]);
    let back = format!("a,b,c,behavior,q:x,q:y\n{}\n", rows.join("\n"));
    let tree = |table: &str| {
        made(text("t.csv", table.as_bytes()), None, &USUAL)
            .unwrap()
            .text
    };
    assert_eq!(tree(there), tree(&back));
}

fn recorded(name: &str) -> Vec<u8> {
    let base = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/tables/recorded");
    std::fs::read(base.join(name)).unwrap()
}

/// Memory is proved along the transitions of a table, from start minterms in the same file or in one of their own.
#[test]
fn transitions_allow_memory() {
    let policy = recorded("policy.csv");
    let table = text("policy.csv", &policy);
    let (whole, bare, starts) = (
        recorded("transitions.csv"),
        recorded("without_starts.csv"),
        recorded("starts.csv"),
    );
    let whole = Recorded {
        transitions: text("transitions.csv", &whole),
        starts: None,
    };
    let two = Recorded {
        transitions: text("transitions.csv", &bare),
        starts: Some(text("starts.csv", &starts)),
    };
    let with = |recorded| made(table, Some(recorded), &USUAL);
    let tree = with(whole).unwrap();
    snapshot::check(
        "table_recorded",
        &format!("{}\n{}\n", tree.text, tree.report.join("\n")),
    );
    assert!(tree.text.contains("memory sequence"));
    assert_eq!(tree.text, with(two).unwrap().text);
    let none = Recorded {
        starts: None,
        ..two
    };
    let refused = with(none).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, Code::E0818);
    // The tree remembers what the table tells by its history: they are equal along the transitions.
    let program = loaded(&tree);
    let proved = verify::table(&program, "learned", (table, None), Some(whole)).unwrap();
    snapshot::check("table_recorded_verified", &proved.text);
    assert!(proved.holds());
}

#[test]
fn a_tree_that_decides_otherwise_is_told_the_lines() {
    let table = "low,near,behavior\n1,0,dock\n0,1,wander\n1,1,dock\n0,0,dock\n";
    let program = "predicate low\npredicate near\nbehavior dock\nbehavior wander\n\
                   tree other = selector { low and near => wander, dock }\n\
                   tree hasty = sequence { dock, wander }\n\
                   tree asks = selector { far => wander, dock }\npredicate far\n";
    let loaded = load("other.bt", program.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    let table = text("t.csv", table.as_bytes());
    let proved = verify::table(&loaded, "other", (table, None), None).unwrap();
    assert!(!proved.holds());
    snapshot::check("table_verify_rows", &proved.text);
    let code = |tree| {
        let refused = verify::table(&loaded, tree, (table, None), None).unwrap_err();
        refused.diagnostics[0].code
    };
    let hasty = verify::table(&loaded, "hasty", (table, None), None).unwrap();
    assert!(hasty.text.contains("t.csv:3: "), "{}", hasty.text);
    assert_eq!(code("asks"), Code::E0610);
    assert_eq!(code("nobody"), Code::E0504);
}

/// All that a row allows is told.
#[test]
fn what_a_row_allows_is_told_whole() {
    let table = "low,behavior\n1,dock|wander\n0,wander\n";
    let program = "predicate low\nbehavior dock\nbehavior wander\nbehavior stop\n\
                   tree other = selector { low => stop, wander }\n";
    let loaded = load("other.bt", program.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    let table = text("t.csv", table.as_bytes());
    let proved = verify::table(&loaded, "other", (table, None), None).unwrap();
    let says = "t.csv:2: {low}: the table says dock|wander, `other` selects stop";
    assert!(proved.text.contains(says), "{}", proved.text);
}

/// Two trees of a program that has declared names alone.
#[test]
fn trees_without_a_task_are_compared() {
    let program = "predicate low\nbehavior a\nbehavior b\n\
                   tree one = selector { low => a, b }\n\
                   tree two = selector { not low => b, a }\n\
                   tree held = memory sequence { a, b }\n\
                   tree asked = selector { done(a) => b, a }\n";
    let loaded = load("bare.bt", program.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    let compared = |a, b| verify::trees(&loaded, a, b).unwrap();
    assert!(compared("one", "two").holds());
    let parted = compared("one", "held");
    assert!(!parted.holds());
    let proved = compared("held", "asked");
    snapshot::check(
        "table_verify_trees",
        &format!("{}\n{}\n", parted.text, proved.text),
    );
}

/// The example of an explanation that follows a heading.
fn example(code: Code, heading: &str, language: &str) -> &'static str {
    let explanation = code.explanation();
    let start = format!("\n{heading}:\n\n```{language}\n");
    let at = explanation.find(&start);
    let at = at.unwrap_or_else(|| panic!("{code} has no example under {heading}")) + start.len();
    let length = explanation[at..].find("\n```").unwrap();
    &explanation[at..=at + length]
}

/// E0811 to E0818: the wrong example of an explanation provokes its code and nothing else, the right one nothing.
#[test]
fn explanations_of_tables_are_true() {
    let slack = Options {
        slack: 0.1,
        ..USUAL
    };
    let codes = [
        Code::E0811,
        Code::E0812,
        Code::E0813,
        Code::E0814,
        Code::E0815,
        Code::E0816,
        Code::E0817,
    ];
    for code in codes {
        let options = if code == Code::E0817 { &slack } else { &USUAL };
        let table = |heading| text("t.csv", example(code, heading, "csv").as_bytes());
        let refused = made(table("Wrong"), None, options).expect_err(code.name());
        assert!(
            refused.diagnostics.iter().all(|found| found.code == code),
            "{code}: {}",
            shown(&refused)
        );
        assert!(made(table("Right"), None, options).is_ok(), "{code}");
    }
    let code = Code::E0818;
    let table = text("t.csv", b"battery_low,behavior\n0,deliver\n1,dock\n");
    let with = |heading| {
        let transitions = text("transitions.csv", example(code, heading, "csv").as_bytes());
        let recorded = Recorded {
            transitions,
            starts: None,
        };
        made(table, Some(recorded), &USUAL)
    };
    let refused = with("Wrong").unwrap_err();
    assert_eq!(refused.diagnostics[0].code, code);
    assert!(with("Right").is_ok());
}

/// E0819: the place is that of the behaviour whose status decides.
#[test]
fn the_explanation_of_trees_without_canonical_form_is_true() {
    let code = Code::E0819;
    let program = |heading| {
        let text = example(code, heading, "bt");
        let loaded = load("t.bt", text.into(), &mut NoFiles);
        assert_eq!(program::shown(&loaded), "");
        loaded
    };
    let wrong = program("Wrong");
    let refused = canonicalize::canonicalize(&wrong, "hasty", Form::Csv).unwrap_err();
    let found = &refused.diagnostics[0];
    assert_eq!(
        (found.code, wrong.sources.text(found.span())),
        (code, "open")
    );
    assert!(canonicalize::canonicalize(&program("Right"), "patient", Form::Csv).is_ok());
}
