//! Linear equations, solved by elimination.

/// One equation: its coefficients, and behind them its right side.
pub(super) type Equation = Vec<f64>;

/// The solution of as many equations as there are unknowns, by Gaussian elimination with partial pivoting; `None` if there is
/// not just one.
///
/// An equation without the unknown that is eliminated is passed over: where states lead to a few others, most are.
pub(super) fn solved(mut equations: Vec<Equation>) -> Option<Vec<f64>> {
    let count = equations.len();
    for at in 0..count {
        let size = |equation: &Equation| equation.get(at).map_or(0.0, |it| it.abs());
        let (mut pivot, mut most) = (at, equations.get(at).map(size)?);
        for (row, equation) in equations.iter().enumerate().skip(at + 1) {
            if size(equation) > most {
                (pivot, most) = (row, size(equation));
            }
        }
        if most == 0.0 {
            return None;
        }
        equations.swap(at, pivot);
        let (above, below) = equations.split_at_mut(at + 1);
        let pivot = above.last()?.get(at..)?;
        let inverse = 1.0 / pivot.first()?;
        for equation in below {
            let own = equation.get_mut(at..)?;
            let (first, own) = own.split_first_mut()?;
            if *first == 0.0 {
                continue;
            }
            let factor = *first * inverse;
            for (own, pivot) in own.iter_mut().zip(pivot.iter().skip(1)) {
                *own -= pivot * factor;
            }
        }
    }
    let mut values: Vec<f64> = equations
        .iter()
        .map(|it| it.last().copied())
        .collect::<Option<_>>()?;
    for (at, equation) in equations.iter().enumerate().rev() {
        let (before, from) = values.split_at_mut_checked(at)?;
        let value = from.first_mut()?;
        *value /= equation.get(at)?;
        for (before, equation) in before.iter_mut().zip(&equations) {
            *before -= *value * equation.get(at)?;
        }
    }
    Some(values)
}

#[cfg(test)]
mod tests {
    use super::{Equation, solved};
    use nalgebra::{DMatrix, DVector};

    /// Equations of random numbers, of which only some are not 0.
    fn random(count: usize, filled: f64, seed: &mut u64) -> Vec<Equation> {
        let mut next = || {
            *seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (*seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        let mut equation = |row: usize| -> Equation {
            let mut coefficient = |column: usize| {
                let (fill, value) = (next(), next());
                let value = if fill < filled {
                    2.0 * value - 1.0
                } else {
                    0.0
                };
                value + f64::from(u8::from(row == column && filled < 1.0))
            };
            (0..=count).map(&mut coefficient).collect()
        };
        (0..count).map(&mut equation).collect()
    }

    /// The solution is that of another implementation, bit for bit: the order of the operations is the same.
    #[test]
    fn the_solution_is_that_of_an_lu_decomposition() {
        let mut seed = 7;
        let mut solvable = 0;
        for round in 0..400 {
            let (count, filled) = (1 + round % 22, [0.05, 0.2, 0.6, 1.0][round % 4]);
            let equations = random(count, filled, &mut seed);
            let matrix = DMatrix::from_fn(count, count, |row, column| equations[row][column]);
            let right = DVector::from_fn(count, |row, _| equations[row][count]);
            let expected = matrix.lu().solve(&right);
            let expected = expected.map(|values| values.iter().copied().collect::<Vec<_>>());
            let found = solved(equations);
            solvable += usize::from(found.is_some());
            assert_eq!(found, expected);
        }
        assert!(solvable > 300);
    }

    #[test]
    fn equations_without_a_single_solution_have_none() {
        assert_eq!(solved(vec![vec![1.0, 1.0, 2.0], vec![1.0, 1.0, 2.0]]), None);
        assert_eq!(solved(vec![vec![0.0, 1.0]]), None);
        assert_eq!(solved(Vec::new()), Some(Vec::new()));
    }
}
