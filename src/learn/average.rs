//! The greatest average reward a tick (semi-Markov decision problems: Puterman 1994, chapter 11).
//!
//! An episode that an event ends begins anew from a start, so the average is that of a renewal process: the expected
//! reward of an episode by its expected length. What the tick limit cuts would have gone on.
//!
//! Where two parts of a problem do not lead to each other there is no single average. A restart with a probability of
//! 10⁻⁵ in each tick, which is the discount of [`discount`], joins them: each counts as often as it is entered from
//! the starts.

use super::solve::{Problem, Solution};
use crate::ir::task::Discount;

/// That no restart happens in a tick.
const CONTINUES: f64 = 1.0 - 1e-5;

/// The discount of what follows a decision, by a tick of this many seconds.
pub fn discount(tick: f64) -> Discount {
    Discount::PerTime(CONTINUES, tick)
}

/// The most improvements; few are needed, since they converge faster than linearly.
const ROUNDS: usize = 50;

/// The average reward a tick of a policy whose episodes start in these states, each with its weight: the ratio of
/// the expected reward and the expected ticks up to a restart.
pub fn gain(problem: &Problem, policy: &[Option<usize>], starts: &[(usize, f64)]) -> f64 {
    let at_start = |problem: &Problem| {
        let values = problem.evaluate(policy);
        let of = |&(state, weight): &(usize, f64)| values.get(state).map_or(0.0, |v| weight * v);
        starts.iter().map(of).sum::<f64>()
    };
    let ticks = at_start(&problem.of_ticks());
    if ticks > 0.0 {
        at_start(problem) / ticks
    } else {
        0.0
    }
}

/// The greatest average reward a tick, and its policy with the relative values of the states: what is gained from there up
/// to a restart over what the average would bring in the same time. `near` is a solution that may be near.
///
/// The ratio is made greatest by the method of Dinkelbach (1967): the best policy where each tick costs the average so
/// far has a greater average, until it has the same.
pub fn solve(problem: &Problem, starts: &[(usize, f64)], near: Solution) -> (f64, Solution) {
    let mut average = gain(problem, &near.policy, starts);
    let mut solution = problem.at_cost(average).solve_near(near);
    for _ in 0..ROUNDS {
        let next = gain(problem, &solution.policy, starts);
        if next <= average + 1e-12 * (1.0 + average.abs()) {
            break;
        }
        average = next;
        solution = problem.at_cost(average).solve_near(solution);
    }
    (average, solution)
}
