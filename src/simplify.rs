//! A smaller tree that loses little return in simulation.
//!
//! Two trees play the same episodes, and the differences of their returns count. A search descends from the exact tree,
//! each tree smaller than the one before. The smallest of them that stays within the loss on other seeds is taken, and
//! measured on fresh ones.

mod descent;

use crate::ir::task::Task;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use crate::learn::simulated::Purpose;
use crate::learn::statistics::{Mean, Summary};
use crate::tree::Size;
use crate::tree::prune::{Change, Requirement};
use crate::trial::Unplayable;
use crate::trial::paired::{Contender, Trials, within};
use descent::{Simplifier, Visited};

/// Episodes of the second opinion on a tree that the search found.
const CONFIRMING: usize = 320;
/// Trees that get a second opinion before the exact one is kept.
const OPINIONS: usize = 6;
/// Fresh episodes before and after.
const FRESH: usize = 1000;

/// The figures of a tree.
#[derive(Clone, Debug, PartialEq)]
pub struct Figures {
    /// Its size.
    pub size: Size,
    /// The figures of its episodes.
    pub summary: Summary,
}

/// A change that was kept.
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// The kind of change.
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
    /// The greatest loss that is allowed, as a part of the exact tree's return.
    pub allowed: f64,
    /// How it was found.
    pub steps: Vec<Kept>,
    /// Ticks that the search simulated.
    pub ticks: u64,
}

/// How far the search has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Progress {
    /// The nodes of the current tree.
    pub nodes: usize,
    /// Ticks simulated so far.
    pub ticks: u64,
    /// The most ticks.
    pub of: u64,
}

/// Simplifies the exact tree of a task while the mean paired loss of return stays below `loss`, a part of the exact
/// tree's return, with 95 % confidence, and no line of `end on` ends more episodes to the robot's loss.
///
/// On each descent the loss also counts against the best tree that was met on it, so that no gain is given away again
/// for a node or two.
///
/// # Errors
/// The world cannot be built, or the tree asks an atom that it does not know.
pub fn simplify(
    program: &Program,
    task: Id<Task>,
    root: &Node,
    loss: f64,
    seed: u64,
    progress: &(dyn Fn(Progress) + Sync),
) -> Result<Simplified, Unplayable> {
    let trials = Trials::new(program, task, root, (Purpose::Simplify, seed))?;
    let requirements = requirements(program, task);
    let mut simplifier = Simplifier::new(trials, &requirements, loss, progress);
    let visited = simplifier.trees(root);
    let ticks = simplifier.ticks;
    let trials = simplifier.into_trials().with(Purpose::Confirm);
    let found = confirmed(&trials, root, &visited, loss).map_err(Unplayable::Unknown)?;
    let simple = found.map_or(root, |visited| &visited.root);
    let trials = trials.with(Purpose::Measure);
    let contender = |root| trials.contender(root).map_err(Unplayable::Unknown);
    let (mut before, mut after) = (contender(root)?, contender(simple)?);
    trials.play(&mut [&mut before], FRESH, None);
    trials.play(&mut [&mut after], FRESH, Some(&before));
    let ends = program.tasks[task].end_on.len();
    let figures = |contender: &Contender, root: &Node| Figures {
        size: Size::of(root),
        summary: Summary::of(&contender.results(), ends),
    };
    Ok(Simplified {
        root: simple.clone(),
        before: figures(&before, root),
        after: figures(&after, simple),
        loss: after.loss(&before),
        allowed: loss,
        steps: found.map_or_else(Vec::new, |visited| visited.steps.clone()),
        ticks,
    })
}

/// The predicate that each behaviour of the task requires, where it requires just that.
fn requirements(program: &Program, task: Id<Task>) -> Vec<Requirement> {
    let task = &program.tasks[task];
    let required = task.choose.iter().filter_map(|&behavior| {
        let requires = program.behaviors[behavior].law.as_ref()?.requires;
        let same = |&&id: &&Id<_>| program.predicates[id].when == Some(requires);
        let predicate = task.observe.iter().find(same)?;
        Some((behavior, Atom::Predicate(*predicate)))
    });
    required.collect()
}

/// The first of the trees that stays within the loss on other seeds. The search chose among many trees on its own seeds,
/// where the luckiest look best.
fn confirmed<'h>(
    trials: &Trials,
    root: &Node,
    visited: &'h [Visited],
    loss: f64,
) -> Result<Option<&'h Visited>, Atom> {
    let mut exact = trials.contender(root)?;
    trials.play(&mut [&mut exact], CONFIRMING, None);
    let limit = loss * exact.returns().mean.abs();
    for visited in visited.iter().take(OPINIONS) {
        let mut contender = trials.contender(&visited.root)?;
        trials.play(&mut [&mut contender], CONFIRMING, Some(&exact));
        if within(&contender, &exact, limit) {
            return Ok(Some(visited));
        }
    }
    Ok(None)
}
