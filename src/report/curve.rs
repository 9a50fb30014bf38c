//! The learning curve as a table and as a picture.

use crate::emit::svg;
use crate::learn::curve::{Point, pooled};
use crate::learn::statistics::Mean;

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
    let drawn = |ticks, total: &Mean, minterms| svg::curve::Point {
        ticks,
        mean: total.mean,
        interval: total.ci95,
        minterms,
    };
    match curves {
        [(seed, points)] => {
            let points = points.iter();
            let points: Vec<_> = points
                .map(|p| drawn(p.ticks, &p.total, p.minterms))
                .collect();
            svg::curve::curve(&points, &format!("{name}, seed {seed}"), "95 % interval")
        }
        _ => {
            let points = pooled(curves);
            let points = points.iter();
            let points: Vec<_> = points
                .map(|p| drawn(p.ticks, &p.total, p.minterms))
                .collect();
            let interval = format!(
                "interquartile mean of {} seeds, 95 % interval",
                curves.len()
            );
            svg::curve::curve(&points, name, &interval)
        }
    }
}
