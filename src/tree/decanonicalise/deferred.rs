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
//! Rows that the table does not have are free. So columns whose choices nowhere differ share one, and a column that tells little may
//! be of several: it is given to one of them as a partition finds it best.

use super::allowed::by_parts;
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
use std::collections::{BTreeMap, BTreeSet};

/// The most kinds of rows by the atoms set aside, and the most choices.
const KINDS: usize = 8;
const CHOICES: usize = 24;
/// The most choices before those that nowhere differ are one.
const FOUND: usize = 512;
/// One row in so many stands in a column with another kind of rows, or the table says too little of its choices.
const TOLD: usize = 8;
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
        let rows = problem.columns().rows();
        let classes = numbers(rows, problem.on.iter().map(|(_, own)| own));
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
        let Some(parts) = self.partition(&self.problem.classes()) else {
            return Vec::new();
        };
        let least = LEAF * parts.leaves() + self.problem.on.len();
        let mut found: Vec<Deferred> = Vec::new();
        let mut tried: BTreeSet<Vec<usize>> = BTreeSet::new();
        let mut open: Vec<Vec<usize>> = vec![Vec::new()];
        while !open.is_empty() {
            let mut grown: Vec<Deferred> = Vec::new();
            for known in &open {
                for atom in (0..atoms).filter(|atom| !known.contains(atom)) {
                    let mut with = known.clone();
                    with.push(atom);
                    with.sort_unstable();
                    if !self.account.is_spent() && tried.insert(with.clone()) {
                        grown.extend(self.deferred(with).filter(|new| new.nodes < least));
                    }
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

    /// The rows divided until each part may be of one of these classes; `None` if the account is spent.
    fn partition(&self, classes: &[Bits]) -> Option<Partition> {
        let columns = self.problem.columns();
        let words = columns.atoms() * columns.rows() / 64;
        self.account.spend((8 * words + columns.rows()) as u64);
        Classified::new(columns, classes).partition(Impurity::Gini, self.account)
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
        let choices = self.choices(&atoms, &kinds)?;
        let merged = merged(&choices);
        if merged.len() > CHOICES {
            return None;
        }
        let bodies = merged.iter();
        let bodies = bodies.map(|choice| self.body(choice, &kinds, &named));
        let bodies = bodies.collect::<Option<Vec<Node>>>()?;
        let classes = merged.iter().map(|choice| {
            let own = choices.iter().filter(|(other, _)| tells(choice, other));
            own.fold(self.problem.none(), |all, (_, rows)| all.or(rows))
        });
        let classes: Vec<Bits> = classes.collect();
        let parts = self.partition(&classes)?;
        let sets = merged.len() * choices.len() + parts.leaves();
        self.account.spend(sets as u64 * self.problem.words());
        let mut of = vec![0; rows.bound()];
        by_parts(self.problem.columns(), &parts, rows, &mut of);
        let mut subunits: Vec<Subunit> = Vec::new();
        for (number, body) in bodies.into_iter().enumerate() {
            let own = of.iter().enumerate().filter(|(_, of)| **of == number);
            let own = Bits::collect(of.len(), own.map(|(row, _)| row));
            match subunits.iter_mut().find(|subunit| subunit.body == body) {
                Some(same) => same.rows.unite(&own),
                None if own.is_empty() => {}
                None => subunits.push(Subunit {
                    body,
                    rows: own,
                    last: None,
                    guards_itself: false,
                }),
            }
        }
        let bodies = subunits.iter().map(|s| Size::of(&s.body).nodes);
        let nodes = LEAF * parts.leaves() + bodies.sum::<usize>();
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
        let kind_of = numbers(rows.len(), kinds);
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

/// The number of the set of each of so many rows.
fn numbers<'s>(rows: usize, sets: impl IntoIterator<Item = &'s Bits>) -> Vec<usize> {
    let mut numbers = vec![0; rows];
    for (number, set) in sets.into_iter().enumerate() {
        for row in set.iter() {
            if let Some(slot) = numbers.get_mut(row) {
                *slot = number;
            }
        }
    }
    numbers
}

/// How many kinds of rows a choice tells of.
fn known(choice: &Choice) -> usize {
    choice.iter().flatten().count()
}

/// Whether a choice tells all that another tells, and the same.
fn tells(choice: &Choice, other: &Choice) -> bool {
    let mut pairs = choice.iter().zip(other);
    pairs.all(|(own, other)| other.is_none() || own == other)
}

/// The choices, those that nowhere differ as one: each joins the first that tells more.
fn merged(choices: &BTreeMap<Choice, Bits>) -> Vec<Choice> {
    let mut choices: Vec<(&Choice, usize)> = choices
        .iter()
        .map(|(choice, rows)| (choice, rows.count()))
        .collect();
    // Stable: of those that tell as much of as many rows the first stays first.
    choices.sort_by_key(|(choice, rows)| (Reverse(known(choice)), Reverse(*rows)));
    let mut merged: Vec<Choice> = Vec::new();
    for (choice, _) in choices {
        let agrees = |other: &Choice| {
            let pairs = other.iter().zip(choice);
            let mut both = pairs.filter_map(|(a, b)| a.zip(*b));
            both.all(|(a, b)| a == b)
        };
        match merged.iter_mut().find(|other| agrees(other)) {
            Some(other) => {
                for (slot, class) in other.iter_mut().zip(choice) {
                    *slot = slot.or(*class);
                }
            }
            None => merged.push(choice.clone()),
        }
    }
    merged
}

#[cfg(test)]
mod tests {
    use super::configurations;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::logic::Account;
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::decanonicalise::problem::Problem;
    use crate::tree::unit::{guarded, selector};

    /// Two numbers from 0 to 4, each compared with 0 to 3, and a door: `up`, `down` and `open` where it is shut, `close` and `wait`.
    fn elevator() -> Policy {
        let rows = (0..50_usize).map(|row| {
            let (from, to, open) = (row / 10, row / 2 % 5, row % 2 == 1);
            let cuts = |value: usize| (0..4).map(move |cut| value <= cut);
            let does = match (from.cmp(&to), open) {
                (std::cmp::Ordering::Equal, _) => 3 + usize::from(open),
                (_, true) => 2,
                (std::cmp::Ordering::Less, _) => 0,
                (std::cmp::Ordering::Greater, _) => 1,
            };
            Row {
                minterm: Minterm::new(cuts(from).chain(cuts(to)).chain([open])),
                free: None,
                behavior: Id::new(does),
                visits: 0,
                values: Vec::new(),
            }
        });
        let mut rows: Vec<Row> = rows.collect();
        rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
        Policy {
            atoms: (0..9).map(|i| Atom::Predicate(Id::new(i))).collect(),
            behaviors: (0..5).map(Id::new).collect(),
            rows,
            ..Policy::default()
        }
    }

    #[test]
    fn the_door_is_set_aside() {
        let policy = elevator();
        let problem = Problem::new(&policy);
        let found = configurations(&problem, &Account::unlimited());
        let door = Guard::Atom(Atom::Predicate(Id::new(8)));
        let leaf = |behavior| Node::Behavior(Id::new(behavior));
        let by_door = |open, shut| selector([guarded(door.clone(), leaf(open)), leaf(shut)]);
        let nodes = |body: &Node| crate::tree::Size::of(body).nodes;
        let best = found.first().unwrap();
        assert_eq!(best.len(), 3);
        assert!(best.iter().all(|subunit| nodes(&subunit.body) == 5));
        let rows = best.iter().map(|subunit| subunit.rows.count());
        assert_eq!(rows.sum::<usize>(), 50);
        // Each in one of its two forms.
        for (open, shut) in [(2, 0), (2, 1), (4, 3)] {
            let either = |body: &Node| {
                let other = selector([
                    guarded(crate::tree::guard::not(door.clone()), leaf(shut)),
                    leaf(open),
                ]);
                *body == by_door(open, shut) || *body == other
            };
            assert!(best.iter().any(|subunit| either(&subunit.body)));
        }
    }
}
