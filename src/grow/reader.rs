//! What trees do in minterms.

use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Guard, Node, Status};
use crate::learn::process::{Key, World};
use crate::learn::solve::Problem;
use crate::tree::Runner;
use crate::tree::atoms::behaviors;
use crate::tree::guard::or;
use crate::tree::unit::{guarded, selector};
use rustc_hash::FxHashMap;

/// What a tree does in a minterm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Drive {
    /// The behaviour that drives, by its number among the choices; `None` if the tree selects nothing.
    pub choice: Option<usize>,
    /// Whether another behaviour failed at once before it.
    pub fell: bool,
}

/// The behaviours by their numbers among the choices.
type Numbers = FxHashMap<Id<Behavior>, usize>;

/// Reads what trees do. A memory node goes on where the history says; trees that ask what the world does not know cannot be
/// read.
#[derive(Debug)]
pub struct Reader<'w> {
    /// The atoms of a minterm.
    pub atoms: &'w [Atom],
    /// All that the world lets a tree ask.
    asked: &'w [Atom],
    numbers: Numbers,
}

impl<'w> Reader<'w> {
    /// A reader of the trees that grow here.
    pub fn new<W: World>(ground: &Ground<'w, W>) -> Self {
        let choices = ground.choices.iter().enumerate();
        Self {
            atoms: ground.atoms(),
            asked: ground.world.atoms(),
            numbers: choices.map(|(at, id)| (*id, at)).collect(),
        }
    }

    /// What a tree does in each of these minterms, where these choices fail at once.
    pub fn drives<'r>(
        &self,
        root: &Node,
        rows: impl Iterator<Item = (Key, &'r [bool])>,
    ) -> Option<Vec<Drive>> {
        let read = without_memory(root, self.atoms);
        let mut runner = Runner::new(&read, self.asked).ok()?;
        let drives = rows.map(|(key, refuses)| {
            driven(&mut runner, key, &self.numbers, |choice| {
                refuses.get(choice).copied().unwrap_or(false)
            })
        });
        Some(drives.collect())
    }

    /// A tree as a policy of a problem whose states are these minterms.
    pub fn policy(
        &self,
        root: &Node,
        problem: &Problem,
        keys: &[Key],
        refuses: &[Vec<bool>],
    ) -> Option<Vec<Option<usize>>> {
        let rows = keys.iter().zip(refuses);
        let drives = self.drives(root, rows.map(|(key, refuses)| (*key, refuses.as_slice())))?;
        let policy = problem.states.iter().zip(drives).map(|(state, drive)| {
            let taken = |(choice, _): &(usize, _)| Some(*choice) == drive.choice;
            state.iter().position(taken)
        });
        Some(policy.collect())
    }
}

/// In how many of these minterms two trees select the same behaviour first, or none.
pub fn alike<W: World>(ground: &Ground<W>, trees: [&Node; 2], keys: &[Key]) -> usize {
    let reader = Reader::new(ground);
    let rows = || keys.iter().map(|key| (*key, [].as_slice()));
    let [Some(own), Some(other)] = trees.map(|root| reader.drives(root, rows())) else {
        return 0;
    };
    let pairs = own.iter().zip(&other);
    pairs
        .filter(|(own, other)| own.choice == other.choice)
        .count()
}

/// What a tree does in a minterm, its memory fresh, where some choices fail at once.
fn driven(
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
fn without_memory(node: &Node, atoms: &[Atom]) -> Node {
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
