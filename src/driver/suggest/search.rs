//! Which conditions are worth learning with.

use super::conditions::{Condition, observing};
use crate::driver::load::Loaded;
use crate::driver::refused::Refused;
use crate::driver::world;
use crate::grow;
use crate::grow::probe::{Probe, outlook};
use crate::ir::program::Predicate;
use crate::ir::task::{Learner, Task};
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::episode::Episode;
use crate::learn::experiment::Experiment;
use crate::learn::process::Key;
use crate::trial::Unplayable;
use rayon::prelude::*;

/// The atoms of a minterm.
const ATOMS: usize = 128;
/// The part of the effort in which decisions are counted, for all conditions together.
const COUNTING: f64 = 0.3;
/// The part of the effort for which a policy is improved with one condition.
const PLAYING: f64 = 0.08;
/// The episodes that it plays then.
const EPISODES: u64 = 100;
/// The most readings that are played with.
const READINGS: usize = 8;
/// Of these, those whose thresholds are looked at more closely.
const REFINED: usize = 3;

/// A condition with its predicate.
pub(super) type Known = (Condition, Id<Predicate>);

/// A learned tree, and what else it could be made of.
pub(super) struct Search<'s> {
    pub(super) loaded: &'s Loaded,
    pub(super) learner: Id<Learner>,
    pub(super) evidence: u64,
    pub(super) seed: u64,
    /// The program with the predicates of all conditions.
    pub(super) program: Program,
    pub(super) root: &'s Node,
}

impl Search<'_> {
    /// The places of the conditions that promise a gain, with that, the greatest first, one for each reading; and how many
    /// were played with.
    pub(super) fn promising(
        &self,
        conditions: &[Known],
        effort: u64,
    ) -> Result<(Vec<(usize, f64)>, usize), Refused> {
        let room = ATOMS.saturating_sub(self.program.atoms(self.task()).len());
        if room == 0 {
            return Ok((Vec::new(), 0));
        }
        let passes = conditions.len().div_ceil(room).max(1) as u64;
        let share = |part: f64| (effort as f64 * part) as u64;
        let mut counted = Vec::new();
        for chunk in conditions.chunks(room) {
            counted.extend(self.counted(chunk, share(COUNTING) / passes)?);
        }
        let effort = share(PLAYING);
        let plain = self.played(None, effort)?;
        let mut gains = vec![None; conditions.len()];
        let play = |places: Vec<usize>, gains: &mut Vec<Option<f64>>| {
            let found = places.par_iter().map(|at| {
                let with = self.played(conditions.get(*at).map(|(_, id)| *id), effort)?;
                let pairs = with.iter().zip(&plain);
                let sum: f64 = pairs.map(|(with, plain)| with.total - plain.total).sum();
                Ok(sum / plain.len().max(1) as f64)
            });
            let found: Vec<f64> = found.collect::<Result<_, Refused>>()?;
            for (at, found) in places.iter().zip(found) {
                if let Some(gain) = gains.get_mut(*at) {
                    *gain = Some(found);
                }
            }
            Ok(())
        };
        play(shortlist(conditions, &counted), &mut gains)?;
        // What stands beside the best of a reading may be better.
        let reading = |at: usize| conditions.get(at).map(|(condition, _)| &condition.reading);
        let best = best_of_readings(conditions, &gains).into_iter();
        let beside = best.take(REFINED).flat_map(|at| {
            let both = [at.checked_sub(1), Some(at + 1)].into_iter().flatten();
            both.filter(move |beside| reading(at) == reading(*beside))
        });
        let new = beside.filter(|at| gains.get(*at) == Some(&None));
        play(new.collect(), &mut gains)?;
        let best = best_of_readings(conditions, &gains).into_iter();
        let gain = |at: usize| gains.get(at).copied().flatten();
        let found = best.filter_map(|at| Some((at, gain(at).filter(|gain| *gain > 0.0)?)));
        let mut found: Vec<(usize, f64)> = found.collect();
        // What costs a word alone comes first.
        let written = |at: usize| conditions.get(at).is_some_and(|(it, _)| it.text.is_some());
        found.sort_by_key(|(at, _)| written(*at));
        Ok((found, gains.iter().flatten().count()))
    }

    fn task(&self) -> Id<Task> {
        self.program.learners[self.learner].task
    }

    /// The experiment where the task observes some predicates more.
    fn experiment<'p>(&self, changed: &'p Program) -> Result<Experiment<'p>, Refused> {
        let experiment = Experiment::new(changed, self.learner, None, self.evidence);
        experiment.map_err(|why| world::unplayable(self.loaded, why))
    }

    /// Episodes of what the learner learns soon, with a predicate more or without.
    fn played(&self, id: Option<Id<Predicate>>, effort: u64) -> Result<Vec<Episode>, Refused> {
        let changed = observing(&self.program, self.task(), id.as_slice());
        let experiment = self.experiment(&changed)?;
        Ok(outlook(&experiment, (effort, EPISODES), self.seed))
    }

    /// What counts promise for each condition, if the task observed it.
    fn counted(&self, conditions: &[Known], ticks: u64) -> Result<Vec<Option<f64>>, Refused> {
        let own = self.program.atoms(self.task());
        let ids: Vec<Id<Predicate>> = conditions.iter().map(|(_, id)| *id).collect();
        let wide = observing(&self.program, self.task(), &ids);
        let experiment = self.experiment(&wide)?;
        let ground = grow::ground(&experiment, self.seed);
        let all = ground.atoms();
        let bit = |atom: &Atom| -> Key {
            let at = all.iter().position(|known| known == atom);
            at.map_or(0, |at| 1 << at)
        };
        let seen: Key = own.iter().map(bit).sum();
        let probe = Probe::new(&ground, self.root, seen, ticks)
            .map_err(|atom| world::unplayable(self.loaded, Unplayable::Unknown(atom)))?;
        let plain = probe.worth(&ground, seen);
        let gains = ids.par_iter().map(|id| {
            let gain = probe.worth(&ground, seen | bit(&Atom::Predicate(*id))) - plain;
            gain.is_finite().then_some(gain)
        });
        Ok(gains.collect())
    }
}

/// What the program declares and the task leaves out; and of each reading that promises most the condition that does, with
/// others from both ends of its range.
fn shortlist(conditions: &[Known], counted: &[Option<f64>]) -> Vec<usize> {
    let declared = conditions.iter().enumerate();
    let declared = declared.filter(|(_, (condition, _))| condition.text.is_none());
    let mut shortlist: Vec<usize> = declared.map(|(at, _)| at).collect();
    for at in best_of_readings(conditions, counted)
        .into_iter()
        .take(READINGS)
    {
        let same = |(_, (condition, _)): &(usize, &Known)| {
            conditions
                .get(at)
                .is_some_and(|(best, _)| best.reading == condition.reading)
        };
        let same = conditions.iter().enumerate().filter(same);
        let same: Vec<usize> = same.map(|(at, _)| at).collect();
        let part = |part: usize| same.get(part * same.len() / 6).copied();
        let mut chosen: Vec<usize> = [Some(at), part(1), part(3), part(5)]
            .into_iter()
            .flatten()
            .collect();
        chosen.sort_unstable();
        chosen.dedup();
        chosen.retain(|at| !shortlist.contains(at));
        shortlist.extend(chosen);
    }
    shortlist
}

/// The place of the best condition of each reading that has a score, the best first.
fn best_of_readings(conditions: &[Known], scores: &[Option<f64>]) -> Vec<usize> {
    let scored = scores.iter().enumerate();
    let mut scored: Vec<(usize, f64)> = scored
        .filter_map(|(at, score)| Some((at, (*score)?)))
        .collect();
    scored.sort_by(|(a, x), (b, y)| y.total_cmp(x).then(a.cmp(b)));
    let mut known = Vec::new();
    scored.retain(|(at, _)| {
        let reading = conditions.get(*at).map(|(condition, _)| &condition.reading);
        let new = !known.contains(&reading);
        known.push(reading);
        new
    });
    scored.into_iter().map(|(at, _)| at).collect()
}
