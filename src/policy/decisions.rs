//! `policy.csv`: a row per minterm with what the policy does in it.
//!
//! The header has the names of the atoms (`done(goto(A))` and `failed(goto(A))` are history), then `behavior`, then, as
//! far as they are known, `visits`, `q_gap` and `q:NAME` for each behaviour that could be chosen.

use super::error::{TableError, TableErrorKind};
use super::reader::{self, Format};
use super::records::REMARK;
use super::sheet;
use super::table::Table;
use super::{Policy, Row};
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::ir::{Id, Name, Program};
use crate::policy::names::{self, AtomName};

/// The most minterms that a row with `-` may stand for, as a power of two.
const WIDEST: usize = 16;

/// The decisions of a policy as text.
pub fn write(policy: &Policy, program: &Program) -> String {
    let name = |id: &Id<Behavior>| program.behaviors[*id].name.to_string();
    let atoms = policy.atoms.iter();
    let atoms = atoms.map(|atom| program.atom_name(*atom).to_string());
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
        cells(row).chain(decided).chain(values).collect()
    });
    sheet::write(std::iter::once(header).chain(rows))
}

/// The decisions alone as text, under names without backquotes where they are read so: a table as anybody writes it, with
/// remarks above it.
pub fn write_bare(policy: &Policy, program: &Program, remarks: &[String]) -> String {
    let atoms = policy.atoms.iter();
    let atoms = atoms.map(|atom| column(AtomName::of(*atom, program)));
    let header = atoms.chain(["behavior".to_owned()]).collect();
    let rows = policy.rows.iter().map(|row| {
        let behavior = program.behaviors[row.behavior].name.bare();
        cells(row).chain([cell(behavior)]).collect()
    });
    let remarks = remarks.iter().map(|line| format!("{REMARK}{line}\n"));
    let remarks: String = remarks.collect();
    remarks + &sheet::write(std::iter::once(header).chain(rows))
}

/// A name of the policy that no table can say.
pub fn unsaid(policy: &Policy, program: &Program) -> Option<String> {
    let atoms = policy.atoms.iter();
    let mut atoms = atoms.map(|atom| AtomName::of(*atom, program));
    let atom = atoms.find(|atom| atom.check().is_err());
    let behaviors = policy.behaviors.iter();
    let mut behaviors = behaviors.map(|id| program.behaviors[*id].name.bare());
    let behavior = || behaviors.find(|name| names::check(name).is_err());
    atom.map(|atom| atom.to_string()).or_else(behavior)
}

/// The column of an atom.
fn column(atom: AtomName) -> String {
    match atom {
        AtomName::Predicate(name) if !is_plain(&name) || reader::is_special(&name) => {
            format!("`{name}`")
        }
        atom => atom.to_string(),
    }
}

/// A behaviour in its cell.
fn cell(behavior: String) -> String {
    match is_plain(&behavior) {
        true => behavior,
        false => format!("`{behavior}`"),
    }
}

/// Whether a name is read as it is.
fn is_plain(name: &str) -> bool {
    name.trim() == name && !name.contains('|') && name != "-"
}

/// The values of a row's atoms as cells, `-` where they are free.
fn cells(row: &Row) -> impl Iterator<Item = String> {
    let free = row.free.as_ref();
    row.minterm.values().enumerate().map(move |(i, value)| {
        let digit = if value { "1" } else { "0" };
        let free = free.is_some_and(|free| free.get(i));
        if free { "-" } else { digit }.to_owned()
    })
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
    if table.has_sets() {
        return Err(vec![TableError {
            span: table.header.clone(),
            kind: TableErrorKind::Several,
        }]);
    }
    let mut unknown = Vec::new();
    let known = names::atoms(program);
    let atoms = table.atoms.iter().filter_map(|(name, place)| {
        let atom = known.get(name);
        if atom.is_none() {
            unknown.push(TableError {
                span: place.clone(),
                kind: TableErrorKind::UnknownColumn(name.to_string()),
            });
        }
        atom.copied()
    });
    let atoms: Vec<Atom> = atoms.collect();
    let known = names::behaviors(program);
    let ids = table.behaviors.iter().filter_map(|(name, place)| {
        let id = known.get(name);
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
    let chosen = task.map_or_else(
        || chosen(table, &ids),
        |task| program.tasks[task].choose.clone(),
    );
    let history = task.map(|task| program.tasks[task].history);
    Ok(table.policy(atoms, &ids, chosen, history))
}

/// The policy in a table of its own names, with a program that declares them and says nothing more.
pub fn declared(table: &Table) -> (Program, Policy) {
    let mut program = Program::default();
    let policy = joined(table, &mut program);
    (program, policy)
}

/// The policy in a table beside a program; the names that the program does not have are declared in it.
pub fn joined(table: &Table, program: &mut Program) -> Policy {
    let known = names::behaviors(program);
    let ids = table.behaviors.iter().map(|(name, _)| {
        known.get(name).copied().unwrap_or_else(|| {
            program.behaviors.push(Behavior {
                name: Name::word(name),
                law: None,
            })
        })
    });
    let ids: Vec<Id<Behavior>> = ids.collect();
    let known = names::atoms(program);
    let atoms = table.atoms.iter().filter_map(|(name, _)| {
        let found = known.get(name).copied();
        found.or_else(|| match name {
            AtomName::Predicate(name) => {
                Some(Atom::Predicate(program.predicates.push(Predicate {
                    name: Name::word(name),
                    when: None,
                })))
            }
            // Every behaviour that the history knows is among those of the table.
            AtomName::Done(_) | AtomName::Failed(_) => None,
        })
    });
    let atoms: Vec<Atom> = atoms.collect();
    table.policy(atoms, &ids, chosen(table, &ids), None)
}

/// The behaviours that a table chooses, in its order.
fn chosen(table: &Table, ids: &[Id<Behavior>]) -> Vec<Id<Behavior>> {
    ids.iter().take(table.chosen).copied().collect()
}

/// Replaces the rows of a policy by one for each minterm.
///
/// # Errors
/// The number of a row that stands for too many.
fn expand(policy: &mut Policy) -> Result<(), usize> {
    let widths = || policy.rows.iter().map(Row::free_atoms);
    if let Some(at) = widths().position(|free| free > WIDEST) {
        return Err(at);
    }
    if widths().any(|free| free > 0) {
        policy.rows = policy.minterm_rows();
    }
    Ok(())
}
