//! Results on disk: whole, of one run, and there again when a run is stopped.

mod faults;
mod folders;
mod kills;
mod searches;
mod states;
mod writers;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SMALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/delivery_small.bt");

/// The options of a run that is over in a second.
const SHORT: [&str; 6] = ["--episodes", "100", "--roll-outs", "50", "--effort", "500k"];

/// The options of one that takes days.
const ENDLESS: [&str; 6] = [
    "--episodes",
    "100",
    "--roll-outs",
    "50",
    "--effort",
    "900000M",
];

fn btc(arguments: &[&str], at: &Path) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_btc"));
    command.args(arguments).current_dir(at);
    command.stdin(Stdio::null());
    command.stdout(Stdio::piped()).stderr(Stdio::piped());
    command
}

fn ran(arguments: &[&str], at: &Path) -> Output {
    btc(arguments, at).output().unwrap()
}

fn told(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A short run of learning in a folder that has the program `small.bt`.
fn learned(at: &Path, more: &[&str]) -> Output {
    let mut arguments = vec!["learn", "small.bt"];
    arguments.extend(SHORT);
    arguments.extend(more);
    ran(&arguments, at)
}

/// A folder with the program `small.bt`.
fn project() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::copy(SMALL, folder.path().join("small.bt")).unwrap();
    folder
}

/// The files of a folder, by name; what btc keeps there for itself is left out.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let entries = entries.map(|entry| entry.unwrap().path());
    entries
        .filter(|path| path.is_file())
        .map(|path| {
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            let bytes = fs::read(path).unwrap();
            (name, bytes)
        })
        .collect()
}

/// What btc keeps for itself in a folder.
fn leftovers(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let names = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap());
    names.filter(|name| name.starts_with(".btc-")).collect()
}
