//! `--simplify`: a smaller tree that simulation tells is worth nearly as much as the exact one.
//!
//! Both trees play the same episodes, and the differences of their returns are what counts. A search goes down from the
//! exact tree, each tree smaller than the one before; of all that it held, the smallest that stays within the loss on
//! seeds of their own is taken, and measured on fresh ones.

mod bench;
mod report;
mod search;
mod trace;

use super::load::Loaded;
use super::run;
use crate::diagnostic::Diagnostic;
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::statistics::{Mean, Summary};
use crate::tree::Size;
use crate::tree::prune::{Change, Requirement};
use crate::world::Start;
use bench::{Bench, Player, within};
use search::{Held, Search};

/// Streams of random numbers: of the search, of the second opinion on what it found, and of the measurement.
const SEARCH: u64 = 16;
const CONFIRM: u64 = 17;
const MEASURE: u64 = 18;

/// Episodes of the second opinion.
const CONFIRMING: usize = 320;
/// Trees that are given a second opinion before the exact one is kept.
const OPINIONS: usize = 6;
/// Fresh episodes before and after.
const FRESH: usize = 1000;

/// A tree with what it is worth.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Its size.
    pub size: Size,
    /// What its episodes came to.
    pub summary: Summary,
}

/// A change that was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Step {
    /// What was done.
    pub change: Change,
    /// The size after it.
    pub size: Size,
    /// The mean loss of return an episode against the exact tree, on the seeds of the search.
    pub loss: Mean,
}

/// A simplified tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Simplified {
    /// The tree; the exact one if nothing smaller came within the loss.
    pub root: Node,
    /// The exact tree on fresh seeds.
    pub before: Figures,
    /// This tree on the same seeds.
    pub after: Figures,
    /// Its mean loss of return an episode on these seeds, paired; negative for a gain.
    pub loss: Mean,
    /// The greatest loss that was allowed, as a part of the exact tree's return.
    pub allowed: f64,
    /// How it was found.
    pub steps: Vec<Step>,
    /// Ticks that the search simulated.
    pub ticks: u64,
}

/// How far the search has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The nodes of the tree that is held now.
    pub nodes: usize,
    /// Ticks that were simulated.
    pub ticks: u64,
    /// Ticks that may be.
    pub of: u64,
}

/// Simplifies the exact tree of a task while the mean paired loss of return stays below `loss`, a part of the exact
/// tree's return, with 95 % confidence, and no line of `end on` ends more episodes to the robot's loss.
///
/// On each way down the loss is held against the best tree that was met on it, too, so that what is gained is not given
/// away again for a node or two.
///
/// # Errors
/// The world cannot be built.
pub fn simplify(
    loaded: &Loaded,
    task: Id<Task>,
    root: &Node,
    loss: f64,
    seed: u64,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Simplified, Diagnostic> {
    let start = Start {
        seed,
        stream: SEARCH,
        limit: loaded.program.tasks[task].end_after,
        ..Start::default()
    };
    let bench = Bench::new(loaded, task, root, start)?;
    let possible = possible(&loaded.program, task);
    let mut search = Search::new(bench, &possible, loss, progress);
    let held = search.trees(root);
    let ticks = search.ticks;
    let bench = search.into_bench().on(CONFIRM);
    let found = confirmed(&bench, root, &held, loss);
    let simple = found.map_or(root, |held| &held.root);
    let bench = bench.on(MEASURE);
    let players = (bench.player(root), bench.player(simple));
    let (Some(mut before), Some(mut after)) = players else {
        return Err(run::internal(loaded, "what a guard asks"));
    };
    bench.play(&mut [&mut before], FRESH, None);
    bench.play(&mut [&mut after], FRESH, Some(&before));
    let ends = loaded.program.tasks[task].end_on.len();
    let figures = |player: &Player, root: &Node| Figures {
        size: Size::of(root),
        summary: Summary::of(&player.results(), ends),
    };
    Ok(Simplified {
        root: simple.clone(),
        before: figures(&before, root),
        after: figures(&after, simple),
        loss: after.loss(&before),
        allowed: loss,
        steps: found.map_or_else(Vec::new, |held| held.steps.clone()),
        ticks,
    })
}

/// The predicate that each behaviour of the task requires, where it requires just that.
fn possible(program: &Program, task: Id<Task>) -> Vec<Requirement> {
    let task = &program.tasks[task];
    let required = task.choose.iter().filter_map(|&behavior| {
        let requires = program.behaviors[behavior].law.as_ref()?.requires;
        let same = |&&id: &&Id<_>| program.predicates[id].when == Some(requires);
        let predicate = task.observe.iter().find(same)?;
        Some((behavior, Atom::Predicate(*predicate)))
    });
    required.collect()
}

/// The first of the trees that holds on seeds of its own. The search has chosen among many on its seeds, where the
/// luckiest look best.
fn confirmed<'h>(bench: &Bench, root: &Node, held: &'h [Held], loss: f64) -> Option<&'h Held> {
    let mut exact = bench.player(root)?;
    bench.play(&mut [&mut exact], CONFIRMING, None);
    let limit = loss * exact.returns().mean.abs();
    held.iter().take(OPINIONS).find(|held| {
        bench.player(&held.root).is_some_and(|mut player| {
            bench.play(&mut [&mut player], CONFIRMING, Some(&exact));
            within(&player, &exact, limit)
        })
    })
}
