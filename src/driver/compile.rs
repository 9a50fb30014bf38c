//! `btc compile`: what was built, as a summary or in another form.

use super::export;
use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit;
use crate::emit::form::TreeForm;
use crate::emit::steps::Steps;
use crate::ir::Id;
use crate::ir::name;
use crate::ir::tree::Tree;
use crate::report;
use crate::syntax::print;
use std::borrow::Cow;

/// The forms that a program or a tree can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The syntax tree.
    Ast,
    /// The checked program.
    Ir,
    /// One of the forms of trees; the language and JSON are forms of a whole program, too.
    Tree(TreeForm),
}

impl From<TreeForm> for Form {
    fn from(form: TreeForm) -> Self {
        Self::Tree(form)
    }
}

/// Writes a program, or one of its trees, in a form.
///
/// # Errors
/// There is no such tree, there are several and none is named, or a robot's library has no counterpart for a node.
pub fn emit(loaded: &Loaded, form: Form, tree: Option<&str>) -> Result<String, Refused> {
    emit_in_steps(loaded, form, tree, Steps::default())
}

/// The same with steps of its own.
///
/// # Errors
/// As [`emit()`].
pub fn emit_in_steps(
    loaded: &Loaded,
    form: Form,
    tree: Option<&str>,
    steps: Steps,
) -> Result<String, Refused> {
    let program = &loaded.program;
    let named = tree.map(|name| to_show(loaded, name)).transpose()?;
    match (form, named) {
        (Form::Ast, _) => Ok(emit::ast::file(&loaded.ast)),
        (Form::Ir, _) => Ok(emit::ir::program(program)),
        (Form::Tree(TreeForm::Bt), None) => {
            let text = loaded.sources.get(loaded.main).map(|s| s.text.as_str());
            Ok(print::file(&loaded.ast, text))
        }
        (Form::Tree(TreeForm::Json), None) => Ok(emit::json::program(program)),
        (Form::Tree(form), named) => {
            let tree = match named {
                Some(tree) => tree,
                None => Cow::Borrowed(one_tree(loaded)?),
            };
            export::of_program(loaded, &tree, (form, steps))
        }
    }
}

/// The tree of that name, or the script of another robot: a form of it asks nothing of a task.
fn to_show<'l>(loaded: &'l Loaded, name: &str) -> Result<Cow<'l, Tree>, Refused> {
    match target::tree(loaded, name) {
        Ok(id) => Ok(Cow::Borrowed(&loaded.program.trees[id])),
        Err(refused) => {
            let script = target::script(loaded, name).map(Cow::Owned);
            script.ok_or(refused)
        }
    }
}

fn one_tree(loaded: &Loaded) -> Result<&Tree, Refused> {
    let trees = &loaded.program.trees;
    let ids: Vec<Id<Tree>> = trees.ids().collect();
    match ids.as_slice() {
        [one] => Ok(&trees[*one]),
        _ => {
            let names = name::list(trees.values().map(|tree| &tree.name));
            let (message, label) = match ids.as_slice() {
                [] => (
                    "the program has no tree".to_owned(),
                    "`tree NAME = …` is missing",
                ),
                _ => (
                    format!("the program has several trees: {names}"),
                    "say which one with `--tree NAME`",
                ),
            };
            let place = target::place_of(loaded, "tree");
            let diagnostic = Diagnostic::new(Code::E0504, place, message).label(label);
            Err(Refused::program(loaded, [diagnostic]))
        }
    }
}

/// What was built, in lines for a person.
pub fn summary(loaded: &Loaded) -> String {
    report::program::summary(&loaded.program)
}
