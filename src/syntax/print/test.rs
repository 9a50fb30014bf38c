//! Tests of trees without a world.

use super::Printer;
use super::columns::Align;
use super::doc::{Doc, Entry, row};
use crate::source::Span;
use crate::syntax::ast::{Expr, Step, Test, TestLine, TestLineKind};

impl Printer<'_> {
    pub(super) fn test<'a>(&self, test: &'a Test, span: Span) -> Doc<'a> {
        let lines = test.lines.iter().map(|line| self.test_line(line));
        let braces = self.braces(test.tree.span.range().end, span, lines.collect());
        let title = test.title.name.as_str();
        let tree = self.call(&test.tree).flat();
        row!["test \"", title, "\" of ", tree, " ", braces]
    }

    /// A line; those of adjacent ticks have their arrows in a column.
    fn test_line<'a>(&self, line: &'a TestLine) -> Entry<'a> {
        let (align, doc) = match &line.kind {
            TestLineKind::Given(changes) => (Align::None, row!["given ", self.changes(changes)]),
            TestLineKind::Tick {
                changes,
                lasting,
                steps,
            } => {
                let mut before = vec![self.changes(changes)];
                if let Some(time) = lasting {
                    let word = if changes.is_empty() { "for " } else { " for " };
                    before.push(row![word, self.expr(time).flat()]);
                }
                let steps = separated(steps.iter().map(|step| self.step(step)));
                let doc = row![
                    "tick",
                    Doc::column(),
                    Doc::row(before),
                    Doc::column(),
                    "=> ",
                    steps
                ];
                (Align::Of("tick"), doc)
            }
            TestLineKind::Error => (Align::None, Doc::nothing()),
        };
        Entry::aligned(line.span, align, doc)
    }

    fn changes<'a>(&self, changes: &'a [Expr]) -> Doc<'a> {
        separated(changes.iter().map(|change| self.expr(change).flat()))
    }

    fn step<'a>(&self, step: &'a Step) -> Doc<'a> {
        let name = self.call(&step.name).flat();
        match step.answer {
            Some(answer) => row![name, " ", answer.node.spelling()],
            None => name,
        }
    }
}

/// Parts with commas between them.
fn separated<'a>(parts: impl Iterator<Item = Doc<'a>>) -> Doc<'a> {
    let mut row = Vec::new();
    for part in parts {
        if !row.is_empty() {
            row.push(Doc::from(", "));
        }
        row.push(part);
    }
    Doc::row(row)
}
