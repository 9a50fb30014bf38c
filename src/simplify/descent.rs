//! The search for smaller trees.
//!
//! A candidate that plays every known path alike needs no simulation and is taken first. The rest race: most are dropped
//! after an episode or a few (successive halving: Karnin, Koren and Somekh 2013), and of those that stay within the
//! loss the one that saves most nodes for its price is taken. Effort is counted in ticks, not in time.

use super::{Kept, Progress};
use crate::ir::tree::Node;
use crate::tree::Size;
use crate::tree::prune::{self, Candidate, Cost, Requirement};
use crate::trial::paired::{Contender, Trials, error, within};
use crate::trial::trace::Paths;

/// For each stage of a race, the episodes up to which its candidates play, and the most that stay in it.
const STAGES: [(usize, usize); 4] = [(1, 32), (4, 12), (16, 5), (64, 3)];
/// Episodes of a candidate before it is taken.
const EPISODES: usize = 160;
/// The most ticks of all descents together.
const BUDGET: u64 = 40_000_000;
/// The most steps of a descent.
const STEPS: usize = 200;
/// A candidate leaves a race when its mean loss exceeds the limit by this many standard errors.
const HOPELESS: f64 = 2.0;
/// The part of the limit that halves the value of a saved node.
const PRICE: f64 = 0.125;

/// A tree on a descent.
pub(super) struct Visited {
    pub(super) root: Node,
    pub(super) steps: Vec<Kept>,
    contender: Contender,
}

/// When a plainer tree of the same size is taken.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Plain {
    /// When nothing smaller is left.
    Last,
    /// As soon as it plays alike.
    Early,
}

/// A candidate in a race.
struct Entrant {
    candidate: Candidate,
    contender: Contender,
}

pub(super) struct Simplifier<'a> {
    pub(super) ticks: u64,
    trials: Trials,
    requirements: &'a [Requirement],
    loss: f64,
    progress: &'a (dyn Fn(Progress) + Sync),
}

/// What candidates are measured against.
struct Measure<'a> {
    exact: &'a Contender,
    best: &'a Contender,
    now: &'a Contender,
    /// The cost of reading the current tree, in nodes.
    nodes: usize,
    /// The greatest loss of return.
    limit: f64,
    /// The standard deviation of a return.
    spread: f64,
}

impl<'a> Simplifier<'a> {
    pub(super) fn new(
        trials: Trials,
        requirements: &'a [Requirement],
        loss: f64,
        progress: &'a (dyn Fn(Progress) + Sync),
    ) -> Self {
        Self {
            ticks: 0,
            trials,
            requirements,
            loss,
            progress,
        }
    }

    pub(super) fn into_trials(self) -> Trials {
        self.trials
    }

    /// Trees within the loss: the smallest first, of equal size the plainest, then the best.
    pub(super) fn trees(&mut self, root: &Node) -> Vec<Visited> {
        let Ok(mut exact) = self.trials.contender(root) else {
            return Vec::new();
        };
        self.ticks += self.trials.play(&mut [&mut exact], EPISODES, None);
        let start = Visited {
            root: root.clone(),
            steps: Vec::new(),
            contender: exact.clone(),
        };
        let mut visited = self.descend(&start, &exact, Plain::Last);
        visited.extend(self.descend(&start, &exact, Plain::Early));
        if let Some(flat) = self.flat(root, &exact) {
            let further = self.descend(&flat, &exact, Plain::Early);
            visited.push(flat);
            visited.extend(further);
        }
        visited.sort_by(|a, b| {
            let key = |visited: &Visited| {
                let cost = Cost::of(&visited.root, self.requirements);
                let cost = (cost.nodes, cost.unasked, cost.literals);
                (cost, prune::negated_literals(&visited.root))
            };
            let returns = |visited: &Visited| visited.contender.returns().mean;
            let better = returns(b).total_cmp(&returns(a));
            key(a).cmp(&key(b)).then(better)
        });
        visited.dedup_by(|a, b| a.root == b.root);
        visited
    }

    /// The best tree with one unit for each behaviour, if any stays within the loss.
    fn flat(&mut self, root: &Node, exact: &Contender) -> Option<Visited> {
        let candidates = prune::flat(
            root,
            self.trials.atoms(),
            &exact.decided(),
            self.requirements,
        );
        let largest = candidates
            .iter()
            .map(|candidate| candidate.cost.nodes)
            .max();
        let measure = Measure {
            exact,
            best: exact,
            now: exact,
            nodes: largest?,
            limit: self.limit(exact),
            spread: exact.spread(),
        };
        let entrants = self.entrants(candidates.into_iter());
        let Entrant {
            candidate,
            contender,
        } = self.race(entrants, &measure)?;
        Some(Visited {
            steps: vec![Kept {
                change: candidate.change,
                size: candidate.size,
                loss: contender.loss(exact),
            }],
            root: candidate.root,
            contender,
        })
    }

    /// The greatest loss, in return.
    fn limit(&self, exact: &Contender) -> f64 {
        self.loss * exact.returns().mean.abs()
    }

    /// Descends from a tree.
    fn descend(&mut self, from: &Visited, exact: &Contender, plain: Plain) -> Vec<Visited> {
        let mut visited: Vec<Visited> = Vec::new();
        let mut steps = from.steps.clone();
        let (mut now, mut root, mut best) =
            (from.contender.clone(), from.root.clone(), exact.clone());
        if now.loss(&best).ci95[1] < 0.0 {
            best = now.clone();
        }
        let mut paths = now.paths();
        while self.ticks < BUDGET && steps.len() < STEPS {
            (self.progress)(Progress {
                nodes: Size::of(&root).nodes,
                ticks: self.ticks,
                of: BUDGET,
            });
            let measure = Measure {
                exact,
                best: &best,
                now: &now,
                nodes: Cost::of(&root, self.requirements).nodes,
                limit: self.limit(exact),
                spread: exact.spread(),
            };
            let known = |c: &Candidate| !visited.iter().any(|visited| visited.root == c.root);
            let smaller = prune::candidates(&root, self.requirements).into_iter();
            let mut smaller = self.entrants(smaller.filter(known));
            let plainer = prune::plainer(&root, self.requirements).into_iter();
            let mut plainer = self.entrants(plainer.filter(known));
            let mut regained = None;
            let mut free = alike(&mut smaller, &measure, &paths);
            if free.is_none() && plain == Plain::Early {
                free = alike(&mut plainer, &measure, &paths);
            }
            let next = match free {
                Some(next) => next,
                None => {
                    let raced = self.race(smaller, &measure).or_else(|| {
                        // A plainer tree may cost what was gained on the way.
                        let next = self.race(plainer, &measure.of(exact))?;
                        regained = Some(next.contender.clone());
                        Some(next)
                    });
                    let Some(next) = raced else {
                        break;
                    };
                    paths = next.contender.paths();
                    next
                }
            };
            now = next.contender;
            root = next.candidate.root;
            if let Some(contender) = regained {
                best = contender;
            } else if now.loss(&best).ci95[1] < 0.0 {
                best = now.clone();
            }
            steps.push(Kept {
                change: next.candidate.change,
                size: next.candidate.size,
                loss: now.loss(exact),
            });
            visited.push(Visited {
                root: root.clone(),
                steps: steps.clone(),
                contender: now.clone(),
            });
        }
        visited
    }

    fn entrants(&self, candidates: impl Iterator<Item = Candidate>) -> Vec<Entrant> {
        let ready = candidates.filter_map(|candidate| {
            let contender = self.trials.contender(&candidate.root).ok()?;
            Some(Entrant {
                candidate,
                contender,
            })
        });
        ready.collect()
    }

    /// The best candidate that stays within the limit.
    fn race(&mut self, mut entrants: Vec<Entrant>, measure: &Measure) -> Option<Entrant> {
        for (episodes, stay) in STAGES {
            self.play(&mut entrants, episodes, measure.now);
            entrants.retain(|entrant| measure.hopes(entrant, episodes));
            // Stable: of equal worth, the first stays.
            entrants.sort_by(|a, b| measure.worth(b).total_cmp(&measure.worth(a)));
            entrants.truncate(stay);
        }
        self.play(&mut entrants, EPISODES, measure.now);
        entrants.sort_by(|a, b| measure.worth(b).total_cmp(&measure.worth(a)));
        entrants.into_iter().find(|entrant| measure.passes(entrant))
    }

    fn play(&mut self, entrants: &mut [Entrant], episodes: usize, now: &Contender) {
        let contenders = entrants.iter_mut().map(|entrant| &mut entrant.contender);
        let mut contenders: Vec<&mut Contender> = contenders.collect();
        self.ticks += self.trials.play(&mut contenders, episodes, Some(now));
    }
}

/// The smallest candidate that does what the current tree does on every path. It takes over the episodes of that tree.
fn alike(entrants: &mut Vec<Entrant>, measure: &Measure, paths: &Paths) -> Option<Entrant> {
    entrants.sort_by_key(|entrant| entrant.candidate.cost);
    let at = entrants
        .iter_mut()
        .position(|entrant| entrant.contender.agrees(paths))?;
    let mut found = entrants.remove(at);
    found.contender = found.contender.standing_for(measure.now);
    Some(found)
}

impl<'a> Measure<'a> {
    /// The same against another best tree.
    fn of(&self, best: &'a Contender) -> Self {
        Self { best, ..*self }
    }

    /// Whether a candidate may still come within the limit after this number of episodes.
    fn hopes(&self, entrant: &Entrant, episodes: usize) -> bool {
        [self.exact, self.best].into_iter().all(|other| {
            let loss = entrant.contender.loss(other);
            let error = error(&loss).max(self.spread / (episodes as f64).sqrt());
            loss.mean - HOPELESS * error <= self.limit && entrant.contender.ended_more(other) <= 0
        })
    }

    fn passes(&self, entrant: &Entrant) -> bool {
        let mut against = [self.exact, self.best].into_iter();
        against.all(|other| within(&entrant.contender, other, self.limit))
    }

    /// The value of a candidate: the nodes that it saves, discounted by the return that it loses against the current tree,
    /// or multiplied by what it gains.
    fn worth(&self, entrant: &Entrant) -> f64 {
        // A move that saves no node has some value, too.
        let saved = self.nodes as f64 - entrant.candidate.cost.nodes as f64 + 0.1;
        let price = (PRICE * self.limit).max(1e-9);
        let lost = entrant.contender.loss(self.now).mean / price;
        if lost <= 0.0 {
            saved * (1.0 - lost)
        } else {
            saved / (1.0 + lost)
        }
    }
}
