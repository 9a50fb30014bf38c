//! What a unit may do: a behaviour, or a small tree of behaviours that the counts suggest.
//!
//! A behaviour that fails at once in most minterms needs another to bring about where it does not:
//! `at(p) => inspect(p), fly(p)` is a unit that a person writes, and hard to find one behaviour at a time.

use super::evidence::{Evidence, KNOWN};
use super::ground::Ground;
use crate::ir::tree::{Composite, Guard, Node};
use crate::learn::process::World;
use crate::tree::guard::not;
use crate::tree::unit::{guarded, memory, selector};

/// How far the parts that fail at once must be apart for a literal to tell them.
const TELLS: f64 = 0.8;
/// The behaviours that are tried as what brings a literal about.
const BRINGERS: usize = 2;

/// The bodies, the behaviours first.
pub fn bodies<W: World>(ground: &Ground<W>, evidence: &Evidence) -> Vec<Node> {
    let mut found: Vec<Node> = ground
        .choices
        .iter()
        .map(|id| Node::Behavior(*id))
        .collect();
    let mut add = |node: Node| {
        if !found.contains(&node) {
            found.push(node);
        }
    };
    for choice in 0..ground.choices.len() {
        let Some((bit, value)) = condition(ground, evidence, choice) else {
            continue;
        };
        let (Some(atom), Some(then)) = (ground.world.atoms().get(bit), ground.choices.get(choice))
        else {
            continue;
        };
        let literal = match value {
            true => Guard::Atom(*atom),
            false => not(Guard::Atom(*atom)),
        };
        for bringer in bringers(ground, evidence, choice, (bit, value)) {
            let Some(first) = ground.choices.get(bringer) else {
                continue;
            };
            let (first, then) = (Node::Behavior(*first), Node::Behavior(*then));
            let unit = guarded(literal.clone(), then.clone());
            add(selector([unit, first.clone()]));
            add(memory(Composite::Sequence, [first, then]));
        }
    }
    found
}

/// The literal that best tells where a choice fails at once; `None` if it seldom does, or no literal tells.
fn condition<W: World>(
    ground: &Ground<W>,
    evidence: &Evidence,
    choice: usize,
) -> Option<(usize, bool)> {
    // For each literal: how often the choice failed at once where it holds, and how often it was taken.
    let mut sums = vec![[[0.0; 2]; 2]; ground.observed];
    for (row, key) in evidence.keys().iter().enumerate() {
        let Some(cell) = evidence.cells(row).get(choice) else {
            continue;
        };
        for (bit, sum) in sums.iter_mut().enumerate() {
            let at = usize::from(key >> bit & 1 == 1);
            if let Some([refused, all]) = sum.get_mut(at) {
                *refused += cell.refused() * cell.count;
                *all += cell.count;
            }
        }
    }
    let mut best: Option<((usize, bool), f64)> = None;
    for (bit, [off, on]) in sums.into_iter().enumerate() {
        let part = |[refused, all]: [f64; 2]| (all >= KNOWN).then(|| refused / all);
        let (Some(off), Some(on)) = (part(off), part(on)) else {
            continue;
        };
        // The choice works where the literal holds.
        for (value, gap) in [(true, off - on), (false, on - off)] {
            if gap >= TELLS && best.is_none_or(|(_, most)| gap > most) {
                best = Some(((bit, value), gap));
            }
        }
    }
    best.map(|(literal, _)| literal)
}

/// The choices after which a literal most often came to hold where it did not.
fn bringers<W: World>(
    ground: &Ground<W>,
    evidence: &Evidence,
    choice: usize,
    (bit, value): (usize, bool),
) -> Vec<usize> {
    let holds = |key: u128| (key >> bit & 1 == 1) == value;
    let mut rates: Vec<(f64, usize)> = Vec::new();
    for other in (0..ground.choices.len()).filter(|other| *other != choice) {
        let (mut brought, mut all) = (0.0, 0.0);
        for (row, key) in evidence.keys().iter().enumerate() {
            let Some(cell) = evidence.cells(row).get(other).filter(|_| !holds(*key)) else {
                continue;
            };
            all += cell.count;
            for (to, count) in cell.next() {
                if evidence.keys().get(to).is_some_and(|to| holds(*to)) {
                    brought += count;
                }
            }
        }
        if brought > 0.0 {
            rates.push((brought / all, other));
        }
    }
    rates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    rates
        .into_iter()
        .take(BRINGERS)
        .map(|(_, other)| other)
        .collect()
}
