//! The policy of a table.

use super::process::Key;
use super::rollout::RollOut;
use super::table::Table;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::policy::{Minterm, Policy, Row, Transition, Value};
use rustc_hash::FxHashMap;

/// What is decided in a minterm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Decided {
    /// The number of the behaviour among those of the task.
    pub choice: usize,
    /// What it is worth, as far as is known.
    pub value: f64,
}

/// A policy by key.
pub type Decisions = FxHashMap<Key, Decided>;

/// What the greedy policy of a table does in each minterm in which at least so many decisions were completed, and one
/// at least.
pub fn greedy(table: &Table, evidence: u64) -> Decisions {
    let decided = |(key, row): (Key, usize)| {
        let choice = table.greedy(row)?;
        let value = table.cells(row).get(choice)?.q;
        (table.visits(row) >= evidence).then_some((key, Decided { choice, value }))
    };
    table.sorted().into_iter().filter_map(decided).collect()
}

/// The minterms in which decisions were completed, but fewer than so many; with how many.
pub fn thin(table: &Table, evidence: u64) -> Vec<(Key, u64)> {
    let rows = table.sorted().into_iter();
    let visits = rows.map(|(key, row)| (key, table.visits(row)));
    visits
        .filter(|(_, visits)| (1..evidence).contains(visits))
        .collect()
}

/// A policy with the evidence of its table, and with what was met under it.
pub fn policy(
    decisions: &Decisions,
    table: &Table,
    met: &RollOut,
    task: &Task,
    atoms: Vec<Atom>,
) -> Policy {
    let n = atoms.len();
    let mut rows: Vec<Row> = table
        .sorted()
        .into_iter()
        .filter_map(|(key, row)| {
            let behavior = *task.choose.get(decisions.get(&key)?.choice)?;
            let values = table.cells(row).iter().map(|cell| {
                (cell.visits > 0).then_some(Value {
                    visits: cell.visits,
                    q: cell.q,
                    squares: cell.squares,
                })
            });
            Some(Row {
                minterm: Minterm::of_key(key, n),
                free: None,
                behavior,
                visits: table.visits(row),
                values: values.collect(),
            })
        })
        .collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    let mut starts: Vec<(Minterm, u64)> = met
        .starts
        .iter()
        .map(|(key, count)| (Minterm::of_key(*key, n), *count))
        .collect();
    starts.sort();
    let mut transitions: Vec<Transition> = met
        .taken
        .iter()
        .filter_map(|(&(from, choice, status, to), &count)| {
            Some(Transition {
                from: Minterm::of_key(from, n),
                behavior: *task.choose.get(choice)?,
                status,
                to: to.map(|to| Minterm::of_key(to, n)),
                count,
            })
        })
        .collect();
    transitions.sort();
    Policy {
        atoms,
        behaviors: task.choose.clone(),
        history: task.history,
        rows,
        starts,
        transitions,
    }
}
