//! The policy of a table.

use super::process::Key;
use super::rollout::RollOut;
use super::table::Table;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::policy::{Minterm, Policy, Row, Transition, Value};
use rustc_hash::FxHashMap;

/// What the greedy policy of a table does in each minterm in which a decision was completed.
pub fn greedy(table: &Table, choices: &[Id<Behavior>]) -> FxHashMap<Key, Id<Behavior>> {
    table
        .sorted()
        .into_iter()
        .filter_map(|(key, row)| Some((key, *choices.get(table.greedy(row)?)?)))
        .collect()
}

/// The minterm whose bits a key holds.
pub fn minterm(key: Key, atoms: usize) -> Minterm {
    Minterm::new((0..atoms).map(|i| key >> i & 1 == 1))
}

/// The key that holds the bits of a minterm.
pub fn key(minterm: &Minterm) -> Key {
    minterm
        .values()
        .enumerate()
        .fold(0, |key, (i, value)| key | Key::from(value) << i)
}

/// The policy of a table with its evidence, and with what was met under it.
pub fn policy(table: &Table, met: &RollOut, task: &Task, atoms: Vec<Atom>) -> Policy {
    let n = atoms.len();
    let mut rows: Vec<Row> = table
        .sorted()
        .into_iter()
        .filter_map(|(key, row)| {
            let cells = table.cells(row);
            Some(Row {
                minterm: minterm(key, n),
                behavior: *task.choose.get(table.greedy(row)?)?,
                visits: cells.iter().map(|cell| cell.visits).sum(),
                values: cells
                    .iter()
                    .map(|cell| {
                        (cell.visits > 0).then_some(Value {
                            visits: cell.visits,
                            q: cell.q,
                            squares: cell.squares,
                        })
                    })
                    .collect(),
            })
        })
        .collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    let mut starts: Vec<(Minterm, u64)> = met
        .starts
        .iter()
        .map(|(key, count)| (minterm(*key, n), *count))
        .collect();
    starts.sort();
    let mut transitions: Vec<Transition> = met
        .taken
        .iter()
        .filter_map(|(&(from, choice, status, to), &count)| {
            Some(Transition {
                from: minterm(from, n),
                behavior: *task.choose.get(choice)?,
                status,
                to: to.map(|to| minterm(to, n)),
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
