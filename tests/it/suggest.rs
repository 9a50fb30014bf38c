//! What else a task could observe: a file each in `tests/cases/suggest`.

use crate::program;
use btc::driver::suggest::{Options, suggest};
use serde_json::Value;
use std::path::Path;

/// A search that is over soon.
const QUICK: Options = Options {
    learner: None,
    effort: 2_000_000,
    tries: 2,
    episodes: 60,
    seed: 1,
};

fn cases(test: impl Fn(&Path)) {
    crate::snapshot::settings().bind(|| insta::glob!("..", "cases/suggest/*.bt", test));
}

/// What is suggested is under snapshot, and a program that takes it is one without mistakes and warnings that observes it.
#[test]
fn what_is_suggested_can_be_pasted() {
    cases(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        let loaded = program::named(name, path);
        assert!(!loaded.has_errors(), "{}", program::shown(&loaded));
        let found = suggest(&loaded, &QUICK, &|_| {}).unwrap();
        insta::assert_snapshot!("suggest", found.human);
        let report: Value = serde_json::from_str(&found.json).unwrap();
        let Some(observe) = report["suggested"]["observe"].as_str() else {
            return;
        };
        let item = report["suggested"]["item"].as_str().unwrap_or("");
        let text = std::fs::read_to_string(path).unwrap();
        let text = text.replacen("observe ", &format!("observe {observe}, "), 1);
        let pasted = program::with_text(path, format!("{text}{item}\n"));
        assert_eq!(
            pasted.diagnostics.len(),
            loaded.diagnostics.len(),
            "{}",
            program::shown(&pasted)
        );
        let task = pasted.program.tasks.values().next().unwrap();
        let first = &pasted.program.predicates[task.observe[0]];
        assert_eq!(first.name.to_string(), observe);
    });
}

#[test]
fn the_same_seed_suggests_the_same_on_any_number_of_threads() {
    let path = Path::new(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/cases/suggest/left_out.bt"
    ));
    let loaded = program::named("left_out.bt", path);
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .unwrap();
        pool.install(|| suggest(&loaded, &QUICK, &|_| {}).unwrap().json)
    };
    assert_eq!(on(1), on(3));
}
