//! Trees for Graphviz and as JSON.

use super::files::program;
use super::small_delivery::figure_8;
use crate::snapshot::check;
use btc::emit::{dot, json};
use btc::ir::Id;
use btc::ir::tree::{Atom, Composite, Decorator, Guard, Node, Tree};

/// Every node kind, guards of every shape.
fn everything() -> Node {
    let leaf = |b| Node::Behavior(Id::new(b));
    let atom = |p| Guard::Atom(Atom::Predicate(Id::new(p)));
    let not = |guard| Guard::Not(Box::new(guard));
    let when = |guard, node| Node::Composite {
        kind: Composite::Sequence,
        memory: false,
        children: vec![Node::Condition(guard), node],
    };
    let decorated = |kind, node| Node::Decorator {
        kind,
        child: Box::new(node),
    };
    let either = Guard::Or(vec![
        Guard::And(vec![atom(0), not(atom(1))]),
        Guard::Atom(Atom::Done(Id::new(2))),
    ]);
    Node::Composite {
        kind: Composite::Selector,
        memory: true,
        children: vec![
            when(Guard::And(vec![either, atom(2)]), leaf(0)),
            Node::Parallel {
                successes: 2,
                children: vec![
                    Node::Condition(not(Guard::And(vec![atom(0), atom(3)]))),
                    decorated(Decorator::Timeout(50), leaf(4)),
                    decorated(Decorator::Invert, Node::Condition(Guard::Const(true))),
                ],
            },
            decorated(Decorator::Retry(3), decorated(Decorator::Succeed, leaf(5))),
        ],
    }
}

#[test]
fn trees_are_drawn() {
    let drawn = |name: &str, root: &Node| {
        check(
            &format!("tree.{name}.dot"),
            &dot::tree(&program(), &Tree::plain(name.into(), root.clone())),
        )
    };
    drawn("figure_8", &figure_8());
    drawn("every_node", &everything());
}

#[test]
fn trees_are_json() {
    let shown = |name: &str, root: &Node| {
        let tree = json::tree(&program(), &Tree::plain(name.into(), root.clone()));
        let tree: serde_json::Value = serde_json::from_str(&tree).unwrap();
        let text = format!("{:#}", tree["root"]);
        check(&format!("tree.{name}.json"), &text);
    };
    shown("figure_8", &figure_8());
    shown("every_node", &everything());
}
