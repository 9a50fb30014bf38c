//! `btc verify`

use super::report::{Reporter, tell};
use super::{Failure, files};
use crate::driver::verify;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program.
    file: String,
    /// The two trees to compare; without them, the claims of the program are proved.
    #[arg(value_name = "TREE", num_args = 0..=2)]
    trees: Vec<String>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let results = match arguments.trees.as_slice() {
        [] => verify::claims(&loaded),
        [left, right] => verify::trees(&loaded, left, right).map(|result| vec![result]),
        _ => {
            tell("error: one tree cannot be compared: name two, or none to prove the claims");
            return Err(Failure::Usage);
        }
    };
    let results = results.map_err(|mistakes| say.several(&loaded.sources, &mistakes))?;
    for result in &results {
        files::print(&format!("{}\n", result.text))?;
    }
    if results.iter().all(|result| result.holds) {
        Ok(())
    } else {
        Err(Failure::Input)
    }
}
