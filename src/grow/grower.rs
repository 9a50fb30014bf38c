//! The search: from the exact tree to smaller ones that cover it, then one change after another.

use super::bodies;
use super::cover;
use super::evidence::{Evidence, Sight, Visits};
use super::field::{Aim, Field};
use super::ground::Ground;
use super::propose::{Proposal, Proposer};
use super::race::{Entrant, Judge};
use super::step::{Climb, Cover, Halted, Refine, Step};
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
use rustc_hash::{FxHashMap, FxHashSet};
use serde::{Deserialize, Serialize};

/// The part of what there is to gain that a node must bring.
const PRICE: f64 = 0.003;
/// The most nodes of a tree that others are grown from in place of a single behaviour.
const STEM: usize = 70;
/// The most changes of a tree that the counts alone are asked for.
const STEPS: usize = 40;
/// The part of the effort after which no more is grown from the start.
const SPROUTS: f64 = 0.4;
/// Rounds of growing from the start.
const ROUNDS: usize = 2;
/// The fewest nodes of a tree that is covered by smaller ones, and the part of the effort after which no more are made.
const COVERED: usize = 20;
const COVERS: f64 = 0.25;
/// The races of the trees that cover another.
const RUNS: usize = 2;
/// The ticks of a collection, as a part of the effort.
const COLLECTED: f64 = 0.006;
/// Proposals of a round: those of which the counts promise most, others at random, and nodes with memory.
const BEST: usize = 20;
const RANDOM: usize = 20;
const MEMORIES: usize = 8;
/// The stages of climbing: the part of a node's price, and whether trees only get smaller.
const CLIMBS: [(f64, bool); 3] = [(1.0, false), (0.5, false), (1.0, true)];
/// Races without a better tree before a stage ends.
const FAILURES: usize = 3;
/// The part of the effort that is kept for choosing and measuring.
const KEPT: f64 = 0.2;
/// The prices, in parts of a node's, at which smaller trees are looked for that cost something.
const DEARER: [f64; 4] = [3.0, 10.0, 30.0, 100.0];
/// Episodes that show what a tree does, for pruning without simulation.
const SHOWN: usize = 64;
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

/// What a search found.
#[derive(Debug)]
pub struct Found<'g, 'w, W> {
    /// The judge, with the ticks that were simulated.
    pub judge: Judge<'g, 'w, W>,
    /// The trees that were the best of their time.
    pub visited: Vec<Visited>,
    /// The price of a node.
    pub price: f64,
}

/// A search.
pub struct Grower<'g, 'w, 'a, W> {
    ground: &'g Ground<'w, W>,
    judge: Judge<'g, 'w, W>,
    settings: &'g Settings<'a>,
    progress: &'g (dyn Fn(Progress) + Sync),
    evidence: Evidence,
    random: Random,
    collected: u64,
    price: f64,
    visited: Vec<Visited>,
    /// The best single behaviour.
    single: Option<Node>,
}

impl<'g, 'w, 'a, W: World> Grower<'g, 'w, 'a, W> {
    /// One that has not begun.
    pub fn new(
        ground: &'g Ground<'w, W>,
        settings: &'g Settings<'a>,
        progress: &'g (dyn Fn(Progress) + Sync),
    ) -> Self {
        Self {
            judge: Judge::new(ground),
            ground,
            settings,
            progress,
            evidence: Evidence::new(ground),
            random: Random::new(ground.seed, 1 << 41, 0),
            collected: 0,
            price: 0.0,
            visited: Vec::new(),
            single: None,
        }
    }

    /// Searches, from where a run before was stopped.
    ///
    /// # Errors
    /// The exact tree asks an atom that the world does not know.
    pub fn run(mut self, starts: &Starts, part: &Part) -> Result<Found<'g, 'w, W>, Atom> {
        let (mut base, mut step) = match part.resume::<Halted>() {
            Some(halted) => self.go_on(halted),
            None => (self.begin(starts)?, Step::Begun),
        };
        while !matches!(step, Step::Done) {
            (base, step) = match step {
                Step::Begun => self.begin_covers(base),
                Step::Cover(cover) => self.cover(base, cover),
                Step::Sprout(round) => self.sprout(base, round, starts),
                Step::Climb(climb) => self.climb(base, climb),
                Step::Refine(refine) => self.refine(base, refine),
                Step::Done => (base, Step::Done),
            };
            part.keep(|| self.halted(&base, &step));
        }
        part.save(|| self.halted(&base, &step));
        Ok(Found {
            judge: self.judge,
            visited: self.visited,
            price: self.price,
        })
    }

    /// Where the search stands.
    fn halted(&self, base: &Node, step: &Step) -> Halted {
        Halted {
            evidence: self.evidence.clone(),
            random: self.random.clone(),
            collected: self.collected,
            price: self.price,
            visited: self.visited.clone(),
            single: self.single.clone(),
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
        self.visited = halted.visited;
        self.single = halted.single;
        self.judge.seen = halted.seen;
        (halted.base, halted.step)
    }

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
        let scale = (top - least).min(top.abs().max(spread)).max(0.1 * spread);
        self.price = PRICE * scale.max(1e-6);
        let mean = |single: &Entrant| single.contender.returns().mean;
        let best = singles
            .iter()
            .reduce(|best, next| match mean(next) > mean(best) {
                true => next,
                false => best,
            });
        self.single = best.map(|best| best.root.clone());
        let pruned = self.pruned(&starts.exact, &exact);
        self.visit(&pruned);
        let others: Vec<Node> = starts
            .others
            .iter()
            .cloned()
            .chain(singles.into_iter().map(|s| s.root))
            .collect();
        let (found, _) = self.judge.race(&pruned, others, self.price);
        let base = found.map_or(pruned, |found| self.pruned(&found.root.clone(), &found));
        self.visit(&base);
        Ok(base)
    }

    /// Counts what decisions lead to under a tree.
    fn collect(&mut self, root: &Node, explore: f64) -> Visits {
        let ticks = (COLLECTED * self.settings.effort as f64) as u64;
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

    /// Whether there is anything to gain from smaller trees that decide as the base does.
    fn begin_covers(&mut self, base: Node) -> (Node, Step) {
        let nodes = Size::of(&base).nodes;
        let Some(tree) = self.single.clone().filter(|_| nodes > COVERED) else {
            return (base, Step::Sprout(0));
        };
        let mut visits = self.collect(&base, 0.05);
        add(&mut visits, self.collect(&base, 0.2));
        let cover = Cover {
            tree,
            visits,
            kept: FxHashMap::default(),
            trees: Vec::new(),
        };
        (base, Step::Cover(cover))
    }

    /// One more tree that decides as the base does where it matters, from few of its decisions to all; then a race.
    fn cover(&mut self, base: Node, mut cover: Cover) -> (Node, Step) {
        if !self.spent(COVERS) && self.covers_more(&base, &mut cover) {
            return (base, Step::Cover(cover));
        }
        (self.best_of(base, cover.trees, RUNS), Step::Sprout(0))
    }

    /// Adds a tree, if there is one more to add.
    fn covers_more(&mut self, base: &Node, cover: &mut Cover) -> bool {
        self.report(&cover.tree);
        let aim = Aim::Of(base);
        let field = Field::new(self.ground, &self.evidence, Sight::Far, &cover.visits, aim);
        let most = (cover.kept.len() / 5).max(2);
        let before = cover.kept.len();
        let missed = cover::missed(&field, &cover.tree, base, most);
        cover.kept.extend(missed);
        if cover.kept.len() == before {
            return false;
        }
        let Some(next) = cover::tree(self.ground, &cover.kept) else {
            return false;
        };
        cover.tree = next;
        if Size::of(&cover.tree).nodes * 5 > Size::of(base).nodes * 4 {
            return false;
        }
        // Where the trees before went still counts, less and less.
        cover.visits.values_mut().for_each(|weight| *weight *= 0.6);
        let met = self.collect(&cover.tree, 0.05);
        add(&mut cover.visits, met);
        if !cover.trees.contains(&cover.tree) {
            cover.trees.push(cover.tree.clone());
        }
        true
    }

    /// The best of these trees, pruned, if it is better than the base; again against what was found, so many races long.
    fn best_of(&mut self, mut base: Node, trees: Vec<Node>, races: usize) -> Node {
        for _ in 0..races {
            let others = trees.iter().filter(|tree| **tree != base).cloned();
            let (found, _) = self.judge.race(&base, others.collect(), self.price);
            let Some(found) = found else { break };
            base = self.taken(found);
        }
        base
    }

    /// Trees grown by the counts alone, from a single behaviour and from the best tree, raced; several times.
    fn sprout(&mut self, base: Node, round: usize, starts: &Starts) -> (Node, Step) {
        if round >= ROUNDS || self.spent(SPROUTS) {
            return (base, Step::Climb(Climb::default()));
        }
        self.report(&base);
        let mut visits = self.collect(&base, 0.1);
        let wider = self.collect(&base, 0.3);
        self.collect(&base, 0.8);
        if round == 0 {
            // Where the other trees go.
            for other in starts.others.iter().chain([&starts.exact]) {
                if *other != base {
                    add(&mut visits, self.collect(other, 0.1));
                }
            }
        }
        add(&mut visits, wider);
        let sight = if round.is_multiple_of(2) {
            Sight::Far
        } else {
            Sight::Learner
        };
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let aim = match round.is_multiple_of(2) {
            true => Aim::Of(&base),
            false => Aim::Best,
        };
        let field = Field::new(self.ground, &self.evidence, sight, &visits, aim);
        let mut trees: Vec<Node> = Vec::new();
        for factor in [1.0, 3.0, 1.0 / 3.0] {
            let proposer = Proposer {
                field: &field,
                bodies: &bodies,
                requirements: self.settings.requirements,
                price: self.price * factor,
            };
            let mut stems: Vec<Node> = single(&field, &bodies).into_iter().collect();
            if Size::of(&base).nodes <= STEM {
                stems.push(base.clone());
            }
            for stem in stems {
                for tree in sprouts(&proposer, stem) {
                    if !trees.contains(&tree) && tree != base {
                        trees.push(tree);
                    }
                }
            }
        }
        (self.best_of(base, trees, 1), Step::Sprout(round + 1))
    }

    /// One change, proposed by the counts and by chance, kept if a race says so.
    fn climb(&mut self, base: Node, mut climb: Climb) -> (Node, Step) {
        let Some((factor, only)) = CLIMBS.get(climb.stage) else {
            return (base, Step::Refine(Refine::default()));
        };
        if climb.failures >= FAILURES || self.spent(1.0 - KEPT) {
            return (base, Step::Climb(Climb::of(climb.stage + 1)));
        }
        self.report(&base);
        let price = self.price * factor;
        let trees = self.proposals(&base, price, *only, &mut climb.tried);
        if trees.is_empty() {
            return (base, Step::Climb(Climb::of(climb.stage + 1)));
        }
        match self.judge.race(&base, trees, price).0 {
            Some(found) => (self.taken(found), Step::Climb(Climb::of(climb.stage))),
            None => {
                climb.failures += 1;
                (base, Step::Climb(climb))
            }
        }
    }

    /// The tree that has won, pruned.
    fn taken(&mut self, found: Entrant) -> Node {
        let base = self.pruned(&found.root, &found);
        self.visit(&base);
        base
    }

    fn proposals(
        &mut self,
        base: &Node,
        price: f64,
        only: bool,
        tried: &mut FxHashSet<String>,
    ) -> Vec<Node> {
        let mut visits = self.collect(base, 0.05);
        add(&mut visits, self.collect(base, 0.3));
        let bodies = bodies::bodies(self.ground, &self.evidence);
        let sight = if self.random.chance(0.5) {
            Sight::Far
        } else {
            Sight::Learner
        };
        let aim = match self.random.chance(0.5) {
            true => Aim::Of(base),
            false => Aim::Best,
        };
        let field = Field::new(self.ground, &self.evidence, sight, &visits, aim);
        let proposer = Proposer {
            field: &field,
            bodies: &bodies,
            requirements: self.settings.requirements,
            price,
        };
        let Some(now) = field.drives(base) else {
            return Vec::new();
        };
        let mut found = proposer.prunings(base, &now);
        let mut memories = Vec::new();
        if !only {
            found.extend(proposer.insertions(base, &now));
            found.extend(proposer.changes(base, &now));
            found.extend(proposer.moves(base, &now));
            memories = proposer.memories(base);
        }
        let (best, random, memory) = if only {
            (30, 18, 0)
        } else {
            (BEST, RANDOM, MEMORIES)
        };
        let mut trees: Vec<Node> = Vec::new();
        let mut take = |proposal: Proposal| {
            let fresh = proposal.root != *base && tried.insert(format!("{:?}", proposal.root));
            if fresh {
                trees.push(proposal.root);
            }
            fresh
        };
        found.sort_by(|a, b| b.score.total_cmp(&a.score).then(a.nodes.cmp(&b.nodes)));
        let mut rest = Vec::new();
        let mut left = best;
        for proposal in found {
            if left > 0 {
                left -= usize::from(take(proposal));
            } else {
                rest.push(proposal);
            }
        }
        for (mut from, count) in [(rest, random), (memories, memory)] {
            let mut left = count;
            while left > 0 && !from.is_empty() {
                let at = self.random.below(from.len() as u64) as usize;
                left -= usize::from(take(from.swap_remove(at)));
            }
        }
        trees
    }

    /// Smaller trees that cost little, for the front.
    fn refine(&mut self, base: Node, mut refine: Refine) -> (Node, Step) {
        if !self.settings.front {
            return (base, Step::Done);
        }
        let Some(factor) = DEARER.get(refine.stage) else {
            // However few nodes are asked for, there is a tree.
            if let Some(single) = self.single.clone() {
                self.visit(&single);
            }
            return (base, Step::Done);
        };
        if !self.spent(1.0) {
            let price = self.price * factor;
            let trees = self.proposals(&base, price, true, &mut refine.tried);
            if let Some(found) = self.judge.race(&base, trees, price).0 {
                return (self.taken(found), Step::Refine(refine));
            }
        }
        (base, Step::Refine(Refine::of(refine.stage + 1)))
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

/// The body that is worth most by itself.
fn single(field: &Field, bodies: &[Node]) -> Option<Node> {
    let worth = |body: &&Node| {
        let drives = field.drives(body).unwrap_or_default();
        let spots = field.spots.iter().zip(&drives);
        spots
            .map(|(spot, drive)| spot.weight * spot.worth(*drive))
            .sum::<f64>()
    };
    let best = bodies.iter().map(|body| (worth(&body), body));
    let best = best.reduce(|best, next| if next.0 > best.0 { next } else { best });
    best.map(|(_, body)| body.clone())
}

/// The trees on the way from one tree by the change that the counts promise most of.
fn sprouts(proposer: &Proposer, stem: Node) -> Vec<Node> {
    let mut trees = vec![stem.clone()];
    let mut root = stem;
    for _ in 0..STEPS {
        let Some(now) = proposer.field.drives(&root) else {
            break;
        };
        let mut found = proposer.insertions(&root, &now);
        found.extend(proposer.prunings(&root, &now));
        let best = found.into_iter().reduce(|best, next| {
            let better =
                next.score > best.score || next.score == best.score && next.nodes < best.nodes;
            if better { next } else { best }
        });
        let Some(best) = best.filter(|best| best.score > 0.0 && !trees.contains(&best.root)) else {
            break;
        };
        root = best.root.clone();
        trees.push(best.root);
    }
    trees
}
