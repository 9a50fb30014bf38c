//! The command line: what it writes where, and its exit codes.

use crate::command::{err, out};
use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SMALL: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/delivery_small.bt");

fn btc(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::null())
        .output()
        .unwrap()
}

fn piped(arguments: &[&str], input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    pipe.write_all(input).unwrap();
    drop(pipe);
    child.wait_with_output().unwrap()
}

#[test]
fn a_program_without_mistakes_is_ok() {
    let output = btc(&["check", SMALL]);
    assert_eq!(
        (output.status.code(), out(&output), err(&output)),
        (Some(0), "ok\n", "")
    );
}

/// Every command that simulates takes its effort in the same words.
#[test]
fn an_effort_may_be_in_millions() {
    for command in ["learn", "tune", "suggest"] {
        // What is missing is the file.
        let asked = [command, "no_such.bt", "--effort", "5M"];
        assert_eq!(btc(&asked).status.code(), Some(1), "{command}");
        let wrong = [command, "no_such.bt", "--effort", "5x"];
        assert_eq!(btc(&wrong).status.code(), Some(2), "{command}");
    }
}

#[test]
fn mistakes_give_exit_code_1_and_a_bad_command_line_2() {
    let wrong = b"state battery: ratio = 3 m\n";
    let output = piped(&["check", "-"], wrong);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("<stdin>:1:24"), "{}", err(&output));
    assert_eq!(btc(&["check", "/no/such/file.bt"]).status.code(), Some(1));
    for usage in [
        &["chek", SMALL][..],
        &["check"],
        &["run", SMALL, "--ticks"],
        &["run", SMALL, "--tree", "expert", "--episodes", "0"],
        &[
            "run",
            SMALL,
            "--tree",
            "expert",
            "--episodes",
            "18446744073709551615",
        ],
        &["learn", SMALL, "--roll-outs", "18446744073709551615"],
        &["learn", SMALL, "--effort", "5x"],
        &["learn", SMALL, "--nodes", "0"],
        &["learn", SMALL, "--nodes", "5", "--loss", "1%"],
        &["learn", SMALL, "--shape", "exact", "--front"],
        &["verify", SMALL, "expert"],
        &["learn", "-"],
        &["compile", SMALL, "--emit", "pdf"],
        &["explain", "E9999"],
    ] {
        assert_eq!(btc(usage).status.code(), Some(2), "{usage:?}");
    }
}

#[test]
fn what_is_no_text_is_a_located_mistake() {
    let output = piped(&["check", "-"], b"state a: bool = \xff\xfe\n");
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("E0130"), "{}", err(&output));
    assert_eq!(piped(&["fmt", "-"], b"\xff").status.code(), Some(1));
    let nothing = piped(&["check", "-"], b"");
    assert_eq!(nothing.status.code(), Some(0));
}

#[test]
fn names_that_are_not_there_are_offered_likely_ones() {
    let output = btc(&["run", SMALL, "--tree", "exprt"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        err(&output).contains("did you mean `expert`?"),
        "{}",
        err(&output)
    );
}

#[test]
fn formatting_is_a_fixed_point_and_keeps_comments() {
    let text = fs::read(SMALL).unwrap();
    let output = piped(&["fmt", "-"], &text);
    assert_eq!(output.stdout, text);
    assert_eq!(btc(&["fmt", "--check", SMALL]).status.code(), Some(0));
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("a.bt");
    fs::write(&file, "// kept\nstate   a:bool=true // too\n").unwrap();
    let path = file.to_str().unwrap();
    assert_eq!(btc(&["fmt", "--check", path]).status.code(), Some(1));
    assert_eq!(btc(&["fmt", path]).status.code(), Some(0));
    let text = fs::read_to_string(&file).unwrap();
    assert_eq!(text, "// kept\nstate a: bool = true // too\n");
    let broken = piped(&["fmt", "-"], b"state = \n");
    assert_eq!((broken.status.code(), out(&broken)), (Some(1), ""));
}

#[test]
fn learning_writes_whole_files_that_other_commands_take() {
    let folder = tempfile::tempdir().unwrap();
    let learn = |name: &str, threads: &str| {
        let to = folder.path().join(name);
        let output = btc(&[
            "learn",
            SMALL,
            "-o",
            to.to_str().unwrap(),
            "--episodes",
            "100",
            "--roll-outs",
            "50",
            "--effort",
            "500k",
            "--threads",
            threads,
        ]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        assert!(out(&output).starts_with("/// Learned from delivery_small.bt, seed 1: "));
        to
    };
    let (one, two) = (learn("one", "1"), learn("two", "2"));
    let files = |folder: &Path| {
        let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap())
            .map(|entry| {
                let name = entry.file_name().into_string().unwrap();
                (name, fs::read(entry.path()).unwrap())
            })
            .collect();
        files.sort();
        files
    };
    let first = files(&one);
    assert_eq!(first, files(&two));
    let names: Vec<&str> = first.iter().map(|(name, _)| name.as_str()).collect();
    for name in [
        "curve.csv",
        "learned.bt",
        "learned.dot",
        "learned.py",
        "learned.xml",
        "metrics.json",
        "policy.csv",
        "q.csv",
        "transitions.csv",
    ] {
        assert!(names.contains(&name), "{names:?}");
    }
    let program = one.join("learned.bt");
    let program = program.to_str().unwrap();
    let verified = btc(&["verify", program, "learned", "expert"]);
    assert_eq!(verified.status.code(), Some(0), "{}", err(&verified));
    let by_tree = btc(&[
        "run",
        program,
        "--tree",
        "learned",
        "--episodes",
        "5",
        "--format",
        "json",
    ]);
    let policy = one.join("policy.csv");
    let by_policy = btc(&[
        "run",
        program,
        "--policy",
        policy.to_str().unwrap(),
        "--episodes",
        "5",
        "--format",
        "json",
    ]);
    assert_eq!(by_tree.status.code(), Some(0), "{}", err(&by_tree));
    assert_eq!(by_tree.stdout, by_policy.stdout);
}

#[test]
fn a_broken_table_is_a_located_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let table = folder.path().join("policy.csv");
    fs::write(
        &table,
        "carrying_package,battery_low,behavior\n1,0,goto(B)\n1,2,goto(A)\n",
    )
    .unwrap();
    let output = btc(&["run", SMALL, "--policy", table.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("policy.csv:3:3"), "{}", err(&output));
}

#[test]
fn every_code_is_explained() {
    let list = btc(&["explain"]);
    assert!(out(&list).lines().count() > 40);
    let output = btc(&["explain", "e0301"]);
    assert!(out(&output).starts_with("# E0301"));
}

#[test]
fn completions_and_manual_pages_have_every_command() {
    let help = btc(&["help"]);
    let commands = out(&help).split("Commands:\n").nth(1).unwrap();
    let commands = commands.split("\n\n").next().unwrap();
    let commands: Vec<&str> = commands
        .lines()
        .filter_map(|line| line.strip_prefix("  ")?.split(' ').next())
        .filter(|name| !name.is_empty() && *name != "help")
        .collect();
    assert!(commands.contains(&"man"), "{commands:?}");

    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = btc(&["completions", shell]);
        for name in &commands {
            assert!(out(&script).contains(name), "{shell}: {name}");
        }
    }
    assert_eq!(btc(&["completions", "cmd"]).status.code(), Some(2));

    let folder = tempfile::tempdir().unwrap();
    let pages = folder.path().join("share/man1");
    let written = btc(&["man", "-o", pages.to_str().unwrap()]);
    assert_eq!(written.status.code(), Some(0), "{}", err(&written));
    assert_eq!(fs::read_dir(&pages).unwrap().count(), commands.len() + 1);
    for name in &commands {
        let page = fs::read_to_string(pages.join(format!("btc-{name}.1"))).unwrap();
        assert!(page.contains(".SH SYNOPSIS"), "{page}");
    }
    let overview = fs::read_to_string(pages.join("btc.1")).unwrap();
    assert!(overview.contains("learn"), "{overview}");

    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let refused = btc(&["man", "-o", file.to_str().unwrap()]);
    assert_eq!(refused.status.code(), Some(1));
}

#[test]
fn manual_pages_are_written_all_or_not_at_all() {
    let folder = tempfile::tempdir().unwrap();
    let at = folder.path().join("man1");
    fs::create_dir_all(at.join("btc.1")).unwrap();
    let output = btc(&["man", "-o", at.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read_dir(&at).unwrap().count(), 1);
}

#[test]
fn nobody_need_read_standard_error() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wrong.bt");
    fs::write(&file, "state a: bool = 3 m\n").unwrap();
    for arguments in [&["check"][..], &["fmt", "--check"], &["verify"]] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
            .args(arguments)
            .args([file.to_str().unwrap(), "/no/such/file.bt"])
            .stdout(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        drop(child.stderr.take());
        let code = child.wait().unwrap().code();
        assert!(matches!(code, Some(1 | 2)), "{arguments:?}: {code:?}");
    }
}

#[test]
fn a_program_is_one_file_by_whatever_path() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| format!("{}/{name}", folder.path().display());
    fs::create_dir(path("sub")).unwrap();
    fs::write(
        path("a.bt"),
        "use \"b.bt\"\nuse \"c.bt\"\nstate a: bool = true\n",
    )
    .unwrap();
    fs::write(
        path("b.bt"),
        "use \"./sub/../c.bt\"\nstate b: bool = true\n",
    )
    .unwrap();
    fs::write(path("c.bt"), "state c: bool = true\n").unwrap();
    for name in ["a.bt", "sub/../a.bt", "./b.bt"] {
        let output = btc(&["check", &path(name)]);
        assert_eq!(out(&output), "ok\n", "{name}: {}", err(&output));
    }
    fs::write(path("c.bt"), "use \"sub/../a.bt\"\n").unwrap();
    let output = btc(&["check", &path("a.bt")]);
    assert!(err(&output).contains("E0210"), "{}", err(&output));
}

#[test]
fn a_new_project_holds_what_it_claims() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &[&str], at: &str| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_btc"));
        let command = command.args(arguments).current_dir(folder.path().join(at));
        command.output().unwrap()
    };
    let output = run(&["new", "hall"], "");
    assert!(output.status.success(), "{}", err(&output));
    for arguments in [
        &["fmt", "--check", "world.bt", "tests.bt"][..],
        &["check", "world.bt", "tests.bt"],
        &["test", "--no-learn", "tests.bt"],
        &["verify", "tests.bt"],
    ] {
        let output = run(arguments, "hall");
        assert!(output.status.success(), "{arguments:?}: {}", err(&output));
    }
    assert_eq!(run(&["new", "hall"], "").status.code(), Some(1));
}

#[test]
fn a_trace_has_a_line_a_decision_or_a_tick() {
    let decisions = btc(&["run", SMALL, "--trace", "-"]);
    let ticks = btc(&["run", SMALL, "--trace", "-", "--ticks"]);
    let lines = |output: &Output| out(output).lines().count();
    assert!(lines(&decisions) > 50, "{}", err(&decisions));
    assert_eq!(lines(&ticks), 5_001, "{}", err(&ticks));
    let documents = btc(&["run", SMALL, "--trace", "-", "--trace-format", "jsonl"]);
    assert_eq!(lines(&documents) + 1, lines(&decisions));
}

#[test]
fn what_a_missing_file_may_declare_is_not_missed_as_well() {
    let moved = "use \"gone.bt\"\ntree t for delivery = low => goto(A)\nstate a: bool = 3 m\n";
    let output = piped(&["check", "-"], moved.as_bytes());
    let said = err(&output);
    assert!(said.contains("E0208") && said.contains("E0302"), "{said}");
    assert!(said.ends_with("\n2 errors\n"), "{said}");
    let table = piped(&["check", "-"], b"use \"gone.csv\"\nstate a: bool = b\n");
    assert!(err(&table).ends_with("\n2 errors\n"), "{}", err(&table));
}

#[test]
fn a_world_that_cannot_be_built_is_a_mistake_of_the_program() {
    let text = fs::read_to_string(SMALL).unwrap();
    let wide = text.replace("disc(17 cm)", "disc(60 cm)");
    let full = wide.replace(
        "    robot create2",
        "    wall pile = rect((1 m, 1 m), (5 m, 3 m))\n    robot create2",
    );
    let output = piped(&["check", "-"], full.as_bytes());
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("fits nowhere"), "{}", err(&output));
    let declared = text.replace(
        "predicate battery_low      = battery <= 25%",
        "predicate battery_low",
    );
    let output = piped(&["check", "-"], declared.as_bytes());
    assert_eq!(out(&output), "ok\n", "{}", err(&output));
}

#[test]
fn a_run_that_is_refused_leaves_no_folder() {
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().join("results");
    let to = place.to_str().unwrap();
    let output = btc(&[
        "learn",
        SMALL,
        "-o",
        to,
        "--episodes",
        "1",
        "--evidence",
        "100000",
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        err(&output).contains("nothing was learned"),
        "{}",
        err(&output)
    );
    assert!(!place.exists());
}

#[test]
fn a_program_is_not_overwritten_by_what_it_learns() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("learned.bt");
    fs::copy(SMALL, &file).unwrap();
    let place = folder.path().to_str().unwrap();
    let output = btc(&["learn", file.to_str().unwrap(), "-o", place]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("overwritten"), "{}", err(&output));
    assert_eq!(fs::read(&file).unwrap(), fs::read(SMALL).unwrap());
}

#[test]
fn a_long_trace_is_told_in_short() {
    let trees =
        "tree a for delivery = goto(A)\ntree b for delivery = timeout(20 ticks) { goto(A) }\n";
    let text = fs::read_to_string(SMALL).unwrap() + trees;
    let output = piped(&["verify", "-", "a", "b"], text.as_bytes());
    let said = out(&output);
    assert_eq!(output.status.code(), Some(1));
    assert!(said.contains("part after 20 ticks"), "{said}");
    assert!(
        said.contains("  ticks 1 to 20 {}: both select goto(A), which answers running\n"),
        "{said}"
    );
    assert_eq!(said.lines().count(), 3, "{said}");
}

#[cfg(unix)]
#[test]
fn writing_changes_the_text_of_a_file_and_nothing_else() {
    use std::os::unix::fs::{FileTypeExt, PermissionsExt, symlink};
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| format!("{}/{name}", folder.path().display());
    fs::write(path("file.bt"), "state   a:bool=true\n").unwrap();
    fs::set_permissions(path("file.bt"), fs::Permissions::from_mode(0o600)).unwrap();
    symlink("file.bt", path("link.bt")).unwrap();
    assert_eq!(btc(&["fmt", &path("link.bt")]).status.code(), Some(0));
    assert!(fs::symlink_metadata(path("link.bt")).unwrap().is_symlink());
    let text = fs::read_to_string(path("file.bt")).unwrap();
    assert_eq!(text, "state a: bool = true\n");
    let mode = fs::metadata(path("file.bt")).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o600);

    // A device of the system may be the one that a careless root would replace: a pipe stands for it.
    let made = Command::new("mkfifo").arg(path("pipe")).status();
    if made.is_ok_and(|status| status.success()) {
        let reader = std::thread::spawn({
            let pipe = path("pipe");
            move || fs::read_to_string(pipe).unwrap()
        });
        let output = btc(&["compile", SMALL, "--emit", "ir", "-o", &path("pipe")]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        assert!(reader.join().unwrap().starts_with("world warehouse"));
        let kind = fs::metadata(path("pipe")).unwrap().file_type();
        assert!(kind.is_fifo());
    }
}

#[test]
fn the_answers_of_verify_are_a_document() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("trees.bt");
    let program = "predicate p\nbehavior a\nbehavior b\n\
        tree one = selector { p => a, b }\ntree same = selector { p => a, b }\ntree other = selector { p => b, a }\n\
        claim one equals same\nclaim one equals other\n";
    fs::write(&path, program).unwrap();
    let output = btc(&["verify", path.to_str().unwrap(), "--format", "json"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let claims = document["claims"].as_array().unwrap();
    let told: Vec<_> = (claims.iter())
        .map(|claim| {
            (
                claim["claim"].as_str().unwrap(),
                claim["answer"].as_str().unwrap(),
            )
        })
        .collect();
    let expected = [
        ("claim one equals same", "holds"),
        ("claim one equals other", "fails"),
    ];
    assert_eq!(told, expected);
    let learned = btc(&["verify", SMALL, "--format", "json"]);
    let document: serde_json::Value = serde_json::from_slice(&learned.stdout).unwrap();
    assert!(document["claims"][0]["answer"].is_null(), "{document}");
}

/// What a command reads it does not write over, and no two outputs go to one file.
#[test]
fn outputs_are_files_of_their_own() {
    let folder = tempfile::tempdir().unwrap();
    let own = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let (program, table, covers) = (own("p.bt"), own("t.csv"), own("c.pla"));
    let text = "input x: number\npredicate p = x > 1\nbehavior a\nbehavior b\ntree t = selector { p => a, b }\n";
    fs::write(&program, text).unwrap();
    fs::write(&table, "p,action\n0,a\n1,b\n").unwrap();
    fs::write(&covers, ".i 1\n.o 1\n1 1\n.e\n").unwrap();
    let small = own("small.bt");
    fs::copy(SMALL, &small).unwrap();
    let (small, picture) = (small.as_str(), own("way.svg"));
    let (program, table, covers) = (program.as_str(), table.as_str(), covers.as_str());
    let wrong = [
        &[
            "compile", program, "--emit", "btcpp", "--tree", "t", "-o", program,
        ][..],
        &["canonicalize", program, "--tree", "t", "-o", program],
        &["decanonicalize", table, "-o", table],
        &["decanonicalize", table, "--program", program, "-o", program],
        &["minimize", covers, "-o", covers],
        &["run", small, "--tree", "expert", "--svg", small],
        &[
            "run", small, "--tree", "expert", "--svg", &picture, "--trace", &picture,
        ],
    ];
    for arguments in wrong {
        let before: Vec<String> = [program, table, covers, small]
            .map(|path| fs::read_to_string(path).unwrap())
            .to_vec();
        let output = btc(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        assert!(err(&output).contains("would overwrite"), "{}", err(&output));
        let after = [program, table, covers, small].map(|path| fs::read_to_string(path).unwrap());
        assert_eq!(before, after, "{arguments:?}");
    }
    let other = own("other.bt");
    let output = btc(&["decanonicalize", table, "-o", &other]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
}

/// A folder that cannot be read is no folder without programs; what is no file is no program.
#[cfg(unix)]
#[test]
fn folders_are_read_or_told() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    fs::create_dir(folder.path().join("pipe.bt")).unwrap();
    fs::copy(SMALL, folder.path().join("small.bt")).unwrap();
    assert_eq!(btc(&["check", path]).status.code(), Some(0));
    let closed = folder.path().join("closed");
    fs::create_dir(&closed).unwrap();
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o000)).unwrap();
    // Nothing is closed to the one who administers the system.
    if fs::read_dir(&closed).is_err() {
        let output = btc(&["check", path]);
        assert_eq!(output.status.code(), Some(1));
        assert!(err(&output).contains("closed"), "{}", err(&output));
    }
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o755)).unwrap();
}

/// The last of all seeds is one like any other.
#[test]
fn the_greatest_seed_learns() {
    let folder = tempfile::tempdir().unwrap();
    let most = u64::MAX.to_string();
    let place = folder.path().to_str().unwrap();
    let asked = ["learn", SMALL, "-o", place, "--seed", &most, "--seeds", "2"];
    let short = ["--episodes", "300", "--effort", "100k", "--roll-outs", "50"];
    let output = btc(&[&asked[..], &short[..]].concat());
    assert!(out(&output).contains("tree learned"), "{}", err(&output));
}

/// Room is made for a whole message at once, so that one that says it is huge is refused.
#[test]
fn a_message_that_says_it_is_huge_is_refused() {
    for length in [
        "99999999999",
        "18446744073709551615",
        "99999999999999999999999",
    ] {
        let output = piped(
            &["lsp"],
            format!("Content-Length: {length}\r\n\r\n{{}}").as_bytes(),
        );
        assert_eq!(output.status.code(), Some(1), "{length}");
        let said = err(&output);
        assert!(
            said.starts_with("error: the editor: ") && !said.contains("channel"),
            "{}",
            err(&output)
        );
    }
}

#[test]
fn the_environment_may_ask_for_any_number_of_threads() {
    for threads in ["1", "0", "99999999", "many"] {
        let output = Command::new(env!("CARGO_BIN_EXE_btc"))
            .args(["check", SMALL])
            .env("RAYON_NUM_THREADS", threads)
            .output()
            .unwrap();
        assert!(output.status.success(), "{threads}: {}", err(&output));
    }
}

#[test]
fn a_dash_is_standard_output() {
    let folder = tempfile::tempdir().unwrap();
    let ran = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_btc"))
            .args(arguments)
            .current_dir(folder.path())
            .output()
            .unwrap();
        assert!(output.status.success(), "{}", err(&output));
        out(&output).to_owned()
    };
    let printed = ran(&["compile", SMALL, "--emit", "ir"]);
    assert_eq!(ran(&["compile", SMALL, "--emit", "ir", "-o", "-"]), printed);
    assert!(!folder.path().join("-").exists());
}

#[test]
fn all_programs_of_a_folder_are_laid_out() {
    let folder = tempfile::tempdir().unwrap();
    let inner = folder.path().join("inner");
    fs::create_dir(&inner).unwrap();
    let path = inner.join("a.bt");
    fs::write(&path, "state  a : number=1\n").unwrap();
    let at = folder.path().to_str().unwrap();
    assert_eq!(btc(&["fmt", "--check", at]).status.code(), Some(1));
    assert!(btc(&["fmt", at]).status.success());
    assert_eq!(fs::read_to_string(&path).unwrap(), "state a: number = 1\n");
    assert!(btc(&["fmt", "--check", at]).status.success());
}

#[test]
fn a_project_has_a_name() {
    let output = btc(&["new", ""]);
    assert_eq!(output.status.code(), Some(2));
    assert_eq!(err(&output), "error: a project needs a name\n");
}

/// The system's administrator is not held to a limit, and takes the place of a user who is.
#[cfg(unix)]
#[test]
fn a_system_that_gives_no_thread_is_enough() {
    for command in ["check FILE", "run FILE --tree expert --episodes 3"] {
        let command = command.replace("FILE", SMALL);
        let script = format!(
            "ulimit -u 1 && exec {} {command}",
            env!("CARGO_BIN_EXE_btc")
        );
        let mut limited = Command::new("bash");
        limited.args(["-c", &script]);
        let as_nobody = std::os::unix::process::CommandExt::uid(&mut limited, 65534).output();
        let output = as_nobody.unwrap_or_else(|_| {
            let own = Command::new("bash").args(["-c", &script]).output();
            own.unwrap()
        });
        // Nobody may not be let into the folder of the program.
        let is_reached = output.status.code() != Some(126);
        assert!(!is_reached || output.status.success(), "{}", err(&output));
    }
}
