//! Short names for nodes and guards.

use btc::ir::Id;
use btc::ir::tree::{Atom, Composite, Decorator, Guard, Node};
use btc::tree::decanonicalise::{Care, Method, Options};

/// A behaviour.
pub(crate) fn leaf(behavior: usize) -> Node {
    Node::Behavior(Id::new(behavior))
}

/// A predicate.
pub(crate) fn p(predicate: usize) -> Guard {
    Guard::Atom(Atom::Predicate(Id::new(predicate)))
}

/// `done(b)`
pub(crate) fn done(behavior: usize) -> Guard {
    Guard::Atom(Atom::Done(Id::new(behavior)))
}

/// `failed(b)`
pub(crate) fn failed(behavior: usize) -> Guard {
    Guard::Atom(Atom::Failed(Id::new(behavior)))
}

pub(crate) fn not(guard: Guard) -> Guard {
    Guard::Not(Box::new(guard))
}

pub(crate) fn condition(guard: Guard) -> Node {
    Node::Condition(guard)
}

/// `guard => node`
pub(crate) fn when(guard: Guard, node: Node) -> Node {
    sequence(vec![condition(guard), node])
}

pub(crate) fn selector(children: Vec<Node>) -> Node {
    composite(Composite::Selector, false, children)
}

pub(crate) fn sequence(children: Vec<Node>) -> Node {
    composite(Composite::Sequence, false, children)
}

pub(crate) fn memory_selector(children: Vec<Node>) -> Node {
    composite(Composite::Selector, true, children)
}

pub(crate) fn memory_sequence(children: Vec<Node>) -> Node {
    composite(Composite::Sequence, true, children)
}

pub(crate) fn composite(kind: Composite, memory: bool, children: Vec<Node>) -> Node {
    Node::Composite {
        kind,
        memory,
        children,
    }
}

pub(crate) fn decorated(kind: Decorator, node: Node) -> Node {
    Node::Decorator {
        kind,
        child: Box::new(node),
    }
}

pub(crate) fn parallel(successes: u32, children: Vec<Node>) -> Node {
    Node::Parallel {
        successes,
        children,
    }
}

/// This method on this care set, the rest as usual.
pub(crate) fn asked(method: Method, care: Care) -> Options {
    Options {
        method,
        care,
        ..Options::default()
    }
}
