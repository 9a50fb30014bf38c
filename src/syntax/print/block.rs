//! Statements.

use super::columns::Group;
use super::{Printer, WIDTH, flat};
use crate::syntax::ast::{Block, Branch, Else, Stmt, StmtKind};

impl Printer<'_> {
    /// A block that `after` more characters follow on its last line: on one line if it was written so and fits.
    pub(super) fn block(&mut self, block: &Block, after: usize) {
        self.hoist(block.span.range().start);
        if let Some(text) = one_line(block)
            && !self.has_comment(block.span)
            && !self
                .is_written_broken(block.span)
                .unwrap_or(self.indent > 0)
            && self.column() + text.chars().count() + after <= WIDTH
        {
            self.write(&text);
            return;
        }
        self.open_block(Group::None);
        self.trailing(block.span.range().start + 1);
        for stmt in &block.stmts {
            self.entry(stmt.span, |printer| printer.stmt(stmt));
        }
        self.rest_of_block(block.span.range().end.saturating_sub(1));
        self.close_block();
    }

    fn stmt(&mut self, stmt: &Stmt) {
        match &stmt.kind {
            StmtKind::Let(binding) => self.binding(binding),
            StmtKind::For {
                name,
                domain,
                block,
            } => {
                self.write(&format!(
                    "for {} in {} ",
                    flat::ident(name),
                    flat::ident(domain)
                ));
                self.block(block, 0);
                self.end_line(Group::None);
            }
            StmtKind::Branch(branch) => {
                self.branch(branch);
                self.end_line(Group::None);
            }
            StmtKind::Assign { target, op, value } => {
                self.write(&format!(
                    "{} {} ",
                    flat::reference(target),
                    flat::assign_op(op.node)
                ));
                self.expr(value, 0);
                self.end_line(Group::None);
            }
            StmtKind::Call(call) => {
                self.call(call, 0);
                self.end_line(Group::None);
            }
            StmtKind::Error => self.end_line(Group::None),
        }
    }

    fn branch(&mut self, branch: &Branch) {
        self.write("if ");
        self.expr(&branch.cond, 2);
        self.write(" ");
        self.block(
            &branch.then,
            if branch.otherwise.is_some() {
                " else {".len()
            } else {
                0
            },
        );
        match branch.otherwise.as_deref() {
            Some(Else::If(next)) => {
                self.write(" else ");
                self.branch(next);
            }
            Some(Else::Block(block)) => {
                self.write(" else ");
                self.block(block, 0);
            }
            None => {}
        }
    }
}

/// A block of at most one plain statement, on one line.
fn one_line(block: &Block) -> Option<String> {
    match block.stmts.as_slice() {
        [] => Some("{}".to_owned()),
        [stmt] => {
            let text = match &stmt.kind {
                StmtKind::Assign { target, op, value } => {
                    let target = flat::reference(target);
                    format!(
                        "{target} {} {}",
                        flat::assign_op(op.node),
                        flat::expr(value)
                    )
                }
                StmtKind::Call(call) => flat::reference(call),
                _ => return None,
            };
            Some(format!("{{ {text} }}"))
        }
        _ => None,
    }
}
