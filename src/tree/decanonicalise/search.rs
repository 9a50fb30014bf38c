//! The search for the smallest tree.
//!
//! First trees without memory are sought ([`super::alone`]): one of them is held from the beginning. Then it is decided which
//! behaviours memory nodes join ([`super::memory`]). The subunits of each such configuration form a list in the wanted order
//! ([`super::orders`]). If the order is to be learned, beam searches start from that list ([`super::beams`]). All draw on one
//! account of work, and what runs at the same time has a part of it each, so that every machine finds the same tree on any
//! number of threads.

use super::alone::{self, CLEAR};
use super::beams;
use super::choices;
use super::complements::complemented;
use super::core::Core;
use super::exchanged::exchanged;
use super::memory::configurations;
use super::minimiser::{LARGE, Minimiser};
use super::optimum::optimum;
use super::orders::{in_order, tree as listed};
use super::parts;
use super::problem::Problem;
use super::share::shared;
use super::subunit::{Subunit, behaviors};
use super::windows::Windows;
use super::{Proof, Stage, paper};
use crate::ir::tree::Node;
use crate::logic::covering::{Known, Sought};
use crate::logic::{Account, Cover, Order};
use crate::tree::Size;
use crate::tree::prune::asked_once;
use rayon::prelude::*;

/// The most trees whose proof is tried, smallest first.
const PROOFS: usize = 256;

/// The trees whose windows are looked at, smallest first.
const TIGHT: usize = 8;
/// Attempts at a smaller tree with groups before the search ends.
const THOROUGH: usize = 100;
/// The most nodes of a tree whose windows are looked at.
const WINDOWED: usize = 2000;

/// The fewest nodes of a tree beside which a list may be lost.
const LOST: usize = 300;
/// A list for some of the rows is made right on all of them if it is so many times smaller than the smallest tree.
const SMALLER: usize = 2;

/// One part in so many of an account is for trees that ask some atoms last.
const CHOICES: usize = 8;

/// What a search came to.
pub(super) struct Found {
    /// The smallest tree that was found, with its proof.
    pub(super) tree: Option<(Node, Proof)>,
    /// The tree of Algorithm 1, if it was run to its end.
    pub(super) paper: Option<Node>,
    /// What was left unfinished because the effort was spent.
    pub(super) unfinished: Vec<Stage>,
}

/// A tree in a wanted order.
pub(super) fn ordered(problem: &Problem, order: Order, account: &Account) -> Option<(Node, Proof)> {
    let minimiser = Minimiser::new(problem, Account::unlimited());
    let mut found: Vec<(Size, Node)> = Vec::new();
    for subunits in configurations(&Minimiser::new(problem, account.part(2))) {
        let list = in_order(&minimiser, &subunits, order)?;
        let node = listed(&minimiser, &subunits, &list);
        found.push((Size::of(&node), node));
    }
    smallest(problem, found, false)
}

/// The smallest tree that was found and proved, with groups and solved windows if it is to be tight.
pub(super) fn tree(problem: &Problem, is_tight: bool, account: &Account) -> Found {
    let mut unfinished = Vec::new();
    let held = alone::held(problem, account);
    let mut trees = held.trees.clone();
    let optimum = optimum(problem, account);
    let is_small = optimum.is_some();
    trees.extend(optimum);
    let mut paper = None;
    if problem.policy.rows.len() <= LARGE {
        let minimiser = Minimiser::new(problem, account.part(5));
        paper = paper::tree(&minimiser);
        account.settle(&minimiser.account);
        match &paper {
            Some(paper) => trees.insert(0, paper.clone()),
            None => unfinished.push(Stage::Paper),
        }
    }
    let minimiser = Minimiser::new(problem, account.part(5));
    let configurations = configurations(&minimiser);
    account.settle(&minimiser.account);
    if minimiser.account.is_spent() {
        unfinished.push(Stage::Memory);
    }
    let with_memory = configurations.get(1..).unwrap_or_default();
    let half = match with_memory.is_empty() {
        // Little is left to find.
        _ if is_small => account.part(8),
        // The rest is for the parts of the smallest trees.
        true if is_tight => account.but(4),
        true => account.part(1),
        false => account.part(2),
    };
    let mut known = Known::default();
    let mut core = Core::first(problem);
    trees.extend(alone::trees(
        problem, &held, is_tight, &mut core, &mut known, &half,
    ));
    account.settle(&half);
    if is_tight {
        let both = (&held.trees[..], &trees[..]);
        trees.extend(further(problem, both, &mut core, &mut known, account));
    }
    let parts: Vec<(&Vec<Subunit>, Account)> = with_memory
        .iter()
        .map(|subunits| (subunits, account.part(with_memory.len())))
        .collect();
    let found: Vec<Vec<Node>> = parts
        .par_iter()
        .map(|(subunits, part)| joined(problem, subunits, part))
        .collect();
    parts.iter().for_each(|(_, part)| account.settle(part));
    trees.extend(found.into_iter().flatten());
    if half.is_spent() || parts.iter().any(|(_, part)| part.is_spent()) {
        unfinished.push(Stage::Search);
    }
    let mut trees = sized(trees);
    if is_tight {
        tightened(problem, &mut trees, account);
    }
    if is_tight && !is_small {
        regrouped(problem, &mut trees, &mut core, &mut known, account);
    }
    let mut tree = smallest(problem, trees, true);
    if is_tight && !is_small {
        let known = tree.as_ref().map(|(tree, _)| tree);
        let other = with_choices(problem, known, account);
        let smaller =
            |(other, _): &(Node, Proof)| known.is_none_or(|tree| Size::of(other) < Size::of(tree));
        if let Some(other) = other.filter(smaller) {
            tree = Some(other);
        }
    }
    if tree.is_none() {
        // No partition of rows that leave atoms free.
        let minimiser = Minimiser::new(problem, Account::unlimited());
        let subunits = behaviors(problem);
        let list = in_order(&minimiser, &subunits, Order::Learned);
        let listed = list.map(|list| listed(&minimiser, &subunits, &list));
        tree = smallest(problem, sized(listed.into_iter().collect()), true);
    }
    Found {
        tree,
        paper,
        unfinished,
    }
}

/// The smallest tree that asks some atoms last, or of which parts were sought as tables of their own. It has a part of the account for
/// itself, whatever the others leave of it: so none of them finds less than without it.
fn with_choices(
    problem: &Problem,
    known: Option<&Node>,
    account: &Account,
) -> Option<(Node, Proof)> {
    if problem.policy.rows.len() > LARGE || !problem.policy.transitions.is_empty() {
        return None;
    }
    let own = account.again(1).part(CHOICES);
    let trees = choices::trees(problem, known, &own);
    account.settle(&own);
    smallest(problem, sized(trees), true)
}

/// What is found beyond the account: a list for some of the rows that is much smaller than what was found for all of them is made right
/// on these; and where no list was found, one is sought with more patience, for a partition of a table that has one is many times
/// larger.
fn further(
    problem: &Problem,
    (held, trees): (&[Node], &[Node]),
    core: &mut Core,
    known: &mut Known,
    account: &Account,
) -> Vec<Node> {
    let (Some(held), Some(least)) = (smallest_of(held), smallest_of(trees)) else {
        return Vec::new();
    };
    if problem.wide || least < LOST {
        return Vec::new();
    }
    let finish = |core: &mut Core, known: &mut Known, least: usize| {
        let list = core.unfinished.take();
        let list = list.filter(|list| list.nodes() * SMALLER < least)?;
        core.groups(list, alone::QUICK, known, &account.again(1))
    };
    if let Some(found) = finish(core, known, least) {
        return vec![found];
    }
    if least * CLEAR <= held {
        return Vec::new();
    }
    // Other samples cost as much as the first, and seldom lead to a clearly smaller list where that did not.
    let sought = (Sought::Any, held / CLEAR);
    let mut found = alone::samples(problem, sought, core, known, &account.again(1).part(2));
    let least = smallest_of(&found).map_or(least, |own| own.min(least));
    found.extend(finish(core, known, least));
    found
}

/// The nodes of the smallest tree.
fn smallest_of(trees: &[Node]) -> Option<usize> {
    trees.iter().map(|tree| Size::of(tree).nodes).min()
}

fn sized(trees: Vec<Node>) -> Vec<(Size, Node)> {
    let trees = trees.into_iter();
    trees.map(|node| (Size::of(&node), node)).collect()
}

/// The smallest of these trees, smallest first.
fn least(found: &mut Vec<(Size, Node)>) -> Vec<Node> {
    found.sort_by_key(|(size, _)| *size);
    found.dedup_by(|a, b| a.1 == b.1);
    let small = found.iter().take(TIGHT);
    let small = small.filter(|(size, _)| size.nodes <= WINDOWED);
    small.map(|(_, tree)| tree.clone()).collect()
}

/// The smallest trees with smaller windows join them.
fn tightened(problem: &Problem, found: &mut Vec<(Size, Node)>, account: &Account) {
    let part = account.part(4);
    let mut windows = Windows::new(problem, &part);
    let trees = least(found);
    let tight = trees.iter().filter_map(|tree| windows.tightened(tree));
    found.extend(sized(tight.collect()));
    account.settle(&part);
}

/// The smallest trees with parts that are sought anew join them, and these with smaller windows.
fn regrouped(
    problem: &Problem,
    found: &mut Vec<(Size, Node)>,
    core: &mut Core,
    known: &mut Known,
    account: &Account,
) {
    for tree in least(found) {
        let list = parts::listed(problem, &tree);
        let tree = list.and_then(|list| core.groups(list, THOROUGH, known, account));
        let Some(tree) = tree.map(shared) else {
            continue;
        };
        let tight = Windows::new(problem, account).tightened(&tree);
        found.extend(sized(tight.into_iter().chain([tree]).collect()));
    }
}

/// The smallest of these that is proved. What a tree asks twice in a tick it asks once; and where no order is wanted, as `free`
/// says, the sides of choices are exchanged.
fn smallest(problem: &Problem, found: Vec<(Size, Node)>, free: bool) -> Option<(Node, Proof)> {
    let once = found.iter().map(|(_, node)| {
        let once = asked_once(node);
        let shared = shared(once.clone());
        match Size::of(&shared) < Size::of(&once) {
            true => shared,
            false => once,
        }
    });
    let mut once: Vec<Node> = once.collect();
    let complemented = once.iter().filter_map(|node| complemented(problem, node));
    let complemented: Vec<Node> = complemented.collect();
    once.extend(complemented);
    let mut found = sized(once);
    // Stable: of equal sizes the first found stands first.
    found.sort_by_key(|(size, _)| *size);
    found.dedup_by(|a, b| a.1 == b.1);
    let small = found.iter().take(if free { TIGHT } else { 0 });
    let exchanged = small.filter_map(|(_, node)| exchanged(problem, node));
    let exchanged: Vec<Node> = exchanged.collect();
    found.extend(sized(exchanged));
    found.sort_by_key(|(size, _)| *size);
    let mut smallest = found.into_iter().take(PROOFS);
    smallest.find_map(|(_, node)| {
        let proof = problem.prover().prove(&node).ok()?;
        Some((node, proof))
    })
}

/// Trees over the subunits of one configuration with memory nodes.
pub(super) fn joined(problem: &Problem, subunits: &[Subunit], account: &Account) -> Vec<Node> {
    // In a small table the search starts from lists in other orders as well.
    let orders = match problem.policy.rows.len() <= LARGE {
        true => &[Order::Learned, Order::Given, Order::Rarest][..],
        false => &[Order::Learned],
    };
    let minimiser = Minimiser::new(problem, account.part(3));
    let lists = orders.iter();
    let lists = lists.filter_map(|order| in_order(&minimiser, subunits, *order));
    let lists: Vec<_> = lists.collect();
    let bases = lists.iter().map(|list| listed(&minimiser, subunits, list));
    let bases: Vec<Node> = bases.collect();
    account.settle(&minimiser.account);
    let covers: Vec<&Cover> = lists.iter().flatten().map(|(_, cover)| cover).collect();
    let searched = beams::trees(problem, subunits, &covers, &[], account);
    bases.into_iter().chain(searched).map(shared).collect()
}
