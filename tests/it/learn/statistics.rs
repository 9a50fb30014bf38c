//! Statistics against printed values and an independent library.

use crate::program::{NoFiles, shown};
use btc::driver::load::load;
use btc::learn::binomial::{lower95, upper95};
use btc::learn::bootstrap::{interquartile_mean, interval95, quantile};
use btc::learn::curve::Point;
use btc::learn::episode::Episode;
use btc::learn::poisson;
use btc::learn::rate::Rate;
use btc::learn::statistics::{Mean, Summary};
use btc::random::Random;
use btc::report::curve;
use btc::report::ends::{EndLine, Ended};
use btc::world::End;
use statrs::distribution::{Beta, ContinuousCDF, Gamma};

#[test]
fn the_interquartile_mean_cuts_a_quarter_at_either_end() {
    assert_eq!(
        interquartile_mean(&[5.0, 8.0, 4.0, 38.0, 8.0, 6.0, 9.0, 7.0, 7.0, 3.0, 1.0, 6.0]),
        6.5
    );
    // Nine values: 2¼ are cut at either end, so the third and the seventh count three quarters.
    let odd: Vec<f64> = (0..9).map(|i| f64::from(2 * i + 1)).collect();
    assert_eq!(interquartile_mean(&odd), 9.0);
    assert_eq!(
        interquartile_mean(&[1.0, 2.0, 6.0]),
        (0.25 + 2.0 + 1.5) / 1.5 - 0.0
    );
    assert_eq!(interquartile_mean(&[4.0]), 4.0);
    assert_eq!(interquartile_mean(&[]), 0.0);
}

#[test]
fn quantiles_lie_between_neighbours() {
    let values = [1.0, 2.0, 4.0];
    let found = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| quantile(&values, share));
    assert_eq!(found, [1.0, 1.5, 2.0, 3.0, 4.0]);
}

#[test]
fn the_bootstrap_interval_is_that_of_theory_and_always_the_same() {
    let mut random = Random::new(5, 0, 0);
    let sample: Vec<f64> = (0..400).map(|_| random.gaussian()).collect();
    let [low, high] = interval95(&sample);
    assert_eq!(interval95(&sample), [low, high]);
    assert!(low < interquartile_mean(&sample) && interquartile_mean(&sample) < high);
    // The variance of the mean of the middle half of a Gaussian sample is 1.19/n (Tukey 1960).
    let theory = 2.0 * 1.96 * (1.19_f64 / 400.0).sqrt();
    assert!(((high - low) / theory - 1.0).abs() < 0.15, "{low} {high}");
    assert_eq!(interval95(&[3.0]), [3.0, 3.0]);
    assert_eq!(interval95(&[2.0; 5]), [2.0, 2.0]);
}

#[test]
fn bounds_on_a_rate_are_those_of_the_beta_distribution() {
    for (count, n) in [(0, 1), (0, 1000), (1, 20), (3, 1000), (40, 100), (99, 100)] {
        let beta = Beta::new(count as f64 + 1.0, (n - count) as f64).unwrap();
        let expected = beta.inverse_cdf(0.95);
        let found = upper95(count, n);
        assert!(
            (found - expected).abs() < 1e-6,
            "{count} of {n}: {found}, {expected}"
        );
    }
    // None in n: 1 − 0.05^(1/n), the "rule of three".
    assert!((upper95(0, 1000) - 0.002_991_2).abs() < 1e-6);
    assert_eq!(upper95(5, 5), 1.0);
    assert_eq!(lower95(0, 5), 0.0);
    assert!((lower95(5, 5) - 0.05_f64.powf(0.2)).abs() < 1e-9);
}

#[test]
fn the_interval_of_a_count_is_that_of_the_gamma_distribution() {
    for count in [0, 1, 2, 7, 19, 300] {
        let quantile =
            |shape: u64, share| Gamma::new(shape as f64, 1.0).unwrap().inverse_cdf(share);
        let [low, high] = poisson::interval95(count);
        let expected = match count {
            0 => 0.0,
            _ => quantile(count, 0.025),
        };
        assert!((low - expected).abs() < 1e-6, "{count}: {low}, {expected}");
        let expected = quantile(count + 1, 0.975);
        assert!(
            (high - expected).abs() < 1e-6,
            "{count}: {high}, {expected}"
        );
    }
}

#[test]
fn rates_are_pooled_over_ticks() {
    // An episode of two ticks that an event ended does not weigh as much as one of 10 000 ticks.
    let rate = Rate::of([(1, 2), (8, 10_000)].into_iter());
    assert_eq!(rate.count, 9);
    assert!((rate.per_1000 - 9000.0 / 10_002.0).abs() < 1e-12);
    let [low, high] = rate.ci95;
    assert!(
        0.0 < low && low < 0.9 && 0.9 < high && high < 3.0,
        "{rate:?}"
    );
    // Nothing that was seen: below 3.69 in all ticks.
    let none = Rate::of([(0, 1000); 5].into_iter());
    assert_eq!((none.per_1000, none.ci95[0]), (0.0, 0.0));
    assert!((none.ci95[1] - 3.688_879 / 5.0).abs() < 1e-5, "{none:?}");
    // Equal episodes have equal ratios, however many.
    let equal = Rate::of([(30, 1000); 8].into_iter());
    assert_eq!(equal.ci95, [30.0, 30.0]);
    assert_eq!(Rate::of(std::iter::empty()).per_1000, 0.0);
}

#[test]
fn the_interval_of_a_rate_holds_the_true_rate_in_95_of_100_samples() {
    // Episodes of two kinds: long ones with two events in 1000 ticks, short ones with twenty.
    let mut random = Random::new(3, 0, 0);
    let mut held = 0;
    for _ in 0..400 {
        let episodes: Vec<(u64, u64)> = (0..60)
            .map(|_| {
                let (ticks, chance) = match random.chance(0.5) {
                    true => (1000, 0.002),
                    false => (100, 0.02),
                };
                let count = (0..ticks).filter(|_| random.chance(chance)).count();
                (count as u64, ticks)
            })
            .collect();
        let [low, high] = Rate::of(episodes.into_iter()).ci95;
        // (0.5 · 2 + 0.5 · 2) / (0.5 · 1000 + 0.5 · 100) events a tick.
        let truth = 1000.0 * 2.0 / 550.0;
        held += u32::from(low < truth && truth < high);
    }
    assert!((368..=392).contains(&held), "{held} of 400");
}

#[test]
fn an_end_that_is_rewarded_is_a_goal_and_is_bounded_below() {
    let episode = |line, last| Episode {
        ticks: 10,
        total: last,
        last,
        lost: false,
        events: Vec::new(),
        end: End::On(line),
        outside: 0,
    };
    let episodes = [episode(0, -5.0), episode(1, 3.0), episode(1, -1.0)];
    let summary = Summary::of(&episodes, 3);
    assert_eq!(summary.ended, [1, 2, 0]);
    assert_eq!(summary.paid, [-5.0, 1.0, 0.0]);
    let bounds = |worths: [Option<f64>; 3]| {
        let lines = worths.map(|worth| EndLine {
            name: "end".to_owned(),
            worth,
        });
        let bounds = Ended::all(&lines, &summary);
        bounds.iter().map(Ended::bound).collect::<Vec<String>>()
    };
    assert_eq!(
        bounds([None; 3]),
        [
            "at most 86.46 % (95 %)",
            "at least 13.54 % (95 %)",
            "at most 63.16 % (95 %)"
        ]
    );
    // What is paid in the same tick makes no goal of an end that costs, and none of a goal that is not.
    let told = bounds([Some(2.0), Some(-5.0), Some(1.0)]);
    let words: Vec<&str> = told.iter().map(|bound| &bound[..8]).collect();
    assert_eq!(words, ["at least", "at most ", "at least"]);
}

#[test]
fn the_reward_says_what_an_end_is_worth() {
    let twice = |n| format!("event dead_{n} = dead_{m} or dead_{m}\n", m = n - 1);
    let nested: String = (1..=60).map(twice).collect();
    let source = "
        world yard {
            tick  = 100 ms
            arena = rect((0 m, 0 m), (9 m, 9 m))
            place dock = disc((8 m, 8 m), 0.5 m)
            robot rover {
                body  = disc(20 cm)
                drive = differential(max_speed = 0.5 m/s, max_turn = 2 rad/s)
            }
        }
        state charge = 100%
        predicate low = charge <= 20%
        event dead = charge <= 0%
        event home = distance(dock) <= 50 cm
        event hall = position.x <= 1 m
        event left = success(leave)
        event dead_0 = dead
        each tick { charge -= 0.1% }
        behavior stay { control { drive(speed = 0 m/s, turn = 0 rad/s) } }
        behavior leave { control { drive(speed = max_speed, turn = 0 rad/s) } succeed when position.y >= 8 m }
        task deliver {
            observe low
            choose  stay, leave
            start { pose = anywhere }
            end on dead
            end on home or hall
            end on home
            end on hall
            end on left
            end on home or dead
            end on charge <= 0%
            end on dead_60
            end after 1 min
            reward {
                on home:           +9
                on dead:           -5
                on success(leave): -1
            }
        }
    ";
    let source = source.replace("each tick", &format!("{nested}each tick"));
    let loaded = load("yard.bt", source.into(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{}", shown(&loaded));
    let program = &loaded.program;
    let task = program.tasks.values().next().unwrap();
    let (home, dead, left) = (Some(9.0), Some(-5.0), Some(-1.0));
    let worths = [dead, home, home, None, left, None, dead, dead];
    assert_eq!(task.worths(program), worths);
}

#[test]
fn a_curve_of_several_seeds_has_a_column_for_each() {
    let point = |mean| Point {
        episodes: 10,
        decisions: 20,
        ticks: 30,
        minterms: 4,
        total: Mean {
            mean,
            ci95: [mean, mean],
        },
        ended: 0,
    };
    let curves = [(1, vec![point(2.0)]), (2, vec![point(2.0)])];
    assert_eq!(
        curve::csv(&curves),
        "episodes,return,return_low,return_high,seed_1,seed_2\n10,2,2,2,2,2\n"
    );
    assert_eq!(
        curve::csv(&curves[..1]),
        "episodes,decisions,ticks,minterms,return,return_low,return_high,ended\n10,20,30,4,2,2,2,0\n"
    );
}
