//! `btc verify`

use super::report::{Reporter, tell};
use super::{Failure, files};
use crate::driver::load::Loaded;
use crate::driver::table::Text;
use crate::driver::verify::{self, Proved};
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program.
    file: String,
    /// Two trees to compare, or a tree and a policy table (`.csv`, `.jsonl`, or `-` for standard input); without them,
    /// the claims of the program are proved.
    #[arg(value_name = "TREE", num_args = 0..=2)]
    sides: Vec<String>,
    /// What the policy of the table does next: the two are compared along these transitions.
    #[arg(long, value_name = "FILE")]
    transitions: Option<String>,
    /// The minterms in which episodes start, if the transitions do not say.
    #[arg(long, value_name = "FILE", requires = "transitions")]
    start: Option<String>,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let results = match arguments.sides.as_slice() {
        [tree, table] if is_table(table) => vec![with_table(&loaded, tree, table, arguments, say)?],
        _ if arguments.transitions.is_some() => {
            tell("error: `--transitions` belongs to a policy table: name a tree and a table");
            return Err(Failure::Usage);
        }
        [] => {
            verify::claims(&loaded).map_err(|mistakes| say.several(&loaded.sources, &mistakes))?
        }
        [left, right] => {
            let result = verify::trees(&loaded, left, right);
            vec![result.map_err(|mistakes| say.several(&loaded.sources, &mistakes))?]
        }
        _ => {
            tell(
                "error: one tree cannot be compared: name two, a tree and a table, or none to prove the claims",
            );
            return Err(Failure::Usage);
        }
    };
    for result in &results {
        files::print(&format!("{}\n", result.text))?;
    }
    if results.iter().all(|result| result.holds) {
        Ok(())
    } else {
        Err(Failure::Input)
    }
}

/// Whether a side is the path of a table, and no tree.
fn is_table(side: &str) -> bool {
    let endings = [".csv", ".jsonl", ".ndjson"];
    side == files::STDIN || endings.iter().any(|ending| side.ends_with(ending))
}

fn with_table(
    loaded: &Loaded,
    tree: &str,
    table: &str,
    arguments: &Arguments,
    say: &Reporter,
) -> Result<Proved, Failure> {
    let all = |path: &Option<String>| path.as_deref().map(files::read).transpose();
    let table = files::read(table)?;
    let (transitions, start) = (all(&arguments.transitions)?, all(&arguments.start)?);
    let recorded = transitions
        .as_ref()
        .map(|file| (text(file), start.as_ref().map(text)));
    verify::table(loaded, tree, text(&table), recorded)
        .map_err(|refused| say.several(&refused.sources, &refused.diagnostics))
}

fn text((name, bytes): &(String, Vec<u8>)) -> Text<'_> {
    Text { name, bytes }
}
