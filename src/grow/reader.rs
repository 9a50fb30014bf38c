//! What trees do in minterms.

use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Guard, Node};
use crate::learn::process::{Key, World};
use crate::learn::solve::Problem;
use crate::tree::atoms::behaviors;
use crate::tree::batch::{Answers, Batch, Rows};
use crate::tree::guard::or;
use crate::tree::unit::{guarded, selector};
use rustc_hash::FxHashMap;
use std::borrow::Cow;

/// What a tree does in a minterm.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Drive {
    /// The behaviour that drives, by its number among the choices; `None` if the tree selects nothing.
    pub choice: Option<usize>,
    /// Whether another behaviour failed at once before it.
    pub fell: bool,
}

/// Reads what trees do in minterms. A memory node goes on where the history says; trees that ask what the world does not know
/// cannot be read.
#[derive(Debug)]
pub struct Reader<'w> {
    /// The atoms of a minterm.
    atoms: &'w [Atom],
    numbers: FxHashMap<Id<Behavior>, usize>,
    minterms: usize,
    batch: Batch,
    /// For each block of minterms, where each choice fails at once.
    refusing: Vec<Vec<Rows>>,
}

impl<'w> Reader<'w> {
    /// A reader of the trees that grow here in these minterms, where these choices fail at once.
    pub fn new<'r, W: World>(
        ground: &Ground<'w, W>,
        minterms: impl Iterator<Item = (Key, &'r [bool])>,
    ) -> Self {
        let choices = ground.choices.iter().enumerate();
        let (keys, refuses): (Vec<Key>, Vec<&[bool]>) = minterms.unzip();
        let blocks = refuses.chunks(Rows::MOST).map(|block| {
            let mut refusing = vec![Rows::NONE; ground.choices.len()];
            for (row, refuses) in block.iter().enumerate() {
                let those = refusing.iter_mut().zip(*refuses);
                let those = those.filter(|(_, refuses)| **refuses);
                those.for_each(|(rows, _)| rows.insert(row));
            }
            refusing
        });
        Self {
            atoms: ground.atoms(),
            numbers: choices.map(|(at, id)| (*id, at)).collect(),
            minterms: keys.len(),
            batch: Batch::new(ground.world.atoms(), &keys),
            refusing: blocks.collect(),
        }
    }

    /// What a tree does in each minterm, its memory fresh.
    pub fn drives(&self, root: &Node) -> Option<Vec<Drive>> {
        let root = match is_plain(root) {
            true => Cow::Borrowed(root),
            false => Cow::Owned(without_memory(root, self.atoms)),
        };
        let mut drives = vec![Drive::default(); self.minterms];
        let mut leaf = |block: usize, behavior: Id<Behavior>, rows: Rows| {
            let choice = self.numbers.get(&behavior).copied();
            let refusing = self.refusing.get(block).zip(choice);
            let refusing = refusing.and_then(|(refusing, choice)| refusing.get(choice));
            let failed = rows & refusing.copied().unwrap_or_default();
            let from = block * Rows::MOST;
            for row in failed.iter() {
                if let Some(drive) = drives.get_mut(from + row) {
                    drive.fell = true;
                }
            }
            for row in (rows & !failed).iter() {
                if let Some(drive) = drives.get_mut(from + row) {
                    drive.choice = choice;
                }
            }
            Answers {
                failed,
                ..Answers::default()
            }
        };
        self.batch.tick(&root, &mut leaf).ok()?;
        Some(drives)
    }

    /// A tree as a policy of a problem whose states are these minterms.
    pub fn policy(&self, root: &Node, problem: &Problem) -> Option<Vec<Option<usize>>> {
        let drives = self.drives(root)?;
        let policy = problem.states.iter().zip(drives).map(|(state, drive)| {
            let taken = |(choice, _): &(usize, _)| Some(*choice) == drive.choice;
            state.iter().position(taken)
        });
        Some(policy.collect())
    }
}

/// In how many of these minterms two trees select the same behaviour first, or none.
pub fn alike<W: World>(ground: &Ground<W>, trees: [&Node; 2], keys: &[Key]) -> usize {
    let reader = Reader::new(ground, keys.iter().map(|key| (*key, [].as_slice())));
    let [Some(own), Some(other)] = trees.map(|root| reader.drives(root)) else {
        return 0;
    };
    let pairs = own.iter().zip(&other);
    pairs
        .filter(|(own, other)| own.choice == other.choice)
        .count()
}

/// Whether a tree has neither memory nodes nor decorators.
fn is_plain(node: &Node) -> bool {
    let keeps = matches!(
        node,
        Node::Composite { memory: true, .. } | Node::Decorator { .. }
    );
    !keeps && node.children().iter().all(is_plain)
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
