//! Which task, tree or learner a command is about.

use super::load::Loaded;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::ir::task::{Learner, Task};
use crate::ir::tree::Tree;
use crate::ir::{Id, Program};
use crate::source::Span;
use crate::syntax::ast::{Item, ItemKind};

/// The end of the main file: where something is missing.
pub fn end_of_file(loaded: &Loaded) -> Span {
    Span {
        start: loaded.ast.span.end,
        ..loaded.ast.span
    }
}

/// The name of the world in the main file, or the file's end.
pub fn world_span(loaded: &Loaded) -> Span {
    let world = |item: &Item| match &item.kind {
        ItemKind::World(world) => Some(world.name.span),
        _ => None,
    };
    let found = loaded.ast.items.iter().find_map(world);
    found.unwrap_or_else(|| end_of_file(loaded))
}

/// The tree of that name.
///
/// # Errors
/// There is none: a diagnostic that offers the likely one.
pub fn tree(loaded: &Loaded, name: &str) -> Result<Id<Tree>, Diagnostic> {
    let trees = &loaded.program.trees;
    let found = trees.find(|tree| tree.name == name || tree.name.trim_matches('`') == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = trees.values().map(|tree| tree.name.as_str()).collect();
        missing(loaded, "tree", name, &names)
    })
}

/// The learner of that name, or the only one.
///
/// # Errors
/// There is none, or there are several and no name was given.
pub fn learner(loaded: &Loaded, name: Option<&str>) -> Result<Id<Learner>, Diagnostic> {
    let learners = &loaded.program.learners;
    let names: Vec<&str> = learners.values().map(|l| l.name.as_str()).collect();
    match name {
        Some(name) => learners
            .find(|learner| learner.name == name)
            .ok_or_else(|| missing(loaded, "learner", name, &names)),
        None => only(loaded, "learn", &names, learners.ids()),
    }
}

/// The task of a tree, or the only one.
///
/// # Errors
/// There is none, or there are several and the tree does not say which.
pub fn task_of(loaded: &Loaded, tree: Option<Id<Tree>>) -> Result<Id<Task>, Diagnostic> {
    let program: &Program = &loaded.program;
    if let Some(task) = tree.and_then(|tree| program.trees[tree].task) {
        return Ok(task);
    }
    let names: Vec<&str> = program.tasks.values().map(|t| t.name.as_str()).collect();
    only(loaded, "task", &names, program.tasks.ids())
}

fn only<T>(
    loaded: &Loaded,
    word: &str,
    names: &[&str],
    ids: impl Iterator<Item = Id<T>>,
) -> Result<Id<T>, Diagnostic> {
    let ids: Vec<Id<T>> = ids.collect();
    match ids.as_slice() {
        [one] => Ok(*one),
        [] => Err(Diagnostic::new(
            Code::E0504,
            end_of_file(loaded),
            format!("the program has no `{word}` item"),
        )
        .label(format!("`{word} … {{ … }}` is missing"))),
        _ => Err(Diagnostic::new(
            Code::E0504,
            end_of_file(loaded),
            format!(
                "the program has several `{word}` items: {}",
                names.join(", ")
            ),
        )
        .label(match word {
            "learn" => "say which one with `--learner NAME`",
            _ => "a tree says which one is meant: `tree NAME for TASK = …`",
        })),
    }
}

fn missing(loaded: &Loaded, what: &str, name: &str, names: &[&str]) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::E0504,
        end_of_file(loaded),
        format!("the program has no {what} `{name}`"),
    )
    .label("not in this file, nor in those that it uses");
    match suggest::nearest(name, names.iter().copied()) {
        Some(likely) => diagnostic.help(format!("did you mean `{likely}`?")),
        None if names.is_empty() => diagnostic,
        None => diagnostic.help(format!("it has: {}", names.join(", "))),
    }
}
