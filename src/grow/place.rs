//! Places in a tree where something can be put.

use crate::ir::tree::{Composite, Node};
use crate::tree::unit::parts;

/// The way from the root to a node, by the numbers of the children.
pub type Path = Vec<usize>;

/// A place for a new unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Place {
    /// Among the children of the selector here, before this one or behind the last.
    Among(Path, usize),
    /// Before the node here, in a selector of the two.
    Before(Path),
}

impl Place {
    /// The places of a tree, from the left.
    pub fn all(root: &Node) -> Vec<Self> {
        let mut found = Vec::new();
        collect(root, &mut Path::new(), false, &mut found);
        found
    }

    /// The tree with a unit in this place.
    pub fn put(&self, root: &Node, unit: &Node) -> Node {
        match self {
            Place::Among(path, at) => edited(root, path, &mut |node| {
                if let Node::Composite { children, .. } = node {
                    children.insert((*at).min(children.len()), unit.clone());
                }
            }),
            Place::Before(path) => edited(root, path, &mut |node| {
                let children = vec![unit.clone(), node.clone()];
                *node = Node::Composite {
                    kind: Composite::Selector,
                    memory: false,
                    children,
                };
            }),
        }
    }

    /// The nodes that a unit costs here beside its own.
    pub fn nodes(&self) -> usize {
        usize::from(matches!(self, Place::Before(_)))
    }
}

fn collect(node: &Node, path: &mut Path, listed: bool, found: &mut Vec<Place>) {
    match node {
        Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children,
        } => {
            for (at, child) in children.iter().enumerate() {
                found.push(Place::Among(path.clone(), at));
                path.push(at);
                collect(child, path, true, found);
                path.pop();
            }
            found.push(Place::Among(path.clone(), children.len()));
        }
        Node::Condition(_) => {}
        node => {
            if !listed {
                found.push(Place::Before(path.clone()));
            }
            if let Some((_, body)) = parts(node) {
                path.push(1);
                collect(body, path, false, found);
                path.pop();
            }
        }
    }
}

/// The paths of all nodes for which `wanted` holds, from the left.
pub fn paths(root: &Node, wanted: &impl Fn(&Node) -> bool) -> Vec<Path> {
    fn go(node: &Node, path: &mut Path, wanted: &impl Fn(&Node) -> bool, found: &mut Vec<Path>) {
        if wanted(node) {
            found.push(path.clone());
        }
        for (at, child) in node.children().iter().enumerate() {
            path.push(at);
            go(child, path, wanted, found);
            path.pop();
        }
    }
    let mut found = Vec::new();
    go(root, &mut Path::new(), wanted, &mut found);
    found
}

/// The node at the end of a path.
pub fn at<'n>(root: &'n Node, path: &[usize]) -> Option<&'n Node> {
    path.iter()
        .try_fold(root, |node, at| node.children().get(*at))
}

/// The tree with the node at the end of a path changed.
pub fn edited(root: &Node, path: &[usize], change: &mut impl FnMut(&mut Node)) -> Node {
    let mut root = root.clone();
    let mut node = Some(&mut root);
    for at in path {
        node = match node {
            Some(Node::Composite { children, .. } | Node::Parallel { children, .. }) => {
                children.get_mut(*at)
            }
            Some(Node::Decorator { child, .. }) => Some(child.as_mut()),
            _ => None,
        };
    }
    if let Some(node) = node {
        change(node);
    }
    root
}
