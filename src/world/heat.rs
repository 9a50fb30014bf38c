//! When a world's code is worth compiling for the processor.

use super::build::Simulator;
use std::sync::atomic::{AtomicU64, Ordering};

/// After so many ticks the time that compiling takes is soon won back.
const WARM: u64 = 50_000;

/// How many ticks a world has run, up to the end of the last episode of each of its simulations.
#[derive(Debug, Default)]
pub(super) struct Heat(AtomicU64);

impl Clone for Heat {
    fn clone(&self) -> Self {
        Self(AtomicU64::new(self.0.load(Ordering::Relaxed)))
    }
}

impl Simulator {
    /// An episode is over after so many ticks.
    pub(super) fn warm(&self, ticks: u64) {
        let before = self.heat.0.fetch_add(ticks, Ordering::Relaxed);
        if before < WARM && before + ticks >= WARM {
            self.compile();
        }
    }

    /// Compiles the code of ticks for the processor, as happens by itself once it has run often. False where that cannot
    /// be done, and the code is interpreted: with the same results.
    pub fn compile(&self) -> bool {
        let scripts = self.others.iter().map(|script| &script.predicates);
        crate::eval::compile(self.compiled.codes().chain(scripts))
    }
}
