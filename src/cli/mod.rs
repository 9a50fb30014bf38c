//! Arguments, files, progress, exit codes: one file per command.
//!
//! Results go to standard output, diagnostics and reports to standard error. Exit codes: 0 for success, 1 for a program
//! with mistakes or a refuted claim, 2 for a bad command line, 3 for a claim that is undecided, 128 and the number of the signal for a
//! run that a signal ended.

mod canonicalize;
mod check;
mod checkpoints;
mod compile;
mod completions;
mod decanonicalize;
mod diff;
mod explain;
mod files;
mod fmt;
mod interrupt;
mod learn;
mod lsp;
mod man;
mod minimize;
mod new;
mod paths;
mod progress;
mod report;
mod results;
mod run;
mod size;
pub mod store;
mod suggest;
mod test;
mod tune;
mod verify;

use clap::{CommandFactory, Parser, Subcommand};
use std::process::ExitCode;

/// The most episodes of one run: the figures of each are kept until the last has ended.
const PLAYED: u64 = 1_000_000;

/// The most threads.
const THREADS: i64 = 1024;

/// A compiler for behaviour trees that robots learn by themselves.
#[derive(Debug, Parser)]
#[command(name = "btc", version, max_term_width = 100)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
    /// Threads to use; the results are the same on any number.
    #[arg(long, global = true, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=THREADS))]
    threads: Option<u16>,
    /// A folder that programs may use files of, besides their own and the current one; it may be given several times.
    #[arg(long, global = true, value_name = "DIR")]
    root: Vec<std::path::PathBuf>,
    /// When to colour diagnostics.
    #[arg(long, global = true, value_name = "WHEN", default_value = "auto")]
    color: report::Color,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Start a project: a small world that learns, a test, a file for continuous integration.
    New(new::Arguments),
    /// Report every mistake of a program.
    Check(check::Arguments),
    /// Say what was built, or write it in another form.
    Compile(compile::Arguments),
    /// Learn a policy and print it as a proved tree.
    Learn(learn::Arguments),
    /// Turn a policy table of any origin into a proved tree.
    Decanonicalize(decanonicalize::Arguments),
    /// Turn a tree into its canonical form, or into its policy table.
    Canonicalize(canonicalize::Arguments),
    /// Run a tree or a policy in its world.
    Run(run::Arguments),
    /// Search for better values of the numbers that may be tuned.
    Tune(tune::Arguments),
    /// Look for a predicate that lets a learner learn a better tree.
    Suggest(suggest::Arguments),
    /// Prove two trees, or a tree and a policy table, equal, or show where they part.
    Verify(verify::Arguments),
    /// Say which decisions of a tree or a table have changed, each change under one condition.
    Diff(diff::Arguments),
    /// Run the tests of programs; learn again, and hold each tree against its snapshot.
    Test(test::Arguments),
    /// Say how large trees are.
    Size(size::Arguments),
    /// Minimise the covers of a PLA.
    Minimize(minimize::Arguments),
    /// Lay files out.
    Fmt(fmt::Arguments),
    /// Explain a diagnostic code.
    Explain(explain::Arguments),
    /// Answer an editor, by the Language Server Protocol over standard input and output.
    Lsp(lsp::Arguments),
    /// Print what makes a shell complete the words of a command.
    Completions(completions::Arguments),
    /// Write manual pages, one a command.
    Man(man::Arguments),
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

/// Why a command stops without its result. The reason stands on standard error already.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Failure {
    /// The input is wrong, or a claim does not hold.
    Input,
    /// The command line is wrong.
    Usage,
    /// No claim is refuted, but one is undecided.
    Undecided,
}

impl From<Failure> for ExitCode {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Input => ExitCode::from(1),
            Failure::Usage => ExitCode::from(2),
            Failure::Undecided => ExitCode::from(3),
        }
    }
}

/// Makes the threads: as many as are asked for, in the environment if not here, or one a processor. Where the system has none to
/// give, the one that there is does all.
fn use_threads(asked: Option<u16>) {
    let most = usize::try_from(THREADS).unwrap_or(usize::MAX);
    let named = || {
        std::env::var("RAYON_NUM_THREADS")
            .ok()?
            .parse::<usize>()
            .ok()
    };
    let threads = asked.map(usize::from).or_else(named).unwrap_or(0);
    let pool = |threads: usize| rayon::ThreadPoolBuilder::new().num_threads(threads.min(most));
    // Whether there are so many is tried before: there is one pool of the whole process, and no second try.
    let chosen = match pool(threads).build() {
        Ok(_) => pool(threads),
        Err(_) => pool(1).use_current_thread(),
    };
    // Fails only if there is one, and nothing has made it yet.
    let _ = chosen.build_global();
}

/// Runs the command of the process's arguments.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    use_threads(arguments.threads);
    interrupt::watch();
    results::allow(&arguments.root);
    let say = report::Reporter::new(arguments.color);
    let result = match arguments.command {
        Command::New(arguments) => new::run(&arguments),
        Command::Check(arguments) => check::run(&arguments, &say),
        Command::Compile(arguments) => compile::run(&arguments, &say),
        Command::Learn(arguments) => learn::run(&arguments, &say),
        Command::Decanonicalize(arguments) => decanonicalize::run(&arguments, &say),
        Command::Canonicalize(arguments) => canonicalize::run(&arguments, &say),
        Command::Run(arguments) => run::run(&arguments, &say),
        Command::Tune(arguments) => tune::run(&arguments, &say),
        Command::Suggest(arguments) => suggest::run(&arguments, &say),
        Command::Verify(arguments) => verify::run(&arguments, &say),
        Command::Diff(arguments) => diff::run(&arguments, &say),
        Command::Test(arguments) => test::run(&arguments, &say),
        Command::Size(arguments) => size::run(&arguments, &say),
        Command::Minimize(arguments) => minimize::run(&arguments, &say),
        Command::Fmt(arguments) => fmt::run(&arguments, &say),
        Command::Explain(arguments) => explain::run(&arguments),
        Command::Lsp(arguments) => lsp::run(&arguments),
        Command::Completions(arguments) => completions::run(&arguments, Arguments::command()),
        Command::Man(arguments) => man::run(&arguments, Arguments::command()),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => failure.into(),
    }
}
