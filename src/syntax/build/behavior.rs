//! Behaviours.

use super::Builder;
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
        let mut parts = Parts::of(node);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut clauses = Vec::new();
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            let span = self.span(&part);
            let kind = match part.as_rule() {
                Rule::stray_mark => {
                    self.stray_mark(&part);
                    continue;
                }
                Rule::close_brace | Rule::missing_close => {
                    self.close(Some(part), open);
                    continue;
                }
                Rule::bad_entry => {
                    self.bad(&part, Rule::strict_clause, previous);
                    ClauseKind::Error
                }
                _ => self.clause(part),
            };
            previous = Some(start);
            clauses.push(Clause { kind, span });
        }
        clauses
    }

    fn clause(&mut self, node: Node<'i>) -> ClauseKind {
        let rule = node.as_rule();
        let mut parts = Parts::of(node);
        parts.next();
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
