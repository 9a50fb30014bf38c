//! The search for a smaller tree than Algorithm 1 finds.
//!
//! Which memory nodes to use is tried out first, in a few configurations; for each, the selector over its subunits is
//! built from the left by a beam search over what may stand next. A subunit may stand under its whole guard or under
//! one of its cubes, and a literal may stand over a selector of everything that it lets through. Effort is counted,
//! not timed, so that every machine finds the same tree.

use super::problem::Problem;
use super::subunit::{Pair, Subunit, behaviors, canonical, pairs, replace};
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover, Cube, Literal};
use crate::tree::Size;
use crate::tree::formula::{guarded, selector};
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;
use std::rc::Rc;

/// Configurations of memory nodes that are tried.
const CONFIGURATIONS: usize = 12;
/// Unfinished selectors that are kept after each step, at the root and below.
const BEAM: usize = 8;
const INNER_BEAM: usize = 2;
/// Selectors within selectors.
const DEPTH: usize = 3;
/// Work that the minimisations of one configuration, and of all together, may take; see [`Problem::effort`].
const EFFORT: usize = 150_000;
const EFFORT_IN_ALL: usize = 450_000;
/// Finished trees that are kept for the proof.
const FINALISTS: usize = 24;

/// The smallest tree that was found and proved; `paper` if none is smaller.
pub(super) fn tree(problem: &Problem, paper: &Node) -> Node {
    let size = Size::of(paper);
    let mut found: Vec<(Size, Node)> = Vec::new();
    for subunits in configurations(problem) {
        let mut builder = Builder::new(problem, &subunits);
        let trees = builder.finished().into_iter();
        found.extend(trees.map(|node| (Size::of(&node), node)));
    }
    // Stable: of equal sizes the first found stands first.
    found.sort_by_key(|(size, _)| *size);
    found.dedup_by(|a, b| a.1 == b.1);
    found
        .into_iter()
        .take_while(|(smaller, _)| *smaller < size)
        .take(FINALISTS * CONFIGURATIONS)
        .find(|(_, node)| problem.proves(node))
        .map_or_else(|| paper.clone(), |(_, node)| node)
}

/// The behaviours alone, and what comes of joining pairs of subunits by memory nodes, as far as each is proved.
fn configurations(problem: &Problem) -> Vec<Vec<Subunit>> {
    let mut found = vec![behaviors(problem)];
    let mut known: BTreeSet<Vec<(Bits, bool)>> = BTreeSet::new();
    let mut next = 0;
    while let Some(subunits) = found.get(next).cloned() {
        for pair in pairs(problem, &subunits) {
            if !pair.entered_properly(problem, &subunits) {
                continue;
            }
            for form in [Pair::joined, Pair::y] {
                let Some(subunit) = form(&pair, problem, &subunits) else {
                    continue;
                };
                let joined = replace(&subunits, pair.first, pair.second, subunit);
                let key = joined.iter().map(|s| (s.rows.clone(), s.guards_itself));
                if found.len() < CONFIGURATIONS
                    && known.insert(key.collect())
                    && problem.proves(&canonical(problem, &joined))
                {
                    found.push(joined);
                }
            }
        }
        next += 1;
    }
    found
}

/// Nodes and literals: the part of a size that adds up.
type Cost = (usize, usize);

fn add(a: Cost, b: Cost) -> Cost {
    (a.0 + b.0, a.1 + b.1)
}

/// A selector that is not finished: its children so far, and the rows that they leave.
#[derive(Clone)]
struct Partial {
    children: Vec<Rc<Node>>,
    cost: Cost,
    left: Bits,
}

impl Partial {
    /// With one more child, which decides these rows.
    fn with(&self, child: Rc<Node>, cost: Cost, rows: &Bits) -> Self {
        let mut children = self.children.clone();
        children.push(child);
        Self {
            children,
            cost: add(self.cost, cost),
            left: self.left.minus(rows),
        }
    }
}

/// A finished selector, without its own node where it has one child.
#[derive(Clone)]
struct Finished {
    children: Vec<Rc<Node>>,
    cost: Cost,
}

impl Finished {
    /// The cost as one node.
    fn whole(&self) -> Cost {
        whole(self.children.len(), self.cost)
    }

    /// The one node.
    fn node(&self) -> Node {
        selector(
            self.children
                .iter()
                .map(|child| (**child).clone())
                .collect(),
        )
    }
}

/// The cost of so many children as one node.
fn whole(children: usize, cost: Cost) -> Cost {
    match children {
        1 => cost,
        _ => add(cost, (1, 0)),
    }
}

/// Builds selectors over the subunits of one configuration.
struct Builder<'a> {
    problem: &'a Problem<'a>,
    subunits: &'a [Subunit],
    limit: usize,
    greedy: FxHashMap<Bits, Rc<Finished>>,
    best: FxHashMap<(Bits, usize), (Rc<Node>, Cost)>,
}

impl<'a> Builder<'a> {
    fn new(problem: &'a Problem<'a>, subunits: &'a [Subunit]) -> Self {
        Self {
            problem,
            subunits,
            limit: (problem.effort.get() + EFFORT).min(EFFORT_IN_ALL),
            greedy: FxHashMap::default(),
            best: FxHashMap::default(),
        }
    }

    /// The best trees for all rows.
    fn finished(&mut self) -> Vec<Node> {
        let all = self.problem.all();
        // What is cheapest next is always known for the whole; all else is tried as far as the effort goes.
        let limit = std::mem::replace(&mut self.limit, usize::MAX);
        self.cheapest_next(&all);
        self.limit = limit;
        self.beam(&all, BEAM, DEPTH)
            .into_iter()
            .map(|finished| finished.node())
            .collect()
    }

    /// The best finished selectors for these rows, cheapest first.
    fn beam(&mut self, rows: &Bits, width: usize, depth: usize) -> Vec<Finished> {
        let mut open = vec![Partial {
            children: Vec::new(),
            cost: (0, 0),
            left: rows.clone(),
        }];
        let mut done: Vec<Finished> = Vec::new();
        while !open.is_empty() {
            let mut next: Vec<(Cost, Partial, Rc<Finished>)> = Vec::new();
            let mut seen: BTreeSet<(Bits, Cost)> = BTreeSet::new();
            for partial in &open {
                for step in self.steps(partial, depth) {
                    if seen.insert((step.left.clone(), step.cost)) {
                        let Some(rest) = self.cheapest_next(&step.left) else {
                            continue;
                        };
                        let children = step.children.len() + rest.children.len();
                        next.push((whole(children, add(step.cost, rest.cost)), step, rest));
                    }
                }
            }
            next.sort_by_key(|(cost, ..)| *cost);
            done.extend(next.iter().take(width).map(|(_, step, rest)| {
                Finished {
                    children: step
                        .children
                        .iter()
                        .chain(&rest.children)
                        .cloned()
                        .collect(),
                    cost: add(step.cost, rest.cost),
                }
            }));
            next.retain(|(_, step, _)| self.sole(&step.left).is_none());
            next.truncate(width);
            open = next.into_iter().map(|(_, step, _)| step).collect();
        }
        done.extend(self.cheapest_next(rows).map(|finished| (*finished).clone()));
        done.sort_by_key(Finished::whole);
        done.truncate(FINALISTS);
        done
    }

    /// The partial selector with every child that may stand next.
    fn steps(&mut self, partial: &Partial, depth: usize) -> Vec<Partial> {
        let mut steps = Vec::new();
        if self.sole(&partial.left).is_some() || self.problem.effort.get() > self.limit {
            return steps;
        }
        let subunits = self.subunits;
        for subunit in subunits {
            let own = subunit.rows.and(&partial.left);
            if own.is_empty() {
                continue;
            }
            if subunit.guards_itself {
                if own == subunit.rows {
                    steps.push(self.step(partial, Rc::new(subunit.body.clone()), &own));
                }
                continue;
            }
            let cover = self.problem.cover(&own, &partial.left.minus(&own));
            steps.push(self.step(partial, Rc::new(subunit.under(self.problem, &cover)), &own));
            if let [_, _, ..] = cover.cubes() {
                for cube in cover.cubes() {
                    let rows = self.problem.columns.cube_rows(cube, &own);
                    let cube = Cover::new([cube.clone()]);
                    steps.push(self.step(
                        partial,
                        Rc::new(subunit.under(self.problem, &cube)),
                        &rows,
                    ));
                }
            }
        }
        if depth > 1 {
            for cube in self.splits(&partial.left) {
                let rows = self.problem.columns.cube_rows(&cube, &partial.left);
                let Some((inner, (nodes, literals))) = self.best(&rows, depth - 1) else {
                    continue;
                };
                let guard = self.problem.guard(&Cover::new([cube]));
                let node = Rc::new(guarded(guard, (*inner).clone()));
                // The sequence and the literal.
                steps.push(partial.with(node, (nodes + 2, literals + 1), &rows));
            }
        }
        steps
    }

    /// Literals that let some, but not all of the rows through, and rows of several subunits.
    fn splits(&self, rows: &Bits) -> Vec<Cube> {
        let mut found = Vec::new();
        for atom in 0..self.problem.columns.atoms() {
            for positive in [true, false] {
                let cube = Cube::new([Literal { atom, positive }]);
                let through = self.problem.columns.cube_rows(&cube, rows);
                if !through.is_empty() && through != *rows && self.sole(&through).is_none() {
                    found.push(cube);
                }
            }
        }
        found
    }

    fn step(&self, partial: &Partial, child: Rc<Node>, rows: &Bits) -> Partial {
        let size = Size::of(&child);
        partial.with(child, (size.nodes, size.literals), rows)
    }

    /// The best selector for rows below the root, as a node.
    fn best(&mut self, rows: &Bits, depth: usize) -> Option<(Rc<Node>, Cost)> {
        let key = (rows.clone(), depth);
        if let Some(known) = self.best.get(&key) {
            return Some(known.clone());
        }
        let finished = self.beam(rows, INNER_BEAM, depth).into_iter().next()?;
        let best = (Rc::new(finished.node()), finished.whole());
        self.best.insert(key, best.clone());
        Some(best)
    }

    /// Whole subunits, each time the one with the smallest guard; `None` once the effort is spent.
    fn cheapest_next(&mut self, rows: &Bits) -> Option<Rc<Finished>> {
        if let Some(known) = self.greedy.get(rows) {
            return Some(known.clone());
        }
        if self.problem.effort.get() > self.limit {
            return None;
        }
        let mut partial = Partial {
            children: Vec::new(),
            cost: (0, 0),
            left: rows.clone(),
        };
        while !partial.left.is_empty() {
            if let Some(sole) = self.sole(&partial.left) {
                partial = self.step(&partial, Rc::new(sole.body.clone()), &sole.rows);
                break;
            }
            let next = self.subunits.iter().filter_map(|subunit| {
                let own = subunit.rows.and(&partial.left);
                let partly = subunit.guards_itself && own != subunit.rows;
                (!own.is_empty() && !partly).then(|| {
                    let cover = self.problem.cover(&own, &partial.left.minus(&own));
                    self.step(&partial, Rc::new(subunit.under(self.problem, &cover)), &own)
                })
            });
            match next.min_by_key(|step| step.cost) {
                Some(step) => partial = step,
                None => break,
            }
        }
        let finished = Rc::new(Finished {
            children: partial.children,
            cost: partial.cost,
        });
        self.greedy.insert(rows.clone(), finished.clone());
        Some(finished)
    }

    /// The subunit that holds all of the rows.
    fn sole(&self, rows: &Bits) -> Option<&'a Subunit> {
        self.subunits
            .iter()
            .find(|subunit| rows.is_subset(&subunit.rows))
    }
}
