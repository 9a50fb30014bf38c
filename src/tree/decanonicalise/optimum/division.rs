//! The smallest list that divides some rows among bodies, by dynamic programming over all sets of the rows.
//!
//! A list that decides a set S of rows has as its first child a unit that decides some part T of them: a guard that holds on T and
//! not on the rest of S, before a body or a list for T. What remains is a list for the rest of S. Guards are any formulas: the
//! smallest for each set of rows is found first ([`super::formulas`]).

use super::formulas::{Formulas, NEVER};
use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::tree::Size;
use crate::tree::unit::{guarded, selector};

/// The smallest lists for all sets of a few rows, each with the body that decides it. A set has a bit for each of its rows.
pub(in crate::tree::decanonicalise) struct Division {
    formulas: Formulas,
    rows: usize,
    bodies: Vec<Body>,
    /// 3^i for the i-th row.
    powers: Vec<usize>,
    /// The nodes of the smallest guard for each division of the rows, written in base 3 (row i is digit i): 1 where it holds, 0
    /// where it does not, 2 where it may.
    guards: Vec<u8>,
    /// The smallest list for each set of rows.
    lists: Vec<List>,
}

/// What decides some rows.
struct Body {
    node: Node,
    rows: usize,
    /// What stands for it where it is the last child of a list.
    last: List,
}

/// A list for a set of rows.
#[derive(Clone, Copy, Default)]
struct List {
    /// The nodes of its children.
    nodes: u32,
    /// The rows that the first child decides.
    first: usize,
    /// Whether it is a selector where it stands alone.
    selects: bool,
}

impl Division {
    /// The work of dividing so many rows.
    pub(in crate::tree::decanonicalise) fn work(rows: usize) -> u64 {
        let divisions = u32::try_from(rows).ok().and_then(|n| 3_u64.checked_pow(n));
        divisions.unwrap_or(u64::MAX).saturating_mul(4)
    }

    /// So many rows, the sets in which the atoms hold, and bodies that decide the rows of one set each. No two rows are alike in
    /// all atoms and belong to different bodies.
    pub(in crate::tree::decanonicalise) fn new(
        rows: usize,
        columns: Vec<usize>,
        bodies: Vec<(Node, usize)>,
    ) -> Self {
        let mut found = Self {
            formulas: Formulas::new(rows, &columns),
            rows,
            bodies: bodies.into_iter().map(Body::new).collect(),
            powers: (0..rows as u32).map(|row| 3_usize.pow(row)).collect(),
            guards: Vec::new(),
            lists: Vec::new(),
        };
        found.find_guards();
        found.find_lists();
        found
    }

    fn all(&self) -> usize {
        (1 << self.rows) - 1
    }

    /// The nodes of the children of the smallest list for all rows.
    pub(in crate::tree::decanonicalise) fn nodes(&self) -> usize {
        self.list(self.all()).nodes as usize
    }

    /// The number in base 3 with the digit 1 for each of these rows.
    fn ternary(&self, set: usize) -> usize {
        let rows = self.powers.iter().enumerate();
        let there = rows.filter(|(row, _)| set >> row & 1 == 1);
        there.map(|(_, power)| power).sum()
    }

    fn find_guards(&mut self) {
        let count = 3_usize.pow(self.rows as u32);
        let mut guards = vec![NEVER; count];
        let mut digits = vec![0_u8; self.rows];
        for at in 0..count {
            let free = digits.iter().position(|digit| *digit == 2);
            let nodes = match free.and_then(|row| self.powers.get(row)) {
                Some(power) => {
                    let fixed = [at - power, at - 2 * power].map(|at| guards.get(at).copied());
                    fixed.into_iter().flatten().min().unwrap_or(NEVER)
                }
                None => {
                    let rows = digits.iter().enumerate();
                    let set = rows.fold(0, |set, (row, digit)| set | usize::from(*digit) << row);
                    self.formulas.nodes(set)
                }
            };
            if let Some(slot) = guards.get_mut(at) {
                *slot = nodes;
            }
            for digit in &mut digits {
                *digit = (*digit + 1) % 3;
                if *digit > 0 {
                    break;
                }
            }
        }
        self.guards = guards;
    }

    fn find_lists(&mut self) {
        let ternaries: Vec<usize> = (0..=self.all()).map(|set| self.ternary(set)).collect();
        let of = |set: usize| ternaries.get(set).copied().unwrap_or(0);
        let whole = of(self.all());
        self.lists = vec![List::default(); 1 << self.rows];
        for set in 1..=self.all() {
            let best = match self.body(set) {
                Some(body) => body.last,
                None => {
                    // Free where it is not in the set.
                    let base = 2 * (whole - of(set));
                    let mut best = List {
                        nodes: u32::MAX,
                        first: set,
                        selects: true,
                    };
                    let mut part = (set - 1) & set;
                    while part > 0 {
                        let guard = self.guards.get(base + of(part)).copied().unwrap_or(NEVER);
                        let body = self.list(part);
                        let nodes = 1 + u32::from(guard) + body.nodes + u32::from(body.selects);
                        let nodes = nodes + self.list(set - part).nodes;
                        if nodes < best.nodes && guard < NEVER {
                            (best.nodes, best.first) = (nodes, part);
                        }
                        part = (part - 1) & set;
                    }
                    best
                }
            };
            if let Some(slot) = self.lists.get_mut(set) {
                *slot = best;
            }
        }
    }

    fn list(&self, set: usize) -> List {
        self.lists.get(set).copied().unwrap_or_default()
    }

    /// The body that decides all of these rows.
    fn body(&self, set: usize) -> Option<&Body> {
        self.bodies.iter().find(|body| set & !body.rows == 0)
    }

    /// The children of the smallest list for all rows.
    pub(in crate::tree::decanonicalise) fn children(&self, atoms: &[Atom]) -> Vec<Node> {
        self.of_set(self.all(), atoms)
    }

    fn of_set(&self, mut set: usize, atoms: &[Atom]) -> Vec<Node> {
        let mut children = Vec::new();
        while set > 0 {
            if let Some(body) = self.body(set) {
                children.push(body.node.clone());
                break;
            }
            let part = self.list(set).first;
            let body = selector(self.of_set(part, atoms));
            children.push(guarded(self.guard(set, part, atoms), body));
            set -= part;
        }
        children
    }

    /// The smallest guard that holds on a part of a set.
    fn guard(&self, set: usize, part: usize, atoms: &[Atom]) -> Guard {
        let fitting = (0..=self.all()).filter(|holds| holds & set == part);
        let best = fitting.min_by_key(|holds| self.formulas.nodes(*holds));
        best.map_or(Guard::Const(false), |holds| {
            self.formulas.guard(holds, atoms)
        })
    }
}

impl Body {
    fn new((node, rows): (Node, usize)) -> Self {
        let selects = matches!(
            node,
            Node::Composite {
                kind: Composite::Selector,
                memory: false,
                ..
            }
        );
        let nodes = Size::of(&node).nodes - usize::from(selects);
        Self {
            last: List {
                nodes: nodes as u32,
                first: rows,
                selects,
            },
            node,
            rows,
        }
    }
}
