//! Worlds with a trap each: the report names it.

use super::runs::{OPTIONS, metrics};
use crate::program;
use crate::snapshot;
use btc::diagnostic::Code;
use btc::driver::learn::{Learned, Options, Shape, learn};
use std::path::Path;

fn learned(name: &str) -> Learned {
    learned_as(name, OPTIONS)
}

fn learned_as(name: &str, options: Options<'static>) -> Learned {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/worlds/traps");
    let file = format!("{name}.bt");
    let loaded = program::named(&file, &folder.join(&file));
    assert!(!loaded.has_errors(), "{name}");
    let options = Options {
        episodes: None,
        roll_outs: 60,
        ..options
    };
    learn(&loaded, &options, &|_| {}).unwrap()
}

#[test]
fn a_report_names_the_trap_of_a_world() {
    let cases: [(&str, &[Code]); 6] = [
        ("zero_reward", &[Code::W0505]),
        ("never_succeeds", &[Code::W0502, Code::W0503]),
        ("unreachable_goal", &[Code::W0502, Code::W0503]),
        ("unseen_deaths", &[Code::W0506]),
        ("nothing_pays", &[]),
        ("deceptive_reward", &[]),
    ];
    let mut text = String::new();
    for (name, expected) in cases {
        let learned = learned(name);
        assert_eq!(learned.headline.len(), 5);
        let codes: Vec<Code> = learned.warnings.iter().map(|found| found.code).collect();
        for code in expected {
            assert!(codes.contains(code), "{name}: {code} is not in {codes:?}");
        }
        text.push_str(&format!("{name}\n"));
        for warning in &learned.warnings {
            text.push_str(&format!("  {}: {}\n", warning.code, warning.message));
        }
    }
    snapshot::check("traps", &text);
}

/// The first number of a line of the headline.
fn first_number(line: &str) -> f64 {
    let number = line.split_whitespace().nth(1).unwrap();
    number.trim_end_matches(',').parse().unwrap()
}

/// What the learned tree returns when it is run.
fn returns(name: &str, learned: &Learned) -> f64 {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/worlds/traps/{name}.bt"));
    let text = std::fs::read_to_string(path).unwrap();
    let program = btc::Program::from_text(&format!("{text}\n{}", learned.text)).unwrap();
    program.run("learned", 100, 7).unwrap().summary.total.mean
}

/// Where a behaviour fails at once a tree goes on and its policy waits: the figures are those of the tree.
#[test]
fn the_figures_of_an_exact_tree_are_its_own() {
    let learned = learned("shut_door");
    let (told, simulated) = (
        first_number(&learned.headline[0]),
        returns("shut_door", &learned),
    );
    assert!(
        (told - simulated).abs() < 0.1 * simulated.abs().max(10.0),
        "{told} {simulated}"
    );
}

/// A reward that takes many behaviours in a row is found, however seldom random ones get there.
#[test]
fn a_far_reward_is_found() {
    let options = Options {
        shape: Shape::Grown,
        effort: 10_000_000,
        ..OPTIONS
    };
    let learned = learned_as("far_reward", options);
    assert!(returns("far_reward", &learned) > 9.0, "{}", learned.text);
    assert!(
        (learned.warnings.iter()).all(|found| found.code != Code::W0505),
        "{:?}",
        learned.warnings
    );
}

/// A policy that waits where a behaviour fails is not given up for one that acts and earns less.
#[test]
fn waiting_is_not_given_up_unseen() {
    let learned = learned_as(
        "shut_door",
        Options {
            shape: Shape::Grown,
            effort: 3_000_000,
            ..OPTIONS
        },
    );
    let policy = metrics(&learned)["greedy"]["return"]["mean"]
        .as_f64()
        .unwrap();
    assert!(policy > 50.0, "{policy}");
    assert!(returns("shut_door", &learned) > 50.0);
}

/// Of a tree that seldom is stuck, its worst episode says so.
#[test]
fn episodes_in_which_a_tree_is_stuck_are_named() {
    let text = include_str!("../../worlds/traps/stuck_at_times.bt");
    let program = btc::Program::from_text(text).unwrap();
    let runs = ["fast", "slow"].map(|tree| program.run(tree, 1000, 3).unwrap().human());
    snapshot::check("stuck_at_times", &runs.join("\n"));
}

/// A policy that is idle does no harm: it does not rule out the trees that work and do no more of it than the one by hand.
#[test]
fn idleness_does_not_rule_out_what_works() {
    let learned = learned_as(
        "worth_the_risk",
        Options {
            shape: Shape::Grown,
            effort: 3_000_000,
            ..OPTIONS
        },
    );
    assert!(
        returns("worth_the_risk", &learned) > 10.0,
        "{}",
        learned.text
    );
}

/// A tree that earns nothing is told as one thing, with each event that it does not meet.
#[test]
fn doing_nothing_is_told_once() {
    let learned = learned_as(
        "farm",
        Options {
            shape: Shape::Grown,
            effort: 3_000_000,
            ..OPTIONS
        },
    );
    let unmet: Vec<_> = (learned.warnings.iter())
        .filter(|found| found.code == Code::W0504)
        .collect();
    assert_eq!(unmet.len(), 1, "{unmet:?}");
    assert_eq!(unmet[0].notes.len(), 2, "{unmet:?}");
}

/// A tree that does nothing is not named after a behaviour that always fails.
#[test]
fn doing_nothing_has_a_plain_name() {
    for seed in [2, 3] {
        let learned = learned_as(
            "farm",
            Options {
                shape: Shape::Grown,
                effort: 3_000_000,
                seed: Some(seed),
                ..OPTIONS
            },
        );
        let tree = learned.text.lines().find(|line| !line.starts_with("//"));
        let tree = tree.unwrap_or_default();
        assert!(
            tree.ends_with("= goto(barn)") || tree.ends_with("= idle"),
            "{tree}"
        );
    }
}
