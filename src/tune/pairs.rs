//! Two numbers at once: what neither of them gains alone.

use super::curve::Curve;
use super::field::{Field, Point};

/// The values of each number of a pair.
const VALUES: usize = 7;
/// The rounds of a pair: the episodes of each point, and how many stay in.
const ROUNDS: [(usize, usize); 3] = [(4, 12), (16, 4), (32, 2)];

/// Searches pairs of numbers as far as the effort goes, those first that alone make the greatest difference. Gives the
/// best points, and how many pairs were searched of how many.
pub(super) fn search(
    field: &mut Field,
    curves: &[Curve],
    until: u64,
) -> (Vec<Point>, (usize, usize)) {
    let mut pairs: Vec<(usize, usize)> = Vec::new();
    for second in 1..curves.len() {
        pairs.extend((0..second).map(|first| (first, second)));
    }
    let reach: Vec<f64> = (0..curves.len()).map(|axis| reach(field, axis)).collect();
    let of = |axis: usize| reach.get(axis).copied().unwrap_or(0.0);
    pairs.sort_by(|a, b| {
        let sum = |pair: &(usize, usize)| of(pair.0) + of(pair.1);
        sum(b).total_cmp(&sum(a)).then(a.cmp(b))
    });
    let mut found = Vec::new();
    let mut searched = 0;
    for &(first, second) in &pairs {
        let Some(points) = pair(field, curves, (first, second), until) else {
            break;
        };
        found.extend(points);
        searched += 1;
    }
    (found, (searched, pairs.len()))
}

/// The greatest difference that a number makes alone.
fn reach(field: &Field, axis: usize) -> f64 {
    let number = field.axes().get(axis).map_or(0, |axis| axis.values.len());
    let points = (0..number).map(|at| field.with(axis, at));
    let gains = points.map(|point| field.gain(&point).mean.abs());
    gains.fold(0.0, f64::max)
}

/// The best points of a pair; nothing if they are not played, for the effort goes no further.
fn pair(
    field: &mut Field,
    curves: &[Curve],
    (first, second): (usize, usize),
    until: u64,
) -> Option<Vec<Point>> {
    let used = field.used();
    let mut points = Vec::new();
    for at in values(field, curves, first) {
        for beside in values(field, curves, second) {
            let mut point = used.clone();
            for (axis, value) in [(first, at), (second, beside)] {
                if let Some(own) = point.get_mut(axis) {
                    *own = value;
                }
            }
            points.push(point);
        }
    }
    let mut played = false;
    for (episodes, stay) in ROUNDS {
        // Neighbours are not played yet: the points of a pair are far from each other.
        if !field.play(&points, episodes, until) {
            break;
        }
        played = true;
        field.rank(&mut points);
        points.truncate(stay);
    }
    played.then_some(points)
}

/// The values of a number that stand for all: some from end to end, and the best ones; not that in use.
fn values(field: &Field, curves: &[Curve], axis: usize) -> Vec<usize> {
    let Some(own) = field.axes().get(axis) else {
        return Vec::new();
    };
    let best = curves.get(axis).map_or(Vec::new(), |curve| curve.best(2));
    let mut chosen: Vec<usize> = best
        .iter()
        .filter_map(|point| point.get(axis).copied())
        .collect();
    let last = own.values.len().saturating_sub(1);
    let spread = VALUES - chosen.len();
    chosen.extend((0..spread).map(|i| (2 * i + 1) * last / (2 * spread)));
    chosen.sort_unstable();
    chosen.dedup();
    chosen.retain(|at| *at != own.used);
    chosen
}
