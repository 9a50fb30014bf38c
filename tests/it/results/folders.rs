//! Folders of results in the hands of users: edited, mixed, moved, full, and with strange names.

use super::{ENDLESS, SHORT, btc, files, learned, leftovers, project, ran, told};
use std::fs;
use std::process::Stdio;

#[test]
fn a_mix_of_two_runs_is_refused() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "one"]).status.success());
    assert!(learned(at, &["-o", "two", "--seed", "2"]).status.success());
    for name in files(&at.join("two")).keys() {
        let (from, to) = (at.join("two").join(name), at.join("one").join(name));
        let old = fs::read(&to).unwrap();
        if old == fs::read(&from).unwrap() || name == "manifest.json" {
            continue;
        }
        fs::copy(&from, &to).unwrap();
        for arguments in [
            &["verify", "one/learned.bt", "learned", "expert"][..],
            &[
                "run",
                "one/learned.bt",
                "--tree",
                "learned",
                "--episodes",
                "1",
            ],
            &[
                "run",
                "small.bt",
                "--policy",
                "one/policy.csv",
                "--episodes",
                "1",
            ],
            &["compile", "one/learned.bt"],
            &["check", "one/learned.bt"],
            &["decanonicalize", "one/policy.csv"],
        ] {
            let output = ran(arguments, at);
            assert_eq!(output.status.code(), Some(1), "{name}: {arguments:?}");
            let said = told(&output);
            assert!(said.contains("E0212") && said.contains(name), "{said}");
            assert!(said.contains("manifest.json"), "{said}");
        }
        fs::write(&to, old).unwrap();
    }
    // Without its manifest, a table still has to be the one that was proved on.
    fs::remove_file(at.join("one/manifest.json")).unwrap();
    fs::write(
        at.join("one/transitions.csv"),
        "battery_low,behavior,status,count\n",
    )
    .unwrap();
    let output = ran(&["verify", "one/learned.bt", "learned", "expert"], at);
    assert!(told(&output).contains("E0211"), "{}", told(&output));
}

/// A folder of results may come from anywhere.
#[test]
fn a_manifest_that_names_files_elsewhere_is_refused() {
    let folder = project();
    let at = folder.path();
    fs::write(at.join("precious"), "mine").unwrap();
    let outside = at.join("precious").to_str().unwrap().to_owned();
    // A folder with another folder in it is written to file by file.
    fs::create_dir_all(at.join("out/inner")).unwrap();
    for name in ["../precious", "./../precious", &outside, "inner/..", ".."] {
        let manifest = serde_json::json!({
            "btc": "", "whole": false, "program": {}, "files": { name: "" },
        });
        fs::write(at.join("out/manifest.json"), manifest.to_string()).unwrap();
        let output = learned(at, &["-o", "out"]);
        assert_eq!(output.status.code(), Some(1), "{name}");
        let said = told(&output);
        assert!(said.contains("is not a manifest of btc"), "{name}: {said}");
        assert_eq!(fs::read(at.join("precious")).unwrap(), b"mine");
    }
}

#[test]
fn files_that_are_not_used_may_go() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "out"]).status.success());
    for name in ["learned.svg", "learned.dot", "curve.svg"] {
        fs::remove_file(at.join("out").join(name)).unwrap();
    }
    fs::write(at.join("out/notes.txt"), "mine").unwrap();
    let output = ran(&["verify", "out/learned.bt", "learned", "expert"], at);
    assert!(output.status.success(), "{}", told(&output));
    // They are back after another run, and the notes still there.
    assert!(learned(at, &["-o", "out"]).status.success());
    assert!(at.join("out/learned.svg").exists());
    assert_eq!(fs::read(at.join("out/notes.txt")).unwrap(), b"mine");
}

/// What somebody has changed, or had there before, is his.
#[test]
fn what_was_edited_is_kept_under_another_name() {
    let folder = project();
    let at = folder.path();
    fs::create_dir(at.join("out")).unwrap();
    fs::write(at.join("out/policy.csv"), "mine").unwrap();
    let output = learned(at, &["-o", "out"]);
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains("kept as `policy.csv.edited`"));
    assert_eq!(fs::read(at.join("out/policy.csv.edited")).unwrap(), b"mine");
    // A result that nobody has touched is replaced without a word.
    let output = learned(at, &["-o", "out", "--seed", "2"]);
    assert!(!told(&output).contains("edited"), "{}", told(&output));
    for (text, kept) in [("one", "learned.py.edited"), ("two", "learned.py.edited-2")] {
        fs::write(at.join("out/learned.py"), text).unwrap();
        let output = learned(at, &["-o", "out"]);
        assert!(told(&output).contains(kept), "{}", told(&output));
        assert_eq!(fs::read_to_string(at.join("out").join(kept)).unwrap(), text);
    }
    assert_eq!(fs::read(at.join("out/policy.csv.edited")).unwrap(), b"mine");
    let output = ran(&["verify", "out/learned.bt", "learned", "expert"], at);
    assert!(output.status.success(), "{}", told(&output));
}

/// Without its manifest nothing says of a folder that it is one result, so that a damaged one is not as good as none.
#[test]
fn a_damaged_manifest_is_told() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "out"]).status.success());
    let whole = fs::read(at.join("out/manifest.json")).unwrap();
    let half = whole.get(..whole.len() / 2).unwrap();
    let doubled = String::from_utf8(whole.clone()).unwrap();
    let doubled = doubled.replace("\"files\"", "\"files\": {}, \"files\"");
    for text in [
        b"".as_slice(),
        half,
        b"{\"btc\": 1}",
        b"{}",
        b"null",
        b"[]",
        b"{\"files\": {}}",
        doubled.as_bytes(),
    ] {
        fs::write(at.join("out/manifest.json"), text).unwrap();
        let output = ran(&["verify", "out/learned.bt", "learned", "expert"], at);
        assert_eq!(output.status.code(), Some(1));
        let said = told(&output);
        assert!(said.contains("E0212") && said.contains("damaged"), "{said}");
        let said = told(&learned(at, &["-o", "out"]));
        assert!(
            said.contains("damaged") && said.contains("delete it"),
            "{said}"
        );
    }
    // What it does not name is not known to be of the result.
    let whole = String::from_utf8(whole).unwrap();
    let less: String = whole
        .lines()
        .filter(|line| !line.contains("learned.bt"))
        .collect();
    fs::write(at.join("out/manifest.json"), less).unwrap();
    let said = told(&ran(&["check", "out/learned.bt"], at));
    assert!(
        said.contains("E0212") && said.contains("does not name `learned.bt`"),
        "{said}"
    );
    // One of somebody else says nothing of what stands beside it.
    fs::write(at.join("out/manifest.json"), "{\"name\": \"a page\"}").unwrap();
    let output = ran(&["check", "out/learned.bt"], at);
    assert!(output.status.success(), "{}", told(&output));
}

/// A program that uses a learned tree gets no other one under its name.
#[test]
fn a_result_that_was_edited_is_not_used() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "out"]).status.success());
    fs::write(at.join("user.bt"), "use \"out/learned.bt\"\n").unwrap();
    let output = ran(&["check", "user.bt"], at);
    assert!(output.status.success(), "{}", told(&output));
    let learned = fs::read_to_string(at.join("out/learned.bt")).unwrap();
    fs::write(at.join("out/learned.bt"), learned + "\n// edited\n").unwrap();
    for command in ["check", "compile"] {
        let output = ran(&[command, "user.bt"], at);
        assert_eq!(output.status.code(), Some(1));
        let said = told(&output);
        assert!(said.contains("`out` is not one result"), "{said}");
    }
}

#[test]
fn what_a_run_no_longer_writes_goes_with_the_old_result() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "out"]).status.success());
    assert!(at.join("out/front.svg").exists());
    assert!(
        learned(at, &["-o", "out", "--shape", "exact"])
            .status
            .success()
    );
    assert!(!at.join("out/front.svg").exists());
}

#[test]
fn a_folder_is_moved_with_its_source() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "deep/down/out"]).status.success());
    let elsewhere = tempfile::tempdir().unwrap();
    let to = elsewhere.path();
    fs::rename(at.join("deep/down/out"), to.join("moved")).unwrap();
    let verify = ["verify", "moved/learned.bt", "learned", "expert"];
    let output = ran(&verify, to);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        told(&output).contains("beside `moved`"),
        "{}",
        told(&output)
    );
    fs::copy(at.join("small.bt"), to.join("small.bt")).unwrap();
    assert!(
        ran(&verify, to).status.success(),
        "{}",
        told(&ran(&verify, to))
    );
    fs::rename(to.join("small.bt"), to.join("moved/small.bt")).unwrap();
    assert!(ran(&verify, to).status.success());
    // From within, and by way of a link.
    let within = ran(
        &["verify", "learned.bt", "learned", "expert"],
        &to.join("moved"),
    );
    assert!(within.status.success(), "{}", told(&within));
    #[cfg(unix)]
    {
        assert!(learned(at, &["-o", "deep/down/out"]).status.success());
        std::os::unix::fs::symlink(at.join("deep/down/out"), at.join("link")).unwrap();
        let output = ran(&["verify", "link/learned.bt", "learned", "expert"], at);
        assert!(output.status.success(), "{}", told(&output));
        assert!(learned(at, &["-o", "link", "--seed", "2"]).status.success());
        assert!(fs::symlink_metadata(at.join("link")).unwrap().is_symlink());
        assert_eq!(files(&at.join("link")), files(&at.join("deep/down/out")));
    }
}

#[test]
fn a_source_that_has_changed_is_told() {
    let folder = project();
    let at = folder.path();
    assert!(learned(at, &["-o", "out"]).status.success());
    let text = fs::read_to_string(at.join("small.bt")).unwrap();
    fs::write(at.join("small.bt"), format!("// Changed.\n{text}")).unwrap();
    let output = ran(&["verify", "out/learned.bt", "learned", "expert"], at);
    assert!(output.status.success(), "{}", told(&output));
    assert!(told(&output).contains("W0203"), "{}", told(&output));
}

#[test]
fn the_current_folder_takes_results() {
    let folder = project();
    let at = folder.path();
    fs::create_dir(at.join("own")).unwrap();
    fs::write(at.join("own/file"), "mine").unwrap();
    for seed in ["1", "2"] {
        let output = learned(at, &["-o", ".", "--seed", seed]);
        assert!(output.status.success(), "{}", told(&output));
        let output = ran(&["verify", "learned.bt", "learned", "expert"], at);
        assert!(output.status.success(), "{}", told(&output));
    }
    assert_eq!(fs::read(at.join("own/file")).unwrap(), b"mine");
    assert!(leftovers(at).is_empty(), "{:?}", leftovers(at));
}

#[test]
fn what_cannot_be_written_shows_before_learning() {
    let folder = project();
    let at = folder.path();
    fs::write(at.join("file"), "").unwrap();
    fs::create_dir_all(at.join("taken/policy.csv")).unwrap();
    fs::create_dir(at.join("foreign")).unwrap();
    fs::write(at.join("foreign/manifest.json"), "{\"name\": \"a page\"}").unwrap();
    for place in ["file", "file/below", "taken", "foreign", "/proc/none"] {
        let mut arguments = vec!["learn", "small.bt", "-o", place];
        arguments.extend(ENDLESS);
        let output = ran(&arguments, at);
        assert_eq!(output.status.code(), Some(1), "{place}");
        assert!(told(&output).starts_with("error: "), "{}", told(&output));
    }
    assert_eq!(
        fs::read(at.join("foreign/manifest.json")).unwrap(),
        b"{\"name\": \"a page\"}"
    );
}

#[cfg(target_os = "linux")]
#[test]
fn results_are_there_before_they_are_printed() {
    let folder = project();
    let at = folder.path();
    let mut arguments = vec!["learn", "small.bt", "-o", "out"];
    arguments.extend(SHORT);
    let full = fs::OpenOptions::new()
        .write(true)
        .open("/dev/full")
        .unwrap();
    let output = btc(&arguments, at).stdout(full).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(
        told(&output).contains("standard output"),
        "{}",
        told(&output)
    );
    assert!(learned(at, &["-o", "whole"]).status.success());
    assert_eq!(files(&at.join("out")), files(&at.join("whole")));
    // Nobody reads.
    let mut child = btc(&arguments, at).stdout(Stdio::piped()).spawn().unwrap();
    drop(child.stdout.take());
    drop(child.stderr.take());
    assert!(child.wait().unwrap().success());
    assert_eq!(files(&at.join("out")), files(&at.join("whole")));
}

#[cfg(unix)]
#[test]
fn names_that_no_use_can_say_are_refused_before_learning() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = project();
    let at = folder.path();
    for name in ["a \"quoted\".bt", "two\nlines.bt", "table.csv"] {
        fs::copy(at.join("small.bt"), at.join(name)).unwrap();
        let output = ran(&["learn", name, ENDLESS[4], ENDLESS[5]], at);
        assert_eq!(output.status.code(), Some(1), "{name}");
        assert!(told(&output).contains("rename it"), "{}", told(&output));
    }
    // A folder may have any name: no file names it.
    let names = [
        &b"a \"quoted\" folder"[..],
        b"two\nlines",
        b"no \xff text",
        "a\u{202e}b".as_bytes(),
    ];
    for name in names {
        let place = at.join(OsStr::from_bytes(name));
        let mut command = btc(&["learn", "small.bt"], at);
        let output = command.args(SHORT).arg("-o").arg(&place).output().unwrap();
        assert!(output.status.success(), "{}", told(&output));
        let output = btc(&["verify", "learned.bt", "learned", "expert"], &place)
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", told(&output));
    }
    // The way to the program leads through a folder whose name is no text.
    let output = btc(
        &["learn", "../small.bt", "-o", "../out"],
        &at.join(OsStr::from_bytes(names[2])),
    )
    .args(SHORT)
    .output()
    .unwrap();
    assert!(output.status.success(), "{}", told(&output));
    let hidden = at.join(OsStr::from_bytes(names[2]));
    fs::copy(at.join("small.bt"), hidden.join("inner.bt")).unwrap();
    let output = ran(
        &["learn", "inner.bt", "-o", "../out", ENDLESS[4], ENDLESS[5]],
        &hidden,
    );
    assert_eq!(output.status.code(), Some(1));
    assert!(told(&output).contains("not UTF-8"), "{}", told(&output));
}
