//! Rows that say the same become one; rows that contradict each other are reported.

use super::rows::Rows;
use std::cmp::Ordering;

/// The rows of a policy in its order, each once, with the visits of all that say the same.
pub(super) struct Merged {
    /// The numbers of the rows that are kept.
    pub(super) order: Vec<u32>,
    /// Pairs of rows that leave the same atoms free and agree in all others, but not in what is done: the earlier and
    /// the later.
    pub(super) contradictions: Vec<(usize, usize)>,
}

/// Sorts and merges. At most `most` contradictions are looked for.
pub(super) fn merge(rows: &mut Rows, most: usize) -> Merged {
    let mut order = sorted(rows);
    let mut contradictions = Vec::new();
    let mut kept: Option<usize> = None;
    order.retain(|&row| {
        let row = row as usize;
        let same = kept.filter(|first| rows.compare(*first, row) == Ordering::Equal);
        let Some(first) = same else {
            kept = Some(row);
            return true;
        };
        if rows.behavior.get(first) != rows.behavior.get(row) {
            contradictions.push((first, row));
        }
        let more = rows.visits.get(row).copied().unwrap_or(0);
        if let Some(visits) = rows.visits.get_mut(first) {
            *visits = visits.saturating_add(more);
        }
        false
    });
    contradictions.sort_by_key(|(_, later)| *later);
    contradictions.truncate(most);
    Merged {
        order,
        contradictions,
    }
}

/// The numbers of the rows in the order of a policy.
fn sorted(rows: &Rows) -> Vec<u32> {
    let count = u32::try_from(rows.len()).unwrap_or(u32::MAX);
    // The first word decides the order of most rows, and stands beside its row; its lowest bit decides first.
    let first = |row: u32| {
        rows.words(row as usize)
            .first()
            .map_or(0, |word| word.reverse_bits())
    };
    let mut keyed: Vec<(u64, u32)> = (0..count).map(|row| (first(row), row)).collect();
    keyed.sort_unstable_by(|(word, a), (other, b)| {
        let rest = || rows.compare(*a as usize, *b as usize).then(a.cmp(b));
        word.cmp(other).then_with(rest)
    });
    keyed.into_iter().map(|(_, row)| row).collect()
}
