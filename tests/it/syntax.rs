//! Text to syntax tree and back.

mod cases;
mod printing;
mod total;
