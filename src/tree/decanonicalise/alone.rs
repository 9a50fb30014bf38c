//! Trees without memory.
//!
//! A partition is held first: it costs little for any table. Then lists of rules and of classes, and a beam search over what they
//! are made of, look for a smaller tree. In a large table most rows say what others have said, so these work on a *core* of
//! the rows; the rows on which a tree for the core is wrong join it, until there are none.

use super::beams;
use super::children::Children;
use super::core::Core;
use super::minimiser::Minimiser;
use super::orders::{in_order, tree as in_place};
use super::parted;
use super::problem::Problem;
use super::share::shared;
use super::subunit::behaviors;
use crate::ir::tree::Node;
use crate::logic::covering::{Known, List, Sought, grouped, lists, top_down};
use crate::logic::impurity::Impurity;
use crate::logic::partition::{Classified, Partition};
use crate::logic::{Account, Cover, Cube, Order};
use crate::tree::Size;

/// The most rows of a table that is its own core.
pub(super) const WHOLE: usize = 1024;
/// The most rows of a core in which a beam searches.
pub(super) const SEARCHED: usize = 4096;
/// The words that may be read in the search for one rule of one class.
pub(super) const REACH: u64 = 60_000;
/// A list with fewer nodes than one for so many rows may have groups.
const LONG: usize = 2;
/// A tree that is so many times smaller than one by a partition is not one of those that a partition begins.
pub(super) const CLEAR: usize = 4;
/// The lists that are made from the top.
const SAMPLES: u64 = 6;
/// Attempts at a smaller list with groups before it is tried on all rows.
pub(super) const QUICK: usize = 15;
/// Attempts at a smaller list before the search for lists ends.
pub(super) const THOROUGH: usize = 3000;

/// Tables of more rows have a price, and so have the proof and the print of their first tree: the words that are read of the table
/// before there is a tree, and those that it takes to prove and print what becomes of one leaf.
const PRICED: usize = 16_384;
const READS: u64 = 4;
const LEAF: u64 = 2500;
/// One part in so many of an account that the partition of a smaller table may take free of charge.
const SMALL: usize = 32;

/// Partitions of all rows, and the trees that they come to.
pub(super) struct Held {
    partitions: Vec<Partition>,
    pub(super) trees: Vec<Node>,
}

/// Partitions by each measure. Only rows with many free atoms may spend an account before there is one.
///
/// Of a large table its own price is paid whatever is allowed, so that less is left to the search.
pub(super) fn held(problem: &Problem, account: &Account) -> Held {
    let columns = problem.columns();
    let classified = Classified::new(columns, &problem.classes());
    let by = |impurity: Impurity| {
        if problem.wide || impurity != Impurity::Gini {
            return classified.partition(impurity, account);
        }
        let unlimited = Account::unlimited();
        let partition = classified.partition(impurity, &unlimited);
        // So has a small one that takes long to divide, as of two behaviours in turns.
        if columns.rows() > PRICED || !account.part(SMALL).affords(unlimited.spent()) {
            account.settle(&unlimited);
        }
        if columns.rows() > PRICED {
            let leaves = partition.as_ref().map_or(0, Partition::leaves) as u64;
            let words = (columns.atoms() * columns.rows()) as u64 / 64;
            account.spend(READS * words + LEAF * leaves);
        }
        partition
    };
    let partitions: Vec<Partition> = Impurity::ALL.into_iter().filter_map(by).collect();
    let trees = partitions.iter().map(|p| parted::plain(problem, p).node());
    Held {
        trees: trees.collect(),
        partitions,
    }
}

/// Trees that are right on all rows, with groups if they are to be tight.
pub(super) fn trees(
    problem: &Problem,
    held: &Held,
    tight: bool,
    core: &mut Core,
    known: &mut Known,
    account: &Account,
) -> Vec<Node> {
    if account.is_spent() {
        return Vec::new();
    }
    if problem.policy.rows.len() <= WHOLE || problem.wide {
        let mut found = from_the_top(problem, tight, core, known, account);
        found.extend(divided(problem, held, account));
        found.extend(searched(problem, known, tight, account));
        return found;
    }
    let mut found = from_the_top(problem, tight, core, known, account);
    let part = account.part(4);
    let listed = core.lists(known, &part);
    account.settle(&part);
    let rows = core.rows.count();
    let list = known
        .list
        .clone()
        .filter(|list| tight && list.nodes() * LONG < rows);
    found.extend(list.and_then(|list| core.groups(list.into(), QUICK, known, account)));
    if let Some(lists) = &listed {
        let listed = |list: &List| Children::listed(problem, list).node();
        found.extend(lists.iter().map(listed));
        let grouped = tight.then(|| in_groups(problem, lists, known, account));
        found.extend(grouped.flatten().map(|(node, _)| node));
    }
    let least = |trees: &[Node]| trees.iter().map(|tree| Size::of(tree).nodes).min();
    let is_clear = least(&found).zip(least(&held.trees));
    if is_clear.is_none_or(|(own, held)| held <= CLEAR * own) {
        // A list of classes looks at a core of its own for each class.
        let minimiser = Minimiser::new(problem, account.part(3));
        let subunits = behaviors(problem);
        let list = in_order(&minimiser, &subunits, Order::Learned);
        found.extend(list.map(|list| shared(in_place(&minimiser, &subunits, &list))));
        account.settle(&minimiser.account);
        found.extend(divided(problem, held, account));
    }
    if listed.is_none() {
        return found;
    }
    while core.rows.count() <= SEARCHED {
        let policy = core.policy();
        let part = account.part(2);
        let mut best = searched(&Problem::new(&policy), known, tight, &part);
        account.settle(&part);
        best.sort_by_key(Size::of);
        best.truncate(TRIED);
        let mut grown = false;
        for tree in best {
            match core.adopt(&tree, account) {
                true => found.push(tree),
                false => grown = true,
            }
            if !grown {
                return found;
            }
        }
        if !grown || account.is_spent() {
            return found;
        }
    }
    found
}

/// Lists with groups that are made from the top, by samples of their own each, and what they come to where their parts are sought
/// anew. One sample may hide what another shows.
fn from_the_top(
    problem: &Problem,
    tight: bool,
    core: &mut Core,
    known: &mut Known,
    account: &Account,
) -> Vec<Node> {
    if !tight || problem.wide {
        return Vec::new();
    }
    let whole = account.part(2);
    let found = samples(problem, (Sought::Plain, usize::MAX), core, known, &whole);
    account.settle(&whole);
    found
}

/// Lists from the top for as many samples as an account allows. One with more than `most` nodes is the last.
pub(super) fn samples(
    problem: &Problem,
    (sought, most): (Sought, usize),
    core: &mut Core,
    known: &mut Known,
    whole: &Account,
) -> Vec<Node> {
    let (columns, classes) = (problem.columns(), problem.classes());
    let mut found = Vec::new();
    for sample in 0..SAMPLES {
        // The first may take all of it: if there is no list from one sample, there is none from the others.
        let part = match sample {
            0 => whole.part(1),
            _ => whole.part(2),
        };
        let made = top_down(columns, &classes, (sample, sought), most, &part);
        whole.settle(&part);
        let Some(list) = made else { break };
        found.push(Children::grouped(problem, &list).node());
        if list.nodes() > most {
            break;
        }
        let part = whole.part(2);
        found.extend(core.groups(list, QUICK, known, &part));
        whole.settle(&part);
    }
    found
}

/// The best grouped list from these lists, and its cubes.
fn in_groups(
    problem: &Problem,
    lists: &[List],
    known: &mut Known,
    account: &Account,
) -> Option<(Node, Vec<Cube>)> {
    if problem.wide {
        return None;
    }
    let part = account.part(3);
    let (columns, classes) = (problem.columns(), problem.classes());
    let best = known.list.take();
    let found = grouped(columns, &classes, lists, REACH, known, &part);
    known.list = best;
    account.settle(&part);
    let found = found?;
    let cubes = found.cubes().into_iter().cloned().collect();
    Some((Children::grouped(problem, &found).node(), cubes))
}

/// The partitions with lists in the places of their parts.
fn divided(problem: &Problem, held: &Held, account: &Account) -> Vec<Node> {
    let all = problem.all();
    let partitions = held.partitions.iter().map(|partition| {
        let part = account.part(6);
        let node = parted::with_lists(problem, partition, &all, &part).node();
        account.settle(&part);
        node
    });
    partitions.collect()
}

/// Trees for a core that are tried on all rows.
const TRIED: usize = 4;

/// Trees by all methods at once.
pub(super) fn searched(
    problem: &Problem,
    known: &mut Known,
    tight: bool,
    account: &Account,
) -> Vec<Node> {
    let subunits = behaviors(problem);
    let part = account.part(2);
    let (columns, classes) = (problem.columns(), problem.classes());
    let ruled: Vec<List> = lists(columns, &classes, REACH, THOROUGH, known, &part);
    account.settle(&part);
    let in_groups = tight.then(|| in_groups(problem, &ruled, known, account));
    let in_groups = in_groups.flatten();
    let orders = [Order::Learned, Order::Given, Order::Rarest];
    let minimisers = orders.map(|_| Minimiser::new(problem, account.part(6)));
    let in_orders = minimisers.into_iter().zip(orders);
    let in_orders = in_orders.filter_map(|(minimiser, order)| {
        let list = in_order(&minimiser, &subunits, order);
        let found = list.map(|list| (in_place(&minimiser, &subunits, &list), list));
        account.settle(&minimiser.account);
        found
    });
    let in_orders: Vec<_> = in_orders.collect();
    let node = |list: &List| Children::listed(problem, list).node();
    let mut found: Vec<Node> = ruled.iter().map(node).collect();
    found.extend(in_orders.iter().map(|(node, _)| node.clone()));
    if !problem.wide {
        let covers = in_orders.iter().flat_map(|(_, list)| list);
        let covers: Vec<&Cover> = covers.map(|(_, cover)| cover).collect();
        let cubes = ruled.iter().flat_map(|list| &list.rules);
        let cubes = cubes.map(|rule| &rule.cube);
        let inner = in_groups.iter().flat_map(|(_, cubes)| cubes);
        let cubes: Vec<&Cube> = cubes.chain(inner).collect();
        found.extend(beams::trees(problem, &subunits, &covers, &cubes, account));
    }
    found.extend(in_groups.map(|(node, _)| node));
    found.into_iter().map(shared).collect()
}
