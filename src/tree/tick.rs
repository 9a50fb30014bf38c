//! Ticks.
//!
//! Each tick starts at the root. Selectors and sequences try their children from the left; those with memory resume at
//! the child that they had come to. What a tick does not reach starts over: the memory that a tick leaves is written
//! only by the nodes that it reached.

use super::answers;
use super::compiled::{CompiledTree, Jump, Op, Placed};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Composite, Decorator, Node, Status};

/// What a ticked tree asks and does.
pub trait Surroundings {
    /// Whether the bits of `mask` in this word of the valuation are those of `value`.
    fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool;
    /// Ticks a behaviour.
    fn behavior(&mut self, behavior: Id<Behavior>) -> Status;
    /// Is told what a node has answered, by the place of the node in pre-order.
    fn answered(&mut self, _node: usize, _status: Status) {}
}

/// A tree with its memory.
#[derive(Clone, Debug)]
pub struct Runner {
    tree: CompiledTree,
    now: Vec<u64>,
    next: Vec<u64>,
    settled: Option<Settled>,
}

/// A tick that is the next one as well, while the atoms and the behaviour's answer stay the same: it ticked this behaviour
/// alone, which runs, and left the memory as it was.
#[derive(Clone, Copy, Debug)]
struct Settled {
    key: u128,
    behavior: Id<Behavior>,
    /// The tree's answer.
    status: Status,
}

impl Runner {
    /// A tree with fresh memory. Bit i of the valuations that it is ticked with is the value of `atoms[i]`.
    ///
    /// # Errors
    /// An atom that a guard asks and that is not among `atoms`.
    pub fn new(root: &Node, atoms: &[Atom]) -> Result<Self, Atom> {
        let tree = CompiledTree::new(root, atoms)?;
        let memory = vec![0; tree.slots];
        Ok(Self {
            tree,
            now: memory.clone(),
            next: memory,
            settled: None,
        })
    }

    /// One tick in a valuation, atom 0 in the lowest bit of the first word; `leaf` ticks a behaviour.
    ///
    /// The behaviour that the tree selects is the first for which `leaf` is called.
    pub fn tick(&mut self, valuation: &[u64], leaf: impl FnMut(Id<Behavior>) -> Status) -> Status {
        struct Known<'a, F>(&'a [u64], F);
        impl<F: FnMut(Id<Behavior>) -> Status> Surroundings for Known<'_, F> {
            fn matches(&mut self, word: usize, mask: u64, value: u64) -> bool {
                self.0.get(word).copied().unwrap_or(0) & mask == value
            }
            fn behavior(&mut self, behavior: Id<Behavior>) -> Status {
                (self.1)(behavior)
            }
        }
        self.tick_in(&mut Known(valuation, leaf))
    }

    /// The behaviour that the tree selects in a valuation, its memory fresh.
    pub fn select(&mut self, valuation: &[u64]) -> Option<Id<Behavior>> {
        let mut selected = None;
        self.reset();
        self.tick(valuation, |behavior| {
            selected = selected.or(Some(behavior));
            Status::Running
        });
        selected
    }

    /// One tick in a valuation as the simulator keeps it: a key of at most 128 atoms. The tree is not walked again where
    /// that would lead to the same behaviour.
    pub fn tick_key(&mut self, key: u128, mut leaf: impl FnMut(Id<Behavior>) -> Status) -> Status {
        if let Some(settled) = self.settled
            && settled.key == key
        {
            return match leaf(settled.behavior) {
                Status::Running => settled.status,
                answer => self.answered(key, answer, leaf),
            };
        }
        self.walk(key, None, leaf)
    }

    /// The behaviour that a tick in this valuation would tick alone, and go on ticking while it runs.
    #[inline]
    pub fn settled(&self, key: u128) -> Option<Id<Behavior>> {
        let settled = self.settled.filter(|settled| settled.key == key);
        settled.map(|settled| settled.behavior)
    }

    /// A tick in which the behaviour that [`Runner::settled`] names has been ticked already, and has answered otherwise than
    /// that it runs.
    pub fn answered(
        &mut self,
        key: u128,
        answer: Status,
        leaf: impl FnMut(Id<Behavior>) -> Status,
    ) -> Status {
        self.walk(key, Some(answer), leaf)
    }

    /// Walks the tree; the first behaviour may have answered already.
    fn walk(
        &mut self,
        key: u128,
        mut answered: Option<Status>,
        mut leaf: impl FnMut(Id<Behavior>) -> Status,
    ) -> Status {
        let (mut ticked, mut last) = (0, None);
        let status = self.tick(&[key as u64, (key >> 64) as u64], |behavior| {
            let answer = answered.take().unwrap_or_else(|| leaf(behavior));
            (ticked, last) = (ticked + 1, Some((behavior, answer)));
            answer
        });
        if let Some((behavior, Status::Running)) = last
            && ticked == 1
            && self.now == self.next
        {
            self.settled = Some(Settled {
                key,
                behavior,
                status,
            });
        }
        status
    }

    /// One tick.
    pub fn tick_in(&mut self, surroundings: &mut impl Surroundings) -> Status {
        self.settled = None;
        if !self.next.is_empty() {
            self.next.fill(0);
        }
        let mut tick = Tick {
            tree: &self.tree,
            now: &self.now,
            next: &mut self.next,
            ticked: 0,
            surroundings,
        };
        let status = tick.node(0);
        std::mem::swap(&mut self.now, &mut self.next);
        status
    }

    /// The memory of all nodes; zeros when fresh.
    pub fn memory(&self) -> &[u64] {
        &self.now
    }

    /// Sets the memory to one that [`Runner::memory`] gave.
    pub fn resume(&mut self, memory: &[u64]) {
        self.settled = None;
        self.now.clear();
        self.now.extend_from_slice(memory);
    }

    /// Halts everything.
    pub fn reset(&mut self) {
        self.settled = None;
        self.now.fill(0);
    }
}

struct Tick<'a, S> {
    tree: &'a CompiledTree,
    now: &'a [u64],
    next: &'a mut [u64],
    /// How many behaviours this tick has ticked.
    ticked: u32,
    surroundings: &'a mut S,
}

impl<S: Surroundings> Tick<'_, S> {
    fn node(&mut self, at: usize) -> Status {
        let Some(&placed) = self.tree.nodes.get(at) else {
            return Status::Failure;
        };
        let status = match placed.op {
            Op::Condition(test) => answers::condition(self.condition(test)),
            Op::Behavior(behavior) => {
                self.ticked += 1;
                self.surroundings.behavior(behavior)
            }
            Op::Composite {
                kind,
                memory: false,
            } => self.reactive(at, placed, kind),
            Op::Composite { kind, memory: true } => self.resuming(at, placed, kind),
            Op::Parallel { needed, children } => self.parallel(at, placed, needed, children),
            Op::Decorator(kind) => self.decorator(at, placed, kind),
        };
        self.surroundings.answered(at, status);
        status
    }

    fn condition(&mut self, mut at: Jump) -> bool {
        loop {
            match at {
                Jump::Answer(value) => return value,
                Jump::Test(index) => {
                    let Some(test) = self.tree.tests.get(index) else {
                        return false;
                    };
                    let holds = self.surroundings.matches(test.word, test.mask, test.value);
                    at = if holds { test.yes } else { test.no };
                }
            }
        }
    }

    fn reactive(&mut self, at: usize, placed: Placed, kind: Composite) -> Status {
        let goes_on = answers::goes_on(kind);
        let mut child = at + 1;
        while child < placed.end {
            let status = self.node(child);
            if status != goes_on {
                return status;
            }
            child = self.after(child);
        }
        goes_on
    }

    /// The memory is the offset of the child to resume at, behind the node.
    fn resuming(&mut self, at: usize, placed: Placed, kind: Composite) -> Status {
        let goes_on = answers::goes_on(kind);
        let mut child = at + 1 + self.recall(placed) as usize;
        while child < placed.end {
            let before = self.ticked;
            let status = self.node(child);
            if status == Status::Running {
                self.remember(placed, (child - at - 1) as u64);
                return Status::Running;
            }
            if status != goes_on {
                return status;
            }
            child = self.after(child);
            // What is left of this node sees the termination before the next child is ticked. A child that ticked no
            // behaviour has only answered, as a condition does.
            if self.ticked != before && child < placed.end {
                self.remember(placed, (child - at - 1) as u64);
                return Status::Running;
            }
        }
        goes_on
    }

    fn parallel(&mut self, at: usize, placed: Placed, needed: u32, children: u32) -> Status {
        let (mut succeeded, mut failed) = (0, 0);
        let mut child = at + 1;
        while child < placed.end {
            match self.node(child) {
                Status::Success => succeeded += 1,
                Status::Failure => failed += 1,
                Status::Running => {}
            }
            child = self.after(child);
        }
        let status = answers::parallel(needed, children, succeeded, failed);
        if status != Status::Running {
            // Children that were still running are halted.
            self.forget(placed);
        }
        status
    }

    fn decorator(&mut self, at: usize, placed: Placed, kind: Decorator) -> Status {
        let count = self.recall(placed);
        if answers::is_over(kind, count) {
            return Status::Failure;
        }
        let child = self.node(at + 1);
        let (status, count) = answers::decorated(kind, count, child);
        if count > 0 {
            self.remember(placed, count);
        }
        status
    }

    fn after(&self, child: usize) -> usize {
        self.tree
            .nodes
            .get(child)
            .map_or(usize::MAX, |placed| placed.end)
    }

    fn recall(&self, placed: Placed) -> u64 {
        self.now.get(placed.slots.0).copied().unwrap_or(0)
    }

    fn remember(&mut self, placed: Placed, value: u64) {
        if let Some(slot) = self.next.get_mut(placed.slots.0) {
            *slot = value;
        }
    }

    fn forget(&mut self, placed: Placed) {
        if let Some(slots) = self.next.get_mut(placed.slots.0..placed.slots.1) {
            slots.fill(0);
        }
    }
}
