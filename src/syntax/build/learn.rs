//! Learners.

use super::Builder;
use crate::diagnostic::Code;
use crate::syntax::ast::{Learn, LearnEntry, Link, Setting, Spanned};
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn learn(&mut self, node: Node<'i>) -> Learn {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_learn);
        let name = parts
            .maybe(Rule::learner_name)
            .map(|node| self.take_name(&mut Parts::of(node)));
        let task = self.take_name(&mut parts);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut entries = Vec::new();
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            match part.as_rule() {
                Rule::stray_mark => {
                    self.stray_mark(&part);
                    continue;
                }
                Rule::close_brace | Rule::missing_close => {
                    self.close(Some(part), open);
                    continue;
                }
                Rule::bad_entry => {
                    let span = self.bad(&part, Rule::strict_learn_entry, previous);
                    entries.push(LearnEntry::Error(span));
                }
                Rule::start => entries.push(LearnEntry::Start(self.start(part))),
                _ => entries.push(LearnEntry::Setting(self.setting(part))),
            }
            previous = Some(start);
        }
        Learn {
            name,
            task,
            entries,
        }
    }

    fn setting(&mut self, node: Node<'i>) -> Setting {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        let tail = parts.maybe(Rule::link).map(|node| {
            let link = self.link(&node);
            (link, self.take_expr(&mut parts))
        });
        Setting {
            name,
            value,
            tail,
            span,
        }
    }

    fn link(&mut self, node: &Node<'i>) -> Spanned<Link> {
        let link = match node.as_str() {
            "of" => Link::Of,
            "per" => Link::Per,
            "->" => Link::Arrow,
            written => {
                let span = self.span(node);
                self.respell(
                    Code::E0121,
                    span,
                    format!("`{written}` is written `->`"),
                    "->",
                );
                Link::Arrow
            }
        };
        self.spanned(node, link)
    }
}
