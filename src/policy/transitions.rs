//! `transitions.csv`: the greedy process, a row per outcome of a decision.
//!
//! The header has the names of the atoms, `behavior`, `status`, the names again as `next:NAME`, and `count`. A start
//! minterm is a row with status `start` whose `next` it is; an ended episode has no next minterm.

use super::error::{TableError, TableErrorKind};
use super::names;
use super::sheet::{self, Cell, Sheet};
use super::{Policy, Transition};
use crate::ir::Program;
use crate::ir::tree::Status;

/// The start minterms and greedy transitions of a policy as text.
pub fn write(policy: &Policy, program: &Program) -> String {
    let names = || {
        let atoms = policy.atoms.iter();
        atoms.map(|atom| program.atom_name(*atom).to_string())
    };
    let fixed = ["behavior", "status"].map(str::to_owned);
    let next = names().map(|name| format!("next:{name}"));
    let header = names()
        .chain(fixed)
        .chain(next)
        .chain(["count".to_owned()])
        .collect();
    let blank = || policy.atoms.iter().map(|_| String::new());
    let starts = policy.starts.iter().map(|(minterm, count)| {
        let decided = [String::new(), "start".to_owned()];
        let row = blank().chain(decided).chain(sheet::cells(minterm));
        row.chain([count.to_string()]).collect()
    });
    let transitions = policy.transitions.iter().map(|t| {
        let decided = [
            program.behaviors[t.behavior].name.to_string(),
            t.status.name().to_owned(),
        ];
        let next: Vec<String> = match &t.to {
            Some(minterm) => sheet::cells(minterm).collect(),
            None => blank().collect(),
        };
        let row = sheet::cells(&t.from).chain(decided).chain(next);
        row.chain([t.count.to_string()]).collect()
    });
    sheet::write(std::iter::once(header).chain(starts).chain(transitions))
}

/// Reads start minterms and greedy transitions into a policy; they replace those that it has.
///
/// # Errors
/// What is wrong with the table, with the place.
pub fn read(text: &str, program: &Program, policy: &mut Policy) -> Result<(), TableError> {
    let sheet = Sheet::read(text)?;
    let from = sheet.columns("", &policy.atoms, program)?;
    let next = sheet.columns("next:", &policy.atoms, program)?;
    let fixed = [
        sheet.column("behavior")?,
        sheet.column("status")?,
        sheet.column("count")?,
    ];
    for (i, cell) in sheet.header.iter().enumerate() {
        if !from.contains(&i) && !next.contains(&i) && !fixed.contains(&i) {
            return Err(cell.error(TableErrorKind::UnknownColumn(cell.text.clone())));
        }
    }
    let names = names::behaviors(program);
    let (mut starts, mut transitions) = (Vec::new(), Vec::new());
    for row in &sheet.rows {
        let [Some(behavior), Some(status), Some(count)] = fixed.map(|i| row.get(i)) else {
            continue;
        };
        let (from, next) = (sheet::at(row, &from), sheet::at(row, &next));
        let count = count.number("a count")?;
        let Some(ended) = outcome(status)? else {
            starts.push((sheet::minterm(&next)?, count));
            continue;
        };
        let over = !next.is_empty() && next.iter().all(|cell| cell.text.is_empty());
        transitions.push(Transition {
            from: sheet::minterm(&from)?,
            behavior: sheet::behavior(behavior, &names)?,
            status: ended,
            to: if over {
                None
            } else {
                Some(sheet::minterm(&next)?)
            },
            count,
        });
    }
    starts.sort();
    transitions.sort();
    policy.starts = starts;
    policy.transitions = transitions;
    Ok(())
}

/// Reads start minterms into a policy, beside those that it has: a column for every atom, and `count` if it is known how
/// many episodes start there.
///
/// # Errors
/// What is wrong with the table, with the place.
pub fn read_starts(text: &str, program: &Program, policy: &mut Policy) -> Result<(), TableError> {
    let sheet = Sheet::read(text)?;
    let atoms = sheet.columns("", &policy.atoms, program)?;
    let count = sheet.header.iter().position(|cell| cell.text == "count");
    for (i, cell) in sheet.header.iter().enumerate() {
        if !atoms.contains(&i) && count != Some(i) {
            return Err(cell.error(TableErrorKind::UnknownColumn(cell.text.clone())));
        }
    }
    for row in &sheet.rows {
        let known = count.and_then(|i| row.get(i));
        let count = known.map_or(Ok(1), |cell| cell.number("a count"))?;
        policy
            .starts
            .push((sheet::minterm(&sheet::at(row, &atoms))?, count));
    }
    policy.starts.sort();
    Ok(())
}

/// How a decision ended; `None` for a start.
fn outcome(cell: &Cell) -> Result<Option<Status>, TableError> {
    let name = cell.text.trim();
    if name == "start" {
        return Ok(None);
    }
    let known = [Status::Success, Status::Failure, Status::Running];
    match known.into_iter().find(|status| status.name() == name) {
        Some(status) => Ok(Some(status)),
        None => Err(cell.error(TableErrorKind::UnknownValue {
            found: cell.text.clone(),
            expected: "`start`, `success`, `failure` or `running`",
        })),
    }
}
