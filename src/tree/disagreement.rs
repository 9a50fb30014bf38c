//! The rows of a table that a tree decides otherwise.

use super::atoms::atoms;
use super::prove::{Proof, Refuted, prove};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::policy::{Minterm, Policy};

/// A minterm that a tree decides otherwise than its table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Disagreement {
    /// The minterm.
    pub minterm: Minterm,
    /// The decision of the table.
    pub table: Id<Behavior>,
    /// The decision of the tree; `None` if it selects nothing.
    pub tree: Option<Id<Behavior>>,
}

/// A tree compared with a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Compared {
    /// The tree takes the decisions of the table.
    Equal(Proof),
    /// It decides these rows otherwise, one minterm each.
    Differs(Vec<Disagreement>),
}

/// Compares a tree with a table, and stops at `most` rows that it decides otherwise.
///
/// # Errors
/// The tree asks what the table does not observe, has no canonical form, or parts from the table along a path and not in
/// a row; or there is too much to explore.
pub fn compare(root: &Node, policy: &Policy, most: usize) -> Result<Compared, Refuted> {
    let unknown = atoms(root)
        .into_iter()
        .find(|atom| !policy.atoms.contains(atom));
    if let Some(atom) = unknown {
        return Err(Refuted::Unknown(atom));
    }
    let mut policy = policy.clone();
    let mut found = Vec::new();
    while found.len() < most {
        match prove(root, &policy) {
            Ok(proof) if found.is_empty() => return Ok(Compared::Equal(proof)),
            Err(Refuted::Decides {
                minterm,
                policy: table,
                tree,
            }) => {
                policy.rows.retain(|row| !row.speaks_of(&minterm));
                found.push(Disagreement {
                    minterm,
                    table,
                    tree,
                });
            }
            Err(refuted @ (Refuted::Unknown(_) | Refuted::Irreducible(_))) => return Err(refuted),
            Err(refuted @ (Refuted::Parts(_) | Refuted::Undecided)) if found.is_empty() => {
                return Err(refuted);
            }
            // What is left of the table is decided alike, or parts along a path only.
            _ => break,
        }
    }
    Ok(Compared::Differs(found))
}
