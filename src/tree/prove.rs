//! Proofs that a tree takes the decisions of a policy.

use super::canonicalise::{Irreducible, canonicalise};
use super::equivalence::{Environment, Explored, Side, Trace, Verdict, compare};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::policy::{Minterm, Policy};

/// What is known of a tree that was proved: in every care minterm it takes the policy's decision, with memory read from
/// the history (P1); and so does the tree itself, memory fresh, on every path of the environment (P2).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The care minterms.
    pub minterms: usize,
    /// The greedy transitions that were gone through.
    pub transitions: usize,
    /// Whether no path leaves the care minterms.
    pub closed: bool,
    /// Whether the paths are those of recorded transitions; else any that the history window allows.
    pub recorded: bool,
    /// What was explored.
    pub explored: Explored,
}

/// Why a tree is not equal to a policy.
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

/// Proves that a tree takes the decisions of a policy in all of its rows, along its greedy transitions where it has
/// any, else along every path that the history window allows.
///
/// # Errors
/// The counterexample.
pub fn prove(root: &Node, policy: &Policy) -> Result<Proof, Refuted> {
    if policy.rows.is_empty() {
        return Err(Refuted::Empty);
    }
    reading(root, policy)?;
    let recorded = !policy.transitions.is_empty();
    let environment = if recorded {
        Environment::Greedy(policy)
    } else {
        Environment::Observed(policy)
    };
    match compare(Side::Tree(root), Side::Policy(policy), environment) {
        Ok(Verdict::Equal(explored)) => Ok(Proof {
            minterms: policy.rows.len(),
            transitions: explored.transitions,
            closed: explored.open == 0,
            recorded,
            explored,
        }),
        Ok(Verdict::Differ(trace)) => Err(Refuted::Parts(trace)),
        Ok(Verdict::Undecided(_)) => Err(Refuted::Undecided),
        Err(unknown) => Err(Refuted::Unknown(unknown.0)),
    }
}

/// P1: the canonical form of the tree decides as the policy in every row.
fn reading(root: &Node, policy: &Policy) -> Result<(), Refuted> {
    let canonical = canonicalise(root).map_err(Refuted::Irreducible)?;
    for row in &policy.rows {
        let mut holds = |atom: Atom| {
            let at = policy.atoms.iter().position(|a| *a == atom);
            at.is_some_and(|i| row.minterm.get(i))
        };
        let tree = canonical.select(&mut holds);
        if tree != Some(row.behavior) {
            return Err(Refuted::Decides {
                minterm: row.minterm.clone(),
                policy: row.behavior,
                tree,
            });
        }
    }
    Ok(())
}
