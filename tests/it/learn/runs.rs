//! Whole runs, from a program to its files.

use crate::program::NoFiles;
use btc::driver::learn::{EFFORT, Learned, Options, Shape, learn};
use btc::driver::load::{Loaded, load};
use btc::grow::Choice;
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
    seeds: Some(1),
    episodes: Some(400),
    evidence: 10,
    method: Method::Search,
    care: Care::Reachable,
    shape: Shape::Exact,
    choice: Choice::Knee,
    front: false,
    effort: EFFORT,
    roll_outs: 100,
    tests: 0,
    source: "../delivery.bt",
    keeper: &btc::checkpoint::Forgetful,
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

/// What a method learns on small delivery.
fn small(method: &str, care: Care) -> Learned {
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
    run(&program(SMALL, &changes), &options)
}

/// To drop a package off before the battery is charged is worth a little more than Figure 8, and double Q-learning may
/// find that.
#[test]
fn every_method_learns_what_is_as_good_as_figure_8() {
    let [single, double, model] =
        ["q_learning", "double_q", "model"].map(|method| small(method, Care::Reachable));
    let total = |learned: &Learned| {
        metrics(learned)["greedy"]["return"]["mean"]
            .as_f64()
            .unwrap()
    };
    for learned in [&single, &model] {
        assert!(learned.text.ends_with(FIGURE_8), "{}", learned.text);
    }
    assert!(total(&double) > 0.99 * total(&single), "{}", double.text);
}

#[test]
fn an_average_is_learned() {
    let changes = [
        ("method   = q_learning", "method   = model"),
        (
            "discount = 0.95 per decision",
            "objective = average per 1 min",
        ),
        ("rate     = visits^-0.7\n", ""),
        ("5_000", "3_000"),
    ];
    let options = Options {
        episodes: Some(500),
        ..OPTIONS
    };
    let learned = run(&program(SMALL, &changes), &options);
    assert!(learned.text.ends_with(FIGURE_8), "{}", learned.text);
    let metrics = metrics(&learned);
    let value = &metrics["value"];
    assert_eq!(value["objective"], "average per 60 s");
    let [on_policy, simulated] =
        [&value["on_policy"], &value["simulated"]["mean"]].map(|v| v.as_f64().unwrap());
    assert!(
        (on_policy / simulated - 1.0).abs() < 0.05,
        "{on_policy} {simulated}"
    );
}

pub(super) fn metrics(learned: &Learned) -> serde_json::Value {
    let mut files = learned.files.iter();
    let (_, text) = files.find(|(name, _)| *name == "metrics.json").unwrap();
    serde_json::from_str(text).unwrap()
}

#[test]
fn either_care_set_is_named_and_proved() {
    let [seen, reachable] = [Care::Seen, Care::Reachable].map(|care| {
        let text = small("q_learning", care).text;
        let (origin, tree) = text.split_once('\n').unwrap();
        assert_eq!(tree, FIGURE_8);
        origin.to_owned()
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
        seeds: Some(3),
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
            seeds: Some(3),
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
        metrics(learned)["evidence"]["thin"]
            .as_array()
            .unwrap()
            .len()
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
