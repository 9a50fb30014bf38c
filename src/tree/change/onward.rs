//! What comes next otherwise within a tick in which two trees select the same: a condition for each pair of behaviours.

use super::{Change, beyond, together};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Exclusion, Node, Status};
use crate::tree::atoms::atoms;
use crate::tree::canonicalise::{LITERALS, shorten};
use crate::tree::circuit::guards::Guards;
use crate::tree::circuit::sat::Solver;
use crate::tree::circuit::{Circuit, Signal};
use crate::tree::compiled::CompiledTree;
use crate::tree::equivalence::unfold::{Given, Inputs, Unfolded, unfold};
use crate::tree::equivalence::{ANSWERS, MayEnd};
use std::collections::{BTreeMap, BTreeSet};

/// The most changes that a reader is told.
const CHANGES: usize = 50;

/// The decisions that the solver may take for one question.
const DECISIONS: u64 = 100_000;

/// What `new` ticks next otherwise than `old` in ticks in which both have ticked the same until then, the first things first.
/// `None` where a tree has memory, or there is too much to tell.
pub fn onward(
    (old, new): (&Node, &Node),
    (history, excluded): (History, &[Exclusion]),
    may_end: MayEnd,
) -> Option<Vec<Change>> {
    let asked: BTreeSet<Atom> = [old, new].into_iter().flat_map(atoms).collect();
    let asked: Vec<Atom> = asked.into_iter().collect();
    let mut guards = Guards::new();
    let signals: Vec<Signal> = asked.iter().map(|atom| guards.atom(*atom)).collect();
    let tree = |root| {
        let tree = CompiledTree::new(root, &asked).ok();
        tree.filter(|tree| tree.slots == 0)
    };
    let trees = [tree(old)?, tree(new)?];
    let held = asked.iter().zip(&signals);
    // What the window does not remember never holds.
    let never = held
        .filter(|(atom, _)| atom.termination().is_some() && !history.remembers(**atom))
        .map(|(_, signal)| *signal);
    let mut free: Vec<Signal> = never.collect();
    free.push(beyond(&asked, history.window, &mut guards));
    free.push(together(excluded, &mut guards));
    let free = guards.circuit.any(free);
    let mut search = Search {
        inputs: Inputs {
            circuit: Circuit::new(),
            atoms: signals,
            behaviors: BTreeMap::new(),
        },
        guards,
        trees,
        free,
        may_end,
        solver: Solver::new(DECISIONS),
        changes: Vec::new(),
    };
    search.from(&mut Vec::new(), !free)?;
    Some(search.changes).filter(|changes| !changes.is_empty())
}

struct Search<'a> {
    guards: Guards,
    /// What a tick meets; its circuit is that of the guards while a tick is unfolded.
    inputs: Inputs,
    trees: [CompiledTree; 2],
    /// Where nothing is asked.
    free: Signal,
    may_end: MayEnd<'a>,
    solver: Solver,
    changes: Vec<Change>,
}

impl Search<'_> {
    /// Finds what changes `here`, where both trees have ticked these.
    fn from(&mut self, ended: &mut Vec<(Id<Behavior>, Status)>, here: Signal) -> Option<()> {
        let [old, new] = self.ticks(ended, false).map(|tick| self.next(&tick));
        for (was, before) in &old {
            for (is, after) in &new {
                let both = self.guards.circuit.all([here, *before, *after]);
                if self.guards.is_never(both) {
                    continue;
                }
                if was != is {
                    if self.changes.len() == CHANGES {
                        return None;
                    }
                    self.changes.push(Change {
                        when: shorten(both, self.free, LITERALS, &mut self.guards),
                        ended: ended.clone(),
                        old: *was,
                        new: *is,
                    });
                    continue;
                }
                let Some(behavior) = was else { continue };
                for answer in ANSWERS {
                    if !(self.may_end)(*behavior, answer) {
                        continue;
                    }
                    ended.push((*behavior, answer));
                    if self.part(ended, both)? {
                        self.from(ended, both)?;
                    }
                    ended.pop();
                }
            }
        }
        Some(())
    }

    /// Whether the trees tick different behaviours here, once they have ticked these; `None` if that is too much to find out.
    fn part(&mut self, ended: &[(Id<Behavior>, Status)], here: Signal) -> Option<bool> {
        let [old, new] = self.ticks(ended, true);
        let may_end = self.may_end;
        let differ = self.lent(|_, inputs| inputs.differ_at_all([&old, &new], may_end));
        let goal = self.guards.circuit.and(here, differ);
        let found = self.solver.can_hold(&self.guards.circuit, &[goal]);
        found.ok()
    }

    /// The tick of each tree, once these have been ticked.
    fn ticks(&mut self, ended: &[(Id<Behavior>, Status)], whole: bool) -> [Unfolded; 2] {
        let given = Given {
            ended: ended.to_vec(),
            whole,
        };
        self.lent(|trees, inputs| {
            trees
                .each_ref()
                .map(|tree| unfold(tree, &[], inputs, &given))
        })
    }

    /// Lends the circuit of the guards to the inputs.
    fn lent<T>(&mut self, ask: impl FnOnce(&[CompiledTree; 2], &mut Inputs) -> T) -> T {
        std::mem::swap(&mut self.guards.circuit, &mut self.inputs.circuit);
        let found = ask(&self.trees, &mut self.inputs);
        std::mem::swap(&mut self.guards.circuit, &mut self.inputs.circuit);
        found
    }

    /// When each behaviour comes next, and when none does.
    fn next(&mut self, tick: &Unfolded) -> Vec<(Option<Id<Behavior>>, Signal)> {
        let mut all: Vec<(Option<Id<Behavior>>, Signal)> = Vec::new();
        all.extend(
            tick.selects
                .iter()
                .map(|(behavior, when)| (Some(*behavior), *when)),
        );
        let any = self.guards.circuit.any(all.iter().map(|(_, when)| *when));
        all.push((None, !any));
        all
    }
}
