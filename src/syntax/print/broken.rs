//! Expressions and lists that one line cannot hold.

use super::columns::Group;
use super::flat::{self, Level};
use super::{Printer, WIDTH};
use crate::source::Span;
use crate::syntax::ast::{
    Arg, ArgKind, BinaryOp, Binding, Choice, Expr, ExprKind, Otherwise, Param, Params, Ref, Yield,
};

/// An operand of a broken chain with the operator before it.
type Operand<'e> = (Option<BinaryOp>, &'e Expr);

impl Printer<'_> {
    /// Whether `text`, which stands at `span`, and `after` more characters fit on the line, with no comment inside.
    pub(super) fn fits(&self, text: &str, span: Span, after: usize) -> bool {
        !self.has_comment(span) && self.column() + text.chars().count() + after <= WIDTH
    }

    /// Moves the comments out of an expression that have no place in it.
    pub(super) fn settle(&mut self, expr: &Expr) {
        self.hoist_unless(expr.span.range().end, |at| has_place(expr, at));
    }

    /// An expression that `after` more characters follow on its last line.
    pub(super) fn expr(&mut self, expr: &Expr, after: usize) {
        self.settle(expr);
        let text = flat::expr(expr);
        if self.fits(&text, expr.span, after) && !self.stays_broken(expr) {
            self.write(&text);
            return;
        }
        match &expr.kind {
            ExprKind::Ref(call) => self.call(call, after),
            ExprKind::If(choice) => self.choice(choice),
            ExprKind::Paren(inner) => {
                self.write("(");
                self.expr(inner, after + 1);
                self.write(")");
            }
            ExprKind::Unary { op, operand } if flat::level(operand) >= flat::level(expr) => {
                self.write(flat::unary_op(op.node));
                self.expr(operand, after);
            }
            ExprKind::Binary { op, .. } if is_chain(op.node) => self.operands(expr, after),
            ExprKind::Binary { op, left, right } if op.node != BinaryOp::Pow => {
                let (outer, inner) = flat::sides(op.node);
                self.operand(left, outer, 0);
                self.write(&format!(" {} ", flat::binary_op(op.node)));
                if flat::divisor(op.node, left, right, inner) == flat::expr(right) {
                    self.operand(right, inner, after);
                } else {
                    self.write(&flat::divisor(op.node, left, right, inner));
                }
            }
            _ => self.write(&text),
        }
    }

    fn operand(&mut self, expr: &Expr, level: Level, after: usize) {
        if flat::level(expr) < level {
            self.write("(");
            self.expr(expr, after + 1);
            self.write(")");
        } else {
            self.expr(expr, after);
        }
    }

    /// Whether an expression holds an `if` that was written on several lines, or a `let`.
    fn stays_broken(&self, expr: &Expr) -> bool {
        match &expr.kind {
            ExprKind::If(choice) => self.choice_stays_broken(choice),
            ExprKind::Paren(inner) | ExprKind::Unary { operand: inner, .. } => {
                self.stays_broken(inner)
            }
            ExprKind::Point(left, right) | ExprKind::Binary { left, right, .. } => {
                self.stays_broken(left) || self.stays_broken(right)
            }
            ExprKind::Ref(call) => call.args.iter().flatten().any(|arg| match &arg.kind {
                ArgKind::Positional(value) | ArgKind::Named(_, value) => self.stays_broken(value),
                ArgKind::Binder { body, .. } => {
                    body.as_ref().is_some_and(|body| self.stays_broken(body))
                }
            }),
            _ => false,
        }
    }

    fn choice_stays_broken(&self, choice: &Choice) -> bool {
        self.yield_stays_broken(&choice.then)
            || match &choice.otherwise {
                Otherwise::If(choice, _) => self.choice_stays_broken(choice),
                Otherwise::Yield(value) => self.yield_stays_broken(value),
            }
    }

    fn yield_stays_broken(&self, value: &Yield) -> bool {
        !value.bindings.is_empty() || self.is_written_broken(value.span).unwrap_or(false)
    }

    /// A chain of `and`, `or`, `+` or `-`, one operand a line.
    fn operands(&mut self, expr: &Expr, after: usize) {
        let operands = chain(expr);
        let count = operands.len();
        for (index, (op, operand)) in operands.into_iter().enumerate() {
            let level = op.map_or(flat::level(expr), |op| flat::sides(op).1);
            if let Some(op) = op {
                self.end_line(Group::None);
                if index == 1 {
                    self.indent += 1;
                }
                self.write(flat::binary_op(op));
                self.write(" ");
            }
            self.operand(operand, level, if index + 1 == count { after } else { 0 });
        }
        if count > 1 {
            self.indent -= 1;
        }
    }

    fn choice(&mut self, choice: &Choice) {
        self.write("if ");
        self.expr(&choice.cond, 2);
        self.write(" ");
        self.yields(&choice.then);
        self.write(" else ");
        match &choice.otherwise {
            Otherwise::If(choice, _) => self.choice(choice),
            Otherwise::Yield(value) => self.yields(value),
        }
    }

    /// `{ let … value }`, on several lines.
    pub(super) fn yields(&mut self, value: &Yield) {
        self.hoist(value.span.range().start);
        self.open_block(Group::None);
        self.trailing(value.span.range().start + 1);
        for binding in &value.bindings {
            self.entry(binding.span, |printer| printer.binding(binding));
        }
        self.entry(value.value.span, |printer| {
            let text = flat::yielded(value);
            if text == flat::expr(&value.value) {
                printer.expr(&value.value, 0);
            } else {
                printer.write(&text);
            }
            printer.end_line(Group::None);
        });
        self.rest_of_block(value.span.range().end.saturating_sub(1));
        self.close_block();
    }

    pub(super) fn binding(&mut self, binding: &Binding) {
        let head = format!("let {}", flat::ident(&binding.name));
        self.declaration("let", &head, binding.ty.as_ref(), &binding.value);
    }

    pub(super) fn call(&mut self, call: &Ref, after: usize) {
        self.hoist_unless(call.span.range().end, |at| has_place_in_call(call, at));
        let text = flat::reference(call);
        match &call.args {
            Some(args) if !args.is_empty() && !self.fits(&text, call.span, after) => {
                self.write(&flat::ident(&call.name));
                self.args(args, call.span);
            }
            _ => self.write(&text),
        }
    }

    /// Arguments, one a line.
    pub(super) fn args(&mut self, args: &[Arg], call: Span) {
        self.write("(");
        self.end_line(Group::None);
        self.indent += 1;
        self.first = true;
        for arg in args {
            self.entry(arg.span, |printer| {
                printer.arg(arg);
                printer.write(",");
                printer.end_line(Group::None);
            });
        }
        self.rest_of_block(call.range().end.saturating_sub(1));
        self.indent -= 1;
        self.first = false;
        self.write(")");
    }

    fn arg(&mut self, arg: &Arg) {
        match &arg.kind {
            ArgKind::Positional(value) => self.expr(value, 1),
            ArgKind::Named(name, value) => {
                self.write(&format!("{} = ", flat::ident(name)));
                self.expr(value, 1);
            }
            ArgKind::Binder { name, domain, body } => {
                self.write(&format!("{} in {}", flat::ident(name), flat::ident(domain)));
                if let Some(body) = body {
                    self.write(": ");
                    self.expr(body, 1);
                }
            }
        }
    }

    pub(super) fn params(&mut self, params: Option<&Params>, after: usize) {
        let Some(params) = params else { return };
        self.hoist(params.span.range().start);
        let text = flat::params(params);
        if params.params.is_empty() || self.fits(&text, params.span, after) {
            self.write(&text);
            return;
        }
        self.write("(");
        self.end_line(Group::None);
        self.indent += 1;
        self.first = true;
        for param in &params.params {
            self.entry(param.span, |printer| printer.param(param));
        }
        self.rest_of_block(params.span.range().end.saturating_sub(1));
        self.indent -= 1;
        self.first = false;
        self.write(")");
    }

    fn param(&mut self, param: &Param) {
        self.write(&flat::param(param));
        self.write(",");
        self.end_line(Group::None);
    }
}

/// Whether a comment at byte `at` can stay where it is: among arguments, or in braces.
fn has_place(expr: &Expr, at: usize) -> bool {
    let within = |span: Span| span.range().contains(&at);
    if !within(expr.span) {
        return false;
    }
    match &expr.kind {
        ExprKind::Ref(call) => has_place_in_call(call, at),
        ExprKind::If(choice) => has_place(&choice.cond, at) || in_braces(choice, at),
        ExprKind::Paren(inner) | ExprKind::Unary { operand: inner, .. } => has_place(inner, at),
        ExprKind::Binary { op, left, right } if op.node != BinaryOp::Pow => {
            has_place(left, at) || has_place(right, at)
        }
        _ => false,
    }
}

fn has_place_in_call(call: &Ref, at: usize) -> bool {
    let args = call.args.as_deref().unwrap_or_default();
    let arg = args.iter().find(|arg| arg.span.range().contains(&at));
    call.span.range().contains(&at)
        && !args.is_empty()
        && arg.is_none_or(|arg| has_place_in_arg(arg, at))
}

fn has_place_in_arg(arg: &Arg, at: usize) -> bool {
    match &arg.kind {
        ArgKind::Positional(value) | ArgKind::Named(_, value) => has_place(value, at),
        ArgKind::Binder { body, .. } => body.as_ref().is_some_and(|body| has_place(body, at)),
    }
}

fn in_braces(choice: &Choice, at: usize) -> bool {
    choice.then.span.range().contains(&at)
        || match &choice.otherwise {
            Otherwise::If(choice, _) => has_place(&choice.cond, at) || in_braces(choice, at),
            Otherwise::Yield(value) => value.span.range().contains(&at),
        }
}

/// Whether chains of the operator are broken at it.
fn is_chain(op: BinaryOp) -> bool {
    matches!(
        op,
        BinaryOp::And | BinaryOp::Or | BinaryOp::Add | BinaryOp::Sub
    )
}

/// The operands of a chain that leans to the left, with the operators before them.
fn chain(expr: &Expr) -> Vec<Operand<'_>> {
    let level = flat::level(expr);
    let mut operands: Vec<Operand<'_>> = Vec::new();
    let mut rest = expr;
    while let ExprKind::Binary { op, left, right } = &rest.kind {
        if flat::level(rest) != level {
            break;
        }
        operands.push((Some(op.node), right));
        rest = left;
    }
    operands.push((None, rest));
    operands.reverse();
    operands
}
