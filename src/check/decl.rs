//! What a program declares: states, events with their effects, predicates, behaviours.

pub mod behavior;
pub mod dynamics;
pub mod instance;
pub mod predicate;
pub mod statement;
