//! The report on a tree that was made from a table.

use super::words::{self, counted, rows};
use crate::ir::Program;
use crate::policy::Policy;
use crate::tree::Size;
use crate::tree::decanonicalise::{Decanonicalised, Loosened, Stage};

/// What there is to report of a table of numbers and words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Values {
    /// Its rows.
    pub rows: usize,
    /// The columns that hold more than truth values.
    pub inputs: usize,
}

/// What there is to report of a tree that was made from a table.
#[derive(Clone, Copy, Debug)]
pub struct Report<'a> {
    /// The policy of the table.
    pub policy: &'a Policy,
    /// The rows that allow several behaviours, of which the policy takes one.
    pub several: usize,
    /// What the table holds, if that is more than truth values.
    pub values: Option<Values>,
    /// The tree that is equal to the table.
    pub exact: &'a Decanonicalised,
    /// The smaller tree that slack allows, if there is one.
    pub loosened: Option<&'a Loosened>,
    /// The slack; 0 for none.
    pub slack: f64,
}

impl Report<'_> {
    /// Where the tree comes from and what was proved of it, as a doc comment.
    pub fn doc(&self, source: &str) -> String {
        match self.loosened {
            Some(loosened) => format!(
                "Made from {source} with a slack of {}, and NOT equal to it: it decides {} of {} otherwise.",
                self.slack,
                loosened.deviations.len(),
                rows(self.policy)
            ),
            None if self.several > 0 => format!(
                "Made from {source}: proved to take an allowed behaviour on {}; {} of them allow several.",
                self.proved(),
                self.several
            ),
            None => format!("Made from {source}: proved on {}.", self.proved()),
        }
    }

    /// Every minterm that the tree decides otherwise than the table.
    pub fn warnings(&self, program: &Program) -> Vec<String> {
        let Some(loosened) = self.loosened else {
            return Vec::new();
        };
        let name = |id| &program.behaviors[id].name;
        let mut lines = vec![format!(
            "warning: the tree is NOT equal to the table: it decides {} of {} otherwise",
            loosened.deviations.len(),
            rows(self.policy)
        )];
        lines.extend(loosened.deviations.iter().filter_map(|change| {
            let row = self.policy.rows.get(change.row)?;
            Some(format!(
                "  {} instead of {}, worth {:.4} less, in {}",
                name(change.behavior),
                name(row.behavior),
                change.loss,
                words::minterm(program, &self.policy.atoms, &row.minterm)
            ))
        }));
        lines
    }

    /// The report in lines.
    pub fn lines(&self, program: &Program) -> Vec<String> {
        let policy = self.policy;
        let mut lines = Vec::new();
        let mut line = |title: &str, text: String| lines.push(words::line(title, &text));
        let over = match self.values {
            Some(values) => format!(
                "{} with {}, which come to {}",
                counted(values.rows, "row"),
                counted(values.inputs, "input"),
                rows(policy)
            ),
            None => rows(policy),
        };
        line(
            "table",
            format!(
                "{over} over {}, {}",
                counted(policy.atoms.len(), "atom"),
                counted(policy.behaviors.len(), "behaviour")
            ),
        );
        if self.several > 0 {
            let title = "allowed";
            line(
                title,
                format!("several behaviours in {} of the rows", self.several),
            );
        }
        if let Some(paper) = &self.exact.paper_size {
            line("paper", size(paper));
        }
        line("tree", size(&self.exact.size));
        if !self.exact.unfinished.is_empty() {
            let stages = self.exact.unfinished.iter().map(|stage| match stage {
                Stage::Paper => "Algorithm 1",
                Stage::Memory => "which behaviours memory nodes join",
                Stage::Search => "the search for smaller trees",
            });
            let stages: Vec<&str> = stages.collect();
            line(
                "unfinished",
                format!("{}: a greater effort goes further", stages.join(", ")),
            );
        }
        line("proved", format!("on {}", self.proved()));
        match self.loosened {
            Some(loosened) => line(
                "slack",
                format!(
                    "{}: {}, not equal to the table",
                    self.slack,
                    size(&loosened.found.size)
                ),
            ),
            None if self.slack > 0.0 => line(
                "slack",
                format!(
                    "{}: no smaller tree, so the tree is the exact one",
                    self.slack
                ),
            ),
            None => {}
        }
        for failing in &self.exact.failing {
            line(
                "fails",
                words::failing(program, policy, failing, "the tree"),
            );
        }
        lines
    }

    /// What was proved of the tree, in words.
    fn proved(&self) -> String {
        let (policy, found) = (self.policy, self.exact);
        let rows = match self.values {
            Some(values) => counted(values.rows, "row"),
            None => rows(policy),
        };
        let proof = &found.proof;
        if proof.recorded {
            let closed = if proof.closed {
                "closed under them"
            } else {
                "not closed under them"
            };
            return format!(
                "{rows} of the table and {}, {closed}",
                counted(proof.transitions, "transition")
            );
        }
        let of = format!("{rows} of the table");
        if found.root.remembers() {
            let window = policy.history.window;
            return format!(
                "{of}, with memory in any environment consistent with a history of {window}"
            );
        }
        of
    }
}

fn size(size: &Size) -> String {
    format!(
        "{}, {}, depth {}",
        counted(size.nodes, "node"),
        counted(size.literals, "literal"),
        size.depth
    )
}
