//! Points of the grid with the episodes that the tree has played under their values.

use super::Subject;
use super::grid::Axis;
use crate::learn::episode::Episode;
use crate::learn::statistics::Mean;
use crate::trial::Unplayable;
use crate::trial::duel::{CHUNK, Player, ended, gain, happened};
use crate::world::Start;
use rayon::prelude::*;
use std::collections::BTreeMap;

/// A value of each number, by its place on the axis.
pub type Point = Vec<usize>;

/// A point without value: the tree cannot be played there, or what must never happen has happened.
const WORTHLESS: f64 = f64::NEG_INFINITY;

/// A point that has played.
#[derive(Debug)]
struct Arm {
    /// `None` where the program has mistakes under the values, or its world cannot be built.
    player: Option<Player>,
    episodes: Vec<Episode>,
}

/// Points of the grid with their episodes, all on the same seeds.
pub struct Field<'a> {
    /// Ticks simulated so far.
    pub ticks: u64,
    subject: &'a Subject<'a>,
    axes: &'a [Axis],
    never: &'a [usize],
    start: Start,
    arms: BTreeMap<Point, Arm>,
    progress: &'a (dyn Fn(u64) + Sync),
}

impl<'a> Field<'a> {
    /// The point in use, with its first episodes.
    pub(super) fn new(
        subject: &'a Subject,
        axes: &'a [Axis],
        never: &'a [usize],
        start: Start,
        progress: &'a (dyn Fn(u64) + Sync),
    ) -> Result<Self, Unplayable> {
        let player = Player::new(subject.program, subject.task, subject.root)?;
        let mut field = Self {
            ticks: 0,
            subject,
            axes,
            never,
            start,
            arms: BTreeMap::new(),
            progress,
        };
        let used = field.used();
        field.arms.insert(
            used.clone(),
            Arm {
                player: Some(player),
                episodes: Vec::new(),
            },
        );
        field.play(&[used], CHUNK);
        Ok(field)
    }

    /// The axes of the grid.
    pub fn axes(&self) -> &'a [Axis] {
        self.axes
    }

    /// The point of the values in use.
    pub fn used(&self) -> Point {
        self.axes.iter().map(|axis| axis.used).collect()
    }

    /// The point in use with another value of one number.
    pub fn with(&self, axis: usize, value: usize) -> Point {
        let mut point = self.used();
        if let Some(own) = point.get_mut(axis) {
            *own = value;
        }
        point
    }

    /// The mean number of ticks of an episode under the values in use.
    pub fn length(&self) -> u64 {
        let episodes = self.episodes(&self.used());
        let ticks: u64 = episodes.iter().map(|episode| episode.ticks).sum();
        (ticks / episodes.len().max(1) as u64).max(1)
    }

    /// The episodes of a point.
    pub fn episodes(&self, point: &[usize]) -> &[Episode] {
        self.arms.get(point).map_or(&[], |arm| &arm.episodes)
    }

    /// Lets each point, and the one in use, play the episodes below `episodes` that it has not played, on all threads.
    pub fn play(&mut self, points: &[Point], episodes: usize) {
        let mut points = points.to_vec();
        points.push(self.used());
        points.sort();
        points.dedup();
        let new: Vec<&Point> = points
            .iter()
            .filter(|point| !self.arms.contains_key(*point))
            .collect();
        let made: Vec<(Point, Arm)> = new
            .into_par_iter()
            .map(|point| {
                let Subject { task, root, .. } = *self.subject;
                let program = (self.subject.revalued)(&self.values(point));
                let player = program.and_then(|program| Player::new(&program, task, root).ok());
                let arm = Arm {
                    player,
                    episodes: Vec::new(),
                };
                (point.clone(), arm)
            })
            .collect();
        self.arms.extend(made);
        let mut due: Vec<(&Point, usize, usize)> = Vec::new();
        for point in &points {
            let mut from = self.episodes(point).len();
            while from < episodes {
                let to = episodes.min(from + CHUNK);
                due.push((point, from, to));
                from = to;
            }
        }
        let played: Vec<Vec<Episode>> = due
            .par_iter()
            .map(|(point, from, to)| {
                let player = self.arms.get(*point).and_then(|arm| arm.player.as_ref());
                player.map_or(Vec::new(), |player| player.play(self.start, *from, *to))
            })
            .collect();
        for ((point, ..), played) in due.into_iter().zip(played) {
            self.ticks += played.iter().map(|episode| episode.ticks).sum::<u64>();
            if let Some(arm) = self.arms.get_mut(point) {
                arm.episodes.extend(played);
            }
        }
        (self.progress)(self.ticks);
    }

    /// The values of a point, in the units of the numbers.
    pub fn values(&self, point: &[usize]) -> Vec<f64> {
        values(self.axes, point)
    }

    /// The points one step beside a point, in each number in which it is not the one in use.
    fn neighbours(&self, point: &[usize]) -> Vec<Point> {
        let mut found = Vec::new();
        for (i, (at, axis)) in point.iter().zip(self.axes).enumerate() {
            if *at == axis.used {
                continue;
            }
            let below = at.checked_sub(1);
            let above = Some(at + 1).filter(|above| *above < axis.values.len());
            for beside in [below, above].into_iter().flatten() {
                let mut next = point.to_vec();
                if let Some(own) = next.get_mut(i) {
                    *own = beside;
                }
                found.push(next);
            }
        }
        found
    }

    /// As [`Field::play`], for the points and their neighbours.
    pub fn play_with_neighbours(&mut self, points: &[Point], episodes: usize) {
        let beside = points.iter().flat_map(|point| self.neighbours(point));
        let all: Vec<Point> = points.iter().cloned().chain(beside).collect();
        self.play(&all, episodes);
    }

    /// What a point gains over the one in use, episode by episode.
    pub fn gain(&self, point: &[usize]) -> Mean {
        self.difference(point, &self.used())
    }

    /// What a point gains over another, over the episodes that both have played.
    pub fn difference(&self, point: &[usize], other: &[usize]) -> Mean {
        gain(self.episodes(point), self.episodes(other))
    }

    /// Whether a point is out of the question: what must never happen has happened in more episodes than under the values in
    /// use, or lines of `end on` have ended clearly more of its episodes to its loss.
    pub fn is_out(&self, point: &[usize]) -> bool {
        let episodes = self.episodes(point);
        let used = self.used();
        let used = self.episodes(&used);
        let same = used.get(..episodes.len()).unwrap_or(used);
        let (worse, better) = ended(episodes, used);
        let (worse, better) = (worse as f64, better as f64);
        episodes.is_empty()
            || happened(episodes, self.never) > happened(same, self.never)
            // A sign test at 95 %.
            || worse - better > 1.645 * (worse + better).sqrt() && worse > better + 1.0
    }

    /// The gain of a point, without value if it is out of the question.
    pub fn worth(&self, point: &[usize]) -> f64 {
        if self.is_out(point) {
            return WORTHLESS;
        }
        self.gain(point).mean
    }

    /// The least worth of a point and of those neighbours that have played.
    pub fn robust(&self, point: &[usize]) -> f64 {
        let beside = self.neighbours(point);
        let beside = beside
            .iter()
            .filter(|beside| self.arms.contains_key(beside.as_slice()))
            .map(|beside| self.worth(beside));
        beside.fold(self.worth(point), f64::min)
    }

    /// The most robust points first; of equal ones, the one that gains more.
    pub fn rank(&self, points: &mut [Point]) {
        let key = |point: &Point| (self.robust(point), self.worth(point));
        points.sort_by_cached_key(|point| {
            let (robust, worth) = key(point);
            std::cmp::Reverse((Ordered(robust), Ordered(worth)))
        });
    }

    /// Puts those that change fewest values first, and then the roundest, among those that are about as robust as the best.
    pub fn round(&self, points: &mut [Point]) {
        let Some(best) = points.first() else {
            return;
        };
        let gain = self.gain(best);
        let doubt = (gain.ci95[1] - gain.mean).max(0.002 * self.scale());
        let enough = self.robust(best) - doubt;
        points.sort_by_cached_key(|point| {
            let robust = self.robust(point);
            match robust >= enough {
                true => (0, self.digits(point), std::cmp::Reverse(Ordered(robust))),
                false => (1, (0, 0), std::cmp::Reverse(Ordered(robust))),
            }
        });
    }

    /// How many values of a point are not in use, and how round these are.
    fn digits(&self, point: &[usize]) -> (usize, usize) {
        let own = point.iter().zip(self.axes);
        let changed = own.filter(|(at, axis)| **at != axis.used);
        changed.fold((0, 0), |(number, digits), (at, axis)| {
            (number + 1, digits + axis.digits(*at))
        })
    }

    /// What gains are compared with: the return under the values in use, or its standard deviation if that is more.
    pub fn scale(&self) -> f64 {
        let totals = self.episodes(&self.used()).iter();
        let totals: Vec<f64> = totals.map(|episode| episode.total).collect();
        let mean = Mean::of(&totals);
        let error = (mean.ci95[1] - mean.mean) / 1.96;
        let deviation = error * (totals.len() as f64).sqrt();
        mean.mean.abs().max(deviation)
    }
}

/// The values of a point on some axes.
pub(super) fn values(axes: &[Axis], point: &[usize]) -> Vec<f64> {
    let own = axes.iter().zip(point);
    own.map(|(axis, at)| axis.values.get(*at).copied().unwrap_or(0.0))
        .collect()
}

/// A number in the order of [`f64::total_cmp`].
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ordered(f64);

impl Eq for Ordered {}

impl Ord for Ordered {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.total_cmp(&other.0)
    }
}

impl PartialOrd for Ordered {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
