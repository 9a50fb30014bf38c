//! One number at a time: the gain at every value of its grid.

use super::field::{Field, Point};
use crate::learn::statistics::Mean;
use serde::{Deserialize, Serialize};

/// The fewest and the most episodes of every value.
pub(super) const FIRST: [usize; 2] = [4, 32];
/// The most episodes of those that are left.
const LAST: usize = 128;
/// The values that are left in the end.
const LEFT: usize = 6;
/// The part of the return that is no difference.
const TOLERANCE: f64 = 0.01;

/// The curve of a number.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Curve {
    /// The values, ascending.
    pub dots: Vec<Dot>,
    /// Whether they were played at all: the effort may not go so far.
    pub searched: bool,
    /// Which of them is in use.
    pub used: usize,
    /// Which of them is the best by the worst of itself and its neighbours; that in use if none gains
    /// anything with 95 % confidence.
    pub best: usize,
    /// The points of the best values, the best first.
    ranked: Vec<Point>,
}

/// A value of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Dot {
    /// The value in the unit of the number.
    pub value: f64,
    /// What it gains over the value in use.
    pub gain: Mean,
    /// The episodes that say so.
    pub episodes: usize,
    /// Whether it is out of the question, whatever it gains.
    pub out: bool,
    /// Whether it belongs to the flat part around the best value.
    pub flat: bool,
}

impl Curve {
    /// The points of the best values.
    pub fn best(&self, most: usize) -> Vec<Point> {
        self.ranked.iter().take(most).cloned().collect()
    }

    /// The values from one end of the flat part to the other.
    pub fn flat(&self) -> Option<(f64, f64)> {
        let mut flat = self.dots.iter().filter(|dot| dot.flat);
        let first = flat.next()?;
        Some((first.value, flat.next_back().unwrap_or(first).value))
    }

    /// Takes the figures over from the field when all has been played.
    pub(super) fn finish(&mut self, field: &Field, axis: usize) {
        let Some(own) = field.axes().get(axis) else {
            return;
        };
        let dot = |(point, &value): (&Point, &f64)| Dot {
            value,
            gain: field.gain(point),
            episodes: field.episodes(point).len(),
            out: field.is_out(point),
            flat: false,
        };
        if !self.searched {
            let used = own.values.get(own.used);
            self.dots = used
                .map(|used| dot((&field.used(), used)))
                .into_iter()
                .collect();
            (self.used, self.best) = (0, 0);
            return;
        }
        let all: Vec<Point> = (0..own.values.len())
            .map(|at| field.with(axis, at))
            .collect();
        let mut ranked: Vec<Point> = self.ranked.clone();
        field.rank(&mut ranked);
        field.round(&mut ranked);
        let gains = |best: &&Point| field.robust(best) > 0.0 && field.gain(best).ci95[0] > 0.0;
        let best = ranked.first().filter(gains);
        let best = best.cloned().unwrap_or_else(|| field.used());
        self.best = best.get(axis).copied().unwrap_or(own.used);
        self.dots = all.iter().zip(&own.values).map(dot).collect();
        let tolerance = TOLERANCE * field.scale();
        let alike = |at: usize| {
            all.get(at).is_some_and(|point| {
                !field.is_out(point) && field.difference(&best, point).ci95[0] <= tolerance
            })
        };
        let up = (self.best..all.len()).take_while(|at| alike(*at));
        let down = (0..self.best).rev().take_while(|at| alike(*at));
        for at in up.chain(down) {
            if let Some(dot) = self.dots.get_mut(at) {
                dot.flat = true;
            }
        }
    }
}

/// Plays every value of a number with the others as they are in use, and the better half of them on and on.
pub(super) fn search(field: &mut Field, axis: usize, until: u64) -> Curve {
    let used = field.axes().get(axis).map_or(0, |axis| axis.used);
    let number = field.axes().get(axis).map_or(0, |axis| axis.values.len());
    let all: Vec<Point> = (0..number).map(|at| field.with(axis, at)).collect();
    // Half of the effort goes into the first round.
    let left = until.saturating_sub(field.account.ticks) / 2;
    let affordable = left / (field.length() * number.max(1) as u64).max(1);
    let [least, most] = FIRST;
    let mut episodes = usize::try_from(affordable).map_or(most, |n| n.clamp(least, most));
    let searched = field.play(&all, episodes, until);
    let mut points: Vec<Point> = all
        .into_iter()
        .filter(|point| searched && *point != field.used())
        .collect();
    field.rank(&mut points);
    while searched && episodes < LAST {
        let mut better = points.clone();
        better.truncate((points.len() / 2).max(LEFT));
        if !field.play_with_neighbours(&better, 2 * episodes, until) {
            break;
        }
        episodes *= 2;
        points = better;
        field.rank(&mut points);
    }
    points.truncate(LEFT);
    Curve {
        dots: Vec::new(),
        searched,
        used,
        best: used,
        ranked: points,
    }
}
