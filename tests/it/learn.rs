//! Learning: the methods on processes whose values are known, exact solutions against naive ones, statistics against
//! printed values and `statrs`, and whole runs.

mod methods;
mod results;
mod runs;
mod solving;
mod statistics;
mod toys;
mod traps;
