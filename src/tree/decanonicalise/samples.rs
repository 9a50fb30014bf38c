//! Trees for cubes by way of some of their minterms.
//!
//! A cube is on both sides of every atom that it leaves free, so that hardly anything divides a table of wide ones. Minterms are on one
//! side each. So a tree is made for some of the minterms of each cube and read in the whole cubes; where it decides otherwise, there
//! are more minterms for the next (counterexample-guided synthesis: Solar-Lezama, Tancau, Bodik, Seshia and Saraswat 2006).

use super::{Decanonicalised, Options, searched};
use crate::logic::random::Random;
use crate::policy::{Minterm, Policy, Row};
use crate::tree::cube::{Cube, Reader, Spent, positions};
use crate::tree::prove::Prover;
use std::collections::BTreeMap;

/// The minterms that stand for the cubes at first.
const FIRST: usize = 2048;
/// The most that are found in a cube where a tree decides otherwise.
const FAILING: usize = 4;
/// The trees that are made, and the part of the effort for each.
const ROUNDS: u64 = 10;
const PART: u64 = 10;
/// The parts of cubes that are looked at for each tree.
const PARTS: usize = 1 << 20;

/// A tree that takes the decisions of the policy in the whole of its cubes; `None` if none was found.
pub(super) fn tree(policy: &Policy, options: &Options) -> Option<Decanonicalised> {
    if !policy.transitions.is_empty() {
        return None;
    }
    let positions = positions(&policy.atoms);
    let cube = |row: &Row| {
        let free = row.free.as_ref();
        Cube::new(&row.minterm, free, &positions, &policy.fields)
    };
    let wide = policy.rows.iter().filter(|row| row.free.is_some());
    let wide: Vec<&Row> = wide.collect();
    let random = &mut Random::new(0);
    let plain = policy.rows.iter().filter(|row| row.free.is_none());
    let mut known: BTreeMap<Minterm, &Row> = plain.map(|row| (row.minterm.clone(), row)).collect();
    for _ in 0..(FIRST / wide.len().max(1)).max(1) {
        for row in &wide {
            known.insert(cube(row).any(random), row);
        }
    }
    let options = Options {
        effort: (options.effort / PART).max(1),
        ..*options
    };
    for _ in 0..ROUNDS {
        let rows = known.iter().map(|(minterm, row)| Row {
            minterm: minterm.clone(),
            free: None,
            ..(*row).clone()
        });
        let sample = Policy {
            rows: rows.collect(),
            ..policy.clone()
        };
        let found = searched(&sample, &options).ok()?;
        let reader = Reader::new(&found.root)
            .ok()
            .filter(|_| !found.root.remembers())?;
        let mut failing: Vec<(Minterm, &Row)> = Vec::new();
        let mut left = PARTS;
        for row in &wide {
            let mut more = FAILING;
            let whole = reader.parts(&mut cube(row), &mut left, &mut |part, selected| {
                if selected != Some(row.behavior) {
                    failing.push((part.any(random), row));
                    more -= 1;
                }
                more > 0
            });
            if whole == Err(Spent) {
                return None;
            }
        }
        if failing.is_empty() {
            let proof = Prover::new(policy).prove(&found.root).ok()?;
            return Some(Decanonicalised { proof, ..found });
        }
        known.extend(failing);
    }
    None
}
