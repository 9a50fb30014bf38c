//! Trees one change away from another, with what the counts promise of them.

use super::field::Field;
use super::guards::{conjunctions, nodes};
use super::place::{self, Path, Place, edited, paths};
use super::reader::Drive;
use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{and, conjuncts, not, or, with_part};
use crate::tree::prune::{self, Requirement, tidy};
use crate::tree::unit::{guarded, memory, selector};
use rayon::prelude::*;
use rustc_hash::FxHasher;
use std::hash::{Hash, Hasher};

/// A tree one change away.
#[derive(Clone, Debug)]
pub struct Proposal {
    /// The tree.
    pub root: Node,
    /// Its nodes.
    pub nodes: usize,
    /// The gain that the counts promise, less the price of the nodes that it has more.
    pub score: f64,
    /// What it does in the minterms that matter; trees that do the same there have the same number.
    pub does: u64,
}

/// The guards that are tried for each change.
const GUARDS: usize = 2;
/// The most nodes of a tree all of whose smaller neighbours are looked at.
const LARGE: usize = 90;
/// The prices at which larger ones are thinned, in parts of a node's.
const THINNED: [f64; 4] = [1.0 / 3.0, 1.0, 3.0, 10.0];

/// What proposals are made from.
#[derive(Debug)]
pub struct Proposer<'a, 'w> {
    /// The minterms that matter.
    pub field: &'a Field<'w>,
    /// What a new unit may do.
    pub bodies: &'a [Node],
    /// What behaviours require.
    pub requirements: &'a [Requirement],
    /// The return that a node must bring.
    pub price: f64,
}

impl Proposer<'_, '_> {
    /// A new unit in any place, under the guards that pay most.
    pub fn insertions(&self, root: &Node, now: &[Drive]) -> Vec<Proposal> {
        let places = Place::all(root);
        let pairs: Vec<(&Place, &Node)> = places
            .iter()
            .flat_map(|place| self.bodies.iter().map(move |body| (place, body)))
            .collect();
        let found: Vec<Vec<Proposal>> = pairs
            .into_par_iter()
            .map(|(place, body)| {
                let own = Size::of(body).nodes + place.nodes();
                let Some(gains) = self.gains(&place.put(root, body), now) else {
                    return Vec::new();
                };
                let guards = conjunctions(self.field, &gains, self.price).into_iter();
                let guards = guards.filter(|found| found.gain > 0.0).take(GUARDS);
                guards
                    .map(|found| {
                        let unit = guarded(found.guard(self.field), body.clone());
                        let proposal = self.proposal(place.put(root, &unit));
                        Some(Proposal {
                            score: found.gain - self.price * (own + nodes(&found)) as f64,
                            does: number(&self.field.drives(&proposal.root)?),
                            ..proposal
                        })
                    })
                    .collect::<Option<_>>()
                    .unwrap_or_default()
            })
            .collect();
        found.into_iter().flatten().collect()
    }

    /// Guards that let more or less through, and behaviours exchanged.
    pub fn changes(&self, root: &Node, now: &[Drive]) -> Vec<Proposal> {
        let mut found = Vec::new();
        for path in paths(root, &|node| matches!(node, Node::Condition(_))) {
            let Some(Node::Condition(guard)) = place::at(root, &path) else {
                continue;
            };
            let with = |new: Guard| {
                edited(root, &path, &mut |node| {
                    *node = Node::Condition(new.clone())
                })
            };
            // Wider: of what the guard keeps out, a cube more.
            if let Some(gains) = self.gains(&with(Guard::Const(true)), now) {
                for wider in conjunctions(self.field, &gains, self.price)
                    .into_iter()
                    .take(GUARDS)
                {
                    found.push(with(or([guard.clone(), wider.guard(self.field)])));
                }
            }
            // Narrower: of what the guard lets through, a cube less.
            if let Some(gains) = self.gains(&with(Guard::Const(false)), now) {
                for kept in conjunctions(self.field, &gains, self.price)
                    .into_iter()
                    .take(GUARDS)
                {
                    found.extend(kept.literals.iter().filter_map(|(bit, value)| {
                        let atom = Guard::Atom(*self.field.atoms.get(*bit)?);
                        let literal = if *value { not(atom) } else { atom };
                        Some(with(and([guard.clone(), literal])))
                    }));
                }
            }
            // Other literals instead.
            for bit in self.field.atoms {
                let atom = Guard::Atom(*bit);
                let parts = conjuncts(guard).len().max(1);
                for part in 0..parts {
                    for literal in [atom.clone(), not(atom.clone())] {
                        let new = match guard {
                            Guard::And(_) => with_part(guard, part, Some(literal)),
                            Guard::Or(_) => continue,
                            _ => literal,
                        };
                        found.push(with(new));
                    }
                }
            }
        }
        for path in paths(root, &|node| matches!(node, Node::Behavior(_))) {
            for body in self.bodies {
                found.push(edited(root, &path, &mut |node| *node = body.clone()));
            }
        }
        self.scored(found, root, now)
    }

    /// Units of a selector in another order.
    pub fn moves(&self, root: &Node, now: &[Drive]) -> Vec<Proposal> {
        let mut found = Vec::new();
        for path in paths(root, &is_selector) {
            let count = place::at(root, &path).map_or(0, |node| node.children().len());
            for from in 0..count {
                for to in (0..count).filter(|to| *to != from) {
                    found.push(edited(root, &path, &mut |node| {
                        if let Node::Composite { children, .. } = node {
                            let child = children.remove(from);
                            children.insert(to, child);
                        }
                    }));
                }
            }
        }
        self.scored(found, root, now)
    }

    /// Smaller trees.
    pub fn prunings(&self, root: &Node, now: &[Drive]) -> Vec<Proposal> {
        let found: Vec<Node> = if Size::of(root).nodes <= LARGE {
            let candidates = prune::candidates(root, self.requirements).into_iter();
            candidates.map(|candidate| candidate.root).collect()
        } else {
            let prices = THINNED.into_par_iter();
            let thinned = prices.filter_map(|factor| self.thinned(root, self.price * factor));
            let mut found: Vec<Node> = thinned.collect();
            found.extend(parts(root).iter().map(|part| part.left_out(root)));
            found
        };
        self.scored(found, root, now)
    }

    /// The tree without all those parts that are worth less than their price, one after another; `None` if there is none.
    fn thinned(&self, root: &Node, price: f64) -> Option<Node> {
        let mut tree = root.clone();
        let mut now = self.field.drives(&tree)?;
        let mut at = 0;
        while let Some(part) = parts(&tree).get(at) {
            let less = tidy(part.left_out(&tree));
            let saved = Size::of(&tree).nodes.saturating_sub(Size::of(&less).nodes);
            let drives = self.field.drives(&less)?;
            if saved > 0 && self.field.gain(&drives, &now) + price * saved as f64 > 0.0 {
                (tree, now) = (less, drives);
            } else {
                at += 1;
            }
        }
        (tree != *root).then_some(tree)
    }

    /// Behaviours joined to nodes with memory. The counts cannot tell what memory is worth.
    pub fn memories(&self, root: &Node) -> Vec<Proposal> {
        let mut found = Vec::new();
        for path in paths(root, &|node| matches!(node, Node::Behavior(_))) {
            for other in self.field.choices {
                let other = Node::Behavior(*other);
                if place::at(root, &path) == Some(&other) {
                    continue;
                }
                for kind in [Composite::Sequence, Composite::Selector] {
                    found.push(edited(root, &path, &mut |node| {
                        *node = memory(kind, [node.clone(), other.clone()]);
                    }));
                    found.push(edited(root, &path, &mut |node| {
                        *node = memory(kind, [other.clone(), node.clone()]);
                    }));
                }
            }
        }
        let remembers = |node: &Node| matches!(node, Node::Composite { memory, .. } if *memory);
        for path in paths(root, &remembers) {
            found.push(edited(root, &path, &mut |node| {
                if let Node::Composite { memory, .. } = node {
                    *memory = false;
                }
            }));
            for other in self.field.choices {
                found.push(edited(root, &path, &mut |node| {
                    if let Node::Composite { children, .. } = node {
                        children.push(Node::Behavior(*other));
                    }
                }));
            }
        }
        found.into_iter().map(|root| self.proposal(root)).collect()
    }

    /// Behaviours that fail at once now and then, with another to do meanwhile. The counts cannot tell what that is worth: in a minterm in
    /// which one fails at times, they take it for one that works when it is tried again.
    pub fn falls(&self, root: &Node, openers: &[Vec<usize>]) -> Vec<Proposal> {
        let mut found = Vec::new();
        for path in paths(root, &|node| matches!(node, Node::Behavior(_))) {
            let Some(leaf @ Node::Behavior(id)) = place::at(root, &path) else {
                continue;
            };
            let choice = self.field.choices.iter().position(|choice| choice == id);
            let others = choice.and_then(|choice| openers.get(choice));
            for other in others.into_iter().flatten() {
                let Some(other) = self.field.choices.get(*other) else {
                    continue;
                };
                let unit = selector([leaf.clone(), Node::Behavior(*other)]);
                found.push(edited(root, &path, &mut |node| *node = unit.clone()));
            }
        }
        found.into_iter().map(|root| self.proposal(root)).collect()
    }

    /// The gain of a tree in each minterm; `None` if there is none anywhere.
    fn gains(&self, root: &Node, now: &[Drive]) -> Option<Vec<f64>> {
        let drives = self.field.drives(root)?;
        let spots = self.field.spots.iter().zip(drives.iter().zip(now));
        let gains = spots.map(|(spot, (new, old))| match new == old {
            true => 0.0,
            false => spot.weight * (spot.worth(*new) - spot.worth(*old)),
        });
        let gains: Vec<f64> = gains.collect();
        gains.iter().any(|gain| *gain != 0.0).then_some(gains)
    }

    fn scored(&self, found: Vec<Node>, root: &Node, now: &[Drive]) -> Vec<Proposal> {
        let nodes = Size::of(root).nodes as f64;
        let scored: Vec<Option<Proposal>> = found
            .into_par_iter()
            .map(|new| {
                let proposal = self.proposal(new);
                let drives = self.field.drives(&proposal.root)?;
                let more = proposal.nodes as f64 - nodes;
                Some(Proposal {
                    score: self.field.gain(&drives, now) - self.price * more,
                    does: number(&drives),
                    ..proposal
                })
            })
            .collect();
        scored.into_iter().flatten().collect()
    }

    fn proposal(&self, root: Node) -> Proposal {
        let root = tidy(root);
        Proposal {
            nodes: Size::of(&root).nodes,
            root,
            score: 0.0,
            does: 0,
        }
    }
}

/// A number for what a tree does.
pub fn number(drives: &[Drive]) -> u64 {
    let mut hasher = FxHasher::default();
    drives.hash(&mut hasher);
    hasher.finish()
}

fn is_selector(node: &Node) -> bool {
    matches!(
        node,
        Node::Composite {
            kind: Composite::Selector,
            memory: false,
            ..
        }
    )
}

/// A part of a tree that it can do without.
enum Part {
    /// A child of a selector, or the guard of a sequence.
    Child(Path, usize),
    /// A literal of a guard.
    Literal(Path, usize),
}

/// The parts of a tree, from its end on.
fn parts(root: &Node) -> Vec<Part> {
    let mut found = Vec::new();
    for path in paths(root, &|_| true) {
        match place::at(root, &path) {
            Some(Node::Condition(guard @ Guard::And(_))) => {
                let literals = 0..conjuncts(guard).len();
                found.extend(literals.map(|at| Part::Literal(path.clone(), at)));
            }
            Some(
                node @ Node::Composite {
                    memory: false,
                    children,
                    ..
                },
            ) => {
                let every = is_selector(node);
                let children = children.iter().enumerate();
                let children = children.filter(|(_, it)| every || matches!(it, Node::Condition(_)));
                found.extend(children.map(|(at, _)| Part::Child(path.clone(), at)));
            }
            _ => {}
        }
    }
    found.reverse();
    found
}

impl Part {
    fn left_out(&self, root: &Node) -> Node {
        let (Self::Child(path, at) | Self::Literal(path, at)) = self;
        edited(root, path, &mut |node| match node {
            Node::Composite { children, .. } => {
                children.remove(*at);
            }
            Node::Condition(guard) => *guard = with_part(guard, *at, None),
            _ => {}
        })
    }
}
