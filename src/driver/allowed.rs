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
use crate::tree::cube::{Cube, Reader, positions};
use crate::tree::tick::Runner;
use rustc_hash::FxHashMap;
use std::ops::Range;

/// A policy and the table that it was read from.
pub(super) type Listed<'a> = (&'a mut Policy, &'a Table);

/// The most parts of rows.
const PARTS: usize = 1 << 20;

/// Gives each row that allows several behaviours the one that the tree takes there, if it is allowed, and each part of a row in
/// which it takes another a row of its own; `None` if the tree remembers, or asks what the table does not say, or there are too many.
pub(super) fn as_tree((policy, table): Listed, root: &Node) -> Option<()> {
    if root.remembers() {
        return None;
    }
    let mut runner = Runner::new(root, &policy.atoms).ok()?;
    if table.has_cubes() {
        return divided(policy, table, root);
    }
    let sets = sets(policy, table);
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

/// Divides the rows where the tree does, each part with what it selects there, if that is allowed; `None` if there are too many, or
/// atoms do not say what the tree selects.
fn divided(policy: &mut Policy, table: &Table, root: &Node) -> Option<()> {
    let reader = Reader::new(root).ok()?;
    let positions = positions(&policy.atoms);
    let mut left = PARTS;
    let mut parts: Vec<Row> = Vec::new();
    for (row, allowed) in policy.rows.iter().zip(sets(policy, table)) {
        let mut cube = Cube::new(&row.minterm, row.free.as_ref(), &positions, &[]);
        let mut say = |part: &Cube, selected: Option<Id<Behavior>>| {
            let own = selected.filter(|own| allowed.contains(own));
            parts.push(Row {
                minterm: part.minterm(),
                free: part.free(),
                behavior: own.unwrap_or(row.behavior),
                ..row.clone()
            });
            true
        };
        reader.parts(&mut cube, &mut left, &mut say).ok()?;
    }
    policy.rows = parts;
    Some(())
}

/// What each row allows.
pub(super) fn sets(policy: &Policy, table: &Table) -> Vec<Vec<Id<Behavior>>> {
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
