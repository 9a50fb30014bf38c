//! Atoms that are asked last.
//!
//! A table may be small once some of its atoms are set aside: rows that are alike in all others then make one *column*, and what a
//! column decides by the atoms set aside is its *choice* (functional decomposition: Ashenhurst 1957, Curtis 1962, Roth and
//! Karp 1962). Where the columns come to few choices, a list of these is all that is needed: guards over the other atoms, each
//! before a body that asks the atoms set aside.
//!
//! ```text
//! selector { from < to => selector { open => close, up }, to < from => selector { open => close, down }, open => wait, open }
//! ```
//!
//! Nothing else finds such a list by its parts: no literal and no cube before a group lets one choice through, and each choice holds
//! several behaviours. The same serves parities: of six atoms, the choices by two of them are two, equal or not.
//!
//! Rows that the table does not have are free, so columns whose choices nowhere differ share one.

use super::optimum::Division;
use super::problem::Problem;
use super::subunit::Subunit;
use crate::ir::tree::{Atom, Node};
use crate::logic::impurity::Impurity;
use crate::logic::partition::{Classified, Partition};
use crate::logic::{Account, Bits};
use crate::tree::Size;
use crate::tree::unit::selector;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BTreeMap;

/// The most kinds of rows by the atoms set aside, and the most choices.
const KINDS: usize = 8;
const CHOICES: usize = 24;
/// The most choices before those that nowhere differ are one.
const FOUND: usize = 512;
/// One row in so many stands in a column with another kind of rows, or the table says too little of its choices.
const TOLD: usize = 2;
/// Sets of atoms to which each other atom is added, and those of which lists are made.
const WIDTH: usize = 4;
const LISTED: usize = 4;
/// The nodes that a part of a partition comes to, about.
const LEAF: usize = 3;

/// What a column decides by each kind of rows; `None` where the table has no such row.
type Choice = Vec<Option<usize>>;

/// Some atoms set aside.
struct Deferred {
    atoms: Vec<usize>,
    subunits: Vec<Subunit>,
    /// The nodes of a tree, about.
    nodes: usize,
}

/// The choices by the most promising sets of atoms, as subunits of a list.
pub(super) fn configurations(problem: &Problem, account: &Account) -> Vec<Vec<Subunit>> {
    if problem.wide || problem.on.len() < 2 {
        return Vec::new();
    }
    let search = Search::new(problem, account);
    let mut found = search.promising();
    found.truncate(LISTED);
    found
        .into_iter()
        .map(|deferred| deferred.subunits)
        .collect()
}

struct Search<'a, 'p> {
    problem: &'a Problem<'p>,
    account: &'a Account,
    /// The class of each row.
    classes: Vec<usize>,
}

impl<'a, 'p> Search<'a, 'p> {
    fn new(problem: &'a Problem<'p>, account: &'a Account) -> Self {
        let mut classes = vec![0; problem.columns().rows()];
        for (class, (_, rows)) in problem.on.iter().enumerate() {
            for row in rows.iter() {
                if let Some(slot) = classes.get_mut(row) {
                    *slot = class;
                }
            }
        }
        Self {
            problem,
            account,
            classes,
        }
    }

    /// Sets of atoms with which a tree seems smaller than without any, the best first. Atoms join the best sets one by one, as long
    /// as any of them seems better so.
    fn promising(&self) -> Vec<Deferred> {
        let atoms = self.problem.columns().atoms();
        let Some(mut least) = self.nodes(&self.problem.classes()) else {
            return Vec::new();
        };
        least += self.problem.on.len();
        let mut found: Vec<Deferred> = Vec::new();
        let mut tried: Vec<Vec<usize>> = Vec::new();
        let mut open: Vec<Vec<usize>> = vec![Vec::new()];
        while !open.is_empty() {
            let mut grown: Vec<Deferred> = Vec::new();
            for known in &open {
                for atom in (0..atoms).filter(|atom| !known.contains(atom)) {
                    let mut with = known.clone();
                    with.push(atom);
                    with.sort_unstable();
                    if self.account.is_spent() || tried.contains(&with) {
                        continue;
                    }
                    tried.push(with.clone());
                    grown.extend(self.deferred(with).filter(|new| new.nodes < least));
                }
            }
            grown.sort_by_key(|new| new.nodes);
            let best = grown.iter().take(WIDTH);
            open = best.map(|new| new.atoms.clone()).collect();
            found.extend(grown);
        }
        found.sort_by_key(|new| new.nodes);
        found
    }

    /// The nodes of the guards that tell these classes, about; `None` if the account is spent.
    fn nodes(&self, classes: &[Bits]) -> Option<usize> {
        let columns = self.problem.columns();
        let words = columns.atoms() * columns.rows() / 64;
        self.account.spend((8 * words + columns.rows()) as u64);
        let classified = Classified::new(columns, classes);
        let parts = classified.partition(Impurity::Gini, self.account);
        parts
            .as_ref()
            .map(Partition::leaves)
            .map(|leaves| LEAF * leaves)
    }

    /// What the table comes to with these atoms set aside; `None` where they have too many kinds of rows or make too many choices,
    /// or where hardly any row tells of a choice.
    fn deferred(&self, atoms: Vec<usize>) -> Option<Deferred> {
        let rows = self.problem.all();
        let named: Vec<Atom> = atoms
            .iter()
            .filter_map(|atom| self.problem.policy.atoms.get(*atom).copied())
            .collect();
        let kinds = self.problem.kinds(&rows, &named, KINDS, self.account)?;
        let choices = merged(self.choices(&atoms, &kinds)?);
        if choices.len() > CHOICES {
            return None;
        }
        let mut subunits: Vec<Subunit> = Vec::new();
        for (choice, rows) in choices {
            let body = self.body(&choice, &kinds, &named)?;
            match subunits.iter_mut().find(|subunit| subunit.body == body) {
                Some(same) => same.rows.unite(&rows),
                None => subunits.push(Subunit {
                    body,
                    rows,
                    last: None,
                    guards_itself: false,
                }),
            }
        }
        let classes: Vec<Bits> = subunits.iter().map(|s| s.rows.clone()).collect();
        let bodies = subunits.iter().map(|s| Size::of(&s.body).nodes);
        let nodes = self.nodes(&classes)? + bodies.sum::<usize>();
        Some(Deferred {
            atoms,
            subunits,
            nodes,
        })
    }

    /// The choices, and the rows of the columns that make each.
    fn choices(&self, atoms: &[usize], kinds: &[Bits]) -> Option<BTreeMap<Choice, Bits>> {
        let rows = &self.problem.policy.rows;
        let words = self.problem.columns().atoms().div_ceil(64);
        self.account.spend((rows.len() * (8 + words)) as u64);
        let mut kind_of = vec![0; rows.len()];
        for (kind, own) in kinds.iter().enumerate() {
            for row in own.iter() {
                if let Some(slot) = kind_of.get_mut(row) {
                    *slot = kind;
                }
            }
        }
        let mut aside = vec![0_u64; words];
        for atom in atoms {
            if let Some(word) = aside.get_mut(atom / 64) {
                *word |= 1 << (atom % 64);
            }
        }
        let mut numbers: FxHashMap<Vec<u64>, usize> = FxHashMap::default();
        let mut columns: Vec<(Choice, Vec<usize>)> = Vec::new();
        for (number, row) in rows.iter().enumerate() {
            let others = row.minterm.words().iter().zip(&aside);
            let others: Vec<u64> = others.map(|(word, aside)| word & !aside).collect();
            let at = *numbers.entry(others).or_insert_with(|| {
                columns.push((vec![None; kinds.len()], Vec::new()));
                columns.len() - 1
            });
            let kind = kind_of.get(number).copied().unwrap_or(0);
            let class = self.classes.get(number).copied();
            let (choice, members) = columns.get_mut(at)?;
            if let Some(slot) = choice.get_mut(kind) {
                *slot = class;
            }
            members.push(number);
        }
        let told = columns.iter().filter(|(choice, _)| known(choice) > 1);
        let told: usize = told.map(|(_, members)| members.len()).sum();
        if told * TOLD < rows.len() {
            return None;
        }
        let mut choices: BTreeMap<Choice, Bits> = BTreeMap::new();
        for (choice, members) in columns {
            let none = || self.problem.none();
            let own = choices.entry(choice).or_insert_with(none);
            members.into_iter().for_each(|row| own.insert(row));
        }
        (choices.len() <= FOUND).then_some(choices)
    }

    /// The smallest tree for a choice.
    fn body(&self, choice: &Choice, kinds: &[Bits], asked: &[Atom]) -> Option<Node> {
        let told = choice.iter().zip(kinds);
        let told: Vec<(usize, &Bits)> = told
            .filter_map(|(class, kind)| class.map(|class| (class, kind)))
            .collect();
        self.account.spend(Division::work(told.len()));
        let set = |holds: &dyn Fn(usize, &Bits) -> bool| {
            let kinds = told.iter().enumerate();
            let own = kinds.filter(|(_, (class, kind))| holds(*class, kind));
            own.fold(0, |all, (at, _)| all | 1 << at)
        };
        let columns: Option<Vec<usize>> = asked
            .iter()
            .map(|atom| {
                let column = self.problem.column(*atom)?;
                Some(set(&|_, kind| !kind.is_disjoint(column)))
            })
            .collect();
        let bodies = self.problem.on.iter().enumerate();
        let bodies = bodies
            .map(|(own, (behavior, _))| (Node::Behavior(*behavior), set(&|class, _| class == own)));
        let bodies = bodies.filter(|(_, kinds)| *kinds != 0).collect();
        let division = Division::new(told.len(), columns?, bodies);
        Some(selector(division.children(asked)))
    }
}

/// How many kinds of rows a choice tells of.
fn known(choice: &Choice) -> usize {
    choice.iter().flatten().count()
}

/// The choices, those that nowhere differ as one: each joins the first that tells more.
fn merged(choices: BTreeMap<Choice, Bits>) -> Vec<(Choice, Bits)> {
    let mut choices: Vec<(Choice, Bits)> = choices.into_iter().collect();
    // Stable: of those that tell as much of as many rows the first stays first.
    choices.sort_by_cached_key(|(choice, rows)| (Reverse(known(choice)), Reverse(rows.count())));
    let mut merged: Vec<(Choice, Bits)> = Vec::new();
    for (choice, rows) in choices {
        let agrees = |other: &Choice| {
            let pairs = other.iter().zip(&choice);
            let mut both = pairs.filter_map(|(a, b)| a.zip(*b));
            both.all(|(a, b)| a == b)
        };
        match merged.iter_mut().find(|(other, _)| agrees(other)) {
            Some((other, own)) => {
                for (slot, class) in other.iter_mut().zip(&choice) {
                    *slot = slot.or(*class);
                }
                own.unite(&rows);
            }
            None => merged.push((choice, rows)),
        }
    }
    merged
}
