//! Guards where the values of some atoms are open.

use crate::ir::tree::{Atom, Guard};

/// The value of a guard, or the first open atom on which it depends.
pub(in crate::tree) fn value<O>(
    guard: &Guard,
    atom: &impl Fn(Atom) -> Result<bool, O>,
) -> Result<bool, O> {
    let each = |guard| value(guard, atom);
    match guard {
        Guard::Const(value) => Ok(*value),
        Guard::Atom(asked) => atom(*asked),
        Guard::Not(guard) => value(guard, atom).map(|value| !value),
        Guard::And(guards) => decided(guards.iter().map(each), false),
        Guard::Or(guards) => decided(guards.iter().map(each), true),
    }
}

/// `decisive` if one of the values is, whatever else is open; else the first that is open.
pub(in crate::tree) fn decided<O>(
    values: impl Iterator<Item = Result<bool, O>>,
    decisive: bool,
) -> Result<bool, O> {
    let mut open = None;
    for value in values {
        match value {
            Ok(value) if value == decisive => return Ok(decisive),
            Ok(_) => {}
            Err(atom) => open = open.or(Some(atom)),
        }
    }
    open.map_or(Ok(!decisive), Err)
}
