//! The explanations, run: the wrong program provokes its code and nothing else, the right one nothing.

use crate::program::{self, NoFiles};
use crate::snapshot;
use btc::diagnostic::{Code, Diagnostic, render};
use btc::driver::compile::Form;
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::{Refused, Text, compile, learn, minimize, run, test, verify};
use btc::emit::form::TreeForm;
use btc::grow::Choice;
use btc::tree::decanonicalise::{Care, Method};

/// The example of an explanation that follows a heading.
fn example(code: Code, heading: &str) -> &'static str {
    let explanation = code.explanation();
    let language = if code.name().starts_with("E080") {
        "pla"
    } else {
        "bt"
    };
    let start = format!("\n{heading}:\n\n```{language}\n");
    let at = explanation.find(&start);
    let at = at.unwrap_or_else(|| panic!("{code} has no example under {heading}")) + start.len();
    let length = explanation[at..].find("\n```").unwrap();
    &explanation[at..at + length]
}

fn wrong(code: Code) -> Loaded {
    load("wrong.bt", example(code, "Wrong").into(), &mut NoFiles)
}

fn right(code: Code) -> Loaded {
    let loaded = load("right.bt", example(code, "Right").into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "", "{code}");
    loaded
}

fn codes(diagnostics: &[Diagnostic]) -> Vec<Code> {
    diagnostics.iter().map(|found| found.code).collect()
}

/// The codes that loading a program does not meet; each has a test below.
const LATER: [Code; 34] = [
    Code::E0130,
    Code::E0211,
    Code::E0212, // this and W0203: results
    Code::W0203,
    Code::W0101, // limits
    Code::E0409,
    Code::E0504,
    Code::E0505,
    Code::E0609, // driver::decanonicalize
    Code::E0610,
    Code::E0612,
    Code::E0811, // this and those below: tables::cases
    Code::E0812,
    Code::E0813,
    Code::E0814,
    Code::E0815,
    Code::E0816,
    Code::E0817,
    Code::E0818,
    Code::E0819,
    Code::E0821,
    Code::E0822,
    Code::E0823,
    Code::E0824,
    Code::E0825,
    Code::E0826,
    Code::W0502, // this and those below: what learning finds
    Code::W0503,
    Code::W0504,
    Code::W0505,
    Code::W0506,
    Code::W0507,
    Code::W0508,
    Code::W0523,
];

#[test]
fn each_code_is_explained_and_provoked() {
    for &code in Code::ALL {
        let heading = format!("# {code}: {}\n\n", code.title());
        assert!(code.explanation().starts_with(&heading), "{code}");
        // Those of the syntax are provoked beside the parser, those of PLAs below.
        if code.name().starts_with("E01")
            || code.name().starts_with("E080")
            || LATER.contains(&code)
        {
            continue;
        }
        let found = codes(&wrong(code).diagnostics);
        assert!(
            !found.is_empty() && found.iter().all(|&other| other == code),
            "{code} provokes {found:?}"
        );
        right(code);
    }
}

#[test]
fn explanations_fit_a_terminal() {
    for &code in Code::ALL
        .iter()
        .filter(|code| !code.name().starts_with("E01"))
    {
        for line in code.explanation().lines() {
            assert!(line.chars().count() <= 120, "{code}: {line}");
        }
    }
}

/// E0130: bytes that are no text.
#[test]
fn a_file_that_is_no_text() {
    let code = Code::E0130;
    let mut bytes = Vec::new();
    for c in example(code, "Wrong").chars() {
        match c {
            '\u{fffd}' => bytes.push(0xff),
            c => bytes.extend(c.to_string().bytes()),
        }
    }
    let loaded = load("wrong.bt", bytes, &mut NoFiles);
    assert_eq!(codes(&loaded.diagnostics), [code]);
    assert_eq!(
        loaded.sources.text(loaded.diagnostics[0].span()),
        "\u{fffd}"
    );
    right(code);
}

/// E0211: a table from another run.
#[test]
fn a_table_of_another_run() {
    struct Table;
    impl Reader for Table {
        fn read(&mut self, _: &str) -> Result<Vec<u8>, String> {
            Ok(b"raining,behavior,status,next:raining,count\n".to_vec())
        }
    }
    let code = Code::E0211;
    let loaded = load("wrong.bt", example(code, "Wrong").into(), &mut Table);
    assert_eq!(codes(&loaded.diagnostics), [code]);
    right(code);
}

/// E0612: a tick that selects something else.
#[test]
fn a_test_that_fails() {
    let code = Code::E0612;
    let failures = |loaded: &Loaded| {
        assert_eq!(program::shown(loaded), "");
        let due = test::due(loaded);
        assert_eq!(due.len(), 1);
        codes(&test::run(loaded, "a.bt", &due, &[]).failures)
    };
    assert_eq!(failures(&wrong(code)), [code]);
    assert_eq!(failures(&right(code)), []);
}

/// E0409: a robot that is larger than its arena.
#[test]
fn a_world_that_cannot_be_built() {
    let code = Code::E0409;
    let loaded = wrong(code);
    assert_eq!(program::shown(&loaded), "");
    let ran = |loaded: &Loaded| {
        let subject = run::Subject::tree(loaded, "back").unwrap();
        run::run(loaded, &subject, 1, 1)
    };
    let found = ran(&loaded).unwrap_err().diagnostics;
    assert_eq!(codes(&found), [code]);
    assert_eq!(loaded.sources.text(found[0].span()), "yard");
    assert!(ran(&right(code)).is_ok());
}

/// E0504: a tree by the wrong name.
#[test]
fn a_tree_that_is_not_there() {
    let code = Code::E0504;
    let loaded = wrong(code);
    assert_eq!(program::shown(&loaded), "");
    let found = compile::emit(&loaded, Form::Tree(TreeForm::Bt), Some("expert")).unwrap_err();
    assert_eq!(codes(&found.diagnostics), [code]);
    assert!(compile::emit(&right(code), Form::Tree(TreeForm::Bt), Some("expert")).is_ok());
}

/// E0505: no episode, so no decision.
#[test]
fn nothing_is_learned() {
    let code = Code::E0505;
    let loaded = wrong(code);
    assert_eq!(program::shown(&loaded), "");
    let found = learned(&loaded, Some(0)).unwrap_err();
    assert_eq!(codes(&found.diagnostics), [code]);
    assert!(learned(&right(code), None).is_ok());
}

/// W0502–W0508, W0523: what is told of a result, and how.
#[test]
fn what_learning_finds() {
    let of = |loaded: &Loaded, code: Code| {
        let shape = match code {
            Code::W0523 => learn::Shape::Grown,
            _ => learn::Shape::Exact,
        };
        shaped(loaded, None, shape).unwrap().warnings
    };
    let code = |code: &&Code| (Code::W0502..=Code::W0508).contains(code) || **code == Code::W0523;
    let mut text = String::new();
    for code in Code::ALL.iter().filter(code) {
        let loaded = wrong(*code);
        assert_eq!(program::shown(&loaded), "", "{code}");
        let mut found = of(&loaded, *code);
        found.retain(|found| found.code == *code);
        assert!(!found.is_empty(), "{code}");
        text.push_str(&render::human(&loaded.sources, &found, false));
        let found = codes(&of(&right(*code), *code));
        assert!(!found.contains(code), "{code}: {found:?}");
    }
    snapshot::check("what_learning_finds", &text);
}

/// E0610: a table that was recorded for another task.
#[test]
fn a_table_of_another_task() {
    struct Table;
    impl Reader for Table {
        fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
            assert_eq!(path, "transitions.csv");
            Ok(b"raining,behavior,status,next:raining,count\n0,stroll,success,1,7\n".to_vec())
        }
    }
    let code = Code::E0610;
    let loaded = load("wrong.bt", example(code, "Wrong").into(), &mut Table);
    assert_eq!(program::shown(&loaded), "");
    let found = verify::trees(&loaded, "a", "b").unwrap_err();
    assert_eq!(codes(&found.diagnostics), [code]);
    let proved = verify::trees(&right(code), "a", "b").unwrap();
    assert!(!proved.holds());
}

/// E0821, E0822: a `parallel` that neither library has, and a time that one of them cannot keep.
#[test]
fn what_a_robot_cannot_run() {
    let cases = [
        (
            Code::E0821,
            "refill",
            vec![TreeForm::BtCpp, TreeForm::PyTrees],
        ),
        (Code::E0822, "walk", vec![TreeForm::BtCpp]),
    ];
    for (code, tree, runtimes) in cases {
        for runtime in runtimes {
            let loaded = wrong(code);
            assert_eq!(program::shown(&loaded), "");
            let form = Form::Tree(runtime);
            let found = compile::emit(&loaded, form, Some(tree)).unwrap_err();
            assert_eq!(codes(&found.diagnostics), [code]);
            assert!(compile::emit(&right(code), form, Some(tree)).is_ok());
        }
    }
}

/// E0801–E0807: PLAs.
#[test]
fn wrong_plas() {
    for &code in Code::ALL.iter().filter(|c| c.name().starts_with("E080")) {
        let options = minimize::Options {
            order: (code == Code::E0807).then_some(minimize::Order::Given),
            limit: if code == Code::E0806 { 1 } else { 100 },
            separate: false,
        };
        let minimized = |heading| {
            let text = example(code, heading);
            let text = Text {
                name: "example.pla",
                bytes: text.as_bytes(),
            };
            minimize::minimize(text, &options)
        };
        let found = minimized("Wrong").unwrap_err();
        assert_eq!(codes(&found.diagnostics), [code]);
        assert!(minimized("Right").is_ok(), "{code}");
    }
}

fn learned(loaded: &Loaded, episodes: Option<u64>) -> Result<learn::Learned, Refused> {
    shaped(loaded, episodes, learn::Shape::Exact)
}

fn shaped(
    loaded: &Loaded,
    episodes: Option<u64>,
    shape: learn::Shape,
) -> Result<learn::Learned, Refused> {
    let options = learn::Options {
        learner: None,
        seed: None,
        seeds: Some(1),
        episodes,
        evidence: 1,
        method: Method::Search,
        care: Care::Seen,
        shape,
        choice: Choice::Knee,
        front: false,
        effort: 100_000,
        roll_outs: 10,
        tests: 0,
        source: "program.bt",
        keeper: &btc::checkpoint::Forgetful,
    };
    learn::learn(loaded, &options, &|_| {})
}
