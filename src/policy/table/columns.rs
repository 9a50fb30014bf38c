//! What the columns of a table say.

use super::Reading;
use crate::policy::error::{TableError, TableErrorKind};
use crate::policy::names::{self, AtomName};
use crate::spelling::bare;
use std::collections::BTreeSet;
use std::ops::Range;

/// How the column is called that says what is done.
pub(in crate::policy) const BEHAVIOR: [&str; 3] = ["behavior", "behaviour", "action"];

/// What parts columns in files of other tools.
const SEPARATORS: [char; 2] = [';', '\t'];

/// What a column says.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Role {
    /// The value of an atom, by its number.
    Atom(usize),
    /// What is done.
    Behavior,
    /// How many decisions stand behind the row.
    Visits,
    /// The value of a behaviour, by the number of the column among those of values.
    Value(usize),
    /// Nothing that is not said elsewhere: `q_gap`.
    Ignored,
}

impl Reading {
    /// The roles of the columns of these names. Mistakes are reported; a column with one is ignored.
    pub(super) fn columns(
        &mut self,
        columns: Vec<(String, Range<usize>)>,
        header: Range<usize>,
    ) -> Vec<Role> {
        if let Some(error) = separated(&columns, &header) {
            self.stop(error);
            return Vec::new();
        }
        let mut known: BTreeSet<String> = BTreeSet::new();
        let mut decides: Option<String> = None;
        let mut roles = Vec::with_capacity(columns.len());
        for (name, place) in &columns {
            let role = if known.insert(without_backquotes(name)) {
                self.role(name, place, &mut decides)
            } else {
                Err(TableErrorKind::RepeatedColumn(without_backquotes(name)))
            };
            roles.push(role.unwrap_or_else(|kind| {
                self.report(place, kind);
                Role::Ignored
            }));
        }
        if decides.is_none() {
            let likely = columns.iter().map(|(name, _)| name).find(|name| {
                let name = name.to_ascii_lowercase();
                BEHAVIOR.contains(&name.trim_end_matches('s'))
            });
            let kind = TableErrorKind::MissingColumn {
                name: "behavior".to_owned(),
                likely: likely.cloned(),
            };
            self.stop(TableError {
                span: header.clone(),
                kind,
            });
        }
        self.header = header;
        self.rows = super::Rows::new(self.atoms.len(), self.values.len());
        roles
    }

    fn role(
        &mut self,
        name: &str,
        place: &Range<usize>,
        decides: &mut Option<String>,
    ) -> Result<Role, TableErrorKind> {
        if name.is_empty() {
            return Err(TableErrorKind::Nameless);
        }
        if BEHAVIOR.contains(&name) {
            return match decides.replace(name.to_owned()) {
                Some(first) if first != name => {
                    Err(TableErrorKind::SecondBehavior(name.to_owned()))
                }
                _ => Ok(Role::Behavior),
            };
        }
        if let Some(behavior) = name.strip_prefix("q:") {
            return self.value(behavior, place).map(Role::Value);
        }
        match name {
            "visits" => return Ok(Role::Visits),
            "q_gap" => return Ok(Role::Ignored),
            _ => {}
        }
        let atom = AtomName::read(name);
        atom.check()?;
        self.atoms.push((atom, place.clone()));
        Ok(Role::Atom(self.atoms.len() - 1))
    }
}

impl Reading {
    /// A column for the value of a behaviour.
    fn value(&mut self, behavior: &str, place: &Range<usize>) -> Result<usize, TableErrorKind> {
        let behavior = bare(behavior);
        names::check(behavior)?;
        let number = self.behaviors.number(behavior, place.clone());
        self.values.push(number);
        Ok(self.values.len() - 1)
    }

    /// A column for the value of a behaviour that no row before has; `None` if nothing can be called so.
    pub(super) fn another_value(&mut self, behavior: &str, place: &Range<usize>) -> Option<usize> {
        let column = self.value(behavior, place);
        if column.is_ok() {
            self.rows.another_value();
            self.draft.another_value();
        }
        column.map_err(|kind| self.report(place, kind)).ok()
    }
}

/// What is wrong with a header of one column that something else than a comma parts.
pub(in crate::policy) fn separated(
    columns: &[(String, Range<usize>)],
    header: &Range<usize>,
) -> Option<TableError> {
    let [(name, _)] = columns else {
        return None;
    };
    let separator = name.chars().find(|c| SEPARATORS.contains(c))?;
    Some(TableError {
        span: header.clone(),
        kind: TableErrorKind::Separator(separator),
    })
}

/// The name of a column without backquotes: two of the same are one column twice.
fn without_backquotes(column: &str) -> String {
    match column.strip_prefix("q:") {
        Some(behavior) => format!("q:{}", bare(behavior)),
        None => AtomName::read(column).to_string(),
    }
}
