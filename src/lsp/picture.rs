//! A tree as a picture, for a panel beside the text.

use super::analysis::Analysis;
use super::outline::whole_tree;
use crate::driver::compile;
use crate::emit::form::TreeForm;
use crate::syntax::ast;
use gen_lsp_types::{Position, Uri};
use serde::{Deserialize, Serialize};

/// The command that asks for a picture.
pub(super) const COMMAND: &str = "btc.tree";

/// The tree that is asked for: the one at a place, else the one of that name, else the first.
#[derive(Deserialize)]
pub(super) struct Wanted {
    pub(super) uri: Uri,
    position: Option<Position>,
    tree: Option<String>,
}

/// A picture, or why there is none.
#[derive(Serialize)]
pub(super) struct Picture {
    /// The trees of the program, those of the main file first.
    trees: Vec<String>,
    /// The tree of the picture.
    #[serde(skip_serializing_if = "Option::is_none")]
    tree: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    svg: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    problem: Option<String>,
}

/// The picture of a tree of the program. Which trees there are is known of a program with mistakes as well.
pub(super) fn picture(analysis: &Analysis, wanted: Wanted) -> Picture {
    let trees = analysis.loaded.asts().flat_map(trees);
    let trees: Vec<String> = trees.map(|tree| tree.name.name.clone()).collect();
    let here = wanted.position.and_then(|at| tree_at(analysis, at));
    let tree = here.or(wanted.tree).or_else(|| trees.first().cloned());
    let drawn = match &tree {
        Some(tree) => drawn(analysis, tree),
        None => Err("the program has no tree".to_owned()),
    };
    let (svg, problem) = match drawn {
        Ok(svg) => (Some(svg), None),
        Err(problem) => (None, Some(problem)),
    };
    Picture {
        trees,
        tree,
        svg,
        problem,
    }
}

fn drawn(analysis: &Analysis, tree: &str) -> Result<String, String> {
    let loaded = &analysis.loaded;
    if loaded.has_errors() {
        return Err("the program has mistakes".to_owned());
    }
    let drawn = compile::emit(loaded, TreeForm::Svg.into(), Some(tree));
    drawn.map_err(|refused| {
        let messages = refused.diagnostics.into_iter().map(|it| it.message);
        messages.collect::<Vec<String>>().join("; ")
    })
}

/// The name of the tree in whose text a place of the main file lies.
fn tree_at(analysis: &Analysis, position: Position) -> Option<String> {
    let byte = analysis.byte(position);
    let items = analysis.loaded.ast.items.iter();
    let mut here = items.filter(|item| (item.span.start..=item.span.end).contains(&byte));
    Some(whole_tree(here.next()?)?.name.name.clone())
}

fn trees(file: &ast::File) -> impl Iterator<Item = &ast::Tree> {
    file.items.iter().filter_map(whole_tree)
}
