//! Expressions and control laws, compiled once to a register code that one loop runs.
//!
//! A [`Layout`] gives each state, local, reading and constant of a program its register; a [`Compiler`] turns
//! expressions and statements into [`Code`]; [`run`] runs it against a [`Host`], the world. Nothing is looked up by
//! name and nothing is allocated while code runs.
//!
//! A value is computed where it is first needed, once on each path: the pool's shared nodes are shared registers, and
//! what only one branch reads is computed in that branch.
//!
//! Code that has run often is compiled once more, to machine code of the processor ([`compile`]). It gives the same results, bit
//! by bit: a property test holds both against a naive reading.
//!
//! Arithmetic is that of IEEE 754: 1 / 0 is infinite, 0 / 0 is NaN. A comparison with NaN is false; a robot commanded to
//! drive at NaN stands still.

mod actions;
mod code;
mod compiler;
mod condition;
mod fold;
mod layout;
mod machine;
mod memo;
#[cfg(feature = "native")]
mod native;
mod statement;
#[cfg(feature = "native")]
mod translate;
mod value;

pub use code::{Code, Instruction, Op, Register};
pub use compiler::{Compiler, Label, TooLarge};
pub use fold::Folding;
pub use layout::{Fixed, Layout, Source};
pub use machine::{Host, Reading, Registers, run};
#[cfg(feature = "native")]
pub use native::compile;
pub use statement::status;

/// Without Cranelift nothing is compiled for the processor.
#[cfg(not(feature = "native"))]
pub fn compile<'c>(_: impl Iterator<Item = &'c Code>) -> bool {
    false
}
