//! What it would be worth to see more.
//!
//! A policy decides by minterms, and cannot tell apart what they do not show. So a world is played in which many
//! conditions more are observed, none of which the policy asks. Its decisions are counted twice: by what the policy sees, and
//! by that and one condition. Each count is solved, and the solutions are compared: the condition is worth what the better
//! solution returns above the other. A finer count always looks better on what it was made from, so a solution is found on
//! one half of the episodes and evaluated on the other.
//!
//! Counts are made where the policy of today goes, so they promise too much here and too little there. What they promise a gain
//! of is tried: the learner learns with it, and what it learns is improved for a little while and played.

use super::evidence::{Evidence, KNOWN, Sight};
use super::gathered::{Excursion, Gathered};
use super::ground::Ground;
use super::iterate::{Iteration, Pace};
use crate::checkpoint::{Forgetful, Part};
use crate::ir::tree::{Atom, Node};
use crate::learn::episode::Episode;
use crate::learn::experiment::Experiment;
use crate::learn::greedy;
use crate::learn::process::{Key, World};
use crate::learn::simulated::Purpose;
use crate::tree::Runner;
use crate::trial::decisions::Taken;
use crate::trial::play::Ticked;

/// The parts of the decisions that explore, in turn.
const EXPLORED: [f64; 3] = [0.05, 0.2, 0.6];

/// The decisions by which counts are doubted.
const DOUBT: f64 = 4.0;

/// Decisions in a world in which more is observed than a tree asks.
#[derive(Debug)]
pub struct Probe {
    episodes: Vec<Vec<Taken>>,
    /// Ticks simulated.
    pub ticks: u64,
}

impl Probe {
    /// Plays about `ticks` ticks under a tree. `seen`: the atoms that it can ask.
    ///
    /// # Errors
    /// The tree asks an atom that the world does not know.
    pub fn new<W: World>(
        ground: &Ground<W>,
        root: &Node,
        seen: Key,
        ticks: u64,
    ) -> Result<Self, Atom> {
        let tree = Ticked(Runner::new(root, ground.world.atoms())?);
        let mut known = Evidence::new(ground);
        let mut probe = Self {
            episodes: Vec::new(),
            ticks: 0,
        };
        for (part, explore) in EXPLORED.into_iter().enumerate() {
            let excursions = Excursion::all(ground, &known);
            let start = ground.episodes(Purpose::Probe, part as u64);
            let (mut used, mut episodes) = (0, 0);
            let due = ticks / EXPLORED.len() as u64;
            while used < due {
                let exploring = (explore, excursions.as_slice());
                let played =
                    Gathered::batch(ground, &tree, exploring, (start, episodes), (due, used));
                episodes += played.len() as u64;
                for gathered in played {
                    used += gathered.ticks;
                    let taken = gathered.taken.iter();
                    taken.for_each(|taken| known.count(&within(taken, seen)));
                    probe.episodes.push(gathered.taken);
                }
            }
            probe.ticks += used;
        }
        Ok(probe)
    }

    /// What an episode returns, in a far sight, under the best policy of those that see these atoms.
    pub fn worth<W: World>(&self, ground: &Ground<W>, seen: Key) -> f64 {
        let halves = [0, 1].map(|half| {
            let mut evidence = Evidence::whole(ground);
            let episodes = self.episodes.iter().skip(half).step_by(2);
            let taken = episodes.flatten();
            taken.for_each(|taken| evidence.count(&within(taken, seen)));
            evidence
        });
        let [one, other] = &halves;
        let worth = [(one, other, 1), (other, one, 0)].map(|(found, judged, half)| {
            let episodes = self.episodes.iter().skip(half).step_by(2);
            let starts = episodes.filter_map(|taken| Some(taken.first()?.from & seen));
            value(found, judged, starts)
        });
        worth.iter().sum::<f64>() / 2.0
    }
}

/// Learns as the learner does, improves the policy for a little while, and plays it: what a learner that sees this may well
/// reach.
pub fn outlook<W: World>(
    experiment: &Experiment<W>,
    (effort, episodes): (u64, u64),
    seed: u64,
) -> Vec<Episode> {
    let ground = super::ground(experiment, seed);
    let iteration = Iteration {
        ground: &ground,
        unseen: greedy::unseen(experiment.program, experiment.learner.task),
        least: experiment.evidence,
        effort,
        pace: Pace::QUICK,
        others: &[],
    };
    let runs = experiment.learn_all((seed, 1), &Forgetful, || {});
    let decisions = runs.into_iter().next().map(|run| run.decisions);
    let found = iteration.run(&decisions.unwrap_or_default(), &Part::new(&Forgetful, ""));
    let start = ground.episodes(Purpose::Probe, EXPLORED.len() as u64);
    iteration.tested(&found, start, episodes)
}

/// A decision as those see it who see these atoms alone.
fn within(taken: &Taken, seen: Key) -> Taken {
    Taken {
        from: taken.from & seen,
        to: taken.to & seen,
        ..*taken
    }
}

/// The mean value of some starts under the best policy of one count, by another. Where the first does not know a minterm,
/// the policy does what was done there most.
fn value(found: &Evidence, judged: &Evidence, starts: impl Iterator<Item = Key>) -> f64 {
    let problem = found.doubted(Sight::Far, DOUBT);
    let policy = problem.solve().policy;
    let choice = |key: Key| {
        let row = found.row(key)?;
        let (choice, _) = problem.states.get(row)?.get((*policy.get(row)?)?)?;
        Some(*choice)
    };
    let mut on = judged.doubted(Sight::Far, DOUBT);
    let keys = judged.keys().iter().zip(&on.states).enumerate();
    let followed: Vec<Option<usize>> = keys
        .map(|(row, (key, state))| {
            let wanted = choice(*key);
            let found = state.iter().position(|(choice, _)| Some(*choice) == wanted);
            let cells = judged.cells(row);
            let count = |choice: usize| cells.get(choice).map_or(0.0, |cell| cell.count);
            let usual = || {
                let counted = state.iter().enumerate();
                let most = counted.max_by(|(_, (a, _)), (_, (b, _))| {
                    count(*a).total_cmp(&count(*b)).then(b.cmp(a))
                });
                most.map(|(at, _)| at)
            };
            found.or_else(usual)
        })
        .collect();
    // What is not known is as bad as what is known at its worst.
    on.unknown = on.low(&on.evaluate(&followed));
    let values = on.evaluate(&followed);
    let (mut sum, mut number) = (0.0, 0.0);
    for key in starts {
        let value = judged.row(key).and_then(|row| values.get(row));
        sum += value.copied().unwrap_or(on.unknown);
        number += 1.0;
    }
    match number > KNOWN {
        true => sum / number,
        false => f64::NEG_INFINITY,
    }
}
