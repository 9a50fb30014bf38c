//! Going on with one behaviour, tick after tick, while nothing happens that matters to whoever decides.

use super::simulation::{Simulation, Tick};
use crate::eval::{Fixed, run, status};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;

/// What came of going on with a behaviour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Gone {
    /// It has answered otherwise than that it runs, in a tick that has still to be ended.
    Answered(Status),
    /// It runs, and a tick has ended.
    Ended(Tick),
}

impl Simulation<'_> {
    /// Goes on with a behaviour alone, for at most so many ticks: until it answers otherwise than that it runs, or a tick ends that
    /// changes an atom or the course of things. `pays` is told of all ticks before that one. Also says how many ticks have begun.
    #[inline]
    pub fn go_on(
        &mut self,
        behavior: Id<Behavior>,
        most: u64,
        mut pays: impl FnMut(f64),
    ) -> (u64, Gone) {
        let from = self.now;
        let last = from.saturating_add(most).min(self.limit);
        let plain = self.is_plain();
        loop {
            if plain
                && self.now > from
                && let Some(answered) = self.run_on(behavior, last, &mut pays)
            {
                return (self.now - from, answered);
            }
            self.begin_tick();
            let status = self.act(behavior);
            if status != Status::Running {
                return (self.now - from, Gone::Answered(status));
            }
            if plain {
                self.go();
                let quiet = self.ends_quietly();
                if quiet && self.body.atoms == self.atoms && self.now < last {
                    pays(self.flow());
                    continue;
                }
                return (self.now - from, Gone::Ended(self.outcome(quiet)));
            }
            let before = self.atoms;
            let tick = self.end_tick();
            if self.atoms != before || tick.closed || tick.end.is_some() || self.now >= last {
                return (self.now - from, Gone::Ended(tick));
            }
            pays(tick.flow);
        }
    }

    /// Goes on with a behaviour that has run in the tick before, in which nothing has happened, in a plain world. None if that
    /// cannot be done in one go, and nothing has been done.
    #[inline]
    fn run_on(
        &mut self,
        behavior: Id<Behavior>,
        last: u64,
        pays: &mut impl FnMut(f64),
    ) -> Option<Gone> {
        let simulator = self.simulator;
        let routine = simulator.compiled.routines.get(behavior.index())?;
        let again = routine.again.as_ref()?;
        let since = self.instances.get(behavior.index())?.since;
        let gone = loop {
            self.now += 1;
            self.rest();
            if routine.timed {
                let elapsed = (self.now - since) as f64 * simulator.tick;
                self.registers.set(Fixed::Elapsed.register(), elapsed);
            }
            let answer = status(run(again, &mut self.registers, &mut self.body));
            if answer != Status::Running {
                self.terminate(behavior, answer);
                return Some(Gone::Answered(answer));
            }
            self.go();
            let quiet = self.ends_quietly();
            if !quiet || self.body.atoms != self.atoms || self.now >= last {
                break Gone::Ended(self.outcome(quiet));
            }
            pays(self.flow());
        };
        if let Some(instance) = self.instances.get_mut(behavior.index()) {
            instance.until = self.now + 1;
        }
        Some(gone)
    }

    /// Whether there is nothing in the world but the robot and what always stands, and nobody asks what runs.
    #[inline]
    fn is_plain(&self) -> bool {
        self.others.is_empty() && self.scene.is_none() && self.watched.is_empty()
    }
}
