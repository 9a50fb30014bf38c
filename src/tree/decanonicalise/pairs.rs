//! Pairs of subunits that a memory node joins (paper, Figure 6: X and Y).

use super::minimiser::Minimiser;
use super::problem::Problem;
use super::subunit::Subunit;
use crate::ir::tree::{Atom, Composite, Node, Status};
use crate::logic::{Bits, Cover};
use crate::policy::Minterm;
use crate::tree::guard::cover;
use crate::tree::unit::{guarded, memory};
use std::collections::BTreeSet;

/// Two subunits that a memory node may join: a history literal holds on all rows of the second.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub(super) first: usize,
    pub(super) second: usize,
    /// The termination of the first after which the second follows.
    pub(super) by: Status,
}

/// The pairs that a history literal c discriminates: all minterms of the first have ¬c, all of the second have c.
///
/// Pairs whose first is no other pair's second come first, so that chains grow from their first member.
pub(super) fn pairs(problem: &Problem, subunits: &[Subunit]) -> Vec<Pair> {
    let mut pairs = following(problem, subunits);
    pairs.retain(|pair| {
        let column = pair.column(problem, subunits);
        let first = pair.of(subunits).map(|(first, _)| first);
        first
            .zip(column)
            .is_some_and(|(first, column)| first.rows.is_disjoint(column))
    });
    from_the_first(pairs)
}

/// The pairs in which all minterms of the second have c, in the same order. In a window of several terminations, c may
/// still hold in the first from an earlier time.
pub(super) fn followers(problem: &Problem, subunits: &[Subunit]) -> Vec<Pair> {
    from_the_first(following(problem, subunits))
}

fn from_the_first(mut pairs: Vec<Pair>) -> Vec<Pair> {
    let seconds: BTreeSet<usize> = pairs.iter().map(|pair| pair.second).collect();
    pairs.sort_by_key(|pair| (seconds.contains(&pair.first), *pair));
    pairs
}

fn following(problem: &Problem, subunits: &[Subunit]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (first, one) in subunits.iter().enumerate() {
        for by in [Status::Success, Status::Failure] {
            let Some(column) = column(problem, one, by).filter(|_| !one.guards_itself) else {
                continue;
            };
            let others = subunits.iter().enumerate();
            let follow = others.filter(|(second, other)| {
                first != *second && !other.guards_itself && other.rows.is_subset(column)
            });
            pairs.extend(follow.map(|(second, _)| Pair { first, second, by }));
        }
    }
    pairs
}

/// The rows in which the history says that what a subunit ends with has ended so.
fn column<'a>(problem: &'a Problem, subunit: &Subunit, by: Status) -> Option<&'a Bits> {
    let last = subunit.last?;
    problem.column(match by {
        Status::Failure => Atom::Failed(last),
        _ => Atom::Done(last),
    })
}

impl Pair {
    /// The subunits of the pair.
    pub(super) fn of<'a>(&self, subunits: &'a [Subunit]) -> Option<(&'a Subunit, &'a Subunit)> {
        subunits.get(self.first).zip(subunits.get(self.second))
    }

    /// The rows with c.
    fn column<'a>(&self, problem: &'a Problem, subunits: &[Subunit]) -> Option<&'a Bits> {
        column(problem, subunits.get(self.first)?, self.by)
    }

    /// Both guards without the literal, c_i and c_j, as ON and OFF rows: each is minimised on its own side of c.
    fn remainders(&self, minimiser: &Minimiser, subunits: &[Subunit]) -> Option<(Sided, Sided)> {
        let (first, second) = self.of(subunits)?;
        let column = self.column(minimiser.problem, subunits)?;
        let off = |rows: &Bits| minimiser.problem.all().minus(rows);
        let first = (first.rows.clone(), off(&first.rows).minus(column));
        let second = (second.rows.clone(), off(&second.rows).and(column));
        Some((first, second))
    }

    /// X: one guard for both, a memory node in it. `None` if the remainders are not equal.
    pub(super) fn x(&self, minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Subunit> {
        let (first, second) = self.of(subunits)?;
        let (c_i, c_j) = self.remainders(minimiser, subunits)?;
        // Smallest covers are not unique: one that serves both sides makes the remainders equal.
        let problem = minimiser.problem;
        let rows = first.rows.or(&second.rows);
        let exact = |(on, off): &Sided| {
            let cover = minimiser.cover(on, off)?;
            Some(problem.columns().cover_rows(&cover, &problem.all()) == rows)
        };
        if !exact(&c_i)? && !exact(&c_j)? {
            return None;
        }
        self.joined(minimiser, subunits)
    }

    /// X under any guard that both share: that of the union always exists.
    pub(super) fn joined(&self, _: &Minimiser, subunits: &[Subunit]) -> Option<Subunit> {
        let (first, second) = self.of(subunits)?;
        let bodies = [first.body.clone(), second.body.clone()];
        Some(self.memory(first, second, bodies, false))
    }

    /// Y: a memory sequence of two units. `None` where, after the first has ended, its guard would let it start over
    /// outside the second's minterms.
    pub(super) fn y(&self, minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Subunit> {
        // A memory selector goes past a unit whose guard does not hold, which the history does not tell.
        if self.by == Status::Failure {
            return None;
        }
        let problem = minimiser.problem;
        let (first, second) = self.of(subunits)?;
        let (c_i, c_j) = self.remainders(minimiser, subunits)?;
        let (c_i, c_j) = (
            minimiser.cover(&c_i.0, &c_i.1)?,
            minimiser.cover(&c_j.0, &c_j.1)?,
        );
        let column = self.column(problem, subunits)?;
        let after = problem.columns().cover_rows(&c_i, column);
        if !after.is_subset(&second.rows) {
            return None;
        }
        let unit = |c: &Cover, body: &Node| guarded(cover(c, &problem.policy.atoms), body.clone());
        let bodies = [unit(&c_i, &first.body), unit(&c_j, &second.body)];
        Some(self.memory(first, second, bodies, true))
    }

    /// X with the second behind a guard of its own. Where the first ends by a failure this replaces Y: a memory selector
    /// may pass nothing but its last child.
    pub(super) fn inner(&self, minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Subunit> {
        let (first, second) = self.of(subunits)?;
        let (_, (on, off)) = self.remainders(minimiser, subunits)?;
        if off.is_empty() {
            return None;
        }
        let guard = minimiser.guard(&on, &off)?.guard.clone();
        let bodies = [first.body.clone(), guarded(guard, second.body.clone())];
        Some(self.memory(first, second, bodies, false))
    }

    fn memory(
        &self,
        first: &Subunit,
        second: &Subunit,
        bodies: [Node; 2],
        guards_itself: bool,
    ) -> Subunit {
        let kind = match self.by {
            Status::Failure => Composite::Selector,
            _ => Composite::Sequence,
        };
        Subunit {
            body: memory(kind, bodies),
            rows: first.rows.or(&second.rows),
            last: second.last,
            guards_itself,
        }
    }

    /// What X and Y require of the environment: the second is entered only from the pair, never at a start, and not by a
    /// termination of its own that starts the memory node over.
    pub(super) fn entered_properly(&self, problem: &Problem, subunits: &[Subunit]) -> bool {
        let Some((first, second)) = self.of(subunits) else {
            return false;
        };
        let policy = problem.policy;
        // Without records, every minterm that the window allows may be a start.
        if policy.starts.is_empty() && policy.transitions.is_empty() {
            return false;
        }
        let within = |rows: &Bits, minterm: &Minterm| {
            let at = policy.rows.binary_search_by(|row| row.minterm.cmp(minterm));
            at.is_ok_and(|i| rows.contains(i))
        };
        let starts = policy.starts.iter().any(|(m, _)| within(&second.rows, m));
        let enters = policy.transitions.iter().any(|t| {
            let ends = t.status != Status::Running && t.status != self.by;
            t.to.as_ref().is_some_and(|to| within(&second.rows, to))
                && if within(&second.rows, &t.from) {
                    ends
                } else {
                    !within(&first.rows, &t.from)
                }
        });
        !starts && !enters
    }
}

/// ON rows and OFF rows.
type Sided = (Bits, Bits);
