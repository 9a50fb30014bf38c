//! Why a tree is not equal to a policy.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::policy::Minterm;
use crate::tree::equivalence::{Trace, Unknown};
use crate::tree::reading::Irreducible;
use std::fmt::{self, Display, Formatter};

/// Why a tree is not equal to a policy.
///
/// Its text names behaviours, predicates and minterms by number: names are the program's.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refuted {
    /// The policy has no rows.
    Empty,
    /// The tree has no canonical form.
    Irreducible(Irreducible),
    /// With memory read from the history it decides otherwise here.
    Decides {
        /// The minterm.
        minterm: Minterm,
        /// What the policy does.
        policy: Id<Behavior>,
        /// What the tree does.
        tree: Option<Id<Behavior>>,
    },
    /// It asks what the policy does not observe.
    Unknown(Atom),
    /// On this path it decides otherwise; left is the tree, right the policy.
    Parts(Trace),
    /// There was too much to explore.
    Undecided,
}

impl Display for Refuted {
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        match self {
            Refuted::Empty => f.write_str("the policy has no rows"),
            Refuted::Irreducible(why) => write!(f, "the tree has no canonical form: {why}"),
            Refuted::Decides {
                minterm,
                policy,
                tree,
            } => parts(f, minterm, *tree, Some(*policy)),
            Refuted::Unknown(atom) => Unknown(*atom).fmt(f),
            Refuted::Parts(trace) => {
                write!(f, "after {} ticks, ", trace.steps.len())?;
                parts(f, &trace.valuation, trace.left, trace.right)
            }
            Refuted::Undecided => f.write_str("there is too much to explore"),
        }
    }
}

impl std::error::Error for Refuted {}

fn parts(
    f: &mut Formatter,
    minterm: &Minterm,
    tree: Option<Id<Behavior>>,
    policy: Option<Id<Behavior>>,
) -> fmt::Result {
    f.write_str("in minterm ")?;
    for value in minterm.values() {
        f.write_str(if value { "1" } else { "0" })?;
    }
    let [tree, policy] = [tree, policy].map(|selected| match selected {
        Some(behavior) => format!("behaviour {}", behavior.index()),
        None => "nothing".to_owned(),
    });
    write!(f, " the tree selects {tree} and the policy {policy}")
}
