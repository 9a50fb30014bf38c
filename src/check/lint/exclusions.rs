//! Which predicates exclude one another, by what they compare: two values of one enum, two intervals of one reading.

use super::cases::{About, Cases, Numbers, when};
use super::view::View;
use crate::ir::Program;
use crate::ir::tree::{Atom, Exclusion};
use std::collections::{BTreeMap, BTreeSet};

/// An atom with a value, and the cases in which it has it.
struct Literal {
    atom: Atom,
    value: bool,
    cases: Cases,
}

/// What cannot hold at once of these atoms, whatever happens and even where a reading is not a number: what never holds
/// for itself, pairs, and the values of one quantity none of which it has. What is too involved is not found.
pub fn exclusions(program: &Program, atoms: &BTreeSet<Atom>) -> Vec<Exclusion> {
    let literals = atoms.iter().flat_map(|atom| {
        [true, false].map(|value| Literal {
            atom: *atom,
            value,
            cases: of(program, *atom, value),
        })
    });
    let (never, possible): (Vec<Literal>, Vec<Literal>) =
        literals.partition(|literal| literal.cases.is_never());
    let mut found: Vec<Exclusion> = never.iter().map(|it| written([it])).collect();
    for (at, one) in possible.iter().enumerate() {
        for other in possible.iter().skip(at + 1) {
            if one.atom != other.atom && excluded([one, other]) {
                found.push(written([one, other]));
            }
        }
    }
    found.extend(of_all_values(&possible));
    found
}

fn of(program: &Program, atom: Atom, value: bool) -> Cases {
    match atom {
        Atom::Predicate(id) => match program.predicates[id].when {
            Some(condition) => {
                let view = View::of(program, &program.predicates[id].name);
                when(view, condition, value, Numbers::Any)
            }
            None => Cases::Unknown,
        },
        Atom::Done(_) | Atom::Failed(_) => Cases::Unknown,
    }
}

fn written<'l>(literals: impl IntoIterator<Item = &'l Literal>) -> Exclusion {
    let literals = literals.into_iter();
    literals.map(|it| (it.atom, it.value)).collect()
}

fn excluded<'l>(literals: impl IntoIterator<Item = &'l Literal>) -> bool {
    let all = literals.into_iter();
    let all = all.fold(Cases::constant(true), |all, it| all.and(&it.cases));
    all.is_never()
}

/// Where each of several predicates rules out some values of one quantity, and no value is left: no more of them than
/// that takes.
fn of_all_values(literals: &[Literal]) -> impl Iterator<Item = Exclusion> {
    let mut groups: BTreeMap<About, Vec<&Literal>> = BTreeMap::new();
    for literal in literals.iter().filter(|literal| !literal.value) {
        if let Some(about) = literal.cases.about() {
            groups.entry(about).or_default().push(literal);
        }
    }
    groups.into_values().filter_map(|mut group| {
        if !excluded(group.iter().copied()) {
            return None;
        }
        for at in (0..group.len()).rev() {
            let taken = group.remove(at);
            if !excluded(group.iter().copied()) {
                group.insert(at, taken);
            }
        }
        // Pairs are found as pairs.
        (group.len() > 2).then(|| written(group))
    })
}
