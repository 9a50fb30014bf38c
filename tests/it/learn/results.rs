//! Learned trees and their files: proved, replayed and compared.

use super::runs::OPTIONS;
use crate::examples::example;
use crate::snapshot;
use btc::driver::learn::{Learned, Options, learn};
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::run::{self, Subject};
use btc::driver::{Text, verify};
use btc::policy::Policy;
use btc::tree::decanonicalise::Method;

/// Learns small delivery in a moment: a tenth of its episodes show the same policy.
fn learned(loaded: &Loaded, seed: u64, method: Method) -> Learned {
    learn(loaded, &options(seed, method), &|_| {}).unwrap()
}

fn options(seed: u64, method: Method) -> Options<'static> {
    Options {
        seed: Some(seed),
        evidence: 1,
        method,
        roll_outs: 50,
        source: "delivery_small.bt",
        ..OPTIONS
    }
}

/// The files of a learned program beside its source.
struct Folder {
    files: Vec<(&'static str, String)>,
    source: String,
}

impl Reader for Folder {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        if path == "delivery_small.bt" {
            return Ok(self.source.clone().into_bytes());
        }
        let file = self.files.iter().find(|(name, _)| *name == path);
        file.map(|(_, text)| text.clone().into_bytes())
            .ok_or_else(|| "not there".to_owned())
    }
}

impl Folder {
    fn of(learned: &Learned) -> Self {
        let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/delivery_small.bt");
        Self {
            files: learned.files.clone(),
            source: std::fs::read_to_string(path).unwrap(),
        }
    }

    fn load(&mut self) -> Loaded {
        let text = self.read("learned.bt").unwrap();
        load("learned.bt", text, self)
    }
}

#[test]
fn small_delivery_ends_with_figure_8() {
    let loaded = example("delivery_small");
    for method in [Method::Paper, Method::Search] {
        let learned = learned(&loaded, 1, method);
        assert_eq!(learned.policy.rows.len(), 10);
        snapshot::check("delivery_small.learned.bt", &learned.text);
        let expert = loaded.program.trees.values().next().unwrap();
        assert_eq!(learned.tree.root, expert.root);
    }
}

#[test]
fn a_seed_is_learned_the_same_way_on_any_number_of_threads() {
    let loaded = example("delivery_small");
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap()
            .install(|| learned(&loaded, 7, Method::Search).files)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(3));
}

#[test]
fn the_learned_program_is_whole() {
    let learned = learned(&example("delivery_small"), 3, Method::Search);
    let mut folder = Folder::of(&learned);
    let loaded = folder.load();
    assert!(loaded.diagnostics.is_empty(), "{:?}", loaded.diagnostics);
    let proved = verify::trees(&loaded, "learned", "expert").unwrap();
    assert!(proved.holds(), "{}", proved.text);
    assert!(proved.text.starts_with("equal:"), "{}", proved.text);
}

#[test]
fn a_changed_guard_is_found_by_a_shortest_trace() {
    let learned = learned(&example("delivery_small"), 1, Method::Search);
    let mut folder = Folder::of(&learned);
    folder.source = folder.source.replace(
        "    battery_low => memory sequence { goto(C), dock(C) },\n    carrying_package",
        "    battery_low => goto(C),\n    carrying_package",
    );
    let proved = verify::trees(&folder.load(), "learned", "expert").unwrap();
    assert!(!proved.holds());
    snapshot::check("delivery_small.different", &proved.text);
}

#[test]
fn tree_and_policy_run_alike() {
    let learned = learned(&example("delivery_small"), 1, Method::Search);
    let mut folder = Folder::of(&learned);
    let loaded = folder.load();
    let bytes = folder.read("policy.csv").unwrap();
    let text = Text {
        name: "policy.csv",
        bytes: &bytes,
    };
    let subject = Subject::policy(&loaded, text).unwrap();
    let Subject::Policy(policy, _) = &subject else {
        panic!("a table is a policy");
    };
    let decisions = |policy: &Policy| -> Vec<_> {
        let rows = policy.rows.iter();
        rows.map(|row| (row.minterm.clone(), row.behavior))
            .collect()
    };
    assert_eq!(decisions(policy), decisions(&learned.policy));
    let tree = Subject::tree(&loaded, "learned").unwrap();
    let by_tree = run::run(&loaded, &tree, 20, 5).unwrap();
    let by_policy = run::run(&loaded, &subject, 20, 5).unwrap();
    assert_eq!(by_tree, by_policy);
    assert_eq!(by_tree.json(), by_policy.json());
}

#[test]
fn figures_have_their_form() {
    let loaded = example("delivery_small");
    let tree = Subject::tree(&loaded, "expert").unwrap();
    let ran = run::run(&loaded, &tree, 4, 1).unwrap();
    snapshot::check("delivery_small.run.json", ran.json().trim_end());
    snapshot::check("delivery_small.run", &ran.human());
}

#[test]
fn rewards_that_are_no_numbers_teach_nothing() {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/delivery_small.bt");
    let text = std::fs::read_to_string(path).unwrap();
    let void = text.replace(
        "otherwise:  -0.1",
        "otherwise:  (battery - 1 * battery) / (1 * battery - battery)",
    );
    assert_ne!(void, text);
    let mut folder = Folder {
        files: Vec::new(),
        source: void.clone(),
    };
    let loaded = load("void.bt", void.into_bytes(), &mut folder);
    assert!(loaded.diagnostics.is_empty(), "{:?}", loaded.diagnostics);
    let refused = learn(&loaded, &options(1, Method::Search), &|_| {}).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, btc::diagnostic::Code::E0505);
}
