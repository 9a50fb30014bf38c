//! Whether two trees that select alike go on alike in the same tick.

use super::SymbolicSearch;
use super::pairs::{Memories, Pairs};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::tree::circuit::Signal;
use crate::tree::circuit::sat::Exhausted;
use crate::tree::equivalence::unfold::Given;
use crate::tree::equivalence::{ANSWERS, MayEnd, Parted, TraceTick};
use rustc_hash::FxHashMap;
use std::rc::Rc;

/// Where both trees select the same and may then go on differently.
pub(super) struct Joint {
    /// The behaviour that both select and what it answers, if they part in what comes next; else in what comes after that.
    ended: Option<(Id<Behavior>, Status)>,
    /// When they do.
    differ: Signal,
}

impl SymbolicSearch {
    /// The shortest way to a tick in which the trees go on differently. They have been found to select alike.
    pub(super) fn onward(&mut self, may_end: MayEnd) -> Result<Option<Parted>, Exhausted> {
        if self.reached.is_empty() {
            let fresh = self.pairs.fresh();
            for joint in self.pairs.joints(&fresh, may_end) {
                if let Some(values) = self.at_once(joint.differ, Pairs::all_inputs)? {
                    return Ok(self.pairs.apart(&fresh, &joint, (Vec::new(), values)));
                }
            }
            return Ok(None);
        }
        let mut known: FxHashMap<Memories, Rc<[Joint]>> = FxHashMap::default();
        for at in 0..self.reached.len() {
            let state = self.reached.get(at).ok_or(Exhausted)?.state.clone();
            let joints = known.entry(state.memories);
            let memories = joints.key().clone();
            let joints = joints.or_insert_with(|| self.pairs.joints(&memories, may_end).into());
            for joint in Rc::clone(joints).iter() {
                let mut question = self.pairs.shows(&state.window);
                question.push(joint.differ);
                if self
                    .solver
                    .can_hold(&self.pairs.inputs.circuit, &question)?
                {
                    let way = self.way(at, joint.differ)?;
                    return Ok(self.pairs.apart(&memories, joint, way));
                }
            }
        }
        Ok(None)
    }
}

impl Pairs {
    /// Where the trees may go on differently from these memories, in which they select alike: first in what comes next, by
    /// what comes of what they select, at last anywhere in the tick.
    fn joints(&mut self, memories: &Memories, may_end: MayEnd) -> Vec<Joint> {
        let pair = self.pair(memories);
        let [selecting, _] = &pair.sides;
        let mut found = Vec::new();
        for (behavior, selected) in &selecting.selects {
            for answer in ANSWERS {
                if !may_end(*behavior, answer) {
                    continue;
                }
                let ended = (*behavior, answer);
                let sides = self.both(memories, &next(&[ended]));
                let differ = self.differ(&sides);
                let differ = self.inputs.circuit.and(*selected, differ);
                found.push(Joint {
                    ended: Some(ended),
                    differ,
                });
            }
        }
        let whole = Given {
            ended: Vec::new(),
            whole: true,
        };
        let [left, right] = self.both(memories, &whole);
        let differ = self.inputs.differ_at_all([&left, &right], may_end);
        found.push(Joint {
            ended: None,
            differ,
        });
        found.retain(|joint| joint.differ != Signal::FALSE);
        found
    }

    /// The tick in which the trees go on differently, behind these steps and with these values of all inputs; `None` if they do
    /// not.
    fn apart(
        &mut self,
        memories: &Memories,
        joint: &Joint,
        (steps, values): (Vec<TraceTick>, Vec<bool>),
    ) -> Option<Parted> {
        let inputs = self.all_inputs();
        let mut ended: Vec<(Id<Behavior>, Status)> = joint.ended.into_iter().collect();
        loop {
            let sides = self.both(memories, &next(&ended));
            let [left, right] = sides
                .each_ref()
                .map(|side| self.selected(side, &inputs, &values));
            if left != right {
                let trace = self.parted(steps, &sides, &values);
                return Some(Parted { ended, trace });
            }
            let behavior = left?;
            let mut answers = ANSWERS.into_iter();
            let answer = answers.find(|answer| {
                let when = self.inputs.status(behavior, *answer);
                self.inputs.circuit.holds(when, &inputs, &values)
            })?;
            ended.push((behavior, answer));
        }
    }
}

/// What comes next once these have been ticked.
fn next(ended: &[(Id<Behavior>, Status)]) -> Given {
    Given {
        ended: ended.to_vec(),
        whole: false,
    }
}
