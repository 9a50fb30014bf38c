//! What a program declares: states, events with their effects, predicates, behaviours.

pub mod behavior;
mod drive;
pub mod event;
pub mod input;
mod instance;
mod law;
mod parameter;
pub mod predicate;
mod shared;
pub mod state;
mod statement;
