//! The values that a variable comes to which its own value sets: by widening, as abstract interpretation calls it.

use super::ranges::range;
use super::view::View;
use crate::ir::Pool;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::program::Stays;
use std::ops::Range;

/// The numbers from the least to the greatest that a variable comes to; `first` are those that it begins with.
///
/// `given` says what some of its `count` settings give, where the variable has these values. An end that a setting moves is
/// moved for ever, unless the bounds that other settings have hold it.
pub fn settle(
    first: &Stays,
    count: usize,
    given: &mut dyn FnMut(&Stays, Range<usize>) -> Stays,
) -> Stays {
    let mut step = |stays: &Stays| first.clone().or(&given(stays, 0..count));
    let widened = first.widened(&step(first));
    let mut bounded = first.clone();
    for at in 0..count {
        bounded = bounded.or_finite(&given(&widened, at..at + 1));
    }
    let mut step = |stays: &Stays| first.clone().or(&given(stays, 0..count));
    let halves = [bounded.endless(true, false), bounded.endless(false, true)];
    for stays in [bounded].into_iter().chain(halves).chain([widened]) {
        let next = step(&stays);
        if stays.clone().or(&next) == stays {
            return next;
        }
    }
    step(&Stays::ANY)
}

/// What a variable may be that is set to each of these: numbers, or, by their bits, truth values and values of an enum.
///
/// Of those nothing is found out where it is not set to one of them as such; what is set to itself stays as it is.
pub fn one_of_these<'p>(
    pool: &Pool,
    variable: Expr,
    by_bits: bool,
    mut settings: impl Iterator<Item = (View<'p>, ExprId)>,
) -> Stays {
    if by_bits {
        let among = settings.try_fold(0, |all, (_, value)| {
            Some(all | bits(pool, variable, value)?)
        });
        return Stays::Among(among.unwrap_or(u64::MAX));
    }
    let none = Stays::Within(f64::INFINITY..=f64::NEG_INFINITY);
    settings.fold(none, |all, (view, value)| {
        let (low, high) = range(view, value).ends();
        all.or(&Stays::Within(low..=high))
    })
}

/// The values that an expression may have, as bits; none of its own for the variable itself. `None`: any.
fn bits(pool: &Pool, variable: Expr, value: ExprId) -> Option<u64> {
    match pool.get(value) {
        Expr::Num(index) => bit(index),
        Expr::Bool(value) => bit(f64::from(value)),
        own if own == variable => Some(0),
        Expr::Select(_, one, other) => {
            Some(bits(pool, variable, one)? | bits(pool, variable, other)?)
        }
        _ => None,
    }
}

fn bit(index: f64) -> Option<u64> {
    let fits = index >= 0.0 && index < f64::from(u64::BITS);
    fits.then(|| 1 << index as u32)
}

impl Stays {
    /// Whether this is one value.
    pub fn is_one(&self) -> bool {
        match self {
            Self::Within(ends) => ends.start() == ends.end(),
            Self::Among(among) => among.count_ones() == 1,
        }
    }

    /// One of these, or one of those.
    #[must_use]
    pub fn or(self, other: &Self) -> Self {
        match (self, other) {
            (Self::Within(one), Self::Within(other)) => {
                let low = one.start().min(*other.start());
                Self::Within(low..=one.end().max(*other.end()))
            }
            (Self::Among(one), Self::Among(other)) => Self::Among(one | other),
            _ => Self::ANY,
        }
    }

    /// One of these numbers, or one up to an end of those that is finite.
    #[must_use]
    fn or_finite(self, other: &Self) -> Self {
        let Self::Within(ends) = other else {
            return Self::ANY;
        };
        let ends = [*ends.start(), *ends.end()].into_iter();
        ends.filter(|end| end.is_finite())
            .fold(self, |all, end| all.or(&Self::Within(end..=end)))
    }

    /// These numbers, with all that is less, or all that is greater.
    #[must_use]
    pub fn endless(&self, less: bool, greater: bool) -> Self {
        let Self::Within(ends) = self else {
            return Self::ANY;
        };
        let low = if less {
            f64::NEG_INFINITY
        } else {
            *ends.start()
        };
        let high = if greater { f64::INFINITY } else { *ends.end() };
        Self::Within(low..=high)
    }

    /// These numbers, without an end in a direction in which the other ones go on.
    #[must_use]
    fn widened(&self, other: &Self) -> Self {
        let (Self::Within(one), Self::Within(other)) = (self, other) else {
            return Self::ANY;
        };
        let low = if other.start() < one.start() {
            f64::NEG_INFINITY
        } else {
            *one.start()
        };
        let high = if other.end() > one.end() {
            f64::INFINITY
        } else {
            *one.end()
        };
        Self::Within(low..=high)
    }
}
