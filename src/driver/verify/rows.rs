//! A tree against a policy table of any origin.

use super::{Proved, values};
use crate::diagnostic::{Code, Diagnostic};
use crate::driver::load::Loaded;
use crate::driver::table::Recorded;
use crate::driver::{Refused, Text, allowed, table, target};
use crate::ir::Program;
use crate::ir::tree::Node;
use crate::policy::reader::{Format, Given};
use crate::policy::table::Table;
use crate::policy::{Minterm, Policy, decisions};
use crate::report::verdict::{Answer, difference};
use crate::report::words::{self, counted, rows};
use crate::source::Span;
use crate::tree::disagreement::{Compared, compare};
use crate::tree::prove::Refuted;

/// The most rows to list that a tree decides otherwise.
const LISTED: usize = 10;

/// Proves that a tree takes the decisions of a table: in each row, with memory read from the history, and in any
/// environment that is consistent with the history window; or, where transitions are given, along these, and at least in
/// the rows that they meet. Where they part and the main file names an environment, they are compared along that.
///
/// # Errors
/// There is no such tree, or the table cannot be read, or it does not say what the tree asks.
pub fn table(
    loaded: &Loaded,
    name: &str,
    of: (Text, Option<Format>),
    recorded: Option<Recorded>,
) -> Result<Proved, Refused> {
    let found = against(loaded, name, of, recorded)?;
    let named = loaded.tables.first().filter(|_| recorded.is_none());
    let source = named.and_then(|(file, _)| loaded.sources.get(*file));
    let Some(source) = source.filter(|_| !found.holds()) else {
        return Ok(found);
    };
    let transitions = Text {
        name: &source.name,
        bytes: source.text.as_bytes(),
    };
    let recorded = Recorded {
        transitions,
        starts: None,
    };
    match against(loaded, name, of, Some(recorded)) {
        Ok(along) if along.holds() => Ok(Proved {
            text: format!(
                "{}\n  along {}, which the file names",
                along.text, source.name
            ),
            ..along
        }),
        _ => Ok(found),
    }
}

/// Compares a tree with a table, along these transitions if there are any.
fn against(
    loaded: &Loaded,
    name: &str,
    (text, from): (Text, Option<Format>),
    recorded: Option<Recorded>,
) -> Result<Proved, Refused> {
    let id = target::tree(loaded, name)?;
    let read = match table::read(text, from)? {
        Given::Truths(table) => table,
        Given::Values(values) => {
            if let Some(recorded) = recorded {
                return Err(values::no_transitions(recorded.transitions));
            }
            return values::table(loaded, id, text, &values);
        }
    };
    let mut program = loaded.program.clone();
    let mut policy = decisions::joined(&read, &mut program);
    if let Some(task) = loaded.program.trees[id].task {
        // The longer memory of the two sides.
        let history = loaded.program.tasks[task].history;
        policy.history.window = policy.history.window.max(history.window);
    }
    if read.has_sets() {
        let root = &loaded.program.trees[id].root;
        let taken = match recorded {
            Some(_) => None,
            None => allowed::as_tree((&mut policy, &read), root),
        };
        if taken.is_none() {
            let message = "rows that allow several behaviours are compared with trees without memory, which may divide them into a million parts";
            return Err(allowed::refused(text, read.header.clone(), message));
        }
    }
    if let Some(recorded) = recorded {
        table::record(&mut policy, &program, recorded)?;
    }
    let sides = Sides {
        program: &program,
        table: &read,
        text,
        tree: name,
        root: &loaded.program.trees[id].root,
        beside: 0,
        policy,
    };
    sides.prove()
}

/// What holds of a tree whose memory alone parts it from a table.
fn agrees(rows: &str) -> String {
    format!(
        "  with memory read from the history they agree in {rows}; a memory node starts over where a tick does not reach \
         it, and the history stays\n  `--transitions FILE` compares them in an environment that was recorded"
    )
}

/// A tree and the table that it is compared with.
struct Sides<'a> {
    program: &'a Program,
    table: &'a Table,
    text: Text<'a>,
    tree: &'a str,
    root: &'a Node,
    policy: Policy,
    /// Rows that are left out: nothing was recorded there.
    beside: usize,
}

impl Sides<'_> {
    /// The same with the minterms alone in which something was recorded; `None` if that is all of them.
    fn recorded(&self) -> Option<Self> {
        let mut policy = self.policy.clone();
        policy.keep_recorded();
        let beside = self.policy.rows.len() - policy.rows.len();
        (beside > 0).then_some(Self {
            policy,
            beside,
            ..*self
        })
    }

    fn prove(&self) -> Result<Proved, Refused> {
        let (tree, table) = (self.tree, self.text.name);
        let rows = match self.beside {
            0 => rows(&self.policy),
            beside => format!(
                "{} (nothing was recorded in {})",
                rows(&self.policy),
                counted(beside, "other")
            ),
        };
        let found = match compare(self.root, &self.policy, LISTED) {
            Ok(Compared::Equal(proof)) => {
                let recorded = self.policy.transitions.len();
                if proof.transitions == 0 && recorded > 0 {
                    return Ok(Proved {
                        answer: Answer::Undecided,
                        text: format!(
                            "undecided: `{tree}` takes the decisions of {table} in {rows}, but none of the {} \
                             that were recorded",
                            counted(recorded, "transition")
                        ),
                    });
                }
                let taken = match proof.transitions {
                    0 => String::new(),
                    n => format!(" and {}", counted(n, "transition")),
                };
                return Ok(Proved {
                    answer: Answer::Holds,
                    text: format!(
                        "equal: `{tree}` takes the decisions of {table} in {rows}{taken}"
                    ),
                });
            }
            Ok(Compared::Differs(found)) => match self.recorded() {
                Some(recorded) => return recorded.prove(),
                None => found,
            },
            Err(refuted) => return self.parted(refuted),
        };
        let more = match found.len() {
            LISTED => "at least ",
            _ => "",
        };
        let mut lines = vec![format!(
            "different: `{tree}` decides {more}{} of {rows} of {table} otherwise",
            found.len()
        )];
        let does = |id| self.program.behaviors[id].name.to_string();
        lines.extend(found.iter().map(|found| {
            format!(
                "  {table}:{}: {}: the table says {}, `{tree}` selects {}",
                self.line(&found.minterm),
                words::minterm(self.program, &self.policy.atoms, &found.minterm),
                self.allowed(&found.minterm)
                    .unwrap_or_else(|| does(found.table)),
                found.tree.map_or_else(|| "nothing".to_owned(), does),
            )
        }));
        Ok(Proved {
            answer: Answer::Fails,
            text: lines.join("\n"),
        })
    }

    /// The tree and the table part along a path, or cannot be compared.
    fn parted(&self, refuted: Refuted) -> Result<Proved, Refused> {
        let (tree, table) = (self.tree, self.text.name);
        let answer = match refuted {
            Refuted::Undecided => Answer::Undecided,
            _ => Answer::Fails,
        };
        let text = match refuted {
            Refuted::Parts(found) => {
                let recorded = !self.policy.transitions.is_empty();
                let along = match recorded {
                    false => "in an environment consistent with the history window",
                    true => "along the transitions",
                };
                let parts = difference(self.program, (tree, table), along, &found);
                match recorded {
                    true => parts,
                    false => format!("{parts}\n{}", agrees(&rows(&self.policy))),
                }
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
        Ok(Proved { answer, text })
    }

    fn refused(&self, code: Code, message: String, label: &str) -> Refused {
        let header = self.table.header.clone();
        Refused::text(self.text, |file| {
            let span = Span::new(file, header.start, header.end);
            vec![Diagnostic::new(code, span, message).label(label)]
        })
    }

    /// The behaviours that the row of a minterm allows.
    fn allowed(&self, minterm: &Minterm) -> Option<String> {
        let mut rows = self.table.rows().zip(self.table.allowed());
        let (_, allowed) = rows.find(|(row, _)| row.speaks_of(minterm))?;
        let named = |number: usize| {
            self.table
                .behaviors
                .get(number)
                .map(|(name, _)| name.as_str())
        };
        let names: Option<Vec<&str>> = allowed.into_iter().map(named).collect();
        Some(names?.join("|"))
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
