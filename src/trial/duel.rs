//! Two trees against each other on common seeds, each in a world of its own: that of the program, or of a changed one.

use super::Unplayable;
use super::play::{Ticked, ready};
use crate::ir::task::Task;
use crate::ir::tree::Node;
use crate::ir::{Id, Program};
use crate::learn::episode::{Episode, play};
use crate::learn::statistics::{Mean, ROUNDING, Summary};
use crate::world::{End, Simulator, Start};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

/// Episodes that one thread plays in a row.
pub const CHUNK: usize = 8;

/// A tree in its world, ready to play.
#[derive(Clone, Debug)]
pub struct Player {
    simulator: Simulator,
    tree: Ticked,
    patience: Option<u64>,
}

impl Player {
    /// A tree in the world of a task.
    pub fn new(program: &Program, task: Id<Task>, root: &Node) -> Result<Self, Unplayable> {
        let (simulator, tree) = ready(program, task, root)?;
        let patience = program.tasks[task].patience;
        Ok(Self {
            simulator,
            tree,
            patience,
        })
    }

    /// Plays the episodes from `from` to before `to`, one after another.
    pub fn play(&self, start: Start, from: usize, to: usize) -> Vec<Episode> {
        let mut simulation = self.simulator.simulation();
        let mut tree = self.tree.clone();
        let episodes = (from..to).map(|number| {
            let start = Start {
                episode: number as u64,
                ..start
            };
            play(&mut simulation, &mut tree, start, self.patience)
        });
        episodes.collect()
    }
}

/// Two against each other on fresh seeds.
#[derive(Clone, Debug, Serialize, Deserialize)]
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
    /// The duel that these episodes are, before and after, in a task with so many lines of `end on`.
    pub fn of(before: &[Episode], after: &[Episode], ends: usize) -> Self {
        Self {
            before: Summary::of(before, ends),
            after: Summary::of(after, ends),
            gain: gain(after, before),
            ended: ended(after, before),
            ticks: before.iter().chain(after).map(|e| e.ticks).sum(),
        }
    }

    /// Whether the whole interval of the gain is above 0, and no more episodes end badly.
    pub fn is_won(&self) -> bool {
        self.gain.ci95[0] > 0.0 && self.ended.0 <= self.ended.1
    }
}

impl Player {
    /// Plays episodes 0 … n − 1 on all threads.
    pub fn play_all(&self, start: Start, episodes: usize) -> Vec<Episode> {
        let chunks = (0..episodes).into_par_iter().step_by(CHUNK);
        chunks
            .flat_map_iter(|from| self.play(start, from, episodes.min(from + CHUNK)))
            .collect()
    }
}

/// Lets two trees play the same episodes of a task, which has the same id in both programs; the episodes of both come with
/// the figures.
///
/// # Errors
/// One of them cannot be played.
pub fn duel(
    task: Id<Task>,
    [before, after]: [(&Program, &Node); 2],
    start: Start,
    episodes: u64,
) -> Result<(Duel, [Vec<Episode>; 2]), Unplayable> {
    let number = usize::try_from(episodes).unwrap_or(usize::MAX);
    let play = |(program, root): (&Program, &Node)| -> Result<Vec<Episode>, Unplayable> {
        let player = Player::new(program, task, root)?;
        Ok(player.play_all(start, number))
    };
    let ends = before.0.tasks[task].end_on.len();
    let (before, after) = (play(before)?, play(after)?);
    Ok((Duel::of(&before, &after, ends), [before, after]))
}

/// What one gains over another, episode by episode.
pub fn gain(own: &[Episode], other: &[Episode]) -> Mean {
    let pairs = own.iter().zip(other);
    let gains: Vec<f64> = pairs
        .map(|(own, other)| {
            let gain = own.total - other.total;
            let least = ROUNDING * own.total.abs().max(other.total.abs());
            if gain.abs() > least { gain } else { 0.0 }
        })
        .collect();
    Mean::of(&gains)
}

/// The episodes that a line of `end on` ended to one's own loss and not in the same way to the other's, and the other
/// way round.
pub fn ended(own: &[Episode], other: &[Episode]) -> (usize, usize) {
    let worse = |own: &Episode, other: &Episode| {
        matches!(own.end, End::On(_)) && own.end != other.end && own.total < other.total
    };
    let pairs = || own.iter().zip(other);
    (
        pairs().filter(|(own, other)| worse(own, other)).count(),
        pairs().filter(|(own, other)| worse(other, own)).count(),
    )
}

/// The episodes in which one of some events has happened.
pub fn happened(episodes: &[Episode], events: &[usize]) -> usize {
    let any = |episode: &&Episode| {
        let mut counts = events.iter().map(|event| episode.events.get(*event));
        counts.any(|count| count.is_some_and(|count| *count > 0))
    };
    episodes.iter().filter(any).count()
}
