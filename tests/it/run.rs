//! Programs at work: a file each in `tests/cases/run`, what its only tree meets and does, and that it can be learned.

use crate::program;
use btc::driver::Text;
use btc::driver::format::format;
use btc::driver::load::Loaded;
use btc::driver::run::{self, Subject};
use btc::driver::trace::{self, Step};
use btc::{LearnOptions, Program, Shape};
use std::path::Path;

/// How many lines of a trace are kept.
const LINES: usize = 24;

fn loaded(path: &Path) -> Loaded {
    let loaded = program::named(path.file_name().unwrap().to_str().unwrap(), path);
    let shown = program::shown(&loaded);
    assert!(!loaded.has_errors(), "{}: {shown}", path.display());
    loaded
}

fn cases(test: impl Fn(&Path)) {
    crate::snapshot::settings().bind(|| insta::glob!("..", "cases/run/*.bt", test));
}

#[test]
fn traces_show_what_programs_mean() {
    cases(|path| {
        let loaded = loaded(path);
        let subject = Subject::only_tree(&loaded).unwrap();
        let trace = trace::trace(&loaded, &subject, 0..1, 1, Step::Decision).unwrap();
        let lines: Vec<String> = trace.csv().lines().take(LINES).map(str::to_owned).collect();
        insta::assert_snapshot!("run", lines.join("\n"));
        let in_json = trace.json_lines();
        for line in in_json.lines() {
            serde_json::from_str::<serde_json::Value>(line).unwrap();
        }
        assert_eq!(in_json.lines().count() + 1, trace.csv().lines().count());
    });
}

/// Counting what nodes answer changes no episode; what is counted adds up.
#[test]
fn the_nodes_of_a_tree_are_counted() {
    cases(|path| {
        let loaded = loaded(path);
        let subject = Subject::only_tree(&loaded).unwrap();
        let plain = run::run(&loaded, &subject, 3, 1).unwrap();
        let counted = run::counted(&loaded, &subject, 3, 1).unwrap();
        assert_eq!(plain.summary, counted.summary, "{}", path.display());
        let coverage = counted.coverage.unwrap();
        let ticks = |at: usize| coverage.nodes[at].answers.ticks();
        assert_eq!(ticks(0), counted.summary.ticks, "{}", path.display());
        for (at, node) in coverage.nodes.iter().enumerate().skip(1) {
            let parent = node.parent.unwrap();
            assert!(ticks(at) <= ticks(parent), "{}", path.display());
            if coverage.nodes[parent].guarded && at == parent + 2 {
                let guard = coverage.nodes[at - 1].answers;
                assert_eq!(guard.success, ticks(at), "{}", path.display());
            }
        }
    });
}

/// Nodes that are never reached stand out.
#[test]
fn what_nodes_answer_is_shown() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/delivery_small.bt");
    let text = std::fs::read_to_string(&path).unwrap();
    let text = text.replace("battery <= 25%", "battery <= -1%");
    let loaded = program::with_text(&path, text);
    let subject = Subject::tree(&loaded, "expert").unwrap();
    let counted = run::counted(&loaded, &subject, 4, 1).unwrap();
    crate::snapshot::check("run_nodes", &counted.coverage.unwrap().table());
}

/// Every program with a learner can be learned, and what is learned is a program.
#[test]
fn programs_are_learned_from() {
    cases(|path| {
        if loaded(path).program.learners.is_empty() {
            return;
        }
        let options = LearnOptions {
            episodes: Some(60),
            roll_outs: 20,
            tests: 20,
            shape: Shape::Exact,
            ..LearnOptions::default()
        };
        let program = Program::from_file(path).unwrap();
        let learned = program.learn(&options).unwrap();
        assert!(learned.tree().size().nodes > 0, "{}", path.display());
    });
}

/// Cases are laid out as the formatter does it.
#[test]
fn cases_are_laid_out() {
    cases(|path| {
        let text = std::fs::read_to_string(path).unwrap();
        let (name, bytes) = ("case.bt", text.as_bytes());
        let laid_out = format(Text { name, bytes }).expect("it parses");
        assert_eq!(text, laid_out, "{}", path.display());
    });
}

/// An end on several events is called after them; one on anything else, by its condition.
#[test]
fn ends_are_called_after_their_events() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/delivery_small.bt");
    let text = std::fs::read_to_string(&path).unwrap();
    let ends = "end on dead or docked\n    end on dropoff\n    end on battery < 1%";
    let loaded = program::with_text(&path, text.replace("end on dead", ends));
    assert!(!loaded.has_errors(), "{}", program::shown(&loaded));
    let task = loaded.program.tasks.values().next().unwrap();
    let names = btc::report::words::end_names(&loaded.program, task);
    assert_eq!(names, ["dead or docked", "dropoff", "battery < 1%"]);
}
