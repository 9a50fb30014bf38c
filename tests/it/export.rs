//! Trees for robots: what is written keeps the rules of its format, and runs as btc runs the tree.

mod cpp;
mod file;
mod format;
mod leaves;
mod library;
mod other_robots;
mod play;
mod python;
mod script;
mod traces;
mod trees;

use crate::examples::example;
use crate::program;
use crate::snapshot;
use btc::diagnostic::{Code, Diagnostic};
use btc::driver::compile;
use btc::driver::compile::Form;
use btc::driver::export::tree;
use btc::driver::load::Loaded;
use btc::emit::form::TreeForm;
use btc::ir::Program;
use btc::ir::tree::{Node, Tree};
use btc::source::Span;
use std::path::Path;

/// A program with names of every sort, and a tree of everything.
fn names() -> Loaded {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/export");
    let loaded = program::named("names.bt", &Path::new(folder).join("names.bt"));
    assert!(!loaded.has_errors(), "{}", program::shown(&loaded));
    loaded
}

/// A tree of these names for a robot.
fn written(program: &Program, root: &Node, runtime: TreeForm) -> Result<String, Diagnostic> {
    let subject = Tree {
        name: "tried".into(),
        docs: Vec::new(),
        task: program.tasks.ids().next(),
        root: root.clone(),
    };
    tree(program, &subject, runtime, |_| Span::default())
}

const RUNTIMES: [(TreeForm, &str); 2] = [(TreeForm::BtCpp, "xml"), (TreeForm::PyTrees, "py")];

#[test]
fn as_robots_get_them() {
    let check = |name: &str, loaded: &Loaded, tree: &str| {
        for (runtime, ending) in RUNTIMES {
            let text = compile::emit(loaded, Form::Tree(runtime), Some(tree)).unwrap();
            snapshot::check(&format!("{name}.{tree}.{ending}"), &text);
        }
    };
    check("delivery_small", &example("delivery_small"), "expert");
    check("delivery_large", &example("delivery_large"), "table_1");
    check("names", &names(), "everything");
}

#[test]
fn what_has_no_counterpart_has_a_place() {
    let text = "predicate low\nbehavior go\n\
        tree a = selector { low => go, parallel(1) { low, go } }\n\
        tree b = sequence { low, invert { a } }\n";
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("wrong.bt");
    let loaded = program::with_text(&path, text.to_owned());
    assert_eq!(program::shown(&loaded), "");
    for (runtime, _) in RUNTIMES {
        for (tree, place) in [("a", "parallel"), ("b", "a")] {
            let refused = compile::emit(&loaded, Form::Tree(runtime), Some(tree)).unwrap_err();
            let found = &refused.diagnostics[0];
            assert_eq!(found.code, Code::E0821);
            assert_eq!(loaded.sources.text(found.span()), place);
        }
    }
}

/// What the documentation shows of the programs for robots stands in them.
#[test]
fn the_documentation_quotes_the_programs() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let read = |path: &str| std::fs::read_to_string(root.join(path)).unwrap();
    let text = read("docs/book/src/export.md");
    for (language, path) in [
        ("cpp", "examples/robots/cpp/courier.cpp"),
        ("python", "examples/robots/py_trees/courier.py"),
    ] {
        let program = read(path);
        let opening = format!("```{language}\n");
        let blocks = text.split(opening.as_str()).skip(1);
        let blocks: Vec<&str> = blocks
            .map(|rest| rest.split("```").next().unwrap())
            .collect();
        assert!(!blocks.is_empty());
        for block in blocks {
            assert!(program.contains(block), "{path} has no\n{block}");
        }
    }
}
