//! Policy iteration with simulation as the judge.
//!
//! A minterm stands for many states, so what follows a decision depends on the way there, and a policy that a model calls
//! better may be far worse: it goes where the counts are few, or round in circles that the minterms do not show. So every
//! policy is doubted in several degrees, a part of its changes is taken at a time, and it is played. What looked good and
//! was not is counted, and the next round knows it.

mod candidate;
mod plan;

use super::evidence::{Cell, Evidence, Sight, Visits};
use super::ground::{Ground, does_more_harm};
use super::survey::survey;
use crate::checkpoint::Part;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::learn::episode::{Episode, play_all};
use crate::learn::extract::{Decided, Decisions};
use crate::learn::greedy::Greedy;
use crate::learn::improve::is_worth_it;
use crate::learn::process::{Key, World};
use crate::learn::q_table::QTable;
use crate::learn::simulated::Purpose;
use crate::random::Random;
use crate::trial::paired::error;
use crate::world::Start;
use candidate::{Candidate, gain};
use plan::Plan;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use serde::{Deserialize, Serialize};

/// The decisions by which counts are doubted: so many more are supposed that go as badly as any in the minterm.
const DOUBTS: [f64; 3] = [4.0, 15.0, 40.0];
/// The standard errors of its worth by which a choice is held for worse than it looks.
const CARES: [f64; 2] = [0.0, 1.5];
/// The stage from which on a policy has to look better.
const TELLING: usize = 16;
/// Policies of a round that are counted under, whether they turn out good or not.
const COUNTED: usize = 3;
/// The gain that a policy must have, in standard errors.
const SURE: f64 = 2.0;
/// Rounds without a better policy before it is enough.
const FAILURES: usize = 10;
/// Rounds without a better policy before the same one is counted under again.
const STALE: usize = 4;
/// Random decisions under the policy at hand.
const EXPLORING: [f64; 3] = [0.05, 0.2, 0.6];
/// Random decisions under those that are tried.
const TRYING: f64 = 0.1;

/// The number of the first collection under another run's policy.
const OTHERS: u64 = 1 << 15;

/// How the effort is divided.
#[derive(Clone, Copy, Debug)]
pub struct Pace {
    /// The effort is so many collections.
    collections: u64,
    /// The stages of a round: episodes, and the policies that stay.
    stages: [(usize, usize); 3],
}

impl Pace {
    /// Many rounds, in which small gains show.
    pub const THOROUGH: Self = Self {
        collections: 100,
        stages: [(4, 8), (16, 3), (64, 1)],
    };
    /// A few rounds, in which large gains show.
    pub const QUICK: Self = Self {
        collections: 12,
        stages: [(2, 6), (6, 2), (20, 1)],
    };
}

/// The choice in each minterm, by its number.
type Choices = FxHashMap<Key, usize>;

/// A better policy.
#[derive(Debug)]
pub struct Iterated {
    choices: Choices,
    evidence: Evidence,
    /// Ticks that were simulated.
    pub ticks: u64,
}

impl Iterated {
    /// Takes the decisions over, with the evidence for minterms that have none; gives the number of those that changed.
    pub fn apply(self, decisions: &mut Decisions, table: &mut QTable) -> usize {
        let mut changed = 0;
        let mut choices: Vec<(Key, usize)> = self.choices.into_iter().collect();
        choices.sort_unstable();
        let worths = self.evidence.worths(Sight::Learner);
        for (key, choice) in choices {
            if let Some(decided) = decisions.get_mut(&key) {
                changed += usize::from(decided.choice != choice);
                decided.choice = choice;
                continue;
            }
            let Some(found) = self.evidence.row(key) else {
                continue;
            };
            let row = table.row(key);
            let cells = self.evidence.cells(found).iter().enumerate();
            for (choice, counted) in cells {
                let worth = worths.get(found).and_then(|row| row.get(choice));
                let Some((mean, variance)) = worth.copied().flatten() else {
                    continue;
                };
                if let Some(cell) = table.cell_mut(row, choice) {
                    cell.visits = counted.count as u64;
                    cell.q = mean;
                    cell.squares = counted.count * (mean * mean + variance);
                }
            }
            let value = table.cells(row).get(choice).map_or(0.0, |cell| cell.q);
            decisions.insert(key, Decided { choice, value });
            changed += 1;
        }
        changed
    }
}

/// Improves a policy, round by round.
#[derive(Debug)]
pub struct Iteration<'g, 'w, W> {
    /// Where they are judged.
    pub ground: &'g Ground<'w, W>,
    /// What is done in a minterm without a decision.
    pub unseen: Id<Behavior>,
    /// The fewest decisions by which a minterm is known.
    pub least: u64,
    /// About how many ticks may be simulated.
    pub effort: u64,
    /// How these are divided.
    pub pace: Pace,
    /// The policies of other runs: what follows their decisions is counted, too.
    pub others: &'g [Decisions],
}

/// Where the iteration stands between two rounds.
#[derive(Serialize, Deserialize)]
struct Halted {
    choices: Choices,
    evidence: Evidence,
    /// Where the policy goes.
    visits: Visits,
    random: Random,
    ticks: u64,
    failures: usize,
    round: u64,
}

impl<W: World> Iteration<'_, '_, W> {
    /// Improves a policy, from where a run before was stopped.
    pub fn run(&self, decisions: &Decisions, part: &Part) -> Iterated {
        let choices = decisions.iter();
        let halted = part.resume().unwrap_or_else(|| Halted {
            choices: choices.map(|(key, it)| (*key, it.choice)).collect(),
            evidence: Evidence::new(self.ground),
            visits: Visits::default(),
            random: Random::new(self.ground.seed, 1 << 42, 0),
            ticks: 0,
            failures: 0,
            round: 0,
        });
        let Halted {
            mut evidence,
            mut visits,
            mut random,
            mut ticks,
            mut failures,
            mut round,
            choices,
        } = halted;
        let mut base = Candidate::new(choices);
        while ticks < self.effort && failures < FAILURES {
            round += 1;
            if failures % STALE == 0 {
                for (at, explore) in EXPLORING.into_iter().enumerate() {
                    let number = round * 8 + at as u64;
                    let (visited, used) =
                        self.collect(&mut evidence, &base.choices, explore, number);
                    ticks += used;
                    if at == 0 {
                        visits = visited;
                    }
                }
            }
            if round == 1 {
                ticks += self.know_others(&mut evidence);
                ticks += survey(self.ground, &mut evidence, self.effort);
                ticks += self.act(&mut evidence, &mut base);
            }
            base.played.clear();
            let (candidates, work) =
                self.candidates(&evidence, &base.choices, &visits, &mut random);
            ticks += work;
            let (found, used) = self.race(&mut evidence, &mut base, candidates, round);
            ticks += used;
            match found {
                Some(better) => {
                    base = better;
                    failures = 0;
                }
                None => failures += 1,
            }
            part.keep(|| Halted {
                choices: base.choices.clone(),
                evidence: evidence.clone(),
                visits: visits.clone(),
                random: random.clone(),
                ticks,
                failures,
                round,
            });
        }
        Iterated {
            choices: base.choices,
            evidence,
            ticks,
        }
    }

    /// Episodes 0 … n − 1 under a policy that was found.
    pub fn tested(&self, found: &Iterated, start: Start, episodes: u64) -> Vec<Episode> {
        let greedy = self.greedy(&found.choices);
        play_all(episodes, start, self.ground.patience, || {
            (self.ground.world.process(), greedy.clone())
        })
    }

    /// Counts under a policy; gives where it went, and the ticks.
    fn collect(
        &self,
        evidence: &mut Evidence,
        choices: &Choices,
        part: f64,
        number: u64,
    ) -> (Visits, u64) {
        let from = match part >= 0.5 {
            true => self.ground.exploring,
            false => self.ground.start,
        };
        let start = Start {
            seed: self.ground.seed,
            stream: Purpose::Count as u64,
            episode: (1 << 40) + (number << 20),
            ..from
        };
        let greedy = self.greedy(choices);
        let ticks = self.effort / self.pace.collections;
        evidence.collect(self.ground, &greedy, (part, start), ticks)
    }

    /// Counts under the policies of other runs, which may know ways that this one does not; gives the ticks.
    fn know_others(&self, evidence: &mut Evidence) -> u64 {
        let mut ticks = 0;
        let mut numbers = OTHERS..;
        for decisions in self.others {
            let choices = decisions.iter().map(|(key, it)| (*key, it.choice));
            let choices: Choices = choices.collect();
            for (explore, number) in EXPLORING.into_iter().zip(&mut numbers) {
                ticks += self.collect(evidence, &choices, explore, number).1;
            }
        }
        ticks
    }

    /// Takes decisions that do not fail at once, unless they are surely worse: a tree would not wait there, but go on to
    /// something else. Gives the ticks that it took to find out.
    fn act(&self, evidence: &mut Evidence, base: &mut Candidate) -> u64 {
        let mut acting = Candidate::new(self.acting(evidence, base.choices.clone()));
        if acting.choices == base.choices {
            return 0;
        }
        let start = self.ground.episodes(Purpose::Improve, 1 << 12);
        let mut used = self.play(evidence, std::slice::from_mut(base), start, TELLING, None);
        used += self.play(
            evidence,
            std::slice::from_mut(&mut acting),
            start,
            TELLING,
            Some(base),
        );
        let gain = gain(&acting, base);
        if gain.mean >= -error(&gain) {
            *base = acting;
        }
        used
    }

    /// The best decisions that do not fail at once, by the counts, in place of those that do.
    fn acting(&self, evidence: &Evidence, mut choices: Choices) -> Choices {
        let problem = evidence.problem(Sight::Far);
        let (_, solution) = evidence.cautious(&problem, 1.0, Sight::Far);
        let rows = evidence.keys().iter().zip(&problem.states);
        let rows = rows.zip(&solution.policy);
        for (row, ((key, state), taken)) in rows.enumerate() {
            let Some(now) = choices.get_mut(key) else {
                continue;
            };
            let cell = evidence.cells(row).get(*now);
            let best = taken.and_then(|taken| state.get(taken));
            if let (true, Some((best, _))) = (cell.is_some_and(Cell::refuses), best) {
                *now = *best;
            }
        }
        choices
    }

    /// Policies that are better by the counts, or take a part of what makes one better, and the ticks in whose time they are
    /// found.
    fn candidates(
        &self,
        evidence: &Evidence,
        now: &Choices,
        visits: &Visits,
        random: &mut Random,
    ) -> (Vec<Candidate>, u64) {
        let mut found: Vec<Choices> = Vec::new();
        let mut work = 0;
        for (plan, own) in self.plans(evidence, now) {
            work += own;
            for changes in plan.parts(visits, random) {
                let mut mixed = now.clone();
                mixed.extend(changes);
                if mixed != *now && !found.contains(&mixed) {
                    found.push(mixed);
                }
            }
        }
        (found.into_iter().map(Candidate::new).collect(), work)
    }

    /// What is decided otherwise by the counts, near-sighted and far-sighted, doubted in several degrees, with more care and less;
    /// each with its work.
    fn plans<'k>(&self, evidence: &'k Evidence, now: &Choices) -> Vec<(Plan<'k>, u64)> {
        let sights = [Sight::Far, Sight::Learner].into_iter();
        let doubted = sights.flat_map(|sight| DOUBTS.map(|doubt| (sight, doubt)));
        let ways = doubted.flat_map(|(sight, doubt)| CARES.map(|care| (sight, doubt, care)));
        let ways: Vec<(Sight, f64, f64)> = ways.collect();
        let plans = ways.into_par_iter().map(|(sight, doubt, care)| {
            let problem = evidence.doubted(sight, doubt);
            let (cautious, solution) = evidence.cautious(&problem, care, sight);
            let rows = evidence.keys().iter().zip(&cautious.states);
            let changes = rows.zip(&solution.policy).enumerate();
            let changes = changes.filter_map(|(row, ((key, state), taken))| {
                let (choice, _) = state.get((*taken)?)?;
                let new = now.get(key) != Some(choice);
                (new && self.is_known(evidence, *key)).then_some((row, *choice))
            });
            let plan = Plan::new(evidence.keys(), changes.collect(), &cautious, &solution);
            (plan, cautious.work())
        });
        plans.collect()
    }

    fn is_known(&self, evidence: &Evidence, key: Key) -> bool {
        let row = evidence.row(key).map(|row| evidence.cells(row));
        let counts = row.into_iter().flatten().map(|cell| cell.count);
        counts.sum::<f64>() >= self.least as f64
    }

    /// The best of these policies if it is surely better than the base, and the ticks that it took to find out.
    fn race(
        &self,
        evidence: &mut Evidence,
        base: &mut Candidate,
        mut standing: Vec<Candidate>,
        round: u64,
    ) -> (Option<Candidate>, u64) {
        let start = self.ground.episodes(Purpose::Improve, (1 << 12) + round);
        let mut used = 0;
        for (stage, (episodes, stay)) in self.pace.stages.into_iter().enumerate() {
            if standing.is_empty() {
                return (None, used);
            }
            used += self.play(evidence, std::slice::from_mut(base), start, episodes, None);
            used += self.play(evidence, &mut standing, start, episodes, Some(base));
            if episodes >= TELLING {
                standing.retain(|candidate| {
                    let gain = gain(candidate, base);
                    gain.mean + 0.5 * error(&gain) > 0.0
                });
            }
            let worth = |candidate: &Candidate| gain(candidate, base).mean;
            standing.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
            standing.truncate(stay);
            if stage == 0 {
                for (at, candidate) in standing.iter().take(COUNTED).enumerate() {
                    let number = round * 8 + (EXPLORING.len() + at) as u64;
                    used += self.collect(evidence, &candidate.choices, TRYING, number).1;
                }
            }
        }
        let surely = |candidate: &Candidate| {
            let harms = |of: &Candidate| -> u64 {
                let harms = of.episodes().map(|episode| self.ground.harm(episode));
                harms.sum()
            };
            !does_more_harm([harms(candidate), harms(base)], 1.0)
                && is_worth_it(&candidate.totals(), &base.totals(), SURE)
        };
        (standing.into_iter().next().filter(surely), used)
    }

    /// Lets policies play up to a number of episodes, and counts what came of it and the ticks. An episode in which a policy
    /// decides as `known` does is not played again.
    fn play(
        &self,
        evidence: &mut Evidence,
        candidates: &mut [Candidate],
        start: Start,
        episodes: usize,
        known: Option<&Candidate>,
    ) -> u64 {
        let controllers = candidates.iter().map(|it| self.greedy(&it.choices));
        let controllers: Vec<Greedy> = controllers.collect();
        let (taken, ticks) = candidate::play(
            self.ground,
            (candidates, &controllers),
            (start, episodes),
            known,
        );
        evidence.count_all(&taken);
        ticks
    }

    fn greedy(&self, choices: &Choices) -> Greedy {
        let choices = choices.iter();
        let behaviors = choices.filter_map(|(key, choice)| {
            let behavior = self.ground.choices.get(*choice)?;
            Some((*key, *behavior))
        });
        Greedy::of(behaviors.collect(), self.unseen)
    }
}
