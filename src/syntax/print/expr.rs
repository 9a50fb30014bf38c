//! Expressions.

use super::Printer;
use super::doc::{Brackets, Break, Doc, Entry, row};
use super::levels::Level;
use super::names::{ident, type_expr};
use crate::spelling::quoted;
use crate::syntax::ast::{
    Axis, BinaryOp, Binding, Choice, Expr, ExprKind, Literal, Otherwise, TypeExpr, UnaryOp, Unit,
    Yield,
};
use crate::syntax::print::columns::Align;
use crate::syntax::words::UNITS;
use std::ops::Range;

impl Printer<'_> {
    pub(super) fn expr<'a>(&self, expr: &'a Expr) -> Doc<'a> {
        let doc = match &expr.kind {
            ExprKind::Number(literal) => number(literal),
            ExprKind::Bool(value) => Doc::from(if *value { "true" } else { "false" }),
            ExprKind::Ref(call) => {
                let stands = self.stands.filter(|_| call.args.is_none());
                return match stands.and_then(|stands| stands(&call.name.name)) {
                    Some(text) => Doc::from(text),
                    None => self.call(call),
                };
            }
            ExprKind::If(choice) => self.choice(choice),
            ExprKind::Point(x, y) => row!["(", self.expr(x), ", ", self.expr(y), ")"].flat(),
            ExprKind::Coordinate(point, axis) => {
                let axis = match axis {
                    Axis::X => ".x",
                    Axis::Y => ".y",
                };
                row![self.expr(point), axis]
            }
            ExprKind::Paren(inner) => row!["(", self.expr(inner), ")"],
            ExprKind::Unary { op, operand } => {
                let blank = if op.node == UnaryOp::Not { " " } else { "" };
                let operand = self.operand(operand, Level::of_unary(op.node));
                row![op.node.spelling(), blank, operand]
            }
            ExprKind::Binary { op, left, right } => match op.node {
                BinaryOp::And | BinaryOp::Or | BinaryOp::Add | BinaryOp::Sub => self.chain(expr),
                BinaryOp::Pow => self.power(left, right),
                op => row![
                    self.operand(left, Level::sides(op).0),
                    " ",
                    op.spelling(),
                    " ",
                    self.right(op, left, right)
                ],
            },
            ExprKind::Error => Doc::from("`?`"),
        };
        let tall = doc.tall;
        doc.grouped(expr.span, Break::always_if(tall))
            .settled(expr.span.range().end)
    }

    /// An expression in parentheses if it binds less tightly than `level`.
    pub(super) fn operand<'a>(&self, expr: &'a Expr, level: Level) -> Doc<'a> {
        if Level::of(expr) < level {
            row!["(", self.expr(expr), ")"]
        } else {
            self.expr(expr)
        }
    }

    /// The right operand. After a quantity with a unit, a name that could be taken for the rest of it is put in
    /// backquotes.
    fn right<'a>(&self, op: BinaryOp, left: &Expr, right: &'a Expr) -> Doc<'a> {
        match &right.kind {
            ExprKind::Ref(call)
                if op == BinaryOp::Div
                    && has_unit(left)
                    && call.args.is_none()
                    && UNITS.contains(&call.name.name.as_str()) =>
            {
                Doc::from(quoted(&call.name.name))
            }
            _ => self.operand(right, Level::sides(op).1),
        }
    }

    /// A power. Blanks part it from a unit, whose own exponent it would be without them.
    fn power<'a>(&self, left: &'a Expr, right: &'a Expr) -> Doc<'a> {
        let (base, exponent) = Level::sides(BinaryOp::Pow);
        let sign = if has_unit(left) { " ^ " } else { "^" };
        row![
            self.operand(left, base),
            sign,
            self.operand(right, exponent)
        ]
        .flat()
    }

    /// A chain of `and`, `or`, or `+` and `-`: on several lines, one operand a line.
    fn chain<'a>(&self, expr: &'a Expr) -> Doc<'a> {
        let mut operands = Vec::new();
        self.links(expr, Level::of(expr), None, &mut operands);
        operands.reverse();
        Doc::row(operands)
    }

    /// The operands of a chain from the right, the first one behind `lead`. Sums lean to the left; the right side of an `and`
    /// or an `or` may be a chain of the same.
    fn links<'a>(
        &self,
        expr: &'a Expr,
        level: Level,
        lead: Option<(BinaryOp, Range<usize>)>,
        operands: &mut Vec<Doc<'a>>,
    ) {
        let link = |(op, gap): (BinaryOp, Range<usize>), operand| {
            row![Doc::line_in(gap), op.spelling(), " ", operand].nested()
        };
        let mut rest = expr;
        while let ExprKind::Binary { op, left, right } = &rest.kind
            && Level::of(rest) == level
        {
            let associates = matches!(op.node, BinaryOp::And | BinaryOp::Or);
            let lead = (op.node, left.span.range().end..right.span.range().start);
            if associates && Level::of(right) == level {
                self.links(right, level, Some(lead), operands);
            } else {
                let right = self.operand(right, Level::sides(op.node).1);
                operands.push(link(lead, right));
            }
            rest = left;
        }
        let first = self.operand(rest, level);
        operands.push(match lead {
            Some(lead) => link(lead, first),
            None => first,
        });
    }

    fn choice<'a>(&self, choice: &'a Choice) -> Doc<'a> {
        let then = self.yields(&choice.then);
        let otherwise = match &choice.otherwise {
            Otherwise::If(choice, _) => self.choice(choice),
            Otherwise::Yield(value) => self.yields(value),
        };
        let tall = then.tall || otherwise.tall;
        let cond = self.expr(&choice.cond).room(" {".len());
        Doc {
            tall,
            ..row!["if ", cond, " ", then, " else ", otherwise]
        }
    }

    /// `{ let … value }`
    pub(super) fn yields<'a>(&self, value: &'a Yield) -> Doc<'a> {
        let mut entries: Vec<Entry<'a>> = value
            .bindings
            .iter()
            .map(|binding| Entry::aligned(binding.span, Align::Of("let"), self.binding(binding)))
            .collect();
        let mut last = self.expr(&value.value);
        if !entries.is_empty() && matches!(last.first(), Some('-' | '+')) {
            // A sign after a `let` would go on with the value that this binds.
            last = row!["(", last, ")"];
        }
        entries.push(Entry::new(value.value.span, last));
        let list = Doc::list(Brackets::BLOCK, value.span, entries);
        Doc {
            tall: !value.bindings.is_empty() || self.is_broken(value.span).unwrap_or(false),
            ..row![Doc::hoist(value.span.range().start), list]
        }
    }

    pub(super) fn binding<'a>(&self, binding: &'a Binding) -> Doc<'a> {
        let head = row!["let ", ident(&binding.name)];
        self.declaration(head, binding.ty.as_ref(), &binding.value)
    }

    /// `head: type = value`, in three columns.
    pub(super) fn declaration<'a>(
        &self,
        head: Doc<'a>,
        ty: Option<&'a TypeExpr>,
        value: &'a Expr,
    ) -> Doc<'a> {
        row![typed(head, ty), self.expr(value)]
    }

    /// `head = value`, in two columns.
    pub(super) fn definition<'a>(&self, head: Doc<'a>, value: &'a Expr) -> Doc<'a> {
        row![head, Doc::column(), "= ", self.expr(value)]
    }
}

/// `head: type = `, in three columns.
pub(super) fn typed<'a>(head: Doc<'a>, ty: Option<&'a TypeExpr>) -> Doc<'a> {
    let ty = match ty {
        Some(ty) => row![":", Doc::column(), type_expr(ty)],
        None => Doc::empty_column(),
    };
    row![head, ty, Doc::column(), "= "]
}

fn number(literal: &Literal) -> Doc<'_> {
    let digits = literal.digits.as_str();
    match &literal.unit {
        Some(Unit { text, .. }) if text.starts_with('%') => row![digits, text.as_str()],
        Some(Unit { text, .. }) => row![digits, " ", text.as_str()],
        None => Doc::from(digits),
    }
}

fn has_unit(expr: &Expr) -> bool {
    matches!(&expr.kind, ExprKind::Number(literal) if literal.unit.is_some())
}
