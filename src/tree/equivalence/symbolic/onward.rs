//! Whether two trees that select alike go on alike in a tick in which what they select fails.

use super::SymbolicSearch;
use super::pairs::{Memories, Pairs};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::tree::circuit::Signal;
use crate::tree::circuit::sat::Exhausted;
use crate::tree::equivalence::unfold::Unfolded;
use crate::tree::equivalence::{MayFail, Parted};
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// A behaviour that both trees may select and that may fail.
pub(super) struct Failing {
    behavior: Id<Behavior>,
    /// When both select it, and tick different behaviours next if it fails.
    differ: Signal,
    /// What each ticks next.
    sides: [Rc<Unfolded>; 2],
}

impl SymbolicSearch {
    /// The shortest way to a tick in which the trees go on differently. They have been found to select alike.
    pub(super) fn onward(&mut self, may_fail: MayFail) -> Result<Option<Parted>, Exhausted> {
        if self.reached.is_empty() {
            let fresh = self.pairs.fresh();
            for failing in self.pairs.failing(&fresh, may_fail) {
                if let Some(values) = self.at_once(failing.differ)? {
                    let trace = self.pairs.parted(Vec::new(), &failing.sides, &values);
                    let behavior = failing.behavior;
                    return Ok(Some(Parted { behavior, trace }));
                }
            }
            return Ok(None);
        }
        let mut known: FxHashMap<Memories, Rc<[Failing]>> = FxHashMap::default();
        for at in 0..self.reached.len() {
            let state = self.reached.get(at).ok_or(Exhausted)?.state.clone();
            let failing = known.entry(state.memories);
            let memories = failing.key().clone();
            let failing = failing.or_insert_with(|| self.pairs.failing(&memories, may_fail).into());
            for failing in Rc::clone(failing).iter() {
                let mut question = self.pairs.shows(&state.window);
                question.push(failing.differ);
                if self
                    .solver
                    .can_hold(&self.pairs.inputs.circuit, &question)?
                {
                    let trace = self.trace(at, failing.differ, &failing.sides)?;
                    let behavior = failing.behavior;
                    return Ok(Some(Parted { behavior, trace }));
                }
            }
        }
        Ok(None)
    }
}

impl Pairs {
    /// The behaviours after which the trees may go on differently from these memories, in which they select alike.
    fn failing(&mut self, memories: &Memories, may_fail: MayFail) -> Vec<Failing> {
        let pair = self.pair(memories);
        let [selecting, _] = &pair.sides;
        let [left, right] = memories;
        let mut found = Vec::new();
        for (behavior, selected) in &selecting.selects {
            if !may_fail(*behavior) {
                continue;
            }
            let fails = Some(*behavior);
            let sides = [self.unfold(0, left, fails), self.unfold(1, right, fails)];
            let differ = self.differ(&sides);
            let differ = self.inputs.circuit.and(*selected, differ);
            if differ != Signal::FALSE {
                found.push(Failing {
                    behavior: *behavior,
                    differ,
                    sides,
                });
            }
        }
        found
    }
}
