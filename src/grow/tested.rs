//! The test of the tree that was chosen: fresh episodes, beside the exact tree and the best one of the file.

use super::Starts;
use super::race::Judge;
use crate::ir::tree::{Atom, Node};
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::{Mean, Summary};
use crate::tree::Size;
use crate::trial::paired::{Contender, Trials};
use serde::{Deserialize, Serialize};

/// The figures of a tree.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// Its size.
    pub size: Size,
    /// The figures of its episodes.
    pub summary: Summary,
    /// Harms in these: ends that cost, events that are claimed never to happen.
    pub harms: u64,
}

/// A tree of the file beside the one that was grown.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Beside {
    /// Its name.
    pub name: String,
    /// Its figures, on the same seeds.
    pub figures: Figures,
    /// The mean gain of the grown tree over it, paired.
    pub gain: Mean,
}

/// What the test came to.
pub(super) struct Tested {
    /// The exact tree.
    pub(super) before: Figures,
    /// The tree that was chosen, on the same seeds.
    pub(super) after: Figures,
    /// Its gain over the exact tree.
    pub(super) gain: Mean,
    /// The best of the other trees that the search began with.
    pub(super) beside: Option<Beside>,
}

/// Tests a tree in so many episodes, after so many that say which of the other trees is the best.
///
/// # Errors
/// The tree, or the exact one, asks an atom that the world does not know.
pub(super) fn test<W: World>(
    judge: &mut Judge<'_, '_, W>,
    starts: &Starts,
    root: &Node,
    [some, all]: [usize; 2],
) -> Result<Tested, Atom> {
    let race = judge.fresh();
    let ground = judge.ground;
    let trials = ground.trials(Purpose::Measure, race);
    let mut before = trials.contender(&starts.exact)?;
    let mut after = trials.contender(root)?;
    let known = starts.others.iter().filter_map(|(name, root)| {
        let contender = trials.contender(root).ok()?;
        Some((name.as_str(), root, contender))
    });
    let mut others: Vec<Other> = known.collect();
    let mut ticks = trials.play(&mut [&mut before], all, None).ticks;
    ticks += trials.play(&mut [&mut after], all, Some(&before)).ticks;
    ticks += play_best(&trials, &mut others, [some, all]);
    judge.seen.ticks += ticks;
    let figures = |contender: &Contender, root: &Node| Figures {
        size: Size::of(root),
        harms: ground.harms(contender, contender.episodes()),
        summary: Summary::of(&contender.results(), ground.ends),
    };
    let beside = others.first().map(|(name, root, contender)| Beside {
        name: (*name).to_owned(),
        figures: figures(contender, root),
        gain: gain(&after, contender),
    });
    Ok(Tested {
        before: figures(&before, &starts.exact),
        after: figures(&after, root),
        gain: gain(&after, &before),
        beside,
    })
}

/// The gain of a tree over another, episode by episode.
fn gain(own: &Contender, other: &Contender) -> Mean {
    let loss = own.loss(other);
    let [low, high] = loss.ci95;
    Mean {
        mean: -loss.mean,
        ci95: [-high, -low],
    }
}

/// Another tree by its name.
type Other<'a> = (&'a str, &'a Node, Contender);

/// Lets trees play some episodes, and the one that returns most, which stands first then, all of them; counts the ticks.
fn play_best<W: World>(
    trials: &Trials<'_, W>,
    trees: &mut [Other],
    [some, all]: [usize; 2],
) -> u64 {
    let mut ticks = 0;
    if trees.len() > 1 {
        let each = trees.iter_mut().map(|(_, _, contender)| contender);
        ticks += trials.play(&mut each.collect::<Vec<_>>(), some, None).ticks;
        let mean = |(_, _, contender): &Other| contender.returns().mean;
        trees.sort_by(|a, b| mean(b).total_cmp(&mean(a)));
    }
    if let Some((_, _, best)) = trees.first_mut() {
        ticks += trials.play(&mut [best], all, None).ticks;
    }
    ticks
}
