//! Tables of cubes as tables of minterms.

use super::covers::LARGE;
use crate::policy::{Minterm, Policy, Row};
use std::collections::BTreeMap;

/// The policy with a row for each minterm that its cubes hold; `None` if it has no cubes, or they hold more minterms
/// than a small table has rows. Only then can a row stand on one side of every literal.
pub(super) fn apart(policy: &Policy) -> Option<Policy> {
    let free = |row: &Row| {
        row.free
            .as_ref()
            .map_or(0, |free| free.values().filter(|f| *f).count())
    };
    if policy.rows.iter().all(|row| free(row) == 0) {
        return None;
    }
    let held = |row: &Row| 1_usize.checked_shl(free(row) as u32).unwrap_or(usize::MAX);
    let all = policy.rows.iter().map(held).fold(0, usize::saturating_add);
    if all > LARGE {
        return None;
    }
    let mut rows: BTreeMap<Minterm, Row> = BTreeMap::new();
    for row in &policy.rows {
        for at in 0..held(row) {
            let minterm = minterm(row, at);
            let held = Row {
                minterm: minterm.clone(),
                free: None,
                ..row.clone()
            };
            rows.entry(minterm).or_insert(held);
        }
    }
    Some(Policy {
        rows: rows.into_values().collect(),
        ..policy.clone()
    })
}

/// The minterm of a row whose free atoms have the values of these bits, the first atom the lowest.
fn minterm(row: &Row, mut bits: usize) -> Minterm {
    let is_free = |i| row.free.as_ref().is_some_and(|free| free.get(i));
    Minterm::new(row.minterm.values().enumerate().map(|(i, value)| {
        if !is_free(i) {
            return value;
        }
        let bit = bits & 1 == 1;
        bits >>= 1;
        bit
    }))
}
