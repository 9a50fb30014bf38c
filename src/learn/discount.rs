//! The discount of what follows a decision that took its time.

use crate::ir::task::Discount;
use serde::{Deserialize, Serialize};

/// A discount in a world of a given tick.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Discounting {
    /// How future reward counts.
    pub discount: Discount,
    /// The length of a tick in seconds.
    pub tick: f64,
}

impl Discounting {
    /// The factor on what a decision is still to bring after `ticks` ticks, while it is not complete.
    pub fn within(&self, ticks: u64) -> f64 {
        match self.discount {
            Discount::PerDecision(_) => 1.0,
            Discount::PerTime(..) => self.factor(ticks),
        }
    }

    /// The factor on all that follows a decision that took `ticks` ticks: γ, or γ^(t/T) in a semi-Markov process whose
    /// time counts (Sutton, Precup and Singh 1999).
    pub fn factor(&self, ticks: u64) -> f64 {
        match self.discount {
            Discount::PerDecision(factor) => factor,
            Discount::PerTime(factor, span) => {
                crate::math::pow(factor, ticks as f64 * self.tick / span)
            }
        }
    }
}
