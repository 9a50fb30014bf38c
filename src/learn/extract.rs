//! The policy of a table.

use super::process::Key;
use super::q_table::QTable;
use super::rollout::RollOut;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::policy::{Minterm, Policy, Row, Transition, Value};
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

/// The decision in a minterm.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Decided {
    /// The number of the behaviour among those of the task.
    pub choice: usize,
    /// Its value, as far as it is known.
    pub value: f64,
}

/// A policy by key.
pub type Decisions = FxHashMap<Key, Decided>;

/// The greedy policy of a table, on the minterms in which at least `evidence` decisions were completed, and at least one.
pub fn greedy(table: &QTable, evidence: u64) -> Decisions {
    let decided = |(key, row): (Key, usize)| {
        let choice = table.greedy(row)?;
        let value = table.cells(row).get(choice)?.q;
        (table.visits(row) >= evidence).then_some((key, Decided { choice, value }))
    };
    table.sorted().into_iter().filter_map(decided).collect()
}

/// The minterms in which decisions were completed, but fewer than `evidence`, each with their number.
pub fn thin(table: &QTable, evidence: u64, atoms: usize) -> Vec<(Minterm, u64)> {
    let rows = table.sorted().into_iter();
    let visits = rows.map(|(key, row)| (Minterm::of_key(key, atoms), table.visits(row)));
    let mut thin: Vec<(Minterm, u64)> = visits
        .filter(|(_, visits)| (1..evidence).contains(visits))
        .collect();
    thin.sort();
    thin
}

/// A policy with the evidence of its table, and with what a roll-out of it met.
pub fn policy(
    decisions: &Decisions,
    table: &QTable,
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
        fields: Vec::new(),
        atoms,
        behaviors: task.choose.clone(),
        history: task.history,
        rows,
        starts,
        transitions,
    }
}
