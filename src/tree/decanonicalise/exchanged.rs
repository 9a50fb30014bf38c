//! The sides of a choice exchanged: `G => X, Y` says the same as `not G => Y, X`, and one of the two may be smaller, by itself or
//! since its neighbour now does the same. So may be what another exchange then finds.

use super::problem::Problem;
use super::share::shared;
use crate::ir::tree::{Composite, Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{and, not};
use crate::tree::prune::with_child;
use crate::tree::unit::{Unit, selector};
use std::collections::BTreeSet;

/// The most nodes of a tree whose sides are exchanged.
const LARGE: usize = 200;
/// The most trees from which exchanges are tried, and the most that are kept.
const TRIED: usize = 48;
const KEPT: usize = 1000;

/// A smaller tree with sides exchanged, whatever comes of it; `None` if none is found. Where transitions were recorded the order of
/// the units is kept.
pub(super) fn exchanged(problem: &Problem, root: &Node) -> Option<Node> {
    let first = Size::of(root);
    if !problem.policy.transitions.is_empty() || first.nodes > LARGE {
        return None;
    }
    let mut seen: Vec<(Size, Node)> = vec![(first, root.clone())];
    let mut least = first;
    // The smallest first, then the first found; none larger than the smallest by more than a node.
    let mut open = BTreeSet::from([(first, 0)]);
    for _ in 0..TRIED {
        let next = open.pop_first();
        let Some((_, at)) = next.filter(|(size, _)| size.nodes <= least.nodes + 1) else {
            break;
        };
        let Some((_, tree)) = seen.get(at).cloned() else {
            break;
        };
        let exchanged = exchanges(&tree).into_iter();
        for new in exchanged.flat_map(|new| [shared(new.clone()), new]) {
            let size = Size::of(&new);
            let is_known = || seen.iter().any(|(_, known)| *known == new);
            if size.nodes > least.nodes + 1 || seen.len() >= KEPT || is_known() {
                continue;
            }
            least = least.min(size);
            open.insert((size, seen.len()));
            seen.push((size, new));
        }
    }
    let best = seen.into_iter().min_by_key(|(size, _)| *size)?;
    (best.0 < first).then_some(best.1)
}

/// The trees with the sides of one choice exchanged.
fn exchanges(node: &Node) -> Vec<Node> {
    let mut found = Vec::new();
    if let Node::Composite {
        kind: Composite::Selector,
        memory: false,
        children,
    } = node
    {
        found.extend((0..children.len()).filter_map(|at| exchanged_at(children, at)));
    }
    for (at, child) in node.children().iter().enumerate() {
        found.extend(exchanges(child).into_iter().map(|new| with(node, at, new)));
    }
    found
}

/// A selector with what a child guards behind all that follows it.
fn exchanged_at(children: &[Node], at: usize) -> Option<Node> {
    let (before, rest) = children.split_at_checked(at)?;
    let (choice, rest) = rest.split_first()?;
    let choice = Unit::of(choice);
    // What lets rows through to nothing cannot stand first.
    let last = Unit::of(rest.last()?);
    let always = Guard::Const(true);
    if choice.guard == always || last.guard != always {
        return None;
    }
    let rest = Unit::of(&selector(rest.iter().cloned()));
    let first = rest.under(and([not(choice.guard.clone()), rest.guard.clone()]));
    let all = before.iter().cloned().chain([first.node(), choice.body]);
    Some(selector(all))
}

/// A node with another child in the place of one; a selector in a selector is a part of it.
fn with(node: &Node, at: usize, new: Node) -> Node {
    match with_child(node, at, new) {
        Node::Composite {
            kind: Composite::Selector,
            memory: false,
            children,
        } => selector(children),
        node => node,
    }
}

#[cfg(test)]
mod tests {
    use super::exchanged;
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::decanonicalise::problem::Problem;
    use crate::tree::guard::{and, not, or};
    use crate::tree::unit::{guarded, selector};
    use crate::tree::{Runner, Size};

    fn atom(at: usize) -> Guard {
        Guard::Atom(Atom::Predicate(Id::new(at)))
    }

    fn leaf(at: usize) -> Node {
        Node::Behavior(Id::new(at))
    }

    /// The decisions of a tree in all minterms of five atoms.
    fn table(root: &Node) -> Policy {
        let atoms: Vec<Atom> = (0..5).map(|i| Atom::Predicate(Id::new(i))).collect();
        let mut runner = Runner::new(root, &atoms).unwrap();
        let rows = (0..32_u64).map(|key| Row {
            minterm: Minterm::new((0..5).map(|atom| key >> atom & 1 == 1)),
            free: None,
            behavior: runner.select(&[key]).unwrap(),
            visits: 0,
            values: Vec::new(),
        });
        let mut rows: Vec<Row> = rows.collect();
        rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
        Policy {
            atoms,
            behaviors: (0..4).map(Id::new).collect(),
            rows,
            ..Policy::default()
        }
    }

    #[test]
    fn the_smaller_side_stands_first() {
        let inner = |guard: Guard, one, other| selector([guarded(guard, leaf(one)), leaf(other)]);
        let both = or([and([atom(0), atom(1)]), and([atom(2), atom(3)])]);
        let root = selector([
            guarded(both, inner(not(atom(4)), 0, 1)),
            guarded(atom(4), leaf(2)),
            leaf(3),
        ]);
        let policy = table(&root);
        let problem = Problem::new(&policy);
        let found = exchanged(&problem, &root).unwrap();
        assert_eq!(Size::of(&root).nodes, 18);
        assert_eq!(Size::of(&found).nodes, 17);
        assert!(problem.proves(&found));
        assert_eq!(exchanged(&problem, &found), None);
    }

    /// What stands behind an exchange may do the same as what stands before it.
    #[test]
    fn neighbours_that_do_the_same_are_one() {
        let choice = || selector([guarded(atom(4), leaf(0)), leaf(1)]);
        let root = selector([
            guarded(and([atom(0), atom(1)]), choice()),
            guarded(and([atom(2), atom(3)]), leaf(2)),
            guarded(atom(4), leaf(0)),
            leaf(1),
        ]);
        let policy = table(&root);
        let problem = Problem::new(&policy);
        let found = exchanged(&problem, &root).unwrap();
        assert!(Size::of(&found) < Size::of(&root));
        assert!(problem.proves(&found));
    }
}
