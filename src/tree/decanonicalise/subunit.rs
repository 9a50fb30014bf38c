//! Subunits: what Algorithm 1 rewrites (paper, Figure 6).

use super::problem::Problem;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Node, Status};
use crate::logic::{Bits, Cover};
use crate::tree::formula::{guarded, selector};

/// A part of the tree with the minterms that are its own.
#[derive(Clone, Debug)]
pub(super) struct Subunit {
    pub(super) body: Node,
    /// minterms of all behaviours in it.
    pub(super) rows: Bits,
    /// The behaviour whose termination is the subunit's: a chain's last.
    pub(super) last: Option<Id<Behavior>>,
    /// Y brings its guards along and fails by itself outside its rows.
    pub(super) guards_itself: bool,
}

/// Two subunits that a history literal tells apart, with the way in which a memory node joins them.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Pair {
    pub(super) first: usize,
    pub(super) second: usize,
    /// The termination of the first by which the second follows.
    pub(super) by: Status,
}

/// One subunit per behaviour.
pub(super) fn behaviors(problem: &Problem) -> Vec<Subunit> {
    let on = problem.on.iter();
    on.map(|(behavior, rows)| Subunit {
        body: Node::Behavior(*behavior),
        rows: rows.clone(),
        last: Some(*behavior),
        guards_itself: false,
    })
    .collect()
}

/// The selector of all subunits, each under its exact guard.
pub(super) fn canonical(problem: &Problem, subunits: &[Subunit]) -> Node {
    let units = subunits.iter().map(|subunit| {
        let off = problem.all().minus(&subunit.rows);
        subunit.under(problem, &problem.cover(&subunit.rows, &off))
    });
    selector(units.collect())
}

impl Subunit {
    /// The subunit under a guard, unless it has guards of its own.
    pub(super) fn under(&self, problem: &Problem, guard: &Cover) -> Node {
        if self.guards_itself {
            return self.body.clone();
        }
        guarded(problem.guard(guard), self.body.clone())
    }
}

/// Replaces two subunits by one, in the place of the earlier.
pub(super) fn replace(subunits: &[Subunit], i: usize, j: usize, by: Subunit) -> Vec<Subunit> {
    let mut by = Some(by);
    let mut left = Vec::new();
    for (k, subunit) in subunits.iter().enumerate() {
        if k == i || k == j {
            left.extend(by.take());
        } else {
            left.push(subunit.clone());
        }
    }
    left
}

/// The pairs that a history literal c tells apart: all minterms of the first have ¬c, all of the second have c.
///
/// Those whose first is nobody's second stand first, so that chains grow from their first member.
pub(super) fn pairs(problem: &Problem, subunits: &[Subunit]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (i, first) in subunits.iter().enumerate() {
        let Some(last) = first.last else { continue };
        for (by, atom) in [
            (Status::Success, Atom::Done(last)),
            (Status::Failure, Atom::Failed(last)),
        ] {
            let Some(column) = problem.column(atom) else {
                continue;
            };
            for (j, second) in subunits.iter().enumerate() {
                let apart = first.rows.is_disjoint(column) && second.rows.is_subset(column);
                if i != j && apart && !first.guards_itself && !second.guards_itself {
                    pairs.push(Pair {
                        first: i,
                        second: j,
                        by,
                    });
                }
            }
        }
    }
    let seconds: Vec<usize> = pairs.iter().map(|pair| pair.second).collect();
    pairs.sort_by_key(|pair| (seconds.contains(&pair.first), *pair));
    pairs
}

impl Pair {
    /// The subunits of the pair.
    pub(super) fn of<'a>(&self, subunits: &'a [Subunit]) -> Option<(&'a Subunit, &'a Subunit)> {
        subunits.get(self.first).zip(subunits.get(self.second))
    }

    /// What is left of both guards without the literal: c_i and c_j.
    fn remainders(&self, problem: &Problem, subunits: &[Subunit]) -> Option<(Cover, Cover)> {
        let (first, second) = self.of(subunits)?;
        let column = self.column(problem, first)?;
        let off = |rows: &Bits| problem.all().minus(rows);
        Some((
            problem.cover(&first.rows, &off(&first.rows).minus(column)),
            problem.cover(&second.rows, &off(&second.rows).and(column)),
        ))
    }

    fn column<'a>(&self, problem: &'a Problem, first: &Subunit) -> Option<&'a Bits> {
        let last = first.last?;
        problem.column(match self.by {
            Status::Failure => Atom::Failed(last),
            _ => Atom::Done(last),
        })
    }

    /// X: one guard for both, a memory node in it. `None` if the remainders are not equal.
    pub(super) fn x(&self, problem: &Problem, subunits: &[Subunit]) -> Option<Subunit> {
        let (first, second) = self.of(subunits)?;
        let (c_i, c_j) = self.remainders(problem, subunits)?;
        // Smallest covers are not unique: one that serves both sides makes the remainders equal.
        let rows = first.rows.or(&second.rows);
        let exact = |cover: &Cover| problem.columns.cover_rows(cover, &problem.all()) == rows;
        if !exact(&c_i) && !exact(&c_j) {
            return None;
        }
        Some(self.memory(
            first,
            second,
            first.body.clone(),
            second.body.clone(),
            false,
        ))
    }

    /// X where both have any guard in common: that of the union, which always exists.
    pub(super) fn joined(&self, _: &Problem, subunits: &[Subunit]) -> Option<Subunit> {
        let (first, second) = self.of(subunits)?;
        Some(self.memory(
            first,
            second,
            first.body.clone(),
            second.body.clone(),
            false,
        ))
    }

    /// Y: a memory sequence of two units. `None` where, after the first has ended, its guard would let it start over
    /// outside the second's minterms.
    pub(super) fn y(&self, problem: &Problem, subunits: &[Subunit]) -> Option<Subunit> {
        // A memory selector goes past a unit whose guard does not hold, which the history does not tell.
        if self.by == Status::Failure {
            return None;
        }
        let (first, second) = self.of(subunits)?;
        let (c_i, c_j) = self.remainders(problem, subunits)?;
        let column = self.column(problem, first)?;
        let after = problem.columns.cover_rows(&c_i, column);
        if !after.is_subset(&second.rows) {
            return None;
        }
        let unit = |cover: &Cover, body: &Node| guarded(problem.guard(cover), body.clone());
        Some(self.memory(
            first,
            second,
            unit(&c_i, &first.body),
            unit(&c_j, &second.body),
            true,
        ))
    }

    fn memory(
        &self,
        first: &Subunit,
        second: &Subunit,
        left: Node,
        right: Node,
        guards_itself: bool,
    ) -> Subunit {
        let kind = match self.by {
            Status::Failure => Composite::Selector,
            _ => Composite::Sequence,
        };
        let mut children = Vec::new();
        for node in [left, right] {
            match node {
                // Chains are one memory node.
                Node::Composite {
                    kind: inner,
                    memory: true,
                    children: links,
                } if inner == kind => children.extend(links),
                node => children.push(node),
            }
        }
        Subunit {
            body: Node::Composite {
                kind,
                memory: true,
                children,
            },
            rows: first.rows.or(&second.rows),
            last: second.last,
            guards_itself,
        }
    }

    /// What X and Y need of the environment: the second is entered from the pair alone, never at a start, and by no
    /// termination of its own that starts the memory node over.
    pub(super) fn entered_properly(&self, problem: &Problem, subunits: &[Subunit]) -> bool {
        let Some((first, second)) = self.of(subunits) else {
            return false;
        };
        let policy = problem.policy;
        let row = |minterm| {
            let at = policy.rows.binary_search_by(|row| row.minterm.cmp(minterm));
            at.ok()
        };
        let within = |rows: &Bits, minterm| row(minterm).is_some_and(|i| rows.contains(i));
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
