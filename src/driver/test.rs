//! `btc test`: the tests that stand in programs.

mod failure;

use super::learn::Learned;
use super::load::Loaded;
use super::nodes;
use super::verify::assumed;
use crate::diagnostic::{Code, Diagnostic, render};
use crate::ir::test::{Subject, Test};
use crate::ir::tree::Node;
use crate::report::tested::Tested;
use crate::source::FileId;
use crate::syntax::ast::{self, ItemKind};
use crate::trial::test::play;

/// A test of a program, with its text.
#[derive(Clone, Copy, Debug)]
pub struct Due<'l> {
    /// The test.
    pub test: &'l Test,
    written: &'l ast::Test,
}

impl Due<'_> {
    /// The learner whose tree it is of, if that is yet to be learned.
    pub fn learner(&self, loaded: &Loaded) -> Option<String> {
        match &self.test.subject {
            Subject::Learned(id) => Some(loaded.program.learners[*id].name.to_string()),
            Subject::Tree(_) | Subject::Subtree(_) => None,
        }
    }
}

/// The tests that are due with a file: its own, and those of the files that it uses which are of its trees.
pub fn due(loaded: &Loaded) -> Vec<Due<'_>> {
    let own = |name: &str| {
        let mut items = loaded.ast.items.iter();
        items.any(|item| matches!(&item.kind, ItemKind::Tree(tree) if tree.name.name == name))
    };
    let tests = loaded.program.tests.iter();
    let tests = tests.filter_map(|test| {
        let (file, written) = written(loaded, &test.title)?;
        let is_due = file == loaded.main || own(&written.tree.name.name);
        is_due.then_some(Due { test, written })
    });
    tests.collect()
}

fn written<'l>(loaded: &'l Loaded, title: &str) -> Option<(FileId, &'l ast::Test)> {
    loaded.asts().find_map(|file| {
        let mut items = file.items.iter();
        let found = items.find_map(|item| match &item.kind {
            ItemKind::Test(test) if test.title.name == title => Some(test),
            _ => None,
        });
        Some((file.span.file, found?))
    })
}

/// What came of the tests of a file, and why those fail that do.
#[derive(Clone, Debug)]
pub struct Results {
    /// What came of them.
    pub tested: Tested,
    /// The failures, at their places.
    pub failures: Vec<Diagnostic>,
}

/// Runs tests, in order. `learned` is what was learned now.
pub fn run(loaded: &Loaded, file: &str, due: &[Due], learned: &[Learned]) -> Results {
    let mut results = Results {
        tested: Tested::of(file),
        failures: Vec::new(),
    };
    for due in due {
        one(loaded, *due, learned, &mut results);
    }
    results
}

fn one(loaded: &Loaded, due: Due, learned: &[Learned], results: &mut Results) {
    let program = &loaded.program;
    let Due { test, written } = due;
    let root: Option<&Node> = match &test.subject {
        Subject::Tree(id) => Some(&program.trees[*id].root),
        Subject::Subtree(root) => Some(root),
        Subject::Learned(id) => {
            let learned = learned.iter().find(|learned| learned.learner == *id);
            learned.map(|learned| &learned.tree.root)
        }
    };
    let Some(root) = root else {
        let failure = unlearned(test, written);
        let told = told(loaded, &failure);
        results.tested.test(test, 0, Some(told));
        results.failures.push(failure);
        return;
    };
    let history = test.task.map(|task| program.tasks[task].history);
    let history = history.unwrap_or_else(|| assumed(&[root]));
    let outcome = play(root, history, &test.lines);
    let found = match &test.subject {
        Subject::Learned(_) => nodes::Found::default(),
        Subject::Tree(_) | Subject::Subtree(_) => {
            let tree = &written.tree;
            nodes::of(loaded, &tree.name.name, tree.span, root)
        }
    };
    let failure = (outcome.failed.as_ref())
        .map(|failed| failure::of(program, (test, written), (root, &found.spans), failed));
    let told = failure.as_ref().map(|failure| told(loaded, failure));
    results.tested.test(test, outcome.ticks, told);
    results.failures.extend(failure);
    let covered = found.covered(loaded, (&test.tree, root), &outcome.nodes);
    results.tested.cover(covered);
}

/// A failure as a person is shown it, and as a JSON document.
fn told(loaded: &Loaded, failure: &Diagnostic) -> (String, String) {
    let failure = std::slice::from_ref(failure);
    (
        render::human(&loaded.sources, failure, false),
        render::json(&loaded.sources, failure),
    )
}

/// The mistake in a test of a tree that no file has.
fn unlearned(test: &Test, written: &ast::Test) -> Diagnostic {
    let tree = &test.tree;
    let message = format!("the tree `{tree}` is yet to be learned");
    Diagnostic::new(Code::E0504, written.tree.span, message)
        .label("its learner stands in another file")
        .help("use what `btc learn` or `btc test --accept` has written: that has the tree")
}
