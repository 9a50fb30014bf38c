//! Searches for better values that are stopped.

use super::{btc, files, leftovers, ran, told};
use crate::tune::small;
use btc::random::Random;
use std::fs;
use std::time::Duration;

const SEARCH: [&str; 8] = [
    "tune", "tuned.bt", "--tree", "expert", "--effort", "2M", "--format", "json",
];

/// A folder with a program that has a number to tune.
fn project() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let text = small("tune(18%, 10% .. 20%)");
    fs::write(folder.path().join("tuned.bt"), text).unwrap();
    folder
}

/// Kills searches after random times, and goes on until one ends.
fn killed(rounds: u64, seed: u64) {
    let folder = project();
    let at = folder.path();
    let whole = ran(&[&SEARCH[..], &["-o", "whole"]].concat(), at);
    assert!(whole.status.success(), "{}", told(&whole));
    let mut random = Random::new(seed, 0, 0);
    for _ in 0..rounds {
        let _ = fs::remove_dir_all(at.join("out"));
        let mut longest = 50_000;
        loop {
            let more = ["-o", "out", "--checkpoint", "0s", "--resume"];
            let mut run = btc(&[&SEARCH[..], &more].concat(), at).spawn().unwrap();
            std::thread::sleep(Duration::from_micros(random.below(longest)));
            longest += longest / 3;
            let ended = run.try_wait().unwrap().is_some();
            run.kill().unwrap();
            let output = run.wait_with_output().unwrap();
            if ended {
                assert_eq!(output.stdout, whole.stdout, "{}", told(&output));
                assert_eq!(files(&at.join("out")), files(&at.join("whole")));
                break;
            }
            // It may have been killed on its way out, with all of its results in place.
            let left = files(&at.join("out"));
            assert!(left.is_empty() || left == files(&at.join("whole")));
        }
        assert!(leftovers(at).is_empty(), "{:?}", leftovers(at));
        assert!(leftovers(&at.join("out")).is_empty());
    }
}

#[test]
fn a_killed_search_goes_on_to_the_same_bytes() {
    killed(2, 1);
}

#[test]
#[ignore = "takes minutes"]
fn searches_killed_again_and_again() {
    killed(20, 2);
}

#[test]
fn a_search_goes_on_only_where_it_has_a_folder() {
    let folder = project();
    let output = ran(&[&SEARCH[..], &["--resume"]].concat(), folder.path());
    assert_eq!(output.status.code(), Some(2), "{}", told(&output));
    assert!(told(&output).contains("`-o`"), "{}", told(&output));
}
