//! Trees without memory.
//!
//! A partition is held first: it costs little for any table. Then lists of rules and of classes, and a beam search over what they
//! are made of, look for a smaller tree. In a large table most rows say what others have said, so these work on a *core* of
//! the rows; the rows on which a tree for the core is wrong join it, until there are none.

use super::beams;
use super::children::Children;
use super::minimiser::Minimiser;
use super::orders::{in_order, tree as in_place};
use super::parted;
use super::problem::Problem;
use super::share::shared;
use super::subunit::behaviors;
use crate::ir::tree::Node;
use crate::logic::covering::{Known, List, grouped, lists};
use crate::logic::impurity::Impurity;
use crate::logic::partition::{Classified, Partition};
use crate::logic::{Account, Bits, Cover, Cube, Order};
use crate::policy::Policy;
use crate::tree::Size;

/// The most rows of a table that is its own core, and the rows of the first core of a larger one.
const WHOLE: usize = 1024;
const FIRST: usize = 512;
/// The most rows of a core in which a beam searches.
const SEARCHED: usize = 4096;
/// A list with fewer nodes than one for so many rows says that the table has structure.
const RARE: usize = 8;
/// The words that may be read in the search for one rule of one class.
pub(super) const REACH: u64 = 60_000;
/// Attempts at a smaller list before it is tried on all rows, and before the search for lists ends.
const QUICK: usize = 40;
pub(super) const THOROUGH: usize = 3000;

/// Tables of more rows have a price, and so have the proof and the print of their first tree: the words that are read of the table
/// before there is a tree, and those that it takes to prove and print what becomes of one leaf.
const PRICED: usize = 16_384;
const READS: u64 = 4;
const LEAF: u64 = 2500;

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
        if columns.rows() > PRICED {
            account.settle(&unlimited);
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
pub(super) fn trees(problem: &Problem, held: &Held, tight: bool, account: &Account) -> Vec<Node> {
    if account.is_spent() {
        return Vec::new();
    }
    let mut known = Known::default();
    if problem.policy.rows.len() <= WHOLE || problem.wide {
        let mut found = divided(problem, held, account);
        found.extend(searched(problem, &mut known, tight, account));
        return found;
    }
    let mut core = Core::first(problem);
    let part = account.part(2);
    let listed = core.lists(&mut known, &part);
    account.settle(&part);
    let mut found: Vec<Node> = Vec::new();
    if let Some(lists) = &listed {
        let listed = |list: &List| Children::listed(problem, list).node();
        found.extend(lists.iter().map(listed));
        let grouped = tight.then(|| in_groups(problem, lists, &mut known, account));
        found.extend(grouped.flatten().map(|(node, _)| node));
    }
    // A list of classes looks at a core of its own for each class.
    let minimiser = Minimiser::new(problem, account.part(3));
    let subunits = behaviors(problem);
    let list = in_order(&minimiser, &subunits, Order::Learned);
    found.extend(list.map(|list| shared(in_place(&minimiser, &subunits, &list))));
    account.settle(&minimiser.account);
    found.extend(divided(problem, held, account));
    if listed.is_none() {
        return found;
    }
    while core.rows.count() <= SEARCHED {
        let policy = core.policy();
        let part = account.part(2);
        let mut best = searched(&Problem::new(&policy), &mut known, tight, &part);
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

/// Some rows of a table.
struct Core<'a, 'p> {
    problem: &'a Problem<'p>,
    rows: Bits,
}

impl<'a, 'p> Core<'a, 'p> {
    /// Rows of every behaviour, evenly spread.
    fn first(problem: &'a Problem<'p>) -> Self {
        let count = problem.policy.rows.len();
        let mut rows = Bits::empty(count);
        for (_, own) in &problem.on {
            let size = own.count();
            let wanted = (FIRST * size).div_ceil(count).max(8);
            let step = size.div_ceil(wanted).max(1);
            rows.unite(&Bits::collect(count, own.iter().step_by(step)));
        }
        Self { problem, rows }
    }

    fn policy(&self) -> Policy {
        let whole = self.problem.policy;
        let rows = self.rows.iter();
        Policy {
            atoms: whole.atoms.clone(),
            behaviors: whole.behaviors.clone(),
            history: whole.history,
            rows: rows
                .filter_map(|row| whole.rows.get(row).cloned())
                .collect(),
            ..Policy::default()
        }
    }

    /// Lists for cores that grow until lists are right on all rows, first quickly, then thoroughly: those that are; `None` where no list
    /// is found at all.
    fn lists(&mut self, known: &mut Known, account: &Account) -> Option<Vec<List>> {
        let mut right = Vec::new();
        let mut patience = QUICK;
        loop {
            let policy = self.policy();
            let sample = Problem::new(&policy);
            let (columns, classes) = (sample.columns(), sample.classes());
            let found = lists(columns, &classes, REACH, patience, known, account);
            let best = found.into_iter().last();
            let node = |list: &List| Children::listed(&sample, list).node();
            match best.map(|best| (self.adopt(&node(&best), account), best)) {
                Some((true, best)) => {
                    right.push(best);
                    if patience == THOROUGH {
                        return Some(right);
                    }
                    patience = THOROUGH;
                }
                Some((false, _)) => {}
                None if right.is_empty() => return None,
                None => return Some(right),
            }
            let rows = self.rows.count();
            let structured = known
                .list
                .as_ref()
                .is_some_and(|list| list.nodes() * RARE < rows);
            if account.is_spent() || rows > SEARCHED && !structured {
                return Some(right);
            }
        }
    }

    /// Whether the tree is right on all rows. Else some rows on which it is wrong join the core.
    fn adopt(&mut self, tree: &Node, account: &Account) -> bool {
        let words = 24 + self.problem.columns().rows() as u64 / 64;
        account.spend(Size::of(tree).nodes as u64 * words);
        let Some(wrong) = self.problem.wrong(tree) else {
            return false;
        };
        let count = wrong.count();
        let step = count.div_ceil(self.rows.count() / 2).max(1);
        self.rows
            .unite(&Bits::collect(wrong.bound(), wrong.iter().step_by(step)));
        let all = self.problem.policy.rows.len();
        if 2 * self.rows.count() > all {
            self.rows = Bits::full(all);
        }
        count == 0
    }
}

/// Trees by all methods at once.
fn searched(problem: &Problem, known: &mut Known, tight: bool, account: &Account) -> Vec<Node> {
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
