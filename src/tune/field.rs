//! Points of the grid with the episodes that the tree has played under their values.

use super::Subject;
use super::account::Account;
use super::grid::Axis;
use crate::checkpoint::Part;
use crate::learn::episode::Episode;
use crate::learn::statistics::Mean;
use crate::trial::duel::{CHUNK, Player, ended, gain, happened};
use crate::world::Start;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::ops::Range;

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

/// The episodes of points, as they are kept.
type Played = BTreeMap<Point, Vec<Episode>>;

/// What a field lies in.
pub(super) struct Place<'a> {
    pub(super) subject: &'a Subject<'a>,
    pub(super) axes: &'a [Axis],
    /// The events that must never happen.
    pub(super) never: &'a [usize],
    pub(super) start: Start,
    /// Where the episodes are kept: those of a run before are not played again.
    pub(super) part: &'a Part<'a>,
    pub(super) progress: &'a (dyn Fn(u64) + Sync),
}

/// Points of the grid with their episodes, all on the same seeds.
pub struct Field<'a> {
    /// What all that is played here is paid from.
    pub account: Account,
    place: Place<'a>,
    arms: BTreeMap<Point, Arm>,
    /// What a run before has played.
    known: Played,
}

impl<'a> Field<'a> {
    /// The point in use, with its player and the first episodes that it has played, which are paid.
    pub(super) fn new(
        place: Place<'a>,
        account: Account,
        (player, episodes): (Player, Vec<Episode>),
    ) -> Self {
        let known = place.part.resume().unwrap_or_default();
        let mut field = Self {
            account,
            place,
            arms: BTreeMap::new(),
            known,
        };
        let player = Some(player);
        field.arms.insert(field.used(), Arm { player, episodes });
        field
    }

    /// What is tuned.
    pub(super) fn subject(&self) -> &'a Subject<'a> {
        self.place.subject
    }

    /// The axes of the grid.
    pub fn axes(&self) -> &'a [Axis] {
        self.place.axes
    }

    /// The point of the values in use.
    pub fn used(&self) -> Point {
        self.place.axes.iter().map(|axis| axis.used).collect()
    }

    /// The point in use with another value of one number.
    pub fn with(&self, axis: usize, value: usize) -> Point {
        let mut point = self.used();
        if let Some(own) = point.get_mut(axis) {
            *own = value;
        }
        point
    }

    /// The mean number of ticks of an episode, where it is the greatest.
    pub fn length(&self) -> u64 {
        let arms = self.arms.values().map(|arm| length(&arm.episodes));
        arms.fold(1, u64::max)
    }

    /// The episodes of a point.
    pub fn episodes(&self, point: &[usize]) -> &[Episode] {
        self.arms.get(point).map_or(&[], |arm| &arm.episodes)
    }

    /// Lets each point, and the one in use, play the episodes below `episodes` that it has not played, on all threads. Does
    /// nothing, and says so, if that takes more ticks than there are until `until`.
    #[must_use]
    pub fn play(&mut self, points: &[Point], episodes: usize, until: u64) -> bool {
        let mut points = points.to_vec();
        points.push(self.used());
        points.sort();
        points.dedup();
        let missing = points.iter().map(|point| self.missing(point, episodes));
        let price = missing.sum::<usize>() as u64 * self.length();
        if !self.account.affords(price, until) {
            return false;
        }
        self.enter(&points);
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
            .map(|(point, from, to)| self.played(point, *from..*to))
            .collect();
        for ((point, ..), played) in due.into_iter().zip(played) {
            let ticks = played.iter().map(|episode| episode.ticks);
            self.account.spend(ticks.sum());
            if let Some(arm) = self.arms.get_mut(point) {
                arm.episodes.extend(played);
            }
        }
        self.place.part.keep(|| self.all());
        (self.place.progress)(self.account.ticks);
        true
    }

    /// How many episodes below `episodes` a point has not played; none where it cannot be played.
    fn missing(&self, point: &[usize], episodes: usize) -> usize {
        let without = self.arms.get(point).is_some_and(|arm| arm.player.is_none());
        match without {
            true => 0,
            false => episodes.saturating_sub(self.episodes(point).len()),
        }
    }

    /// Makes a player for each of the points that has none.
    fn enter(&mut self, points: &[Point]) {
        let new: Vec<&Point> = points
            .iter()
            .filter(|point| !self.arms.contains_key(*point))
            .collect();
        let made: Vec<(Point, Arm)> = new
            .into_par_iter()
            .map(|point| {
                let Subject { task, root, .. } = *self.place.subject;
                let program = (self.place.subject.revalued)(&self.values(point));
                let player = program.and_then(|program| Player::new(&program, task, root).ok());
                let arm = Arm {
                    player,
                    episodes: Vec::new(),
                };
                (point.clone(), arm)
            })
            .collect();
        self.arms.extend(made);
    }

    /// These episodes of a point, as a run before has played them or as they are played now.
    fn played(&self, point: &Point, range: Range<usize>) -> Vec<Episode> {
        let known = self.known.get(point);
        if let Some(known) = known.and_then(|known| known.get(range.clone())) {
            return known.to_vec();
        }
        let player = self.arms.get(point).and_then(|arm| arm.player.as_ref());
        player.map_or(Vec::new(), |player| {
            player.play(self.place.start, range.start, range.end)
        })
    }

    /// All episodes so far, with those of a run before that have not been asked for yet.
    fn all(&self) -> Played {
        let mut all = self.known.clone();
        for (point, arm) in &self.arms {
            let longer = all
                .get(point)
                .is_none_or(|known| known.len() < arm.episodes.len());
            if longer {
                all.insert(point.clone(), arm.episodes.clone());
            }
        }
        all
    }

    /// The values of a point, in the units of the numbers.
    pub fn values(&self, point: &[usize]) -> Vec<f64> {
        values(self.place.axes, point)
    }

    /// The points one step beside a point, in each number in which it is not the one in use.
    fn neighbours(&self, point: &[usize]) -> Vec<Point> {
        let mut found = Vec::new();
        for (i, (at, axis)) in point.iter().zip(self.place.axes).enumerate() {
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
    #[must_use]
    pub fn play_with_neighbours(&mut self, points: &[Point], episodes: usize, until: u64) -> bool {
        let beside = points.iter().flat_map(|point| self.neighbours(point));
        let all: Vec<Point> = points.iter().cloned().chain(beside).collect();
        self.play(&all, episodes, until)
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
            || happened(episodes, self.place.never) > happened(same, self.place.never)
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
        let own = point.iter().zip(self.place.axes);
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

/// The mean number of ticks of some episodes, rounded up.
pub(super) fn length(episodes: &[Episode]) -> u64 {
    let ticks: u64 = episodes.iter().map(|episode| episode.ticks).sum();
    ticks.div_ceil(episodes.len().max(1) as u64)
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
