//! Inputs, and comparisons of those that have one of some values.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Code, suggest};
use crate::ir::expr::{Binary, Expr as Leaf};
use crate::ir::input::{Input, InputKind};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{self, BinaryOp, Expr, Ident, Ref, Spanned};

/// A checked input with the type of its number; a category has none.
#[derive(Clone, Debug)]
pub struct InputSlot {
    id: Id<Input>,
    ty: Option<Type>,
}

impl<'a> Checker<'a> {
    /// `input name: type` or `input name: {a, b}`
    pub fn input(&mut self, input: &'a ast::Input) {
        let name = &input.name;
        // Where the world was not understood, neither was what else may be there.
        if self.has_world && !self.names.lost_world {
            let message = format!("`{}` is an input, and the program has a world", name.name);
            self.error(Code::E0410, name.span, message)
                .label("what is known here comes from the world")
                .help("a `state`, or a reading of the world, says what is known in it");
        }
        let (kind, ty) = match &input.kind {
            ast::InputKind::Number(written) => {
                let ty = self.type_expr(written);
                let Some(dim) = ty.dim() else {
                    return self.no_number(input, &ty, written.span);
                };
                let ratio = ty == Type::Ratio;
                (InputKind::Number { dim, ratio }, Some(ty))
            }
            ast::InputKind::Category(values) => {
                self.values(name, values);
                let values = values.iter().map(|value| Name::word(&value.name));
                (InputKind::Category(values.collect()), None)
            }
        };
        let id = self.program.inputs.push(Input {
            name: Name::word(&name.name),
            kind,
        });
        self.inputs.insert(&name.name, InputSlot { id, ty });
    }

    /// Reports an input of a type that none has.
    fn no_number(&mut self, input: &ast::Input, ty: &Type, at: Span) {
        self.names.lose(&input.name.name);
        let name = spelled(&input.name.name);
        let help = match ty {
            Type::Error => return,
            Type::Bool => format!("what holds or does not is a predicate: `predicate {name}`"),
            _ => format!("list the values: `input {name}: {{a, b}}`"),
        };
        let message = format!("an input is a number or one of some values, not {ty}");
        self.error(Code::E0302, at, message).this_is(ty).help(help);
    }

    /// Reports a list of values without any, or with one twice.
    fn values(&mut self, name: &Ident, values: &[Ident]) {
        if values.is_empty() {
            let message = format!("the input `{}` has no values", name.name);
            self.error(Code::E0312, name.span, message)
                .label("it could not be anything");
        }
        for (at, value) in values.iter().enumerate() {
            let earlier = values.iter().take(at);
            if let Some(first) = earlier.into_iter().find(|first| first.name == value.name) {
                let message = format!("the value `{}` stands twice", value.name);
                self.error(Code::E0201, value.span, message)
                    .label("listed again here")
                    .also(first.span, "first listed here");
            }
        }
    }

    /// The current value of an input.
    pub fn input_value(&mut self, input: &'a ast::Input, reference: &'a Ref) -> Option<Typed> {
        let name = &reference.name.name;
        if self.context.region == Region::World {
            let message = format!("the input `{name}` is not a constant");
            return self
                .error(Code::E0303, reference.span, message)
                .label("this changes as the program runs")
                .none();
        }
        if self.gives_arguments(reference, "an input") {
            return None;
        }
        let slot = self.inputs.get(name.as_str())?.clone();
        if let Some(ty) = slot.ty {
            return Some(self.leaf(Leaf::Input(slot.id), ty, reference.span));
        }
        let example = match &input.kind {
            ast::InputKind::Category(values) => values.first(),
            ast::InputKind::Number(_) => None,
        };
        let help = example.map(|value| {
            let (name, value) = (spelled(name), spelled(&value.name));
            format!("compare it with one of its values: `{name} == {value}`")
        });
        let message = format!("`{name}` has one of some values");
        self.error(Code::E0313, reference.span, message)
            .label("this is no number and no truth value")
            .help_if(help)
            .none()
    }

    /// A comparison of an input with one of its values; `None` if neither side is such an input.
    pub fn category(
        &mut self,
        op: Spanned<BinaryOp>,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Option<Typed> {
        let (reference, values, value) = match (self.categorical(left), self.categorical(right)) {
            (Some((reference, values)), _) => (reference, values, right),
            (None, Some((reference, values))) => (reference, values, left),
            (None, None) => return self.value_of_an_unknown(left, right, span),
        };
        let failed = Typed::unknown(Type::Bool, span);
        let name = &reference.name.name;
        if !matches!(op.node, BinaryOp::Eq | BinaryOp::Ne) {
            self.error(
                Code::E0302,
                op.span,
                format!("the values of `{name}` have no order"),
            )
            .label("only `==` and `!=` compare them");
            return Some(failed);
        }
        let listed = || {
            let names = values.iter().map(|value| spelled(&value.name));
            let names: Vec<_> = names.collect();
            format!("its values are {}", suggest::first(&names))
        };
        let Some(asked) = plain_ref(value) else {
            let message = format!("`{name}` is compared with one of its values");
            self.error(Code::E0313, value.span, message)
                .label("this is none of them")
                .help(listed());
            return Some(failed);
        };
        let asked = &asked.name;
        let Some(at) = values.iter().position(|value| value.name == asked.name) else {
            let known = values.iter().map(|value| value.name.as_str());
            let likely = suggest::nearest(&asked.name, known).map(str::to_owned);
            let message = format!("`{}` is no value of `{name}`", asked.name);
            let draft = self.error(Code::E0313, asked.span, message);
            match likely {
                Some(likely) => draft.likely(asked, Some(&likely)).emit(),
                None => draft.label("not one of its values").help(listed()).emit(),
            }
            return Some(failed);
        };
        let Some(slot) = self.inputs.get(name.as_str()).cloned() else {
            return Some(failed);
        };
        if self.context.region == Region::World {
            // It is not a constant, and says so.
            self.expr(match self.categorical(left) {
                Some(_) => left,
                None => right,
            });
            return Some(failed);
        }
        let pool = &mut self.program.pool;
        let input = pool.leaf(Leaf::Input(slot.id));
        let code = pool.num(at as f64);
        let op = match op.node {
            BinaryOp::Eq => Binary::Eq,
            _ => Binary::Ne,
        };
        let id = pool.binary(op, input, code);
        Some(Typed::new(Type::Bool, Some(id), span))
    }

    /// A comparison of a name that nothing declares with a value that an input has: that input was meant, whose value
    /// is no name of its own.
    fn value_of_an_unknown(
        &mut self,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Option<Typed> {
        let unknown = |expr: &'a Expr| {
            let name = plain_ref(expr).filter(|name| name.args.is_none())?;
            let name = name.name.name.as_str();
            let bound = self.context.lookup(name).is_some();
            let known = bound || self.names.value(name, self.context.library).is_some();
            (!known).then_some(name)
        };
        let (one, other) = (unknown(left)?, unknown(right)?);
        let is_value = |name: &str| self.input_with(name).is_some();
        let input = match (is_value(one), is_value(other)) {
            (false, true) => left,
            (true, false) => right,
            _ => return None,
        };
        self.expr(input);
        Some(Typed::unknown(Type::Bool, span))
    }

    /// The input that an expression names, if it has one of some values.
    fn categorical(&self, expr: &'a Expr) -> Option<(&'a Ref, &'a [Ident])> {
        let reference = plain_ref(expr)?;
        let name = reference.name.name.as_str();
        if self.context.lookup(name).is_some() {
            return None;
        }
        match self.names.value(name, self.context.library) {
            Some((Decl::Input(input), _)) => match &input.kind {
                ast::InputKind::Category(values) => Some((reference, values)),
                ast::InputKind::Number(_) => None,
            },
            _ => None,
        }
    }
}
