//! Guards that people read: as short as they are found to be.

use crate::ir::tree::{Atom, Guard};
use crate::logic::{Bits, Columns, Minterm, minimise};
use crate::tree::circuit::guards::Guards;
use crate::tree::circuit::{Signal, truth};
use crate::tree::guard::{factored, not, with_part};

/// A guard of at most this many atoms is also minimised in two levels.
const TWO_LEVELS: usize = 8;

/// A guard of at most this many literals is tried without each of its parts.
const DROPPED: usize = 400;

/// A guard of at most `most` literals that has the value of `signal` wherever `free` does not hold. `None` if none is
/// found.
///
/// Two are looked for: the signal as it was built, without the parts that it can do without, and the smallest two-level
/// form with its common literals factored out. The shorter one is taken, the first if they are alike.
pub(in crate::tree) fn shorten(
    signal: Signal,
    free: Signal,
    most: usize,
    guards: &mut Guards,
) -> Option<Guard> {
    let built = guards.guard(signal, most);
    let built = built.map(|guard| match literals(&guard) <= DROPPED {
        true => without_redundancy(guard, free, guards),
        false => guard,
    });
    let support = guards.support(&[signal, free]);
    let flat = (support.len() <= TWO_LEVELS).then(|| two_levels(signal, free, &support, guards));
    let found = built.into_iter().chain(flat);
    found.min_by_key(literals)
}

/// The number of literals of a guard.
fn literals(guard: &Guard) -> usize {
    let mut count = 0;
    guard.visit_atoms(&mut |_| count += 1);
    count
}

/// The guard without the parts of conjunctions and disjunctions that change nothing where `free` does not hold, large
/// ones first.
fn without_redundancy(mut guard: Guard, free: Signal, guards: &mut Guards) -> Guard {
    let signal = guards.signal(&guard);
    for constant in [false, true] {
        let differs = guards.circuit.and(!free, signal.negated_if(constant));
        if guards.is_never(differs) {
            return Guard::Const(constant);
        }
    }
    let mut at = 0;
    while let Some(shorter) = without(&guard, &mut { at }) {
        let changed = guards.signal(&shorter);
        let differs = guards.circuit.xor(changed, signal);
        let differs = guards.circuit.and(differs, !free);
        if guards.is_never(differs) {
            guard = shorter;
        } else {
            at += 1;
        }
    }
    guard
}

/// The guard without its `at`-th part, in the order in which they are read; `None` if there are fewer.
fn without(guard: &Guard, at: &mut usize) -> Option<Guard> {
    let (Guard::And(parts) | Guard::Or(parts)) = guard else {
        return None;
    };
    for (i, part) in parts.iter().enumerate() {
        if *at == 0 {
            return Some(with_part(guard, i, None));
        }
        *at -= 1;
        if let Some(shorter) = without(part, at) {
            return Some(with_part(guard, i, Some(shorter)));
        }
    }
    None
}

/// A guard that holds in the rows `on` and not in the rows `off`: the smallest disjunction of conjunctions, or the
/// negation of that of its negation if that is shorter.
pub(in crate::tree) fn covered(columns: &Columns, on: &Bits, off: &Bits, atoms: &[Atom]) -> Guard {
    let plain = factored(&minimise(columns, on, off), atoms);
    let turned = not(factored(&minimise(columns, off, on), atoms));
    if literals(&turned) < literals(&plain) {
        turned
    } else {
        plain
    }
}

/// The two-level form of a signal, by its truth table.
fn two_levels(signal: Signal, free: Signal, support: &[(Atom, Signal)], guards: &Guards) -> Guard {
    let inputs: Vec<Signal> = support.iter().map(|(_, input)| *input).collect();
    let atoms: Vec<Atom> = support.iter().map(|(atom, _)| *atom).collect();
    let rows = 1usize << inputs.len();
    let column = |signal| {
        let words = truth::column(&guards.circuit, signal, &inputs);
        let holds = move |row: &usize| {
            words
                .get(row / 64)
                .is_some_and(|w| w >> (row % 64) & 1 == 1)
        };
        Bits::collect(rows, (0..rows).filter(holds))
    };
    let (holds, free) = (column(signal), column(free));
    let (on, off) = (
        holds.minus(&free),
        Bits::full(rows).minus(&holds).minus(&free),
    );
    // The first input is the highest digit of a row's number.
    let minterm = |row| Minterm::new((0..inputs.len()).rev().map(|digit| row >> digit & 1 == 1));
    let minterms: Vec<Minterm> = (0..rows).map(minterm).collect();
    let columns = Columns::new(inputs.len(), minterms.iter().map(Minterm::words));
    covered(&columns, &on, &off, &atoms)
}
