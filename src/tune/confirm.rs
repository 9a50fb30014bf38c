//! What was found, held against the values in use on seeds that nothing was chosen by.

use super::field::{Player, ended, gain, happened, values};
use super::grid::Axis;
use super::{Options, Subject, never};
use crate::ir::Program;
use crate::ir::task::ClaimKind;
use crate::ir::tree::Node;
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::{Mean, Summary};
use crate::trial::Unplayable;
use crate::trial::claim::Tests;
use rayon::prelude::*;

/// Episodes that one thread plays in a row.
const CHUNK: usize = 8;

/// Two against each other on fresh seeds.
#[derive(Clone, Debug)]
pub struct Duel {
    /// The figures of what was there before.
    pub before: Summary,
    /// The figures of what is held against it.
    pub after: Summary,
    /// What this gains, episode by episode.
    pub gain: Mean,
    /// The episodes that a line of `end on` ended to its loss and not to that of the other, and the other way round.
    pub ended: (usize, usize),
    /// Ticks simulated.
    pub ticks: u64,
}

impl Duel {
    /// Whether the whole interval of the gain is above 0, and no more episodes end badly.
    pub fn is_won(&self) -> bool {
        self.gain.ci95[0] > 0.0 && self.ended.0 <= self.ended.1
    }
}

/// Some values against those in use.
#[derive(Clone, Debug)]
pub struct Confirmed {
    /// The values, in the units of the numbers.
    pub values: Vec<f64>,
    /// How they do.
    pub duel: Duel,
    /// The claims on the tree that do not hold under these values, as they are written.
    pub refuted: Vec<String>,
}

impl Confirmed {
    /// Whether these values are better, and refute no claim that an event never happens.
    pub fn holds(&self) -> bool {
        self.duel.is_won() && self.refuted.is_empty()
    }
}

/// Lets the tree of a subject play fresh episodes under other values, and the tree of another under those in use.
///
/// # Errors
/// One of them cannot be played.
pub fn duel(
    subject: &Subject,
    program: &Program,
    before: (&Program, &Node),
    options: &Options,
) -> Result<Duel, Unplayable> {
    Ok(fought(subject, program, before, options)?.0)
}

fn fought(
    subject: &Subject,
    program: &Program,
    (used, root): (&Program, &Node),
    options: &Options,
) -> Result<(Duel, Vec<Episode>), Unplayable> {
    let task = &program.tasks[subject.task];
    let start = Purpose::TuneConfirm.start(options.seed, task.end_after);
    let number = usize::try_from(options.episodes).unwrap_or(usize::MAX);
    let play = |player: &Player| -> Vec<Episode> {
        let chunks = (0..number).into_par_iter().step_by(CHUNK);
        chunks
            .flat_map_iter(|from| player.play(start, from, number.min(from + CHUNK)))
            .collect()
    };
    let before = play(&Player::new(used, subject.task, root)?);
    let after = play(&Player::new(program, subject.task, subject.root)?);
    let ends = task.end_on.len();
    let duel = Duel {
        before: Summary::of(&before, ends),
        after: Summary::of(&after, ends),
        gain: gain(&after, &before),
        ended: ended(&after, &before),
        ticks: before.iter().chain(&after).map(|e| e.ticks).sum(),
    };
    Ok((duel, after))
}

/// Plays fresh episodes under the values of a point and under those in use. `None` if the program has mistakes under
/// these values.
pub(super) fn confirm(
    subject: &Subject,
    axes: &[Axis],
    point: &[usize],
    options: &Options,
) -> Result<Option<Confirmed>, Unplayable> {
    let values = values(axes, point);
    let Some(program) = (subject.revalued)(&values) else {
        return Ok(None);
    };
    let (duel, episodes) = fought(subject, &program, (subject.program, subject.root), options)?;
    let never = never(subject);
    let mut refuted = Vec::new();
    let mut tests = Tests::new(&program);
    for claim in program.claims.iter().filter(|c| c.tree == subject.claimed) {
        let ClaimKind::Never(occurrence) = &claim.kind else {
            continue;
        };
        let tested = tests.event((subject.task, subject.root), occurrence, false)?;
        let event = occurrence.event.index();
        let met = never.contains(&event) && happened(&episodes, &[event]) > 0;
        if tested.refuted() || met {
            refuted.push(claim.text.clone());
        }
    }
    Ok(Some(Confirmed {
        values,
        duel,
        refuted,
    }))
}
