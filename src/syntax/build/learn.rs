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
        let mut entries = Vec::new();
        self.entries(parts, Rule::strict_learn_entry, |builder, node, span| {
            entries.push(match node {
                Some(node) if node.as_rule() == Rule::start => {
                    LearnEntry::Start(builder.start(node))
                }
                Some(node) => LearnEntry::Setting(builder.setting(node)),
                None => LearnEntry::Error(span),
            });
        });
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
        let tail = parts
            .maybe(Rule::link)
            .or_else(|| parts.maybe(Rule::wrong_link));
        let tail = tail.map(|node| {
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
                let code = if written.is_ascii() {
                    Code::E0110
                } else {
                    Code::E0121
                };
                self.respell(code, span, format!("`{written}` is written `->`"), "->");
                Link::Arrow
            }
        };
        self.spanned(node, link)
    }
}
