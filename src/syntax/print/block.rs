//! Statements, and everything else in braces.

use super::Printer;
use super::columns::Align;
use super::doc::{Brackets, Break, Doc, Entry, row};
use super::names::ident;
use crate::source::Span;
use crate::syntax::ast::{Block, Branch, Else, Stmt, StmtKind};

impl Printer<'_> {
    /// A block: at most one plain statement stays on one line if it was written so; without a source, unless it is
    /// to be `broken`.
    pub(super) fn block<'a>(&self, block: &'a Block, broken: bool) -> Doc<'a> {
        let is_plain =
            |stmt: &Stmt| matches!(stmt.kind, StmtKind::Assign { .. } | StmtKind::Call(_));
        let is_short = block.stmts.len() <= 1 && block.stmts.iter().all(is_plain);
        let broken = !is_short || self.is_broken(block.span).unwrap_or(broken);
        let stmts = block.stmts.iter().map(|stmt| self.stmt(stmt)).collect();
        let list = Doc::list(Brackets::BLOCK, block.span, stmts)
            .grouped(block.span, Break::always_if(broken));
        row![Doc::hoist(block.span.range().start), list]
    }

    fn stmt<'a>(&self, stmt: &'a Stmt) -> Entry<'a> {
        let doc = match &stmt.kind {
            StmtKind::Let(binding) => {
                return Entry::aligned(stmt.span, Align::Of("let"), self.binding(binding));
            }
            StmtKind::For {
                name,
                domain,
                block,
            } => row![
                "for ",
                ident(name),
                " in ",
                ident(domain),
                " ",
                self.block(block, true)
            ],
            StmtKind::Branch(branch) => self.branch(branch),
            StmtKind::Assign { target, op, value } => row![
                self.call(target).flat(),
                " ",
                op.node.spelling(),
                " ",
                self.expr(value)
            ],
            StmtKind::Call(call) => self.call(call),
            StmtKind::Error => Doc::nothing(),
        };
        Entry::new(stmt.span, doc)
    }

    fn branch<'a>(&self, branch: &'a Branch) -> Doc<'a> {
        let cond = self.expr(&branch.cond).room(" {".len());
        let then = self.block(&branch.then, true);
        match branch.otherwise.as_deref() {
            None => row!["if ", cond, " ", then],
            Some(otherwise) => {
                let then = then.room(" else {".len());
                let otherwise = match otherwise {
                    Else::If(next) => self.branch(next),
                    Else::Block(block) => self.block(block, true),
                };
                row!["if ", cond, " ", then, " else ", otherwise]
            }
        }
    }

    /// Entries in the braces that follow byte `head` and end with `span`, one a line.
    pub(super) fn braces<'a>(&self, head: usize, span: Span, entries: Vec<Entry<'a>>) -> Doc<'a> {
        let inside = self.braces_after(head, span);
        let broken = if entries.is_empty() {
            Break::Never
        } else {
            Break::Always
        };
        let list = Doc::list(Brackets::BLOCK, inside, entries).grouped(inside, broken);
        row![Doc::hoist(inside.range().start), list]
    }

    /// From the first brace after byte `head` to the end of `span`.
    pub(super) fn braces_after(&self, head: usize, span: Span) -> Span {
        let open = self.source.map_or(0, |source| source.brace_after(head));
        Span::new(span.file, open, span.range().end)
    }

    /// Whether `span` goes over several lines in the source, if there is one.
    pub(super) fn is_broken(&self, span: Span) -> Option<bool> {
        self.source.map(|source| source.is_broken(span))
    }
}
