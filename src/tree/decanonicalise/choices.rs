//! Trees that ask some atoms last, and trees of which parts are sought as tables of their own.

use super::alone::searched;
use super::deferred::configurations;
use super::problem::Problem;
use super::reach::Parts;
use super::search::joined;
use super::subtables::Subtables;
use super::subunit::Subunit;
use super::windows::Windows;
use crate::ir::tree::Node;
use crate::logic::Account;
use crate::logic::covering::Known;
use crate::tree::Size;
use rayon::prelude::*;

/// Trees that ask some atoms last, and the smallest of these and of a known one with smaller parts.
pub(super) fn trees(problem: &Problem, known: Option<&Node>, account: &Account) -> Vec<Node> {
    let part = account.part(2);
    let mut found = deferring(problem, &part);
    account.settle(&part);
    let best = found.iter().chain(known).min_by_key(|tree| Size::of(tree));
    let Some(best) = best.cloned() else {
        return found;
    };
    let part = account.part(2);
    let seek = |table: &Problem, account: &Account| {
        let mut trees = deferring(table, &account.part(2));
        trees.extend(searched(table, &mut Known::default(), true, account));
        trees
    };
    let smaller = Subtables::new(problem, &part, seek).smaller(&best);
    account.settle(&part);
    let best = smaller.clone().unwrap_or(best);
    found.extend(smaller);
    found.extend(Windows::new(problem, account).tightened(&best));
    found
}

/// Trees that ask some atoms last.
fn deferring(problem: &Problem, account: &Account) -> Vec<Node> {
    let part = account.part(2);
    let configurations = configurations(problem, &part);
    account.settle(&part);
    let parts = configurations.len();
    let parts: Vec<(&Vec<Subunit>, Account)> = configurations
        .iter()
        .map(|subunits| (subunits, account.part(parts)))
        .collect();
    let found = parts
        .par_iter()
        .map(|(subunits, part)| joined(problem, subunits, part));
    let found: Vec<Vec<Node>> = found.collect();
    parts.iter().for_each(|(_, part)| account.settle(part));
    found.into_iter().flatten().collect()
}
