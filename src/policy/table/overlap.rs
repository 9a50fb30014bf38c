//! Rows that leave atoms free, against all others that they overlap.
//!
//! The rows are divided by the values of one atom after the other, those that leave it free going to both sides, until
//! a side holds one behaviour, or no free atoms, or so few rows that each is compared with each.

use super::rows::{Rows, Truth};
use crate::logic::minterm::agree;

/// As many rows are compared pair by pair.
const FEW: usize = 64;

/// Pairs of overlapping rows that do different things, the earlier and the later; at most `most`, later ones sorted.
pub(super) fn overlaps(rows: &Rows, kept: &[u32], most: usize) -> Vec<(usize, usize)> {
    if !rows.has_cubes() {
        return Vec::new();
    }
    let mut found = Vec::new();
    let kept = kept.iter().map(|row| *row as usize).collect();
    divide(rows, kept, &mut found, most);
    found.sort_by_key(|(earlier, later)| (*later, *earlier));
    found.dedup_by_key(|(_, later)| *later);
    found
}

fn divide(rows: &Rows, part: Vec<usize>, found: &mut Vec<(usize, usize)>, most: usize) {
    let first = part.first().and_then(|row| rows.behavior.get(*row));
    let alike = part.iter().all(|row| rows.behavior.get(*row) == first);
    let cubes = |part: &[usize]| part.iter().any(|row| leaves_free(rows, *row));
    if alike || !cubes(&part) || found.len() >= most {
        return;
    }
    let Some((atom, larger)) = best(rows, &part).filter(|_| part.len() > FEW) else {
        return pairs(rows, &part, found, most);
    };
    // An atom that is free almost everywhere divides nothing.
    if larger * 10 > part.len() * 9 {
        return pairs(rows, &part, found, most);
    }
    let side = |excluded: Truth| {
        let rows = part
            .iter()
            .copied()
            .filter(|row| rows.truth(*row, atom) != excluded);
        rows.collect::<Vec<_>>()
    };
    divide(rows, side(Truth::Yes), found, most);
    divide(rows, side(Truth::No), found, most);
}

/// The atom that leaves the fewest rows on its larger side, with how many.
fn best(rows: &Rows, part: &[usize]) -> Option<(usize, usize)> {
    let sides = (0..rows.atoms()).map(|atom| {
        let (mut no, mut yes) = (0, 0);
        for row in part {
            let truth = rows.truth(*row, atom);
            no += usize::from(truth != Truth::Yes);
            yes += usize::from(truth != Truth::No);
        }
        (atom, no.max(yes))
    });
    sides.min_by_key(|(_, larger)| *larger)
}

fn pairs(rows: &Rows, part: &[usize], found: &mut Vec<(usize, usize)>, most: usize) {
    for (i, a) in part.iter().enumerate() {
        for b in part.iter().skip(i + 1) {
            let differ = rows.behavior.get(*a) != rows.behavior.get(*b);
            if differ && common(rows, *a, *b) {
                found.push((*a.min(b), *a.max(b)));
                if found.len() >= most {
                    return;
                }
            }
        }
    }
}

fn leaves_free(rows: &Rows, row: usize) -> bool {
    rows.free(row).iter().any(|word| *word != 0)
}

/// Whether some minterm is of both rows.
fn common(rows: &Rows, a: usize, b: usize) -> bool {
    let free = rows.free(a).iter().zip(rows.free(b));
    agree(rows.words(a), rows.words(b), free.map(|(a, b)| a | b))
}
