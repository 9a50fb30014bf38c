//! Behaviours.

use super::Builder;
use crate::diagnostic::Code;
use crate::syntax::ast::{Behavior, BehaviorBody, Clause, ClauseKind};
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn behavior(&mut self, node: Node<'i>) -> Behavior {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_behavior);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        let body = if let Some(node) = parts.maybe(Rule::clauses) {
            BehaviorBody::Clauses(self.clauses(node))
        } else if self.take_is(&mut parts)
            && let Some(node) = parts.maybe(Rule::r#ref)
        {
            BehaviorBody::Alias(self.reference(node))
        } else {
            BehaviorBody::Declared
        };
        Behavior { name, params, body }
    }

    fn clauses(&mut self, node: Node<'i>) -> Vec<Clause> {
        let mut clauses = Vec::new();
        self.entries(
            Parts::of(node),
            Rule::strict_clause,
            |builder, node, span| {
                let kind = node.map_or(ClauseKind::Error, |node| builder.clause(node));
                clauses.push(Clause { kind, span });
            },
        );
        clauses
    }

    fn clause(&mut self, node: Node<'i>) -> ClauseKind {
        let rule = node.as_rule();
        let mut parts = Parts::of(node);
        if let Some(first) = parts.next()
            && first.as_rule() == Rule::wrong_control
        {
            let message = "what a behaviour does in every tick is its `control`".to_owned();
            self.respell(Code::E0123, self.span(&first), message, "control");
        }
        match rule {
            Rule::local => {
                let name = self.take_name(&mut parts);
                let ty = self.maybe_type(&mut parts);
                self.take_is(&mut parts);
                let value = self.take_expr(&mut parts);
                ClauseKind::Local { name, ty, value }
            }
            Rule::requires => ClauseKind::Requires(self.take_expr(&mut parts)),
            Rule::succeed_when => {
                parts.has(Rule::kw_when);
                ClauseKind::Succeed(self.take_expr(&mut parts))
            }
            Rule::fail_when => {
                parts.has(Rule::kw_when);
                ClauseKind::Fail(self.take_expr(&mut parts))
            }
            Rule::control => ClauseKind::Control(self.take_block(&mut parts)),
            _ => ClauseKind::Error,
        }
    }
}
