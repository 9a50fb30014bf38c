//! Operators.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::expr::expect::is_literal;
use crate::check::expr::plain_ref;
use crate::check::report::listed;
use crate::check::types::units::Dim;
use crate::check::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code};
use crate::ir::Pool;
use crate::ir::expr::{Binary, Echo, Expr as Node, ExprId, Pose, Unary};
use crate::ir::world::DriveKind;
use crate::source::Span;
use crate::syntax::ast::{self, BinaryOp, Expr, ExprKind, UnaryOp};
use crate::syntax::print;

/// Whether an operator makes a sum or a product.
pub(super) fn is_arithmetic(op: BinaryOp) -> bool {
    matches!(
        op,
        BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div
    )
}

impl<'a> Checker<'a> {
    /// `not a`, `-a`, `+a`
    pub fn unary(&mut self, op: UnaryOp, operand: &'a Expr, span: Span) -> Option<Typed> {
        if op == UnaryOp::Not {
            let operand = self.expect(operand, &Type::Bool, "what `not` negates");
            if operand.ty == Type::Error {
                return None;
            }
            return Some(self.lift(Type::Bool, span, [&operand], |pool, [a]| pool.not(a)));
        }
        let operand = self.expr(operand);
        if operand.ty == Type::Error {
            return None;
        }
        if operand.ty.dim().is_none() {
            let message = format!("a sign stands before a number, not before {}", operand.ty);
            return self
                .error(Code::E0302, operand.span, message)
                .this_is(&operand.ty)
                .none();
        }
        let ty = operand.ty.clone();
        Some(self.lift(ty, span, [&operand], |pool, [a]| match op {
            UnaryOp::Neg => pool.unary(Unary::Neg, a),
            _ => a,
        }))
    }

    /// `a + b` and its like
    pub fn binary(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Option<Typed> {
        self.same_operands(op, left, right);
        match op.node {
            BinaryOp::And => self.junction(op, Binary::And, [left, right], span),
            BinaryOp::Or => self.junction(op, Binary::Or, [left, right], span),
            BinaryOp::Eq
            | BinaryOp::Ne
            | BinaryOp::Lt
            | BinaryOp::Le
            | BinaryOp::Gt
            | BinaryOp::Ge => Some(self.comparison(op, left, right, span)),
            BinaryOp::Pow => self.power(left, right, span),
            BinaryOp::Add | BinaryOp::Sub | BinaryOp::Mul | BinaryOp::Div => {
                let a = self.expr(left);
                self.step(op, (left, a), right, span)
            }
        }
    }

    /// `a and b`, `a or b`
    fn junction(
        &mut self,
        sign: ast::Spanned<BinaryOp>,
        op: Binary,
        [left, right]: [&'a Expr; 2],
        span: Span,
    ) -> Option<Typed> {
        let word = sign.node.spelling();
        // What is called within the operands comes after.
        let call = self.context.argument.take();
        let (a, b) = (self.expr(left), self.expr(right));
        if !a.ty.fits(&Type::Bool) && !b.ty.fits(&Type::Bool) {
            return self.joins_no_truths(sign, [(left, &a), (right, &b)], call);
        }
        if let Type::Enum(of) = &b.ty
            && let Some(asked) = self.asked_before(left, of)
        {
            let right_text = format!("{asked}{}", print::expr(right));
            return self
                .error(
                    Code::E0302,
                    b.span,
                    format!("each side of `{word}` is a comparison of its own"),
                )
                .this_is(&b.ty)
                .fix(
                    format!("write `{right_text}`"),
                    b.span,
                    right_text,
                    Applicability::Unsafe,
                )
                .none();
        }
        let role = format!("each side of `{word}`");
        let a = self.coerce(a, left, &Type::Bool, &role);
        let b = self.coerce(b, right, &Type::Bool, &role);
        if a.ty == Type::Error || b.ty == Type::Error {
            return None;
        }
        self.joins(left, a.scalar());
        self.joins(right, b.scalar());
        self.joint(sign.node, span, [(left, a.scalar()), (right, b.scalar())]);
        Some(self.lift_binary(op, Type::Bool, &a, &b, span))
    }

    /// `weather == ` of `weather == misty`, which a further value of that enum follows.
    fn asked_before(&mut self, left: &'a Expr, of: &str) -> Option<String> {
        match &left.kind {
            ExprKind::Binary { op, left, .. } if matches!(op.node, BinaryOp::Eq | BinaryOp::Ne) => {
                let (typed, _) = self.captured(|checker| checker.expr(left));
                let same = matches!(&typed.ty, Type::Enum(is) if is == of);
                same.then(|| format!("{} {} ", print::expr(left), op.node.spelling()))
            }
            ExprKind::Binary { op, right, .. }
                if matches!(op.node, BinaryOp::And | BinaryOp::Or) =>
            {
                self.asked_before(right, of)
            }
            _ => None,
        }
    }

    /// Reports `0 or 3`: neither side holds or does not.
    fn joins_no_truths<T>(
        &mut self,
        sign: ast::Spanned<BinaryOp>,
        [(left, a), (right, b)]: [(&Expr, &Typed); 2],
        call: Option<(Span, String)>,
    ) -> Option<T> {
        let word = sign.node.spelling();
        let alike = a.ty == b.ty;
        // `has(bolt or plate)`
        let (from, until) = (left.span, right.span);
        let call = call.filter(|(span, _)| span.start == from.start && span.end == until.end);
        if let Some((span, call)) = call {
            let (one, other) = (print::expr(left), print::expr(right));
            let right = format!("{one}) {word} {call}({other}");
            let message = format!("`{word}` joins conditions, and neither side is one");
            return self
                .error(Code::E0302, sign.span, message)
                .label(format!(
                    "each side is a call of its own: `{call}({one}) {word} {call}({other})`"
                ))
                .fix(
                    format!("write `{call}({right})`"),
                    span,
                    right,
                    Applicability::Unsafe,
                )
                .none();
        }
        let help = match alike && sign.node == BinaryOp::Or && self.context.region.draws() {
            true => {
                let (left, right) = (print::expr(left), print::expr(right));
                Some(format!(
                    "one of several values is drawn: `one_of({left}, {right})`"
                ))
            }
            false => Some("each side is a condition, such as a comparison".to_owned()),
        };
        self.error(
            Code::E0302,
            sign.span,
            format!("`{word}` joins conditions, and neither side is one"),
        )
        .label("neither side holds or does not")
        .also(a.span, format!("this is {}", a.ty))
        .also(b.span, format!("this is {}", b.ty))
        .help_if(help)
        .none()
    }

    /// Sums and products, which lean to the left: from the left, one operation after the other, however many there are.
    pub fn arithmetic(&mut self, expr: &'a Expr) -> Option<Typed> {
        let mut steps = Vec::new();
        let mut first = expr;
        while let ExprKind::Binary { op, left, right } = &first.kind
            && is_arithmetic(op.node)
            && !self.is_lost_with_a_dash(first)
        {
            steps.push((first, *op, &**left, &**right));
            first = left;
        }
        let mut a = self.expr(first);
        while let Some((whole, op, left, right)) = steps.pop() {
            self.same_operands(op, left, right);
            let typed = self.step(op, (left, a), right, whole.span);
            if steps.is_empty() {
                return typed;
            }
            a = self.settled(typed, whole);
        }
        None
    }

    /// A sum or a product of what has been checked and an expression.
    fn step(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        (left, a): (&'a Expr, Typed),
        right: &'a Expr,
        span: Span,
    ) -> Option<Typed> {
        match op.node {
            BinaryOp::Add => self.sum(Binary::Add, op, (left, a), right, span),
            BinaryOp::Sub => self.sum(Binary::Sub, op, (left, a), right, span),
            BinaryOp::Mul => self.product(Binary::Mul, &a, right, span),
            _ => self.product(Binary::Div, &a, right, span),
        }
    }

    fn sum(
        &mut self,
        of: Binary,
        op: ast::Spanned<BinaryOp>,
        (left, a): (&'a Expr, Typed),
        right: &'a Expr,
        span: Span,
    ) -> Option<Typed> {
        let b = self.expr(right);
        // What is no number may be a state that should be one.
        match (a.ty.dim(), b.ty.dim()) {
            (None, Some(_)) if a.ty != Type::Error => self.clashes(left, a.span, &b.ty),
            (Some(_), None) if b.ty != Type::Error => self.clashes(right, b.span, &a.ty),
            _ => {}
        }
        let (a, b) = self.same_dimension(op, (left, a), (right, b))?;
        let ty = match (&a.ty, &b.ty) {
            (Type::Ratio, _) | (_, Type::Ratio) => Type::Ratio,
            _ => a.ty.clone(),
        };
        Some(self.lift_binary(of, ty, &a, &b, span))
    }

    fn product(&mut self, of: Binary, a: &Typed, right: &'a Expr, span: Span) -> Option<Typed> {
        let b = self.expr(right);
        let (x, y) = (self.number(a), self.number(&b));
        let (x, y) = (x?, y?);
        if of == Binary::Div {
            self.no_division_by_zero(&b)?;
        }
        let power = if of == Binary::Mul { 1 } else { -1 };
        let ty = match (&a.ty, &b.ty) {
            (Type::Ratio, Type::Ratio) if power == 1 => Type::Ratio,
            _ => Type::Quantity(x.times(y, power)),
        };
        Some(self.lift_binary(of, ty, a, &b, span))
    }

    fn comparison(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        left: &'a Expr,
        right: &'a Expr,
        span: Span,
    ) -> Typed {
        if let Some(typed) = self.category(op, left, right, span) {
            return typed;
        }
        if self.may_be_value(left, right) || self.may_be_value(right, left) {
            return Typed::unknown(Type::Bool, span);
        }
        let a = self.expr(left);
        let b = self.expr_like(right, &a.ty);
        if a.ty == Type::Error || b.ty == Type::Error {
            return Typed::unknown(Type::Bool, span);
        }
        let equality = matches!(op.node, BinaryOp::Eq | BinaryOp::Ne);
        let words = matches!(a.ty, Type::Bool | Type::Enum(_)) && a.ty == b.ty;
        let named = |ty: &Type| ty.is_named_target() || *ty == Type::Nowhere;
        let targets = named(&a.ty) && named(&b.ty) && a.ty.join(&b.ty).is_some();
        let operands = if equality && words {
            Some((a, b))
        } else if equality && targets {
            Some((self.told_by_code(a), self.told_by_code(b)))
        } else if a.ty.dim().is_some() && b.ty.dim().is_some() {
            self.same_dimension(op, (left, a), (right, b))
        } else {
            self.incomparable(op.span, &a, &b);
            self.clashes(left, b.span, &b.ty);
            self.clashes(right, b.span, &a.ty);
            None
        };
        let Some((a, b)) = operands else {
            return Typed::error(span);
        };
        self.warn_plain_ratio(left, &b.ty);
        self.warn_plain_ratio(right, &a.ty);
        self.percent_beside(left, &a.ty, right);
        self.percent_beside(right, &b.ty, left);
        self.equal_to(op, left, [&a, &b]);
        let constant = |of: &Typed| of.scalar().and_then(|id| self.program.pool.constant(id));
        // Two measures may be of one thing.
        let exact = match op.node {
            BinaryOp::Eq | BinaryOp::Ne => {
                self.is_measure(&a) && constant(&b).is_some()
                    || self.is_measure(&b) && constant(&a).is_some()
            }
            BinaryOp::Le => constant(&b) == Some(0.0) && self.is_distance(&a),
            BinaryOp::Ge => constant(&a) == Some(0.0) && self.is_distance(&b),
            _ => false,
        };
        if exact {
            self.exact_measure(op.node != BinaryOp::Ne, span);
        }
        let (op, a, b) = match op.node {
            BinaryOp::Eq => (Binary::Eq, a, b),
            BinaryOp::Ne => (Binary::Ne, a, b),
            BinaryOp::Lt => (Binary::Lt, a, b),
            BinaryOp::Le => (Binary::Le, a, b),
            BinaryOp::Gt => (Binary::Lt, b, a),
            _ => (Binary::Le, b, a),
        };
        self.lift_binary(op, Type::Bool, &a, &b, span)
    }

    /// Whether this is where a robot is, how far it is from something, an input with a unit, or what is reckoned from that: no
    /// two are ever quite the same.
    fn is_measure(&self, of: &Typed) -> bool {
        fn measures(pool: &Pool, id: ExprId, is_one: &impl Fn(Node) -> bool) -> bool {
            match pool.get(id) {
                Node::Unary(op, of) => {
                    !matches!(
                        op,
                        Unary::Not | Unary::Round | Unary::Floor | Unary::Ceil | Unary::Sign
                    ) && measures(pool, of, is_one)
                }
                Node::Binary(op, a, b) => {
                    let reckoned = matches!(
                        op,
                        Binary::Add
                            | Binary::Sub
                            | Binary::Mul
                            | Binary::Div
                            | Binary::Hypot
                            | Binary::Atan2
                    );
                    reckoned && (measures(pool, a, is_one) || measures(pool, b, is_one))
                }
                one => is_one(one),
            }
        }
        let dim = of.ty.dim();
        let expr = of.scalar().filter(|_| dim.is_some());
        // A robot that need not turn may face one way all the time, and be where it was.
        let drive = self.subject_robot().map(|robot| robot.drive.kind);
        let turns = drive == Some(DriveKind::Differential);
        let is_one = |node| match node {
            Node::Pose(Pose::Heading) => turns,
            Node::Pose(_) | Node::Robot(..) => true,
            Node::NearestWall(echo) | Node::Wall(_, echo) => echo != Echo::Seen,
            Node::Input(_) => dim != Some(Dim::NONE),
            _ => false,
        };
        let pool = &self.program.pool;
        let mut kept = |part| matches!(part, Node::State(_) | Node::Local(_));
        expr.is_some_and(|id| measures(pool, id, &is_one) && !pool.any(id, &mut kept))
    }

    /// Whether this is a distance, which is not below zero.
    fn is_distance(&self, of: &Typed) -> bool {
        let pool = &self.program.pool;
        of.scalar().is_some_and(|id| match pool.get(id) {
            Node::Binary(Binary::Hypot, ..) => self.is_measure(of),
            _ => false,
        })
    }

    fn exact_measure(&mut self, equal: bool, at: Span) {
        if self.context.library {
            return;
        }
        let (message, label) = match equal {
            true => (
                "a measure is hardly ever just so much",
                "next to no tick meets this exactly",
            ),
            false => (
                "a measure is nearly always other than that",
                "nearly every tick meets this",
            ),
        };
        self.warning(Code::W0304, at, message)
            .label(label)
            .help("leave some room, as in `distance(home) <= 5 cm`");
    }

    /// Whether a name that is not declared may be a value of what its broken declaration does not tell.
    fn may_be_value(&self, of: &'a Expr, value: &'a Expr) -> bool {
        let (Some(of), Some(value)) = (plain_ref(of), plain_ref(value)) else {
            return false;
        };
        let value = value.name.name.as_str();
        let is_known = self.context.lookup(value).is_some()
            || self.names.value(value, self.context.library).is_some();
        self.names.is_lost(&of.name.name) && !is_known
    }

    /// A target as the number that says which one it is.
    fn told_by_code(&mut self, target: Typed) -> Typed {
        let code = self.code(&target.value);
        Typed::new(Type::NUMBER, code, target.span)
    }

    /// `base ^ exponent`: with a unit, the exponent has to be a whole constant.
    fn power(&mut self, base: &'a Expr, exponent: &'a Expr, span: Span) -> Option<Typed> {
        let base = self.expr(base);
        let power = self.expect(exponent, &Type::NUMBER, "an exponent");
        let dim = self.number(&base)?;
        let ty = if dim == Dim::NONE {
            Type::NUMBER
        } else {
            let known = power.scalar().and_then(|id| self.program.pool.constant(id));
            match known {
                Some(n) if n.fract() == 0.0 && n.abs() <= 16.0 => {
                    Type::Quantity(Dim::NONE.times(dim, n as i32))
                }
                _ if power.ty == Type::Error => return None,
                _ => {
                    return self
                        .error(
                            Code::E0308,
                            power.span,
                            format!("{dim} can only be raised to a whole constant"),
                        )
                        .label("the unit of the result would not be known")
                        .none();
                }
            }
        };
        Some(self.lift_binary(Binary::Pow, ty, &base, &power, span))
    }

    /// Both operands, if they are numbers of one dimension; reported if not.
    fn same_dimension(
        &mut self,
        op: ast::Spanned<BinaryOp>,
        (left, a): (&Expr, Typed),
        (right, b): (&Expr, Typed),
    ) -> Option<(Typed, Typed)> {
        let (x, y) = (self.number(&a), self.number(&b));
        let (x, y) = (x?, y?);
        if x == y {
            return Some((a, b));
        }
        let verb = match op.node {
            BinaryOp::Add => "added to",
            BinaryOp::Sub => "subtracted from",
            _ => "compared with",
        };
        let (one, other) = if op.node == BinaryOp::Sub {
            (&b.ty, &a.ty)
        } else {
            (&a.ty, &b.ty)
        };
        let message = format!("{one} cannot be {verb} {other}");
        // The side without a unit is the likely mistake.
        let declared = [left, right].map(|side| self.plain_constant(side));
        let (wrong, expr, fine, dim) = match declared {
            [Some(number), _] if x == Dim::NONE => (&a, number, &b, y),
            [None, _] if x == Dim::NONE && is_literal(left) => (&a, left, &b, y),
            [_, Some(number)] if y == Dim::NONE => (&b, number, &a, x),
            _ => (&b, right, &a, x),
        };
        let at = wrong.span;
        let elsewhere = (expr.span != left.span && expr.span != right.span).then_some(expr.span);
        let sums = matches!(op.node, BinaryOp::Add | BinaryOp::Sub);
        if self.context.region == Region::Reward && sums && wrong.ty == Type::NUMBER {
            let measure = if fine.span == right.span { right } else { left };
            let divided = fine.ty.dim().and_then(Dim::unit).map(|unit| {
                let whole = match measure.kind {
                    ExprKind::Ref(_) | ExprKind::Paren(_) | ExprKind::Number(_) => {
                        print::expr(measure)
                    }
                    _ => format!("({})", print::expr(measure)),
                };
                let right = format!("{whole} / 1 {unit}");
                (
                    format!("a reward is a plain number: write `{right}`"),
                    measure.span,
                    right,
                )
            });
            self.error(Code::E0301, at, message)
                .this_is(&wrong.ty)
                .also(fine.span, format!("this is {}", fine.ty))
                .also_if(elsewhere, "declared without a unit")
                .fix_if(divided);
            return None;
        }
        self.error(Code::E0301, at, message)
            .this_is(&wrong.ty)
            .also(fine.span, format!("this is {}", fine.ty))
            .also_if(elsewhere, "declared without a unit")
            .unit_for(expr, Some(dim))
            .minutes(expr, Some(dim))
            .emit();
        self.clashes(left, at, &b.ty);
        self.clashes(right, at, &a.ty);
        None
    }

    /// Reports why two values are not compared: they are of different types, or such values are never compared.
    fn incomparable(&mut self, op: Span, a: &Typed, b: &Typed) {
        if a.ty != b.ty {
            let message = format!("{} cannot be compared with {}", a.ty, b.ty);
            let target = [(a, b), (b, a)]
                .into_iter()
                .find(|(target, other)| target.ty.is_named_target() && other.ty.dim().is_some());
            let help = match (&a.ty, &b.ty) {
                _ if target.is_some() => Some("how far something is: `distance(…)`".to_owned()),
                (Type::Enum(of), _) | (_, Type::Enum(of)) => {
                    let variants = self.variants(of);
                    let names: Vec<String> = variants.iter().map(ToString::to_string).collect();
                    let names: Vec<&str> = names.iter().map(String::as_str).collect();
                    Some(format!("`{of}` has {}", listed(&names, "and")))
                }
                (Type::Target, Type::Nowhere) | (Type::Nowhere, Type::Target) => Some(
                    "what is nowhere is infinitely far: `distance(…) < 100 m` does not hold of it"
                        .to_owned(),
                ),
                (Type::Point, _) | (_, Type::Point) => Some(
                    "of a point the coordinates are compared, `p.x` and `p.y`, or how far it is: `distance(p)`"
                        .to_owned(),
                ),
                _ => None,
            };
            self.error(Code::E0302, b.span, message)
                .this_is(&b.ty)
                .also(a.span, format!("this is {}", a.ty))
                .help_if(help);
            return;
        }
        if (&a.ty, &b.ty) == (&Type::Point, &Type::Point) {
            self.error(Code::E0302, op, "two points are hardly ever the same")
                .label("points are not compared")
                .help("how far apart they are: `distance(POINT, POINT) < 10 cm`");
            return;
        }
        let (message, label) = match a.ty {
            Type::Bool => (
                "truth values have no order",
                "only `==` and `!=` compare them",
            ),
            Type::Enum(_) => (
                "the values of an enum have no order",
                "only `==` and `!=` compare them",
            ),
            Type::Place(_) | Type::Wall(_) | Type::Robot | Type::Sensor | Type::Nowhere => {
                ("targets have no order", "only `==` and `!=` compare them")
            }
            _ => (
                "only numbers, truth values, enums and targets are compared",
                "these are none of them",
            ),
        };
        self.error(Code::E0302, op, message)
            .label(label)
            .also(a.span, format!("this is {}", a.ty));
    }

    /// A value computed from scalars; unknown if one of them is.
    pub fn lift<const N: usize>(
        &mut self,
        ty: Type,
        span: Span,
        operands: [&Typed; N],
        make: impl FnOnce(&mut Pool, [ExprId; N]) -> ExprId,
    ) -> Typed {
        let ids: Option<Vec<ExprId>> = operands.iter().map(|operand| operand.scalar()).collect();
        let ids = ids.and_then(|ids| ids.try_into().ok());
        Typed::new(ty, ids.map(|ids| make(&mut self.program.pool, ids)), span)
    }

    fn lift_binary(&mut self, op: Binary, ty: Type, a: &Typed, b: &Typed, span: Span) -> Typed {
        self.lift(ty, span, [a, b], |pool, [a, b]| pool.binary(op, a, b))
    }
}
