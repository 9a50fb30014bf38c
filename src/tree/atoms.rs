//! What a tree mentions.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use std::collections::BTreeSet;

/// The atoms that the guards of a tree ask.
pub fn atoms(node: &Node) -> BTreeSet<Atom> {
    let mut found = BTreeSet::new();
    node.visit_atoms(&mut |atom| {
        found.insert(atom);
    });
    found
}

/// The behaviours that stand in a tree.
pub fn behaviors(node: &Node) -> BTreeSet<Id<Behavior>> {
    let mut found = BTreeSet::new();
    node.visit_behaviors(&mut |behavior| {
        found.insert(behavior);
    });
    found
}
