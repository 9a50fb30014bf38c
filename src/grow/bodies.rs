//! What a unit may do: a behaviour, or a small tree of behaviours that the counts suggest.
//!
//! A behaviour that fails at once in most minterms needs another to bring about where it does not:
//! `at(p) => inspect(p), fly(p)` is a unit that a person writes, and hard to find one behaviour at a time.

use super::evidence::{Cell, Evidence, KNOWN};
use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Composite, Guard, Node};
use crate::learn::process::{Key, World};
use crate::tree::guard::{and, not};
use crate::tree::unit::{guarded, memory, selector};

/// The most of its decisions that fail at once where a behaviour counts as working.
const WORKS: f64 = 0.2;
/// The fewest of its decisions that fail at once elsewhere.
const FAILS: f64 = 0.6;
/// The literals of a condition, and the conditions of a behaviour, at most.
const LITERALS: usize = 3;
const CONDITIONS: usize = 4;
/// The behaviours that are tried as what brings a literal about.
const BRINGERS: usize = 2;
/// How much oftener than behaviours do on average one brings a literal about that it is tried for.
const OFTENER: f64 = 1.5;

/// The part of its decisions that fail at once from which on it is worth to know what to do meanwhile; how much oftener it has to work
/// after another; and how many others are tried.
const SELDOM: f64 = 0.05;
const OPENS: f64 = 0.05;
const OPENERS: usize = 3;

/// The decisions for a behaviour after which it shows where it works, if the minterms show that at all; and those after which
/// one that always failed at once is not tried any more before another.
const SHOWN: f64 = 300.0;
const TRIED: f64 = 1000.0;

/// A literal: the number of an atom, and its value.
type Literal = (usize, bool);

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
    for (choice, then) in ground.choices.iter().enumerate() {
        let conditions = conditions(ground, evidence, choice);
        if conditions.is_empty() {
            for enabler in enablers(ground, evidence, choice) {
                add(selector([*then, enabler].map(Node::Behavior)));
            }
        }
        for condition in conditions {
            let literals = condition.iter().filter_map(|(bit, value)| {
                let atom = Guard::Atom(*ground.world.atoms().get(*bit)?);
                Some(if *value { atom } else { not(atom) })
            });
            let guard = and(literals);
            for literal in &condition {
                for bringer in bringers(ground, evidence, choice, *literal) {
                    let Some(first) = ground.choices.get(bringer) else {
                        continue;
                    };
                    let (first, then) = (Node::Behavior(*first), Node::Behavior(*then));
                    let unit = guarded(guard.clone(), then.clone());
                    add(selector([unit, first.clone()]));
                    add(memory(Composite::Sequence, [first, then]));
                }
            }
        }
    }
    found
}

/// Decisions for one behaviour in a minterm.
#[derive(Clone, Copy)]
struct Tried {
    key: Key,
    all: f64,
    refused: f64,
}

fn holds(key: Key, (bit, value): Literal) -> bool {
    (key >> bit & 1 == 1) == value
}

/// Decisions, and those of them that failed at once.
fn sums(tried: &[Tried]) -> (f64, f64) {
    tried.iter().fold((0.0, 0.0), |(all, refused), it| {
        (all + it.all, refused + it.refused)
    })
}

/// The behaviours that may bring about where a choice works that fails at once nearly everywhere, though no condition says where
/// it does: what it requires is not observed. Which of them does shows when they are played.
fn enablers<W: World>(ground: &Ground<W>, evidence: &Evidence, choice: usize) -> Vec<Id<Behavior>> {
    let fails = |choice: usize| {
        let tried = tried(evidence, choice);
        let (all, refused) = sums(&tried);
        let hopeless = all >= TRIED && refused >= all;
        (all >= KNOWN && refused >= FAILS * all).then_some((all, hopeless))
    };
    if fails(choice).is_none_or(|(all, hopeless)| all < SHOWN || hopeless) {
        return Vec::new();
    }
    let others = ground.choices.iter().enumerate();
    let others = others.filter(|(other, _)| *other != choice && fails(*other).is_none());
    others.map(|(_, id)| *id).collect()
}

/// For each choice that fails at once now and then, those after which it oftenest does no more: what to do meanwhile.
pub fn openers(evidence: &Evidence, choices: usize) -> Vec<Vec<usize>> {
    let openers = |choice: usize| {
        let (all, refused) = sums(&tried(evidence, choice));
        if refused < KNOWN.max(SELDOM * all) {
            return Vec::new();
        }
        let others = (0..choices).filter(|other| *other != choice);
        let opens = others.map(|other| (opens(evidence, choice, other), other));
        let mut opens: Vec<(f64, usize)> = opens.filter(|(gain, _)| *gain > OPENS).collect();
        opens.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        opens.truncate(OPENERS);
        opens.into_iter().map(|(_, other)| other).collect()
    };
    (0..choices).map(openers).collect()
}

/// How much oftener a choice does not fail at once after a decision for another than before it, where it does at times.
fn opens(evidence: &Evidence, choice: usize, other: usize) -> f64 {
    let refused = |row: usize| {
        let cell = evidence.cells(row).get(choice);
        cell.filter(|cell| cell.count >= KNOWN).map(Cell::refused)
    };
    let (mut gain, mut all) = (0.0, 0.0);
    for row in 0..evidence.keys().len() {
        let before = refused(row).filter(|refused| *refused > SELDOM);
        let (Some(before), Some(cell)) = (before, evidence.cells(row).get(other)) else {
            continue;
        };
        for (to, count) in cell.next() {
            if let Some(after) = refused(to) {
                gain += count * (before - after);
                all += count;
            }
        }
    }
    gain / f64::max(all, KNOWN)
}

/// The decisions for a choice, by minterm.
fn tried(evidence: &Evidence, choice: usize) -> Vec<Tried> {
    let rows = evidence.keys().iter().enumerate();
    let tried = rows.filter_map(|(row, key)| {
        let cell = evidence.cells(row).get(choice)?;
        let refused = cell.refused() * cell.count;
        (cell.count > 0.0).then_some(Tried {
            key: *key,
            all: cell.count,
            refused,
        })
    });
    tried.collect()
}

/// Where a choice works that fails at once elsewhere: conjunctions, one for each place or reason, the most common first.
fn conditions<W: World>(
    ground: &Ground<W>,
    evidence: &Evidence,
    choice: usize,
) -> Vec<Vec<Literal>> {
    let mut left = tried(evidence, choice);
    let mut found = Vec::new();
    while found.len() < CONDITIONS {
        let (all, refused) = sums(&left);
        if all - refused < KNOWN || refused < FAILS * all {
            break;
        }
        let Some(condition) = condition(&left, ground.observed) else {
            break;
        };
        left.retain(|it| !condition.iter().all(|literal| holds(it.key, *literal)));
        found.push(condition);
    }
    found
}

/// The conjunction that keeps most of the decisions that do not fail at once, and hardly another, literal by literal.
fn condition(tried: &[Tried], atoms: usize) -> Option<Vec<Literal>> {
    let mut rows = tried.to_vec();
    let mut condition: Vec<Literal> = Vec::new();
    loop {
        let (all, refused) = sums(&rows);
        if refused <= WORKS * all {
            return (!condition.is_empty()).then_some(condition);
        }
        if condition.len() == LITERALS {
            return None;
        }
        let now = information(all, refused);
        let mut best: Option<(f64, Literal)> = None;
        for bit in 0..atoms {
            for value in [true, false] {
                let literal = (bit, value);
                let kept = rows.iter().filter(|it| holds(it.key, literal));
                let (all, refused) = kept.fold((0.0, 0.0), |(all, refused), it| {
                    (all + it.all, refused + it.refused)
                });
                if all - refused < KNOWN {
                    continue;
                }
                let gain = (all - refused) * (now - information(all, refused));
                if gain > 1e-9 && best.is_none_or(|(most, _)| gain > most) {
                    best = Some((gain, literal));
                }
            }
        }
        let (_, literal) = best?;
        rows.retain(|it| holds(it.key, literal));
        condition.push(literal);
    }
}

/// The information of knowing that a decision does not fail at once, in nats (the gain of FOIL: Quinlan 1990).
fn information(all: f64, refused: f64) -> f64 {
    -crate::math::ln(((all - refused) / all).max(f64::MIN_POSITIVE))
}

/// The choices after which a literal most often came to hold where it did not.
fn bringers<W: World>(
    ground: &Ground<W>,
    evidence: &Evidence,
    choice: usize,
    literal: Literal,
) -> Vec<usize> {
    let mut rates: Vec<(f64, usize)> = Vec::new();
    let (mut whole, mut everywhere) = (0.0, 0.0);
    for other in 0..ground.choices.len() {
        let (mut brought, mut all) = (0.0, 0.0);
        for (row, key) in evidence.keys().iter().enumerate() {
            let cells = evidence.cells(row);
            let Some(cell) = cells.get(other).filter(|_| !holds(*key, literal)) else {
                continue;
            };
            all += cell.count;
            for (to, count) in cell.next() {
                if evidence
                    .keys()
                    .get(to)
                    .is_some_and(|to| holds(*to, literal))
                {
                    brought += count;
                }
            }
        }
        whole += brought;
        everywhere += all;
        if other != choice && brought > 0.0 {
            rates.push((brought / all, other));
        }
    }
    rates.retain(|(rate, _)| rate * everywhere >= OFTENER * whole);
    rates.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    rates
        .into_iter()
        .take(BRINGERS)
        .map(|(_, other)| other)
        .collect()
}
