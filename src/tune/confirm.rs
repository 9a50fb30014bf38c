//! What was found, held against the values in use on seeds that nothing was chosen by.

use super::account::Account;
use super::field::{Field, Point};
use super::{Options, Subject, excluded, never};
use crate::ir::Program;
use crate::ir::task::TreeRef;
use crate::ir::tree::Node;
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::trial::Unplayable;
use crate::trial::claim::Tests;
use crate::trial::duel::{self, Duel, Player, happened};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;

/// Some values against those in use.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Confirmed {
    /// The values, in the units of the numbers.
    pub values: Vec<f64>,
    /// How they do.
    pub duel: Duel,
    /// The claims on the tree that do not hold under these values, and hold under those in use or fail more seldom, as they are
    /// written.
    pub refuted: Vec<String>,
}

impl Confirmed {
    /// Whether these values are better, and refute no claim that an event never happens.
    pub fn holds(&self) -> bool {
        self.duel.is_won() && self.refuted.is_empty()
    }
}

/// Lets the tree of a subject play so many fresh episodes under other values, and another tree as well.
///
/// # Errors
/// One of them cannot be played.
pub fn duel(
    subject: &Subject,
    program: &Program,
    before: (&Program, &Node),
    (seed, episodes): (u64, u64),
) -> Result<Duel, Unplayable> {
    let limit = program.tasks[subject.task].end_after;
    let start = Purpose::TuneConfirm.start(seed, limit);
    let both = [before, (program, subject.root)];
    Ok(duel::duel(subject.task, both, start, episodes)?.0)
}

/// The most episodes that test a claim on an event, on the account of a search.
pub(super) const MOST: u64 = 1000;

/// The fewest fresh episodes that say anything.
const LEAST: u64 = 8;

/// How often fresh episodes are played to hold so many points against the values in use, which play them once. What was
/// learned is learned again under better values, and both trees play once more.
pub(super) fn plays(subject: &Subject, points: usize) -> u64 {
    let again = matches!(subject.claimed, TreeRef::Learned(_));
    1 + points as u64 + 2 * u64::from(again)
}

/// How often the claims on the tree are tested, once for each time within which they are meant.
pub(super) fn tests(subject: &Subject, points: usize) -> u64 {
    let within: BTreeSet<_> = excluded(subject).map(|(_, claim)| claim.within).collect();
    within.len() as u64 * (1 + points as u64)
}

/// What became of points on fresh seeds.
pub(super) struct Opinions {
    /// In the order in which they were tried, up to the first that is better.
    pub(super) opinions: Vec<Confirmed>,
    /// The number of fresh episodes.
    pub(super) fresh: u64,
    /// The ticks of the whole search.
    pub(super) ticks: u64,
}

/// Plays fresh episodes under the values of some points and under those in use, as many as there is effort left for.
/// Points under whose values the program has mistakes are left out.
pub(super) fn confirm(
    field: &Field,
    points: &[Point],
    options: &Options,
) -> Result<Opinions, Unplayable> {
    let (subject, mut account) = (field.subject(), field.account);
    let (length, left) = (field.length(), account.left());
    let (plays, tests) = (plays(subject, points.len()), tests(subject, points.len()));
    // Where there are claims, half is for them.
    let for_tests = if tests > 0 { left / 2 } else { 0 };
    let most = MOST.min(for_tests / (tests.max(1) * length));
    let fresh = options.episodes.min((left - for_tests) / (plays * length));
    let mut opinions = Vec::new();
    if points.is_empty() || fresh < LEAST.min(options.episodes) {
        return Ok(Opinions {
            opinions,
            fresh: 0,
            ticks: account.ticks,
        });
    }
    let task = &subject.program.tasks[subject.task];
    let start = Purpose::TuneConfirm.start(options.seed, task.end_after);
    let play = |program: &Program, account: &mut Account| -> Result<Vec<Episode>, Unplayable> {
        let player = Player::new(program, subject.task, subject.root)?;
        let episodes = player.play_all(start, fresh as usize);
        account.spend(episodes.iter().map(|episode| episode.ticks).sum());
        Ok(episodes)
    };
    let before = play(subject.program, &mut account)?;
    let mut used = Tests::at_most(subject.program, most);
    for point in points {
        let values = field.values(point);
        let Some(program) = (subject.revalued)(&values) else {
            continue;
        };
        let after = play(&program, &mut account)?;
        let mut tests = Tests::at_most(&program, most);
        let refuted = refuted(subject, (&mut used, &mut tests), [&before, &after])?;
        account.spend(tests.ticks());
        let duel = Duel::of(&before, &after, task.end_on.len());
        let opinion = Confirmed {
            values,
            duel,
            refuted,
        };
        let holds = opinion.holds();
        opinions.push(opinion);
        if holds {
            break;
        }
    }
    account.spend(used.ticks());
    Ok(Opinions {
        opinions,
        fresh,
        ticks: account.ticks,
    })
}

/// The claims that tell against other values, by tests and by episodes under the values in use and under the others.
fn refuted<'a: 'b, 'b>(
    subject: &Subject<'a>,
    (used, tests): (&mut Tests<'a>, &mut Tests<'b>),
    played: [&[Episode]; 2],
) -> Result<Vec<String>, Unplayable> {
    let never = never(subject);
    let mut refuted = Vec::new();
    for (claim, occurrence) in excluded(subject) {
        let tree = (subject.task, subject.root);
        let tested = tests.event(tree, occurrence, false)?;
        let event = occurrence.event.index();
        let [before, after] = played.map(|played| happened(played, &[event]));
        let met = never.contains(&event) && after > 0;
        // A claim that fails in any case, and not more often, tells against neither.
        let fails = (tested.refuted() || met)
            && (after > before || !used.event(tree, occurrence, false)?.refuted());
        if fails {
            refuted.push(claim.text.clone());
        }
    }
    Ok(refuted)
}
