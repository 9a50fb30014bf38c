//! The commands as processes: what goes where, exit codes, an interrupt.

use std::fs;
use std::io::Write;
use std::process::{Child, Command, Output, Stdio};

const TABLE: &str = "is-low,near,action\n1,-,dock\n0,1,wander\n0,0,go to (A)\n";

fn started(arguments: &[&str]) -> Child {
    Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn piped(arguments: &[&str], input: &str) -> Output {
    let mut child = started(arguments);
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(input.as_bytes()).unwrap();
    drop(pipe);
    child.wait_with_output().unwrap()
}

/// What a command writes to standard output and to standard error, and its exit code.
fn ran(arguments: &[&str], input: &str) -> (String, String, Option<i32>) {
    let output = piped(arguments, input);
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (
        text(&output.stdout),
        text(&output.stderr),
        output.status.code(),
    )
}

/// Decisions without any order by behaviours of long names.
#[test]
fn a_tree_of_more_text_than_btc_reads_is_written_with_a_warning() {
    let predicates: Vec<String> = (0..11).map(|i| format!("p{i}")).collect();
    let mut table = format!("{},action\n", predicates.join(","));
    for row in 0..1_u32 << 11 {
        let values: Vec<String> = (0..11).map(|i| (row >> i & 1).to_string()).collect();
        let does = row.wrapping_mul(2_654_435_761) >> 28;
        let name = format!("b{does}_{}", "x".repeat(1_000));
        table.push_str(&format!("{},{name}\n", values.join(",")));
    }
    let (out, err, code) = ran(&["decanonicalize", "-", "--effort", "0"], &table);
    assert_eq!(code, Some(0), "{err}");
    assert!(out.len() > 1_000_000, "{}", out.len());
    assert!(err.starts_with("warning: the tree comes to "), "{err}");
    let (out, err, code) = ran(
        &["decanonicalize", "-", "--effort", "0", "--emit", "json"],
        &table,
    );
    assert_eq!((err.as_str(), code), ("", Some(0)));
    assert!(!out.is_empty());
}

#[test]
fn a_table_goes_through_all_commands() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (csv, bt) = (path("p.csv"), path("p.bt"));
    fs::write(&csv, TABLE).unwrap();
    let fine = |arguments: &[&str]| {
        let (out, err, code) = ran(arguments, "");
        assert_eq!((err.as_str(), code), ("", Some(0)), "{arguments:?}");
        out
    };
    assert_eq!(fine(&["decanonicalize", &csv, "-o", &bt]), "");
    assert_eq!(
        fine(&["decanonicalize", &csv]),
        fs::read_to_string(&bt).unwrap()
    );
    assert!(fine(&["verify", &bt, "learned", &csv]).starts_with("equal: "));
    assert_eq!(fine(&["check", &bt]), "ok\n");
    assert_eq!(fine(&["fmt", "--check", &bt]), "");
    assert_eq!(fine(&["size", &bt]).lines().count(), 2);
    for form in ["dot", "svg", "json", "btcpp", "py_trees"] {
        let direct = fine(&["decanonicalize", &csv, "--emit", form]);
        let compiled = fine(&["compile", &bt, "--emit", form, "--tree", "learned"]);
        assert_eq!(direct, compiled, "{form}");
    }
    let cubes = path("q.csv");
    fine(&[
        "canonicalize",
        &bt,
        "--tree",
        "learned",
        "--emit",
        "csv",
        "-o",
        &cubes,
    ]);
    fine(&["verify", &bt, "learned", &cubes]);
    let canonical = path("c.bt");
    fine(&["canonicalize", &bt, "--tree", "learned", "-o", &canonical]);
    fine(&["verify", &canonical, "learned_canonical", &csv]);
}

#[test]
fn exit_codes_tell_what_came_of_it() {
    let (out, err, code) = ran(&["decanonicalize", "-", "--report"], TABLE);
    assert!(out.contains("Made from a table: proved on "), "{out}");
    assert!(err.contains("\npaper "), "{err}");
    assert_eq!(code, Some(0));
    let (out, err, code) = ran(&["decanonicalize", "-"], "a,action\n1,x\n1,y\n");
    assert_eq!((out.as_str(), code), ("", Some(1)));
    assert!(err.contains("<stdin>:3:1"), "{err}");
    let folder = tempfile::tempdir().unwrap();
    let bt = folder.path().join("p.bt");
    let bt = bt.to_str().unwrap();
    ran(&["decanonicalize", "-", "-o", bt], TABLE);
    let other = TABLE.replace("1,wander", "1,dock");
    let (out, _, code) = ran(&["verify", bt, "learned", "-"], &other);
    assert!(
        out.contains("<stdin>:3: {near}: the table says dock"),
        "{out}"
    );
    assert_eq!(code, Some(1));
    // Where nothing was recorded, a tree may do as it likes.
    let met = folder.path().join("met.csv");
    let recorded = "is-low,near,behavior,status,next:is-low,next:near,count\n,,,start,0,0,3\n0,0,go to (A),success,,,3\n";
    fs::write(&met, recorded).unwrap();
    let met = met.to_str().unwrap();
    let along = &["verify", bt, "learned", "-", "--transitions", met];
    let (out, _, code) = ran(along, &other);
    assert!(out.contains("(nothing was recorded in 1 other)"), "{out}");
    assert_eq!(code, Some(0), "{out}");
    // So it is where the file names the record itself.
    let text = fs::read_to_string(bt).unwrap();
    fs::write(bt, format!("{text}\nuse \"met.csv\"\n")).unwrap();
    let (out, err, code) = ran(&["verify", bt, "learned", "-"], &other);
    assert!(
        out.contains("(nothing was recorded in 1 other)"),
        "{out}{err}"
    );
    assert!(out.contains("met.csv, which the file names"), "{out}");
    assert_eq!(code, Some(0), "{out}");
    for usage in [
        &["decanonicalize"][..],
        &["decanonicalize", "-", "--slack", "-1"],
        &[
            "decanonicalize",
            "-",
            "--slack",
            "1",
            "--transitions",
            "t.csv",
        ],
        &["decanonicalize", "-", "--start", "s.csv"],
        &["decanonicalize", "-", "--name", "a`b"],
        &["canonicalize", bt],
        &["verify", bt, "learned"],
        &["verify", bt, "learned", "learned", "--transitions", "t.csv"],
    ] {
        assert_eq!(ran(usage, "").2, Some(2), "{usage:?}");
    }
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_what_was_there() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.bt");
    fs::write(&path, "the old\n").unwrap();
    let mut child = started(&["decanonicalize", "-", "-o", path.to_str().unwrap()]);
    let mut pipe = child.stdin.take().unwrap();
    // More than a pipe holds: when all is written, the command has begun to read.
    pipe.write_all(&TABLE.as_bytes().repeat(1 << 15)).unwrap();
    let id = child.id().to_string();
    // A command that runs in the background may have been started without this signal.
    let (signal, number) = match crate::command::is_ignored(2) {
        true => ("-TERM", 15),
        false => ("-INT", 2),
    };
    let sent = Command::new("kill").args([signal, &id]).status();
    assert!(sent.unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(128 + number));
    drop(pipe);
    assert_eq!(fs::read_to_string(&path).unwrap(), "the old\n");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 1);
}
