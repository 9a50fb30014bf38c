//! `btc minimize`

use super::report::{Reporter, tell};
use super::{Failure, files};
use crate::driver::minimize::{self, Options, Order};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The PLA, in the format of Berkeley Espresso; `-` is standard input.
    file: String,
    /// Make the outputs a decision list: of the rows that hold the first decides.
    #[arg(long, value_name = "ORDER")]
    order: Option<Order>,
    /// Minimise each output by itself, although together they may have fewer rows.
    #[arg(long, conflicts_with = "order")]
    separate: bool,
    /// The file to write to instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say how large the sets are before and after, as Espresso does.
    #[arg(short, long)]
    statistics: bool,
    /// The most cubes that the complement of an output may have, where the file does not say where it is 0.
    #[arg(long, value_name = "CUBES", default_value_t = 100_000)]
    limit: usize,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    files::apart(&[arguments.output.as_deref()], &[Some(&arguments.file)])?;
    let file = files::read(&arguments.file)?;
    let options = Options {
        order: arguments.order,
        limit: arguments.limit,
        separate: arguments.separate,
    };
    let minimized =
        minimize::minimize(file.text(), &options).map_err(|refused| say.refused(&refused))?;
    if arguments.statistics {
        tell(minimized.statistics.trim_end());
    }
    files::put(arguments.output.as_deref(), &minimized.text)
}
