//! Runs that are killed at random moments.

use super::{ENDLESS, SHORT, btc, files, learned, leftovers, project, ran, told};
use btc::random::Random;
use std::fs;
use std::path::Path;
use std::process::Child;
use std::time::Duration;

fn begun(at: &Path, more: &[&str]) -> Child {
    let mut arguments = vec!["learn", "small.bt"];
    arguments.extend(SHORT);
    arguments.extend(more);
    btc(&arguments, at).spawn().unwrap()
}

/// Kills runs after random times, and goes on until one ends.
fn killed(kills: u64, seed: u64) {
    let folder = project();
    let at = folder.path();
    let other = ["--seed", "2", "-o", "out"];
    assert!(learned(at, &other).status.success());
    let old = files(&at.join("out"));
    let output = learned(at, &["-o", "whole"]);
    assert!(output.status.success(), "{}", told(&output));
    let new = files(&at.join("whole"));
    let mut random = Random::new(seed, 0, 0);
    let mut done = 0;
    while done < kills {
        // From an old result, one kill after another, until a run has gone through.
        fs::remove_dir_all(at.join("out")).unwrap();
        assert!(learned(at, &other).status.success());
        // The last step of a run takes its time: each run is given a little more.
        let mut longest = 100_000;
        loop {
            let mut run = begun(at, &["-o", "out", "--checkpoint", "3ms", "--resume"]);
            std::thread::sleep(Duration::from_micros(random.below(longest)));
            longest += longest / 4;
            let ended = run.try_wait().unwrap().is_some();
            run.kill().unwrap();
            run.wait().unwrap();
            done += u64::from(!ended);
            let found = files(&at.join("out"));
            assert!(found == old || found == new, "a mix after {done} kills");
            if ended {
                assert_eq!(found, new, "after {done} kills");
                break;
            }
        }
    }
    assert!(learned(at, &["-o", "out"]).status.success());
    assert!(leftovers(at).is_empty(), "{:?}", leftovers(at));
    assert!(leftovers(&at.join("out")).is_empty());
}

#[test]
fn a_killed_run_goes_on_to_the_same_bytes() {
    killed(4, 1);
}

#[test]
#[ignore = "takes minutes"]
fn two_hundred_killed_runs() {
    killed(200, 2);
}

#[test]
fn a_damaged_checkpoint_is_left_out() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "whole"]).status.success());
    let mut run = begun(at, &["-o", "out", "--checkpoint", "0s"]);
    let states = at.join("out/.btc-checkpoint");
    while !states.join("met.state").exists() && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    let unfinished = ran(&["verify", "out/learned.bt", "learned", "expert"], at);
    let said = told(&unfinished);
    assert!(said.contains("`--resume` goes on with it"), "{said}");
    for entry in fs::read_dir(&states).into_iter().flatten() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|ending| ending == "state") {
            let mut bytes = fs::read(&path).unwrap();
            let last = bytes.len() - 1;
            bytes[last] ^= 1;
            fs::write(&path, bytes).unwrap();
        }
    }
    let output = learned(at, &["-o", "out", "--resume"]);
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains("a part of the checkpoint is damaged"));
    assert_eq!(files(&at.join("out")), files(&at.join("whole")));
}

/// The state of one seed says nothing of another.
#[test]
fn a_state_of_another_part_is_left_out() {
    let folder = project();
    let at = folder.path();
    let two = ["--seeds", "2"];
    let whole = learned(at, &[&["-o", "whole"], &two[..]].concat());
    assert!(whole.status.success(), "{}", told(&whole));
    let mut run = begun(
        at,
        &[&["-o", "out", "--checkpoint", "0s"], &two[..]].concat(),
    );
    let states = at.join("out/.btc-checkpoint");
    while !states.join("seed-1.state").exists() && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    if states.is_dir() {
        fs::copy(states.join("seed-1.state"), states.join("seed-2.state")).unwrap();
    }
    let output = learned(at, &[&["-o", "out", "--resume"], &two[..]].concat());
    assert!(output.status.success(), "{}", told(&output));
    assert_eq!(files(&at.join("out")), files(&at.join("whole")));
}

/// What somebody else has put where checkpoints are kept stays there, and nothing is kept through a link.
#[cfg(unix)]
#[test]
fn files_of_others_survive_a_checkpoint() {
    let folder = project();
    let at = folder.path();
    let before = files(at);
    for more in [&["--checkpoint", "0s"][..], &["--resume"]] {
        let _ = fs::remove_dir_all(at.join("out"));
        fs::create_dir(at.join("out")).unwrap();
        std::os::unix::fs::symlink("..", at.join("out/.btc-checkpoint")).unwrap();
        let output = learned(at, &[&["-o", "out"], more].concat());
        assert!(output.status.success(), "{}", told(&output));
        assert!(told(&output).contains("is a link"), "{}", told(&output));
        let after = files(at);
        assert!(
            before
                .iter()
                .all(|(name, bytes)| after.get(name) == Some(bytes))
        );
    }
    fs::remove_dir_all(at.join("out")).unwrap();
    fs::create_dir_all(at.join("out/.btc-checkpoint")).unwrap();
    let note = at.join("out/.btc-checkpoint/notes.txt");
    fs::write(&note, "mine").unwrap();
    assert!(
        learned(at, &["-o", "out", "--checkpoint", "0s"])
            .status
            .success()
    );
    // What is left of the folder that was there before keeps it.
    let folders = fs::read_dir(at)
        .unwrap()
        .chain(fs::read_dir(at.join("out")).unwrap());
    let kept = folders.map(|folder| folder.unwrap().path());
    let kept = kept.filter(|folder| folder.join(".btc-checkpoint/notes.txt").exists());
    assert_eq!(kept.count(), 1);
}

#[test]
fn a_checkpoint_of_another_run_is_not_taken() {
    let folder = project();
    let at = folder.path();
    let mut run = begun(at, &["-o", "out", "--checkpoint", "0s"]);
    while !at.join("out/.btc-checkpoint/policy.csv").exists() && run.try_wait().unwrap().is_none() {
        std::thread::sleep(Duration::from_millis(1));
    }
    run.kill().unwrap();
    run.wait().unwrap();
    let output = learned(at, &["-o", "out", "--resume", "--seed", "3"]);
    assert_eq!(output.status.code(), Some(1));
    let said = told(&output);
    assert!(said.contains("--seed: nothing there, 3 here"), "{said}");
    let output = learned(at, &["-o", "out", "--resume"]);
    assert!(output.status.success(), "{}", told(&output));
    assert!(leftovers(&at.join("out")).is_empty());
}

/// A run that does not end, and has kept something.
fn at_work(at: &Path) -> Child {
    let mut arguments = vec!["learn", "small.bt", "-o", "out", "--checkpoint", "0s"];
    arguments.extend(ENDLESS);
    let run = btc(&arguments, at).spawn().unwrap();
    while !at.join("out/.btc-checkpoint/seed-1.state").exists() {
        std::thread::sleep(Duration::from_millis(1));
    }
    run
}

fn kill(mut run: Child) {
    run.kill().unwrap();
    run.wait().unwrap();
}

#[test]
fn a_checkpoint_that_is_lost_is_told() {
    let folder = project();
    let at = folder.path();
    kill(at_work(at));
    let output = learned(at, &["-o", "out"]);
    assert!(output.status.success());
    let said = told(&output);
    assert!(said.contains("a checkpoint of another run"), "{said}");
    assert!(said.contains("--effort: 900000000000 there"), "{said}");
    kill(at_work(at));
    // One that is refused, and has kept nothing itself, leaves it.
    let states = files(&at.join("out/.btc-checkpoint"));
    let refused = [
        "--episodes",
        "1",
        "--evidence",
        "1000",
        "--checkpoint",
        "never",
    ];
    let output = ran(
        &[&["learn", "small.bt", "-o", "out"], &refused[..]].concat(),
        at,
    );
    assert_eq!(output.status.code(), Some(1), "{}", told(&output));
    assert_eq!(files(&at.join("out/.btc-checkpoint")), states);
    fs::write(at.join("out/.btc-checkpoint/run.json"), "").unwrap();
    let output = learned(at, &["-o", "out", "--resume"]);
    assert!(output.status.success());
    let said = told(&output);
    assert!(said.contains("the checkpoint in out is damaged"), "{said}");
}

#[test]
fn a_folder_in_which_a_run_keeps_its_states_is_taken() {
    let folder = project();
    let at = folder.path();
    let mut run = at_work(at);
    for more in [&["--seed", "2"][..], &["--resume"]] {
        let output = learned(at, &[&["-o", "out"], more].concat());
        assert_eq!(output.status.code(), Some(1), "{}", told(&output));
        let said = told(&output);
        assert!(said.contains("another run is at work in out"), "{said}");
    }
    assert!(run.try_wait().unwrap().is_none());
    kill(run);
    assert!(learned(at, &["-o", "out"]).status.success());
    assert!(leftovers(&at.join("out")).is_empty());
}

#[cfg(unix)]
#[test]
fn signals_leave_nothing_half_done() {
    for (signal, number) in [("TERM", 15), ("HUP", 1), ("INT", 2)] {
        // What this test was started without, as by `nohup`, its runs are without.
        if crate::command::is_ignored(number) {
            continue;
        }
        let folder = project();
        let at = folder.path();
        let mut arguments = vec!["learn", "small.bt", "-o", "out", "--checkpoint", "never"];
        arguments.extend(ENDLESS);
        let mut run = btc(&arguments, at).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(300));
        let id = run.id().to_string();
        let sent = std::process::Command::new("kill")
            .args(["-s", signal, &id])
            .status();
        assert!(sent.unwrap().success());
        assert_eq!(run.wait().unwrap().code(), Some(128 + number), "{signal}");
        assert!(!at.join("out").exists());
        assert!(leftovers(at).is_empty());
    }
}

/// `nohup` has the process begin with the signal ignored.
#[cfg(unix)]
#[test]
fn a_run_without_its_terminal_goes_on() {
    let folder = project();
    let script = format!(
        "trap '' HUP; exec {} learn small.bt -o out --effort 900000M --checkpoint never",
        env!("CARGO_BIN_EXE_btc")
    );
    let mut run = std::process::Command::new("sh")
        .args(["-c", &script])
        .current_dir(folder.path())
        .stdout(std::process::Stdio::null())
        .stderr(std::process::Stdio::null())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(300));
    let send = |signal: &str| {
        let id = run.id().to_string();
        let sent = std::process::Command::new("kill")
            .args(["-s", signal, &id])
            .status();
        assert!(sent.unwrap().success());
    };
    send("HUP");
    std::thread::sleep(Duration::from_millis(200));
    send("TERM");
    assert_eq!(run.wait().unwrap().code(), Some(143));
}
