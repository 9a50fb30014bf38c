//! A tree against a policy table of any origin.

use super::{Proved, trace};
use crate::diagnostic::{Code, Diagnostic};
use crate::driver::compile::counted;
use crate::driver::decanonicalize::rows;
use crate::driver::learn::minterm_text;
use crate::driver::load::Loaded;
use crate::driver::table::{self, Refused, Text};
use crate::driver::target;
use crate::ir::Program;
use crate::policy::table::Table;
use crate::policy::{Minterm, Policy, decisions};
use crate::source::Span;
use crate::tree::atoms::atoms;
use crate::tree::prove::{Refuted, prove};

/// How many rows are listed that a tree decides otherwise.
const LISTED: usize = 10;

/// Proves that a tree takes the decisions of a table: in each row, with memory read from the history, and along the
/// transitions that are given or else in any environment that is consistent with the history window.
///
/// # Errors
/// There is no such tree, or the table cannot be read, or it does not say what the tree asks.
pub fn table(
    loaded: &Loaded,
    name: &str,
    text: Text,
    recorded: Option<(Text, Option<Text>)>,
) -> Result<Proved, Refused> {
    let of_program = |mistake| Refused {
        sources: loaded.sources.clone(),
        diagnostics: vec![mistake],
    };
    let id = target::tree(loaded, name).map_err(of_program)?;
    let read = table::read(text)?;
    let mut program = loaded.program.clone();
    let mut policy = decisions::joined(&read, &mut program);
    if let Some(task) = loaded.program.trees[id].task {
        // The longest memory that either side knows.
        let history = loaded.program.tasks[task].history;
        policy.history.window = policy.history.window.max(history.window);
    }
    if let Some((transitions, starts)) = recorded {
        table::record(&mut policy, &program, transitions, starts)?;
    }
    let sides = Sides {
        program: &program,
        table: &read,
        text,
        tree: name,
        root: &loaded.program.trees[id].root,
        policy,
    };
    sides.prove()
}

/// A tree and the table that it is compared with.
struct Sides<'a> {
    program: &'a Program,
    table: &'a Table,
    text: Text<'a>,
    tree: &'a str,
    root: &'a crate::ir::tree::Node,
    policy: Policy,
}

impl Sides<'_> {
    fn prove(mut self) -> Result<Proved, Refused> {
        let asked = atoms(self.root);
        let untold = asked.iter().find(|atom| !self.policy.atoms.contains(atom));
        if let Some(atom) = untold {
            return self.apart(Refuted::Unknown(*atom));
        }
        let (tree, table) = (self.tree, self.text.name);
        let rows = rows(&self.policy);
        let mut otherwise = Vec::new();
        loop {
            let refuted = match prove(self.root, &self.policy) {
                Ok(proof) if otherwise.is_empty() => {
                    let taken = match proof.transitions {
                        0 => String::new(),
                        n => format!(" and {}", counted(n, "transition")),
                    };
                    return Ok(Proved {
                        holds: true,
                        text: format!(
                            "equal: `{tree}` takes the decisions of {table} in {}{taken}",
                            rows
                        ),
                    });
                }
                Ok(_) | Err(Refuted::Empty) => break,
                Err(refuted) => refuted,
            };
            match refuted {
                Refuted::Decides {
                    minterm,
                    policy,
                    tree: selected,
                } => {
                    let does = |id| self.program.behaviors[id].name.to_string();
                    otherwise.push(format!(
                        "  {}:{}: {}: the table says {}, `{tree}` selects {}",
                        table,
                        self.line(&minterm),
                        minterm_text(self.program, &self.policy, &minterm),
                        does(policy),
                        selected.map_or_else(|| "nothing".to_owned(), does),
                    ));
                    self.policy.rows.retain(|row| !row.speaks_of(&minterm));
                    if otherwise.len() >= LISTED {
                        break;
                    }
                }
                Refuted::Parts(_) | Refuted::Undecided if !otherwise.is_empty() => break,
                other => return self.apart(other),
            }
        }
        let more = match otherwise.len() {
            LISTED => "at least ",
            _ => "",
        };
        let mut lines = vec![format!(
            "different: `{tree}` decides {more}{} of {} of {table} otherwise",
            otherwise.len(),
            rows
        )];
        lines.append(&mut otherwise);
        Ok(Proved {
            holds: false,
            text: lines.join("\n"),
        })
    }

    /// Where the two part, but not in one row alone.
    fn apart(&self, refuted: Refuted) -> Result<Proved, Refused> {
        let (tree, table) = (self.tree, self.text.name);
        let text = match refuted {
            Refuted::Parts(found) => {
                let along = match self.policy.transitions.is_empty() {
                    true => "in an environment consistent with the history window",
                    false => "along the transitions",
                };
                trace::text(self.program, (tree, table), along, &found)
            }
            Refuted::Undecided => {
                format!("undecided: there is too much to explore of `{tree}` and {table}")
            }
            Refuted::Unknown(atom) => {
                let asked = self.program.atom_name(atom);
                return Err(self.refused(
                    Code::E0610,
                    format!("the table does not say whether `{asked}` holds, and `{tree}` asks it"),
                    "there is no such column",
                ));
            }
            Refuted::Irreducible(why) => {
                return Err(self.refused(
                    Code::E0819,
                    format!("`{tree}` has no canonical form to compare with a table"),
                    why.message(),
                ));
            }
            Refuted::Decides { .. } | Refuted::Empty => String::new(),
        };
        Ok(Proved { holds: false, text })
    }

    fn refused(&self, code: Code, message: String, label: &str) -> Refused {
        let header = self.table.header.clone();
        Refused::new(self.text, |file| {
            let span = Span::new(file, header.start, header.end);
            vec![Diagnostic::new(code, span, message).label(label)]
        })
    }

    /// The line of the row that speaks of a minterm.
    fn line(&self, minterm: &Minterm) -> usize {
        let mut rows = self.table.rows().enumerate();
        let at = rows.find(|(_, row)| row.speaks_of(minterm));
        let place = self
            .table
            .place(self.text.bytes, at.map_or(0, |(at, _)| at));
        let before = self.text.bytes.get(..place.start).unwrap_or_default();
        1 + before.iter().filter(|byte| **byte == b'\n').count()
    }
}
