//! Subunits: what Algorithm 1 rewrites (paper, Figure 6).

use super::minimiser::Minimiser;
use super::problem::Problem;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover};
use crate::tree::guard::cover;
use crate::tree::unit::{guarded, selector};

/// A part of the tree with the minterms that are its own.
#[derive(Clone, Debug)]
pub(super) struct Subunit {
    pub(super) body: Node,
    /// The minterms of all behaviours in it.
    pub(super) rows: Bits,
    /// The behaviour whose termination is the subunit's: a chain's last.
    pub(super) last: Option<Id<Behavior>>,
    /// Whether its own guards make it fail outside its rows, as those of Y do.
    pub(super) guards_itself: bool,
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

/// The selector of all subunits, each under its exact guard; `None` if the account is spent.
pub(super) fn canonical(minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Node> {
    let units = subunits.iter().map(|subunit| {
        let off = minimiser.problem.all().minus(&subunit.rows);
        let cover = minimiser.cover(&subunit.rows, &off)?;
        Some(subunit.under(minimiser.problem, &cover))
    });
    let units: Option<Vec<Node>> = units.collect();
    units.map(selector)
}

impl Subunit {
    /// Whether it is a behaviour alone, which may stand in several places.
    pub(super) fn is_behavior(&self) -> bool {
        matches!(self.body, Node::Behavior(_))
    }

    /// The subunit under a guard, unless it has guards of its own.
    pub(super) fn under(&self, problem: &Problem, guard: &Cover) -> Node {
        if self.guards_itself {
            return self.body.clone();
        }
        let guard = cover(guard, &problem.policy.atoms);
        guarded(guard, self.body.clone())
    }
}

/// Replaces two subunits by one, which stands where the earlier stood.
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
