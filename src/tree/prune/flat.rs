//! A start from the other side: one short unit for each behaviour, guarded by what holds more often where it drives.

use super::memory::{chain, done};
use super::plain::unasked;
use super::units::{needs, select};
use super::{Candidate, Change, Requirement, tidy};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Guard, Node};
use crate::tree::atoms::{atoms as atoms_of, behaviors};
use crate::tree::guard::{and, not};
use crate::tree::unit::Unit;
use std::collections::BTreeSet;

/// A behaviour, the key of the atoms under which it drove, and for how many ticks.
pub type Decided = (Id<Behavior>, u128, u64);

/// Two behaviours become one memory sequence if the first has succeeded in at least this part of the second's ticks.
const FOLLOWS: f64 = 0.95;
/// Guards that are tried for a behaviour, among them the one that asks only for what it requires.
const GUARDS: usize = 5;
/// The most units of which every order is tried.
const PERMUTED: usize = 4;
/// The most trees that are made.
const TREES: usize = 1_000;

/// Trees of one unit for each behaviour and each memory node of `root`. A unit asks for what its behaviour requires and for
/// at most one more literal, which holds more often where it drives than elsewhere. The last unit has no guard.
///
/// Simulation tells whether any of them decides well. `atoms` are those of the keys, at most 128.
pub fn flat(
    root: &Node,
    atoms: &[Atom],
    decided: &[Decided],
    requirements: &[Requirement],
) -> Vec<Candidate> {
    let seen = Seen { atoms, decided };
    let bodies = seen.joined(bodies(root), &atoms_of(root));
    let (bound, free): (Vec<&Node>, Vec<&Node>) = bodies
        .iter()
        .partition(|body| needs(body, requirements).is_some());
    let resorts = if free.is_empty() { &bound } else { &free };
    let mut found = Vec::new();
    for resort in resorts {
        // What might stand last as well may be left out.
        let every = bodies.iter().filter(|body| body != resort).collect();
        let mut sets: Vec<Vec<&Node>> = vec![every];
        let few: Vec<&Node> = bound.iter().copied().filter(|b| b != resort).collect();
        if !sets.contains(&few) {
            sets.push(few);
        }
        let share = TREES / (resorts.len() * sets.len());
        for others in sets {
            let orders = orders(others.len());
            for units in seen.units(&others, share / orders.len().max(1), requirements) {
                for order in &orders {
                    let ordered = order.iter().filter_map(|i| units.get(*i).cloned());
                    let last = Unit {
                        guard: Guard::Const(true),
                        body: (*resort).clone(),
                    };
                    let root = tidy(select(ordered.chain([last]).collect()));
                    found.push(Candidate::new(Change::Flattened, root, requirements));
                }
            }
        }
    }
    found
}

/// The behaviours and memory nodes of a tree, each once.
fn bodies(root: &Node) -> Vec<Node> {
    let mut found = Vec::new();
    collect(root, &mut found);
    found
}

fn collect(node: &Node, found: &mut Vec<Node>) {
    match node {
        Node::Condition(_) => {}
        Node::Composite { memory: false, .. } => {
            let children = node.children().iter();
            children.for_each(|child| collect(child, found));
        }
        body => {
            if !found.contains(body) {
                found.push(body.clone());
            }
        }
    }
}

/// What was seen under a tree.
struct Seen<'a> {
    atoms: &'a [Atom],
    decided: &'a [Decided],
}

impl Seen<'_> {
    /// The bodies, joined to memory sequences where one nearly always follows a success of another that the tree asks for.
    fn joined(&self, mut bodies: Vec<Node>, asked: &BTreeSet<Atom>) -> Vec<Node> {
        let follows = |first: &Node, second: &Node| {
            let done = done(first).filter(|atom| first != second && asked.contains(atom));
            done.is_some_and(|atom| self.share(second, atom, true) >= FOLLOWS)
        };
        loop {
            let pair = (0..bodies.len()).find_map(|i| {
                let first = bodies.get(i)?;
                let j = bodies.iter().position(|second| follows(first, second))?;
                Some((i, j))
            });
            let Some((i, j)) = pair else { return bodies };
            let second = bodies.remove(j);
            if let Some(first) = bodies.get_mut(if j < i { i - 1 } else { i }) {
                *first = chain(first, &second);
            }
        }
    }

    /// The bodies, each under one of its guards, in at most `limit` ways if possible.
    fn units(
        &self,
        bodies: &[&Node],
        limit: usize,
        requirements: &[Requirement],
    ) -> Vec<Vec<Unit>> {
        let ways = |guards: usize| {
            let count = u32::try_from(bodies.len()).ok()?;
            guards.checked_pow(count)
        };
        let within = |guards: &usize| ways(*guards).is_some_and(|ways| ways <= limit);
        let most = (1..=GUARDS).rev().find(within).unwrap_or(1);
        let rules = bodies
            .iter()
            .map(|body| self.rules(body, most, requirements));
        choices(rules.collect())
    }

    /// A body under at most `most` guards, the likeliest first.
    fn rules(&self, body: &Node, most: usize, requirements: &[Requirement]) -> Vec<Unit> {
        let predicates = self.atoms.iter().filter_map(|atom| match atom {
            Atom::Predicate(_) => Some(*atom),
            _ => None,
        });
        let literals = predicates.flat_map(|atom| [(atom, true), (atom, false)]);
        let mut telling: Vec<(f64, Guard)> = literals
            .map(|(atom, value)| {
                let literal = Guard::Atom(atom);
                let guard = if value { literal } else { not(literal) };
                (self.gain(body, atom, value), guard)
            })
            .filter(|(gain, _)| *gain > 0.0)
            .collect();
        telling.sort_by(|a, b| b.0.total_cmp(&a.0));
        let guards = telling.into_iter().map(|(_, guard)| guard);
        let mut rules: Vec<Unit> = Vec::new();
        for guard in guards.chain([Guard::Const(true)]) {
            let mut unit = Unit {
                guard,
                body: body.clone(),
            };
            if let Some(needs) = unasked(&unit, requirements) {
                unit = unit.under(and([unit.guard.clone(), needs]));
            }
            if unit.guard != Guard::Const(true) && !rules.contains(&unit) {
                rules.push(unit);
            }
        }
        rules.truncate(most);
        rules
    }

    /// The part of a body's ticks in which an atom has this value.
    fn share(&self, body: &Node, atom: Atom, value: bool) -> f64 {
        let own = behaviors(body);
        self.part(|behavior| own.contains(&behavior), atom, value)
    }

    /// The part of the body's ticks in which an atom has this value, less that of the others' ticks.
    fn gain(&self, body: &Node, atom: Atom, value: bool) -> f64 {
        let own = behaviors(body);
        self.share(body, atom, value) - self.part(|b| !own.contains(&b), atom, value)
    }

    fn part(&self, of: impl Fn(Id<Behavior>) -> bool, atom: Atom, value: bool) -> f64 {
        let Some(bit) = self.atoms.iter().position(|a| *a == atom) else {
            return 0.0;
        };
        let (mut held, mut all) = (0, 0);
        for (_, values, times) in self.decided.iter().filter(|(behavior, ..)| of(*behavior)) {
            all += times;
            if (values >> bit & 1 == 1) == value {
                held += times;
            }
        }
        if all == 0 {
            0.0
        } else {
            held as f64 / all as f64
        }
    }
}

/// Every way to choose one of each.
fn choices(rules: Vec<Vec<Unit>>) -> Vec<Vec<Unit>> {
    rules.into_iter().fold(vec![Vec::new()], |chosen, rules| {
        let longer = chosen.iter().flat_map(|units: &Vec<Unit>| {
            rules
                .iter()
                .map(|unit| units.iter().cloned().chain([unit.clone()]).collect())
        });
        longer.collect()
    })
}

/// The orders of `count` units: all, or only the rotations where there are too many.
fn orders(count: usize) -> Vec<Vec<usize>> {
    if count > PERMUTED {
        return (0..count)
            .map(|first| (first..count).chain(0..first).collect())
            .collect();
    }
    let mut orders = vec![Vec::new()];
    for _ in 0..count {
        let longer = orders.iter().flat_map(|order: &Vec<usize>| {
            let left = (0..count).filter(|i| !order.contains(i));
            left.map(|i| order.iter().copied().chain([i]).collect())
        });
        orders = longer.collect();
    }
    orders
}
