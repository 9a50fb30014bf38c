//! Rows of a table that allow several behaviours: which of them a comparison takes.

use super::refused::Refused;
use super::text::Text;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::policy::table::Table;
use crate::policy::{Minterm, Policy, Row};
use crate::source::Span;
use crate::tree::tick::Runner;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;
use std::ops::Range;

/// A policy and the table that it was read from.
pub(super) type Listed<'a> = (&'a mut Policy, &'a Table);

/// The most minterms that rows are written out into.
const WRITTEN_OUT: usize = 65_536;

/// Gives each row that allows several behaviours the one that the tree takes there, if it is allowed, and each minterm a row;
/// `None` if the tree remembers, or asks what the table does not say, or rows stand for too many minterms.
pub(super) fn as_tree((policy, table): Listed, root: &Node) -> Option<()> {
    if root.remembers() {
        return None;
    }
    let mut runner = Runner::new(root, &policy.atoms).ok()?;
    let sets = match table.has_cubes() {
        true => written_out(policy, table)?,
        false => sets(policy, table),
    };
    for (row, allowed) in policy.rows.iter_mut().zip(sets) {
        let selected = runner.select(row.minterm.words());
        if let Some(behavior) = selected.filter(|own| allowed.contains(own)) {
            row.behavior = behavior;
        }
    }
    Some(())
}

/// Gives each minterm that two tables list a behaviour that both of them allow there, if there is one; `None` if they do not
/// have the same atoms, or rows stand for several minterms.
pub(super) fn as_both((old, before): Listed, (new, after): Listed) -> Option<()> {
    let places = old.atoms.iter().map(|atom| {
        let mut others = new.atoms.iter();
        others.position(|other| other == atom)
    });
    let places: Vec<usize> = places.collect::<Option<_>>()?;
    if before.has_cubes() || after.has_cubes() || places.len() != new.atoms.len() {
        return None;
    }
    let sets = [sets(old, before), sets(new, after)];
    let rows = new.rows.iter_mut().zip(&sets[1]).map(|(row, allowed)| {
        let values = places.iter().map(|at| row.minterm.get(*at));
        (Minterm::new(values), (&mut row.behavior, allowed))
    });
    let mut rows: FxHashMap<Minterm, _> = rows.collect();
    for (row, allowed) in old.rows.iter_mut().zip(&sets[0]) {
        let Some((behavior, others)) = rows.get_mut(&row.minterm) else {
            continue;
        };
        if let Some(both) = allowed.iter().find(|own| others.contains(own)) {
            row.behavior = *both;
            **behavior = *both;
        }
    }
    Some(())
}

/// Gives each minterm that rows stand for a row of its own, with what it allows; `None` if there are too many.
fn written_out(policy: &mut Policy, table: &Table) -> Option<Vec<Vec<Id<Behavior>>>> {
    let minterms = |row: &Row| 1_usize.checked_shl(row.free_atoms() as u32);
    let mut counts = policy
        .rows
        .iter()
        .map(|row| minterms(row).unwrap_or(usize::MAX));
    let all = counts.try_fold(0_usize, |all, more| all.checked_add(more))?;
    if all > WRITTEN_OUT {
        return None;
    }
    let mut rows = BTreeMap::new();
    for (row, allowed) in policy.rows.iter().zip(sets(policy, table)) {
        for minterm in row.minterms() {
            let row = Row {
                minterm: minterm.clone(),
                free: None,
                ..row.clone()
            };
            rows.entry(minterm).or_insert((row, allowed.clone()));
        }
    }
    let (rows, sets) = rows.into_values().unzip();
    policy.rows = rows;
    Some(sets)
}

/// What each row allows.
fn sets(policy: &Policy, table: &Table) -> Vec<Vec<Id<Behavior>>> {
    let of = |numbers: Vec<usize>| {
        let numbers = numbers.into_iter();
        let own = numbers.filter_map(|number| policy.behaviors.get(number).copied());
        own.collect()
    };
    table.allowed().map(of).collect()
}

/// That a table with this header cannot be compared: its rows allow several behaviours.
pub(super) fn refused(text: Text, header: Range<usize>, message: &str) -> Refused {
    Refused::text(text, |file| {
        let span = Span::new(file, header.start, header.end);
        vec![
            Diagnostic::new(Code::E0823, span, message)
                .help("choose one behaviour for each row, and write out the rows with `-`"),
        ]
    })
}
