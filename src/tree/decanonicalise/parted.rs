//! Partitions as trees: a unit for one part of each division, and what follows it for the other.

use super::children::Children;
use super::problem::Problem;
use crate::logic::covering::{Worth, covering};
use crate::logic::partition::Partition;
use crate::logic::{Account, Bits, Cube, Literal};

/// The most rows of a part for which a list of rules is tried as well.
const LIST: usize = 512;
/// The words that may be read in the search for one rule of such a list.
const REACH: u64 = 4_000;

/// The children of a selector that decides as the partition does.
pub(super) fn plain(problem: &Problem, partition: &Partition) -> Children {
    match partition {
        Partition::Leaf(class) => Children::leaf(problem, *class),
        Partition::Split { atom, parts } => {
            let [zero, one] = &**parts;
            Children::divided(problem, *atom, plain(problem, zero), plain(problem, one))
        }
    }
}

/// The same with a list of rules in the place of each part where that is smaller, as far as the account goes.
pub(super) fn with_lists(
    problem: &Problem,
    partition: &Partition,
    rows: &Bits,
    account: &Account,
) -> Children {
    let Partition::Split { atom, parts } = partition else {
        return plain(problem, partition);
    };
    if account.is_spent() {
        return plain(problem, partition);
    }
    let columns = problem.columns();
    let part = |positive| {
        let literal = Literal {
            atom: *atom,
            positive,
        };
        columns.cube_meets(&Cube::new([literal]), rows)
    };
    account.spend(2 * columns.rows() as u64 / 64);
    let [zero, one] = &**parts;
    let zero = with_lists(problem, zero, &part(false), account);
    let one = with_lists(problem, one, &part(true), account);
    let divided = Children::divided(problem, *atom, zero, one);
    let count = rows.count();
    if !(3..=LIST).contains(&count) {
        return divided;
    }
    let classes = problem.classes();
    let worth = Worth::plain(classes.len(), REACH);
    let limit = divided.price.nodes;
    let listed = covering(columns, &classes, rows, &worth, limit, account);
    match listed.map(|list| Children::listed(problem, &list)) {
        Some(listed) if listed.price < divided.price => listed,
        _ => divided,
    }
}
