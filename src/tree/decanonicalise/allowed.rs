//! Tables in which a row may allow several behaviours.
//!
//! A row is no exception to any behaviour that it allows. So lists of rules are found for classes of rows that overlap, and
//! each gives every row one of its behaviours: a policy as any other, which the tree is made of and proved on.

use super::alone::{REACH, THOROUGH};
use super::children::Children;
use super::problem::Problem;
use super::share::shared;
use super::{Decanonicalised, Options, decanonicalise, proved};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::logic::covering::{
    Grouped, Known, List, Part, Regroup, Rule, Sought, lists, picked, top_down,
};
use crate::logic::impurity::Impurity;
use crate::logic::partition::{Classified, Partition};
use crate::logic::{Account, Bits, Columns, Cube, Literal};
use crate::policy::{Policy, Row};
use crate::tree::prove::Refuted;
use rustc_hash::FxHashMap;

/// The part of the effort that the choice of behaviours may take, and that the trees that are compared may.
const PARTS: u64 = 4;

/// The most rows that allow the same and are compared with each other.
const PAIRED: usize = 1000;

/// The lists that are made from the top.
const SAMPLES: u64 = 3;

/// The rows of the first core of a table.
const FIRST: usize = 600;
/// Attempts at a smaller list before it is tried on all rows, at first, and where it is wrong on few rows.
const QUICK: usize = 40;
const HASTY: usize = 8;
/// Few are so many times fewer than those of the core.
const FEW: usize = 50;
/// A list may be wrong on one row of so many to be mended, for which one part in so many of the account is kept.
const RARELY: usize = 50;
const MENDED: usize = 4;

/// The smallest tree found that takes an allowed behaviour in every row, with the policy on which it is proved. `allowed` are the
/// behaviours that each row allows.
///
/// # Errors
/// The policy has no rows, or the tree that was found is refuted: with the counterexample.
pub fn allowing(
    policy: &Policy,
    allowed: &[Vec<Id<Behavior>>],
    options: &Options,
) -> Result<(Policy, Decanonicalised), Refuted> {
    let classes: Vec<Bits> = policy
        .behaviors
        .iter()
        .map(|behavior| {
            let rows = allowed.iter().enumerate();
            let own = rows.filter(|(_, all)| all.contains(behavior));
            Bits::collect(allowed.len(), own.map(|(row, _)| row))
        })
        .collect();
    let words = |row: &Row| {
        let free = row.free.as_ref().map(|free| free.words().to_vec());
        (row.minterm.words().to_vec(), free)
    };
    let words: Vec<_> = policy.rows.iter().map(words).collect();
    let rows = words.iter().map(|(ones, free)| (&**ones, free.as_deref()));
    let columns = Columns::with_free(policy.atoms.len(), rows);
    let effort = options.effort.saturating_mul(super::EFFORT);
    let is_whole = policy.rows.iter().all(|row| row.free.is_none());
    if is_whole && let Some(list) = by_core(&columns, &classes, &Account::new(effort)) {
        let mut choice = vec![0; columns.rows()];
        by_grouped(&columns, &list, Bits::full(columns.rows()), &mut choice);
        return listed(&chosen(policy, &choice), &list, options);
    }
    let account = Account::new(effort / PARTS);
    let mut choices = Vec::new();
    if is_whole {
        choices.extend(by_partition(&columns, &classes, &account));
    }
    if is_whole {
        choices.extend(from_the_top(&columns, &classes, &account));
    }
    let mut known = Known::default();
    let found = lists(&columns, &classes, REACH, THOROUGH, &mut known, &account);
    choices.extend(found.iter().rev().map(|list| by_list(&columns, list)));
    choices.push(by_frequency(&classes, allowed.len()));
    let alike = alike(policy, allowed);
    for choice in &mut choices {
        as_first(choice, &alike);
    }
    choices.dedup();
    let policies = choices.iter().map(|choice| chosen(policy, choice));
    let policies: Vec<Policy> = policies.collect();
    let quick = Options {
        effort: (options.effort / (PARTS * policies.len().max(1) as u64)).max(1),
        ..*options
    };
    let mut best: Option<(Policy, Decanonicalised)> = None;
    for policy in policies {
        let found = decanonicalise(&policy, &quick)?;
        if best
            .as_ref()
            .is_none_or(|(_, known)| found.size < known.size)
        {
            best = Some((policy, found));
        }
    }
    let (policy, first) = best.ok_or(Refuted::Empty)?;
    let found = decanonicalise(&policy, options)?;
    let smallest = if first.size < found.size {
        first
    } else {
        found
    };
    Ok((policy, smallest))
}

/// The smallest tree found for a policy, which takes the decisions of a list.
fn listed(
    policy: &Policy,
    list: &Grouped,
    options: &Options,
) -> Result<(Policy, Decanonicalised), Refuted> {
    let problem = Problem::new(policy);
    // A problem numbers the behaviours that are taken somewhere.
    let number = |class: usize| {
        let behavior = policy.behaviors.get(class)?;
        problem.on.iter().position(|(taken, _)| taken == behavior)
    };
    let list = renumbered(list, &number);
    let tree = shared(Children::grouped(&problem, &list).node());
    let first = proved(policy, tree)?;
    let found = decanonicalise(policy, options)?;
    let smallest = match first.size < found.size {
        true => first,
        false => found,
    };
    Ok((policy.clone(), smallest))
}

/// The list with other numbers for its classes; the rules of those that have none go.
fn renumbered(list: &Grouped, number: &impl Fn(usize) -> Option<usize>) -> Grouped {
    let parts = list.parts.iter().filter_map(|part| {
        Some(match part {
            Part::Rule(rule) => Part::Rule(Rule {
                class: number(rule.class)?,
                cube: rule.cube.clone(),
            }),
            Part::Group(cube, inner) => Part::Group(cube.clone(), renumbered(inner, number)),
        })
    });
    Grouped {
        parts: parts.collect(),
        last: number(list.last).unwrap_or(0),
    }
}

/// The behaviour of each row by the smallest of a few lists with groups that are made from the top.
fn from_the_top(columns: &Columns, classes: &[Bits], account: &Account) -> Option<Vec<usize>> {
    let part = account.part(2);
    let sample = |number: u64| {
        let sought = (number, Sought::Plain);
        top_down(columns, classes, sought, usize::MAX, &part)
    };
    let made = (0..SAMPLES).map_while(sample);
    let least = made.min_by_key(Grouped::nodes);
    account.settle(&part);
    let mut choice = vec![0; columns.rows()];
    by_grouped(columns, &least?, Bits::full(columns.rows()), &mut choice);
    Some(choice)
}

/// The behaviour of each of these rows by a list with groups, by its number.
fn by_grouped(columns: &Columns, list: &Grouped, mut rows: Bits, choice: &mut [usize]) {
    for part in &list.parts {
        let decided = columns.cube_rows(part.cube(), &rows);
        rows.subtract(&decided);
        match part {
            Part::Rule(rule) => decide(choice, &decided, rule.class),
            Part::Group(_, inner) => by_grouped(columns, inner, decided, choice),
        }
    }
    decide(choice, &rows, list.last);
}

/// The behaviour of each row by the partition with the fewest parts.
fn by_partition(columns: &Columns, classes: &[Bits], account: &Account) -> Option<Vec<usize>> {
    let classified = Classified::new(columns, classes);
    let part = account.part(4);
    let made = Impurity::ALL.into_iter();
    let made = made.filter_map(|impurity| classified.partition(impurity, &part));
    let least = made.min_by_key(Partition::leaves);
    account.settle(&part);
    let mut choice = vec![0; columns.rows()];
    by_parts(columns, &least?, Bits::full(columns.rows()), &mut choice);
    Some(choice)
}

/// The class of each of these rows by a partition, by its number.
pub(super) fn by_parts(columns: &Columns, partition: &Partition, rows: Bits, choice: &mut [usize]) {
    match partition {
        Partition::Leaf(class) => decide(choice, &rows, *class),
        Partition::Split { atom, parts } => {
            let literal = Literal {
                atom: *atom,
                positive: true,
            };
            let holds = columns.cube_rows(&Cube::new([literal]), &rows);
            let [zero, one] = &**parts;
            by_parts(columns, zero, rows.minus(&holds), choice);
            by_parts(columns, one, holds, choice);
        }
    }
}

/// The behaviour of each row by a list, by its number.
fn by_list(columns: &Columns, list: &List) -> Vec<usize> {
    let mut choice = vec![list.last; columns.rows()];
    let mut left = Bits::full(columns.rows());
    for rule in &list.rules {
        let decided = columns.cube_rows(&rule.cube, &left);
        decide(&mut choice, &decided, rule.class);
        left.subtract(&decided);
    }
    choice
}

/// Lets these rows take a behaviour.
fn decide(choice: &mut [usize], rows: &Bits, class: usize) {
    for row in rows.iter() {
        if let Some(slot) = choice.get_mut(row) {
            *slot = class;
        }
    }
}

/// A list that is made for a few rows, which grow by some for which it takes what they do not allow.
/// One that is wrong on few rows at the end is sought anew from where it is. `None` in a small table, and where that does not end soon.
fn by_core(columns: &Columns, classes: &[Bits], account: &Account) -> Option<Grouped> {
    let count = columns.rows();
    if count < 2 * FIRST {
        return None;
    }
    let mut core = Bits::collect(count, (0..count).step_by(count.div_ceil(FIRST)));
    let (mut known, mut patience) = (Known::default(), QUICK);
    let mut right = None;
    let mut nearly: Option<(usize, List)> = None;
    let searching = account.but(MENDED);
    while 2 * core.count() <= count && !searching.is_spent() {
        let (part, own) = picked(columns, classes, &core, &searching);
        let found = lists(&part, &own, REACH, patience, &mut known, &searching);
        let Some(list) = found.last() else { break };
        let choice = by_list(columns, list);
        searching.spend((list.rules.len() * count / 16) as u64);
        let wrong = choice.iter().enumerate();
        let wrong = wrong
            .filter(|(row, class)| !classes.get(**class).is_some_and(|own| own.contains(*row)));
        let wrong: Vec<usize> = wrong.map(|(row, _)| row).collect();
        if nearly
            .as_ref()
            .is_none_or(|(least, _)| wrong.len() < *least)
        {
            nearly = Some((wrong.len(), list.clone()));
        }
        if wrong.is_empty() {
            right = Some(list.clone());
            if patience == THOROUGH {
                break;
            }
            patience = THOROUGH;
        } else if right.is_none() && FEW * wrong.len() < core.count() {
            patience = HASTY;
        }
        let step = wrong.len().div_ceil(core.count() / 2).max(1);
        core.unite(&Bits::collect(count, wrong.into_iter().step_by(step)));
    }
    account.settle(&searching);
    if let Some(right) = right {
        return Some(right.into());
    }
    let (wrong, list) = nearly?;
    if RARELY * wrong > count {
        return None;
    }
    Regroup::new(columns, classes, account).smaller(&list.into(), 0, &mut known)
}

/// The behaviour of each row with as few behaviours as possible: again and again the one that most rows left allow.
fn by_frequency(classes: &[Bits], rows: usize) -> Vec<usize> {
    let mut choice = vec![0; rows];
    let mut left = Bits::full(rows);
    while !left.is_empty() {
        let counts = classes.iter().enumerate();
        let counts = counts.map(|(class, own)| (own.count_both(&left), std::cmp::Reverse(class)));
        let Some((1.., std::cmp::Reverse(class))) = counts.max() else {
            break;
        };
        let Some(own) = classes.get(class) else {
            break;
        };
        decide(&mut choice, &own.and(&left), class);
        left.subtract(own);
    }
    choice
}

/// For each row the first of those that it shares minterms with, at once or by way of others: they have to take the same behaviour.
/// Where many rows allow the same, all of them count as such.
fn alike(policy: &Policy, allowed: &[Vec<Id<Behavior>>]) -> Vec<usize> {
    let mut first: Vec<usize> = (0..policy.rows.len()).collect();
    let mut groups: FxHashMap<&[Id<Behavior>], Vec<(usize, &Row)>> = FxHashMap::default();
    for (at, (row, allowed)) in policy.rows.iter().zip(allowed).enumerate() {
        if allowed.len() > 1 {
            groups.entry(allowed).or_default().push((at, row));
        }
    }
    for group in groups.into_values() {
        if group.iter().all(|(_, row)| row.free.is_none()) {
            continue;
        }
        for (i, (at, row)) in group.iter().enumerate() {
            let many = group.len() > PAIRED;
            for (other, before) in group.iter().take(if many { 1 } else { i }) {
                if many || row.meets(before) {
                    join(&mut first, *other, *at);
                }
            }
        }
    }
    (0..first.len()).map(|at| root(&first, at)).collect()
}

/// The first of the rows that one is joined with.
fn root(first: &[usize], mut at: usize) -> usize {
    while let Some(next) = first.get(at).filter(|next| **next != at) {
        at = *next;
    }
    at
}

fn join(first: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(first, a), root(first, b));
    if let Some(own) = first.get_mut(a.max(b)) {
        *own = a.min(b);
    }
}

/// Gives each row the behaviour of another one.
fn as_first(choice: &mut [usize], first: &[usize]) {
    for (at, first) in first.iter().enumerate() {
        let class = choice.get(*first).copied();
        if let (Some(own), Some(class)) = (choice.get_mut(at), class) {
            *own = class;
        }
    }
}

/// The policy that takes these of its behaviours.
fn chosen(policy: &Policy, choice: &[usize]) -> Policy {
    let rows = policy.rows.iter().zip(choice);
    let rows = rows.map(|(row, class)| Row {
        behavior: policy
            .behaviors
            .get(*class)
            .copied()
            .unwrap_or(row.behavior),
        ..row.clone()
    });
    Policy {
        rows: rows.collect(),
        ..policy.clone()
    }
}
