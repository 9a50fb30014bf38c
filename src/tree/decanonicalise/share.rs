//! Literals that neighbouring units have in common, once before a selector of them.

use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{and, atom, conjuncts};
use crate::tree::unit::{self, Unit, guarded, selector};

/// The tree with shared literals taken out of the guards of neighbours wherever that makes it smaller: a unit whose
/// guard fails lets the next one try, and so does a group of units none of whose guards hold.
pub(super) fn shared(node: Node) -> Node {
    match node {
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let children = children.into_iter().map(shared).collect();
            match (kind, memory) {
                (Composite::Selector, false) => grouped(children),
                _ => Node::Composite {
                    kind,
                    memory,
                    children,
                },
            }
        }
        node => node,
    }
}

/// The selector of these, the best group made until none helps.
fn grouped(mut children: Vec<Node>) -> Node {
    let mut size = Size::of(&selector(children.clone()));
    loop {
        let mut best: Option<(Size, Vec<Node>)> = None;
        for start in 0..children.len() {
            for literal in children.get(start).map(literals).unwrap_or_default() {
                let run = children.iter().skip(start);
                let run = run
                    .take_while(|child| literals(child).contains(&literal))
                    .count();
                for end in start + 2..=start + run {
                    let candidate = group(&children, start, end, &literal);
                    let smaller = Size::of(&selector(candidate.clone()));
                    if smaller < best.as_ref().map_or(size, |(size, _)| *size) {
                        best = Some((smaller, candidate));
                    }
                }
            }
        }
        match best {
            Some(found) => (size, children) = found,
            None => return selector(children),
        }
    }
}

/// The children with those from `start` to `end` in one group behind a literal that all of them have.
fn group(children: &[Node], start: usize, end: usize, literal: &Guard) -> Vec<Node> {
    let inside = children.iter().take(end).skip(start);
    let inside = grouped(inside.map(|child| without(child, literal)).collect());
    let before = children.iter().take(start).cloned();
    let after = children.iter().skip(end).cloned();
    before
        .chain([guarded(literal.clone(), inside)])
        .chain(after)
        .collect()
}

/// The literals without which a unit lets nothing through.
fn literals(node: &Node) -> Vec<Guard> {
    let parts = unit::parts(node).map_or(&[][..], |(guard, _)| conjuncts(guard));
    let literals = parts.iter().filter(|part| atom(part).is_some());
    literals.cloned().collect()
}

/// The unit without one of its literals.
fn without(node: &Node, literal: &Guard) -> Node {
    let unit = Unit::of(node);
    let rest = conjuncts(&unit.guard).iter();
    let rest = and(rest.filter(|part| *part != literal).cloned());
    guarded(rest, unit.body)
}
