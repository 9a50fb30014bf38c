//! Tasks.

use super::Builder;
use super::commas::HISTORY;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    Aspect, AspectKind, Expr, Outcome, Paid, RewardLine, Start, StartLine, Task,
};
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn task(&mut self, node: Node<'i>) -> Task {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_task);
        let name = self.take_name(&mut parts);
        let mut aspects = Vec::new();
        self.entries(parts, Rule::strict_aspect, |builder, node, span| {
            let kind = node.map_or(AspectKind::Error, |node| builder.aspect(node));
            aspects.push(Aspect { kind, span });
        });
        Task { name, aspects }
    }

    fn aspect(&mut self, node: Node<'i>) -> AspectKind {
        let rule = node.as_rule();
        if rule == Rule::start {
            return AspectKind::Start(self.start(node));
        }
        let mut parts = Parts::of(node);
        parts.next();
        match rule {
            Rule::reward => self.reward(parts),
            Rule::observe => AspectKind::Observe(self.list(&mut parts)),
            Rule::choose => AspectKind::Choose(self.list(&mut parts)),
            Rule::history => {
                parts.has(Rule::kw_last);
                let window = self.take_expr(&mut parts);
                let parts = self.history_commas(parts);
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
                let event = self.take_expr(&mut parts);
                if let Some(comma) = parts.maybe(Rule::wrong_comma) {
                    let diagnostic = Diagnostic::new(
                        Code::E0101,
                        self.span(&comma),
                        "an end waits for one event, found `,`",
                    )
                    .label("a second one follows")
                    .help("write a line for each, `end on A` and `end on B`, or join them: `end on A or B`");
                    self.report(diagnostic);
                    return AspectKind::Error;
                }
                AspectKind::EndOn(event)
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
                Rule::stray_mark => {
                    let span = self.span(&part);
                    self.stray_mark(span);
                }
                Rule::list_item => {
                    self.in_list = true;
                    exprs.push(self.take_expr(&mut Parts::of(part)));
                    self.in_list = false;
                }
                _ => {}
            }
        }
        exprs
    }

    pub(super) fn start(&mut self, node: Node<'i>) -> Start {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_start);
        if let Some(wrong) = parts.maybe(Rule::wrong_start) {
            let message = "how an episode begins is said by `start`".to_owned();
            self.respell(Code::E0123, self.span(&wrong), message, "start");
        }
        let mut lines = Vec::new();
        self.entries(parts, Rule::strict_start_line, |builder, node, span| {
            lines.extend(node.and_then(|node| builder.start_line(node, span)));
        });
        Start { lines, span }
    }

    fn start_line(&mut self, node: Node<'i>, span: Span) -> Option<StartLine> {
        let mut parts = Parts::of(node);
        let target = self.reference(parts.maybe(Rule::r#ref)?);
        if self.fields_of_target(&mut parts, &target) {
            return None;
        }
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        Some(StartLine {
            target,
            value,
            span,
        })
    }

    fn reward(&mut self, parts: Parts<'i>) -> AspectKind {
        let mut lines = Vec::new();
        let mut otherwise: Option<Expr> = None;
        let mut last: Option<Span> = None;
        // One `otherwise` that stands too early is one mistake, however many lines follow it.
        let mut told = false;
        self.entries(parts, Rule::strict_reward, |builder, node, span| {
            let Some(node) = node else { return };
            let rule = node.as_rule();
            if let Some(last) = last
                && (rule == Rule::otherwise || !told)
                && builder.failed_at.is_none_or(|at| at < last.range().start)
            {
                told |= rule != Rule::otherwise;
                builder.after_otherwise(rule, span, last);
            }
            if rule == Rule::otherwise {
                last = last.or(Some(span));
            }
            let mut parts = Parts::of(node);
            let paid = match rule {
                Rule::otherwise => None,
                Rule::price_line => {
                    let during = parts.has(Rule::kw_while);
                    let during = during.then(|| builder.take_expr(&mut parts));
                    parts.has(Rule::comma);
                    parts.has(Rule::kw_per);
                    if let Some(wrong) = parts.maybe(Rule::wrong_per) {
                        let message = "what time costs is said by `per`".to_owned();
                        builder.respell(Code::E0123, builder.span(&wrong), message, "per");
                    }
                    let time = builder.take_expr(&mut parts);
                    Some(Paid::Per { during, time })
                }
                _ => {
                    parts.has(Rule::kw_on);
                    let event = builder.take_expr(&mut parts);
                    Some(Paid::On(builder.compared(
                        event,
                        &mut parts,
                        Rule::wrong_paid_equals,
                    )))
                }
            };
            parts.has(Rule::kw_otherwise);
            let value = builder.take_reward(&mut parts);
            match paid {
                Some(paid) => lines.push(RewardLine { paid, value, span }),
                None => otherwise = otherwise.take().or(Some(value)),
            }
        });
        AspectKind::Reward { lines, otherwise }
    }

    /// Reports a line of `reward` that stands behind `otherwise`.
    fn after_otherwise(&mut self, rule: Rule, span: Span, otherwise: Span) {
        let diagnostic = if rule == Rule::otherwise {
            Diagnostic::new(Code::E0503, span, "`otherwise` is given twice")
                .label("given again here")
                .also(otherwise, "first given here")
        } else {
            Diagnostic::new(
                Code::E0101,
                span,
                "`otherwise` is the last line of `reward`",
            )
            .label("this stands behind it")
            .also(otherwise, "move this below")
        };
        self.report(diagnostic);
    }

    /// The parts of a history, whose commas are there or reported.
    fn history_commas(&mut self, parts: Parts<'i>) -> Vec<Node<'i>> {
        let parts: Vec<Node<'i>> = parts.into_iter().collect();
        let mut before = None;
        for part in &parts {
            match part.as_rule() {
                Rule::missing_comma => self.missing_comma(part, before, HISTORY),
                _ => before = Some(self.span(part)),
            }
        }
        parts
    }

    /// A colon and the value after it.
    fn take_reward(&mut self, parts: &mut Parts<'i>) -> Expr {
        if let Some(node) = parts.maybe(Rule::reward_colon)
            && node.as_str() != ":"
        {
            let written = node.as_str();
            let message = format!("a reward follows a `:`, not a `{written}`");
            self.respell(Code::E0127, self.span(&node), message, ":");
        }
        self.take_expr(parts)
    }
}
