//! `btc run`

use super::report::{Format, Reporter};
use super::{Failure, PLAYED, files};
use crate::driver::picture;
use crate::driver::run::{self, Subject};
use crate::driver::trace::{self, Step};
use clap::{Args, ValueEnum};
use std::path::PathBuf;

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("subject").args(["tree", "policy"]))]
pub(super) struct Arguments {
    /// The program; `-` is standard input.
    file: String,
    /// The tree to run; the only one of the program if neither a tree nor a policy is named.
    #[arg(long, value_name = "NAME")]
    tree: Option<String>,
    /// The policy to run, as `btc learn` writes it.
    #[arg(long, value_name = "FILE")]
    policy: Option<String>,
    /// How many episodes.
    #[arg(long, value_name = "N", default_value_t = 100, value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    episodes: u64,
    /// The seed of the episodes.
    #[arg(long, value_name = "N", default_value_t = 1)]
    seed: u64,
    /// Show for each node of the tree in how many ticks it was reached, succeeded and failed.
    #[arg(long, conflicts_with = "policy")]
    nodes: bool,
    /// How to write the figures.
    #[arg(long, value_name = "FORM", default_value = "human")]
    format: Format,
    /// Draw the world with the way of the robot in an episode, as SVG.
    #[arg(long, value_name = "FILE")]
    svg: Option<PathBuf>,
    /// Which episode to draw, and to trace from on.
    #[arg(long, value_name = "N", default_value_t = 0, value_parser = clap::value_parser!(u64).range(..PLAYED))]
    episode: u64,
    /// How many ticks of it to draw.
    #[arg(long, value_name = "N", default_value_t = 2_000, requires = "svg")]
    svg_ticks: u64,
    /// Write what was found, done and rewarded, a line for each decision, or for each behaviour that drives in it; `-` is standard output, then without the figures.
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// A line for each tick instead.
    #[arg(long, requires = "trace")]
    ticks: bool,
    /// How many episodes to trace.
    #[arg(long, value_name = "N", default_value_t = 1, requires = "trace", value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    trace_episodes: u64,
    /// How to write the trace; JSON Lines if the name of the file ends so, else CSV.
    #[arg(long, value_name = "FORM", requires = "trace")]
    trace_format: Option<TraceFormat>,
}

/// The forms of a trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum TraceFormat {
    /// Comma-separated values, with a header.
    Csv,
    /// JSON Lines: a document a line.
    Jsonl,
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    files::apart(
        &[arguments.svg.as_deref(), arguments.trace.as_deref()],
        &[Some(&arguments.file), arguments.policy.as_deref()],
    )?;
    let loaded = files::load(&arguments.file, say)?;
    let subject = match (&arguments.policy, &arguments.tree) {
        (Some(path), _) => Subject::policy(&loaded, files::read(path)?.text()),
        (None, Some(name)) => Subject::tree(&loaded, name),
        (None, None) => Subject::only_tree(&loaded),
    };
    let subject = subject.map_err(|refused| say.refused(&refused))?;
    let mut traced = None;
    if let Some(path) = &arguments.trace {
        let step = match arguments.ticks {
            true => Step::Tick,
            false => Step::Decision,
        };
        let episodes = arguments.trace_episodes;
        let first = arguments.episode;
        let episodes = first..first.saturating_add(episodes);
        let trace = trace::trace(&loaded, &subject, episodes, arguments.seed, step)
            .map_err(|refused| say.refused(&refused))?;
        let by_name = path.extension().filter(|end| *end == "jsonl");
        let by_name = by_name.map_or(TraceFormat::Csv, |_| TraceFormat::Jsonl);
        let text = match arguments.trace_format.unwrap_or(by_name) {
            TraceFormat::Csv => trace.csv(),
            TraceFormat::Jsonl => trace.json_lines(),
        };
        if path.as_os_str() == files::DASH {
            traced = Some(text);
        } else {
            files::write(path, &text)?;
        }
    }
    if let Some(path) = &arguments.svg {
        let picture = picture::draw(
            &loaded,
            &subject,
            (arguments.seed, arguments.episode),
            arguments.svg_ticks,
        )
        .map_err(|refused| say.refused(&refused))?;
        files::write(path, &picture)?;
    }
    if let Some(traced) = traced {
        return files::print(&traced);
    }
    let play = match arguments.nodes {
        true => run::counted,
        false => run::run,
    };
    let ran = play(&loaded, &subject, arguments.episodes, arguments.seed)
        .map_err(|refused| say.refused(&refused))?;
    match arguments.format {
        Format::Human => files::print(&ran.human()),
        Format::Json => files::print(&ran.json()),
    }
}
