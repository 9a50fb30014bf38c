//! The search for better values of the numbers of a program that may be tuned, judged by episodes of a tree.
//!
//! The return of a tree is a jagged function of a threshold, so nothing climbs it: every value of a [`grid`] of round
//! numbers plays the same seeds, and the worse half of them is dropped after each doubling of the episodes (successive
//! halving: Karnin, Koren and Somekh 2013). A value counts for as much as the worst of itself and its two neighbours on
//! the grid. [`curve`] searches one number at a time, [`pairs`] two at once; what comes out of both is held against the
//! values in use on fresh seeds by [`confirm`].

pub mod confirm;
pub mod curve;
pub mod field;
pub mod grid;
pub mod pairs;

use crate::ir::task::{ClaimKind, Task, TreeRef};
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::simulated::Purpose;
use crate::trial::Unplayable;
use confirm::Confirmed;
use curve::Curve;
use field::{Field, Point};
use grid::Axis;

/// Episodes of the last round of the search.
const EPISODES: usize = 128;
/// The most points that go into the last round.
const FINALISTS: usize = 8;
/// The most points that are held against the values in use on fresh seeds.
const OPINIONS: usize = 3;

/// A tree whose numbers are tuned.
#[derive(Clone, Copy)]
pub struct Subject<'a> {
    /// The program under the values in use.
    pub program: &'a Program,
    /// The task that it is judged by.
    pub task: Id<Task>,
    /// The tree.
    pub root: &'a Node,
    /// What the claims on it call it.
    pub claimed: TreeRef,
    /// The program under other values, in the order of its tunables and in their units; all ids stay.
    pub revalued: &'a (dyn Fn(&[f64]) -> Option<Program> + Sync),
}

/// How much to search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// About how many ticks the search may take.
    pub effort: u64,
    /// The number of fresh episodes on which the values that were found are held against those in use.
    pub episodes: u64,
    /// The seed of all episodes.
    pub seed: u64,
}

/// How far the search has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// Ticks simulated so far.
    pub ticks: u64,
    /// About how many there will be.
    pub of: u64,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Tuned {
    /// The curve of each number.
    pub curves: Vec<Curve>,
    /// The pairs of numbers that were searched, and those that there are.
    pub pairs: (usize, usize),
    /// What became of the best points on fresh seeds, in the order in which they were tried.
    pub opinions: Vec<Confirmed>,
    /// Ticks simulated.
    pub ticks: u64,
}

impl Tuned {
    /// The values that do better than those in use.
    pub fn better(&self) -> Option<&Confirmed> {
        self.opinions.iter().find(|opinion| opinion.holds())
    }
}

/// Searches for better values.
///
/// # Errors
/// The tree cannot be played under the values in use.
pub fn tune(
    subject: &Subject,
    options: &Options,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Tuned, Unplayable> {
    let tunables = subject.program.tunables.values();
    let number = subject.program.tunables.len();
    let most = grid::most(number);
    let axes: Vec<Axis> = tunables.map(|tunable| Axis::new(tunable, most)).collect();
    let never = never(subject);
    let heard = |ticks| {
        progress(Progress {
            ticks,
            of: options.effort,
        });
    };
    let start = Purpose::Tune.start(options.seed, subject.program.tasks[subject.task].end_after);
    let mut field = Field::new(subject, &axes, &never, start, &heard)?;
    let share = |part: u64| options.effort / 100 * part;
    let mut curves = Vec::new();
    for axis in 0..axes.len() {
        let until = field.ticks + share(50) / number.max(1) as u64;
        curves.push(curve::search(&mut field, axis, until));
    }
    let (mut points, pairs) = pairs::search(&mut field, &curves, share(85));
    points.extend(curves.iter().flat_map(|curve| curve.best(FINALISTS / 2)));
    points.extend(together(&field, &curves));
    let ranked = last_round(&mut field, points, options.effort);
    let mut ticks = field.ticks;
    let mut opinions: Vec<Confirmed> = Vec::new();
    for point in ranked.into_iter().take(OPINIONS) {
        let Some(opinion) = confirm::confirm(subject, &axes, &point, options)? else {
            continue;
        };
        ticks += opinion.duel.ticks;
        let holds = opinion.holds();
        opinions.push(opinion);
        if holds {
            break;
        }
    }
    for (axis, curve) in curves.iter_mut().enumerate() {
        curve.finish(&field, axis);
    }
    Ok(Tuned {
        curves,
        pairs,
        opinions,
        ticks,
    })
}

/// The best value of each number, all at once.
fn together(field: &Field, curves: &[Curve]) -> Option<Point> {
    let mut point = field.used();
    let mut changed = 0;
    for (axis, curve) in curves.iter().enumerate() {
        if let Some(best) = curve.best(1).first()
            && let (Some(own), Some(best)) = (point.get_mut(axis), best.get(axis))
        {
            *own = *best;
            changed += 1;
        }
    }
    (changed > 1).then_some(point)
}

/// The best points, the most robust first; those that do no better than the values in use are left out.
fn last_round(field: &mut Field, mut points: Vec<Point>, effort: u64) -> Vec<Point> {
    points.sort();
    points.dedup();
    let mut episodes = 16;
    while episodes <= EPISODES {
        field.play_with_neighbours(&points, episodes);
        field.rank(&mut points);
        points.truncate(match episodes {
            16 => 2 * FINALISTS,
            32 => FINALISTS,
            _ => FINALISTS / 2,
        });
        if field.ticks > effort {
            break;
        }
        episodes *= 2;
    }
    points.retain(|point| field.robust(point) > 0.0);
    field.round(&mut points);
    points
}

/// An event that the program claims never to happen under the tree, in any episode and at any time.
fn never(subject: &Subject) -> Vec<usize> {
    let claims = subject.program.claims.iter();
    let events = claims.filter_map(|claim| match &claim.kind {
        ClaimKind::Never(never)
            if claim.tree == subject.claimed
                && never.within.is_none()
                && never.probability >= 1.0 =>
        {
            Some(never.event.index())
        }
        _ => None,
    });
    events.collect()
}
