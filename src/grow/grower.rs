//! The search: from the exact tree to smaller ones that cover it, then one change after another.

mod attempts;
mod climb;
mod covers;
mod detours;
mod mend;
mod rows;
mod sprouts;

use super::evidence::{Evidence, Visits};
use super::ground::Ground;
use super::race::{Entrant, Judge, Terms};
use super::step::{Attempts, Halted, Step};
use super::{Progress, Settings, Starts};
use crate::checkpoint::Part;
use crate::ir::tree::{Atom, Node};
use crate::learn::process::{Key, World};
use crate::learn::simulated::Purpose;
use crate::random::Random;
use crate::tree::prune;
use crate::tree::{Runner, Size};
use crate::trial::play::Ticked;
use crate::trial::trace::Paths;
use crate::world::Start;
use serde::{Deserialize, Serialize};

/// The part of what there is to gain that a node must bring.
const PRICE: f64 = 0.003;
/// The ticks of a collection, as a part of the effort.
const COLLECTED: f64 = 0.006;
/// Episodes that show what a tree does, for pruning without simulation.
const SHOWN: usize = 64;
/// What rounding may change of a mean return, as a part of it.
const ROUNDED: f64 = 1e-9;
/// The most nodes of a tree that is pruned so.
const PRUNED: usize = 120;

/// A tree that was the best of its time.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Visited {
    /// The tree.
    pub root: Node,
    /// Its nodes.
    pub nodes: usize,
}

/// A search.
pub struct Grower<'g, 'w, 'a, W> {
    ground: &'g Ground<'w, W>,
    /// The judge, with the ticks that were simulated.
    pub judge: Judge<'g, 'w, W>,
    settings: &'g Settings<'a>,
    progress: &'g (dyn Fn(Progress) + Sync),
    evidence: Evidence,
    random: Random,
    collected: u64,
    /// The price of a node while trees change.
    price: f64,
    /// Its price where trees only get smaller and where one is taken.
    pub full_price: f64,
    /// What the price of harm is a part of.
    scale: f64,
    /// The trees that were the best of their time.
    pub visited: Vec<Visited>,
    /// The best single behaviour.
    single: Option<Node>,
    attempts: Attempts,
}

impl<'g, 'w, 'a, W: World> Grower<'g, 'w, 'a, W> {
    /// One that has not begun.
    pub fn new(
        ground: &'g Ground<'w, W>,
        settings: &'g Settings<'a>,
        progress: &'g (dyn Fn(Progress) + Sync),
    ) -> Self {
        Self {
            judge: Judge::new(ground, settings.effort),
            ground,
            settings,
            progress,
            evidence: Evidence::new(ground),
            random: Random::new(ground.seed, 1 << 41, 0),
            collected: 0,
            price: 0.0,
            full_price: 0.0,
            scale: 0.0,
            visited: Vec::new(),
            single: None,
            attempts: Attempts::default(),
        }
    }

    /// Searches, from where a run before was stopped; gives the tree that it ends with.
    ///
    /// # Errors
    /// The exact tree asks an atom that the world does not know.
    pub fn run(&mut self, starts: &Starts, part: &Part) -> Result<Node, Atom> {
        let (mut base, mut step) = match part.resume::<Halted>() {
            Some(halted) => self.go_on(halted),
            None => {
                let first = self.begin(starts)?;
                self.attempt(first)
            }
        };
        while !matches!(step, Step::Done) {
            (base, step) = match step {
                Step::Begun => self.begin_covers(base),
                Step::Cover(cover) => self.cover(base, cover),
                Step::Sprout(round) => self.sprout(base, round, starts),
                Step::Climb(stage) => self.climb(base, stage),
                Step::Attempted => self.again(base, &starts.exact),
                Step::Detour(detour) => self.detour(base, detour),
                Step::Refine(stage) => self.refine(base, stage),
                Step::Done => (base, Step::Done),
            };
            self.count_noted();
            part.keep(|| self.halted(&base, &step));
        }
        part.save(|| self.halted(&base, &step));
        Ok(base)
    }

    /// Counts what the races have shown.
    fn count_noted(&mut self) {
        self.evidence.count_all(&self.judge.noted);
        self.judge.noted.clear();
    }

    /// Where the search stands.
    fn halted(&self, base: &Node, step: &Step) -> Halted {
        Halted {
            evidence: self.evidence.clone(),
            random: self.random.clone(),
            collected: self.collected,
            price: self.price,
            full_price: self.full_price,
            scale: self.scale,
            visited: self.visited.clone(),
            single: self.single.clone(),
            attempts: self.attempts.clone(),
            seen: self.judge.seen,
            base: base.clone(),
            step: step.clone(),
        }
    }

    fn go_on(&mut self, halted: Halted) -> (Node, Step) {
        self.evidence = halted.evidence;
        self.random = halted.random;
        self.collected = halted.collected;
        self.price = halted.price;
        self.full_price = halted.full_price;
        self.scale = halted.scale;
        self.visited = halted.visited;
        self.single = halted.single;
        self.attempts = halted.attempts;
        self.judge.seen = halted.seen;
        (halted.base, halted.step)
    }

    /// Whether so much of the effort is spent.
    fn spent(&self, part: f64) -> bool {
        self.judge.seen.ticks as f64 >= part * self.settings.effort as f64
    }

    fn report(&self, root: &Node) {
        (self.progress)(Progress {
            nodes: Size::of(root).nodes,
            ticks: self.judge.seen.ticks,
            of: self.settings.effort,
        });
    }

    fn visit(&mut self, root: &Node) {
        self.visited.push(Visited {
            root: root.clone(),
            nodes: Size::of(root).nodes,
        });
    }

    /// The best of the trees to start from, and the price of a node.
    fn begin(&mut self, starts: &Starts) -> Result<Node, Atom> {
        let race = self.judge.fresh();
        let trials = self.ground.trials(Purpose::Grow, race);
        let singles = self.ground.choices.iter().map(|id| Node::Behavior(*id));
        let mut singles: Vec<Entrant> = singles
            .filter_map(|root| self.judge.entrant(&trials, &root))
            .collect();
        let mut exact = vec![Entrant {
            root: starts.exact.clone(),
            nodes: Size::of(&starts.exact).nodes,
            contender: trials.contender(&starts.exact)?,
        }];
        self.judge.play(&trials, &mut exact, 8, None);
        let episodes = self.judge.scaled(8);
        self.judge
            .play(&trials, &mut exact, self.judge.scaled(SHOWN), None);
        self.judge.play(&trials, &mut singles, episodes, None);
        let Some(exact) = exact.pop() else {
            return Ok(starts.exact.clone());
        };
        let top = exact.contender.returns().mean;
        let spread = exact.contender.spread();
        let means = singles.iter().map(|single| single.contender.returns().mean);
        let least = means.fold(f64::NEG_INFINITY, f64::max);
        self.judge.seen.idle = spread == 0.0 && (top - least).abs() <= ROUNDED * top.abs();
        let rows = match self.judge.seen.idle {
            true => self.rows(),
            false => Vec::new(),
        };
        let scale = (top - least).min(top.abs().max(spread)).max(0.1 * spread);
        self.price = PRICE * scale.max(1e-6);
        self.full_price = self.price;
        self.scale = exact.scale();
        let mean = |single: &Entrant| single.contender.returns().mean;
        let best = singles
            .iter()
            .reduce(|best, next| match mean(next) > mean(best) {
                true => next,
                false => best,
            });
        self.single = best.map(|best| best.root.clone());
        let theirs = starts.others.iter().map(|(_, other)| other);
        let theirs = theirs.chain(&starts.found);
        let theirs = theirs.filter_map(|other| self.judge.entrant(&trials, other));
        let mut theirs: Vec<Entrant> = theirs.collect();
        let shown = self.judge.scaled(SHOWN);
        self.judge.play(&trials, &mut theirs, shown, Some(&exact));
        // What would not be taken in the end leads to more of its kind.
        theirs.retain(|it| !self.judge.is_more_harmful(it, &exact));
        let theirs: Vec<Node> = theirs.into_iter().map(|it| it.root).collect();
        self.attempts.theirs.clone_from(&theirs);
        let pruned = self.pruned(&starts.exact, &exact);
        self.visit(&pruned);
        let others: Vec<Node> = theirs
            .iter()
            .cloned()
            .chain(singles.into_iter().map(|s| s.root))
            .chain(rows)
            .collect();
        let terms = Terms::searching(self.price);
        let found = self.judge.race(&pruned, others, terms);
        let base = match found {
            Some(found) => self.pruned(&found.root, &found),
            None => pruned.clone(),
        };
        let theirs = match theirs.as_slice() {
            [only] => Some(only.clone()),
            _ => self.judge.best(&theirs, terms).map(|best| best.root),
        };
        let others = [Some(pruned), theirs].into_iter().flatten();
        let others = others.filter(|other| *other != base);
        self.attempts.starts = std::iter::once(base.clone()).chain(others).collect();
        self.visit(&base);
        Ok(base)
    }

    /// Counts what decisions lead to under a tree.
    fn collect(&mut self, root: &Node, explore: f64) -> Visits {
        let ticks = (COLLECTED * self.share()) as u64;
        self.collected += 1;
        let at = if explore >= 0.5 {
            self.ground.exploring
        } else {
            self.ground.start
        };
        let start = Start {
            seed: self.ground.seed,
            stream: Purpose::Count as u64,
            episode: self.collected << 20,
            ..at
        };
        let Ok(runner) = Runner::new(root, self.ground.world.atoms()) else {
            return Visits::default();
        };
        let (visits, used) =
            self.evidence
                .collect(self.ground, &Ticked(runner), (explore, start), ticks);
        self.judge.seen.ticks += used;
        visits
    }

    /// The best of these trees, pruned, if it is better than the base; again against what was found, so many races long.
    fn best_of(&mut self, mut base: Node, trees: Vec<Node>, races: usize) -> Node {
        for _ in 0..races {
            let others = trees.iter().filter(|tree| **tree != base).cloned();
            let terms = Terms::searching(self.price);
            let Some(found) = self.judge.race(&base, others.collect(), terms) else {
                break;
            };
            base = self.taken(found);
        }
        base
    }

    /// The tree that has won, pruned.
    fn taken(&mut self, found: Entrant) -> Node {
        let base = self.pruned(&found.root, &found);
        self.scale = found.scale();
        self.visit(&base);
        base
    }

    /// Lets the counts charge for harm what the races do in which a tree is taken.
    fn charge(&mut self, terms: Terms) {
        self.evidence.charge(terms.harm * self.scale);
    }

    /// The tree without what it never showed in its episodes: it plays them alike.
    fn pruned(&self, root: &Node, shown: &Entrant) -> Node {
        if Size::of(root).nodes > PRUNED {
            return root.clone();
        }
        let paths = shown.contender.paths();
        let mut root = root.clone();
        while let Some(smaller) = self.alike(&root, &paths) {
            root = smaller;
        }
        root
    }

    fn alike(&self, root: &Node, paths: &Paths) -> Option<Node> {
        let requirements = self.settings.requirements;
        let mut candidates = prune::candidates(root, requirements);
        candidates.extend(prune::plainer(root, requirements));
        candidates.sort_by_key(|candidate| candidate.size.nodes);
        let trials = self.ground.trials(Purpose::Grow, 0);
        candidates.into_iter().find_map(|candidate| {
            let mut contender = trials.contender(&candidate.root).ok()?;
            contender.agrees(paths).then_some(candidate.root)
        })
    }
}

fn add(visits: &mut Visits, other: Visits) {
    let mut other: Vec<(Key, f64)> = other.into_iter().collect();
    other.sort_by_key(|(key, _)| *key);
    for (key, count) in other {
        *visits.entry(key).or_default() += count;
    }
}
