//! Text to syntax tree and back.

mod again;
mod cases;
mod printing;
mod total;
