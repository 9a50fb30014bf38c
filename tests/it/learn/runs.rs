//! Whole runs, from a program to its files.

use crate::program::NoFiles;
use btc::driver::learn::{Learned, Options, learn};
use btc::driver::load::{Loaded, load};
use btc::tree::decanonicalise::{Care, Method};

const SMALL: &str = include_str!("../../../examples/delivery_small.bt");
const LARGE: &str = include_str!("../../../examples/delivery_large.bt");

/// An example with some changes.
fn program(text: &str, changes: &[(&str, &str)]) -> Loaded {
    let mut text = text.to_owned();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    let loaded = load("delivery.bt", text.into_bytes(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{:#?}", loaded.diagnostics);
    loaded
}

pub(super) const OPTIONS: Options = Options {
    learner: None,
    seed: None,
    seeds: 1,
    episodes: Some(400),
    evidence: 10,
    method: Method::Search,
    care: Care::Reachable,
    simplify: None,
    roll_outs: 100,
    tests: 0,
    source: "../delivery.bt",
};

fn run(loaded: &Loaded, options: &Options) -> Learned {
    learn(loaded, options, &|_| {}).unwrap()
}

const FIGURE_8: &str = "\
tree learned for delivery = selector {
    battery_low => memory sequence { goto(C), dock(C) },
    carrying_package => goto(B),
    goto(A),
}
";

/// What a method learns on small delivery: the comment on where the tree comes from, and the tree.
fn small(method: &str, care: Care) -> (String, String) {
    let method = format!("method   = {method}");
    let changes = [
        ("method   = q_learning", method.as_str()),
        ("5_000", "3_000"),
    ];
    let options = Options {
        episodes: Some(500),
        care,
        ..OPTIONS
    };
    let learned = run(&program(SMALL, &changes), &options);
    let (origin, tree) = learned.text.split_once('\n').unwrap();
    (origin.to_owned(), tree.to_owned())
}

#[test]
fn every_method_learns_figure_8() {
    for method in ["double_q", "model"] {
        assert_eq!(small(method, Care::Reachable).1, FIGURE_8, "{method}");
    }
}

#[test]
fn either_care_set_is_named_and_proved() {
    let [seen, reachable] = [Care::Seen, Care::Reachable].map(|care| {
        let (origin, tree) = small("q_learning", care);
        assert_eq!(tree, FIGURE_8);
        origin
    });
    assert_eq!(
        [seen, reachable],
        [
            "/// Learned from delivery.bt, seed 1: proved on 10 observed minterms and 11 transitions, closed under them.",
            "/// Learned from delivery.bt, seed 1: proved on 8 of 10 observed minterms and 11 transitions, closed under \
             them.",
        ]
    );
}

#[test]
fn several_seeds_are_the_same_on_any_number_of_threads() {
    let loaded = program(LARGE, &[("5_000", "600")]);
    let options = Options {
        seeds: 3,
        tests: 60,
        ..OPTIONS
    };
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let learned = pool.unwrap().install(|| run(&loaded, &options));
        (learned.text, learned.files, learned.report)
    };
    assert_eq!(on(1), on(3));
}

#[test]
fn a_single_run_is_one_of_several() {
    let loaded = program(SMALL, &[("5_000", "600")]);
    let several = run(
        &loaded,
        &Options {
            seeds: 3,
            ..OPTIONS
        },
    );
    let single = run(
        &loaded,
        &Options {
            seed: Some(2),
            ..OPTIONS
        },
    );
    assert_eq!(several.curves[1], single.curves[0]);
    assert_eq!(several.curves.len(), 3);
    let report = several.report.join("\n");
    for word in [
        "curve",
        "seed 3",
        "taken",
        "agreement",
        "evidence",
        "value",
        "care",
    ] {
        assert!(report.contains(word), "{word} is missing in\n{report}");
    }
}

#[test]
fn what_was_met_too_seldom_is_a_dont_care_and_is_listed() {
    let loaded = program(LARGE, &[("5_000", "600"), ("= model", "= q_learning")]);
    let of = |evidence| {
        run(
            &loaded,
            &Options {
                evidence,
                ..OPTIONS
            },
        )
    };
    let (all, some) = (of(1), of(30));
    let thin = |learned: &Learned| {
        let (_, metrics) = learned
            .files
            .iter()
            .find(|(name, _)| *name == "metrics.json")
            .unwrap();
        let metrics: serde_json::Value = serde_json::from_str(metrics).unwrap();
        metrics["evidence"]["thin"].as_array().unwrap().len()
    };
    assert_eq!(thin(&all), 0);
    assert!(thin(&some) > 0);
    assert_eq!(some.policy.rows.len() + thin(&some), all.policy.rows.len());
    assert!(some.policy.rows.iter().all(|row| row.visits >= 30));
    assert!(some.report.iter().any(|line| line.starts_with("thin ")));
}

#[test]
fn nothing_learned_is_said_to_be_nothing() {
    let loaded = program(SMALL, &[("5_000", "600")]);
    let options = Options {
        episodes: Some(1),
        evidence: 1_000_000,
        ..OPTIONS
    };
    let refused = learn(&loaded, &options, &|_| {}).unwrap_err();
    assert_eq!(
        refused.diagnostics[0].message,
        "nothing was learned: no minterm has 1000000 completed decisions"
    );
}
