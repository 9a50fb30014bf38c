//! The search for better values of the numbers of a program that may be tuned, judged by episodes of a tree.
//!
//! The return of a tree is a jagged function of a threshold, so nothing climbs it: every value of a [`grid`] of round
//! numbers plays the same seeds, and the worse half of them is dropped after each doubling of the episodes (successive
//! halving: Karnin, Koren and Somekh 2013). A value counts for as much as the worst of itself and its two neighbours on
//! the grid. [`curve`] searches one number at a time, [`pairs`] two at once; what comes out of both is held against the
//! values in use on fresh seeds by [`confirm`]. All of them draw on one [`account`] of ticks: what is not affordable is left out.

pub mod account;
pub mod confirm;
pub mod curve;
pub mod field;
pub mod grid;
pub mod pairs;

use crate::checkpoint::{Keeper, Part};
use crate::ir::task::{Claim, ClaimKind, Occurrence, Task, TreeRef};
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::simulated::Purpose;
use crate::trial::Unplayable;
use crate::trial::duel::{CHUNK, Player};
use account::Account;
use confirm::{Confirmed, Opinions};
use curve::Curve;
use field::{Field, Place, Point};
use grid::Axis;
use serde::{Deserialize, Serialize};

/// Episodes of the last round of the search.
const EPISODES: usize = 128;
/// The most points that go into the last round.
const FINALISTS: usize = 8;
/// The most points that are held against the values in use on fresh seeds.
const OPINIONS: usize = 3;

/// The most of the effort, in hundredths, that is put by for what was found.
const RESERVE: u64 = 40;
/// The part of the search, in hundredths, after which each number alone and then pairs of them have been searched.
const ALONE: u64 = 50;
const TOGETHER: u64 = 85;

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
    /// About how many ticks the search may take, with the episodes that hold what was found against the values in use.
    pub effort: u64,
    /// The most fresh episodes on which the values that were found are held against those in use.
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
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Tuned {
    /// The curve of each number.
    pub curves: Vec<Curve>,
    /// The pairs of numbers that were searched, and those that there are.
    pub pairs: (usize, usize),
    /// What became of the best points on fresh seeds, in the order in which they were tried.
    pub opinions: Vec<Confirmed>,
    /// The number of fresh episodes.
    pub fresh: u64,
    /// Whether points were found and the effort did not go as far as fresh episodes.
    pub untried: bool,
    /// Ticks simulated.
    pub ticks: u64,
}

impl Tuned {
    /// The values that do better than those in use.
    pub fn better(&self) -> Option<&Confirmed> {
        self.opinions.iter().find(|opinion| opinion.holds())
    }
}

/// Searches for better values. What was played is kept: a search that goes on plays it no second time.
///
/// # Errors
/// The tree cannot be played under the values in use.
pub fn tune(
    subject: &Subject,
    options: &Options,
    keeper: &dyn Keeper,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Tuned, Unplayable> {
    let whole = Part::new(keeper, "tuned");
    if let Some(tuned) = whole.resume() {
        return Ok(tuned);
    }
    let tuned = search(subject, options, &Part::new(keeper, "played"), progress)?;
    whole.save(|| &tuned);
    Ok(tuned)
}

fn search(
    subject: &Subject,
    options: &Options,
    part: &Part,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Tuned, Unplayable> {
    let of = options.effort;
    let heard = |ticks| progress(Progress { ticks, of });
    let start = Purpose::Tune.start(options.seed, subject.program.tasks[subject.task].end_after);
    let player = Player::new(subject.program, subject.task, subject.root)?;
    // Of few ticks, most are to be left for other values.
    let mut first = player.play(start, 0, 1);
    let affordable = options.effort / 4 / field::length(&first).max(1);
    let more = usize::try_from(affordable).map_or(CHUNK, |n| n.clamp(1, CHUNK));
    first.extend(player.play(start, 1, more));
    let length = field::length(&first).max(1);
    let mut account = Account::new(options.effort);
    account.spend(first.iter().map(|episode| episode.ticks).sum());
    let whole = options.effort - reserve(subject, options, length);
    let share = |hundredths: u64| whole / 100 * hundredths;

    let number = subject.program.tunables.len();
    let alone = share(ALONE).saturating_sub(account.ticks) / number.max(1) as u64;
    let axes = axes(
        subject.program,
        alone / 2 / (curve::FIRST[0] as u64 * length),
    );
    let place = Place {
        subject,
        axes: &axes,
        never: &never(subject),
        start,
        part,
        progress: &heard,
    };
    let mut field = Field::new(place, account, (player, first));
    let mut curves = Vec::new();
    for axis in 0..axes.len() {
        let until = field.account.ticks.saturating_add(alone);
        curves.push(curve::search(&mut field, axis, until));
    }
    let (mut points, pairs) = pairs::search(&mut field, &curves, share(TOGETHER));
    points.extend(curves.iter().flat_map(|curve| curve.best(FINALISTS / 2)));
    points.extend(together(&field, &curves));
    let mut ranked = last_round(&mut field, points, whole);
    ranked.truncate(OPINIONS);
    let Opinions {
        opinions,
        fresh,
        ticks,
    } = confirm::confirm(&field, &ranked, options)?;
    heard(ticks);
    for (axis, curve) in curves.iter_mut().enumerate() {
        curve.finish(&field, axis);
    }
    Ok(Tuned {
        curves,
        pairs,
        opinions,
        fresh,
        untried: fresh == 0 && !ranked.is_empty(),
        ticks,
    })
}

/// The values of each number that are tried: no more than can be played.
fn axes(program: &Program, affordable: u64) -> Vec<Axis> {
    let affordable = usize::try_from(affordable).unwrap_or(usize::MAX);
    let most = grid::most(program.tunables.len()).min(affordable);
    let tunables = program.tunables.values();
    tunables.map(|tunable| Axis::new(tunable, most)).collect()
}

/// The ticks that are put by to hold what will be found against the values in use.
fn reserve(subject: &Subject, options: &Options, length: u64) -> u64 {
    let episodes = options
        .episodes
        .saturating_mul(confirm::plays(subject, OPINIONS));
    let claims = confirm::MOST * confirm::tests(subject, OPINIONS);
    let wanted = episodes.saturating_add(claims).saturating_mul(length);
    wanted.min(Account::new(options.effort).at(RESERVE))
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
fn last_round(field: &mut Field, mut points: Vec<Point>, until: u64) -> Vec<Point> {
    points.sort();
    points.dedup();
    field.rank(&mut points);
    let mut episodes = 16;
    while episodes <= EPISODES {
        let mut played = field.play_with_neighbours(&points, episodes, until);
        while !played && points.len() > OPINIONS {
            points.truncate(points.len() / 2);
            played = field.play_with_neighbours(&points, episodes, until);
        }
        if !played {
            break;
        }
        field.rank(&mut points);
        points.truncate(match episodes {
            16 => 2 * FINALISTS,
            32 => FINALISTS,
            _ => FINALISTS / 2,
        });
        episodes *= 2;
    }
    points.retain(|point| field.robust(point) > 0.0);
    field.round(&mut points);
    points
}

/// The claims on the tree that an event never happens.
fn excluded<'s>(subject: &Subject<'s>) -> impl Iterator<Item = (&'s Claim, &'s Occurrence)> {
    let claimed = subject.claimed;
    let claims = subject.program.claims.iter();
    claims
        .filter(move |claim| claim.tree == claimed)
        .filter_map(|claim| match &claim.kind {
            ClaimKind::Never(occurrence) => Some((claim, occurrence)),
            _ => None,
        })
}

/// The events that the program claims never to happen under the tree, in any episode and at any time.
fn never(subject: &Subject) -> Vec<usize> {
    let always =
        excluded(subject).filter(|(_, never)| never.within.is_none() && never.probability >= 1.0);
    always.map(|(_, never)| never.event.index()).collect()
}
