//! Races: trees against another on common seeds that nothing was chosen by before.

use super::ground::{self, Ground};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::learn::episode::Episode;
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::tree::Size;
use crate::trial::decisions::Taken;
use crate::trial::paired::{Contender, Trials, error};
use serde::{Deserialize, Serialize};

/// For each stage, the episodes up to which its trees play, and the most that stay after it.
const STAGES: [(usize, usize); 4] = [(2, 14), (8, 6), (24, 3), (64, 2)];
/// The episodes of the last stage where harm is dear and was met: it is rare.
const RARE: usize = 160;
/// The least effort that is not spared.
pub const ENOUGH: u64 = 1_000_000;
/// The ticks that an episode of a stage should have, on average.
const LENGTH: [u64; 2] = [1000, 2000];
/// The most by which shorter episodes are more, and the least part to which longer ones are fewer.
const SHORT: u64 = 8;
const LONG: usize = 2;
/// A tree leaves a race when its gain is below zero by this many standard errors.
const HOPELESS: f64 = 2.0;
/// Where a tree is surely better: its gain in standard errors, and the stage from which on that is said.
const CLEAR: (f64, usize) = (4.0, 2);

/// The part of its ticks in which a tree does what it has to use.
const USED: f64 = 0.03;
/// For each stage of a race without a base, the episodes up to which its trees play, and the most that stay after it.
const WITHOUT_BASE: [(usize, usize); 3] = [(2, 12), (8, 4), (24, 1)];

/// The standard errors by which a tree does surely more harm than another.
pub const SURE: f64 = 2.0;
/// A tree that returns more than another by this part of it may do more harm.
const MUCH: f64 = 0.5;

/// What an episode with harm costs, in returns.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Harm {
    /// Little, while trees are searched for: one that returns much and does harm at times is more easily mended than one
    /// that returns little.
    Cheap,
    /// More, while they are mended: where harm is dear at once, a tree that hardly acts beats one that needs a guard more.
    Middling,
    /// Much, where a tree is to be taken.
    Dear,
}

impl Harm {
    fn returns(self) -> f64 {
        match self {
            Self::Cheap => 1.0,
            Self::Middling => 4.0,
            Self::Dear => 20.0,
        }
    }
}

/// What a tree is charged for in a race.
#[derive(Clone, Copy, Debug)]
pub struct Terms {
    /// The price of a node.
    pub price: f64,
    /// What an episode with harm costs, in returns.
    pub harm: f64,
    /// A behaviour that it has to use.
    pub kept: Option<Id<Behavior>>,
}

impl Terms {
    /// With this price of a node, where harm costs so much.
    pub fn of(price: f64, harm: Harm) -> Self {
        Self {
            price,
            harm: harm.returns(),
            kept: None,
        }
    }

    /// Those of a search that goes on.
    pub fn searching(price: f64) -> Self {
        Self::of(price, Harm::Cheap)
    }

    /// Those of a search whose tree is taken.
    pub fn taking(price: f64) -> Self {
        Self::of(price, Harm::Dear)
    }

    /// Those of returns alone.
    pub fn free() -> Self {
        Self {
            price: 0.0,
            harm: 0.0,
            kept: None,
        }
    }

    /// Whether a tree has used what it has to use.
    fn allow(&self, entrant: &Entrant) -> bool {
        let used = |kept| entrant.contender.driven(kept) >= USED;
        self.kept.is_none_or(used)
    }
}

/// Trees in a race.
#[derive(Clone, Debug)]
pub struct Entrant {
    /// The tree.
    pub root: Node,
    /// Its nodes.
    pub nodes: usize,
    /// Its episodes.
    pub contender: Contender,
}

impl Entrant {
    /// What the price of harm is a part of.
    pub fn scale(&self) -> f64 {
        ground::scale(&self.contender.returns(), self.contender.episodes())
    }
}

/// What a judge has seen so far.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Seen {
    /// Ticks simulated.
    pub ticks: u64,
    /// Races held.
    races: u64,
    /// Whether harm was met in any episode.
    pub harmed: bool,
    /// The mean length of an episode.
    pub length: u64,
    /// Whether the first tree earns nothing: beside it no tree is stuck in an episode that earns nothing.
    pub idle: bool,
}

/// The judge of races.
#[derive(Debug)]
pub struct Judge<'g, 'w, W> {
    /// Where races are held.
    pub ground: &'g Ground<'w, W>,
    /// What was seen so far.
    pub seen: Seen,
    /// Whether the effort is so small that no race begins with many episodes.
    sparing: bool,
    /// The decisions of the races that are not yet counted.
    pub noted: Vec<Taken>,
}

impl<'g, 'w, W: World> Judge<'g, 'w, W> {
    /// One that has not judged, with so many ticks to spend.
    pub fn new(ground: &'g Ground<'w, W>, effort: u64) -> Self {
        Self {
            ground,
            sparing: effort < ENOUGH,
            noted: Vec::new(),
            seen: Seen {
                ticks: 0,
                races: 0,
                harmed: false,
                length: ground.start.limit,
                idle: false,
            },
        }
    }

    /// A number that no race had.
    pub fn fresh(&mut self) -> u64 {
        self.seen.races += 1;
        self.seen.races
    }

    /// A tree that has not played; `None` if it asks what the world does not know.
    pub fn entrant(&self, trials: &Trials<'_, W>, root: &Node) -> Option<Entrant> {
        Some(Entrant {
            root: root.clone(),
            nodes: Size::of(root).nodes,
            contender: trials.contender(root).ok()?,
        })
    }

    /// The episodes of a stage: more where they are short, fewer where they are long.
    pub fn scaled(&self, episodes: usize) -> usize {
        let [short, long] = LENGTH;
        let length = self.seen.length.max(1);
        let more = short.div_ceil(length).clamp(1, SHORT) as usize;
        let fewer = (episodes as u64 * long).div_ceil(length) as usize;
        (episodes * more).min(fewer.max(episodes.div_ceil(LONG)))
    }

    /// Lets trees play up to a number of episodes.
    pub fn play(
        &mut self,
        trials: &Trials<'_, W>,
        entrants: &mut [Entrant],
        episodes: usize,
        known: Option<&Entrant>,
    ) {
        let contenders = entrants.iter_mut().map(|entrant| &mut entrant.contender);
        let mut contenders: Vec<&mut Contender> = contenders.collect();
        let known = known.map(|known| &known.contender);
        let simulated = trials.play(&mut contenders, episodes, known);
        self.seen.ticks += simulated.ticks;
        self.noted.extend(simulated.taken);
        let first = entrants.first().map(|entrant| entrant.contender.length());
        let first = first.filter(|length| *length > 0);
        self.seen.length = first.unwrap_or(self.seen.length);
        let harmed = entrants.iter().any(|entrant| self.harms(entrant) > 0);
        self.seen.harmed = self.seen.harmed || harmed;
    }

    /// Lets one of these trees play up to a number of episodes; gives how many it played.
    pub fn plays_to(
        &mut self,
        trials: &Trials<'_, W>,
        entrants: &mut [Entrant],
        at: usize,
        episodes: usize,
    ) -> usize {
        let Some(entrant) = entrants.get_mut(at) else {
            return 0;
        };
        let before = entrant.contender.episodes();
        self.play(trials, std::slice::from_mut(entrant), episodes, None);
        entrant.contender.episodes() - before
    }

    /// What went wrong in a tree's episodes, those among it in which it was stuck.
    pub fn harms(&self, entrant: &Entrant) -> u64 {
        self.harms_in(entrant, entrant.contender.episodes())
    }

    /// What went wrong in the first of a tree's episodes.
    pub fn harms_in(&self, entrant: &Entrant, episodes: usize) -> u64 {
        let contender = &entrant.contender;
        if !self.seen.idle {
            return self.ground.harms(contender, episodes);
        }
        let harms = contender.each(|episode| self.ground.harm(episode));
        harms.into_iter().take(episodes).sum()
    }

    /// Whether a tree does surely more harm than another in the episodes that both have played, and does not return so much
    /// more that this one is no measure.
    pub fn is_more_harmful(&self, entrant: &Entrant, other: &Entrant) -> bool {
        let [own, theirs] = [entrant, other].map(|it| it.contender.episodes());
        let harms = [entrant, other].map(|it| self.harms_in(it, own.min(theirs)));
        let gain = self.gain(entrant, other, Terms::free()).mean;
        ground::does_more_harm(harms, SURE) && gain <= MUCH * other.contender.returns().mean.abs()
    }

    /// The harm of a tree in an episode, on average.
    fn harm_rate(&self, entrant: &Entrant) -> f64 {
        self.harms(entrant) as f64 / entrant.contender.episodes().max(1) as f64
    }

    /// The mean return of a tree less what its nodes and its harm cost, where harm is a part of `scale`.
    pub fn worth(&self, entrant: &Entrant, scale: f64, terms: Terms) -> f64 {
        let harm = terms.harm * scale * self.harm_rate(entrant);
        entrant.contender.returns().mean - harm - terms.price * entrant.nodes as f64
    }

    /// What one episode with harm costs beside a tree, on average over its episodes.
    pub fn one_harm(&self, base: &Entrant, terms: Terms) -> f64 {
        terms.harm * base.scale() / base.contender.episodes().max(1) as f64
    }

    /// The gain of a tree over another with what its nodes and its harm cost more, episode by episode.
    pub fn gain(&self, entrant: &Entrant, base: &Entrant, terms: Terms) -> Mean {
        let loss = entrant.contender.loss(&base.contender);
        let nodes = terms.price * (entrant.nodes as f64 - base.nodes as f64);
        let more = self.harm_rate(entrant) - self.harm_rate(base);
        let cost = nodes + terms.harm * base.scale() * more;
        let [low, high] = loss.ci95;
        Mean {
            mean: -loss.mean - cost,
            ci95: [-high - cost, -low - cost],
        }
    }

    fn hopes(&self, entrant: &Entrant, base: &Entrant, terms: Terms) -> bool {
        let gain = self.gain(entrant, base, terms);
        let least = base.contender.spread() / (entrant.contender.episodes() as f64).sqrt();
        gain.mean + HOPELESS * error(&gain).max(0.2 * least) > 0.0
    }

    /// The best of these trees on these terms.
    pub fn best(&mut self, trees: &[Node], terms: Terms) -> Option<Entrant> {
        let race = self.fresh();
        let trials = self.ground.trials(Purpose::Grow, race);
        let ready = trees.iter().filter_map(|root| self.entrant(&trials, root));
        let mut entrants: Vec<Entrant> = ready.collect();
        for (episodes, stay) in WITHOUT_BASE {
            let episodes = self.scaled(episodes);
            self.play(&trials, &mut entrants, episodes, None);
            entrants.retain(|entrant| terms.allow(entrant));
            let worth = |entrant: &Entrant| self.worth(entrant, entrant.scale(), terms);
            entrants.sort_by(|a, b| worth(b).total_cmp(&worth(a)));
            entrants.truncate(stay);
        }
        entrants.into_iter().next()
    }

    /// The best of these trees that is surely better than the base on these terms.
    pub fn race(&mut self, base: &Node, trees: Vec<Node>, terms: Terms) -> Option<Entrant> {
        let race = self.fresh();
        let trials = self.ground.trials(Purpose::Grow, race);
        let mut base = vec![self.entrant(&trials, base)?];
        let ready = trees.iter().filter_map(|root| self.entrant(&trials, root));
        let mut entrants: Vec<Entrant> = ready.collect();
        let mut stages = STAGES.to_vec();
        let cheap = terms.harm <= Harm::Cheap.returns();
        if self.seen.harmed && !cheap {
            stages.push((RARE, 2));
        }
        // A tree that races alone is not sent away after a few episodes.
        if let ([_], Some(last), false) = (entrants.as_slice(), stages.last(), self.sparing) {
            stages = vec![*last];
        }
        for (stage, (episodes, stay)) in stages.into_iter().enumerate() {
            let episodes = self.scaled(episodes);
            self.play(&trials, &mut base, episodes, None);
            let base = base.first()?;
            self.heat(&trials, base, &mut entrants, (episodes, stay), terms);
            let first = entrants.first()?;
            let (errors, from) = CLEAR;
            let gain = self.gain(first, base, terms);
            if cheap && stage >= from && gain.mean > errors * error(&gain) {
                break;
            }
        }
        let base = base.pop()?;
        self.winner(entrants, &base, terms)
    }

    /// Lets trees play up to a number of episodes beside a base that has played them. Of those that may still be better than it, the
    /// best stay, the best first.
    pub fn heat(
        &mut self,
        trials: &Trials<'_, W>,
        base: &Entrant,
        entrants: &mut Vec<Entrant>,
        (episodes, stay): (usize, usize),
        terms: Terms,
    ) {
        self.play(trials, entrants, episodes, Some(base));
        entrants.retain(|entrant| self.hopes(entrant, base, terms) && terms.allow(entrant));
        let gain = |entrant: &Entrant| self.gain(entrant, base, terms).mean;
        entrants.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
        entrants.truncate(stay);
    }

    /// The first of these trees that is surely better than the base.
    pub fn winner(&self, entrants: Vec<Entrant>, base: &Entrant, terms: Terms) -> Option<Entrant> {
        entrants.into_iter().find(|entrant| {
            let gain = self.gain(entrant, base, terms);
            gain.mean > error(&gain)
        })
    }

    /// The gain of each tree over a base, as far as some of its episodes tell: those of the first kind, in which it did harm, and others.
    /// Only the trees that do less harm in the first are given.
    pub fn spared(
        &mut self,
        trials: &Trials<'_, W>,
        entrants: Vec<Entrant>,
        (base, [harmed, others]): (&Entrant, [&[usize]; 2]),
        terms: Terms,
    ) -> Vec<(f64, Entrant)> {
        let contenders = entrants.iter().map(|entrant| &entrant.contender);
        let contenders: Vec<&Contender> = contenders.collect();
        let episodes = [harmed, others].concat();
        let (figures, simulated) = trials.sample(&contenders, &episodes, &base.contender);
        self.seen.ticks += simulated.ticks;
        self.noted.extend(simulated.taken);
        let cost = terms.harm * base.scale();
        let rate = self.harm_rate(base).min(1.0);
        // The mean worth of these episodes, and the harm in them.
        let sums = |figures: &[Episode]| {
            let harms: u64 = figures.iter().map(|it| self.ground.harm(it)).sum();
            let returns: f64 = figures.iter().map(|it| it.total).sum();
            let worth = (returns - cost * harms as f64) / figures.len().max(1) as f64;
            (worth, harms)
        };
        let halves = |figures: &[Episode]| {
            let (bad, good) = figures.split_at(harmed.len().min(figures.len()));
            let ((bad, harms), (good, _)) = (sums(bad), sums(good));
            (rate * bad + (1.0 - rate) * good, harms)
        };
        let all = base.contender.results();
        let own = episodes.iter().filter_map(|n| all.get(*n).cloned());
        let (worth, before) = halves(&own.collect::<Vec<_>>());
        let played = entrants.into_iter().zip(&figures);
        played
            .filter_map(|(entrant, figures)| {
                let (better, harms) = halves(figures);
                let nodes = entrant.nodes as f64 - base.nodes as f64;
                (harms < before).then_some((better - worth - terms.price * nodes, entrant))
            })
            .collect()
    }
}
