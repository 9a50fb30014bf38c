//! Items.

use super::Builder;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    Enum, Event, Expr, ExprKind, Ident, Input, InputKind, ItemKind, Let, LetBody, On, Param,
    Params, Predicate, State, Trigger, TypeExpr, Use, UseWhat,
};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::words::TIMES;

/// The type that a default likely has, as far as it is written.
fn type_of(default: &Expr) -> &'static str {
    match &default.kind {
        ExprKind::Bool(_) => "bool",
        ExprKind::Point(..) => "point",
        ExprKind::Unary { operand, .. } => type_of(operand),
        ExprKind::Number(literal) => match literal.unit.as_ref().map(|unit| unit.text.as_str()) {
            None => "number",
            Some("%") => "ratio",
            Some(unit) if TIMES.contains(&unit) => "time",
            Some("deg" | "rad") => "angle",
            Some("Hz") => "frequency",
            Some("rad/s" | "deg/s") => "turn_rate",
            Some(unit) if unit.contains('/') => "speed",
            Some(_) => "length",
        },
        _ => "length",
    }
}

impl<'i> Builder<'i> {
    pub(super) fn item(&mut self, node: Node<'i>) -> ItemKind {
        match node.as_rule() {
            Rule::use_item => self.use_item(node),
            Rule::world => ItemKind::World(self.world(node)),
            Rule::enum_item => ItemKind::Enum(self.enum_item(node)),
            Rule::input => ItemKind::Input(self.input(node)),
            Rule::state => ItemKind::State(self.state(node)),
            Rule::event => ItemKind::Event(self.event(node)),
            Rule::each_tick => ItemKind::EachTick(self.last_block(node)),
            Rule::on_item => ItemKind::On(self.on_item(node)),
            Rule::let_item => ItemKind::Let(self.let_item(node)),
            Rule::predicate => ItemKind::Predicate(self.predicate(node)),
            Rule::behavior => ItemKind::Behavior(self.behavior(node)),
            Rule::task => ItemKind::Task(self.task(node)),
            Rule::learn => ItemKind::Learn(self.learn(node)),
            Rule::tree => ItemKind::Tree(self.tree(node)),
            Rule::claim => ItemKind::Claim(self.claim(node)),
            Rule::test => self.test(node),
            _ => ItemKind::Error,
        }
    }

    fn use_item(&mut self, node: Node<'i>) -> ItemKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_use);
        let Some(what) = parts.next() else {
            return ItemKind::Error;
        };
        let path = match what.as_rule() {
            Rule::std => UseWhat::Std,
            Rule::string => {
                self.straight_quotes(&what, "a path");
                UseWhat::Path(unquoted(what.as_str()).to_owned())
            }
            _ => {
                self.unclosed_text(&what);
                return ItemKind::Error;
            }
        };
        let pin = parts.maybe(Rule::pin).map(|pin| {
            let digits = pin.as_str().trim_start_matches("sha256:");
            self.spanned(&pin, digits.to_ascii_lowercase())
        });
        ItemKind::Use(Use {
            what: self.spanned(&what, path),
            pin,
        })
    }

    /// Reports quotes of print around `what` is written in quotes.
    pub(super) fn straight_quotes(&mut self, node: &Node<'i>, what: &str) {
        if node.as_str().starts_with('“') {
            let right = format!("\"{}\"", unquoted(node.as_str()));
            let span = self.span(node);
            self.respell(
                Code::E0121,
                span,
                format!("{what} is written in straight quotes"),
                &right,
            );
        }
    }

    fn enum_item(&mut self, node: Node<'i>) -> Enum {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_enum);
        let name = self.take_name(&mut parts);
        let variants = self.names(parts, "variants");
        Enum { name, variants }
    }

    /// The names of a list, `what` they are.
    fn names(&mut self, parts: Parts<'i>, what: &str) -> Vec<Ident> {
        let mut names: Vec<Ident> = Vec::new();
        for part in parts {
            match part.as_rule() {
                Rule::name => names.push(self.name(&part)),
                Rule::missing_comma => {
                    let before = names.last().map(|name| name.span);
                    self.missing_comma(&part, before, what);
                }
                _ => {}
            }
        }
        names
    }

    fn input(&mut self, node: Node<'i>) -> Input {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_input);
        let name = self.take_name(&mut parts);
        let kind = match self.maybe_type(&mut parts) {
            Some(ty) => InputKind::Number(ty),
            None => {
                parts.has(Rule::colon);
                let values = parts.maybe(Rule::values);
                let values = values.map(|values| self.names(Parts::of(values), "values"));
                InputKind::Category(values.unwrap_or_default())
            }
        };
        Input { name, kind }
    }

    fn state(&mut self, node: Node<'i>) -> State {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_state);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        let ty = self.maybe_type(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        State {
            name,
            params,
            ty,
            value,
        }
    }

    fn event(&mut self, node: Node<'i>) -> Event {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_event);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        Event {
            name,
            params,
            value,
        }
    }

    fn on_item(&mut self, node: Node<'i>) -> On {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_on);
        let trigger = if let Some(family) = parts.maybe(Rule::family) {
            let fallback = self.span(&family);
            let mut parts = Parts::of(family);
            let name = self.take_name(&mut parts);
            let params = self.maybe_params(&mut parts).unwrap_or(Params {
                params: Vec::new(),
                span: fallback,
            });
            Trigger::Family { name, params }
        } else {
            Trigger::Expr(self.take_expr(&mut parts))
        };
        let block = self.take_block(&mut parts);
        On { trigger, block }
    }

    fn let_item(&mut self, node: Node<'i>) -> Let {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_let);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        let ty = self.maybe_type(&mut parts);
        self.take_is(&mut parts);
        let body = if let Some(node) = parts.maybe(Rule::r#yield) {
            LetBody::Yield(self.yields(node))
        } else {
            LetBody::Expr(self.take_expr(&mut parts))
        };
        Let {
            name,
            params,
            ty,
            body,
        }
    }

    fn predicate(&mut self, node: Node<'i>) -> Predicate {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_predicate);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        let value = self.take_is(&mut parts).then(|| self.take_expr(&mut parts));
        Predicate {
            name,
            params,
            value,
        }
    }

    // ---- parameters and types

    pub(super) fn maybe_params(&mut self, parts: &mut Parts<'i>) -> Option<Params> {
        let node = parts
            .maybe(Rule::params)
            .or_else(|| parts.maybe(Rule::typed_params))?;
        let span = self.span(&node);
        let params = Parts::of(node)
            .into_iter()
            .filter(|part| matches!(part.as_rule(), Rule::param | Rule::typed_param))
            .map(|part| self.param(part))
            .collect();
        Some(Params { params, span })
    }

    /// Whether the line of a name declares a family of states or events.
    fn is_family(&self, name: Span) -> bool {
        let before = self.text.get(..name.range().start).unwrap_or_default();
        let line = before.rsplit('\n').next().unwrap_or_default();
        line.starts_with("state ") || line.starts_with("event ")
    }

    fn param(&mut self, node: Node<'i>) -> Param {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        let ty = self.maybe_type(&mut parts).unwrap_or(TypeExpr {
            factors: Vec::new(),
            span: name.span.after(),
        });
        let untyped = parts.has(Rule::missing_type);
        let default = self.take_is(&mut parts).then(|| self.take_expr(&mut parts));
        if untyped {
            let of_default = default.as_ref().map(type_of);
            let diagnostic = Diagnostic::new(
                Code::E0128,
                name.span,
                format!("the parameter `{}` has no type", name.name),
            )
            .label("a type goes after it")
            .help(match self.glance().declares_by(&["task"], &name.name) {
                true => format!("if it is the task: `tree NAME for {} = …`", name.name),
                false => match of_default {
                    Some(of) => format!("write `{}: {of}`, or whichever type it has", name.name),
                    None if self.is_family(name.span) => {
                        format!(
                            "write `{}: KIND`: the kind or the enum of its members",
                            name.name
                        )
                    }
                    None => {
                        let types = "`length`, `number`, `place` or whichever it is";
                        format!("write `{}: TYPE`: {types}", name.name)
                    }
                },
            });
            self.report(diagnostic);
        }
        Param {
            name,
            ty,
            default,
            span,
        }
    }

    pub(super) fn maybe_type(&mut self, parts: &mut Parts<'i>) -> Option<TypeExpr> {
        let node = parts.maybe(Rule::ascription)?;
        let node = Parts::of(node)
            .into_iter()
            .find(|part| part.as_rule() == Rule::type_expr)?;
        let span = self.span(&node);
        let mut divides = false;
        let mut factors = Vec::new();
        for part in Parts::of(node) {
            match part.as_rule() {
                Rule::type_op => divides = part.as_str() == "/",
                _ => factors.push((self.name(&part), divides)),
            }
        }
        Some(TypeExpr { factors, span })
    }
}

/// A text without the quotes around it.
pub(super) fn unquoted(text: &str) -> &str {
    let mut inner = text.chars();
    inner.next();
    inner.next_back();
    inner.as_str()
}
