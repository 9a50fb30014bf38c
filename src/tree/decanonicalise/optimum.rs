//! The smallest tree without memory for a table of few rows, by dynamic programming over all sets of its rows.
//!
//! A list that decides a set S of rows has as its first child a unit that decides some part T of them: a guard that holds on T and
//! not on the rest of S, before a behaviour or a list for T. What remains is a list for the rest of S. Guards are any formulas: the
//! smallest for each function of up to four atoms is found first ([`formulas`]).

mod formulas;

use super::problem::Problem;
use crate::ir::tree::{Guard, Node};
use crate::logic::Account;
use crate::tree::unit::{guarded, selector};
use formulas::{Formulas, NEVER};

/// The most atoms, and the most rows that are always tried.
const ATOMS: usize = 4;
const FEW: usize = 10;

/// A tree of fewest nodes among those in which each group decides all rows that reach it; `None` where there are too many atoms,
/// or the account does not go so far.
pub(super) fn optimum(problem: &Problem, account: &Account) -> Option<Node> {
    let rows = problem.policy.rows.len();
    let atoms = problem.columns().atoms();
    if atoms == 0 || atoms > ATOMS || problem.wide || rows == 0 {
        return None;
    }
    let divisions = 3_u64.checked_pow(u32::try_from(rows).ok()?)?;
    let work = divisions.saturating_mul(4);
    if rows > FEW && !account.affords(work.saturating_mul(2)) {
        return None;
    }
    account.spend(work);
    let search = Search::new(problem, rows, atoms);
    let children = search.children(search.all());
    Some(selector(children))
}

struct Search<'a> {
    problem: &'a Problem<'a>,
    formulas: Formulas,
    rows: usize,
    /// The minterm of each row, as a number.
    minterms: Vec<usize>,
    /// The rows of each behaviour, a bit each.
    classes: Vec<u32>,
    /// 3^i for the i-th row.
    powers: Vec<usize>,
    /// The nodes of the smallest guard for each division of the rows, written in base 3 (row i is digit i): 1 where it holds, 0
    /// where it does not, 2 where it may.
    guards: Vec<u8>,
    /// The nodes of the children of the smallest list for each set of rows, and the rows that its first child decides.
    lists: Vec<(u8, u32)>,
}

impl<'a> Search<'a> {
    fn new(problem: &'a Problem<'a>, rows: usize, atoms: usize) -> Self {
        let minterm = |row: &crate::policy::Row| {
            let values = row.minterm.values().enumerate();
            values.fold(0, |all, (atom, value)| all | usize::from(value) << atom)
        };
        let bits = |class: &crate::logic::Bits| class.iter().fold(0, |all, row| all | 1 << row);
        let mut search = Self {
            formulas: Formulas::new(atoms),
            minterms: problem.policy.rows.iter().map(minterm).collect(),
            classes: problem.classes().iter().map(bits).collect(),
            powers: (0..rows as u32).map(|row| 3_usize.pow(row)).collect(),
            guards: Vec::new(),
            lists: Vec::new(),
            problem,
            rows,
        };
        search.find_guards();
        search.find_lists();
        search
    }

    fn all(&self) -> u32 {
        (1 << self.rows) - 1
    }

    /// The number in base 3 with the digit 1 for each of these rows.
    fn ternary(&self, set: u32) -> usize {
        let rows = self.powers.iter().enumerate();
        let there = rows.filter(|(row, _)| set >> row & 1 == 1);
        there.map(|(_, power)| power).sum()
    }

    fn find_guards(&mut self) {
        let minterms = 1_usize << self.formulas.atoms();
        // The smallest formula for each set of rows, whatever it is on minterms without a row.
        let mut least = vec![NEVER; 1 << self.rows];
        for function in 0..1_usize << minterms {
            let rows = self.minterms.iter().enumerate();
            let set = rows.fold(0_usize, |set, (row, minterm)| {
                set | (function >> minterm & 1) << row
            });
            if let Some(least) = least.get_mut(set) {
                *least = (*least).min(self.formulas.nodes(function));
            }
        }
        let count = 3_usize.pow(self.rows as u32);
        let mut guards = vec![NEVER; count];
        let mut digits = vec![0_u8; self.rows];
        for at in 0..count {
            let free = digits.iter().position(|digit| *digit == 2);
            let nodes = match free.and_then(|row| self.powers.get(row)) {
                Some(power) => {
                    let fixed = [at - power, at - 2 * power].map(|at| guards.get(at).copied());
                    fixed.into_iter().flatten().min()
                }
                None => {
                    let rows = digits.iter().enumerate();
                    let set = rows.fold(0, |set, (row, digit)| set | usize::from(*digit) << row);
                    least.get(set).copied()
                }
            };
            if let (Some(slot), Some(nodes)) = (guards.get_mut(at), nodes) {
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
        let of = |set: u32| ternaries.get(set as usize).copied().unwrap_or(0);
        let whole = of(self.all());
        let mut lists = vec![(0_u8, 0_u32); 1 << self.rows];
        for set in 1..=self.all() {
            let mut best = (NEVER, set);
            if self.class(set).is_some() {
                best.0 = 1;
            } else {
                // Free where it is not in the set.
                let base = 2 * (whole - of(set));
                let mut part = (set - 1) & set;
                while part > 0 {
                    let guard = self.guards.get(base + of(part)).copied().unwrap_or(NEVER);
                    let of = |set: u32| lists.get(set as usize).map_or(NEVER, |(nodes, _)| *nodes);
                    let body = of(part);
                    // A list of several children is a selector.
                    let nodes = 1 + guard + body + u8::from(body > 1) + of(set - part);
                    if nodes < best.0 {
                        best = (nodes, part);
                    }
                    part = (part - 1) & set;
                }
            }
            if let Some(slot) = lists.get_mut(set as usize) {
                *slot = best;
            }
        }
        self.lists = lists;
    }

    /// The class to which all of these rows belong.
    fn class(&self, set: u32) -> Option<usize> {
        self.classes.iter().position(|class| set & !class == 0)
    }

    fn children(&self, mut set: u32) -> Vec<Node> {
        let mut children = Vec::new();
        loop {
            if let Some(class) = self.class(set) {
                let behavior = self.problem.on.get(class).map(|(behavior, _)| *behavior);
                children.extend(behavior.map(Node::Behavior));
                return children;
            }
            let Some((_, part)) = self.lists.get(set as usize) else {
                return children;
            };
            let body = selector(self.children(*part));
            children.push(guarded(self.guard(set, *part), body));
            set -= part;
        }
    }

    /// The smallest guard that holds on a part of a set.
    fn guard(&self, set: u32, part: u32) -> Guard {
        let fits = |function: &usize| {
            self.minterms.iter().enumerate().all(|(row, minterm)| {
                set >> row & 1 == 0 || (function >> minterm & 1) as u32 == part >> row & 1
            })
        };
        let functions = 0..1_usize << (1_usize << self.formulas.atoms());
        let best = functions.filter(fits);
        let best = best.min_by_key(|function| self.formulas.nodes(*function));
        let atoms = &self.problem.policy.atoms;
        best.map_or(Guard::Const(false), |function| {
            self.formulas.guard(function, atoms)
        })
    }
}
