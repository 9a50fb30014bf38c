//! EXPAND: from an ON row to a prime that holds on it; and covers built of such primes, the widest first.

use super::instance::{Instance, Pool};
use crate::logic::account::Account;
use crate::logic::alive::Alive;
use crate::logic::bits::Bits;
use crate::logic::cube::{Cube, Literal};
use crate::logic::random::{Random, sample};
use rayon::prelude::*;

/// Rows that are enough to weigh literals by.
const ENOUGH: usize = 512;

/// Expansions that each read this many words of rows are spread over several threads.
const PARALLEL: usize = 20_000;

/// How literals are compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Scoring {
    /// OFF rows excluded per ON row lost.
    Ratio,
    /// Fewest ON rows lost, then most OFF rows excluded.
    KeepOn,
    /// Most OFF rows excluded, then fewest ON rows lost.
    DropOff,
}

impl Scoring {
    /// All scorings.
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

/// A prime of these literals, all of which hold on some rows of `on`. To the cube without literals the one that scores
/// best is added until no OFF row is met; then literals are dropped as long as none is met again.
fn expand(
    instance: &Instance,
    mut open: Vec<Literal>,
    on: &Bits,
    scoring: Scoring,
    account: &Account,
) -> Cube {
    let (mut kept, mut left) = (Alive::new(on), Alive::new(&instance.all_off()));
    let mut chosen = Vec::new();
    let mut enough = ENOUGH;
    while !left.is_empty() {
        let stride = |rows: &Alive| (rows.count() / enough).max(1);
        let (on_stride, off_stride) = (stride(&kept), stride(&left));
        let read = 16 + kept.words() / on_stride + left.words() / off_stride;
        account.spend((open.len() * read) as u64);
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
            // A literal that excludes nothing now never will.
            gone > 0 || off_stride > 1
        });
        // The words that were read may show nothing where others would. If all were read, a row is both ON and OFF; the
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
    let words = (instance.on.rows() + instance.off.rows()).div_ceil(64);
    account.spend((chosen.len() * (8 + 4 * words)) as u64);
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

/// The cube without superfluous literals; those that cost most rows of `on` go first.
fn prune(instance: &Instance, mut cube: Cube, on: &Bits) -> Cube {
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
    let mut once = Bits::empty(instance.off.rows());
    let mut twice = once.clone();
    for literal in cube.literals() {
        let rows = instance.excluded(*literal);
        twice.unite(&once.and(&rows));
        once.unite(&rows);
    }
    once.subtract(&twice);
    let literals = cube.literals().iter();
    literals
        .filter(|literal| instance.excluded(**literal).is_disjoint(&once))
        .copied()
        .collect()
}

/// Primes of the pool that cover `rows` together.
///
/// Literals are weighed on the rows that are still open, so that what few rows share is not drowned by the others. In each
/// round some open rows are seeds of EXPAND. Of the primes found the widest is taken, then those that cover more than
/// half as many of the rows left. `None` if the account is spent.
pub(super) fn sweep(
    instance: &Instance,
    pool: &mut Pool,
    rows: &Bits,
    seeds: usize,
    scorings: &[Scoring],
    random: &mut Random,
    account: &Account,
) -> Option<Vec<usize>> {
    let mut open = rows.clone();
    let mut cover = Vec::new();
    while !open.is_empty() {
        if account.is_spent() {
            return None;
        }
        let seeds = sample(open.iter(), open.count(), seeds, random);
        let mut found: Vec<usize> = expansions(instance, &seeds, &open, scorings, account)
            .into_iter()
            .map(|cube| pool.add(instance, cube))
            .collect();
        found.sort_unstable();
        found.dedup();
        let words = open.bound().div_ceil(64);
        account.spend((found.len() * (8 + 8 * words)) as u64);
        let mut widest = 0;
        while let Some((at, gain)) = pool.widest(found.iter().copied(), &open) {
            if 2 * gain <= widest {
                break;
            }
            widest = widest.max(gain);
            if let Some(prime) = pool.get(at) {
                open.subtract(&prime.covers);
            }
            cover.push(at);
        }
        // Without a gain the rows left are OFF rows as well; the caller's sets are disjoint.
        if widest == 0 {
            break;
        }
    }
    Some(cover)
}

/// A prime for each seed and scoring, in this order on any number of threads.
fn expansions(
    instance: &Instance,
    seeds: &[usize],
    open: &Bits,
    scorings: &[Scoring],
    account: &Account,
) -> Vec<Cube> {
    let one = |(seed, scoring): (usize, Scoring)| {
        let literals: Vec<Literal> = instance.on.literals_of(seed).collect();
        expand(instance, literals, open, scoring, account)
    };
    let pairs = seeds
        .iter()
        .flat_map(|seed| scorings.iter().map(|s| (*seed, *s)));
    if instance.words() < PARALLEL {
        return pairs.map(one).collect();
    }
    pairs.collect::<Vec<_>>().into_par_iter().map(one).collect()
}
