//! What is printed on one line.

use crate::spelling::{quoted, spelled};
use crate::syntax::ast::{
    Arg, ArgKind, AssignOp, BinaryOp, Binding, Choice, Expr, ExprKind, Ident, Link, Literal, Node,
    NodeKind, Otherwise, Outcome, Param, Params, Ref, TypeExpr, UnaryOp, Unit, Word, Yield,
};
use crate::syntax::words::{ASPECTS, UNITS};

/// How tightly an expression binds, loosest first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Level {
    Or,
    And,
    Not,
    Comparison,
    Sum,
    Term,
    Unary,
    Power,
    Primary,
}

pub(super) fn ident(ident: &Ident) -> String {
    spelled(&ident.name).into_owned()
}

pub(super) fn expr(expr: &Expr) -> String {
    match &expr.kind {
        ExprKind::Number(literal) => number(literal),
        ExprKind::Bool(value) => value.to_string(),
        ExprKind::Ref(call) => reference(call),
        ExprKind::If(choice) => choice_of(choice),
        ExprKind::Point(x, y) => format!("({}, {})", self::expr(x), self::expr(y)),
        ExprKind::Paren(inner) => format!("({})", self::expr(inner)),
        ExprKind::Unary { op, operand } => {
            let level = if op.node == UnaryOp::Not {
                Level::Not
            } else {
                Level::Unary
            };
            format!("{}{}", unary_op(op.node), at_least(operand, level))
        }
        ExprKind::Binary { op, left, right } => {
            let (outer, inner) = sides(op.node);
            let (left, right) = (at_least(left, outer), divisor(op.node, left, right, inner));
            match op.node {
                BinaryOp::Pow => format!("{left}^{right}"),
                op => format!("{left} {} {right}", binary_op(op)),
            }
        }
        ExprKind::Error => "`?`".to_owned(),
    }
}

/// The right operand; after a quantity with a unit a name that could be taken for the rest of it is put in backquotes.
pub(super) fn divisor(op: BinaryOp, left: &Expr, right: &Expr, level: Level) -> String {
    if let (BinaryOp::Div, ExprKind::Number(literal), ExprKind::Ref(call)) =
        (op, &left.kind, &right.kind)
        && literal.unit.is_some()
        && call.args.is_none()
        && UNITS.contains(&call.name.name.as_str())
    {
        return quoted(&call.name.name);
    }
    at_least(right, level)
}

/// The expression, in parentheses if it binds less tightly than `level`.
pub(super) fn at_least(expr: &Expr, level: Level) -> String {
    let text = self::expr(expr);
    if self::level(expr) < level {
        format!("({text})")
    } else {
        text
    }
}

pub(super) fn level(expr: &Expr) -> Level {
    match &expr.kind {
        ExprKind::Unary { op, .. } if op.node == UnaryOp::Not => Level::Not,
        ExprKind::Unary { .. } => Level::Unary,
        ExprKind::Binary { op, .. } => match op.node {
            BinaryOp::Or => Level::Or,
            BinaryOp::And => Level::And,
            BinaryOp::Add | BinaryOp::Sub => Level::Sum,
            BinaryOp::Mul | BinaryOp::Div => Level::Term,
            BinaryOp::Pow => Level::Power,
            _ => Level::Comparison,
        },
        _ => Level::Primary,
    }
}

/// How tightly the operands of a binary operator bind at least.
pub(super) fn sides(op: BinaryOp) -> (Level, Level) {
    match op {
        BinaryOp::Or => (Level::Or, Level::And),
        BinaryOp::And => (Level::And, Level::Not),
        BinaryOp::Add | BinaryOp::Sub => (Level::Sum, Level::Term),
        BinaryOp::Mul | BinaryOp::Div => (Level::Term, Level::Unary),
        BinaryOp::Pow => (Level::Primary, Level::Unary),
        _ => (Level::Sum, Level::Sum),
    }
}

pub(super) fn unary_op(op: UnaryOp) -> &'static str {
    match op {
        UnaryOp::Neg => "-",
        UnaryOp::Pos => "+",
        UnaryOp::Not => "not ",
    }
}

pub(super) fn binary_op(op: BinaryOp) -> &'static str {
    match op {
        BinaryOp::Or => "or",
        BinaryOp::And => "and",
        BinaryOp::Eq => "==",
        BinaryOp::Ne => "!=",
        BinaryOp::Lt => "<",
        BinaryOp::Le => "<=",
        BinaryOp::Gt => ">",
        BinaryOp::Ge => ">=",
        BinaryOp::Add => "+",
        BinaryOp::Sub => "-",
        BinaryOp::Mul => "*",
        BinaryOp::Div => "/",
        BinaryOp::Pow => "^",
    }
}

pub(super) fn assign_op(op: AssignOp) -> &'static str {
    match op {
        AssignOp::Set => "=",
        AssignOp::Add => "+=",
        AssignOp::Sub => "-=",
        AssignOp::Mul => "*=",
        AssignOp::Div => "/=",
    }
}

pub(super) fn link(link: Link) -> &'static str {
    match link {
        Link::Of => "of",
        Link::Per => "per",
        Link::Arrow => "->",
    }
}

pub(super) fn outcome(outcome: Outcome) -> &'static str {
    match outcome {
        Outcome::Success => "success",
        Outcome::Failure => "failure",
    }
}

fn number(literal: &Literal) -> String {
    match &literal.unit {
        Some(Unit { text, .. }) if text.starts_with('%') => format!("{}{text}", literal.digits),
        Some(Unit { text, .. }) => format!("{} {text}", literal.digits),
        None => literal.digits.clone(),
    }
}

pub(super) fn reference(call: &Ref) -> String {
    match &call.args {
        Some(list) => format!("{}{}", ident(&call.name), args(list)),
        None => ident(&call.name),
    }
}

pub(super) fn args(args: &[Arg]) -> String {
    format!("({})", joined(args.iter().map(arg)))
}

pub(super) fn arg(arg: &Arg) -> String {
    match &arg.kind {
        ArgKind::Positional(value) => expr(value),
        ArgKind::Named(name, value) => format!("{} = {}", ident(name), expr(value)),
        ArgKind::Binder { name, domain, body } => {
            let head = format!("{} in {}", ident(name), ident(domain));
            match body {
                Some(body) => format!("{head}: {}", expr(body)),
                None => head,
            }
        }
    }
}

fn choice_of(choice: &Choice) -> String {
    let otherwise = match &choice.otherwise {
        Otherwise::If(choice, _) => choice_of(choice),
        Otherwise::Yield(value) => yields(value),
    };
    format!(
        "if {} {} else {otherwise}",
        expr(&choice.cond),
        yields(&choice.then)
    )
}

pub(super) fn yields(value: &Yield) -> String {
    let mut text = "{ ".to_owned();
    for binding in &value.bindings {
        text.push_str(&self::binding(binding));
        // On one line a unit or a parenthesis could be taken for more of the value.
        text.push('\n');
    }
    text.push_str(&yielded(value));
    text.push_str(" }");
    text
}

/// The value of a block; a sign after a `let` would go on with the value that this binds.
pub(super) fn yielded(value: &Yield) -> String {
    let text = expr(&value.value);
    if !value.bindings.is_empty() && text.starts_with(['-', '+']) {
        format!("({text})")
    } else {
        text
    }
}

fn binding(binding: &Binding) -> String {
    let ty = binding
        .ty
        .as_ref()
        .map_or(String::new(), |ty| format!(": {}", type_expr(ty)));
    format!(
        "let {}{ty} = {}",
        ident(&binding.name),
        expr(&binding.value)
    )
}

pub(super) fn params(params: &Params) -> String {
    format!("({})", joined(params.params.iter().map(param)))
}

pub(super) fn maybe_params(params: Option<&Params>) -> String {
    params.map_or(String::new(), self::params)
}

pub(super) fn param(param: &Param) -> String {
    let head = format!("{}: {}", ident(&param.name), type_expr(&param.ty));
    match &param.default {
        Some(value) => format!("{head} = {}", expr(value)),
        None => head,
    }
}

pub(super) fn type_expr(ty: &TypeExpr) -> String {
    let mut text = String::new();
    for (index, (name, divides)) in ty.factors.iter().enumerate() {
        if index > 0 {
            text.push_str(if *divides { "/" } else { "*" });
        }
        text.push_str(&ident(name));
    }
    text
}

/// An entry of `observe` or `choose`; one that begins with the word of an aspect has that in backquotes.
pub(super) fn list_item(item: &Expr) -> String {
    let text = expr(item);
    let word: String = text
        .chars()
        .take_while(|letter| letter.is_ascii_alphanumeric() || *letter == '_')
        .collect();
    let rest = text.get(word.len()..).unwrap_or_default();
    if ASPECTS.contains(&word.as_str()) && !rest.starts_with('(') {
        format!("{}{rest}", quoted(&word))
    } else {
        text
    }
}

pub(super) fn node(node: &Node) -> String {
    match &node.kind {
        NodeKind::Composite {
            memory,
            word,
            args,
            children,
        } => {
            let head = composite_head(memory.is_some(), word.node, args.as_deref());
            if children.is_empty() {
                format!("{head} {{}}")
            } else {
                format!("{head} {{ {} }}", joined(children.iter().map(self::node)))
            }
        }
        NodeKind::Guarded { guard, node } => format!("{} => {}", expr(guard), self::node(node)),
        NodeKind::Leaf(leaf) => expr(leaf),
        NodeKind::Error => "`?`".to_owned(),
    }
}

pub(super) fn composite_head(memory: bool, word: Word, args: Option<&[Arg]>) -> String {
    let memory = if memory { "memory " } else { "" };
    let args = args.map_or(String::new(), self::args);
    format!("{memory}{}{args}", word.spelling())
}

pub(super) fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}
