//! The learning curve as a table and as a picture.

use crate::emit::svg;
use crate::learn::curve::{Point, pooled};

/// The curves of several seeds as CSV: all figures of a single one, else the interquartile mean over the seeds with its
/// bootstrap interval, and the return of each.
pub fn csv(curves: &[(u64, Vec<Point>)]) -> String {
    match curves {
        [(_, points)] => single(points),
        _ => several(curves),
    }
}

fn single(points: &[Point]) -> String {
    let mut text =
        String::from("episodes,decisions,ticks,minterms,return,return_low,return_high,ended\n");
    for point in points {
        let [low, high] = point.total.ci95;
        text.push_str(&format!(
            "{},{},{},{},{},{low},{high},{}\n",
            point.episodes,
            point.decisions,
            point.ticks,
            point.minterms,
            point.total.mean,
            point.ended,
        ));
    }
    text
}

fn several(curves: &[(u64, Vec<Point>)]) -> String {
    let mut text = String::from("episodes,return,return_low,return_high");
    for (seed, _) in curves {
        text.push_str(&format!(",seed_{seed}"));
    }
    text.push('\n');
    for point in pooled(curves) {
        let [low, high] = point.total.ci95;
        text.push_str(&format!(
            "{},{},{low},{high}",
            point.episodes, point.total.mean
        ));
        for total in point.totals {
            text.push_str(&format!(",{total}"));
        }
        text.push('\n');
    }
    text
}

/// The curve of one seed with the interval over its episodes, or of several with that over the seeds, as SVG.
pub fn picture(name: &str, curves: &[(u64, Vec<Point>)]) -> String {
    match curves {
        [(seed, points)] => {
            let points: Vec<svg::curve::Point> = points
                .iter()
                .map(|point| svg::curve::Point {
                    ticks: point.ticks,
                    mean: point.total.mean,
                    interval: point.total.ci95,
                    minterms: point.minterms,
                })
                .collect();
            svg::curve::curve(&points, &format!("{name}, seed {seed}"), "95 % interval")
        }
        _ => {
            let count = curves.len();
            let points: Vec<svg::curve::Point> = pooled(curves)
                .iter()
                .map(|point| svg::curve::Point {
                    ticks: point.ticks,
                    mean: point.total.mean,
                    interval: point.total.ci95,
                    minterms: point.minterms,
                })
                .collect();
            let interval = format!("interquartile mean of {count} seeds, 95 % interval");
            svg::curve::curve(&points, name, &interval)
        }
    }
}
