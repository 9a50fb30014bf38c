//! `btc decanonicalize`

use super::progress::Progress;
use super::report::{Reporter, tell};
use super::{Failure, files};
use crate::driver::compile::Form;
use crate::driver::decanonicalize::{self, Options, Recorded};
use crate::driver::export::Runtime;
use crate::driver::table::Text;
use crate::tree::decanonicalise::{self, Method, Order};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(after_long_help = FORMATS)]
pub(super) struct Arguments {
    /// The policy table, comma-separated or JSON Lines; `-` is standard input.
    file: String,
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
    method: TreeMethod,
    /// In which order behaviours stand in the tree.
    #[arg(long, value_name = "ORDER", default_value = "learned")]
    order: UnitOrder,
    /// How much work the search may take, in millions of units; the tree is the same on every machine.
    #[arg(long, value_name = "N", default_value_t = decanonicalise::Options::default().effort)]
    effort: u64,
    /// The name of the tree.
    #[arg(long, value_name = "NAME", default_value = "learned", value_parser = name)]
    name: String,
    /// The form to write.
    #[arg(long, value_name = "FORM", default_value = "bt")]
    emit: Emit,
    /// The file to write to, in the place of standard output.
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say on standard error what was read, found and proved.
    #[arg(long)]
    report: bool,
}

const FORMATS: &str = "\
Tables: a column for each predicate with 0, 1, or - for either; one for what is done, called behavior, behaviour or \
action; if known, visits, q_gap, and q:NAME with the value of each behaviour. done(NAME) and failed(NAME) ask the \
history. Rows that say the same are merged.

JSON Lines: an object a line with the same names as keys. A predicate is 0, 1, false, true, or \"-\" or null for \
either; values may stand in an object under q:
  {\"low\": true, \"near\": null, \"behavior\": \"dock\", \"visits\": 12, \"q\": {\"dock\": 1.5, \"wander\": 0.2}}";

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TreeMethod {
    /// Algorithm 1 of the paper.
    Paper,
    /// The smallest tree that a search finds from there.
    Search,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum UnitOrder {
    /// As makes the tree smallest.
    Learned,
    /// As in the table: by their columns of values, else as they are met.
    Given,
    /// Those with the fewest rows first.
    Rarest,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Emit {
    /// A program that declares the names of the table.
    Bt,
    /// Graphviz.
    Dot,
    /// A picture.
    Svg,
    /// JSON.
    Json,
    /// XML for BehaviorTree.CPP 4, Groot2 and Nav2.
    Btcpp,
    /// A Python module for py_trees 2.
    #[value(name = "py_trees")]
    PyTrees,
}

fn slack(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(slack) if slack >= 0.0 && f64::is_finite(slack) => Ok(slack),
        _ => Err("slack is a value that may be lost, such as 0.05".to_owned()),
    }
}

fn name(text: &str) -> Result<String, String> {
    let name = text.trim_matches('`');
    if name.is_empty() || name.contains('`') || name.contains(char::is_control) {
        return Err("a name has no backquote, and stands on one line".to_owned());
    }
    Ok(name.to_owned())
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    let options = Options {
        method: match arguments.method {
            TreeMethod::Paper => Method::Paper,
            TreeMethod::Search => Method::Search,
        },
        order: match arguments.order {
            UnitOrder::Learned => Order::Learned,
            UnitOrder::Given => Order::Given,
            UnitOrder::Rarest => Order::Rarest,
        },
        effort: arguments.effort,
        slack: arguments.slack,
        name: &arguments.name,
        form: match arguments.emit {
            Emit::Bt => Form::Bt,
            Emit::Dot => Form::Dot,
            Emit::Svg => Form::Svg,
            Emit::Json => Form::Json,
            Emit::Btcpp => Form::Robot(Runtime::BtCpp),
            Emit::PyTrees => Form::Robot(Runtime::PyTrees),
        },
    };
    let bar = Progress::new();
    bar.stage("reading");
    let asked = read(arguments, &options, say)?;
    bar.stage("finding a tree");
    let made = decanonicalize::decanonicalize(asked, &options);
    bar.finish();
    let made = made.map_err(|refused| say.several(&refused.sources, &refused.diagnostics))?;
    files::put(arguments.output.as_deref(), &made.text)?;
    made.warnings.iter().for_each(|line| tell(line));
    if arguments.report {
        made.report.iter().for_each(|line| tell(line));
    }
    Ok(())
}

/// Reads the tables; their texts are dropped with the end of this function.
fn read(
    arguments: &Arguments,
    options: &Options,
    say: &Reporter,
) -> Result<decanonicalize::Asked, Failure> {
    let all = |path: &Option<String>| path.as_deref().map(files::read).transpose();
    let (name, bytes) = files::read(&arguments.file)?;
    let (transitions, start) = (all(&arguments.transitions)?, all(&arguments.start)?);
    let recorded = transitions.as_ref().map(|(name, bytes)| Recorded {
        transitions: Text { name, bytes },
        starts: start.as_ref().map(|(name, bytes)| Text { name, bytes }),
    });
    let table = Text {
        name: &name,
        bytes: &bytes,
    };
    decanonicalize::read(table, recorded, options)
        .map_err(|refused| say.several(&refused.sources, &refused.diagnostics))
}
