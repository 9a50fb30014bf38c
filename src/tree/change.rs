//! What one side decides otherwise than another: a condition for each pair of decisions.

mod listed;
mod onward;

pub use onward::onward;

use super::canonicalise::{LITERALS, decisions, shorten};
use super::circuit::Signal;
use super::circuit::guards::Guards;
use super::equivalence::Side;
use super::reading::{Irreducible, Reading};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Exclusion, Guard, Status};

/// Where one behaviour takes the place of another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The condition, as short as it is found to be; `None` if it is too large to be written out.
    pub when: Option<Guard>,
    /// What both tick before in that tick, one after another, and what each answers; nothing where they select differently.
    pub ended: Vec<(Id<Behavior>, Status)>,
    /// What was selected, or came next.
    pub old: Option<Id<Behavior>>,
    /// What is selected now, or comes next.
    pub new: Option<Id<Behavior>>,
}

/// When a behaviour is selected; `None` is no behaviour at all.
type Decision = (Option<Id<Behavior>>, Signal);

/// What `new` decides otherwise than `old`, in the order of the old decisions. Of what the history asks at most `window`
/// terminations hold together, and minterms of which a table says nothing or which are excluded are left out.
///
/// # Errors
/// A tree depends on more than predicates and the history.
pub fn changes(
    old: Side,
    new: Side,
    window: usize,
    excluded: &[Exclusion],
) -> Result<Vec<Change>, Irreducible> {
    if let (Side::Policy(old), Side::Policy(new)) = (old, new)
        && let Some(changes) = listed::listed(old, new)
    {
        return Ok(changes);
    }
    let sides = [old, new];
    let mut guards = Guards::new();
    let mut atoms = Vec::new();
    for side in sides {
        match side {
            Side::Tree(root) => root.visit_atoms(&mut |atom| atoms.push(atom)),
            Side::Policy(policy) => atoms.extend(&policy.atoms),
        }
    }
    for atom in &atoms {
        guards.atom(*atom);
    }
    let (old, said) = decided(old, &mut guards)?;
    let (new, also) = decided(new, &mut guards)?;
    let beyond = beyond(&atoms, window, &mut guards);
    let together = together(excluded, &mut guards);
    let free = guards.circuit.any([!said, !also, beyond, together]);
    let mut changes = Vec::new();
    for (was, before) in &old {
        for (is, after) in &new {
            if was == is {
                continue;
            }
            let both = guards.circuit.and(*before, *after);
            let both = guards.circuit.and(both, !free);
            if guards.is_never(both) {
                continue;
            }
            changes.push(Change {
                when: shorten(both, free, LITERALS, &mut guards),
                ended: Vec::new(),
                old: *was,
                new: *is,
            });
        }
    }
    // Beside a long table a short condition may need minterms that it does not list.
    if changes.iter().any(|change| change.when.is_none())
        && let Some(listed) = listed::beside(sides)
    {
        return Ok(listed);
    }
    Ok(changes)
}

/// When each behaviour is selected, and where anything is said at all.
fn decided(side: Side, guards: &mut Guards) -> Result<(Vec<Decision>, Signal), Irreducible> {
    match side {
        Side::Tree(root) => {
            let found = decisions(root, Reading::Furthest, guards)?;
            let any = guards.circuit.any(found.iter().map(|(_, when)| *when));
            let mut all: Vec<Decision> = Vec::new();
            all.extend(
                found
                    .into_iter()
                    .map(|(behavior, when)| (Some(behavior), when)),
            );
            all.push((None, !any));
            Ok((all, Signal::TRUE))
        }
        Side::Policy(policy) => {
            let mut all: Vec<Decision> = Vec::new();
            let mut said = Signal::FALSE;
            for row in &policy.rows {
                let values = row.minterm.values();
                let free = row.free.as_ref();
                let free: Vec<bool> = free.map_or_else(Vec::new, |free| free.values().collect());
                let mut when = !said;
                for (at, (atom, value)) in policy.atoms.iter().zip(values).enumerate() {
                    if free.get(at) != Some(&true) {
                        let holds = guards.atom(*atom);
                        when = guards.circuit.and(when, holds.negated_if(!value));
                    }
                }
                said = guards.circuit.or(said, when);
                match all
                    .iter_mut()
                    .find(|(known, _)| *known == Some(row.behavior))
                {
                    Some((_, before)) => *before = guards.circuit.or(*before, when),
                    None => all.push((Some(row.behavior), when)),
                }
            }
            Ok((all, said))
        }
    }
}

/// Where something holds together that is excluded.
fn together(excluded: &[Exclusion], guards: &mut Guards) -> Signal {
    let mut any = Vec::new();
    for literals in excluded {
        let literals = literals.iter();
        let literals = literals.map(|(atom, value)| guards.atom(*atom).negated_if(!value));
        let literals: Vec<Signal> = literals.collect();
        any.push(guards.circuit.all(literals));
    }
    guards.circuit.any(any)
}

/// Where more of what the history asks holds than the window has room for.
fn beyond(atoms: &[Atom], window: usize, guards: &mut Guards) -> Signal {
    let mut asked: Vec<Atom> = atoms.to_vec();
    asked.retain(|atom| !matches!(atom, Atom::Predicate(_)));
    asked.sort_unstable();
    asked.dedup();
    let held: Vec<Signal> = asked.into_iter().map(|atom| guards.atom(atom)).collect();
    match held.len() > window {
        true => guards.circuit.at_least(window + 1, &held),
        false => Signal::FALSE,
    }
}
