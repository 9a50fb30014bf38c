//! EXPAND: from an ON row to a prime that holds on it.

use super::alive::Alive;
use super::bits::Bits;
use super::cube::{Cube, Literal};
use super::instance::Instance;

/// Rows that are enough to weigh literals by.
const ENOUGH: usize = 512;

/// How a literal is weighed against the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scoring {
    /// OFF rows excluded per ON row lost.
    Ratio,
    /// Fewest ON rows lost, then most OFF rows excluded.
    KeepOn,
    /// Most OFF rows excluded, then fewest ON rows lost.
    DropOff,
}

impl Scoring {
    /// Every one.
    pub(super) const ALL: [Self; 3] = [Self::Ratio, Self::KeepOn, Self::DropOff];

    /// Greater is better.
    fn score(self, lost: usize, gone: usize) -> (u64, u64) {
        let (lost, gone) = (lost as u64, gone as u64);
        match self {
            Self::Ratio => (gone * (1 << 20) / (lost + 1), gone),
            Self::KeepOn => (u64::MAX - lost, gone),
            Self::DropOff => (gone, u64::MAX - lost),
        }
    }
}

/// One prime out of these literals, which hold together on some ON rows of `on`: adds to the cube without literals the
/// one that scores best until it meets no OFF row, then drops literals while none is met again.
pub(super) fn expand(
    instance: &Instance,
    mut open: Vec<Literal>,
    on: &Bits,
    scoring: Scoring,
) -> Cube {
    let (mut kept, mut left) = (Alive::new(on), Alive::new(&instance.all_off()));
    let mut chosen = Vec::new();
    let mut enough = ENOUGH;
    while !left.is_empty() {
        let stride = |rows: &Alive| (rows.count() / enough).max(1);
        let (on_stride, off_stride) = (stride(&kept), stride(&left));
        let mut best: Option<((u64, u64), Literal)> = None;
        open.retain(|literal| {
            let (Some(inside), Some(meeting)) = tests(instance, *literal) else {
                return false;
            };
            let gone = left.count_out(meeting, off_stride);
            if gone > 0 {
                let score = scoring.score(kept.count_out(inside, on_stride), gone);
                if best.is_none_or(|(top, _)| score > top) {
                    best = Some((score, *literal));
                }
            }
            // What excludes nothing now never will.
            gone > 0 || off_stride > 1
        });
        // The words that were looked at may have shown nothing. A row that is both ON and OFF cannot be told apart; the
        // caller's sets are disjoint.
        let Some((_, literal)) = best else {
            if off_stride == 1 {
                break;
            }
            enough = usize::MAX;
            continue;
        };
        if let (Some(inside), Some(meeting)) = tests(instance, literal) {
            kept.keep(inside);
            left.keep(meeting);
        }
        open.retain(|l| *l != literal);
        chosen.push(literal);
    }
    prune(instance, Cube::new(chosen), on)
}

/// A column with the bit that it has where a literal holds.
type Test<'a> = (&'a Bits, bool);

fn tests(instance: &Instance, literal: Literal) -> (Option<Test<'_>>, Option<Test<'_>>) {
    let (inside, holds) = instance.on.inside(literal);
    let (meeting, meets) = instance.off.meeting(literal);
    (
        inside.map(|column| (column, holds)),
        meeting.map(|column| (column, meets)),
    )
}

/// The cube without the literals that it can do without; those that cost most rows of `on` go first.
pub(super) fn prune(instance: &Instance, mut cube: Cube, on: &Bits) -> Cube {
    loop {
        let idle = idle(instance, &cube);
        let shorter = idle.into_iter().map(|literal| {
            let shorter = cube.without(literal);
            (instance.on.cube_rows(&shorter, on).count(), shorter)
        });
        // Of equal counts the first.
        let best = shorter.reduce(|best, next| if next.0 > best.0 { next } else { best });
        match best {
            Some((_, shorter)) => cube = shorter,
            None => return cube,
        }
    }
}

/// The literals that exclude no OFF row alone.
fn idle(instance: &Instance, cube: &Cube) -> Vec<Literal> {
    let excluded = |literal: &Literal| {
        let mut rows = instance.all_off();
        if let (Some(column), meets) = instance.off.meeting(*literal) {
            rows.keep(column, !meets);
        }
        rows
    };
    let (mut once, mut twice) = (
        Bits::empty(instance.off.rows()),
        Bits::empty(instance.off.rows()),
    );
    for literal in cube.literals() {
        let rows = excluded(literal);
        twice.unite(&once.and(&rows));
        once.unite(&rows);
    }
    once.subtract(&twice);
    let literals = cube.literals().iter();
    literals
        .filter(|literal| excluded(literal).is_disjoint(&once))
        .copied()
        .collect()
}
