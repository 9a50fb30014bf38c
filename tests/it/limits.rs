//! The limits of `docs/book/src/limits.md`, each with what is said one step beyond it.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};

const SMALL: &str = include_str!("../../examples/delivery_small.bt");

fn btc(arguments: &[&str], at: &Path, input: &[u8]) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_btc"))
        .args(arguments)
        .current_dir(at)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut pipe = child.stdin.take().unwrap();
    let input = input.to_vec();
    let writer = std::thread::spawn(move || {
        let _ = pipe.write_all(&input);
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    output
}

/// What is said of a program, which has to be refused.
fn said(arguments: &[&str], program: &str) -> String {
    let output = btc(arguments, Path::new("."), program.as_bytes());
    assert_eq!(output.status.code(), Some(1), "{arguments:?}");
    String::from_utf8(output.stderr).unwrap()
}

fn list<T: std::fmt::Display>(items: impl Iterator<Item = T>, between: &str) -> String {
    items
        .map(|item| item.to_string())
        .collect::<Vec<_>>()
        .join(between)
}

#[test]
fn text() {
    let comment = format!("// {}\n", "x".repeat(96));
    let large = comment.repeat(11_000);
    assert!(said(&["check", "-"], &large).contains("E0132"));
    assert!(said(&["fmt", "-"], &large).contains("E0132"));
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::write(path("half.bt"), comment.repeat(6_000)).unwrap();
    fs::write(
        path("main.bt"),
        format!("use \"half.bt\"\n{}", comment.repeat(6_000)),
    )
    .unwrap();
    let output = btc(&["check", "main.bt"], folder.path(), b"");
    let text = String::from_utf8(output.stderr).unwrap();
    assert!(
        text.contains("E0132") && text.contains("main.bt:1:5"),
        "{text}"
    );
}

#[test]
fn rows_of_a_canonical_table() {
    let program = |pairs: usize| {
        let names = |letter| list((0..pairs).map(|i| format!("predicate {letter}{i}\n")), "");
        let any = list((0..pairs).map(|i| format!("not x{i} and not y{i}")), " or ");
        let (x, y) = (names("x"), names("y"));
        format!("{x}{y}behavior go\nbehavior stay\n\ntree t = selector {{ {any} => go, stay }}\n")
    };
    let csv = ["canonicalize", "-", "--tree", "t", "--emit", "csv"];
    assert!(said(&csv, &program(24)).contains("E0819"));
    let output = btc(&csv, Path::new("."), program(4).as_bytes());
    assert!(output.status.success(), "{output:?}");
    let output = btc(
        &["canonicalize", "-", "--tree", "t"],
        Path::new("."),
        program(24).as_bytes(),
    );
    assert!(output.status.success(), "{output:?}");
}

#[cfg(unix)]
#[test]
fn files() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    fs::create_dir(path("inner")).unwrap();
    fs::write(path("secret.txt"), "password = 1234\n").unwrap();
    fs::write(path("world.bt"), "predicate low\nbehavior go\n").unwrap();
    let pipe = Command::new("mkfifo").arg(path("inner/pipe")).status();
    assert!(pipe.unwrap().success());
    std::os::unix::fs::symlink(path("secret.txt"), path("inner/link.bt")).unwrap();
    let inner = path("inner");
    for used in [
        "../secret.txt",
        "link.bt",
        "/etc/passwd",
        "/dev/zero",
        "/proc/self/environ",
        "pipe",
    ] {
        fs::write(path("inner/main.bt"), format!("use \"{used}\"\n")).unwrap();
        let output = btc(&["check", "main.bt"], &inner, b"");
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{used}");
        assert!(
            text.contains("E0208") && !text.contains("password"),
            "{used}: {text}"
        );
        assert!(!text.contains("root:"), "{used}: {text}");
    }
    // A folder above is allowed by name, or by standing in it.
    fs::write(path("inner/main.bt"), "use \"../world.bt\"\ntree t = go\n").unwrap();
    assert_eq!(
        btc(&["compile", "main.bt"], &inner, b"").status.code(),
        Some(1)
    );
    let named = btc(&["compile", "main.bt", "--root", ".."], &inner, b"");
    assert!(named.status.success());
    assert!(
        btc(&["compile", "inner/main.bt"], folder.path(), b"")
            .status
            .success()
    );
    // What is not beside a file is looked for below the folders that are named.
    fs::write(path("inner/main.bt"), "use \"world.bt\"\ntree t = go\n").unwrap();
    let alone = btc(&["compile", "main.bt"], &inner, b"");
    assert_eq!(alone.status.code(), Some(1));
    let named = btc(&["compile", "main.bt", "--root", ".."], &inner, b"");
    assert!(named.status.success());
    // A device that never ends does.
    assert!(said(&["check", "/dev/zero"], "").contains("E0132"));
}

#[test]
fn nesting() {
    let deep = format!("let x = {}1{}", "(".repeat(65), ")".repeat(65));
    assert!(said(&["check", "-"], &deep).contains("E0104"));
    let chain = list(
        (0..60).map(|n| format!("let f{}(x: ratio) = f{n}(x)", n + 1)),
        "\n",
    );
    let program = format!("let f0(x: ratio) = x\n{chain}\npredicate p = f60(50%) > 1%\n");
    assert!(said(&["check", "-"], &program).contains("E0209"));
}

#[test]
fn what_there_may_be_many_of() {
    let variants = list((0..101).map(|n| format!("v{n}")), ", ");
    let family = format!("enum kind {{ {variants} }}\nstate s(a: kind, b: kind): bool = false\n");
    let text = said(&["check", "-"], &format!("{SMALL}{family}"));
    assert!(text.contains("too many members"), "{text}");
    let tunes = list(
        (0..17).map(|n| format!("predicate p{n} = battery <= tune(25%, 5% .. 60%)")),
        "\n",
    );
    let text = said(&["check", "-"], &format!("{SMALL}{tunes}\n"));
    assert!(text.contains("at most 16"), "{text}");
    let predicates = list(
        (0..127).map(|n| format!("predicate p{n} = battery <= {n}%")),
        "\n",
    );
    let observed = list((0..127).map(|n| format!("p{n}")), ", ");
    let many = SMALL.replace(
        "observe carrying_package, battery_low",
        &format!("observe carrying_package, battery_low, {observed}"),
    );
    let text = said(&["check", "-"], &format!("{many}{predicates}\n"));
    assert!(text.contains("128 atoms"), "{text}");
    let wall = |n: usize| {
        let y = 1.0 + n as f64 * 1e-4;
        format!("wall w{n} = polyline((2 m, {y} m), (3 m, {y} m))")
    };
    let place = "place A";
    let doors = list(
        (0..129).map(|n| format!("{} when battery > 50%", wall(n))),
        "\n",
    );
    let text = said(
        &["check", "-"],
        &SMALL.replacen(place, &format!("{doors}\n{place}"), 1),
    );
    assert!(text.contains("128 walls"), "{text}");
    let walls = list((0..1100).map(wall), "\n");
    let text = said(
        &["check", "-"],
        &SMALL.replacen(place, &format!("{walls}\n{place}"), 1),
    );
    assert!(text.contains("registers"), "{text}");
}

#[test]
fn numbers() {
    for tick in ["2 h", "0.0005 ms"] {
        let program = SMALL.replace("100 ms", tick);
        assert!(said(&["check", "-"], &program).contains("E0309"), "{tick}");
    }
    let long = "test \"waits\" of expert {\n    tick for 10_000_001 ticks => charge\n}\n";
    let text = said(&["check", "-"], &format!("{SMALL}{long}"));
    assert!(text.contains("E0309"), "{text}");
    let often = "tree often = retry(1_000_001) { charge }\n";
    let text = said(&["check", "-"], &format!("{SMALL}{often}"));
    assert!(text.contains("from 1 to a million"), "{text}");
    for arguments in [
        ["learn", "-", "--seeds", "1001"],
        ["run", "-", "--episodes", "1000001"],
    ] {
        let output = btc(&arguments, Path::new("."), SMALL.as_bytes());
        assert_eq!(output.status.code(), Some(2), "{arguments:?}");
        let text = String::from_utf8(output.stderr).unwrap();
        assert!(text.contains("is not in 1..="), "{text}");
    }
}

#[test]
fn tables_of_values() {
    let read = |table: &str| {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("table.csv"), table).unwrap();
        btc(&["decanonicalize", "table.csv"], folder.path(), b"")
    };
    let refused = |table: &str| {
        let output = read(table);
        assert_eq!(output.status.code(), Some(1));
        String::from_utf8(output.stderr).unwrap()
    };
    let digits = "1".repeat(65);
    let text = refused(&format!("x:number,action\n{digits},go\n2,stay\n"));
    assert!(text.contains("E0814"), "{text}");
    // The first row stands for all 300 times 300 values of the others: it stays a cube.
    let each = |at: u32| format!("{at},{at},1,{}\n", ["stay", "turn"][at as usize % 2]);
    let values = list((0..300).map(each), "");
    let output = read(&format!(
        "x:number,y:number,loaded,action\n-,-,0,go\n{values}"
    ));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("not loaded => go"), "{text}");
}

#[test]
fn parts_of_open_rows() {
    // Each pair of predicates doubles the parts that have to be told apart.
    let refused = |pairs: usize| {
        let names: Vec<String> = (0..2 * pairs).map(|at| format!("p{at}")).collect();
        let guards = names
            .chunks(2)
            .map(|pair| format!("({})", pair.join(" or ")));
        let guards: Vec<String> = guards.collect();
        let declared: String = names
            .iter()
            .map(|name| format!("predicate {name}\n"))
            .collect();
        let program = format!(
            "{declared}behavior go\nbehavior wait\ntree t = selector {{ {} => go, wait }}\n",
            guards.join(" and ")
        );
        let row = vec!["-"; 2 * pairs].join(",");
        let table = format!("{},action\n{row},go|wait\n", names.join(","));
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("t.bt"), program).unwrap();
        fs::write(folder.path().join("t.csv"), table).unwrap();
        let output = btc(&["verify", "t.bt", "t", "t.csv"], folder.path(), b"");
        let text = String::from_utf8(output.stderr).unwrap();
        (output.status.code() == Some(1) && text.contains("E0823")).then_some(text)
    };
    assert_eq!(refused(8), None);
    assert!(refused(22).is_some());
}

#[test]
fn what_is_shown() {
    let mistakes = list((0..150).map(|n| format!("state a{n}: bool = b{n}")), "\n");
    let text = said(&["check", "-"], &mistakes);
    assert_eq!(text.matches("error[").count(), 100);
    assert!(
        text.contains("50 more") && text.ends_with("150 errors\n"),
        "{text}"
    );
    // Wherever in a long line a mistake stands, what is shown of it is the same.
    let blank = " ".repeat(2_000);
    for line in [
        format!("state x: bool = nowhere{blank}// {blank}"),
        format!("{blank}state x: bool = nowhere"),
        format!("{blank}state x: bool = nowhere{blank}// {blank}"),
    ] {
        let text = said(
            &["check", "-"],
            &format!("state ok: bool = true\n{line}\nstate also: bool = ok\n"),
        );
        assert!(text.len() < 1_200, "{}", text.len());
        let column = line.find("nowhere").unwrap() + 1;
        assert!(text.contains(&format!("<stdin>:2:{column}\n")), "{text}");
        let mut lines = text
            .lines()
            .skip_while(|line| !line.contains("nowhere") || line.contains("error"));
        let (shown, marks) = (lines.next().unwrap(), lines.next().unwrap());
        let at = |line: &str, what: &str| line.find(what).map(|at| line[..at].chars().count());
        assert_eq!(at(shown, "nowhere"), at(marks, "^^^^^^^"), "{text}");
    }
    let name = "x".repeat(100_000);
    let text = said(&["check", "-"], &format!("state a: bool = {name}\n"));
    assert!(text.len() < 3_000, "{}", text.len());
}

#[test]
fn characters_that_are_not_seen() {
    let output = btc(
        &["check", "-"],
        Path::new("."),
        "// \u{202e}\u{2066}\n// \u{1b}[31m\n".as_bytes(),
    );
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(text.matches("W0101").count(), 2, "{text}");
    assert!(!text.contains(['\u{202e}', '\u{2066}', '\u{1b}']), "{text}");
}

/// A file may be called so that its name would read as lines of btc's own.
#[test]
fn a_name_is_said_on_one_line() {
    let name = "no\nerror: forged\u{1b}[2K.bt";
    for arguments in [
        ["check", name],
        ["size", name],
        ["run", name],
        ["diff", name],
    ] {
        let second = (arguments[0] == "diff").then_some(name);
        let arguments: Vec<&str> = arguments.into_iter().chain(second).collect();
        let output = btc(&arguments, Path::new("."), b"");
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{text}");
        assert!(
            text.contains("no\\u{a}error: forged\\u{1b}[2K.bt"),
            "{text}"
        );
        assert!(
            !text.lines().any(|line| line.starts_with("error: forged")),
            "{text}"
        );
    }
}

/// A proof that would take days is given up, and says what would settle it; a tree is equal to itself without one.
#[test]
fn proofs() {
    // Pigeons in holes: each pigeon has one, and no two the same.
    let (pigeons, holes) = (14, 13);
    let at = |pigeon: usize, hole: usize| format!("p{pigeon}_{hole}");
    let all = (0..pigeons).flat_map(|p| (0..holes).map(move |h| (p, h)));
    let predicates = list(all.map(|(p, h)| format!("predicate {}", at(p, h))), "\n");
    let housed = list(
        (0..pigeons).map(|p| format!("({})", list((0..holes).map(|h| at(p, h)), " or "))),
        " and ",
    );
    let alone = (0..holes).flat_map(|h| {
        (0..pigeons)
            .flat_map(move |p| (0..p).map(move |q| format!("not ({} and {})", at(p, h), at(q, h))))
    });
    let alone: Vec<String> = alone.collect();
    let parts = list(
        alone
            .chunks(16)
            .map(|part| format!("({})", part.join(" and "))),
        " and ",
    );
    let program = format!(
        "{predicates}\nbehavior go\nbehavior stay\ntree a = selector {{ {housed} and {parts} => go, stay }}\ntree b = stay\n"
    );
    let output = btc(
        &["verify", "-", "a", "b"],
        Path::new("."),
        program.as_bytes(),
    );
    let text = String::from_utf8(output.stdout).unwrap();
    assert_eq!(
        output.status.code(),
        Some(3),
        "{text}{}",
        String::from_utf8_lossy(&output.stderr)
    );
    assert!(
        text.starts_with("undecided: ") && text.contains("would settle it"),
        "{text}"
    );
    let output = btc(
        &["verify", "-", "a", "a"],
        Path::new("."),
        program.as_bytes(),
    );
    assert!(output.status.success());
    assert!(
        String::from_utf8(output.stdout)
            .unwrap()
            .contains("the same tree")
    );
}
