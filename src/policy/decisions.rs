//! `policy.csv`: a row per minterm with what the policy does in it.
//!
//! The header has the names of the atoms (`done(goto(A))` and `failed(goto(A))` are history), then `behavior`, then, as
//! far as they are known, `visits`, `q_gap` and `q:NAME` for each behaviour that could be chosen.

use super::sheet::{self, Cell, Sheet, TableError, TableErrorKind};
use super::{Minterm, Policy, Row, Value};
use crate::ir::law::Behavior;
use crate::ir::task::{History, Task};
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use std::collections::BTreeMap;
use std::ops::Range;

/// The most minterms that a row with `-` may stand for.
const WIDEST: u32 = 16;

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

/// Reads the decisions of a policy; its transitions and the evidence behind its values come from other files.
///
/// A task says in which order its behaviours stand and what its history window holds. Without one, behaviours stand as
/// in the program, and the window is as long as the rows need.
///
/// # Errors
/// What is wrong with the table, with the place.
pub fn read(text: &str, program: &Program, task: Option<Id<Task>>) -> Result<Policy, TableError> {
    let sheet = Sheet::read(text)?;
    let columns = Columns::of(&sheet, program)?;
    let mut rows: BTreeMap<Minterm, (Row, Range<usize>)> = BTreeMap::new();
    let behaviors = columns.behaviors(&sheet, program, task)?;
    let names = sheet::behaviors(program);
    for cells in &sheet.rows {
        let place = sheet::whole(cells);
        let cell = |i: usize| cells.get(i);
        let Some(decided) = cell(columns.behavior) else {
            continue;
        };
        let behavior = sheet::behavior(decided, &names)?;
        let visits = match columns.visits.and_then(cell) {
            Some(cell) => cell.number("a count")?,
            None => 0,
        };
        let mut values = vec![None; behaviors.len()];
        for (id, column) in &columns.values {
            let known = cell(*column).filter(|cell| !cell.text.is_empty());
            let at = behaviors.iter().position(|b| b == id);
            if let (Some(cell), Some(slot)) = (known, at.and_then(|at| values.get_mut(at))) {
                *slot = Some(Value {
                    visits: 0,
                    q: cell.number("a number")?,
                    squares: 0.0,
                });
            }
        }
        for minterm in minterms(cells, &columns, &place)? {
            let row = Row {
                minterm: minterm.clone(),
                free: None,
                behavior,
                visits,
                values: values.clone(),
            };
            match rows.get(&minterm) {
                Some((known, earlier)) if known.behavior != behavior => {
                    return Err(TableError {
                        span: place,
                        kind: TableErrorKind::Contradiction {
                            earlier: earlier.clone(),
                        },
                    });
                }
                Some(_) => {}
                None => {
                    rows.insert(minterm, (row, place.clone()));
                }
            }
        }
    }
    let rows: Vec<Row> = rows.into_values().map(|(row, _)| row).collect();
    let atoms: Vec<Atom> = columns.atoms.iter().map(|(atom, _)| *atom).collect();
    let history = match task {
        Some(task) => program.tasks[task].history,
        None => window(&atoms, &rows),
    };
    Ok(Policy {
        atoms,
        behaviors,
        history,
        rows,
        starts: Vec::new(),
        transitions: Vec::new(),
    })
}

/// What the columns of a table are.
struct Columns {
    atoms: Vec<(Atom, usize)>,
    behavior: usize,
    visits: Option<usize>,
    values: Vec<(Id<Behavior>, usize)>,
}

impl Columns {
    fn of(sheet: &Sheet, program: &Program) -> Result<Self, TableError> {
        let known = sheet::atoms(program);
        let names = sheet::behaviors(program);
        let mut columns = Self {
            atoms: Vec::new(),
            behavior: sheet.column("behavior")?,
            visits: sheet.find("visits"),
            values: Vec::new(),
        };
        for (i, cell) in sheet.header.iter().enumerate() {
            let name = cell.text.trim();
            if i == columns.behavior || ["visits", "q_gap"].contains(&name) {
                continue;
            }
            let value = name.strip_prefix("q:").and_then(|name| names.get(name));
            match (known.get(name), value) {
                (Some(atom), _) => columns.atoms.push((*atom, i)),
                (None, Some(id)) => columns.values.push((*id, i)),
                (None, None) => {
                    return Err(cell.error(TableErrorKind::UnknownColumn(name.to_owned())));
                }
            }
        }
        Ok(columns)
    }

    /// The behaviours that could be chosen, in order.
    fn behaviors(
        &self,
        sheet: &Sheet,
        program: &Program,
        task: Option<Id<Task>>,
    ) -> Result<Vec<Id<Behavior>>, TableError> {
        if let Some(task) = task {
            return Ok(program.tasks[task].choose.clone());
        }
        if !self.values.is_empty() {
            return Ok(self.values.iter().map(|(id, _)| *id).collect());
        }
        let names = sheet::behaviors(program);
        let cells = sheet.rows.iter().filter_map(|row| row.get(self.behavior));
        let mut found = cells
            .map(|cell| sheet::behavior(cell, &names))
            .collect::<Result<Vec<_>, _>>()?;
        found.sort_unstable();
        found.dedup();
        Ok(found)
    }
}

/// The minterms that a row stands for.
fn minterms(
    cells: &[Cell],
    columns: &Columns,
    place: &Range<usize>,
) -> Result<Vec<Minterm>, TableError> {
    let values = columns.atoms.iter().filter_map(|(_, i)| cells.get(*i));
    let values = values.map(Cell::truth).collect::<Result<Vec<_>, _>>()?;
    let free = values.iter().filter(|value| value.is_none()).count();
    if free > WIDEST as usize {
        return Err(TableError {
            span: place.clone(),
            kind: TableErrorKind::Wide,
        });
    }
    let every = 0..1_u32 << free;
    Ok(every
        .map(|mut bits| {
            Minterm::new(values.iter().map(|value| {
                value.unwrap_or_else(|| {
                    let bit = bits & 1 == 1;
                    bits >>= 1;
                    bit
                })
            }))
        })
        .collect())
}

/// The shortest window under which these rows can be seen.
fn window(atoms: &[Atom], rows: &[Row]) -> History {
    let remembered = |row: &Row| {
        let held = atoms.iter().zip(row.minterm.values());
        held.filter(|(atom, value)| *value && !matches!(atom, Atom::Predicate(_)))
            .count()
    };
    let success = atoms.iter().any(|atom| matches!(atom, Atom::Done(_)));
    let failure = atoms.iter().any(|atom| matches!(atom, Atom::Failed(_)));
    let needed = rows.iter().map(remembered).max().unwrap_or(0);
    History {
        window: if success || failure { needed.max(1) } else { 0 },
        success,
        failure,
    }
}
