//! Episodes that return far less than nearly all others: a tree may be stuck in them.

use super::bootstrap::quantile;

/// The fewest returns that say which of them stand apart.
const FEWEST: usize = 40;
/// How far below the lower quartile that is, in widths of the middle half. Tukey (1977) calls far out what is three away; by ten, no
/// chance of a world explains it.
const FAR: f64 = 10.0;
/// The least width of the middle half, as a part of the median.
const WIDTH: f64 = 0.2;
/// Where more than one in so many is that low, they are a part of how the tree does, and no exception.
const RARE: usize = 50;

/// The lowest return of a sample, and what stands apart from it.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize, serde::Deserialize)]
pub struct Worst {
    /// The lowest return.
    pub total: f64,
    /// The number of its episode.
    pub episode: u64,
    /// The episodes that return far less than the others.
    pub apart: u64,
}

impl Worst {
    /// That of returns in the order of their episodes; `None` if there are none.
    pub fn of(totals: &[f64]) -> Option<Self> {
        let numbered = totals.iter().enumerate();
        let (episode, total) = numbered.min_by(|a, b| a.1.total_cmp(b.1))?;
        Some(Self {
            total: *total,
            episode: episode as u64,
            apart: apart(totals),
        })
    }
}

/// How many returns are far below the others.
pub fn apart(totals: &[f64]) -> u64 {
    if totals.len() < FEWEST {
        return 0;
    }
    let mut sorted = totals.to_vec();
    sorted.sort_by(f64::total_cmp);
    let [low, median, high] = [0.25, 0.5, 0.75].map(|share| quantile(&sorted, share));
    let width = (high - low).max(WIDTH * median.abs());
    if width <= 0.0 {
        return 0;
    }
    let below = sorted.partition_point(|total| *total < low - FAR * width);
    if below * RARE > totals.len() {
        return 0;
    }
    below as u64
}

#[cfg(test)]
mod tests {
    use super::{Worst, apart};

    fn returns(low: &[f64]) -> Vec<f64> {
        let spread = (0..200).map(|at| 10.0 + f64::from(at % 20) / 10.0);
        spread.chain(low.iter().copied()).collect()
    }

    #[test]
    fn a_return_far_below_all_others_stands_apart() {
        let totals = returns(&[-400.0, 9.0, -390.0]);
        let worst = Worst::of(&totals).unwrap();
        assert_eq!((worst.total, worst.episode, worst.apart), (-400.0, 200, 2));
    }

    #[test]
    fn a_low_one_does_not_and_no_more_do_low_ones_that_are_common() {
        assert_eq!(apart(&returns(&[5.0, 4.0])), 0);
        assert_eq!(apart(&returns(&[-400.0; 5])), 0);
    }

    #[test]
    fn few_returns_say_nothing_and_nor_does_a_failure_beside_equal_ones() {
        assert_eq!(apart(&[1.0, 2.0, 3.0, -900.0]), 0);
        let mut equal = vec![500.0; 300];
        equal.push(0.0);
        assert_eq!(apart(&equal), 0);
        equal.push(-600.0);
        assert_eq!(apart(&equal), 1);
        assert_eq!(Worst::of(&[]), None);
    }
}
