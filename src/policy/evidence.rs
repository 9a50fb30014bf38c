//! `q.csv`: the evidence behind a policy, a row per minterm and behaviour that was tried in it.
//!
//! The header has the names of the atoms, `behavior`, `visits`, `q` and `squares`, the sum of the squares of the
//! targets that the value was moved towards.

use super::error::{TableError, TableErrorKind};
use super::names;
use super::sheet::{self, Sheet};
use super::{Policy, Value};
use crate::ir::Program;

/// The evidence of a policy as text.
pub fn write(policy: &Policy, program: &Program) -> String {
    let atoms = policy.atoms.iter();
    let atoms = atoms.map(|atom| program.atom_name(*atom).to_string());
    let fixed = ["behavior", "visits", "q", "squares"].map(str::to_owned);
    let header = atoms.chain(fixed).collect();
    let rows = policy.rows.iter().flat_map(|row| {
        let tried = policy.behaviors.iter().zip(&row.values);
        tried.filter_map(|(behavior, value)| {
            let value = (*value)?;
            let known = [
                program.behaviors[*behavior].name.to_string(),
                value.visits.to_string(),
                value.q.to_string(),
                value.squares.to_string(),
            ];
            Some(sheet::cells(&row.minterm).chain(known).collect())
        })
    });
    sheet::write(std::iter::once(header).chain(rows))
}

/// Reads evidence into a policy; it replaces what the policy has.
///
/// # Errors
/// What is wrong with the table, with the place.
pub fn read(text: &str, program: &Program, policy: &mut Policy) -> Result<(), TableError> {
    let sheet = Sheet::read(text)?;
    let columns = sheet.columns("", &policy.atoms, program)?;
    let fixed = [
        sheet.column("behavior")?,
        sheet.column("visits")?,
        sheet.column("q")?,
        sheet.column("squares")?,
    ];
    for (i, cell) in sheet.header.iter().enumerate() {
        if !columns.contains(&i) && !fixed.contains(&i) {
            return Err(cell.error(TableErrorKind::UnknownColumn(cell.text.clone())));
        }
    }
    for row in &mut policy.rows {
        row.values = vec![None; policy.behaviors.len()];
    }
    let names = names::behaviors(program);
    for cells in &sheet.rows {
        let [Some(name), Some(visits), Some(q), Some(squares)] = fixed.map(|i| cells.get(i)) else {
            continue;
        };
        let minterm = sheet::minterm(&sheet::at(cells, &columns))?;
        let behavior = sheet::behavior(name, &names)?;
        let Some(at) = policy.behaviors.iter().position(|b| *b == behavior) else {
            return Err(name.error(TableErrorKind::UnknownBehavior(name.text.clone())));
        };
        let row = policy
            .rows
            .binary_search_by(|row| row.minterm.cmp(&minterm));
        let row = row.ok().and_then(|i| policy.rows.get_mut(i));
        let Some(slot) = row.and_then(|row| row.values.get_mut(at)) else {
            return Err(TableError {
                span: sheet::whole(cells),
                kind: TableErrorKind::Unseen,
            });
        };
        *slot = Some(Value {
            visits: visits.number("a count")?,
            q: q.finite()?,
            squares: squares.finite()?,
        });
    }
    Ok(())
}
