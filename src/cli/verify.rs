//! `btc verify`

use super::files::File;
use super::report::{Format as Form, Reporter, tell};
use super::{Failure, files};
use crate::driver::load::Loaded;
use crate::driver::table::Format;
use crate::driver::table::Recorded;
use crate::driver::verify::{self, Proved};
use crate::facade::Answer;
use crate::report::verdict::{self, Told};
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program.
    file: String,
    /// Two trees to compare, or a tree and a policy table (`.csv`, `.jsonl`, `.json`,
    /// `.yaml`, or `-` for standard input); without them,
    /// the claims of the program are proved.
    #[arg(value_name = "TREE", num_args = 0..=2)]
    sides: Vec<String>,
    /// How the policy table is written, if its ending and its first characters do not say.
    #[arg(long, value_name = "KIND")]
    from: Option<Format>,
    /// What the policy of the table does next: the two are compared along these transitions.
    #[arg(long, value_name = "FILE")]
    transitions: Option<String>,
    /// The minterms in which episodes start, if the transitions do not say.
    #[arg(long, value_name = "FILE", requires = "transitions")]
    start: Option<String>,
    /// How to write the answers.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Form,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let loaded = files::load(&arguments.file, say)?;
    let results = match arguments.sides.as_slice() {
        [tree, table] if is_table(table) || arguments.from.is_some() => {
            vec![with_table(&loaded, tree, table, arguments, say)?]
        }
        _ if arguments.transitions.is_some() => {
            tell("error: `--transitions` belongs to a policy table: name a tree and a table");
            return Err(Failure::Usage);
        }
        [] => verify::claims(&loaded).map_err(|refused| say.refused(&refused))?,
        [left, right] => {
            let result = verify::trees(&loaded, left, right);
            vec![result.map_err(|refused| say.refused(&refused))?]
        }
        _ => {
            tell(
                "error: one tree cannot be compared: name two, a tree and a table, or none to prove the claims",
            );
            return Err(Failure::Usage);
        }
    };
    match arguments.format {
        Form::Human => {
            for result in &results {
                files::print(&format!("{}\n", result.text))?;
            }
        }
        Form::Json => files::print(&verdict::json(&told(&loaded, arguments, &results)))?,
    }
    together(&results)
}

/// The answers with what they answer; of a program that claims nothing there are none.
fn told<'r>(loaded: &Loaded, arguments: &Arguments, results: &'r [Proved]) -> Vec<Told<'r>> {
    let asked: Vec<(String, bool)> = match arguments.sides.as_slice() {
        [left, right] => vec![(format!("claim {left} equals {right}"), true)],
        _ => verify::claimed(&loaded.program)
            .map(|(claim, there)| (claim.to_owned(), there))
            .collect(),
    };
    let told = asked.into_iter().zip(results);
    told.map(|((claim, there), result)| Told {
        claim,
        answer: there.then_some(result.answer),
        text: &result.text,
    })
    .collect()
}

/// What the answers say together: one that fails counts before one that is undecided.
pub(super) fn together(results: &[Proved]) -> Result<(), Failure> {
    let any = |answer| results.iter().any(|result| result.answer == answer);
    if any(Answer::Fails) {
        Err(Failure::Input)
    } else if any(Answer::Undecided) {
        Err(Failure::Undecided)
    } else {
        Ok(())
    }
}

/// Whether a side is the path of a table, and no tree.
fn is_table(side: &str) -> bool {
    let endings = [".csv", ".jsonl", ".ndjson", ".json", ".yaml", ".yml"];
    side == files::DASH || endings.iter().any(|ending| side.ends_with(ending))
}

fn with_table(
    loaded: &Loaded,
    tree: &str,
    table: &str,
    arguments: &Arguments,
    say: &Reporter,
) -> Result<Proved, Failure> {
    let table = files::read(table)?;
    let transitions = files::read_optional(arguments.transitions.as_deref())?;
    let start = files::read_optional(arguments.start.as_deref())?;
    let recorded = transitions.as_ref().map(|transitions| Recorded {
        transitions: transitions.text(),
        starts: start.as_ref().map(File::text),
    });
    let table = (table.text(), arguments.from);
    verify::table(loaded, tree, table, recorded).map_err(|refused| say.refused(&refused))
}
