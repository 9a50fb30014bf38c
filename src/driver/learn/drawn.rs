//! The learning curve as a picture.

use crate::emit::svg::curve::{Point, curve};
use crate::learn::bootstrap::{interquartile_mean, interval95};
use crate::learn::curve;

/// The curve of one seed with the interval over its episodes, or of several with that over the seeds.
pub(super) fn learning_curve(name: &str, curves: &[(u64, Vec<curve::Point>)]) -> String {
    match curves {
        [(seed, points)] => {
            let points: Vec<Point> = points
                .iter()
                .map(|point| Point {
                    ticks: point.ticks,
                    mean: point.total.mean,
                    interval: point.total.ci95,
                    minterms: point.minterms,
                })
                .collect();
            curve(&points, &format!("{name}, seed {seed}"), "95 % interval")
        }
        _ => {
            let count = curves.len();
            let interval = format!("interquartile mean of {count} seeds, 95 % interval");
            curve(&over_seeds(curves), name, &interval)
        }
    }
}

fn over_seeds(curves: &[(u64, Vec<curve::Point>)]) -> Vec<Point> {
    let shortest = curves.iter().map(|(_, points)| points.len()).min();
    (0..shortest.unwrap_or(0))
        .map(|at| {
            let of = || curves.iter().filter_map(|(_, points)| points.get(at));
            let totals: Vec<f64> = of().map(|point| point.total.mean).collect();
            Point {
                ticks: of().map(|point| point.ticks).max().unwrap_or(0),
                mean: interquartile_mean(&totals),
                interval: interval95(&totals),
                minterms: of().map(|point| point.minterms).max().unwrap_or(0),
            }
        })
        .collect()
}
