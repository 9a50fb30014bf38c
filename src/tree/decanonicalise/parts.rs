//! A tree without memory as a list with groups.

use super::problem::Problem;
use crate::ir::tree::{Guard, Node};
use crate::logic::covering::{Grouped, Part, Rule};
use crate::logic::{Cube, Literal};
use crate::tree::guard::atom;
use crate::tree::unit::units;

/// The most cubes of a guard.
const CUBES: usize = 64;

/// A tree as a list with groups; `None` where that is not possible.
pub(super) fn listed(problem: &Problem, tree: &Node) -> Option<Grouped> {
    match problem.wide {
        true => None,
        false => Lists { problem }.list(tree),
    }
}

/// What lists are made of.
struct Lists<'a, 'p> {
    problem: &'a Problem<'p>,
}

impl Lists<'_, '_> {
    /// A tree as a list; `None` where that is not possible.
    fn list(&self, tree: &Node) -> Option<Grouped> {
        let mut parts = Vec::new();
        if let Some(last) = self.parts(&Cube::default(), tree, &mut parts)? {
            return Some(Grouped { parts, last });
        }
        // The last unit decides all that is left.
        let last = match parts.pop()? {
            Part::Rule(rule) => rule.class,
            Part::Group(_, inner) => {
                parts.extend(inner.parts);
                inner.last
            }
        };
        Some(Grouped { parts, last })
    }

    /// The parts that decide as a body behind a cube does, and the class of what these leave; none if that is for what follows the body.
    fn parts(&self, above: &Cube, body: &Node, parts: &mut Vec<Part>) -> Option<Option<usize>> {
        let Some(units) = units(body) else {
            return Some(Some(self.class(body)?));
        };
        let mut last = None;
        for unit in &units {
            let cubes = self.cubes(&unit.guard)?;
            for cube in &cubes {
                if cube.literals().is_empty()
                    && units.last() == Some(unit)
                    && let Some(class) = self.class(&unit.body)
                {
                    last = Some(class);
                    continue;
                }
                let literals = above.literals().iter().chain(cube.literals());
                let behind = Cube::new(literals.copied());
                let mut inner = Vec::new();
                match (
                    self.parts(&Cube::default(), &unit.body, &mut inner)?,
                    &unit.body,
                ) {
                    (Some(class), Node::Behavior(_)) => parts.push(Part::Rule(Rule {
                        class,
                        cube: behind,
                    })),
                    (Some(last), _) => {
                        parts.push(Part::Group(behind, Grouped { parts: inner, last }))
                    }
                    (None, body) => {
                        if self.parts(&behind, body, parts)?.is_some() {
                            return None;
                        }
                    }
                }
            }
        }
        Some(last)
    }

    fn class(&self, node: &Node) -> Option<usize> {
        match node {
            Node::Behavior(behavior) => self.problem.on.iter().position(|(own, _)| own == behavior),
            _ => None,
        }
    }

    /// The cubes of which a guard is the disjunction; `None` for too many.
    fn cubes(&self, guard: &Guard) -> Option<Vec<Cube>> {
        let literal = |guard: &Guard| {
            let atom = atom(guard)?;
            let number = self
                .problem
                .policy
                .atoms
                .iter()
                .position(|own| *own == atom)?;
            Some(Cube::new([Literal {
                atom: number,
                positive: !matches!(guard, Guard::Not(_)),
            }]))
        };
        let cubes = match guard {
            Guard::Const(true) => vec![Cube::default()],
            Guard::Const(false) => Vec::new(),
            Guard::Atom(_) | Guard::Not(_) => vec![literal(guard)?],
            Guard::Or(parts) => {
                let parts: Option<Vec<Vec<Cube>>> =
                    parts.iter().map(|part| self.cubes(part)).collect();
                parts?.concat()
            }
            Guard::And(parts) => {
                let mut all = vec![Cube::default()];
                for part in parts {
                    let with = self.cubes(part)?;
                    let both = all.iter().flat_map(|one| {
                        with.iter().map(|other| {
                            Cube::new(one.literals().iter().chain(other.literals()).copied())
                        })
                    });
                    all = both.collect();
                    if all.len() > CUBES {
                        return None;
                    }
                }
                all
            }
        };
        (cubes.len() <= CUBES).then_some(cubes)
    }
}
