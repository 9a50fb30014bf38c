//! Trees in their forms; a node that a robot's library has no counterpart for becomes a diagnostic.

use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit::form::TreeForm;
use crate::emit::refusal::{Reason, Refusal};
use crate::emit::steps::Steps;
use crate::ir::tree::Tree;
use crate::ir::{Name, Program};
use crate::source::Span;
use crate::syntax::ast::{Node, NodeKind};
use crate::syntax::print;

/// A tree in a form. It may be a tree that the program does not have; the program gives the names. `place` gives the
/// place in the text of the node at a path of child positions, for a node that has no counterpart.
///
/// # Errors
/// A node that the form has no counterpart for.
pub fn tree(
    program: &Program,
    tree: &Tree,
    form: TreeForm,
    place: impl Fn(&[usize]) -> Span,
) -> Result<String, Diagnostic> {
    in_steps(program, tree, (form, Steps::default()), place)
}

/// The same with steps of its own.
///
/// # Errors
/// A node that the form has no counterpart for.
pub fn in_steps(
    program: &Program,
    tree: &Tree,
    (form, steps): (TreeForm, Steps),
    place: impl Fn(&[usize]) -> Span,
) -> Result<String, Diagnostic> {
    let written = form.write(program, tree, steps);
    written.map_err(|refusal| refused(&refusal, place(&refusal.path)))
}

/// A tree that is written in the program in a form.
///
/// # Errors
/// A node that the form has no counterpart for.
pub fn of_program(
    loaded: &Loaded,
    exported: &Tree,
    form: (TreeForm, Steps),
) -> Result<String, Refused> {
    let place = |path: &[usize]| place(loaded, exported, path);
    in_steps(&loaded.program, exported, form, place)
        .map_err(|mistake| Refused::program(loaded, [mistake]))
}

/// A tree of what is in a file, for a robot: it loads several trees and tells them apart by their names.
pub(super) fn named_after(file: &str, tree: &Tree) -> Tree {
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    Tree {
        name: Name::word(format!("{stem}_{}", tree.name.family)),
        ..tree.clone()
    }
}

/// An item in a file that uses the program at `path`, or without one behind the whole of the program.
pub(super) fn beside(loaded: &Loaded, path: Option<&str>, origin: &str, item: &str) -> String {
    match path {
        Some(path) => format!("//! {origin}\nuse \"{path}\"\n\n{item}"),
        None => {
            let text = loaded.sources.get(loaded.main).map(|s| s.text.as_str());
            format!("{}\n{item}", print::file(&loaded.ast, text))
        }
    }
}

/// Where the node at a path of child positions is written; a subtree is one leaf.
pub(super) fn place(loaded: &Loaded, tree: &Tree, path: &[usize]) -> Span {
    let name = tree.name.as_word();
    let written = name.and_then(|name| target::written(loaded, name));
    written.map_or_else(
        || target::end_of_file(loaded),
        |written| node_at(&written.root, path),
    )
}

fn node_at(root: &Node, path: &[usize]) -> Span {
    let mut at = root;
    for &position in path {
        let child = match &at.kind {
            NodeKind::Composite { children, .. } => children.get(position),
            NodeKind::Guarded { node, .. } if position == 1 => Some(&**node),
            _ => None,
        };
        match child {
            Some(child) => at = child,
            None => break,
        }
    }
    match &at.kind {
        NodeKind::Composite { word, .. } => word.span,
        _ => at.span,
    }
}

fn refused(refusal: &Refusal, span: Span) -> Diagnostic {
    match refusal.reason {
        Reason::Finished => Diagnostic::new(
            Code::E0821,
            span,
            "BehaviorTree.CPP has no such `parallel`",
        )
        .label("has a child that can go on, and others to ask anew in each tick")
        .note("`Parallel` of BehaviorTree.CPP does not tick a child again that has finished")
        .help("a `sequence` or a `selector` asks the conditions to the left of a behaviour in each tick"),
        Reason::Partial => Diagnostic::new(Code::E0821, span, "py_trees has no such `parallel`")
            .label("succeeds before all of its children have")
            .note("`Parallel` of py_trees fails as soon as one child fails")
            .help("a `selector` asks its conditions from the left until one holds"),
        Reason::Time => Diagnostic::new(Code::E0822, span, "no clock counts so long")
            .label("longer than 49 days")
            .note("BehaviorTree.CPP counts milliseconds in 32 bits"),
        Reason::Ticks => Diagnostic::new(Code::E0822, span, "nothing says how long these ticks are")
            .label("a program without a world has no `tick`")
            .note("the libraries that run trees on robots go by the clock")
            .help("add a `world` with a `tick`, or leave the `timeout` to the behaviour"),
    }
}
