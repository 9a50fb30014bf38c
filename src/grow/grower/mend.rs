//! Changes against harm that is rare.
//!
//! A race does not show what goes wrong in one of two hundred episodes. So the tree that was found plays many of them. Changes of
//! it are tried first in those in which it did harm, and in as many others, which costs little; what does less there races with it
//! over all of them.
//! Besides the changes that the counts suggest, each behaviour is put in front under guards that hold where harm follows and
//! seldom elsewhere.

use super::Grower;
use crate::grow::evidence::{Sight, Visits};
use crate::grow::field::{Aim, Field};
use crate::grow::guards::conjunctions;
use crate::grow::place::Place;
use crate::grow::race::{Entrant, Terms};
use crate::ir::tree::{Guard, Node};
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::tree::unit::guarded;
use crate::trial::decisions::Taken;
use crate::trial::paired::Trials;
use rustc_hash::FxHashSet;
use std::{mem, slice};

/// The part of its ticks that the episodes of the tree take in a round.
const PLAYED: f64 = 0.4;
/// The most of these episodes, and the most of those with harm, and of others, in which changes are tried.
const EPISODES: usize = 1000;
const SAMPLED: usize = 12;
/// Rounds without a better tree before it is enough.
const FAILURES: usize = 2;
/// The decisions before harm that guards are made for, and what a guard loses by the decisions that it lets through elsewhere.
const BEFORE: [usize; 3] = [1, 2, 4];
const ELSEWHERE: [f64; 2] = [1.0, 5.0];
/// The guards that are made for each, and what a literal of them must bring.
const GUARDS: usize = 3;
const LITERAL: f64 = 0.02;
/// The most trees with a behaviour put in front.
const WARDS: usize = 96;
/// The trees that race: the episodes of the first heat, those that begin it, and those that stay after it.
const HEAT: (usize, usize, usize) = (64, 6, 2);

impl<W: World> Grower<'_, '_, '_, W> {
    /// Looks for a tree that does less harm than this one, with so many ticks more, where any was met.
    pub fn mend(&mut self, root: &Node, ticks: u64) -> Node {
        let until = self.judge.seen.ticks.saturating_add(ticks);
        let mut base = root.clone();
        let mut tried = FxHashSet::default();
        let mut failures = 0;
        let harmed = self.judge.seen.harmed && !self.is_sparing();
        while harmed && failures < FAILURES && self.judge.seen.ticks < until {
            self.report(&base);
            let race = self.judge.fresh();
            let trials = self.ground.trials(Purpose::Grow, race);
            let Some(own) = self.played(&base, &trials, ticks) else {
                break;
            };
            let harms = own.contender.each(|episode| self.ground.harm(episode));
            let numbers = 0..own.contender.episodes();
            let (mut bad, mut others): (Vec<usize>, Vec<usize>) =
                numbers.partition(|n| harms.get(*n).is_some_and(|harm| *harm > 0));
            if bad.is_empty() {
                break;
            }
            bad.truncate(SAMPLED);
            others.truncate(SAMPLED);
            match self.less_harmful(&trials, (&own, [&bad, &others]), &mut tried) {
                Some(found) => {
                    base = self.taken(found);
                    tried.clear();
                    failures = 0;
                }
                None => failures += 1,
            }
            self.count_noted();
        }
        base
    }

    /// The tree with its many episodes.
    fn played(&mut self, base: &Node, trials: &Trials<'_, W>, ticks: u64) -> Option<Entrant> {
        let mut own = self.judge.entrant(trials, base)?;
        let most = PLAYED * ticks as f64 / self.judge.seen.length.max(1) as f64;
        let episodes = self.judge.scaled(EPISODES).min(most as usize);
        self.judge
            .play(trials, slice::from_mut(&mut own), episodes, None);
        Some(own)
    }

    /// The best change of a tree that does less harm in these of its episodes with harm, and no worse in others; if it is surely better
    /// over all of them.
    fn less_harmful(
        &mut self,
        trials: &Trials<'_, W>,
        (own, episodes): (&Entrant, [&[usize]; 2]),
        tried: &mut FxHashSet<String>,
    ) -> Option<Entrant> {
        let terms = Terms::taking(self.price);
        self.charge(terms);
        let taken = mem::take(&mut self.judge.noted);
        self.evidence.count_all(&taken);
        let mut trees = self.wards(&own.root, &taken, tried);
        trees.extend(self.proposals(&own.root, self.price, false, tried));
        let ready = trees.iter();
        let ready = ready.filter_map(|root| self.judge.entrant(trials, root));
        let ready = ready.collect();
        let mut spared = self.judge.spared(trials, ready, (own, episodes), terms);
        spared.retain(|(gain, _)| *gain > 0.0);
        spared.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        let mut entrants: Vec<Entrant> = spared.into_iter().map(|(_, it)| it).collect();
        let (first, begin, stay) = HEAT;
        entrants.truncate(begin);
        let all = own.contender.episodes();
        let first = self.judge.scaled(first).min(all);
        for heat in [(first, stay), (all, 1)] {
            self.judge.heat(trials, own, &mut entrants, heat, terms);
        }
        self.judge.winner(entrants, own, terms)
    }

    /// The base with a behaviour in front of it, under guards that hold in the decisions before harm.
    fn wards(&self, base: &Node, taken: &[Taken], tried: &mut FxHashSet<String>) -> Vec<Node> {
        let mut trees = Vec::new();
        let bodies = self.ground.choices.iter().map(|id| Node::Behavior(*id));
        let bodies: Vec<Node> = bodies.collect();
        let Some(place) = Place::all(base).into_iter().next() else {
            return trees;
        };
        for guard in self.dangers(taken) {
            for body in &bodies {
                let tree = place.put(base, &guarded(guard.clone(), body.clone()));
                if trees.len() < WARDS && tried.insert(format!("{tree:?}")) {
                    trees.push(tree);
                }
            }
        }
        trees
    }

    /// Guards that hold where harm follows soon, and seldom elsewhere.
    fn dangers(&self, taken: &[Taken]) -> Vec<Guard> {
        let mut visits = Visits::default();
        for taken in taken {
            *visits.entry(taken.from).or_default() += 1.0;
        }
        let mut found: Vec<Guard> = Vec::new();
        for before in BEFORE {
            let dangers = before_harm(taken, before);
            let all: f64 = dangers.values().sum();
            // What is dangerous matters, however seldom it comes.
            let mut weights = visits.clone();
            for (key, weight) in &mut weights {
                if dangers.contains_key(key) {
                    *weight += taken.len() as f64;
                }
            }
            let field = Field::new(self.ground, &self.evidence, Sight::Far, &weights, Aim::Best);
            for elsewhere in ELSEWHERE {
                let gains = field.spots.iter().map(|spot| {
                    let part = |of: &Visits, all: f64| {
                        of.get(&spot.key).copied().unwrap_or(0.0) / all.max(1.0)
                    };
                    part(&dangers, all) - elsewhere * part(&visits, taken.len() as f64)
                });
                let gains: Vec<f64> = gains.collect();
                let guards = conjunctions(&field, &gains, LITERAL).into_iter();
                for guard in guards.filter(|found| found.gain > 0.0).take(GUARDS) {
                    let guard = guard.guard(&field);
                    if !found.contains(&guard) {
                        found.push(guard);
                    }
                }
            }
        }
        found
    }
}

/// The minterms of so many decisions up to each that did harm, with how often.
fn before_harm(taken: &[Taken], decisions: usize) -> Visits {
    let mut found = Visits::default();
    for (at, last) in taken.iter().enumerate() {
        if !last.harmed {
            continue;
        }
        let before = taken.get(..=at).unwrap_or_default().iter().rev();
        let mut next = None;
        for taken in before.take(decisions) {
            // Another episode, or a decision that is not known.
            if next.is_some_and(|next| taken.to != next) {
                break;
            }
            *found.entry(taken.from).or_default() += 1.0;
            next = Some(taken.from);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::before_harm;
    use crate::ir::tree::Status;
    use crate::learn::process::{End, Key};
    use crate::trial::decisions::Taken;

    fn taken(from: Key, to: Key, harmed: bool) -> Taken {
        Taken {
            from,
            choice: 0,
            to,
            reward: 0.0,
            ticks: 1,
            status: Status::Running,
            end: if harmed { End::Terminal(0) } else { End::Not },
            harmed,
        }
    }

    #[test]
    fn what_comes_before_harm_ends_where_nothing_is_known() {
        let episodes = [
            taken(1, 2, false),
            taken(2, 3, false),
            taken(3, 0, true),
            taken(7, 4, false),
            taken(5, 3, false),
            taken(3, 0, true),
        ];
        let counted = |decisions| {
            let found = before_harm(&episodes, decisions).into_iter();
            let mut found: Vec<(Key, f64)> = found.collect();
            found.sort_by_key(|(key, _)| *key);
            found
        };
        assert_eq!(counted(1), [(3, 2.0)]);
        assert_eq!(counted(2), [(2, 1.0), (3, 2.0), (5, 1.0)]);
        assert_eq!(counted(4), [(1, 1.0), (2, 1.0), (3, 2.0), (5, 1.0)]);
    }
}
