//! `btc diff` and `btc test`: which decisions have changed, in words and for tools.

use crate::command::{btc, err, out};
use crate::snapshot;
use std::fs;
use std::path::Path;

fn cases() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/diff")
}

#[test]
fn a_changed_tree_is_told_by_its_decisions() {
    for form in ["human", "markdown", "json", "github"] {
        let output = btc(&cases(), &["diff", "old.bt", "new.bt", "--format", form]);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        snapshot::check(&format!("diff@{form}"), out(&output));
    }
}

#[test]
fn another_shape_is_proved_equal() {
    let output = btc(&cases(), &["diff", "old.bt", "reshaped.bt"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        out(&output),
        "equal: `carry` of reshaped.bt has another shape than `carry` of old.bt and decides the same, both \
         reduce to the same circuit\n"
    );
    let output = btc(&cases(), &["diff", "old.bt", "old.bt"]);
    assert_eq!(output.status.code(), Some(0));
    assert!(out(&output).starts_with("same: "), "{}", out(&output));
}

/// Trees that choose the same first are no equal trees where they go on otherwise in the tick in which that ends.
#[test]
fn what_comes_next_in_a_tick_is_told_too() {
    for form in ["human", "markdown", "json", "github"] {
        let pair = ["gap.bt", "--tree", "good", "--new-tree", "bad"];
        let more = ["--episodes", "20", "--format", form];
        let arguments = [&["diff", "gap.bt"], &pair[..], &more].concat();
        let output = btc(&cases(), &arguments);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        snapshot::check(&format!("diff@gap.{form}"), out(&output));
    }
    let mut told = String::new();
    for (old, new, code) in [
        ("fallback", "waits", 1),
        ("fallback", "guarded", 1),
        ("third", "third_too", 1),
        ("step", "leap", 1),
        ("both", "other", 1),
        ("resumes", "gives_up", 1),
        // What never ends lets nothing come next.
        ("stays", "stays_too", 0),
    ] {
        let pair = ["onward.bt", "onward.bt", "--tree", old, "--new-tree", new];
        let output = btc(&cases(), &[&["diff"], &pair[..]].concat());
        assert_eq!(output.status.code(), Some(code), "{}", err(&output));
        told.push_str(out(&output));
        let output = btc(&cases(), &["verify", "onward.bt", old, new]);
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        told.push_str(&format!("{}\n", out(&output)));
    }
    snapshot::check("diff@onward", &told);
}

/// A table of some minterms of many atoms decides otherwise than a tree in a few of them: the condition holds in those, and says
/// nothing of minterms without a row.
#[test]
fn a_tree_is_compared_with_a_long_table_by_its_rows() {
    const ATOMS: u64 = 14;
    let folder = tempfile::tempdir().unwrap();
    let predicates: String = (0..ATOMS).map(|at| format!("predicate a{at}\n")).collect();
    let tree = "behavior go\nbehavior stay\n\ntree t = selector { a0 and a1 => go, stay }\n";
    fs::write(folder.path().join("old.bt"), predicates + tree).unwrap();
    let header: String = (0..ATOMS).map(|at| format!("a{at},")).collect();
    // Every eleventh minterm has a row, in an order that mixes their bits.
    let rows = (0..1 << ATOMS).step_by(11).map(|number: u64| {
        let minterm = (number * 5_771) % (1 << ATOMS);
        let holds = |at: u64| minterm >> at & 1 == 1;
        let cells: String = (0..ATOMS)
            .map(|at| format!("{},", u8::from(holds(at))))
            .collect();
        let goes = holds(0) && holds(1) && !(holds(3) && holds(4) && holds(5));
        format!("{cells}{}\n", if goes { "go" } else { "stay" })
    });
    let table: String = rows.collect();
    fs::write(
        folder.path().join("new.csv"),
        format!("{header}behavior\n{table}"),
    )
    .unwrap();
    let output = btc(folder.path(), &["diff", "old.bt", "new.csv"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let said = out(&output);
    assert!(
        said.contains("\n  a0 and a1 and a3 and a4 and a5: go → stay\n"),
        "{said}"
    );
}

/// Which trees a file has is said where it has none of the name that was given, or where none was given and it has several.
#[test]
fn a_tree_that_is_not_there_is_told_with_those_that_are() {
    let folder = tempfile::tempdir().unwrap();
    let program = |trees: [&str; 2]| {
        let [one, other] =
            trees.map(|name| format!("tree {name} = selector {{ low => dock, go }}\n"));
        format!("predicate low\nbehavior dock\nbehavior go\n{one}{other}")
    };
    fs::write(folder.path().join("old.bt"), program(["carry", "haul"])).unwrap();
    fs::write(folder.path().join("new.bt"), program(["carry", "hauls"])).unwrap();
    let told = |arguments: &[&str]| {
        let all = [&["diff", "old.bt", "new.bt"], arguments].concat();
        let output = btc(folder.path(), &all);
        (output.status.code(), err(&output).to_owned())
    };
    let (code, said) = told(&["--tree", "carry"]);
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = told(&["--tree", "haul", "--new-tree", "hauls"]);
    assert_eq!(code, Some(0), "{said}");
    let (code, said) = told(&["--tree", "haul"]);
    assert_eq!(code, Some(1), "{said}");
    for part in [
        "new.bt",
        "no tree `haul`",
        "did you mean `hauls`?",
        "it has: carry, hauls",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let (code, said) = told(&[]);
    assert_eq!(code, Some(1), "{said}");
    for part in ["several `tree` items: carry, hauls", "--tree NAME"] {
        assert!(said.contains(part), "{part}: {said}");
    }
}

#[test]
fn tables_are_compared_as_trees_are() {
    let output = btc(&cases(), &["diff", "old.csv", "new.csv"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    assert!(
        out(&output).ends_with("\n  not carrying and low: dock → goto_a\n"),
        "{}",
        out(&output)
    );
    let output = btc(&cases(), &["diff", "old.csv", "old.bt"]);
    assert_eq!(output.status.code(), Some(0), "{}", out(&output));
}

/// A row that allows several behaviours takes that of the other side, if it is among them, in whatever order they stand.
#[test]
fn allowed_behaviors_are_those_of_the_other_side() {
    for old in ["sets_old.csv", "sets_other_order.csv"] {
        for (new, code) in [
            ("sets_old.csv", 0),
            ("sets_other_order.csv", 0),
            ("sets_new.csv", 0),
            ("sets_wait.csv", 1),
        ] {
            for pair in [[old, new], [new, old]] {
                let output = btc(&cases(), &["diff", pair[0], pair[1]]);
                assert_eq!(
                    output.status.code(),
                    Some(code),
                    "{pair:?} {}",
                    out(&output)
                );
            }
        }
    }
}

/// A table is the same as itself, whatever its rows allow or leave open.
#[test]
fn a_table_is_the_same_as_itself() {
    let open = "tests/cases/tables/good/allows_several_by_two_rows.csv";
    for [old, new, said] in [
        [
            "old.csv",
            "old.csv",
            "same: old.csv has the rows of old.csv",
        ],
        [
            "sets_old.csv",
            "sets_other_order.csv",
            "same: sets_other_order.csv has the rows of sets_old.csv",
        ],
    ] {
        let output = btc(&cases(), &["diff", old, new]);
        assert_eq!(out(&output).lines().next(), Some(said));
        assert_eq!(output.status.code(), Some(0));
    }
    let output = btc(Path::new(env!("CARGO_MANIFEST_DIR")), &["diff", open, open]);
    assert!(out(&output).starts_with("same: "), "{}", out(&output));
}

/// One row of many columns has changed: a condition of a few literals tells it from the other rows.
#[test]
fn a_changed_row_is_told_in_a_few_words() {
    let output = btc(&cases(), &["diff", "wide_old.csv", "wide_new.csv"]);
    let change = out(&output).lines().last().unwrap();
    assert!(change.ends_with(": go → wait"), "{change}");
    assert!(change.split(" and ").count() <= 2, "{change}");
}

/// A world in which two rewards lead to two trees.
fn world(folder: &Path, at_gate: &str) {
    let world = format!(
        "use std

world yard {{
    tick  = 100 ms
    arena = rect((0 m, 0 m), (4 m, 2 m))
    place shed = disc((0.5 m, 1 m), 20 cm)
    place gate = disc((3.5 m, 1 m), 20 cm)
    robot mower {{
        body  = disc(17 cm)
        drive = differential(max_speed = 0.5 m/s, max_turn = 3 rad/s)
    }}
}}

event at_shed = success(goto(shed))
event at_gate = success(goto(gate))
predicate west = position.x < 2 m

task mow {{
    observe west
    choose  goto(shed), goto(gate)
    end on at_shed
    end on at_gate
    end after 1 min
    reward {{
        on at_shed: 1
        on at_gate: {at_gate}
        per 1 s:    -0.01
    }}
}}

learn mow {{ episodes = 300 }}
"
    );
    fs::write(folder.join("yard.bt"), world).unwrap();
}

#[test]
fn learned_trees_are_held_against_snapshots() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let test = |more: &[&str]| {
        let arguments = [
            &["test", ".", "--shape", "exact", "--episodes", "200"],
            more,
        ]
        .concat();
        btc(path, &arguments)
    };
    world(path, "-1");
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("no snapshot yet"), "{}", out(&output));
    let output = test(&["--accept"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        err(&output).lines().last(),
        Some("0 passed, 0 failed, 1 accepted")
    );
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(out(&output), "./yard.learned.bt: ok\n");

    world(path, "5");
    let before = fs::read_to_string(path.join("yard.learned.bt")).unwrap();
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        out(&output).contains("goto(shed) → goto(gate)"),
        "{}",
        out(&output)
    );
    assert!(out(&output).contains("return "), "{}", out(&output));
    let after = fs::read_to_string(path.join("yard.learned.bt")).unwrap();
    assert_eq!(before, after);
    let output = test(&["--review"]);
    assert_eq!(output.status.code(), Some(2), "{}", err(&output));

    // A tree that chooses the same first is not the one that was learned where it goes on otherwise.
    let accepted = test(&["--accept"]);
    assert_eq!(accepted.status.code(), Some(0), "{}", err(&accepted));
    let snapshot = path.join("yard.learned.bt");
    let learned = fs::read_to_string(&snapshot).unwrap();
    let (head, _) = learned.split_once("tree learned").unwrap();
    let onward = format!("{head}tree learned for mow = selector {{ goto(gate), goto(shed) }}\n");
    fs::write(&snapshot, onward).unwrap();
    let output = test(&[]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    for part in [
        "chooses the same first",
        "in a tick in which goto(gate) fails: goto(shed) → nothing",
    ] {
        assert!(out(&output).contains(part), "{part}: {}", out(&output));
    }
    fs::write(&snapshot, &before).unwrap();

    // An empty file is no snapshot yet, one that is broken is a failure, and either may be overwritten.
    let snapshot = path.join("yard.learned.bt");
    for (text, says) in [
        ("", "no snapshot yet"),
        (&before[..before.len() / 2], "error["),
    ] {
        fs::write(&snapshot, text).unwrap();
        let output = test(&[]);
        assert_eq!(output.status.code(), Some(1));
        let said = [out(&output), err(&output)].concat();
        assert!(said.contains(says), "{said}");
        assert_eq!(fs::read_to_string(&snapshot).unwrap(), text);
        for more in [&["--accept"][..], &[]] {
            let output = test(more);
            assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        }
    }
    // A program of somebody is not.
    let own = "predicate low\n";
    fs::write(&snapshot, own).unwrap();
    for more in [&[][..], &["--accept"]] {
        let output = test(more);
        assert_eq!(output.status.code(), Some(1));
        assert!(err(&output).contains("not a snapshot"), "{}", err(&output));
        assert_eq!(fs::read_to_string(&snapshot).unwrap(), own);
    }
}

/// Where nothing can be tested, that is said, and is a mistake.
#[test]
fn to_test_nothing_is_a_mistake() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::create_dir(path.join("none")).unwrap();
    fs::create_dir(path.join("two")).unwrap();
    fs::write(path.join("two/a.bt"), "predicate low\n").unwrap();
    fs::write(path.join("two/b.bt"), "").unwrap();
    fs::write(path.join("alone.bt"), "").unwrap();
    for (named, why) in [
        ("none", "no file in this folder ends in `.bt`"),
        (
            "two",
            "none of the 2 programs in this folder has a `test` or a `learn`",
        ),
        ("alone.bt", "it has neither a `test` nor a `learn`"),
        (
            ".",
            "none of the 3 programs in this folder has a `test` or a `learn`",
        ),
    ] {
        let output = btc(path, &["test", named]);
        assert_eq!(output.status.code(), Some(1), "{named}");
        let expected =
            format!("error: there is nothing to test in `{named}`: {why}\n0 passed, 0 failed\n");
        assert_eq!(err(&output), expected);
    }
    // Beside what can be tested too; but a snapshot is tested with its program.
    world(path, "-1");
    let test = |more: &[&str]| btc(path, &[&["test", "--shape", "exact"], more].concat());
    let output = test(&["--accept", "yard.bt", "alone.bt"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
    let output = test(&["yard.bt", "./yard.learned.bt"]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    let output = test(&["yard.learned.bt"]);
    assert_eq!(output.status.code(), Some(1), "{}", err(&output));
}

/// What was learned into a folder is left out where folders are walked, and read where it is named.
#[test]
fn results_are_left_out_of_walks() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    world(path, "-1");
    let learn = [
        "learn",
        "yard.bt",
        "--shape",
        "exact",
        "--roll-outs",
        "20",
        "-o",
        "out/first",
    ];
    let output = btc(path, &learn);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert!(path.join("out/first/manifest.json").exists());
    // The result is now of another program.
    world(path, "5");
    let output = btc(path, &["check", "."]);
    assert_eq!((output.status.code(), out(&output)), (Some(0), "ok\n"));
    assert_eq!(err(&output), "");
    let output = btc(path, &["check", "out/first"]);
    assert!(err(&output).contains("W0203"), "{}", err(&output));
    // Another tool's manifest makes no result of a folder.
    fs::create_dir(path.join("web")).unwrap();
    fs::write(path.join("web/manifest.json"), "{ \"name\": \"app\" }").unwrap();
    fs::write(path.join("web/a.bt"), "predicate\n").unwrap();
    assert_eq!(btc(path, &["check", "."]).status.code(), Some(1));
}
