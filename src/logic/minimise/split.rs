//! ON cubes in smaller parts.
//!
//! A cube that lies in no prime, or only in long ones, may be covered by several primes together. Few minterms take the
//! places of the cubes; where there are more, but not too many, they are tried beside the cubes. What is larger still is
//! cut where the primes of a cover cut it.

use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::Cover;
use crate::logic::packed::Packed;
use std::collections::BTreeSet;

/// The most minterms that replace cubes.
const MINTERMS: usize = 2_048;
/// The most minterms, or parts of cubes, that are tried beside them.
const PARTS: usize = 16_384;
/// How many times as many may be written out, since overlapping cubes have some in common.
const OVERLAP: usize = 8;

/// A problem with other rows: the table, the ON rows and the OFF rows.
pub(super) type Split = (Columns, Bits, Bits);

/// The same problem with minterms for ON rows; `None` where they are minterms already, or too many.
pub(super) fn split(columns: &Columns, on: &Bits, off: &Bits) -> Option<Split> {
    minterms(columns, on, off, MINTERMS)
}

/// The same problem with smaller ON rows: minterms, or what the primes of a cover cut the cubes into. `None` where neither
/// changes anything, or there would be too many.
pub(super) fn finer(columns: &Columns, on: &Bits, off: &Bits, cover: &Cover) -> Option<Split> {
    if columns.are_minterms() {
        return None;
    }
    minterms(columns, on, off, PARTS).or_else(|| cut(columns, on, off, cover))
}

fn minterms(columns: &Columns, on: &Bits, off: &Bits, most: usize) -> Option<Split> {
    let atoms = columns.atoms();
    let mut ons: Vec<Packed> = on.iter().map(|row| columns.packed(row, atoms)).collect();
    // Overlapping cubes have minterms in common, which count once. With the larger cubes first, too many are noticed early.
    ons.sort_by_cached_key(Packed::literals);
    if ons
        .first()
        .is_none_or(|largest| largest.literals() == atoms)
    {
        return None;
    }
    let mut all: BTreeSet<Packed> = BTreeSet::new();
    let mut left = most.saturating_mul(OVERLAP);
    for cube in ons {
        let free = u32::try_from(atoms - cube.literals()).ok()?;
        let size = 1_usize.checked_shl(free).filter(|size| *size <= most)?;
        left = left.checked_sub(size)?;
        all.extend(cube.minterms(atoms));
        if all.len() > most {
            return None;
        }
    }
    Some(with_parts(columns, all, off))
}

/// Each ON cube in disjoint parts, of which each lies wholly in a prime of the cover or does not meet it.
fn cut(columns: &Columns, on: &Bits, off: &Bits, cover: &Cover) -> Option<Split> {
    let atoms = columns.atoms();
    let mut parts: Vec<Packed> = on.iter().map(|row| columns.packed(row, atoms)).collect();
    let before = parts.len();
    for prime in cover.cubes() {
        let prime = Packed::of(atoms, prime);
        let mut smaller = Vec::with_capacity(parts.len());
        for part in parts {
            if part.meets(&prime) && !prime.contains(&part) {
                smaller.push(part.and(&prime));
                smaller.extend(part.minus(&prime));
            } else {
                smaller.push(part);
            }
        }
        parts = smaller;
        if parts.len() > PARTS {
            return None;
        }
    }
    (parts.len() > before).then(|| with_parts(columns, parts.into_iter().collect(), off))
}

/// A table of these ON rows and of the OFF rows as they are.
fn with_parts(columns: &Columns, parts: BTreeSet<Packed>, off: &Bits) -> Split {
    let (ones, atoms) = (parts.len(), columns.atoms());
    let offs = off.iter().map(|row| columns.packed(row, atoms));
    let rows: Vec<Packed> = parts.into_iter().chain(offs).collect();
    let set = |range| Bits::collect(rows.len(), range);
    (
        Columns::of(columns.atoms(), &rows),
        set(0..ones),
        set(ones..rows.len()),
    )
}

#[cfg(test)]
mod tests {
    use super::minterms;
    use crate::logic::bits::Bits;
    use crate::logic::columns::Columns;
    use crate::logic::packed::Packed;

    /// Of three atoms, three cubes of four minterms each come to seven.
    #[test]
    fn minterms_of_several_cubes_count_once() {
        let cube = |atom| {
            let mut cube = Packed::universe(3);
            cube.set(atom, Some(true));
            cube
        };
        let columns = Columns::of(3, &[cube(0), cube(1), cube(2)]);
        let (on, off) = (Bits::full(3), Bits::empty(3));
        let found = minterms(&columns, &on, &off, 7).map(|(columns, on, _)| (columns.rows(), on));
        assert_eq!(found, Some((7, Bits::full(7))));
        assert!(minterms(&columns, &on, &off, 6).is_none());
    }
}
