//! The trees that none beats in both nodes and return, and the one of them that is taken.

use super::alone::plainest;
use super::ground::does_more_harm;
use super::grower::{Grower, Visited};
use super::race::{Entrant, Judge, SURE, Terms};
use super::reader;
use super::tested::{self, Beside, Figures};
use super::trim::trimmed;
use super::{Settings, Starts};
use crate::ir::tree::{Atom, Node};
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::math;
use crate::tree::Size;
use crate::tree::prune::asked_once;
use crate::trial::paired::{Trials, error};
use serde::{Deserialize, Serialize};

/// For each stage of the choice, the episodes up to which its trees play, and the most that stay after it.
const STAGES: [(usize, usize); 3] = [(60, 7), (160, 3), (500, 3)];
/// The episodes of the tree that was chosen, before it is taken: in fewer, what seldom goes wrong does not show.
const VETTED: usize = 1500;
/// The most trees that are looked at of those that were found, and of smaller ones.
const LOOKED_AT: usize = 12;
/// Fresh episodes that measure the tree that was chosen.
const FRESH: usize = 500;
/// The episodes that say which of the other trees the grown one is compared with.
const COMPARED: usize = 60;
/// The episodes of each tree of a front that is shown.
const DRAWN: usize = 160;
/// The effort that these numbers are for; for less of it they are less.
const WHOLE: f64 = 36e6;
/// The fewest episodes, whatever the effort.
const FEWEST: usize = 40;
/// A tree that is proved gives way to one that is only tested for a gain of so many prices of a node.
const PROVED: f64 = 3.4;

/// What a tree may return less than one with at least so many times its nodes, as a part of what that returns. With more of them
/// it may return less by the price of those that it has not, but by no more than this.
const LESS: (usize, f64) = (2, 0.015);

/// Which tree of the front is wanted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Choice {
    /// The one from where on a node more brings less than its price.
    Knee,
    /// The best of at most so many nodes.
    Nodes(usize),
    /// The smallest that loses at most this part of the return of the best.
    Loss(f64),
}

/// A tree of the front.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The tree.
    pub root: Node,
    /// Its size.
    pub size: Size,
    /// Its return.
    pub returns: Mean,
    /// Harms.
    pub harms: u64,
    /// Of so many episodes.
    pub episodes: u64,
    /// Whether it is the one that was taken.
    pub taken: bool,
}

/// A grown tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Grown {
    /// The tree; the exact one if none was better.
    pub root: Node,
    /// The exact tree on fresh seeds.
    pub before: Figures,
    /// This tree on the same seeds.
    pub after: Figures,
    /// Its mean gain of return an episode over the exact tree on these seeds, paired.
    pub gain: Mean,
    /// The best of the other trees that the search began with, if there were any.
    pub beside: Option<Beside>,
    /// Whether this is the exact tree.
    pub kept: bool,
    /// The minterms of the policy in which it selects the same as the exact tree, and all of them. What a memory node goes on
    /// with is read from the history.
    pub alike: [usize; 2],
    /// The front, the smallest tree first.
    pub front: Vec<Point>,
    /// Ticks that the search simulated.
    pub ticks: u64,
}

impl Grown {
    /// Whether the exact tree was kept.
    pub fn is_exact(&self) -> bool {
        self.kept
    }
}

/// Chooses a tree among those that were the best of their time.
///
/// # Errors
/// The exact tree asks an atom that the world does not know.
pub(super) fn choose<W: World>(
    grower: &mut Grower<'_, '_, '_, W>,
    trees: Vec<Node>,
    starts: &Starts,
    settings: &Settings,
) -> Result<Grown, Atom> {
    let price = grower.full_price;
    let judge = &mut grower.judge;
    let of = episodes(settings);
    let race = judge.fresh();
    let trials = judge.ground.trials(Purpose::Confirm, race);
    let mut entrants = confirmed((judge, &trials), trees, starts, &of, settings, price)?;
    let exact = entrants.len().saturating_sub(1);
    let theirs = starts.others.iter().map(|(_, other)| other);
    let theirs: Vec<&Node> = theirs.collect();
    let vetted = judge.scaled(of(VETTED));
    let ended = entrants.last().map_or(0, |it| it.contender.episodes());
    let chosen = loop {
        let Some(known) = known(judge, &entrants, (exact, &theirs), ended) else {
            break exact;
        };
        let chosen = chosen(judge, &entrants, &known, settings.choice, price);
        let by = (&mut *judge, &trials);
        let goes_on = match settings.choice {
            _ if chosen == exact || chosen == known.best => {
                plays_next(by, &mut entrants, &known, price)
            }
            Choice::Knee => is_doubted(by, &mut entrants, [chosen, known.best], vetted),
            Choice::Nodes(_) | Choice::Loss(_) => false,
        };
        if !goes_on {
            break chosen;
        }
    };
    for entrant in entrants.iter_mut().take(exact) {
        entrant.root = asked_once(&entrant.root);
        entrant.nodes = Size::of(&entrant.root).nodes;
    }
    let harms = |entrant: &Entrant| judge.harms(entrant);
    let mut front = points(&entrants, chosen, &harms);
    let taken = (chosen < entrants.len()).then(|| entrants.swap_remove(chosen));
    drop(entrants);
    let root = match taken.filter(|taken| taken.root != starts.exact) {
        None => starts.exact.clone(),
        Some(taken) => {
            let root = trimmed(judge, &trials, (taken, settings.requirements), vetted);
            plainest(judge, &trials, root, judge.scaled(of(FRESH)))
        }
    };
    for point in front.iter_mut().filter(|point| point.taken) {
        point.size = Size::of(&root);
        point.root = root.clone();
    }
    let episodes = [COMPARED, FRESH].map(|episodes| judge.scaled(of(episodes)));
    let tested = tested::test(judge, starts, &root, episodes)?;
    Ok(Grown {
        before: tested.before,
        after: tested.after,
        gain: tested.gain,
        beside: tested.beside,
        kept: root == starts.exact,
        alike: [
            reader::alike(judge.ground, [&root, &starts.exact], &starts.minterms),
            starts.minterms.len(),
        ],
        root,
        front,
        ticks: judge.seen.ticks,
    })
}

/// So many episodes for the effort.
fn episodes(settings: &Settings) -> impl Fn(usize) -> usize + use<> {
    let part = (settings.effort as f64 / WHOLE).min(1.0);
    move |episodes| ((episodes as f64 * part) as usize).max(FEWEST)
}

/// The front around the tree that was chosen, all of whose trees play alike long.
pub(super) fn drawn<W: World>(
    grower: &mut Grower<'_, '_, '_, W>,
    mut trees: Vec<Node>,
    starts: &Starts,
    settings: &Settings,
    root: &Node,
) -> Vec<Point> {
    for tree in &mut trees {
        *tree = asked_once(tree);
    }
    for tree in [&starts.exact, root] {
        if !trees.contains(tree) {
            trees.push(tree.clone());
        }
    }
    let judge = &mut grower.judge;
    let race = judge.fresh();
    let trials = judge.ground.trials(Purpose::Confirm, race);
    let entrants = trees.iter().filter_map(|root| judge.entrant(&trials, root));
    let mut entrants: Vec<Entrant> = entrants.collect();
    let episodes = judge.scaled(episodes(settings)(DRAWN));
    judge.play(&trials, &mut entrants, episodes, None);
    let chosen = entrants.iter().position(|entrant| entrant.root == *root);
    points(&entrants, chosen.unwrap_or(entrants.len()), &|entrant| {
        judge.harms(entrant)
    })
}

/// The trees that are looked at: those of the file, and of those that were found, and then of the smaller ones that cost
/// something, the later ones, which are the better ones; of the same size the last.
pub(super) fn candidates((found, shrunk): (&[Visited], &[Visited]), starts: &Starts) -> Vec<Node> {
    let mut trees: Vec<Node> = Vec::new();
    let mut sizes: Vec<usize> = Vec::new();
    for visited in [found, shrunk] {
        let most = trees.len() + LOOKED_AT;
        for tree in visited.iter().rev() {
            if !sizes.contains(&tree.nodes) && trees.len() < most {
                sizes.push(tree.nodes);
                trees.push(tree.root.clone());
            }
        }
    }
    let others = starts.others.iter().map(|(_, other)| other);
    for other in others.chain(&starts.found) {
        if !trees.contains(other) {
            trees.push(other.clone());
        }
    }
    trees
}

/// The trees with episodes that none was chosen by, the exact one last. The best play longest, where the best is wanted.
fn confirmed<W: World>(
    (judge, trials): (&mut Judge<'_, '_, W>, &Trials<'_, W>),
    trees: Vec<Node>,
    starts: &Starts,
    of: &impl Fn(usize) -> usize,
    settings: &Settings,
    price: f64,
) -> Result<Vec<Entrant>, Atom> {
    let mut exact = vec![Entrant {
        root: starts.exact.clone(),
        nodes: Size::of(&starts.exact).nodes,
        contender: trials.contender(&starts.exact)?,
    }];
    let others = trees.iter().filter(|root| **root != starts.exact);
    let mut entrants: Vec<Entrant> = others
        .filter_map(|root| judge.entrant(trials, root))
        .collect();
    let halves = settings.choice == Choice::Knee;
    let stages = STAGES.len() - usize::from(!halves);
    let mut out: Vec<Entrant> = Vec::new();
    let is_theirs = |entrant: &&Entrant| starts.others.iter().any(|(_, it)| *it == entrant.root);
    for (episodes, stay) in STAGES.into_iter().take(stages) {
        let episodes = judge.scaled(of(episodes));
        judge.play(trials, &mut exact, episodes, None);
        judge.play(trials, &mut entrants, episodes, exact.first());
        if halves {
            let known = exact.iter().chain(entrants.iter().filter(is_theirs));
            let mean = |entrant: &Entrant| entrant.contender.returns().mean;
            let best = known.reduce(|best, next| if mean(next) > mean(best) { next } else { best });
            let Some(best) = best.cloned() else { break };
            let terms = Terms::taking(price);
            let gain = |entrant: &Entrant| judge.gain(entrant, &best, terms).mean;
            entrants.sort_by(|a, b| gain(b).total_cmp(&gain(a)));
            // The best tree of the file is what others are held against.
            let leave = entrants.split_off(stay.min(entrants.len()));
            let is_best = |entrant: &Entrant| entrant.root == best.root;
            let (stays, leave): (Vec<_>, Vec<_>) = leave.into_iter().partition(is_best);
            entrants.extend(stays);
            out.extend(leave);
        }
    }
    entrants.extend(out);
    entrants.extend(exact);
    Ok(entrants)
}

/// Lets the best of the trees that left early play to the end, if it looks better than the best that was known before. Harm
/// that is rare shows late, so those that stayed longest may all have turned out to do more of it.
fn plays_next<W: World>(
    (judge, trials): (&mut Judge<'_, '_, W>, &Trials<'_, W>),
    entrants: &mut [Entrant],
    known: &Known,
    price: f64,
) -> bool {
    let Some(base) = entrants.get(known.best) else {
        return false;
    };
    let gains = entrants.iter().enumerate().filter_map(|(at, entrant)| {
        let gain = judge.gain(entrant, base, Terms::taking(price)).mean;
        let waits = entrant.contender.episodes() < known.ended && gain > 0.0;
        waits.then_some((gain, at))
    });
    let next = gains.reduce(|best, next| if next.0 > best.0 { next } else { best });
    next.is_some_and(|(_, at)| judge.plays_to(trials, entrants, at, known.ended) > 0)
}

/// What was there before the search.
struct Known {
    /// The place of the exact tree, the last one.
    exact: usize,
    /// That of the best tree where harm is dear: the exact one, or one of the file.
    best: usize,
    /// The episodes of all that did not leave early.
    ended: usize,
    /// The least harm in them, of the exact tree or of one of the file that returns as much; and that of the best tree.
    harms: [u64; 2],
}

/// What the exact tree and those of the file do in so many episodes; `None` if there is no exact one.
fn known<W: World>(
    judge: &Judge<'_, '_, W>,
    entrants: &[Entrant],
    (exact, theirs): (usize, &[&Node]),
    ended: usize,
) -> Option<Known> {
    let base = entrants.get(exact)?;
    let harms = |entrant: &Entrant| judge.harms_in(entrant, ended);
    let (mut least, mut best, mut most) = (harms(base), exact, 0.0);
    for (at, entrant) in entrants.iter().enumerate() {
        if !theirs.contains(&&entrant.root) || entrant.contender.episodes() < ended {
            continue;
        }
        if entrant.contender.loss(&base.contender).mean <= 0.0 {
            least = least.min(harms(entrant));
        }
        let gain = judge.gain(entrant, base, Terms::taking(0.0));
        let surely = gain.mean - error(&gain);
        if surely > most {
            (most, best) = (surely, at);
        }
    }
    let of_best = entrants.get(best).map_or(least, harms);
    Some(Known {
        exact,
        best,
        ended,
        harms: [least, of_best.max(least)],
    })
}

/// Lets the tree that was chosen play on and, where it then did harm or looks worse than the best that was known before, that one,
/// too. Whether it does, so that the choice has to be made again.
fn is_doubted<W: World>(
    (judge, trials): (&mut Judge<'_, '_, W>, &Trials<'_, W>),
    entrants: &mut [Entrant],
    [chosen, best]: [usize; 2],
    episodes: usize,
) -> bool {
    if chosen == best || judge.plays_to(trials, entrants, chosen, episodes) == 0 {
        return false;
    }
    let [Some(own), Some(other)] = [chosen, best].map(|at| entrants.get(at)) else {
        return false;
    };
    let worth = |entrant: &Entrant| judge.worth(entrant, other.scale(), Terms::taking(0.0));
    let doubted = worth(own) < worth(other) || judge.harms(own) > 0;
    if doubted {
        judge.plays_to(trials, entrants, best, episodes);
    }
    doubted
}

/// The place of the tree that is taken.
fn chosen<W: World>(
    judge: &Judge<'_, '_, W>,
    entrants: &[Entrant],
    known: &Known,
    choice: Choice,
    price: f64,
) -> usize {
    let mean = |entrant: &Entrant| entrant.contender.returns().mean;
    let more_harmful = |entrant: &Entrant| {
        let best = entrants.get(known.best);
        best.is_some_and(|best| judge.is_more_harmful(entrant, best))
    };
    // Those that have played to the end and did no more harm than so much, as far as the episodes can tell.
    let within = |most: u64| {
        let is_safe = |entrant: &Entrant| {
            let harms = judge.harms_in(entrant, known.ended);
            entrant.contender.episodes() >= known.ended
                && !does_more_harm([harms, most], SURE)
                && !more_harmful(entrant)
        };
        let safe = entrants.iter().enumerate();
        let safe = safe.filter(|(_, entrant)| is_safe(entrant));
        safe.collect::<Vec<(usize, &Entrant)>>()
    };
    let [least, of_best] = known.harms;
    let best = |from: &[(usize, &Entrant)], worth: &dyn Fn(&Entrant) -> f64| {
        let worths = from.iter().map(|(at, entrant)| (*at, worth(entrant)));
        let best = worths.reduce(|best, next| if next.1 > best.1 { next } else { best });
        best.map_or(known.exact, |(at, _)| at)
    };
    match choice {
        // A tree that does nothing does no harm: it does not rule out those that do no more of it than the best one.
        Choice::Knee => [least, of_best]
            .into_iter()
            .map(|most| knee(judge, entrants, (&within(most), known), price))
            .find(|chosen| *chosen != known.exact)
            .unwrap_or(known.exact),
        Choice::Nodes(most) => {
            let all = entrants.iter().enumerate();
            let few: Vec<_> = all.filter(|(_, e)| e.nodes <= most).collect();
            best(&few, &mean)
        }
        Choice::Loss(part) => {
            let safe = within(least);
            let means = safe.iter().map(|(_, entrant)| mean(entrant));
            let most = means.fold(f64::NEG_INFINITY, f64::max);
            let least = most - part * most.abs();
            let good: Vec<_> = safe.into_iter().filter(|(_, e)| mean(e) >= least).collect();
            best(&good, &|entrant| -(entrant.nodes as f64))
        }
    }
}

/// The place of the tree that returns most for its nodes and its harm, of those that are as good as the best that was known before
/// without regard to nodes, with and without regard to harm.
fn knee<W: World>(
    judge: &Judge<'_, '_, W>,
    entrants: &[Entrant],
    (safe, known): (&[(usize, &Entrant)], &Known),
    price: f64,
) -> usize {
    let [Some(exact), Some(base)] = [known.exact, known.best].map(|at| entrants.get(at)) else {
        return known.exact;
    };
    // Less harm alone does not make a tree as good: one that does nothing has none.
    let as_good = |entrant: &Entrant| {
        let (times, part) = LESS;
        let most = part * base.contender.returns().mean.abs();
        let less = match entrant.nodes * times <= base.nodes {
            true => most,
            false => (price * base.nodes.saturating_sub(entrant.nodes) as f64).min(most),
        };
        [Terms::taking(0.0), Terms::free()]
            .into_iter()
            .all(|terms| {
                let gain = judge.gain(entrant, base, terms);
                // One harm more may be chance.
                let chance = math::hypot(error(&gain), judge.one_harm(base, terms));
                gain.mean >= -chance.max(less)
            })
    };
    // What harm costs is a part of what the best tree returns.
    let gain = |entrant: &Entrant, over| judge.gain(entrant, over, Terms::taking(price)).mean;
    let good = safe.iter().filter(|(_, entrant)| as_good(entrant));
    let gains = good.map(|(at, entrant)| (at, gain(entrant, base), entrant));
    let best = gains.reduce(|best, next| if next.1 > best.1 { next } else { best });
    let gives_way = best.filter(|(_, _, entrant)| gain(entrant, exact) > PROVED * price);
    gives_way.map_or(known.exact, |(at, ..)| *at)
}

/// The trees that none beats in both nodes and return, and the one that was taken.
fn points(entrants: &[Entrant], chosen: usize, harms: &impl Fn(&Entrant) -> u64) -> Vec<Point> {
    let mut points: Vec<Point> = entrants
        .iter()
        .enumerate()
        .map(|(at, entrant)| Point {
            size: Size::of(&entrant.root),
            returns: entrant.contender.returns(),
            harms: harms(entrant),
            episodes: entrant.contender.episodes() as u64,
            taken: at == chosen,
            root: entrant.root.clone(),
        })
        .collect();
    points.sort_by(|a, b| {
        let nodes = a.size.nodes.cmp(&b.size.nodes);
        let better = b.returns.mean.total_cmp(&a.returns.mean);
        nodes.then(better).then(b.taken.cmp(&a.taken))
    });
    let mut best = f64::NEG_INFINITY;
    points.retain(|point| {
        let stands = point.returns.mean > best;
        best = best.max(point.returns.mean);
        stands || point.taken
    });
    points
}
