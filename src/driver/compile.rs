//! `btc compile`: what was built, as a summary or in another form.

use super::export::{self, Runtime};
use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit;
use crate::ir::Id;
use crate::ir::name;
use crate::ir::tree::Tree;
use crate::report;
use crate::syntax::print;

/// The forms that a program or a tree can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Form {
    /// The syntax tree.
    Ast,
    /// The checked program.
    Ir,
    /// The language, laid out.
    Bt,
    /// Graphviz.
    Dot,
    /// JSON.
    Json,
    /// A picture.
    Svg,
    /// XML for BehaviorTree.CPP 4, Groot2 and Nav2.
    #[cfg_attr(feature = "cli", value(name = "btcpp"))]
    BtCpp,
    /// A Python module for py_trees 2.
    #[cfg_attr(feature = "cli", value(name = "py_trees"))]
    PyTrees,
}

impl Form {
    /// Whether a single tree has this form; the others are of a whole program.
    pub fn is_of_trees(self) -> bool {
        !matches!(self, Self::Ast | Self::Ir)
    }
}

impl From<Runtime> for Form {
    fn from(runtime: Runtime) -> Self {
        match runtime {
            Runtime::BtCpp => Self::BtCpp,
            Runtime::PyTrees => Self::PyTrees,
        }
    }
}

/// Writes a program, or one of its trees, in a form.
///
/// # Errors
/// There is no such tree, there are several and none is named, or a robot's library has no counterpart for a node.
pub fn emit(loaded: &Loaded, form: Form, tree: Option<&str>) -> Result<String, Refused> {
    let program = &loaded.program;
    let named = tree.map(|name| target::tree(loaded, name)).transpose()?;
    Ok(match (form, named) {
        (Form::Ast, _) => emit::ast::file(&loaded.ast),
        (Form::Ir, _) => emit::ir::program(program),
        (Form::Bt, None) => {
            let text = loaded.sources.get(loaded.main).map(|s| s.text.as_str());
            print::file(&loaded.ast, text)
        }
        (Form::Bt, Some(id)) => emit::bt::tree(program, &program.trees[id]),
        (Form::Dot, named) => {
            let tree = &program.trees[one_tree(loaded, named)?];
            emit::dot::tree(program, tree)
        }
        (Form::Svg, named) => {
            let tree = &program.trees[one_tree(loaded, named)?];
            emit::svg::tree::tree(program, tree)
        }
        (Form::BtCpp, named) => {
            export::of_program(loaded, one_tree(loaded, named)?, Runtime::BtCpp)?
        }
        (Form::PyTrees, named) => {
            export::of_program(loaded, one_tree(loaded, named)?, Runtime::PyTrees)?
        }
        (Form::Json, named) => emit::json::program(program, named),
    })
}

fn one_tree(loaded: &Loaded, named: Option<Id<Tree>>) -> Result<Id<Tree>, Refused> {
    let trees = &loaded.program.trees;
    if let Some(id) = named {
        return Ok(id);
    }
    let ids: Vec<Id<Tree>> = trees.ids().collect();
    match ids.as_slice() {
        [one] => Ok(*one),
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
            let place = target::end_of_file(loaded);
            let diagnostic = Diagnostic::new(Code::E0504, place, message).label(label);
            Err(Refused::program(loaded, [diagnostic]))
        }
    }
}

/// What was built, in lines for a person.
pub fn summary(loaded: &Loaded) -> String {
    report::program::summary(&loaded.program)
}
