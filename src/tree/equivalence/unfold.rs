//! What a tree does in one tick, from given memory, as functions of everything that it may meet.

use super::MayEnd;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Composite, Decorator, Status};
use crate::tree::answers;
use crate::tree::circuit::{Circuit, Signal};
use crate::tree::compiled::{CompiledTree, Jump, Op, Placed};
use std::collections::{BTreeMap, BTreeSet};

/// What a tick meets: a signal for every atom, and for every behaviour whether it ends and whether it then fails. In
/// one tick a behaviour has one status, wherever it is ticked: nothing has moved in between.
pub(in crate::tree) struct Inputs {
    pub(in crate::tree) circuit: Circuit,
    /// The atoms, in the order of the trees' bits.
    pub(in crate::tree) atoms: Vec<Signal>,
    pub(in crate::tree) behaviors: BTreeMap<Id<Behavior>, [Signal; 2]>,
}

impl Inputs {
    /// When a behaviour has this status.
    pub(in crate::tree) fn status(&mut self, behavior: Id<Behavior>, status: Status) -> Signal {
        let circuit = &mut self.circuit;
        let [ends, fails] = *self
            .behaviors
            .entry(behavior)
            .or_insert_with(|| [circuit.input(), circuit.input()]);
        match status {
            Status::Running => !ends,
            Status::Success => circuit.and(ends, !fails),
            Status::Failure => circuit.and(ends, fails),
        }
    }

    /// Where behaviours are ticked at different times.
    pub(in crate::tree) fn differ(
        &mut self,
        [left, right]: [&BTreeMap<Id<Behavior>, Signal>; 2],
    ) -> Signal {
        let behaviors: BTreeSet<_> = left.keys().chain(right.keys()).collect();
        let when = |side: &BTreeMap<_, Signal>, behavior| {
            let when = side.get(behavior).copied();
            when.unwrap_or(Signal::FALSE)
        };
        let mut differ = Signal::FALSE;
        for behavior in behaviors {
            let (left, right) = (when(left, behavior), when(right, behavior));
            let parts = self.circuit.xor(left, right);
            differ = self.circuit.or(differ, parts);
        }
        differ
    }

    /// Where behaviours of two whole ticks are ticked at different times, each answering as it may.
    pub(in crate::tree) fn differ_at_all(
        &mut self,
        [left, right]: [&Unfolded; 2],
        may_end: MayEnd,
    ) -> Signal {
        let mut holds = vec![self.differ([&left.ticked, &right.ticked])];
        let behaviors: BTreeSet<_> = left.ticked.keys().chain(right.ticked.keys()).collect();
        for behavior in behaviors {
            for status in [Status::Success, Status::Failure] {
                if !may_end(*behavior, status) {
                    holds.push(!self.status(*behavior, status));
                }
            }
        }
        self.circuit.all(holds)
    }
}

/// The slots of a memory that are not 0.
type Slots = BTreeMap<usize, u64>;

/// How far a tick is followed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub(in crate::tree) struct Given {
    /// What has been ticked before, and what it answers: what is selected is what is ticked next.
    pub(in crate::tree) ended: Vec<(Id<Behavior>, Status)>,
    /// Whether all that is ticked after it is told as well.
    pub(in crate::tree) whole: bool,
}

/// A tick of a tree, from one memory.
#[derive(Default)]
pub(in crate::tree) struct Unfolded {
    /// When each behaviour is selected.
    pub(in crate::tree) selects: BTreeMap<Id<Behavior>, Signal>,
    /// When each behaviour is ticked at all, if the whole tick is followed.
    pub(in crate::tree) ticked: BTreeMap<Id<Behavior>, Signal>,
    /// The memories that the tick may leave, and when it does.
    pub(super) leaves: Vec<(Box<[u64]>, Signal)>,
}

/// Unfolds a tick from this memory.
pub(in crate::tree) fn unfold(
    tree: &CompiledTree,
    memory: &[u64],
    inputs: &mut Inputs,
    given: &Given,
) -> Unfolded {
    let mut tick = Tick {
        tree,
        memory,
        inputs,
        given,
        tests: vec![None; tree.tests.len()],
        selects: BTreeMap::new(),
        ticked: BTreeMap::new(),
    };
    let ways = tick.node(
        0,
        Reach {
            all: Signal::TRUE,
            fresh: Signal::TRUE,
        },
    );
    let (selects, ticked) = (tick.selects, tick.ticked);
    if tree.slots == 0 {
        return Unfolded {
            selects,
            ticked,
            leaves: vec![(Box::default(), Signal::TRUE)],
        };
    }
    let mut leaves: BTreeMap<Slots, Signal> = BTreeMap::new();
    for (way, when) in ways {
        let before = leaves.entry(way.left.slots).or_insert(Signal::FALSE);
        *before = inputs.circuit.or(*before, when);
    }
    let leaves = leaves.into_iter().map(|(slots, when)| {
        let slot = |slot| slots.get(&slot).copied().unwrap_or(0);
        ((0..tree.slots).map(slot).collect(), when)
    });
    Unfolded {
        selects,
        ticked,
        leaves: leaves.collect(),
    }
}

/// When a node is reached.
#[derive(Clone, Copy)]
struct Reach {
    all: Signal,
    /// … before the tick has selected any behaviour.
    fresh: Signal,
}

/// What a part of a tick leaves behind it.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
struct Left {
    /// Whether it ticked a behaviour.
    drove: bool,
    /// Whether it ticked one that is selected.
    selected: bool,
    slots: Slots,
}

impl Left {
    fn then(&self, next: &Self) -> Self {
        let mut slots = self.slots.clone();
        slots.extend(next.slots.iter().map(|(slot, value)| (*slot, *value)));
        Self {
            drove: self.drove || next.drove,
            selected: self.selected || next.selected,
            slots,
        }
    }
}

/// A way in which a node may be gone through.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Way {
    answer: Status,
    left: Left,
}

/// Ways, each with when it is taken.
type Ways = BTreeMap<Way, Signal>;

struct Tick<'a> {
    tree: &'a CompiledTree,
    memory: &'a [u64],
    inputs: &'a mut Inputs,
    given: &'a Given,
    /// The guards from each test on, as far as they were asked.
    tests: Vec<Option<Signal>>,
    selects: BTreeMap<Id<Behavior>, Signal>,
    ticked: BTreeMap<Id<Behavior>, Signal>,
}

impl Tick<'_> {
    fn node(&mut self, at: usize, reach: Reach) -> Ways {
        let Some(&placed) = self.tree.nodes.get(at) else {
            return Ways::new();
        };
        if reach.all == Signal::FALSE {
            return Ways::new();
        }
        match placed.op {
            Op::Condition(jump) => {
                let holds = self.guard(jump);
                let mut ways = Ways::new();
                for value in [true, false] {
                    let when = holds.negated_if(!value);
                    let when = self.inputs.circuit.and(reach.all, when);
                    self.take(&mut ways, answers::condition(value), Left::default(), when);
                }
                ways
            }
            Op::Behavior(behavior) => self.behavior(behavior, reach),
            Op::Composite {
                kind,
                memory: false,
            } => self.composite(at, placed, reach, kind, None),
            Op::Composite { kind, memory: true } => {
                let first = self.recall(placed);
                self.composite(at, placed, reach, kind, Some(first))
            }
            Op::Parallel { needed, children } => self.parallel(at, placed, reach, needed, children),
            Op::Decorator(kind) => self.decorator(at, placed, reach, kind),
        }
    }

    /// When the guard from here on holds.
    fn guard(&mut self, jump: Jump) -> Signal {
        let index = match jump {
            Jump::Answer(value) => return Signal::constant(value),
            Jump::Test(index) => index,
        };
        let Some(&test) = self.tree.tests.get(index) else {
            return Signal::FALSE;
        };
        if let Some(Some(signal)) = self.tests.get(index) {
            return *signal;
        }
        let literals = (0..64).filter(|bit| test.mask >> bit & 1 == 1).map(|bit| {
            let atom = self.inputs.atoms.get(test.word * 64 + bit);
            let atom = atom.copied().unwrap_or(Signal::FALSE);
            atom.negated_if(test.value >> bit & 1 == 0)
        });
        let holds = self.inputs.circuit.all(literals.collect::<Vec<_>>());
        let (yes, no) = (self.guard(test.yes), self.guard(test.no));
        let signal = self.inputs.circuit.choose(holds, yes, no);
        if let Some(known) = self.tests.get_mut(index) {
            *known = Some(signal);
        }
        signal
    }

    fn behavior(&mut self, behavior: Id<Behavior>, reach: Reach) -> Ways {
        let mut ended = self.given.ended.iter();
        if let Some((_, answer)) = ended.find(|(ended, _)| *ended == behavior) {
            return self.has_ended(*answer, reach);
        }
        if self.given.whole {
            let ticked = self.ticked.entry(behavior).or_insert(Signal::FALSE);
            *ticked = self.inputs.circuit.or(*ticked, reach.all);
        }
        let selected = self.selects.entry(behavior).or_insert(Signal::FALSE);
        *selected = self.inputs.circuit.or(*selected, reach.fresh);
        let mut ways = Ways::new();
        // Without memory, what comes of behaviours leaves no trace.
        if self.tree.slots == 0 && !self.given.whole {
            return ways;
        }
        for answer in [Status::Success, Status::Failure, Status::Running] {
            let status = self.inputs.status(behavior, answer);
            let when = self.inputs.circuit.and(reach.all, status);
            let left = Left {
                drove: true,
                selected: true,
                slots: Slots::new(),
            };
            self.take(&mut ways, answer, left, when);
        }
        ways
    }

    /// A behaviour whose answer is given, which is not selected.
    fn has_ended(&mut self, answer: Status, reach: Reach) -> Ways {
        let mut ways = Ways::new();
        let left = Left {
            drove: true,
            ..Left::default()
        };
        self.take(&mut ways, answer, left, reach.all);
        ways
    }

    /// A selector or sequence; `first` is the offset of the child that one with memory resumes at.
    fn composite(
        &mut self,
        at: usize,
        placed: Placed,
        reach: Reach,
        kind: Composite,
        first: Option<u64>,
    ) -> Ways {
        let goes_on = answers::goes_on(kind);
        let mut ways = Ways::new();
        let mut child = at + 1 + first.unwrap_or(0) as usize;
        let mut open = BTreeMap::from([(Left::default(), reach.all)]);
        while child < placed.end {
            let after = self.after(child);
            let mut next = BTreeMap::new();
            for (before, when) in open {
                for (way, when) in self.child(child, &before, when, reach) {
                    let mut left = before.then(&way.left);
                    let stands = match way.answer {
                        Status::Running => Some(child),
                        // What is left sees the termination before the next child is ticked.
                        answer if answer == goes_on && way.left.drove && after < placed.end => {
                            Some(after)
                        }
                        _ => None,
                    };
                    match stands.filter(|_| first.is_some()) {
                        Some(child) => {
                            remember(&mut left, placed, (child - at - 1) as u64);
                            self.take(&mut ways, Status::Running, left, when);
                        }
                        None if way.answer == goes_on && after < placed.end => {
                            self.join(&mut next, left, when);
                        }
                        None => self.take(&mut ways, way.answer, left, when),
                    }
                }
            }
            open = next;
            child = after;
        }
        ways
    }

    fn parallel(
        &mut self,
        at: usize,
        placed: Placed,
        reach: Reach,
        needed: u32,
        children: u32,
    ) -> Ways {
        let mut open = BTreeMap::from([((0u32, 0u32, Left::default()), reach.all)]);
        let mut child = at + 1;
        while child < placed.end {
            let mut next = BTreeMap::new();
            for ((succeeded, failed, before), when) in open {
                for (way, when) in self.child(child, &before, when, reach) {
                    let left = before.then(&way.left);
                    let succeeded = succeeded + u32::from(way.answer == Status::Success);
                    let failed = failed + u32::from(way.answer == Status::Failure);
                    self.join(&mut next, (succeeded, failed, left), when);
                }
            }
            open = next;
            child = self.after(child);
        }
        let mut ways = Ways::new();
        for ((succeeded, failed, mut left), when) in open {
            let answer = answers::parallel(needed, children, succeeded, failed);
            if answer != Status::Running {
                // Children that were still running are halted.
                left.slots.clear();
            }
            self.take(&mut ways, answer, left, when);
        }
        ways
    }

    fn decorator(&mut self, at: usize, placed: Placed, reach: Reach, kind: Decorator) -> Ways {
        let count = self.recall(placed);
        let mut ways = Ways::new();
        if answers::is_over(kind, count) {
            self.take(&mut ways, Status::Failure, Left::default(), reach.all);
            return ways;
        }
        for (way, when) in self.node(at + 1, reach) {
            let mut left = way.left;
            let (answer, count) = answers::decorated(kind, count, way.answer);
            remember(&mut left, placed, count);
            self.take(&mut ways, answer, left, when);
        }
        ways
    }

    /// A child that is reached `when` the children before it have left this.
    fn child(&mut self, child: usize, before: &Left, when: Signal, reach: Reach) -> Ways {
        let fresh = match before.selected {
            true => Signal::FALSE,
            // Where nothing has been selected before, nothing has here: the gates of nested nodes stay those of flat ones.
            false if reach.fresh == reach.all => when,
            false => self.inputs.circuit.and(when, reach.fresh),
        };
        self.node(child, Reach { all: when, fresh })
    }

    fn take(&mut self, ways: &mut Ways, answer: Status, left: Left, when: Signal) {
        self.join(ways, Way { answer, left }, when);
    }

    fn join<K: Ord>(&mut self, all: &mut BTreeMap<K, Signal>, key: K, when: Signal) {
        if when != Signal::FALSE {
            let before = all.entry(key).or_insert(Signal::FALSE);
            *before = self.inputs.circuit.or(*before, when);
        }
    }

    fn after(&self, child: usize) -> usize {
        let placed = self.tree.nodes.get(child);
        placed.map_or(usize::MAX, |placed| placed.end)
    }

    fn recall(&self, placed: Placed) -> u64 {
        self.memory.get(placed.slots.0).copied().unwrap_or(0)
    }
}

fn remember(left: &mut Left, placed: Placed, value: u64) {
    if value > 0 {
        left.slots.insert(placed.slots.0, value);
    }
}
