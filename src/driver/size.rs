//! `btc size`: the sizes of trees, a measure of how well they read.

use super::load::Loaded;
use super::refused::Refused;
use super::target;
use crate::ir::Id;
use crate::ir::tree::{Node, Tree};
use crate::tree::Size;
use crate::tree::atoms::{atoms, behaviors};

/// The heads of the columns.
const HEADS: [&str; 5] = ["tree", "nodes", "literals", "depth", "leaves"];

/// The sizes of these trees, a row each under a header; of all trees if none is named.
///
/// # Errors
/// There is no tree of that name.
pub fn sizes(loaded: &Loaded, names: &[String]) -> Result<String, Refused> {
    let trees = &loaded.program.trees;
    let mut wrong = Vec::new();
    let mut ids: Vec<Id<Tree>> = Vec::new();
    for name in names {
        match target::tree(loaded, name) {
            Ok(id) => ids.push(id),
            Err(refused) => wrong.extend(refused.diagnostics),
        }
    }
    if !wrong.is_empty() {
        return Err(Refused::program(loaded, wrong));
    }
    if names.is_empty() {
        ids = trees.ids().collect();
    }
    let heads = HEADS.map(str::to_owned);
    let rows = ids.into_iter().map(|id| {
        let Tree { name, root, .. } = &trees[id];
        let size = Size::of(root);
        [
            name.to_string(),
            size.nodes.to_string(),
            size.literals.to_string(),
            size.depth.to_string(),
            leaves(root).to_string(),
        ]
    });
    let rows: Vec<[String; 5]> = std::iter::once(heads).chain(rows).collect();
    let width = |column: usize| {
        let cells = rows.iter().filter_map(|row| row.get(column));
        cells.map(|cell| cell.chars().count()).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..HEADS.len()).map(width).collect();
    Ok(rows.iter().map(|row| line(row, &widths)).collect())
}

/// Names to the left, figures to the right.
fn line(row: &[String; 5], widths: &[usize]) -> String {
    let [name, figures @ ..] = row;
    let mut widths = widths.iter();
    let mut text = format!("{name:<0$}", widths.next().copied().unwrap_or(0));
    for (figure, width) in figures.iter().zip(widths) {
        text.push_str(&format!("  {figure:>width$}"));
    }
    text.push('\n');
    text
}

/// The number of different leaves of a tree: the behaviours that it ticks and the atoms that it asks, negated or not.
fn leaves(root: &Node) -> usize {
    atoms(root).len() + behaviors(root).len()
}
