//! A run that goes on from any state that it kept comes to the same end.

use crate::program::NoFiles;
use crate::tune::{QUICK, small};
use btc::checkpoint::{Forgetful, Keeper};
use btc::driver::learn::{Learned, Options, Shape, learn};
use btc::driver::load::{Loaded, load};
use btc::driver::tune;
use std::collections::BTreeMap;
use std::sync::Mutex;

/// Keeps every state, one after another.
#[derive(Debug, Default)]
struct Everything {
    before: BTreeMap<String, Vec<u8>>,
    kept: Mutex<Vec<(String, Vec<u8>)>>,
    /// Only each n-th state is due.
    sparse: usize,
    asked: Mutex<usize>,
}

impl Keeper for Everything {
    fn load(&self, part: &str) -> Option<Vec<u8>> {
        self.before.get(part).cloned()
    }

    fn keeps(&self) -> bool {
        true
    }

    fn is_due(&self, _: &str) -> bool {
        let mut asked = self.asked.lock().unwrap();
        *asked += 1;
        self.sparse > 0 && asked.is_multiple_of(self.sparse)
    }

    fn save(&self, part: &str, state: &[u8]) {
        let mut kept = self.kept.lock().unwrap();
        kept.push((part.to_owned(), state.to_vec()));
    }

    fn publish(&self, _: &str, _: &str) {}
}

fn program(method: &str, ticks: u64) -> Loaded {
    let text = include_str!("../../../examples/delivery_small.bt");
    let methods = ["q_learning", "double_q", "model"];
    let text = methods.iter().fold(text.to_owned(), |text, other| {
        text.replace(
            &format!("method   = {other}"),
            &format!("method   = {method}"),
        )
    });
    assert!(text.contains(method), "{text}");
    let limit = "end after 5_000 ticks";
    assert!(text.contains(limit), "{text}");
    let text = text.replace(limit, &format!("end after {ticks} ticks"));
    let loaded = load("small.bt", text.into_bytes(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{:#?}", loaded.diagnostics);
    loaded
}

fn options(keeper: &dyn Keeper) -> Options<'_> {
    Options {
        seeds: Some(2),
        episodes: Some(60),
        roll_outs: 40,
        effort: 400_000,
        front: true,
        shape: Shape::Grown,
        keeper,
        ..Options::default()
    }
}

fn same(one: &Learned, other: &Learned, case: &str) {
    for ((name, one), (_, other)) in one.files.iter().zip(&other.files) {
        assert_eq!(one, other, "{case}: {name}");
    }
    assert_eq!(one.report, other.report, "{case}");
}

/// Goes on from each n-th of all states, these among them.
fn goes_on((method, ticks): (&str, u64), step: usize, own: &[&str]) {
    let loaded = program(method, ticks);
    let whole = learn(&loaded, &options(&Forgetful), &|_| {}).unwrap();
    let keeper = Everything {
        sparse: 1,
        ..Everything::default()
    };
    same(
        &learn(&loaded, &options(&keeper), &|_| {}).unwrap(),
        &whole,
        method,
    );
    let kept = keeper.kept.into_inner().unwrap();
    let parts: Vec<&String> = kept.iter().map(|(part, _)| part).collect();
    let usual = [
        "seed-1", "seed-2", "policy", "improved", "met", "tree", "grown",
    ];
    for part in usual.iter().chain(own) {
        assert!(parts.iter().any(|kept| kept == part), "{part}: {parts:?}");
    }
    for at in (0..kept.len()).step_by(step) {
        let before = kept[..=at].iter().cloned().collect();
        let again = Everything {
            before,
            ..Everything::default()
        };
        let learned = learn(&loaded, &options(&again), &|_| {}).unwrap();
        same(
            &learned,
            &whole,
            &format!("{method}, {}, state {at}", kept[at].0),
        );
    }
}

#[test]
fn a_run_goes_on_from_its_states() {
    goes_on(("model", 5000), 19, &[]);
    goes_on(("double_q", 5000), 61, &[]);
    goes_on(("q_learning", 5000), 61, &[]);
}

/// Where episodes are long, a search in which they end early comes first. It may take more than all of the effort.
#[test]
fn a_run_of_long_episodes_goes_on_from_its_states() {
    goes_on(("model", 20_000), 31, &["early", "early tree"]);
    let loaded = program("model", 20_000);
    let options = Options {
        effort: 1,
        ..options(&Forgetful)
    };
    let learned = learn(&loaded, &options, &|_| {}).unwrap();
    assert!(!learned.report.is_empty());
}

/// A search for better values goes on from each state, and so does what is learned again under them: its states have names of
/// their own, for they are not those of the values in use.
#[test]
fn what_is_tuned_goes_on_from_its_states() {
    let text = small("tune(18%, 10% .. 20%)");
    let loaded = load("small.bt", text.into_bytes(), &mut NoFiles);
    let keeper = Everything::default();
    let options = options(&keeper);
    let mut learned = learn(&loaded, &options, &|_| {}).unwrap();
    // A tree for which other values are known to be better.
    let expert = loaded.program.trees.values();
    let mut expert = expert.filter(|tree| tree.name.family == "expert");
    learned.tree.root = expert.next().unwrap().root.clone();
    let tuned = |keeper: &dyn Keeper| {
        let search = tune::Options { keeper, ..QUICK };
        tune::of_learned(&loaded, &learned, &options, &search, &|_| {}).unwrap()
    };
    let before = keeper.kept.lock().unwrap().len();
    let whole = tuned(&Forgetful);
    assert!(whole.text.is_some(), "{}", whole.human);
    assert_eq!(keeper.kept.lock().unwrap().len(), before);
    let every = Everything {
        sparse: 1,
        ..Everything::default()
    };
    assert_eq!(tuned(&every).json, whole.json);
    let kept = every.kept.into_inner().unwrap();
    let parts: Vec<&String> = kept.iter().map(|(part, _)| part).collect();
    for part in ["played", "tuned", "again-seed-1", "again-grown"] {
        assert!(parts.iter().any(|kept| *kept == part), "{part}: {parts:?}");
    }
    let other = parts
        .iter()
        .all(|part| ["played", "tuned"].contains(&part.as_str()) || part.starts_with("again-"));
    assert!(other, "{parts:?}");
    let step = kept.len().div_ceil(8);
    for at in (0..kept.len()).step_by(step) {
        let before = kept[..=at].iter().cloned().collect();
        let again = tuned(&Everything {
            before,
            ..Everything::default()
        });
        assert_eq!(again.json, whole.json, "{}, state {at}", kept[at].0);
        assert_eq!(again.text, whole.text, "{}, state {at}", kept[at].0);
    }
}

#[test]
#[ignore = "takes minutes"]
fn a_run_goes_on_from_each_of_its_states() {
    for method in ["model", "double_q", "q_learning"] {
        goes_on((method, 5000), 1, &[]);
    }
}
