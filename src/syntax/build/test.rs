//! Tests of trees without a world.

use super::Builder;
use super::item::unquoted;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{
    Answer, Expr, Ident, ItemKind, Spanned, Step, Test, TestLine, TestLineKind,
};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::words::ANSWERS;

impl<'i> Builder<'i> {
    pub(super) fn test(&mut self, node: Node<'i>) -> ItemKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_test);
        let Some(title) = parts.maybe(Rule::title) else {
            return ItemKind::Error;
        };
        self.straight_quotes(&title, "what is tested");
        let title = Ident {
            name: unquoted(title.as_str()).to_owned(),
            span: self.span(&title),
        };
        parts.has(Rule::kw_of);
        let Some(tree) = parts.maybe(Rule::r#ref) else {
            return ItemKind::Error;
        };
        let tree = self.reference(tree);
        let mut lines = Vec::new();
        self.entries(parts, Rule::strict_test_entry, |builder, node, span| {
            let kind = node.map_or(TestLineKind::Error, |node| builder.test_line(node));
            lines.push(TestLine { kind, span });
        });
        ItemKind::Test(Test { title, tree, lines })
    }

    fn test_line(&mut self, node: Node<'i>) -> TestLineKind {
        let is_given = node.as_rule() == Rule::given;
        let mut parts = Parts::of(node);
        parts.next();
        let changes = parts.maybe(Rule::changes);
        let changes = changes.map_or(Vec::new(), |node| self.changes(node));
        if is_given {
            return TestLineKind::Given(changes);
        }
        let lasting = parts.maybe(Rule::lasting).map(|node| {
            let mut parts = Parts::of(node);
            parts.has(Rule::kw_for);
            self.take_expr(&mut parts)
        });
        if let Some(arrow) = parts.maybe(Rule::guards) {
            self.guards(&arrow, "what is expected is preceded");
        }
        let steps = parts.maybe(Rule::steps).map(Parts::of);
        let steps = steps.into_iter().flatten();
        let steps = steps.filter(|part| part.as_rule() == Rule::step);
        TestLineKind::Tick {
            changes,
            lasting,
            steps: steps.filter_map(|node| self.step(node)).collect(),
        }
    }

    fn changes(&mut self, node: Node<'i>) -> Vec<Expr> {
        let parts = Parts::of(node).into_iter();
        let changes = parts.filter(|part| part.as_rule() == Rule::change);
        changes.map(|node| self.change(node)).collect()
    }

    /// What holds from a line on; what a behaviour answers is not said there.
    fn change(&mut self, node: Node<'i>) -> Expr {
        let mut parts = Parts::of(node);
        let expr = self.take_expr(&mut parts);
        if let Some(answer) = parts.maybe(Rule::wrong_answer) {
            let (named, word) = (self.slice(expr.span), answer.as_str());
            let message = "what a behaviour answers stands where it is selected";
            let diagnostic = Diagnostic::new(Code::E0101, self.span(&answer), message)
                .label("not before `=>`")
                .help(format!(
                    "say it in the tick before: `tick => {named} {word}`"
                ));
            self.report(diagnostic);
            return self.error_expr(expr.span);
        }
        expr
    }

    fn step(&mut self, node: Node<'i>) -> Option<Step> {
        let mut parts = Parts::of(node);
        let name = self.reference(parts.maybe(Rule::r#ref)?);
        let answer = match parts.next() {
            Some(node) if node.as_rule() == Rule::answer => {
                let answer = ANSWERS.iter().find(|(word, _)| *word == node.as_str());
                answer.map(|(_, answer)| self.spanned(&node, *answer))
            }
            Some(node) => Some(self.wrong_verb(&node)),
            None => None,
        };
        Some(Step { name, answer })
    }

    /// `goto(A) succeeded`, `goto(A) failure`
    fn wrong_verb(&mut self, node: &Node<'i>) -> Spanned<Answer> {
        let written = node.as_str();
        let answer = match written.chars().next() {
            Some('s') => Answer::Succeeds,
            Some('f') => Answer::Fails,
            _ => Answer::Runs,
        };
        let right = answer.spelling();
        let message = format!("what a behaviour answers is said by `{right}`, not by `{written}`");
        self.respell(Code::E0101, self.span(node), message, right);
        self.spanned(node, answer)
    }
}
