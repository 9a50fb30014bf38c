//! The guard that lets a change through where it pays: a beam over conjunctions of literals.

use super::field::Field;
use crate::ir::tree::Guard;
use crate::tree::guard::{and, not};

/// The conjunctions that are kept of each length.
const WIDTH: usize = 3;
/// The most literals.
const LITERALS: usize = 3;

/// A conjunction with what it lets through.
#[derive(Clone, Debug)]
pub struct Found {
    /// The literals: an atom by its bit, and its value.
    pub literals: Vec<(usize, bool)>,
    /// The gain of the minterms that it lets through.
    pub gain: f64,
}

impl Found {
    /// As a guard.
    pub fn guard(&self, field: &Field) -> Guard {
        and(self.literals.iter().filter_map(|(bit, value)| {
            let atom = Guard::Atom(*field.atoms.get(*bit)?);
            Some(if *value { atom } else { not(atom) })
        }))
    }
}

/// Conjunctions that let much gain through for the price of a literal, the best first; the empty one is among them. The
/// gain of each minterm is that of [`Field::spots`]; minterms without any say nothing.
pub fn conjunctions(field: &Field, gains: &[f64], price: f64) -> Vec<Found> {
    let rows: Vec<(u128, f64)> = field
        .spots
        .iter()
        .zip(gains)
        .filter(|(_, gain)| **gain != 0.0)
        .map(|(spot, gain)| (spot.key, *gain))
        .collect();
    let all = Found {
        literals: Vec::new(),
        gain: rows.iter().map(|(_, gain)| gain).sum(),
    };
    let mut beam = vec![(all.clone(), rows)];
    let mut found = vec![all];
    for _ in 0..LITERALS {
        let mut longer: Vec<(Found, Vec<(u128, f64)>)> = Vec::new();
        for (base, rows) in &beam {
            // Without a loss there is nothing to keep out.
            if rows.iter().all(|(_, gain)| *gain > 0.0) {
                continue;
            }
            let mut sums = vec![[0.0; 2]; field.atoms.len()];
            for (key, gain) in rows {
                for (bit, sum) in sums.iter_mut().enumerate() {
                    let [off, on] = sum;
                    if key >> bit & 1 == 1 {
                        *on += gain;
                    } else {
                        *off += gain;
                    }
                }
            }
            for (bit, [off, on]) in sums.into_iter().enumerate() {
                if base.literals.iter().any(|(known, _)| *known == bit) {
                    continue;
                }
                for (value, gain) in [(true, on), (false, off)] {
                    if gain <= base.gain {
                        continue;
                    }
                    let mut literals = base.literals.clone();
                    literals.push((bit, value));
                    literals.sort_unstable();
                    if longer.iter().any(|(other, _)| other.literals == literals) {
                        continue;
                    }
                    longer.push((Found { literals, gain }, Vec::new()));
                }
            }
        }
        longer
            .sort_by(|(a, _), (b, _)| b.gain.total_cmp(&a.gain).then(a.literals.cmp(&b.literals)));
        longer.truncate(WIDTH);
        for (new, rows) in &mut longer {
            let holds = |key: u128| {
                let mut literals = new.literals.iter();
                literals.all(|(bit, value)| (key >> bit & 1 == 1) == *value)
            };
            let spots = field.spots.iter().zip(gains);
            *rows = spots
                .filter(|(spot, gain)| **gain != 0.0 && holds(spot.key))
                .map(|(spot, gain)| (spot.key, *gain))
                .collect();
        }
        found.extend(longer.iter().map(|(found, _)| found.clone()));
        if longer.is_empty() {
            break;
        }
        beam = longer;
    }
    let worth = |found: &Found| found.gain - price * nodes(found) as f64;
    found.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
    found
}

/// The nodes that a guard costs.
pub fn nodes(found: &Found) -> usize {
    match found.literals.len() {
        0 => 0,
        literals => literals + 1,
    }
}
