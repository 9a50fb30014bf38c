//! Numbers that may be tuned: what they mean when nobody tunes, and what is found when somebody does.

use crate::program::NoFiles;
use crate::snapshot::check;
use btc::checkpoint::Forgetful;
use btc::driver::load::{Loaded, load};
use btc::driver::run::{Subject, run};
use btc::driver::tune::{Options, Outcome, tune};
use btc::driver::{Text, compile, format::format};
use btc::emit::form::TreeForm;
use std::fs;
use std::process::{Command, Output, Stdio};

/// Small delivery with its threshold to be tuned.
pub(super) fn small(threshold: &str) -> String {
    let text = include_str!("../../examples/delivery_small.bt");
    let plain = "battery <= 25%";
    assert!(text.contains(plain));
    text.replace(plain, &format!("battery <= {threshold}"))
        .replace("claim learned equals expert\n", "")
}

fn loaded(text: &str) -> Loaded {
    let loaded = load("small.bt", text.into(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{:?}", loaded.diagnostics);
    loaded
}

/// A search that is over soon.
pub(super) const QUICK: Options = Options {
    tree: Some("expert"),
    learner: None,
    effort: 1_500_000,
    episodes: 40,
    seed: 1,
    keeper: &Forgetful,
};

fn tuned(text: &str) -> Outcome {
    tune(&loaded(text), &QUICK, &|_| {}).unwrap()
}

#[test]
fn a_number_that_nobody_tunes_is_its_value() {
    let ran = |text: &str| {
        let loaded = loaded(text);
        let expert = Subject::tree(&loaded, "expert").unwrap();
        run(&loaded, &expert, 4, 1).unwrap().json()
    };
    assert_eq!(ran(&small("tune(25%, 5% .. 60%)")), ran(&small("25%")));
}

#[test]
fn another_value_is_what_the_text_would_be_with_it() {
    let loaded = loaded(&small("tune(25%)"));
    let tunable = loaded.program.tunables.values().next().unwrap();
    assert_eq!(
        (
            tunable.name.as_str(),
            tunable.value,
            tunable.low,
            tunable.high
        ),
        ("battery_low", 25.0, 12.5, 50.0)
    );
    let program = loaded.revalued(&[35.0]).unwrap();
    let same = self::loaded(&small("tune(35%, 12.5% .. 50%)")).program;
    let shown = |program| btc::emit::ir::program(program);
    let without = |text: String| text.split("tune #0").next().unwrap().to_owned();
    assert_eq!(without(shown(&program)), without(shown(&same)));
}

#[test]
fn a_tree_for_a_robot_has_the_value_in_use() {
    let text = small("25%").replace("dock(C)", "dock(C, slack = tune(0.1 rad, 1 deg .. 20 deg))");
    let loaded = loaded(&text);
    // One behaviour in the task, in an event and in the tree: one number, in four places.
    assert_eq!(loaded.program.tunables.len(), 1);
    assert_eq!(loaded.tunes[0].len(), 3);
    let form = |form| compile::emit(&loaded, compile::Form::Tree(form), Some("expert")).unwrap();
    assert!(form(TreeForm::BtCpp).contains("slack=\"0.1 rad\""));
    let tree = form(TreeForm::Bt);
    assert!(tree.contains("dock(C, slack = tune(0.1 rad, 1 deg .. 20 deg))"));
}

#[test]
fn ranges_are_laid_out() {
    let laid_out = |text: &str| {
        let bytes = text.as_bytes();
        format(Text {
            name: "a.bt",
            bytes,
        })
        .unwrap()
    };
    assert_eq!(
        laid_out("let a = tune( 3, 1..  5)\nlet b=tune(2 ,1..5)\nlet c=tune(-3 cm,-1 m..0 m)"),
        "let a = tune(3, 1 .. 5)\nlet b = tune(2, 1 .. 5)\nlet c = tune(-3 cm, -1 m .. 0 m)\n"
    );
}

/// At 18 % the robot turns back as it arrives at A or B; a little earlier or later is better.
#[test]
fn a_bad_threshold_is_found_out() {
    let found = tuned(&small("tune(18%, 10% .. 20%)"));
    check("tuned", &found.human);
    let [(name, text)] = found.fixed.as_slice() else {
        panic!("{:?}", found.fixed);
    };
    assert_eq!(name, "small.bt");
    let new = text.split("tune(").nth(1).unwrap().split(',').next();
    assert_eq!(*text, small(&format!("tune({}, 10% .. 20%)", new.unwrap())));
    let document: serde_json::Value = serde_json::from_str(&found.json).unwrap();
    assert_eq!(document["edits"][0]["text"], "18%");
    assert_eq!(document["opinions"][0]["better"], true);
    let [(_, picture)] = found.pictures.as_slice() else {
        panic!("one number has one curve");
    };
    roxmltree::Document::parse(picture).unwrap();
}

#[test]
fn a_good_threshold_stays() {
    let found = tuned(&small("tune(15%, 13% .. 18%)"));
    assert_eq!(found.fixed, []);
    assert!(found.human.contains("in use, best 15%"), "{}", found.human);
}

/// Turning back late pays, and runs the battery down.
#[test]
fn what_a_claim_excludes_is_not_proposed() {
    let text = small("tune(18%, 10% .. 18%)")
        .replace("event dead ", "event thin = battery <= 7%\nevent dead ");
    let low = |claim: &str| tuned(&format!("{text}\n{claim}\n")).fixed;
    assert_eq!(low("").len(), 1);
    assert_eq!(low("claim expert never thin"), []);
}

/// A claim that fails under the value in use as well tells against no other.
#[test]
fn what_fails_anyway_excludes_nothing() {
    let text = small("tune(18%, 10% .. 20%)")
        .replace("event dead ", "event half = battery <= 50%\nevent dead ");
    let found = tuned(&format!("{text}\nclaim expert never half\n"));
    assert_eq!(found.fixed.len(), 1, "{}", found.human);
}

/// Both numbers are found together, and the one that changes nothing is left as it is.
#[test]
fn a_number_that_changes_nothing_stays() {
    let text = small("tune(18%, 13% .. 18%)").replace(
        "predicate carrying_package",
        "predicate near = distance(A) <= tune(1 m, 90 cm .. 110 cm)\npredicate carrying_package",
    );
    let options = Options {
        effort: 9_000_000,
        ..QUICK
    };
    let found = tune(&loaded(&text), &options, &|_| {}).unwrap();
    assert!(found.human.contains("1 of 1 pair"), "{}", found.human);
    let [(_, fixed)] = found.fixed.as_slice() else {
        panic!("{}", found.human);
    };
    assert!(fixed.contains("tune(1 m, 90 cm .. 110 cm)"));
    assert!(!fixed.contains("tune(18%"));
}

/// All that is simulated is paid from one account.
#[test]
fn a_search_keeps_its_budget() {
    let plain = small("tune(18%, 10% .. 20%)");
    let several = plain.replace(
        "predicate carrying_package",
        "predicate near = distance(A) <= tune(1 m, 10 cm .. 3 m)\npredicate carrying_package",
    );
    let claimed =
        format!("{plain}\nclaim expert never dead\nclaim expert never dead within 1 min\n");
    for text in [&plain, &several, &claimed] {
        for effort in [30_000, 100_000, 300_000, 1_000_000, 3_000_000] {
            let options = Options {
                effort,
                episodes: 400,
                ..QUICK
            };
            let found = tune(&loaded(text), &options, &|_| {}).unwrap();
            let document: serde_json::Value = serde_json::from_str(&found.json).unwrap();
            let ticks = document["ticks"].as_u64().unwrap();
            assert!(ticks <= effort + effort / 50, "{ticks} of {effort}");
            // What is affordable is played.
            assert!(
                effort < 1_000_000 || ticks > effort / 2,
                "{ticks} of {effort}"
            );
        }
    }
}

/// What the effort does not go as far as is told.
#[test]
fn what_is_not_searched_is_told() {
    let options = Options {
        effort: 20_000,
        ..QUICK
    };
    let found = tune(&loaded(&small("tune(18%, 10% .. 20%)")), &options, &|_| {}).unwrap();
    check("not_searched", &found.human);
    assert!(found.pictures.is_empty() && found.fixed.is_empty());
}

fn btc(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

#[test]
fn the_command_fixes_files_and_is_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let text = small("tune(18%, 13% .. 18%)");
    let file = folder.path().join("small.bt");
    fs::write(&file, &text).unwrap();
    let path = file.to_str().unwrap();
    let results = folder.path().join("results");
    let ran = |threads: &str, more: &[&str]| {
        let arguments = [
            &["tune", path, "--tree", "expert", "--effort", "500000"],
            &["--episodes", "24", "--threads", threads][..],
            more,
        ];
        let output = btc(&arguments.concat());
        assert_eq!(output.status.code(), Some(0), "{output:?}");
        output.stdout
    };
    let one = ran("1", &["--format", "json"]);
    assert_eq!(fs::read_to_string(&file).unwrap(), text);
    assert_eq!(one, ran("3", &["--format", "json"]));
    ran("2", &["--fix", "-o", results.to_str().unwrap()]);
    assert_eq!(fs::read(results.join("tune.json")).unwrap(), one);
    assert!(results.join("tune_1.svg").exists());
    let fixed = fs::read_to_string(&file).unwrap();
    assert!(!fixed.contains("tune(18%"), "{fixed}");
    let new = fixed.split("tune(").nth(1).unwrap().split(',').next();
    assert_eq!(fixed, small(&format!("tune({}, 13% .. 18%)", new.unwrap())));
    assert_eq!(btc(&["tune", "-", "--fix"]).status.code(), Some(2));
}
