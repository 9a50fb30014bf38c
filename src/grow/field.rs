//! The minterms that matter, with what each choice is worth there, and how a tree decides in them.
//!
//! A tree is scored by the advantage of its decisions over those of another, weighted by visits: the sum over minterms
//! approximates the difference of their returns (the performance difference lemma: Kakade and Langford 2002).

use super::evidence::{Cell, Evidence, Sight, Visits};
use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Guard;
use crate::ir::tree::{Atom, Composite, Node, Status};
use crate::learn::process::{Key, World};
use crate::learn::solve::Problem;
use crate::tree::Runner;
use crate::tree::atoms::behaviors;
use crate::tree::guard::or;
use crate::tree::unit::{guarded, selector};
use rustc_hash::FxHashMap;

/// By whose decisions what follows is judged.
#[derive(Clone, Copy, Debug)]
pub enum Aim<'n> {
    /// The best ones, as far as the counts tell.
    Best,
    /// Those of a tree.
    Of(&'n Node),
}

/// The behaviours by their numbers among the choices.
pub(super) type Numbers = FxHashMap<Id<Behavior>, usize>;

/// What a tree does in a minterm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drive {
    /// The behaviour that drives, by its number among the choices; `None` if the tree selects nothing.
    pub choice: Option<usize>,
    /// Whether another behaviour failed at once before it.
    pub fell: bool,
}

/// A minterm that matters.
#[derive(Clone, Debug)]
pub struct Spot {
    /// The minterm.
    pub key: Key,
    /// How often it is visited in an episode.
    pub weight: f64,
    /// What each choice is worth, and what it is worth below a behaviour that fails at once.
    values: Vec<[f64; 2]>,
    /// Whether a choice fails at once.
    refuses: Vec<bool>,
    /// What it is worth to select nothing.
    nothing: f64,
}

impl Spot {
    /// What a tree is worth that does this here.
    pub fn worth(&self, drive: Drive) -> f64 {
        let value = drive.choice.and_then(|choice| self.values.get(choice));
        value.map_or(
            self.nothing,
            |[plain, fallen]| if drive.fell { *fallen } else { *plain },
        )
    }

    /// The best choice.
    pub fn best(&self) -> f64 {
        let values = self.values.iter().map(|[plain, _]| *plain);
        values.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The minterms that matter.
#[derive(Debug)]
pub struct Field<'w> {
    /// The minterms, the most visited first.
    pub spots: Vec<Spot>,
    /// The atoms of a minterm.
    pub atoms: &'w [Atom],
    /// All that the world lets a tree ask.
    asked: &'w [Atom],
    /// The behaviours to choose from.
    pub choices: &'w [Id<Behavior>],
    numbers: Numbers,
}

/// The most minterms that are scored.
const SPOTS: usize = 700;

impl<'w> Field<'w> {
    /// What is known, with the visits of a tree.
    pub fn new<W: World>(
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        sight: Sight,
        visits: &Visits,
        aim: Aim,
    ) -> Self {
        let atoms = ground.atoms();
        let numbers = numbers(ground);
        let mut problem = evidence.problem(sight);
        let runner = match aim {
            Aim::Best => None,
            Aim::Of(root) => Runner::new(&without_memory(root, atoms), ground.world.atoms()).ok(),
        };
        let values = match runner {
            None => problem.solve().values,
            Some(mut runner) => {
                let rows = evidence.keys().iter().zip(&problem.states).enumerate();
                let policy = rows.map(|(row, (key, state))| {
                    let cells = evidence.cells(row);
                    let drive = driven(&mut runner, *key, &numbers, |choice| {
                        cells.get(choice).is_some_and(Cell::refuses)
                    });
                    let taken = |(choice, _): &(usize, _)| Some(*choice) == drive.choice;
                    state.iter().position(taken)
                });
                let policy: Vec<Option<usize>> = policy.collect();
                // What is not known of the tree is about as bad as anything else that it does.
                problem.unknown = problem.low(&problem.evaluate(&policy));
                problem.evaluate(&policy)
            }
        };
        Self::with(ground, evidence, &problem, &values, visits)
    }

    /// What is known, with the visits of a tree, where rows are worth so much.
    pub fn with<W: World>(
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        problem: &Problem,
        values: &[f64],
        visits: &Visits,
    ) -> Self {
        let atoms = ground.atoms();
        let numbers = numbers(ground);
        let refusal = evidence.refusal();
        let mut spots: Vec<Spot> = visits
            .iter()
            .filter_map(|(key, weight)| {
                let row = evidence.row(*key)?;
                let states = problem.states.get(row)?;
                let mut worths: Vec<Option<f64>> = vec![None; ground.choices.len()];
                for (choice, outlook) in states {
                    if let Some(worth) = worths.get_mut(*choice) {
                        *worth = Some(problem.lasting(row, outlook, values));
                    }
                }
                let known = || worths.iter().flatten().copied();
                let least = known().fold(f64::INFINITY, f64::min);
                if !least.is_finite() {
                    return None;
                }
                let cells = evidence.cells(row);
                let values = cells.iter().zip(&worths).map(|(cell, worth)| {
                    // What nobody tried is no better than the worst that somebody did.
                    let plain = worth.unwrap_or(least);
                    let due = (cell.ticks() - 1.0).max(0.0);
                    [plain, plain + due.min(100.0) * refusal.min(0.0)]
                });
                Some(Spot {
                    key: *key,
                    weight: *weight,
                    values: values.collect(),
                    refuses: cells.iter().map(Cell::refuses).collect(),
                    nothing: least + refusal.min(0.0),
                })
            })
            .collect();
        spots.sort_by(|a, b| b.weight.total_cmp(&a.weight).then(a.key.cmp(&b.key)));
        spots.truncate(SPOTS);
        Self {
            spots,
            atoms,
            asked: ground.world.atoms(),
            choices: ground.choices,
            numbers,
        }
    }

    /// What a tree does in each minterm; `None` if it asks what the world does not know.
    pub fn drives(&self, root: &Node) -> Option<Vec<Drive>> {
        let read = without_memory(root, self.atoms);
        let mut runner = Runner::new(&read, self.asked).ok()?;
        let drives = self.spots.iter().map(|spot| {
            driven(&mut runner, spot.key, &self.numbers, |choice| {
                spot.refuses.get(choice).copied().unwrap_or(false)
            })
        });
        Some(drives.collect())
    }

    /// How much more a tree returns than another that does `now`, as far as the counts tell.
    pub fn gain(&self, drives: &[Drive], now: &[Drive]) -> f64 {
        let pairs = self.spots.iter().zip(drives.iter().zip(now));
        let gains = pairs.map(|(spot, (new, old))| {
            if new == old {
                0.0
            } else {
                spot.weight * (spot.worth(*new) - spot.worth(*old))
            }
        });
        gains.sum()
    }
}

pub(super) fn numbers<W>(ground: &Ground<W>) -> Numbers {
    let choices = ground.choices.iter().enumerate();
    choices.map(|(at, id)| (*id, at)).collect()
}

/// In how many of these minterms two trees select the same behaviour first, or none.
pub fn alike<W: World>(ground: &Ground<W>, trees: [&Node; 2], keys: &[Key]) -> usize {
    let read =
        |root: &Node| Runner::new(&without_memory(root, ground.atoms()), ground.world.atoms()).ok();
    let [Some(mut own), Some(mut other)] = trees.map(read) else {
        return 0;
    };
    let numbers = numbers(ground);
    let first = |runner: &mut Runner, key| driven(runner, key, &numbers, |_| false).choice;
    let alike = |key: &&Key| first(&mut own, **key) == first(&mut other, **key);
    keys.iter().filter(alike).count()
}

/// What a tree does in a minterm, its memory fresh, where some choices fail at once.
pub(super) fn driven(
    runner: &mut Runner,
    key: Key,
    numbers: &Numbers,
    refuses: impl Fn(usize) -> bool,
) -> Drive {
    runner.reset();
    let mut drive = Drive {
        choice: None,
        fell: false,
    };
    runner.tick_key(key, |behavior| {
        let choice = numbers.get(&behavior).copied();
        if choice.is_some_and(&refuses) {
            drive.fell = true;
            return Status::Failure;
        }
        drive.choice = choice;
        Status::Running
    });
    drive
}

/// A tree whose memory nodes ask the history instead: a sequence goes on behind the last child that has succeeded, a
/// selector behind the last that has failed. Where the history is not kept, a later child comes first and fails at
/// once where it is not its turn.
pub(super) fn without_memory(node: &Node, atoms: &[Atom]) -> Node {
    match node {
        Node::Condition(_) | Node::Behavior(_) => node.clone(),
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let children = children.iter().map(|child| without_memory(child, atoms));
            let children: Vec<Node> = children.collect();
            if *memory {
                return by_history(*kind, &children, atoms);
            }
            Node::Composite {
                kind: *kind,
                memory: false,
                children,
            }
        }
        Node::Parallel {
            successes,
            children,
        } => {
            let children = children.iter().map(|child| without_memory(child, atoms));
            Node::Parallel {
                successes: *successes,
                children: children.collect(),
            }
        }
        Node::Decorator { child, .. } => without_memory(child, atoms),
    }
}

fn by_history(kind: Composite, children: &[Node], atoms: &[Atom]) -> Node {
    let mut units: Vec<Node> = Vec::new();
    for (at, child) in children.iter().enumerate() {
        let before = at.checked_sub(1).and_then(|before| children.get(before));
        let unit = match before {
            None => child.clone(),
            Some(before) => {
                let ended = behaviors(before).into_iter().map(|behavior| match kind {
                    Composite::Sequence => Atom::Done(behavior),
                    Composite::Selector => Atom::Failed(behavior),
                });
                let kept = ended.filter(|atom| atoms.contains(atom));
                let kept: Vec<Guard> = kept.map(Guard::Atom).collect();
                match kept.is_empty() {
                    true => child.clone(),
                    false => guarded(or(kept), child.clone()),
                }
            }
        };
        units.insert(0, unit);
    }
    selector(units)
}
