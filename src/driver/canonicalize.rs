//! `btc canonicalize`: the canonical form of a tree (paper, section IV), or its policy table.

use super::export;
use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::check;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit::bt;
use crate::ir::tree::{Atom, Node, Status, Tree};
use crate::ir::{Name, Program};
use crate::policy::decisions;
use crate::tree::atoms::atoms as asked;
use crate::tree::canonicalise::{Canonical, canonicalise};
use crate::tree::reading::{Irreducible, Reading};

/// The form to write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form<'f> {
    /// A program with the canonical tree. What the tree mentions is declared, or found in the file that this path leads
    /// to from the place of the result; without a path, the whole of the program stands before it.
    Bt(Option<&'f str>),
    /// The policy table: cubes that do not overlap.
    Csv,
}

/// The canonical form of a tree, with a warning if there is any.
///
/// # Errors
/// There is no such tree, or it has no canonical form: the diagnostic points to the node that has none.
pub fn canonicalize(
    loaded: &Loaded,
    name: &str,
    form: Form,
) -> Result<(String, Option<String>), Refused> {
    let id = target::tree(loaded, name)?;
    let tree = &loaded.program.trees[id];
    let canonical = canonicalise(&tree.root, Reading::Furthest)
        .map_err(|why| irreducible(loaded, tree, &why))?;
    if canonical.units.is_empty() {
        let note = format!("`{}` selects nothing in any minterm", tree.name);
        let message = format!("`{}` has no canonical form", tree.name);
        let place = export::place(loaded, tree, &[]);
        let diagnostic = Diagnostic::new(Code::E0819, place, message).label(note);
        return Err(Refused::program(loaded, [diagnostic]));
    }
    if let Some(unkept) = unkept(loaded, tree, &canonical) {
        return Err(Refused::program(loaded, [unkept]));
    }
    match form {
        Form::Csv => table(loaded, tree, &canonical),
        Form::Bt(path) => Ok((file(loaded, tree, &canonical, path), None)),
    }
}

/// Why the canonical form of a tree with memory could not be: it asks a history that the task does not keep.
fn unkept(loaded: &Loaded, tree: &Tree, canonical: &Canonical) -> Option<Diagnostic> {
    let task = &loaded.program.tasks[tree.task?];
    let asked = canonical.atoms().into_iter().filter_map(Atom::termination);
    let asked = asked.map(|(_, status)| status);
    let lacking: Vec<Status> = asked
        .filter(|status| !task.history.keeps(*status))
        .collect();
    if lacking.is_empty() {
        return None;
    }
    let needed = [Status::Success, Status::Failure].map(|status| lacking.contains(&status));
    let name = task.name.to_string();
    let [message, help] = check::kept_too_little(&name, task.history, needed);
    let path = remembers(&tree.root).unwrap_or_default();
    let place = export::place(loaded, tree, &path);
    let diagnostic = Diagnostic::new(Code::E0607, place, message)
        .label("in the canonical form the history says what this remembers");
    Some(diagnostic.help(help))
}

/// The way to the first node with memory.
fn remembers(node: &Node) -> Option<Vec<usize>> {
    if let Node::Composite { memory: true, .. } = node {
        return Some(Vec::new());
    }
    let mut children = node.children().iter().enumerate();
    children.find_map(|(at, child)| {
        let below = remembers(child)?;
        Some([vec![at], below].concat())
    })
}

/// The canonical tree in a program.
fn file(loaded: &Loaded, tree: &Tree, canonical: &Canonical, path: Option<&str>) -> String {
    let program = &loaded.program;
    let plain = &tree.name.family;
    let memory = if tree.root.remembers() {
        ", with memory read from the history"
    } else {
        ""
    };
    let docs = vec![format!("The canonical form of `{plain}`{memory}.")];
    let canonical = Tree {
        name: Name::word(format!("{plain}_canonical")),
        docs,
        task: tree.task,
        root: canonical.tree(),
    };
    if is_declared_only(program) {
        let mut program = program.clone();
        program.trees = std::iter::once(canonical).collect();
        return bt::declared(&program, &["Made by `btc canonicalize`.".to_owned()]);
    }
    let item = bt::tree(program, &canonical);
    export::beside(loaded, path, "Made by `btc canonicalize`.", &item)
}

/// Whether a program only declares names.
fn is_declared_only(program: &Program) -> bool {
    program.world.is_none()
        && program.tasks.is_empty()
        && program
            .predicates
            .values()
            .all(|p| p.when.is_none() && p.name.as_word().is_some())
        && program
            .behaviors
            .values()
            .all(|b| b.law.is_none() && b.name.as_word().is_some())
}

/// The policy table of a tree, with a warning where it says nothing of some minterms.
fn table(
    loaded: &Loaded,
    tree: &Tree,
    canonical: &Canonical,
) -> Result<(String, Option<String>), Refused> {
    let program = &loaded.program;
    let window = tree.task.map(|task| program.tasks[task].history.window);
    let mut atoms = canonical.atoms();
    // What the tree asks in vain has its column: the table is held against the tree by its names.
    let in_vain = asked(&tree.root).into_iter();
    let in_vain: Vec<Atom> = in_vain.filter(|atom| !atoms.contains(atom)).collect();
    atoms.extend(in_vain);
    let Some(divided) = canonical.divided(&atoms, window) else {
        let message = format!("the table of `{}` is too large", tree.name.family);
        let place = export::place(loaded, tree, &[]);
        let note = "its minterms come to more than 200 000 parts, asked one atom after the other";
        let help = "leave out `--emit csv` for its canonical form as a tree";
        let diagnostic = Diagnostic::new(Code::E0819, place, message).label(note);
        return Err(Refused::program(loaded, [diagnostic.help(help)]));
    };
    let warning = (!divided.is_total).then(|| {
        format!(
            "warning: `{}` selects nothing in some minterms, and these have no row",
            tree.name.family
        )
    });
    let remarks = match tree.root.remembers() {
        true => remembered(&tree.name.bare()),
        false => Vec::new(),
    };
    let policy = divided.policy(atoms);
    if let Some(name) = decisions::unsaid(&policy, program) {
        let message = format!("no table can say the name `{name}`");
        let place = export::place(loaded, tree, &[]);
        let note = "it would be read as something else";
        let diagnostic = Diagnostic::new(Code::E0819, place, message).label(note);
        return Err(Refused::program(loaded, [diagnostic]));
    }
    Ok((decisions::write_bare(&policy, program, &remarks), warning))
}

/// What the table of a tree with memory lacks.
fn remembered(tree: &str) -> Vec<String> {
    [
        format!("The decisions of `{tree}` where its memory is what the history says."),
        "A memory node starts over where a tick does not reach it, and the history stays: there the two may part."
            .to_owned(),
        "`btc verify --transitions FILE` compares them in an environment that was recorded.".to_owned(),
    ]
    .into()
}

fn irreducible(loaded: &Loaded, tree: &Tree, why: &Irreducible) -> Refused {
    let message = format!("`{}` has no canonical form", tree.name.family);
    let place = export::place(loaded, tree, &why.path);
    let diagnostic = Diagnostic::new(Code::E0819, place, message).label(why.message());
    Refused::program(loaded, [diagnostic])
}
