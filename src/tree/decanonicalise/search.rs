//! The search for a smaller tree than Algorithm 1 finds.
//!
//! First it is decided which behaviours memory nodes join ([`super::memory`]). The subunits of each such configuration form
//! a list in the wanted order ([`super::orders`]). If the order is to be learned, a beam search starts from that list
//! ([`super::beam`]). Work is counted, not timed, and each search has its own share of it, so that every machine finds
//! the same tree on any number of threads.

use super::beam::{Beam, Bounds};
use super::memory::configurations;
use super::minimiser::{LARGE, Minimiser};
use super::orders::{in_order, tree as listed};
use super::problem::Problem;
use super::rules::Rules;
use super::share::shared;
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::Order;
use crate::tree::Size;
use rayon::prelude::*;

/// The beams: one without groups, and one with groups.
const BEAMS: [Bounds; 2] = [
    Bounds {
        width: 24,
        inner: 1,
        depth: 1,
    },
    Bounds {
        width: 8,
        inner: 2,
        depth: 3,
    },
];
/// The most trees whose proof is tried, smallest first.
const PROOFS: usize = 256;

/// The smallest tree that was found and proved; `None` if none was proved. If the order is to be learned, the tree of
/// Algorithm 1 is among them.
pub(super) fn tree(
    problem: &Problem,
    paper: Option<&Node>,
    order: Order,
    effort: u64,
) -> Option<Node> {
    let configurations = configurations(&Minimiser::new(problem, u64::MAX));
    let share = effort / configurations.len().max(1) as u64;
    let found: Vec<Vec<Node>> = configurations
        .par_iter()
        .map(|subunits| trees(problem, subunits, order, share))
        .collect();
    let mut found: Vec<(Size, Node)> = found
        .into_iter()
        .flatten()
        .map(|node| (Size::of(&node), node))
        .collect();
    if let (Order::Learned, Some(paper)) = (order, paper) {
        found.insert(0, (Size::of(paper), paper.clone()));
    }
    // Stable: of equal sizes the first found stands first.
    found.sort_by_key(|(size, _)| *size);
    found.dedup_by(|a, b| a.1 == b.1);
    let mut smallest = found.into_iter().take(PROOFS).map(|(_, node)| node);
    smallest.find(|node| problem.proves(node))
}

/// Trees over the subunits of one configuration.
fn trees(problem: &Problem, subunits: &[Subunit], order: Order, effort: u64) -> Vec<Node> {
    let minimiser = Minimiser::new(problem, effort / BEAMS.len() as u64);
    let searches = order == Order::Learned && !problem.wide;
    // In a small table the search starts from lists in other orders as well.
    let orders = match searches && problem.policy.rows.len() <= LARGE {
        true => vec![order, Order::Given, Order::Rarest],
        false => vec![order],
    };
    let lists = orders.into_iter();
    let lists: Vec<_> = lists
        .map(|order| in_order(&minimiser, subunits, order))
        .collect();
    let bases = lists.iter().map(|list| listed(&minimiser, subunits, list));
    let bases: Vec<Node> = bases.collect();
    if !searches {
        return bases;
    }
    let searched = BEAMS.par_iter().map(|bounds| {
        let minimiser = Minimiser::new(problem, effort / BEAMS.len() as u64);
        let useful = lists.iter().flatten().map(|(_, cover)| cover);
        let rules = Rules::new(&minimiser, useful);
        Beam::new(&minimiser, subunits, rules, *bounds).trees()
    });
    let searched: Vec<Vec<Node>> = searched.collect();
    let all = bases.into_iter().chain(searched.into_iter().flatten());
    all.map(shared).collect()
}
