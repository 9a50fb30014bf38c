//! `policy.csv`: a row per minterm with what the policy does in it.
//!
//! The header has the names of the atoms (`done(goto(A))` and `failed(goto(A))` are history), then `behavior`, then, as
//! far as they are known, `visits`, `q_gap` and `q:NAME` for each behaviour that could be chosen.

use super::error::{TableError, TableErrorKind};
use super::sheet;
use super::table::{Format, Table};
use super::{Minterm, Policy, Row};
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use crate::policy::names::{self, AtomName};
use std::collections::BTreeMap;

/// The most minterms that a row with `-` may stand for, as a power of two.
const WIDEST: usize = 16;

/// The decisions of a policy as text.
pub fn write(policy: &Policy, program: &Program) -> String {
    let name = |id: &Id<Behavior>| program.behaviors[*id].name.clone();
    let atoms = policy.atoms.iter().map(|atom| program.atom_name(*atom));
    let fixed = ["behavior", "visits", "q_gap"].map(str::to_owned);
    let values = policy.behaviors.iter().map(|id| format!("q:{}", name(id)));
    let header = atoms.chain(fixed).chain(values).collect();
    let rows = policy.rows.iter().map(|row| {
        let shown = |q: Option<f64>| q.map_or_else(String::new, |q| q.to_string());
        let decided = [
            name(&row.behavior),
            row.visits.to_string(),
            shown(row.q_gap()),
        ];
        let values = row.values.iter().map(|value| shown(value.map(|v| v.q)));
        sheet::cells(&row.minterm)
            .chain(decided)
            .chain(values)
            .collect()
    });
    sheet::write(std::iter::once(header).chain(rows))
}

/// Reads the decisions of a policy of a program; its transitions and the evidence behind its values come from other
/// files.
///
/// A task says in which order its behaviours stand and what its history window holds. Without one, behaviours stand as
/// in the table, and the window is as long as the rows need.
///
/// # Errors
/// What is wrong with the table, with the places.
pub fn read(
    text: &str,
    program: &Program,
    task: Option<Id<Task>>,
) -> Result<Policy, Vec<TableError>> {
    let table = Table::read(text.as_bytes(), Format::of("", text.as_bytes()))?;
    let mut policy = of_program(&table, program, task)?;
    expand(&mut policy).map_err(|at| {
        vec![TableError {
            span: table.place(text.as_bytes(), at),
            kind: TableErrorKind::Wide,
        }]
    })?;
    Ok(policy)
}

/// The policy in a table whose names are those of a program.
///
/// # Errors
/// Names that the program does not have, with their places.
pub fn of_program(
    table: &Table,
    program: &Program,
    task: Option<Id<Task>>,
) -> Result<Policy, Vec<TableError>> {
    let mut unknown = Vec::new();
    let known = atoms(program);
    let atoms = table.atoms.iter().filter_map(|(name, place)| {
        let atom = known.get(&name.to_string());
        if atom.is_none() {
            unknown.push(TableError {
                span: place.clone(),
                kind: TableErrorKind::UnknownColumn(name.to_string()),
            });
        }
        atom.copied()
    });
    let atoms: Vec<Atom> = atoms.collect();
    let known = behaviors(program);
    let ids = table.behaviors.iter().filter_map(|(name, place)| {
        let id = known.get(name.as_str());
        if id.is_none() {
            unknown.push(TableError {
                span: place.clone(),
                kind: TableErrorKind::UnknownBehavior(name.clone()),
            });
        }
        id.copied()
    });
    let ids: Vec<Id<Behavior>> = ids.collect();
    if !unknown.is_empty() {
        return Err(unknown);
    }
    let chosen = task.map_or_else(|| ids.clone(), |task| program.tasks[task].choose.clone());
    let history = task.map(|task| program.tasks[task].history);
    Ok(table.policy(atoms, &ids, chosen, history))
}

/// The policy in a table of its own names, with a program that declares them, as `spelled` writes them in the language,
/// and says nothing more.
pub fn declared(table: &Table, spelled: impl Fn(&str) -> String) -> (Program, Policy) {
    let mut program = Program::default();
    let ids = table.behaviors.iter().map(|(name, _)| {
        let name = spelled(name);
        program.behaviors.push(Behavior { name, law: None })
    });
    let ids: Vec<Id<Behavior>> = ids.collect();
    let of = |name: &str| {
        let at = table.behaviors.iter().position(|(known, _)| known == name);
        at.and_then(|at| ids.get(at)).copied()
    };
    let atoms = table.atoms.iter().filter_map(|(name, _)| match name {
        AtomName::Predicate(name) => Some(Atom::Predicate(program.predicates.push(Predicate {
            name: spelled(name),
            when: None,
        }))),
        AtomName::Done(name) => of(name).map(Atom::Done),
        AtomName::Failed(name) => of(name).map(Atom::Failed),
    });
    let atoms: Vec<Atom> = atoms.collect();
    let policy = table.policy(atoms, &ids, ids.clone(), None);
    (program, policy)
}

/// The names of a program's behaviours, without backquotes around them.
pub(super) fn behaviors(program: &Program) -> BTreeMap<&str, Id<Behavior>> {
    let behaviors = program.behaviors.iter();
    behaviors
        .map(|(id, b)| (names::plain(&b.name), id))
        .collect()
}

/// The names of a program's atoms, without backquotes around what they name.
pub(super) fn atoms(program: &Program) -> BTreeMap<String, Atom> {
    let predicates = program.predicates.ids().map(Atom::Predicate);
    let history = program
        .behaviors
        .ids()
        .flat_map(|b| [Atom::Done(b), Atom::Failed(b)]);
    predicates
        .chain(history)
        .map(|atom| (AtomName::of(&program.atom_name(atom)).to_string(), atom))
        .collect()
}

/// Puts the minterms that a policy's rows stand for in their place, sorted, each once.
///
/// # Errors
/// The number of a row that stands for too many.
pub fn expand(policy: &mut Policy) -> Result<(), usize> {
    if policy.rows.iter().all(|row| row.free.is_none()) {
        return Ok(());
    }
    let mut all = Vec::new();
    for (at, row) in policy.rows.iter().enumerate() {
        let free: Vec<usize> = match &row.free {
            Some(free) => (0..free.len()).filter(|i| free.get(*i)).collect(),
            None => Vec::new(),
        };
        if free.len() > WIDEST {
            return Err(at);
        }
        for bits in 0..1_u32 << free.len() {
            let values = row.minterm.values().enumerate().map(|(atom, value)| {
                let at = free.iter().position(|i| *i == atom);
                at.map_or(value, |at| bits >> at & 1 == 1)
            });
            all.push(Row {
                minterm: Minterm::new(values),
                free: None,
                ..row.clone()
            });
        }
    }
    all.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    all.dedup_by(|a, b| a.minterm == b.minterm);
    policy.rows = all;
    Ok(())
}
