//! Rows that contradict each other.

use super::Pla;
use crate::logic::alive::Alive;
use crate::logic::packed::Packed;
use crate::logic::{Bits, Columns};
use rustc_hash::{FxHashMap, FxHashSet};

/// Two rows with a minterm in common of which they say different things, the earlier first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Conflict {
    /// The earlier row.
    pub first: usize,
    /// The later row.
    pub second: usize,
}

/// The first conflict between rows of different labels; rows without a label say nothing.
pub(super) fn conflict(
    pla: &Pla,
    columns: &Columns,
    label: impl Fn(usize) -> Option<usize>,
) -> Option<Conflict> {
    if pla.are_minterms() {
        return equal(pla, label);
    }
    let mut labels: Vec<Bits> = Vec::new();
    for row in 0..pla.rows() {
        let Some(label) = label(row) else { continue };
        while labels.len() <= label {
            labels.push(Bits::empty(pla.rows()));
        }
        if let Some(rows) = labels.get_mut(label) {
            rows.insert(row);
        }
    }
    let all = labels
        .iter()
        .fold(Bits::empty(pla.rows()), |all, rows| all.or(rows));
    // A row that stands twice meets the same ones.
    let mut seen: FxHashSet<(usize, Packed)> = FxHashSet::default();
    let mut conflicts = (0..pla.rows()).filter_map(|row| {
        let label = label(row)?;
        if !seen.insert((label, pla.cube(row))) {
            return None;
        }
        let own = labels.get(label)?;
        let other = meeting(columns, row, &all.minus(own))?;
        Some(Conflict {
            first: row.min(other),
            second: row.max(other),
        })
    });
    conflicts.next()
}

/// The first of the rows that meets this one.
fn meeting(columns: &Columns, row: usize, rows: &Bits) -> Option<usize> {
    let mut left = Alive::new(rows);
    for literal in columns.literals_of(row) {
        if let (Some(column), meets) = columns.meeting(literal) {
            left.keep((column, meets));
        }
        if left.is_empty() {
            return None;
        }
    }
    left.first()
}

/// Minterms that stand twice.
fn equal(pla: &Pla, label: impl Fn(usize) -> Option<usize>) -> Option<Conflict> {
    let mut seen: FxHashMap<&[u64], (usize, usize)> = FxHashMap::default();
    for row in 0..pla.rows() {
        let Some(label) = label(row) else { continue };
        let (first, other) = *seen
            .entry(pla.row(&pla.values, row))
            .or_insert((row, label));
        if other != label {
            return Some(Conflict { first, second: row });
        }
    }
    None
}
