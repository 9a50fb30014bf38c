//! Laws: what holds of every input, whatever its bytes.
//!
//! Each law is a function of bytes that panics where it is broken. The tests here hold them on cases, on inputs that are
//! made up and on the corpus of `fuzz/`; the fuzz targets there hold the same functions on what they find.

pub mod check;
pub mod format;
pub mod parse;
pub mod pla;
pub mod proof;
pub mod table;

pub(crate) mod build;
pub(crate) mod grown;
pub(crate) mod lockstep;
pub(crate) mod naive;
pub(crate) mod random;
