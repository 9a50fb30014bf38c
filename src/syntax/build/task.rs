//! Tasks.

use super::Builder;
use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{Aspect, AspectKind, Expr, Outcome, Start, StartLine, Task};
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn task(&mut self, node: Node<'i>) -> Task {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_task);
        let name = self.take_name(&mut parts);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut aspects = Vec::new();
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
                    self.bad(&part, Rule::strict_aspect, previous);
                    AspectKind::Error
                }
                Rule::start => AspectKind::Start(self.start(part)),
                Rule::reward => self.reward(part),
                _ => self.aspect(part),
            };
            previous = Some(start);
            aspects.push(Aspect { kind, span });
        }
        Task { name, aspects }
    }

    fn aspect(&mut self, node: Node<'i>) -> AspectKind {
        let rule = node.as_rule();
        let mut parts = Parts::of(node);
        parts.next();
        match rule {
            Rule::observe => AspectKind::Observe(self.list(&mut parts)),
            Rule::choose => AspectKind::Choose(self.list(&mut parts)),
            Rule::history => {
                parts.has(Rule::kw_last);
                let window = self.take_expr(&mut parts);
                let outcomes = parts
                    .into_iter()
                    .filter(|part| part.as_rule() == Rule::outcome)
                    .map(|part| {
                        let outcome = match part.as_str() {
                            "success" => Outcome::Success,
                            _ => Outcome::Failure,
                        };
                        self.spanned(&part, outcome)
                    })
                    .collect();
                AspectKind::History { window, outcomes }
            }
            Rule::patience => AspectKind::Patience(self.take_expr(&mut parts)),
            Rule::end_on => {
                parts.has(Rule::kw_on);
                AspectKind::EndOn(self.take_expr(&mut parts))
            }
            Rule::end_after => {
                parts.has(Rule::kw_after);
                AspectKind::EndAfter(self.take_expr(&mut parts))
            }
            _ => AspectKind::Error,
        }
    }

    fn list(&mut self, parts: &mut Parts<'i>) -> Vec<Expr> {
        let mut exprs: Vec<Expr> = Vec::new();
        let Some(list) = parts.maybe(Rule::list) else {
            return exprs;
        };
        for part in Parts::of(list) {
            match part.as_rule() {
                Rule::missing_comma => {
                    let before = exprs.last().map(|expr| expr.span);
                    self.missing_comma(&part, before, "the entries of a list");
                }
                Rule::list_item => exprs.push(self.take_expr(&mut Parts::of(part))),
                _ => {}
            }
        }
        exprs
    }

    pub(super) fn start(&mut self, node: Node<'i>) -> Start {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_start);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut lines = Vec::new();
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            match part.as_rule() {
                Rule::stray_mark => self.stray_mark(&part),
                Rule::close_brace | Rule::missing_close => self.close(Some(part), open),
                Rule::bad_entry => {
                    self.bad(&part, Rule::strict_start_line, previous);
                    previous = Some(start);
                }
                _ => {
                    previous = Some(start);
                    lines.extend(self.start_line(part));
                }
            }
        }
        Start { lines, span }
    }

    fn start_line(&mut self, node: Node<'i>) -> Option<StartLine> {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let target = self.reference(parts.maybe(Rule::r#ref)?);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        Some(StartLine {
            target,
            value,
            span,
        })
    }

    fn reward(&mut self, node: Node<'i>) -> AspectKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_reward);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut lines = Vec::new();
        let mut otherwise = None;
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            match part.as_rule() {
                Rule::stray_mark => self.stray_mark(&part),
                Rule::close_brace | Rule::missing_close => self.close(Some(part), open),
                Rule::bad_reward => {
                    self.bad(&part, Rule::strict_reward, previous);
                    previous = Some(start);
                }
                Rule::otherwise => {
                    previous = Some(start);
                    let mut parts = Parts::of(part);
                    parts.has(Rule::kw_otherwise);
                    self.take_reward_colon(&mut parts);
                    otherwise = Some(self.take_expr(&mut parts));
                }
                _ => {
                    previous = Some(start);
                    let span = self.span(&part);
                    lines.push(self.reward_line(part, span));
                }
            }
        }
        AspectKind::Reward { lines, otherwise }
    }

    fn reward_line(&mut self, node: Node<'i>, span: Span) -> crate::syntax::ast::RewardLine {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_on);
        let event = self.take_expr(&mut parts);
        self.take_reward_colon(&mut parts);
        let value = self.take_expr(&mut parts);
        crate::syntax::ast::RewardLine { event, value, span }
    }

    fn take_reward_colon(&mut self, parts: &mut Parts<'i>) {
        if let Some(node) = parts.maybe(Rule::reward_colon)
            && node.as_str() != ":"
        {
            let span = self.span(&node);
            let written = node.as_str();
            self.respell(
                Code::E0127,
                span,
                format!("a reward follows a `:`, not a `{written}`"),
                ":",
            );
        }
    }
}
