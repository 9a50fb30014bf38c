//! Guards that name the smaller part of a choice: of values of which every row has one, `is none of these fourteen` is
//! `is one of the other six`.

use super::problem::Problem;
use crate::ir::tree::{Atom, Guard, Node};
use crate::tree::Size;
use crate::tree::guard::{and, not, or};

/// The fewest literals of a guard that are looked at together.
const FEWEST: usize = 3;
/// The most nodes of a tree whose guards are.
const LARGE: usize = 2000;

/// The tree with such guards, whatever comes of it; `None` if there are none.
pub(super) fn complemented(problem: &Problem, root: &Node) -> Option<Node> {
    if problem.wide || Size::of(root).nodes > LARGE {
        return None;
    }
    let new = with(root, &|guard| shorter(problem, guard.clone()));
    (new != *root).then_some(new)
}

/// The tree with each guard changed.
fn with(node: &Node, change: &impl Fn(&Guard) -> Guard) -> Node {
    let mut node = node.clone();
    match &mut node {
        Node::Condition(guard) => *guard = change(guard),
        Node::Behavior(_) => {}
        Node::Composite { children, .. } | Node::Parallel { children, .. } => {
            for child in children {
                *child = with(child, change);
            }
        }
        Node::Decorator { child, .. } => **child = with(child, change),
    }
    node
}

fn shorter(problem: &Problem, guard: Guard) -> Guard {
    match guard {
        Guard::And(parts) => joined(problem, parts),
        // Where one of some values is asked for, none of them is the other side.
        Guard::Or(parts) => not(joined(problem, parts.into_iter().map(not).collect())),
        guard => guard,
    }
}

/// The conjunction of these, with the rest of the values in place of more of them that are excluded.
fn joined(problem: &Problem, parts: Vec<Guard>) -> Guard {
    let parts = parts.into_iter().map(|part| shorter(problem, part));
    let parts: Vec<Guard> = parts.collect();
    let excluded = |part: &Guard| match part {
        Guard::Not(inner) => match **inner {
            Guard::Atom(atom) => Some(atom),
            _ => None,
        },
        _ => None,
    };
    let all: Vec<Atom> = parts.iter().filter_map(excluded).collect();
    let Some((group, rest)) = rest(problem, &all) else {
        return and(parts);
    };
    let one_of = or(rest.into_iter().map(Guard::Atom));
    let stays = |part: &Guard| excluded(part).is_none_or(|atom| !group.contains(&atom));
    let parts = parts.into_iter().filter(stays);
    and(std::iter::once(one_of).chain(parts))
}

/// Of these atoms those no two of which hold in a row, with the fewer others that hold where none of them does.
fn rest(problem: &Problem, atoms: &[Atom]) -> Option<(Vec<Atom>, Vec<Atom>)> {
    if atoms.len() < FEWEST {
        return None;
    }
    let (mut union, mut group, mut rest) = (problem.none(), Vec::new(), Vec::new());
    for atom in atoms {
        let rows = problem.column(*atom)?;
        if union.is_disjoint(rows) {
            union.unite(rows);
            group.push(*atom);
        }
    }
    // Those of one input stand together.
    let known = &problem.policy.atoms;
    let place = |atom: &&Atom| known.iter().position(|known| known == *atom);
    let near = group.first().and_then(|atom| place(&atom))?;
    let mut others: Vec<(usize, &Atom)> = known.iter().enumerate().collect();
    others.sort_by_key(|(at, _)| at.abs_diff(near));
    let whole = problem.all();
    for (_, atom) in others {
        let rows = problem.column(*atom)?;
        if !group.contains(atom) && !rows.is_empty() && union.is_disjoint(rows) {
            union.unite(rows);
            rest.push(atom);
        }
        if rest.len() >= group.len() {
            return None;
        }
        if union == whole {
            // Named in the order in which they are declared.
            rest.sort_by_key(place);
            let rest: Vec<Atom> = rest.into_iter().copied().collect();
            return (!rest.is_empty()).then_some((group, rest));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::{Problem, complemented};
    use crate::ir::Id;
    use crate::ir::tree::{Atom, Guard, Node};
    use crate::policy::{Minterm, Policy, Row};
    use crate::tree::guard::{and, not, or};
    use crate::tree::unit::{guarded, selector};

    /// Rows that have one of six values each, with another atom.
    fn table() -> Policy {
        let rows = (0..12_usize).map(|row| Row {
            minterm: Minterm::new((0..7).map(|atom| match atom {
                6 => row >= 6,
                value => row % 6 == value,
            })),
            free: None,
            behavior: Id::new(usize::from(row % 6 < 2 && row >= 6)),
            visits: 0,
            values: Vec::new(),
        });
        let mut rows: Vec<Row> = rows.collect();
        rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
        Policy {
            atoms: (0..7).map(|i| Atom::Predicate(Id::new(i))).collect(),
            behaviors: (0..2).map(Id::new).collect(),
            rows,
            ..Policy::default()
        }
    }

    #[test]
    fn the_smaller_part_of_a_choice_is_named() {
        let atom = |at: usize| Guard::Atom(Atom::Predicate(Id::new(at)));
        let policy = table();
        let problem = Problem::new(&policy);
        let tree = |guard: Guard| {
            let first = guarded(guard, Node::Behavior(Id::new(1)));
            selector([first, Node::Behavior(Id::new(0))])
        };
        let none_of = and((2..6).map(|at| not(atom(at))).chain([atom(6)]));
        let one_of = and([or([atom(0), atom(1)]), atom(6)]);
        assert!(problem.proves(&tree(none_of.clone())));
        let found = complemented(&problem, &tree(none_of)).unwrap();
        assert_eq!(found, tree(one_of.clone()));
        assert!(problem.proves(&found));
        assert_eq!(complemented(&problem, &tree(one_of)), None);
        // The other way round.
        let found = complemented(&problem, &tree(or((2..6).map(atom)))).unwrap();
        assert_eq!(found, tree(and([not(atom(0)), not(atom(1))])));
    }
}
