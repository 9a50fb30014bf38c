//! `btc size`

use super::report::Reporter;
use super::{Failure, files};
use crate::driver::size;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The trees; all of the program if none is named.
    ///
    /// A row says how many nodes a tree has when drawn, how many literals stand in its guards, how deep it is, and how
    /// many different leaves it has: the behaviours that it ticks and the predicates that it asks, negated or not.
    #[arg(value_name = "TREE")]
    trees: Vec<String>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let text = size::sizes(&loaded, &arguments.trees).map_err(|refused| say.refused(&refused))?;
    files::print(&text)
}
