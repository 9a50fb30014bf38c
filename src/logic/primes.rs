//! Prime implicants: cubes that hold on some ON rows, on no OFF row, and that no literal can be dropped from.

use super::bits::Bits;
use super::columns::Columns;
use super::cube::{Cube, Literal};

/// All primes that hold in the row `seed`, and some cubes that are not prime, or `None` when the search for them takes more than `budget` steps.
///
/// A prime through the seed is a minimal set of the seed's literals that excludes every OFF row: a minimal hitting set
/// of the sets in which the OFF rows differ from the seed.
pub fn all_through(
    columns: &Columns,
    seed: usize,
    off: &Bits,
    budget: &mut usize,
) -> Option<Vec<Cube>> {
    let mut found = Vec::new();
    let open: Vec<Literal> = columns.literals_of(seed).collect();
    let hit = hit(columns, &mut Vec::new(), &open, off, &mut found, budget);
    hit.then_some(found)
}

/// Completes `chosen` by literals of `open`, each of which excludes a row that those before it do not; `left` is what it does not exclude yet.
fn hit(
    columns: &Columns,
    chosen: &mut Vec<Literal>,
    open: &[Literal],
    left: &Bits,
    found: &mut Vec<Cube>,
    budget: &mut usize,
) -> bool {
    let Some(step) = budget.checked_sub(1) else {
        return false;
    };
    *budget = step;
    let Some(row) = left.first() else {
        found.push(Cube::new(chosen.iter().copied()));
        return true;
    };
    let mut open = open.to_vec();
    // The branches exclude each other: a literal that was tried is not open in later branches.
    for literal in open.clone() {
        if columns.value(row, literal.atom) == literal.positive {
            continue;
        }
        open.retain(|l| *l != literal);
        chosen.push(literal);
        let mut rest = left.clone();
        columns.restrict(&mut rest, literal);
        let goes_on = hit(columns, chosen, &open, &rest, found, budget);
        chosen.pop();
        if !goes_on {
            return false;
        }
    }
    true
}

/// How EXPAND weighs a literal.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scoring {
    /// OFF rows excluded per ON row lost.
    Ratio,
    /// Fewest ON rows lost, then most OFF rows excluded.
    KeepOn,
    /// Most OFF rows excluded, then fewest ON rows lost.
    DropOff,
}

/// One prime through the seed: from the cube without literals, adds the literal of the seed that scores best until no
/// OFF row is left, then drops literals while none comes back.
pub fn expand(columns: &Columns, seed: usize, on: &Bits, off: &Bits, scoring: Scoring) -> Cube {
    let mut open: Vec<Literal> = columns.literals_of(seed).collect();
    let (mut kept, mut left) = (on.clone(), off.clone());
    let mut chosen = Vec::new();
    while !left.is_empty() {
        let (ons, offs) = (kept.count(), left.count());
        let mut best: Option<((u64, u64), Literal)> = None;
        for literal in &open {
            let (mut k, mut l) = (kept.clone(), left.clone());
            columns.restrict(&mut k, *literal);
            columns.restrict(&mut l, *literal);
            let (lost, gone) = ((ons - k.count()) as u64, (offs - l.count()) as u64);
            if gone == 0 {
                continue;
            }
            let score = match scoring {
                Scoring::Ratio => (gone * (1 << 20) / (lost + 1), gone),
                Scoring::KeepOn => (u64::MAX - lost, gone),
                Scoring::DropOff => (gone, u64::MAX - lost),
            };
            if best.is_none_or(|(top, _)| score > top) {
                best = Some((score, *literal));
            }
        }
        // A row that is both ON and OFF cannot be told apart; the caller's sets are disjoint.
        let Some((_, literal)) = best else { break };
        columns.restrict(&mut kept, literal);
        columns.restrict(&mut left, literal);
        open.retain(|l| *l != literal);
        chosen.push(literal);
    }
    prune(columns, Cube::new(chosen), on, off)
}

/// The cube without the literals that it can do without; those that cost most ON rows go first.
pub fn prune(columns: &Columns, mut cube: Cube, on: &Bits, off: &Bits) -> Cube {
    loop {
        let shorter = cube
            .literals()
            .iter()
            .map(|literal| cube.without(*literal))
            .filter(|shorter| columns.cube_rows(shorter, off).is_empty())
            .enumerate()
            .max_by_key(|(i, shorter)| {
                (
                    columns.cube_rows(shorter, on).count(),
                    std::cmp::Reverse(*i),
                )
            });
        match shorter {
            Some((_, shorter)) => cube = shorter,
            None => return cube,
        }
    }
}
