//! `btc learn`

use super::files::{self, STDIN};
use super::progress::Progress;
use super::report::{Reporter, tell};
use super::{Failure, PLAYED};
use crate::driver::learn::{self, Learned, Options, Shape};
use crate::driver::load::Loaded;
use crate::driver::{target, tune, verify};
use crate::grow::Choice;
use crate::tree::decanonicalise::{Care, Method};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The program.
    file: String,
    /// The folder for the results; `<program>.learned` if not given.
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
    /// The learner, if the program has several.
    #[arg(long, value_name = "NAME")]
    learner: Option<String>,
    /// The seed, instead of the program's.
    #[arg(long, value_name = "N")]
    seed: Option<u64>,
    /// The number of runs, with this seed and those that follow it; the best by validation is taken.
    #[arg(long, value_name = "K", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: u64,
    /// The number of episodes, instead of the program's.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(1..))]
    episodes: Option<u64>,
    /// How the tree is found.
    #[arg(long, value_name = "METHOD", default_value = "search")]
    method: Method,
    /// In which minterms the tree takes the policy's decisions.
    #[arg(long, value_name = "SET", default_value = "reachable")]
    care: Care,
    /// The tree that is wanted.
    #[arg(long, value_name = "SHAPE", default_value = "grown")]
    shape: Shape,
    /// List the grown trees that none beats in both nodes and return; `front.svg` shows them.
    #[arg(long)]
    front: bool,
    /// Take the best of the grown trees with at most this many nodes.
    #[arg(long, value_name = "N", conflicts_with = "loss", value_parser = clap::value_parser!(u64).range(1..))]
    nodes: Option<u64>,
    /// Take the smallest of the grown trees that costs at most this part of the best one's return, such as `1%`.
    #[arg(long, value_name = "LOSS", value_parser = loss)]
    loss: Option<f64>,
    /// About how many ticks the search for a tree may simulate, such as `60M`.
    #[arg(long, value_name = "TICKS", default_value = "60M", value_parser = effort)]
    effort: u64,
    /// The fewest decisions by which a minterm counts as learned; below, it is a don't-care.
    #[arg(long, value_name = "N", default_value_t = 10)]
    evidence: u64,
    /// The number of greedy episodes that show the transitions of the policy.
    #[arg(long, value_name = "N", default_value_t = 2000, value_parser = clap::value_parser!(u64).range(1..=PLAYED))]
    roll_outs: u64,
    /// The number of episodes that test the tree: 1000 with several seeds, else none.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(0..=PLAYED))]
    tests: Option<u64>,
    /// Write the whole report, and not only its five lines on the tree.
    #[arg(long)]
    report: bool,
    /// Then search for better values of the numbers that may be tuned, and learn again under them; see `btc tune`.
    #[arg(long)]
    tune: bool,
}

/// A part of a return: `1%` or `0.01`.
fn loss(text: &str) -> Result<f64, String> {
    let (digits, scale) = match text.strip_suffix('%') {
        Some(digits) => (digits, 100.0),
        None => (text, 1.0),
    };
    match digits.trim().parse::<f64>().map(|number| number / scale) {
        Ok(part) if (0.0..1.0).contains(&part) => Ok(part),
        _ => Err("a loss is a part of the return, such as `1%`".to_owned()),
    }
}

/// A number of ticks: `60M`, `500k` or `20_000_000`.
fn effort(text: &str) -> Result<u64, String> {
    let (digits, scale) = match text.strip_suffix(['M', 'm']) {
        Some(digits) => (digits, 1_000_000),
        None => match text.strip_suffix(['k', 'K']) {
            Some(digits) => (digits, 1000),
            None => (text, 1),
        },
    };
    let number = digits.replace('_', "").parse::<u64>().ok();
    let ticks = number.and_then(|number| number.checked_mul(scale));
    ticks.ok_or_else(|| "an effort is a number of ticks, such as `60M`".to_owned())
}

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    if arguments.file == STDIN {
        tell("error: a program is learned from its file, so that the result can use it");
        return Err(Failure::Usage);
    }
    let grows = arguments.front || arguments.nodes.is_some() || arguments.loss.is_some();
    if arguments.shape == Shape::Exact && grows {
        tell(
            "error: `--front`, `--nodes` and `--loss` choose among grown trees: leave out `--shape exact`",
        );
        return Err(Failure::Usage);
    }
    let loaded = files::load(&arguments.file, say)?;
    target::learner(&loaded, arguments.learner.as_deref())
        .map_err(|refused| say.refused(&refused))?;
    if arguments.tune {
        tune::something(&loaded).map_err(|refused| say.refused(&refused))?;
    }
    let folder = match &arguments.output {
        Some(folder) => folder.clone(),
        None => {
            let name = Path::new(&arguments.file).file_stem().unwrap_or_default();
            PathBuf::from(format!("{}.learned", name.to_string_lossy()))
        }
    };
    // Whether the results can be written shows before hours of learning; a run that is refused or killed leaves no folder.
    let found = folder.exists();
    files::make_folder(&folder)?;
    let source = files::from_folder(&folder, Path::new(&arguments.file));
    if !found {
        let _ = std::fs::remove_dir(&folder);
    }
    let source = source?;
    if source == "learned.bt" {
        let message =
            "is the program itself, and would be overwritten; name another folder with `-o`";
        return Err(files::complain(&format!("{}: {message}", arguments.file)));
    }
    let options = Options {
        learner: arguments.learner.as_deref(),
        seed: arguments.seed,
        seeds: arguments.seeds,
        episodes: arguments.episodes,
        evidence: arguments.evidence,
        method: arguments.method,
        care: arguments.care,
        shape: arguments.shape,
        choice: match (arguments.nodes, arguments.loss) {
            (Some(nodes), _) => Choice::Nodes(usize::try_from(nodes).unwrap_or(usize::MAX)),
            (None, Some(loss)) => Choice::Loss(loss),
            (None, None) => Choice::Knee,
        },
        front: arguments.front,
        effort: arguments.effort,
        roll_outs: arguments.roll_outs,
        tests: arguments
            .tests
            .unwrap_or(if arguments.seeds > 1 { 1000 } else { 0 }),
        source: &source,
    };
    let bar = Progress::new();
    let learned = learn::learn(&loaded, &options, &|stage| bar.show(stage));
    bar.finish();
    let learned = learned.map_err(|refused| say.refused(&refused))?;
    files::print(&learned.text)?;
    files::make_folder(&folder)?;
    for (name, text) in &learned.files {
        files::write(&folder.join(name), text)?;
    }
    let lines = match arguments.report {
        true => &learned.report,
        false => &learned.headline,
    };
    for line in lines {
        tell(line);
    }
    say.all(&loaded.sources, &learned.warnings);
    let claims =
        verify::claims_of_learned(&loaded, &learned).map_err(|refused| say.refused(&refused))?;
    for claim in &claims {
        tell(&claim.text);
    }
    if arguments.tune {
        tuned(&loaded, &learned, &options, &folder, say)?;
    }
    tell(&format!("written to {}", folder.display()));
    super::verify::verdict(&claims)
}

/// Tunes the tree that was learned. The program and the tree that were written stay those of the values in use.
fn tuned(
    loaded: &Loaded,
    learned: &Learned,
    options: &Options,
    folder: &Path,
    say: &Reporter,
) -> Result<(), Failure> {
    let bar = Progress::new();
    let search = tune::Options::default();
    let tuned = tune::of_learned(loaded, learned, options, &search, &|stage| match stage {
        tune::Stage::Learning(stage) => bar.show(stage),
        tune::Stage::Tuning(_) => bar.stage("tuning"),
    });
    bar.finish();
    let tuned = tuned.map_err(|refused| say.refused(&refused))?;
    tell(tuned.human.trim_end());
    if let Some(text) = &tuned.text {
        tell(text.trim_end());
    }
    files::write(&folder.join("tune.json"), &tuned.json)?;
    for (name, picture) in &tuned.pictures {
        files::write(&folder.join(name), picture)?;
    }
    Ok(())
}
