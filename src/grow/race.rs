//! Races: trees against another on common seeds that nothing was chosen by before.

use super::ground::Ground;
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::tree::Size;
use crate::trial::paired::{Contender, Trials, error};
use serde::{Deserialize, Serialize};

/// For each stage, the episodes up to which its trees play, and the most that stay after it.
const STAGES: [(usize, usize); 4] = [(2, 14), (8, 6), (24, 3), (64, 2)];
/// The episodes of the last stage where ends that cost were met: they are rare and dear.
const RARE: usize = 160;
/// The ticks that an episode of a stage should have at least, on average.
const LENGTH: u64 = 1000;
/// A tree leaves a race when its gain is below zero by this many standard errors.
const HOPELESS: f64 = 2.0;
/// The standard errors by which harm is more than chance.
const CERTAIN: f64 = 1.7;
/// The part of the return that a tree may lose where it avoids harm.
pub const RANSOM: f64 = 0.05;

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

/// What a judge has seen so far.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Seen {
    /// Ticks simulated.
    pub ticks: u64,
    /// Races held.
    races: u64,
    /// Whether harm was met in any episode.
    harmed: bool,
    /// The mean length of an episode.
    length: u64,
}

/// The judge of races.
#[derive(Debug)]
pub struct Judge<'g, 'w, W> {
    /// Where races are held.
    pub ground: &'g Ground<'w, W>,
    /// What was seen so far.
    pub seen: Seen,
}

impl<'g, 'w, W: World> Judge<'g, 'w, W> {
    /// One that has not judged.
    pub fn new(ground: &'g Ground<'w, W>) -> Self {
        Self {
            ground,
            seen: Seen {
                ticks: 0,
                races: 0,
                harmed: false,
                length: ground.start.limit,
            },
        }
    }

    /// A number that no race had.
    pub fn fresh(&mut self) -> u64 {
        self.seen.races += 1;
        self.seen.races
    }

    /// A tree that has not played; `None` if it asks what the world does not know.
    pub fn entrant(&self, trials: &Trials<'w, W>, root: &Node) -> Option<Entrant> {
        Some(Entrant {
            root: root.clone(),
            nodes: Size::of(root).nodes,
            contender: trials.contender(root).ok()?,
        })
    }

    /// The episodes of a stage: more where they are short.
    pub fn scaled(&self, episodes: usize) -> usize {
        let factor = LENGTH.div_ceil(self.seen.length.max(1)).clamp(1, 8);
        episodes * factor as usize
    }

    /// Lets trees play up to a number of episodes.
    pub fn play(
        &mut self,
        trials: &Trials<'w, W>,
        entrants: &mut [Entrant],
        episodes: usize,
        known: Option<&Entrant>,
    ) {
        let contenders = entrants.iter_mut().map(|entrant| &mut entrant.contender);
        let mut contenders: Vec<&mut Contender> = contenders.collect();
        let known = known.map(|known| &known.contender);
        self.seen.ticks += trials.play(&mut contenders, episodes, known);
        let first = entrants.first().map(|entrant| entrant.contender.length());
        let first = first.filter(|length| *length > 0);
        self.seen.length = first.unwrap_or(self.seen.length);
        let harmed = entrants.iter().any(|entrant| self.harms(entrant) > 0);
        self.seen.harmed = self.seen.harmed || harmed;
    }

    /// What went wrong in a tree's episodes.
    pub fn harms(&self, entrant: &Entrant) -> u64 {
        let harms = entrant.contender.each(|episode| self.ground.harm(episode));
        harms.into_iter().sum()
    }

    /// The gain of a tree over another with what its nodes cost more, episode by episode.
    fn gain(&self, entrant: &Entrant, base: &Entrant, price: f64) -> Mean {
        let loss = entrant.contender.loss(&base.contender);
        let cost = price * (entrant.nodes as f64 - base.nodes as f64);
        let [low, high] = loss.ci95;
        Mean {
            mean: -loss.mean - cost,
            ci95: [-high - cost, -low - cost],
        }
    }

    /// How many more harms a tree met than another, and the standard error of the difference.
    fn harm(&self, entrant: &Entrant, base: &Entrant) -> (f64, f64) {
        let own = entrant.contender.each(|episode| self.ground.harm(episode));
        let other = base.contender.each(|episode| self.ground.harm(episode));
        let pairs = own.into_iter().zip(other);
        let differences: Vec<f64> = pairs
            .map(|(own, other)| own as f64 - other as f64)
            .collect();
        let more = differences.iter().sum();
        let squares: f64 = differences.iter().map(|d| d * d).sum();
        (more, squares.sqrt())
    }

    /// Whether a tree is better than another: less harm, or else more return for its nodes.
    pub fn better(&self, entrant: &Entrant, base: &Entrant, price: f64) -> bool {
        let (more, doubt) = self.harm(entrant, base);
        if more > 0.0 && (more >= doubt || self.harms(base) == 0) {
            return false;
        }
        let gain = self.gain(entrant, base, price);
        if more < 0.0 && -more >= 2.0 * doubt {
            let loss = entrant.contender.loss(&base.contender);
            return loss.mean <= RANSOM * base.contender.returns().mean.abs();
        }
        gain.mean > error(&gain)
    }

    /// Orders trees that have played alike long: those that surely do more harm than others come last, the others by
    /// what they are worth.
    pub fn order(&self, entrants: &mut [Entrant], worth: impl Fn(&Entrant) -> f64) {
        let least = entrants.iter().map(|entrant| self.harms(entrant)).min();
        let certain = |entrant: &Entrant| is_more(self.harms(entrant), least.unwrap_or(0));
        entrants.sort_by(|a, b| {
            let safer = certain(a).cmp(&certain(b));
            safer.then(worth(b).total_cmp(&worth(a)))
        });
    }

    fn hopes(&self, entrant: &Entrant, base: &Entrant, price: f64) -> bool {
        let (more, doubt) = self.harm(entrant, base);
        if more > 2.0 * doubt {
            return false;
        }
        let gain = self.gain(entrant, base, price);
        let least = base.contender.spread() / (entrant.contender.episodes() as f64).sqrt();
        (more < 0.0 && -more >= doubt) || gain.mean + HOPELESS * error(&gain).max(0.2 * least) > 0.0
    }

    /// The best of these trees that is better than the base, at a price for each node, and the base as it played.
    pub fn race(
        &mut self,
        base: &Node,
        trees: Vec<Node>,
        price: f64,
    ) -> (Option<Entrant>, Option<Entrant>) {
        let race = self.fresh();
        let trials = self.ground.trials(Purpose::Grow, race);
        let Some(base) = self.entrant(&trials, base) else {
            return (None, None);
        };
        let mut base = vec![base];
        let ready = trees.iter().filter_map(|root| self.entrant(&trials, root));
        let mut entrants: Vec<Entrant> = ready.collect();
        let mut stages = STAGES.to_vec();
        if self.seen.harmed {
            stages.push((RARE, 2));
        }
        for (episodes, stay) in stages {
            let episodes = self.scaled(episodes);
            self.play(&trials, &mut base, episodes, None);
            let Some(base) = base.first() else { break };
            self.play(&trials, &mut entrants, episodes, Some(base));
            entrants.retain(|entrant| self.hopes(entrant, base, price));
            self.order(&mut entrants, |entrant| {
                self.gain(entrant, base, price).mean
            });
            entrants.truncate(stay);
            if entrants.is_empty() {
                break;
            }
        }
        let base = base.pop();
        let found = base.as_ref().and_then(|base| {
            let mut entrants = entrants.into_iter();
            entrants.find(|entrant| self.better(entrant, base, price))
        });
        (found, base)
    }
}

/// Whether harm is more than other harm in as many episodes, and not by chance.
pub fn is_more(harms: u64, others: u64) -> bool {
    let more = harms.saturating_sub(others) as f64;
    more > CERTAIN * ((harms + others) as f64).sqrt()
}
