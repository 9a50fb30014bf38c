//! `btc decanonicalize`

use super::files::File;
use super::progress::Progress;
use super::report::{Reporter, tell};
use super::{Failure, files, paths};
use crate::driver::decanonicalize::{self, Asked, Named, Options};
use crate::driver::table::Format;
use crate::driver::table::Recorded;
use crate::emit::form::TreeForm;
use crate::spelling;
use crate::tree::decanonicalise::{self, Method, Order};
use clap::Args;
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_long_help = FORMATS)]
pub(super) struct Arguments {
    /// The policy table: comma-separated, JSON Lines, or of another tool; `-` is standard input.
    file: String,
    /// How the policy is written, if its ending and its first characters do not say.
    #[arg(long, value_name = "KIND")]
    from: Option<Format>,
    /// The program whose names the table has: the tree is for its task, and a robot gets the leaves of its other trees.
    #[arg(long, value_name = "FILE")]
    program: Option<String>,
    /// What the policy does next, as `btc learn` writes it: memory is proved along these transitions.
    #[arg(long, value_name = "FILE", conflicts_with = "slack")]
    transitions: Option<String>,
    /// The minterms in which episodes start, if the transitions do not say.
    #[arg(long, value_name = "FILE", requires = "transitions")]
    start: Option<String>,
    /// Take decisions worth at most Q less where the tree gets smaller: it is then NOT equal to the table.
    #[arg(long, value_name = "Q", default_value_t = 0.0, value_parser = slack)]
    slack: f64,
    /// How the tree is found.
    #[arg(long, value_name = "METHOD", default_value = "search")]
    method: Method,
    /// In which order behaviours stand in the tree.
    ///
    /// A table gives the order of its columns of values, or else that in which its rows name the behaviours.
    #[arg(long, value_name = "ORDER", default_value = "learned")]
    order: Order,
    /// How much work the search may take, in units of about a twentieth of a second; the tree is the same on every machine.
    ///
    /// Work is counted, not timed. A tree is found whatever the effort; `--report` says what it left unfinished.
    #[arg(long, value_name = "N", default_value_t = decanonicalise::Options::default().effort)]
    effort: u64,
    /// The name of the tree.
    #[arg(long, value_name = "NAME", default_value = "learned", value_parser = name)]
    name: String,
    /// The form to write.
    #[arg(long, value_name = "FORM", default_value = "bt")]
    emit: TreeForm,
    /// The file to write to instead of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Report on standard error what was read, found and proved.
    #[arg(long)]
    report: bool,
}

const FORMATS: &str = "\
Tables: a column for each predicate with 0, 1, or - for either; one for what is done, called behavior, behaviour or \
action; if known, visits, q_gap, and q:NAME with the value of each behaviour. done(NAME) and failed(NAME) ask the \
history. Rows that say the same are merged. A row may allow several behaviours, go|dock: the tree takes one of them.

Columns of numbers and words say so in the header: x:number, x:number m with a unit, mode:{a,b} with the values. The
tree asks comparisons, which are printed above it: predicate x_at_most_3 = x <= 3.

Other tools: controllers of dtControl, schedulers that Storm exports as JSON, policies of refine-plan in YAML.

JSON Lines: an object a line with the same names as keys. A predicate is 0, 1, false, true, or \"-\" or null for \
either; several behaviours are a list of names; values may stand in an object under q:
  {\"low\": true, \"near\": null, \"behavior\": \"dock\", \"visits\": 12, \"q\": {\"dock\": 1.5, \"wander\": 0.2}}";

fn slack(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(slack) if slack >= 0.0 && f64::is_finite(slack) => Ok(slack),
        _ => Err("slack is a value that may be lost, such as 0.05".to_owned()),
    }
}

fn name(text: &str) -> Result<String, String> {
    let name = spelling::bare(text);
    let why = spelling::unusable(name);
    why.map_or_else(|| Ok(name.to_owned()), |why| Err(why.to_owned()))
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let options = Options {
        method: arguments.method,
        order: arguments.order,
        effort: arguments.effort,
        slack: arguments.slack,
        from: arguments.from,
        name: &arguments.name,
        form: arguments.emit,
    };
    files::apart(
        &[arguments.output.as_deref()],
        &[
            Some(&arguments.file),
            arguments.program.as_deref(),
            arguments.transitions.as_deref(),
            arguments.start.as_deref(),
        ],
    )?;
    let bar = Progress::new();
    bar.stage("reading");
    let program = arguments.program.as_deref();
    let loaded = program.map(|path| files::load(path, say)).transpose()?;
    let path = match program {
        Some(path) => paths::used_by(arguments.output.as_deref(), path)?,
        None => None,
    };
    let named = loaded.as_ref().map(|loaded| Named {
        loaded,
        path: path.as_deref(),
    });
    let asked = read(arguments, named, &options, say)?;
    bar.stage("finding a tree");
    let made = decanonicalize::decanonicalize(asked, &options);
    bar.finish();
    let made = made.map_err(|refused| say.refused(&refused))?;
    files::put(arguments.output.as_deref(), &made.text)?;
    made.warnings.iter().for_each(|line| tell(line));
    if arguments.report {
        made.report.iter().for_each(|line| tell(line));
    }
    Ok(())
}

/// Reads the tables. Their texts are dropped as this function ends.
fn read<'l>(
    arguments: &Arguments,
    named: Option<Named<'l>>,
    options: &Options,
    say: &Reporter,
) -> Result<Asked<'l>, Failure> {
    let table = files::read(&arguments.file)?;
    let transitions = files::read_optional(arguments.transitions.as_deref())?;
    let start = files::read_optional(arguments.start.as_deref())?;
    let recorded = transitions.as_ref().map(|transitions| Recorded {
        transitions: transitions.text(),
        starts: start.as_ref().map(File::text),
    });
    decanonicalize::read(table.text(), recorded, named, options)
        .map_err(|refused| say.refused(&refused))
}
