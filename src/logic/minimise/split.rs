//! ON cubes as their minterms.
//!
//! A cube that lies in no prime, or only in long ones, may be covered by several primes together. Few minterms replace the
//! cubes; where there are many, one prime covers each ON cube.

use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::packed::Packed;
use std::collections::BTreeSet;

/// The most minterms that replace cubes.
const MINTERMS: usize = 2_048;

/// The same problem with minterms for ON rows; `None` where they are minterms already, or too many.
pub(super) fn split(columns: &Columns, on: &Bits, off: &Bits) -> Option<(Columns, Bits, Bits)> {
    let atoms = columns.atoms();
    let cube = |row| {
        let mut cube = Packed::universe(atoms);
        for literal in columns.literals_of(row) {
            cube.set(literal.atom, Some(literal.positive));
        }
        cube
    };
    let ons: Vec<Packed> = on.iter().map(cube).collect();
    let mut all: usize = 0;
    for cube in &ons {
        let free = u32::try_from(atoms - cube.literals()).ok()?;
        all = all.checked_add(1_usize.checked_shl(free)?)?;
        if all > MINTERMS {
            return None;
        }
    }
    if all == ons.len() {
        return None;
    }
    let minterms = ons.into_iter().flat_map(|cube| cube.minterms(atoms));
    let minterms: BTreeSet<Packed> = minterms.collect();
    let ones = minterms.len();
    let rows: Vec<Packed> = minterms.into_iter().chain(off.iter().map(cube)).collect();
    let set = |range| Bits::collect(rows.len(), range);
    Some((
        Columns::of(atoms, &rows),
        set(0..ones),
        set(ones..rows.len()),
    ))
}
