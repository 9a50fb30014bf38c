//! One tick of a tree in many valuations together.
//!
//! The valuations stand side by side in blocks, a bit for each, and a node is ticked in all those that come to it. In each of
//! them it answers what a [`Runner`](super::tick::Runner) with fresh memory does. A [proof](super::prove) asks for less: which
//! behaviour is selected first, whatever it answers.

use super::answers;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Guard, Node, Status};
use rustc_hash::FxHashMap;
use std::ops::{BitAnd, BitOr, Not};

/// The words of a block.
const WORDS: usize = 8;

/// Rows of a block: a set of its valuations.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Rows([u64; WORDS]);

impl Rows {
    /// The valuations of a block.
    pub const MOST: usize = 64 * WORDS;
    /// No row.
    pub const NONE: Self = Self([0; WORDS]);
    const ALL: Self = Self([u64::MAX; WORDS]);

    /// Adds a row.
    pub fn insert(&mut self, row: usize) {
        if let Some(word) = self.0.get_mut(row / 64) {
            *word |= 1 << (row % 64);
        }
    }

    /// The rows, in ascending order.
    pub fn iter(self) -> impl Iterator<Item = usize> {
        self.0.into_iter().enumerate().flat_map(|(at, mut word)| {
            std::iter::from_fn(move || {
                let bit = word.trailing_zeros() as usize;
                word &= word.wrapping_sub(1);
                (bit < 64).then_some(64 * at + bit)
            })
        })
    }

    fn both(self, other: Self, join: impl Fn(u64, u64) -> u64) -> Self {
        Self(std::array::from_fn(|at| {
            let [own, other] = [self, other].map(|rows| rows.0.get(at).copied().unwrap_or(0));
            join(own, other)
        }))
    }
}

impl BitAnd for Rows {
    type Output = Self;

    fn bitand(self, other: Self) -> Self {
        self.both(other, |own, other| own & other)
    }
}

impl BitOr for Rows {
    type Output = Self;

    fn bitor(self, other: Self) -> Self {
        self.both(other, |own, other| own | other)
    }
}

impl Not for Rows {
    type Output = Self;

    fn not(self) -> Self {
        Self(self.0.map(|word| !word))
    }
}

/// What a node answers in the rows that it is ticked in: where it neither succeeds nor fails, it runs.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Answers {
    /// Where it succeeds.
    pub succeeded: Rows,
    /// Where it fails.
    pub failed: Rows,
}

impl Answers {
    /// Where it answers this, of the rows that it is ticked in.
    fn rows(&self, status: Status, ticked: Rows) -> Rows {
        match status {
            Status::Success => self.succeeded,
            Status::Failure => self.failed,
            Status::Running => ticked & !(self.succeeded | self.failed),
        }
    }

    /// This answer in these rows as well.
    fn add(&mut self, status: Status, rows: Rows) {
        match status {
            Status::Success => self.succeeded = self.succeeded | rows,
            Status::Failure => self.failed = self.failed | rows,
            Status::Running => {}
        }
    }
}

/// Valuations in which trees are ticked together.
#[derive(Clone, Debug)]
pub struct Batch {
    places: FxHashMap<Atom, usize>,
    blocks: Vec<Block>,
}

/// Up to [`Rows::MOST`] valuations.
#[derive(Clone, Debug)]
struct Block {
    all: Rows,
    /// Where each atom holds.
    atoms: Vec<Rows>,
}

impl Batch {
    /// Valuations of these atoms; the first atom is the lowest bit of a key.
    pub fn new(atoms: &[Atom], keys: &[u128]) -> Self {
        let places = atoms.iter().enumerate().rev();
        let blocks = keys.chunks(Rows::MOST).map(|keys| {
            let mut block = Block {
                all: Rows::NONE,
                atoms: vec![Rows::NONE; atoms.len()],
            };
            for (row, key) in keys.iter().enumerate() {
                block.all.insert(row);
                for (bit, column) in block.atoms.iter_mut().enumerate().take(128) {
                    if key >> bit & 1 == 1 {
                        column.insert(row);
                    }
                }
            }
            block
        });
        Self {
            places: places.map(|(at, atom)| (*atom, at)).collect(),
            blocks: blocks.collect(),
        }
    }

    /// Ticks a tree once in each valuation, and gives its answers block by block. `leaf` ticks a behaviour in these rows of
    /// the block of this number.
    ///
    /// # Errors
    /// An atom that a guard asks and that the valuations do not have.
    pub fn tick(
        &self,
        root: &Node,
        leaf: &mut impl FnMut(usize, Id<Behavior>, Rows) -> Answers,
    ) -> Result<Vec<Answers>, Atom> {
        let blocks = self.blocks.iter().enumerate();
        let answers = blocks.map(|(number, block)| {
            let mut tick = Tick {
                places: &self.places,
                block,
                driven: Rows::NONE,
                leaf: &mut |behavior, rows| leaf(number, behavior, rows),
            };
            tick.node(root, block.all)
        });
        answers.collect()
    }
}

struct Tick<'a, F> {
    places: &'a FxHashMap<Atom, usize>,
    block: &'a Block,
    /// Where a behaviour was ticked.
    driven: Rows,
    leaf: &'a mut F,
}

impl<F: FnMut(Id<Behavior>, Rows) -> Answers> Tick<'_, F> {
    fn node(&mut self, node: &Node, rows: Rows) -> Result<Answers, Atom> {
        match node {
            Node::Condition(guard) => {
                let holds = self.guard(guard)?;
                let mut answers = Answers::default();
                answers.add(answers::condition(true), rows & holds);
                answers.add(answers::condition(false), rows & !holds);
                Ok(answers)
            }
            Node::Behavior(behavior) => {
                self.driven = self.driven | rows;
                Ok((self.leaf)(*behavior, rows))
            }
            Node::Composite {
                kind,
                memory,
                children,
            } => self.composite((*kind, *memory), children, rows),
            Node::Parallel {
                successes,
                children,
            } => self.parallel(*successes, children, rows),
            Node::Decorator { kind, child } => {
                let mut answers = Answers::default();
                if answers::is_over(*kind, 0) {
                    self.node(child, Rows::NONE)?;
                    answers.add(Status::Failure, rows);
                    return Ok(answers);
                }
                let below = self.node(child, rows)?;
                for status in [Status::Success, Status::Failure, Status::Running] {
                    let (answer, _) = answers::decorated(*kind, 0, status);
                    answers.add(answer, below.rows(status, rows));
                }
                Ok(answers)
            }
        }
    }

    fn composite(
        &mut self,
        (kind, memory): (Composite, bool),
        children: &[Node],
        rows: Rows,
    ) -> Result<Answers, Atom> {
        let goes_on = answers::goes_on(kind);
        let mut answers = Answers::default();
        let mut left = rows;
        for (at, child) in children.iter().enumerate() {
            let before = std::mem::take(&mut self.driven);
            let below = self.node(child, left)?;
            for status in [Status::Success, Status::Failure] {
                if status != goes_on {
                    answers.add(status, below.rows(status, left));
                }
            }
            left = below.rows(goes_on, left);
            if memory && at + 1 < children.len() {
                // The next child waits for the next tick where this one has ended and is no condition.
                left = left & !self.driven;
            }
            self.driven = self.driven | before;
        }
        answers.add(goes_on, left);
        Ok(answers)
    }

    fn parallel(&mut self, successes: u32, children: &[Node], rows: Rows) -> Result<Answers, Atom> {
        let [mut succeeded, mut failed] = [vec![rows], vec![rows]];
        for child in children {
            let below = self.node(child, rows)?;
            count(&mut succeeded, below.succeeded);
            count(&mut failed, below.failed);
        }
        let mut answers = Answers::default();
        let number = |count: usize| u32::try_from(count).unwrap_or(u32::MAX);
        for (s, succeeded) in succeeded.iter().enumerate() {
            for (f, failed) in failed.iter().enumerate() {
                let children = number(children.len());
                let answer = answers::parallel(successes, children, number(s), number(f));
                answers.add(answer, *succeeded & *failed);
            }
        }
        Ok(answers)
    }

    fn guard(&self, guard: &Guard) -> Result<Rows, Atom> {
        Ok(match guard {
            Guard::Const(true) => Rows::ALL,
            Guard::Const(false) => Rows::NONE,
            Guard::Atom(atom) => {
                let column = self.places.get(atom).map(|at| self.block.atoms.get(*at));
                *column.flatten().ok_or(*atom)?
            }
            Guard::Not(guard) => !self.guard(guard)?,
            Guard::And(parts) => {
                let mut all = Rows::ALL;
                for part in parts {
                    all = all & self.guard(part)?;
                }
                all
            }
            Guard::Or(parts) => {
                let mut any = Rows::NONE;
                for part in parts {
                    any = any | self.guard(part)?;
                }
                any
            }
        })
    }
}

/// Counts one more in these rows; `counts[n]` are the rows in which n were counted.
fn count(counts: &mut Vec<Rows>, rows: Rows) {
    counts.push(Rows::NONE);
    let mut carried = Rows::NONE;
    for those in counts {
        let next = *those & rows;
        *those = (*those & !rows) | carried;
        carried = next;
    }
}
