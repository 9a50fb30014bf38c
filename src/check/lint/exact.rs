//! Quantities that are to be exactly so much, and pass over that.

use super::stays::{Set, all_settings};
use crate::check::Checker;
use crate::check::types::Typed;
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Draw, Expr, ExprId};
use crate::ir::program::State;
use crate::ir::{Id, Pool};
use crate::source::Span;
use crate::syntax::ast::{self, BinaryOp, Spanned};
use std::collections::BTreeMap;

/// A state that is to be exactly so much, or anything but that.
#[derive(Clone, Copy, Debug)]
pub struct Equality<'a> {
    /// The operator.
    op: Spanned<BinaryOp>,
    /// What is asked, as it is written.
    left: &'a ast::Expr,
    state: Id<State>,
    value: f64,
}

/// How a quantity changes: the values that it is set to, and the amounts by which it changes.
#[derive(Default)]
struct Course {
    set: Vec<f64>,
    steps: Vec<f64>,
}

/// The most sums that are looked at, and the most ways to come to them: with more, it may come to any value.
const FOLLOWED: usize = 20_000;
const WAYS: usize = 64;

/// Sums of multiples of this are exact.
const EXACT: f64 = 1.0 / 1024.0;

impl<'a> Checker<'a> {
    /// Notes a comparison of a state with a constant by `==` or `!=`.
    pub fn equal_to(&mut self, op: Spanned<BinaryOp>, left: &'a ast::Expr, [a, b]: [&Typed; 2]) {
        let equality = matches!(op.node, BinaryOp::Eq | BinaryOp::Ne);
        if self.context.library || !equality || a.ty.dim().is_none() {
            return;
        }
        let pool = &self.program.pool;
        let of = a.scalar().map(|id| pool.get(id));
        let value = b.scalar().and_then(|id| pool.constant(id));
        if let (Some(Expr::State(state)), Some(value)) = (of, value) {
            self.equalities.push(Equality {
                op,
                left,
                state,
                value,
            });
        }
    }

    /// Warns of quantities that pass over what they are to be equal to.
    pub fn passed_over(&mut self) {
        let told = self.told();
        let mut places: BTreeMap<Span, Vec<Equality>> = BTreeMap::new();
        for equality in std::mem::take(&mut self.equalities) {
            places.entry(equality.op.span).or_default().push(equality);
        }
        let settings = all_settings(&self.program);
        for (at, equalities) in places {
            let passed = equalities.iter().map(|it| self.passes(it, &settings));
            let passed: Option<Vec<Course>> = passed.collect();
            let (Some(first), Some(passed)) = (equalities.first(), passed) else {
                continue;
            };
            let of = first.left.span;
            if told.overlap(at) || told.overlap(of) {
                continue;
            }
            let mut steps = passed.iter().flat_map(|course| &course.steps);
            let (less, more) = (
                steps.clone().any(|step| *step < 0.0),
                steps.any(|step| *step > 0.0),
            );
            let name = &self.program.states[first.state].name.family;
            let holds = match first.op.node {
                BinaryOp::Ne => "nearly always",
                _ => "hardly ever",
            };
            let message = match first.op.node {
                BinaryOp::Ne => format!("`{name}` is nearly always other than that"),
                _ => format!("`{name}` is hardly ever just so much"),
            };
            let right = match (first.op.node, less, more) {
                (BinaryOp::Eq, true, false) => Some("<="),
                (BinaryOp::Eq, false, true) => Some(">="),
                (BinaryOp::Ne, true, false) => Some(">"),
                (BinaryOp::Ne, false, true) => Some("<"),
                _ => None,
            };
            let fix = right.map(|right| (format!("write `{right}`"), at, right.to_owned()));
            let help = right.is_none().then(|| "ask for a range".to_owned());
            self.warning(Code::W0304, at, message)
                .label(format!("this {holds} holds"))
                .note("what is added is rounded, and sums of it pass over a value")
                .fix_if(fix)
                .help_if(help);
        }
    }

    /// The course of a state that passes over a value; `None` if it may come to it, as far as that is known.
    fn passes(&self, equality: &Equality, settings: &Set) -> Option<Course> {
        let pool = &self.program.pool;
        let mut course = Course::default();
        course
            .set
            .extend(pool.constant(self.program.states[equality.state].initial));
        for (_, value) in settings.get(&equality.state)? {
            course.follow(pool, equality.state, *value)?;
        }
        let Course { set, steps } = &course;
        if set.len() * steps.len() > WAYS {
            return None;
        }
        let is_exact = |value: &f64| (value / EXACT).fract() == 0.0;
        let exact = steps.iter().all(is_exact) && set.iter().all(is_exact);
        let comes = |from: &f64| {
            let mut steps = steps.iter();
            *from == equality.value || steps.any(|step| comes_to(equality.value, *from, *step))
        };
        (!exact && !steps.is_empty() && !set.iter().any(comes)).then_some(course)
    }
}

impl Course {
    /// Adds what a setting of a state does; `None` if that is not known.
    fn follow(&mut self, pool: &Pool, state: Id<State>, value: ExprId) -> Option<()> {
        if let Some(value) = pool.constant(value) {
            self.set.push(value);
            return Some(());
        }
        let is_own = |id: ExprId| pool.get(id) == Expr::State(state);
        match pool.get(value) {
            Expr::State(own) if own == state => Some(()),
            // A draw comes to one value with probability 0.
            Expr::Draw(_, Draw::Uniform(..) | Draw::Normal(..)) => Some(()),
            Expr::Select(_, one, other) => {
                self.follow(pool, state, one)?;
                self.follow(pool, state, other)
            }
            Expr::Binary(Binary::Min | Binary::Max, a, b) => {
                self.follow(pool, state, a)?;
                self.follow(pool, state, b)
            }
            Expr::Binary(Binary::Add, a, b) if is_own(a) => self.step(pool, b, 1.0),
            Expr::Binary(Binary::Add, a, b) if is_own(b) => self.step(pool, a, 1.0),
            Expr::Binary(Binary::Sub, a, b) if is_own(a) => self.step(pool, b, -1.0),
            _ => None,
        }
    }

    /// Adds an amount by which it changes.
    fn step(&mut self, pool: &Pool, amount: ExprId, sign: f64) -> Option<()> {
        if let Some(amount) = pool.constant(amount) {
            self.steps.push(sign * amount);
            return Some(());
        }
        match pool.get(amount) {
            Expr::Select(_, one, other) => {
                self.step(pool, one, sign)?;
                self.step(pool, other, sign)
            }
            _ => None,
        }
    }
}

/// Whether a sum of steps comes to a value exactly.
fn comes_to(value: f64, from: f64, step: f64) -> bool {
    let ahead = |at: &f64| (value - at) * step >= 0.0 && step != 0.0;
    let sums = std::iter::successors(Some(from), |at| Some(at + step));
    let mut sums = sums.take(FOLLOWED).take_while(ahead);
    sums.any(|at| at == value)
}
