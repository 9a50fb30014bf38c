//! Exact solutions against naive ones.

use btc::learn::average;
use btc::learn::solve::{Outlook, Problem};
use btc::random::Random;

/// A random problem: some choices end, some states have none.
fn random_problem(random: &mut Random, states: usize, discount: f64) -> Problem {
    let choice = |random: &mut Random| {
        let ends = random.unit() * 0.3;
        let mut next: Vec<(usize, f64)> = (0..3)
            .map(|_| (random.below(states as u64) as usize, random.unit()))
            .collect();
        let sum: f64 = next.iter().map(|(_, weight)| weight).sum();
        for (_, weight) in &mut next {
            *weight *= discount * (1.0 - ends) / sum;
        }
        Outlook {
            reward: random.gaussian(),
            ticks: (1 + random.below(40)) as f64,
            next,
        }
    };
    Problem {
        states: (0..states)
            .map(|_| {
                let choices = random.below(4) as usize;
                (0..choices).map(|c| (c, choice(random))).collect()
            })
            .collect(),
        unknown: 0.25,
    }
}

/// v ← max over the choices, or what the policy takes, again and again, from nothing.
fn value_iteration(problem: &Problem, policy: Option<&[Option<usize>]>) -> Vec<f64> {
    let mut values = vec![0.0; problem.states.len()];
    for _ in 0..5000 {
        let old = values.clone();
        for (state, choices) in problem.states.iter().enumerate() {
            let worth = choices.iter().enumerate().filter_map(|(at, (_, outlook))| {
                if policy.is_some_and(|policy| policy[state] != Some(at)) {
                    return None;
                }
                let next = outlook.next.iter().map(|&(to, p)| p * old[to]);
                Some(outlook.reward + next.sum::<f64>())
            });
            values[state] = worth.reduce(f64::max).unwrap_or(problem.unknown);
        }
    }
    values
}

fn same(a: &[f64], b: &[f64]) {
    assert_eq!(a.len(), b.len());
    for (a, b) in a.iter().zip(b) {
        assert!((a - b).abs() < 1e-7, "{a} is not {b}");
    }
}

#[test]
fn policy_iteration_finds_what_value_iteration_finds() {
    let mut random = Random::new(1, 0, 0);
    for round in 0..40 {
        let problem = random_problem(&mut random, 1 + round, 0.97);
        let solution = problem.solve();
        same(&solution.values, &value_iteration(&problem, None));
        same(
            &problem.evaluate(&solution.policy),
            &value_iteration(&problem, Some(&solution.policy)),
        );
    }
}

#[test]
fn a_policy_is_worth_what_iteration_says() {
    let mut random = Random::new(2, 0, 0);
    for _ in 0..20 {
        let problem = random_problem(&mut random, 30, 0.95);
        let any = problem.states.iter().map(|choices| {
            let n = choices.len() as u64;
            (n > 0).then(|| random.below(n) as usize)
        });
        let policy: Vec<Option<usize>> = any.collect();
        let naive = value_iteration(&problem, Some(&policy));
        same(&problem.evaluate(&policy), &naive);
    }
}

#[test]
fn more_states_than_are_eliminated_are_swept() {
    let corridor = |n: usize| Problem {
        states: (0..n)
            .map(|cell| {
                let next = if cell + 1 < n {
                    vec![(cell + 1, 0.99)]
                } else {
                    vec![]
                };
                let outlook = Outlook {
                    reward: 1.0,
                    ticks: 1.0,
                    next,
                };
                vec![(0, outlook)]
            })
            .collect(),
        unknown: 0.0,
    };
    for n in [10, 700] {
        let value = corridor(n).solve().values[0];
        let geometric = (1.0 - 0.99_f64.powi(n as i32)) / 0.01;
        assert!((value - geometric).abs() < 1e-6, "{value}");
    }
}

#[test]
fn where_states_are_many_the_beginning_decides_nothing() {
    let mut random = Random::new(4, 0, 0);
    for states in [700, 900] {
        let problem = random_problem(&mut random, states, 0.99);
        assert!(problem.is_large());
        let solution = problem.solve();
        same(&solution.values, &value_iteration(&problem, None));
        let mut begun = problem.unsolved();
        for (choices, taken) in problem.states.iter().zip(&mut begun.policy) {
            *taken = taken.map(|_| random.below(choices.len() as u64) as usize);
        }
        let values = begun.values.iter_mut();
        values.for_each(|value| *value = 100.0 * random.gaussian());
        same(&problem.solve_from(begun).values, &solution.values);
    }
}

#[test]
fn without_discount_and_end_there_is_an_answer_still() {
    let forever = Outlook {
        reward: -1.0,
        ticks: 1.0,
        next: vec![(0, 1.0)],
    };
    let problem = Problem {
        states: vec![vec![(0, forever)]],
        unknown: 0.0,
    };
    let solution = problem.solve();
    assert_eq!(solution.policy, [Some(0)]);
    assert!(solution.values[0] < -1000.0 && solution.values[0].is_finite());
}

#[test]
fn the_average_is_the_greatest_of_all_policies() {
    let mut random = Random::new(3, 0, 0);
    for _ in 0..60 {
        let problem = random_problem(&mut random, 5, 1.0);
        let starts = [(0, 3.0), (2, 1.0)];
        let (average, solution) = average::solve(&problem, &starts, problem.unsolved());
        let of = |policy: &[Option<usize>]| average::gain(&problem, policy, &starts);
        assert!((of(&solution.policy) - average).abs() < 1e-9);
        let all = policies(&problem);
        let best = all
            .iter()
            .map(|policy| of(policy))
            .fold(f64::NEG_INFINITY, f64::max);
        assert!((average - best).abs() < 1e-9, "{average} is not {best}");
    }
}

/// Every policy of a problem.
fn policies(problem: &Problem) -> Vec<Vec<Option<usize>>> {
    let mut policies = vec![Vec::new()];
    for choices in &problem.states {
        let n = choices.len();
        let taken: Vec<Option<usize>> = match n {
            0 => vec![None],
            _ => (0..n).map(Some).collect(),
        };
        let with = |policy: &Vec<Option<usize>>| -> Vec<Vec<Option<usize>>> {
            let longer = taken
                .iter()
                .map(|&choice| [policy.as_slice(), &[choice]].concat());
            longer.collect()
        };
        policies = policies.iter().flat_map(with).collect();
    }
    policies
}

/// One way brings 1 in 2 ticks, the other 3 in 10: the sum of a discounted decision is for the second, the average of
/// a tick for the first.
#[test]
fn an_average_counts_the_time() {
    let again = |reward, ticks| Outlook {
        reward,
        ticks,
        next: vec![(0, 0.9)],
    };
    let problem = Problem {
        states: vec![vec![(0, again(3.0, 10.0)), (1, again(1.0, 2.0))]],
        unknown: 0.0,
    };
    assert_eq!(problem.solve().policy, [Some(0)]);
    let (average, solution) = average::solve(&problem, &[(0, 1.0)], problem.unsolved());
    assert_eq!(solution.policy, [Some(1)]);
    assert!((average - 0.5).abs() < 1e-12);
    // A start is worth nothing over the average.
    assert!(solution.values[0].abs() < 1e-9);
}
