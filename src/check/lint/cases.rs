//! Conditions by cases: when one holds, as far as literals show.
//!
//! A case is a conjunction of literals, a condition a disjunction of cases. Whatever grows too large is taken to be
//! possible. What is not a number is left out of account.

use crate::ir::expr::{Binary, Expr, ExprId, Unary};
use crate::ir::tree::{Atom, Guard};
use crate::ir::{Pool, Program};
use std::collections::BTreeMap;

/// How many cases a condition may have.
const MOST: usize = 128;

/// How many literals a case keeps.
const LONGEST: usize = 64;

/// How deeply a condition may nest.
const DEEPEST: usize = 64;

/// What a literal is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum About {
    /// The truth of an expression.
    Truth(ExprId),
    /// The truth of an atom without a definition.
    Atom(Atom),
    /// The number that an expression is.
    Number(ExprId),
}

/// What a literal says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Says {
    Is(bool),
    Within(Interval),
}

/// An interval of numbers; an end that is open does not belong to it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    low: f64,
    low_open: bool,
    high: f64,
    high_open: bool,
}

impl Interval {
    fn below(high: f64, high_open: bool) -> Self {
        Self {
            low: f64::NEG_INFINITY,
            low_open: true,
            high,
            high_open,
        }
    }

    fn above(low: f64, low_open: bool) -> Self {
        Self {
            low,
            low_open,
            high: f64::INFINITY,
            high_open: true,
        }
    }

    fn just(value: f64) -> Self {
        Self {
            low: value,
            low_open: false,
            high: value,
            high_open: false,
        }
    }

    fn is_empty(self) -> bool {
        self.low > self.high || self.low == self.high && (self.low_open || self.high_open)
    }

    fn and(self, other: Self) -> Self {
        let (low, low_open) = if (other.low, other.low_open) > (self.low, self.low_open) {
            (other.low, other.low_open)
        } else {
            (self.low, self.low_open)
        };
        let (high, high_open) = if (other.high, self.high_open) < (self.high, other.high_open) {
            (other.high, other.high_open)
        } else {
            (self.high, self.high_open)
        };
        Self {
            low,
            low_open,
            high,
            high_open,
        }
    }
}

/// A conjunction of literals, none of which contradicts another.
pub type Case = BTreeMap<About, Says>;

/// When a condition holds.
#[derive(Clone, Debug, PartialEq)]
pub enum Cases {
    /// In one of these cases, and in no other.
    Some(Vec<Case>),
    /// Nothing is known.
    Unknown,
}

impl Cases {
    /// A condition that holds always, or never.
    pub fn constant(holds: bool) -> Self {
        Self::Some(if holds { vec![Case::new()] } else { Vec::new() })
    }

    /// Whether it cannot hold.
    pub fn is_never(&self) -> bool {
        matches!(self, Self::Some(cases) if cases.is_empty())
    }

    /// Both hold.
    #[must_use]
    pub fn and(&self, other: &Self) -> Self {
        let (ours, theirs) = match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) => (ours, theirs),
            (never, _) | (_, never) if never.is_never() => return Self::constant(false),
            // What is not known cannot rule anything out.
            (Self::Unknown, known) | (known, Self::Unknown) => return known.clone(),
        };
        if ours.len() * theirs.len() > MOST {
            return Self::Unknown;
        }
        let pairs = ours.iter().flat_map(|a| theirs.iter().map(move |b| (a, b)));
        Self::Some(pairs.filter_map(|(a, b)| joined(a, b)).collect())
    }

    /// One of them holds.
    #[must_use]
    pub fn or(&self, other: &Self) -> Self {
        match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) if ours.len() + theirs.len() <= MOST => {
                Self::Some(ours.iter().chain(theirs).cloned().collect())
            }
            _ => Self::Unknown,
        }
    }

    /// Whether the other one holds wherever this one does; false where that is not known.
    pub fn implies(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Some(ours), Self::Some(theirs)) => {
                ours.iter().all(|a| theirs.iter().any(|b| covers(b, a)))
            }
            _ => false,
        }
    }

    fn one(about: About, says: Says) -> Self {
        match says {
            Says::Within(interval) if interval.is_empty() => Self::constant(false),
            _ => Self::Some(vec![Case::from([(about, says)])]),
        }
    }
}

/// Both cases at once; `None` if they contradict each other.
fn joined(a: &Case, b: &Case) -> Option<Case> {
    let mut case = a.clone();
    for (about, says) in b {
        let says = match (case.get(about), says) {
            (None, _) if case.len() >= LONGEST => continue,
            (None, says) => *says,
            (Some(Says::Within(a)), Says::Within(b)) => {
                Says::Within(Some(a.and(*b)).filter(|both| !both.is_empty())?)
            }
            (Some(a), b) => Some(*a).filter(|a| a == b)?,
        };
        case.insert(*about, says);
    }
    Some(case)
}

/// Whether the wider case holds wherever the narrower one does.
fn covers(wider: &Case, narrower: &Case) -> bool {
    wider
        .iter()
        .all(|(about, wide)| match (wide, narrower.get(about)) {
            (Says::Within(wide), Some(Says::Within(narrow))) => wide.and(*narrow) == *narrow,
            (wide, narrow) => narrow == Some(wide),
        })
}

/// When an expression is true, or when it is not, as `wanted` says.
pub fn of_expr(program: &Program, id: ExprId, wanted: bool) -> Cases {
    expr(program, id, wanted, 0)
}

/// When a guard holds, or when it does not, as `wanted` says.
pub fn of_guard(program: &Program, guard: &Guard, wanted: bool) -> Cases {
    let parts = |guards: &[Guard], all: bool| {
        let parts = guards.iter().map(|guard| of_guard(program, guard, wanted));
        let first = Cases::constant(all == wanted);
        parts.fold(first, |so_far, part| match all == wanted {
            true => so_far.and(&part),
            false => so_far.or(&part),
        })
    };
    match guard {
        Guard::Const(value) => Cases::constant(*value == wanted),
        Guard::Not(guard) => of_guard(program, guard, !wanted),
        Guard::And(guards) => parts(guards, true),
        Guard::Or(guards) => parts(guards, false),
        Guard::Atom(Atom::Predicate(id)) if let Some(when) = program.predicates[*id].when => {
            of_expr(program, when, wanted)
        }
        Guard::Atom(atom) => Cases::one(About::Atom(*atom), Says::Is(wanted)),
    }
}

fn expr(program: &Program, id: ExprId, wanted: bool, depth: usize) -> Cases {
    if depth > DEEPEST {
        return Cases::Unknown;
    }
    let pool = &program.pool;
    let of = |id, wanted| expr(program, id, wanted, depth + 1);
    match pool.get(id) {
        Expr::Bool(value) => Cases::constant(value == wanted),
        Expr::Unary(Unary::Not, a) => of(a, !wanted),
        Expr::Binary(op @ (Binary::And | Binary::Or), a, b) => {
            let (a, b) = (of(a, wanted), of(b, wanted));
            if (op == Binary::And) == wanted {
                a.and(&b)
            } else {
                a.or(&b)
            }
        }
        Expr::Event(event) => of(program.events[event].when, wanted),
        Expr::Binary(op, a, b) => match comparison(pool, op, a, b, wanted) {
            Some((about, interval)) => Cases::one(About::Number(about), Says::Within(interval)),
            None => Cases::one(About::Truth(id), Says::Is(wanted)),
        },
        _ => Cases::one(About::Truth(id), Says::Is(wanted)),
    }
}

/// A comparison with a constant: what is compared, and where it has to be.
fn comparison(
    pool: &Pool,
    op: Binary,
    a: ExprId,
    b: ExprId,
    wanted: bool,
) -> Option<(ExprId, Interval)> {
    let open = op == Binary::Lt;
    match (pool.constant(a), pool.constant(b), op) {
        (None, Some(b), Binary::Lt | Binary::Le) => Some(if wanted {
            (a, Interval::below(b, open))
        } else {
            (a, Interval::above(b, !open))
        }),
        (Some(a), None, Binary::Lt | Binary::Le) => Some(if wanted {
            (b, Interval::above(a, open))
        } else {
            (b, Interval::below(a, !open))
        }),
        (None, Some(value), Binary::Eq) if wanted => Some((a, Interval::just(value))),
        (Some(value), None, Binary::Eq) if wanted => Some((b, Interval::just(value))),
        (None, Some(value), Binary::Ne) if !wanted => Some((a, Interval::just(value))),
        (Some(value), None, Binary::Ne) if !wanted => Some((b, Interval::just(value))),
        _ => None,
    }
}
