//! Commands that write single files or whole projects, killed after random times: what they write is as it was before or as it
//! is after, and what a dead one has left is gone after the next.

use super::{btc, leftovers, project, ran, told};
use btc::random::Random;
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Duration;

/// All files in a folder and its folders, by path; what btc keeps there for itself is left out.
fn all(folder: &Path, found: &mut BTreeMap<String, Vec<u8>>) {
    for entry in fs::read_dir(folder).into_iter().flatten() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if name.starts_with(".btc-") {
            continue;
        }
        match path.is_dir() {
            true => {
                found.insert(format!("{}/", path.display()), Vec::new());
                all(&path, found);
            }
            false => drop(found.insert(path.display().to_string(), fs::read(&path).unwrap())),
        }
    }
}

fn state(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut found = BTreeMap::new();
    all(folder, &mut found);
    found
}

/// Kills a command `rounds` times, after longer and longer times. What it makes is taken away before each.
fn killed(text: &str, arguments: &[&str], rounds: u64) {
    let folder = project();
    let at = folder.path();
    let begin = || {
        for entry in fs::read_dir(at).unwrap() {
            let path = entry.unwrap().path();
            let name = path.file_name().unwrap().to_str().unwrap();
            match path.is_dir() {
                _ if name.starts_with(".btc-") => {}
                true => fs::remove_dir_all(&path).unwrap(),
                false => fs::remove_file(&path).unwrap(),
            }
        }
        fs::write(at.join("small.bt"), text).unwrap();
    };
    begin();
    let old = state(at);
    let whole = ran(arguments, at);
    assert!(whole.status.success(), "{arguments:?}: {}", told(&whole));
    let new = state(at);
    assert_ne!(old, new, "{arguments:?}");
    let mut random = Random::new(rounds, 0, 0);
    let mut longest = 4_000;
    for round in 0..rounds {
        begin();
        let mut run = btc(arguments, at).spawn().unwrap();
        std::thread::sleep(Duration::from_micros(random.below(longest)));
        run.kill().unwrap();
        run.wait().unwrap();
        let found = state(at);
        assert!(found == old || found == new, "{arguments:?}: {round}");
        // Up to what takes the command to its end, and then anew.
        longest = match found == new {
            true => 4_000,
            false => longest + longest / 3,
        };
    }
    // A process that another test starts holds all locks for a moment.
    for _ in 0..100 {
        begin();
        assert!(ran(arguments, at).status.success());
        if leftovers(at).is_empty() {
            break;
        }
    }
    assert_eq!(state(at), new);
    assert!(leftovers(at).is_empty(), "{:?}", leftovers(at));
}

/// The commands, each with the program that it is given.
fn commands() -> Vec<(String, Vec<&'static str>)> {
    let small = include_str!("../../../examples/delivery_small.bt");
    let tuned = crate::tune::small("tune(18%, 10% .. 20%)");
    vec![
        (small.replace("  ", " \t "), vec!["fmt", "small.bt"]),
        (
            small.replace(" and ", " && "),
            vec!["check", "--fix", "small.bt"],
        ),
        (small.to_owned(), vec!["new", "project"]),
        (
            small.to_owned(),
            vec![
                "compile", "small.bt", "--emit", "svg", "--tree", "expert", "-o", "tree.svg",
            ],
        ),
        (
            tuned,
            vec![
                "tune", "small.bt", "--tree", "expert", "--effort", "2M", "--fix",
            ],
        ),
    ]
}

#[test]
fn a_killed_command_leaves_the_old_or_the_new() {
    for (text, arguments) in commands() {
        killed(&text, &arguments, 6);
    }
}

#[test]
#[ignore = "takes minutes"]
fn commands_killed_again_and_again() {
    for (text, arguments) in commands() {
        killed(&text, &arguments, 100);
    }
    let small = fs::read_to_string(super::SMALL).unwrap();
    let accept = ["test", "--accept", "--shape", "exact", "small.bt"];
    killed(&small, &accept, 20);
}

/// A search takes long, and its user goes on writing.
#[test]
fn what_was_written_during_a_search_is_kept() {
    let folder = project();
    let at = folder.path();
    let text = crate::tune::small("tune(18%, 10% .. 20%)");
    fs::write(at.join("small.bt"), &text).unwrap();
    let search = [
        "tune",
        "small.bt",
        "--tree",
        "expert",
        "--effort",
        "2M",
        "--fix",
        "-o",
        "out",
        "--checkpoint",
        "0s",
    ];
    let mut run = btc(&search, at).spawn().unwrap();
    // The first state shows that the program was read.
    while !at.join("out/.btc-checkpoint").exists() && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    let edited = format!("{text}\n// Mine.\n");
    fs::write(at.join("small.bt"), &edited).unwrap();
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert!(
        told(&output).contains("small.bt: it has changed"),
        "{}",
        told(&output)
    );
    assert_eq!(fs::read_to_string(at.join("small.bt")).unwrap(), edited);
    assert!(at.join("out/tune.json").exists());
}
