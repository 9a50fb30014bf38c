//! The files of a policy read back exactly, and mistakes in them have a place.

use super::random::policy;
use super::small_delivery;
use crate::program::called;
use crate::snapshot::check;
use btc::ir::law::Behavior;
use btc::ir::program::{Predicate, Program};
use btc::policy::error::{TableError, TableErrorKind};
use btc::policy::{Policy, Value, decisions, evidence, transitions};

/// A program with names as families have them.
pub(crate) fn program() -> Program {
    let mut program = Program::default();
    for i in 0..13 {
        let name = match i {
            0 => called("carrying_package"),
            1 => called("battery_low"),
            _ => called(&format!("near(oak, p{i})")),
        };
        program.predicates.push(Predicate { name, when: None });
    }
    for name in [
        "goto(A)",
        "goto(B)",
        "goto(C)",
        "dock(C)",
        "swap(A, B)",
        "wander",
        "idle",
    ] {
        program.behaviors.push(Behavior {
            name: called(name),
            law: None,
        });
    }
    program
}

/// A policy with evidence of all sizes.
fn with_evidence(mut policy: Policy) -> Policy {
    for (i, row) in policy.rows.iter_mut().enumerate() {
        row.visits = i as u64 * 7;
        for (j, value) in row.values.iter_mut().enumerate() {
            *value = (i + j).is_multiple_of(3).then(|| Value {
                visits: (i * j) as u64,
                q: (1.0 + i as f64) / (3.0 + j as f64) * if j == 1 { -1e-300 } else { 1.0 },
                squares: (i as f64 + 0.1).powi(9),
            });
        }
    }
    policy
}

#[test]
fn policies_read_back_exactly() {
    let program = program();
    let random = (1..=40)
        .map(policy)
        .filter(|policy| !policy.atoms.is_empty());
    for written in random.chain([small_delivery::policy()]) {
        let written = with_evidence(written);
        let mut read =
            decisions::read(&decisions::write(&written, &program), &program, None).unwrap();
        transitions::read(&transitions::write(&written, &program), &program, &mut read).unwrap();
        evidence::read(&evidence::write(&written, &program), &program, &mut read).unwrap();
        // A table alone does not say how long the window is.
        read.history = written.history;
        assert_eq!(read, written);
    }
}

#[test]
fn the_files_of_small_delivery() {
    let policy = small_delivery::policy();
    check(
        "small_delivery.policy.csv",
        &decisions::write(&policy, &program()),
    );
    check(
        "small_delivery.transitions.csv",
        &transitions::write(&policy, &program()),
    );
}

#[test]
fn a_dash_stands_for_both_values() {
    let text = "carrying_package,battery_low,behavior\n1,-,goto(A)\n0,0,goto(B)\n";
    let policy = decisions::read(text, &program(), None).unwrap();
    assert_eq!(policy.rows.len(), 3);
    assert_eq!(policy.behaviors.len(), 2);
    assert_eq!(policy.history.window, 0);
}

/// Reads a wrong table with one mistake; gives the text that it is about, and what it is.
fn mistake(text: &str) -> (String, TableErrorKind) {
    let mut mistakes = decisions::read(text, &program(), None).unwrap_err();
    assert_eq!(mistakes.len(), 1, "{mistakes:?}");
    let TableError { span, kind } = mistakes.remove(0);
    (text[span].to_owned(), kind)
}

#[test]
fn mistakes_have_a_place() {
    let head = "carrying_package,battery_low,behavior\n";
    let cases: [(&str, &str, &str); 8] = [
        (
            "0,1,goto(A)\n0,1,goto(B)\n",
            "0,1,goto(B)",
            "Contradiction { earlier: 38..49, overlap: None }",
        ),
        (
            "0,1,goto(A)\n0,-,goto(B)\n",
            "0,-,goto(B)",
            "Contradiction { earlier: 38..49, overlap: Some(\"carrying_package = 0, battery_low = 1\") }",
        ),
        ("0,1\n", "0,1", "Ragged { found: 2, expected: 3 }"),
        (
            "0,1,goto(A),7\n",
            "0,1,goto(A),7",
            "Ragged { found: 4, expected: 3 }",
        ),
        (
            "\n\n0,2,goto(A)\n",
            "2",
            "UnknownValue { found: \"2\", expected: \"`0`, `1` or `-`\" }",
        ),
        (
            "0,,goto(A)\n",
            "",
            "UnknownValue { found: \"\", expected: \"`0`, `1` or `-`\" }",
        ),
        ("0,1,goto(D)\n", "goto(D)", "UnknownBehavior(\"goto(D)\")"),
        (
            "0,1,\"swap(A, C)\"\n",
            "\"swap(A, C)\"",
            "UnknownBehavior(\"swap(A, C)\")",
        ),
    ];
    for (rows, place, kind) in cases {
        let (at, found) = mistake(&format!("{head}{rows}"));
        assert_eq!(
            (at.as_str(), format!("{found:?}").as_str()),
            (place, kind),
            "{rows}"
        );
    }
    let (at, kind) = mistake("carrying,behavior\n1,goto(A)\n");
    assert_eq!(
        (at.as_str(), kind),
        ("carrying", TableErrorKind::UnknownColumn("carrying".into()))
    );
    let (at, kind) = mistake("battery_low,battery_low,behavior\n1,1,goto(A)\n");
    assert_eq!(
        (at.as_str(), kind),
        (
            "battery_low",
            TableErrorKind::RepeatedColumn("battery_low".into())
        )
    );
    let (at, kind) = mistake("battery_low\n1\n");
    assert_eq!(
        (at.as_str(), kind),
        (
            "battery_low",
            TableErrorKind::MissingColumn {
                name: "behavior".into(),
                likely: None
            }
        )
    );
    assert!(decisions::read("", &program(), None).is_err());
}
