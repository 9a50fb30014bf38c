//! The report on a tree that was made from a table.

use crate::ir::Program;
use crate::policy::Policy;
use crate::report::words::{self, counted, rows};
use crate::tree::Size;
use crate::tree::decanonicalise::{Decanonicalised, Loosened};

/// The subject of the report.
pub(super) struct Subject<'a> {
    pub(super) program: &'a Program,
    pub(super) policy: &'a Policy,
    pub(super) exact: &'a Decanonicalised,
    pub(super) slack: Option<&'a Loosened>,
    /// The slack; 0 for none.
    pub(super) allowed: f64,
}

impl Subject<'_> {
    /// Every minterm that the tree decides otherwise than the table.
    pub(super) fn warnings(&self) -> Vec<String> {
        let Some(slack) = self.slack else {
            return Vec::new();
        };
        let name = |id| &self.program.behaviors[id].name;
        let mut lines = vec![format!(
            "warning: the tree is NOT equal to the table: it decides {} of {} otherwise",
            slack.deviations.len(),
            rows(self.policy)
        )];
        lines.extend(slack.deviations.iter().filter_map(|change| {
            let row = self.policy.rows.get(change.row)?;
            Some(format!(
                "  {} instead of {}, worth {:.4} less, in {}",
                name(change.behavior),
                name(row.behavior),
                change.loss,
                words::minterm(self.program, &self.policy.atoms, &row.minterm)
            ))
        }));
        lines
    }

    /// The report in lines.
    pub(super) fn lines(&self) -> Vec<String> {
        let policy = self.policy;
        let mut lines = Vec::new();
        let mut line = |title: &str, text: String| lines.push(words::line(title, &text));
        line(
            "table",
            format!(
                "{} over {}, {}",
                rows(policy),
                counted(policy.atoms.len(), "atom"),
                counted(policy.behaviors.len(), "behaviour")
            ),
        );
        if let Some(paper) = &self.exact.paper_size {
            line("paper", size(paper));
        }
        line("tree", size(&self.exact.size));
        line("proved", format!("on {}", proved(policy, self.exact)));
        match self.slack {
            Some(slack) => line(
                "slack",
                format!(
                    "{}: {}, not equal to the table",
                    self.allowed,
                    size(&slack.found.size)
                ),
            ),
            None if self.allowed > 0.0 => line(
                "slack",
                format!(
                    "{}: no smaller tree, so the tree is the exact one",
                    self.allowed
                ),
            ),
            None => {}
        }
        for failing in &self.exact.failing {
            line("fails", words::failing(self.program, policy, failing));
        }
        lines
    }
}

/// What was proved of a tree, in words.
pub(super) fn proved(policy: &Policy, found: &Decanonicalised) -> String {
    let proof = &found.proof;
    if proof.recorded {
        let closed = if proof.closed {
            "closed under them"
        } else {
            "not closed under them"
        };
        return format!(
            "{} of the table and {}, {closed}",
            rows(policy),
            counted(proof.transitions, "transition")
        );
    }
    let of = format!("{} of the table", rows(policy));
    if found.root.remembers() {
        let window = policy.history.window;
        return format!(
            "{of}, with memory in any environment consistent with a history of {window}"
        );
    }
    of
}

fn size(size: &Size) -> String {
    format!(
        "{}, {}, depth {}",
        counted(size.nodes, "node"),
        counted(size.literals, "literal"),
        size.depth
    )
}
