//! `btc learn`

use super::checkpoints::{self, Checkpoints};
use super::files::{self, DASH};
use super::progress::Progress;
use super::report::{Reporter, tell};
use super::store::checkpoint::Run;
use super::store::{Checkpoint, Folder, System};
use super::{Failure, PLAYED, effort, interrupt, paths};
use crate::checkpoint::Forgetful;
use crate::diagnostic::render;
use crate::driver::learn::{self, Learned, Options, Shape};
use crate::driver::load::Loaded;
use crate::driver::tune::Outcome;
use crate::driver::{target, tune, verify};
use crate::grow::Choice;
use crate::tree::decanonicalise::{Care, Method};
use clap::{Args, ValueEnum};
use std::collections::BTreeMap;
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
    /// The number of runs, with this seed and those that follow it; the best by validation is taken. By default one, and
    /// before a search for a grown tree up to two more, if they take a small part of its effort.
    #[arg(long, value_name = "K", value_parser = clap::value_parser!(u64).range(1..=1000))]
    seeds: Option<u64>,
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
    /// List the grown trees that none beats in both nodes and return, with the one that is taken, which was chosen by more
    /// episodes; `front.svg` shows them.
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
    /// The number of episodes that test the tree: 1000 where `--seeds` asks for several, else none.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u64).range(0..=PLAYED))]
    tests: Option<u64>,
    /// Write the whole report, and not only its five lines on the tree.
    #[arg(long)]
    report: bool,
    #[command(flatten)]
    checkpoints: Checkpoints,
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

pub(super) fn run(arguments: &Arguments, say: &Reporter) -> Result<(), Failure> {
    if arguments.file == DASH {
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
    let place = match &arguments.output {
        Some(folder) => folder.clone(),
        None => {
            let name = Path::new(&arguments.file).file_stem().unwrap_or_default();
            PathBuf::from(format!("{}.learned", name.to_string_lossy()))
        }
    };
    // Whether the results can be written shows before hours of learning; a run that is refused or killed leaves no folder.
    let folder = Folder::new(&place);
    let missing = folder.missing();
    let whole = interrupt::uninterrupted(|| folder.probe(&System, &learn::NAMES))
        .map_err(|error| files::complain(&error.to_string()))?;
    let source = paths::used_from(&whole, Path::new(&arguments.file))?;
    let program = paths::program_of(&loaded, &whole)?;
    if let Some(own) = learn::NAMES
        .iter()
        .find(|name| program.contains_key(**name))
    {
        let message = format!(
            "`{own}` there is part of the program itself, and would be overwritten; name another folder with `-o`"
        );
        return Err(files::complain(&format!("{}: {message}", place.display())));
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
        tests: arguments.tests.unwrap_or(match arguments.seeds {
            Some(2..) => 1000,
            _ => 0,
        }),
        source: &source,
        keeper: &Forgetful,
    };
    let mut checkpoint = Checkpoint::new(
        &System,
        &whole,
        run_of(&options, arguments.tune, &program),
        arguments.checkpoints.every(),
        interrupt::guard,
    );
    arguments.checkpoints.begin(&mut checkpoint, &place)?;
    let options = Options {
        keeper: &checkpoint,
        ..options
    };
    let made = make(&loaded, &options, arguments.tune, say);
    let (learned, tuned) = checkpoints::settle(made, &checkpoint, &missing)?;
    let files = learned
        .files
        .iter()
        .map(|(name, text)| ((*name).to_owned(), text.clone()));
    let more = tuned.iter().flat_map(tuned_files);
    let written = files::write_all(&folder, &files.chain(more).collect::<Vec<_>>(), program);
    // Whoever reads this may have gone: all is written. What could not be written is printed at least.
    let printed = files::print(&learned.text);
    if written.is_err() && checkpoint.is_up_to_date() {
        tell(
            "note: the run is kept: once its folder can be written, `--resume` writes the results",
        );
    }
    written?;
    let lines = match arguments.report {
        true => &learned.report,
        false => &learned.headline,
    };
    for line in lines {
        tell(line);
    }
    say.all(&loaded.sources, &learned.warnings);
    let tree = place.join("learned.bt");
    let claims = verify::claims_of_learned(&loaded, &learned, &tree.to_string_lossy())
        .map_err(|refused| say.refused(&refused))?;
    for claim in &claims {
        tell(&claim.text);
    }
    if let Some(tuned) = &tuned {
        tell(tuned.human.trim_end());
        if let Some(text) = &tuned.text {
            tell(text.trim_end());
        }
    }
    tell(&format!(
        "written to {}",
        render::on_one_line(&place.to_string_lossy())
    ));
    printed.and(super::verify::together(&claims))
}

/// Learns, and tunes what was learned if that is asked for. The tree that is written is that of the values in use.
fn make(
    loaded: &Loaded,
    options: &Options,
    tunes: bool,
    say: &Reporter,
) -> Result<(Learned, Option<Outcome>), Failure> {
    let bar = Progress::new();
    let learned = learn::learn(loaded, options, &|stage| bar.show(stage));
    bar.finish();
    let learned = learned.map_err(|refused| say.refused(&refused))?;
    if !tunes {
        return Ok((learned, None));
    }
    let bar = Progress::new();
    let search = tune::Options {
        keeper: options.keeper,
        ..tune::Options::default()
    };
    let tuned = tune::of_learned(loaded, &learned, options, &search, &|stage| bar.tune(stage));
    bar.finish();
    let tuned = tuned.map_err(|refused| say.refused(&refused))?;
    Ok((learned, Some(tuned)))
}

/// The files of a search for better values.
pub(super) fn tuned_files(tuned: &Outcome) -> impl Iterator<Item = (String, String)> {
    let report = ("tune.json".to_owned(), tuned.json.clone());
    std::iter::once(report).chain(tuned.pictures.iter().cloned())
}

/// All that the result depends on.
fn run_of(options: &Options, tunes: bool, program: &BTreeMap<String, String>) -> Run {
    let mut run = checkpoints::run_of("learn", program);
    let mut add = |name: &str, value: String| run.insert(name.to_owned(), value);
    add("--learner", options.learner.unwrap_or_default().to_owned());
    add(
        "--seed",
        options.seed.map_or(String::new(), |seed| seed.to_string()),
    );
    add(
        "--seeds",
        options.seeds.map_or(String::new(), |n| n.to_string()),
    );
    add(
        "--episodes",
        options.episodes.map_or(String::new(), |n| n.to_string()),
    );
    add("--evidence", options.evidence.to_string());
    add("--method", named(&options.method));
    add("--care", named(&options.care));
    add("--shape", named(&options.shape));
    add("the tree that is taken", format!("{:?}", options.choice));
    add("--front", options.front.to_string());
    add("--effort", options.effort.to_string());
    add("--roll-outs", options.roll_outs.to_string());
    add("--tests", options.tests.to_string());
    add("--tune", tunes.to_string());
    run
}

/// The value of an option as it is written.
fn named(value: &impl ValueEnum) -> String {
    let value = value.to_possible_value();
    value.map_or_else(String::new, |value| value.get_name().to_owned())
}
