//! `btc test` on the tests that stand in programs: a program in each file of `tests/cases/tested`, and what it says of them.

use crate::command::{btc, err, out};
use crate::snapshot;
use std::fs;
use std::path::Path;

#[test]
fn tests_of_programs_run() {
    snapshot::settings().bind(|| {
        insta::glob!("..", "cases/tested/*.bt", |path| {
            let name = path.file_name().unwrap().to_str().unwrap();
            let folder = path.parent().unwrap();
            let output = btc(folder, &["test", "--no-learn", name]);
            let failed = err(&output).contains("error[E0612]");
            assert_eq!(output.status.code(), Some(i32::from(failed)), "{name}");
            let shown = format!("{}\n{}", out(&output), err(&output));
            insta::assert_snapshot!("tested", shown);
            let laid_out = btc(folder, &["fmt", "--check", name]);
            assert_eq!(laid_out.status.code(), Some(0), "{}", err(&laid_out));
        });
    });
}

#[test]
fn results_have_forms_for_programs() {
    let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases/tested");
    for form in ["markdown", "json", "github"] {
        let file = "expects_another_behaviour.bt";
        let output = btc(&cases, &["test", "--format", form, file]);
        assert_eq!(output.status.code(), Some(1), "{}", err(&output));
        assert_eq!(err(&output), "0 passed, 1 failed\n");
        snapshot::check(&format!("tested@{form}"), out(&output));
    }
}

/// A world that is learned in no time, and a test of what is learned.
const WORLD: &str = "use std

world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (4 m, 2 m))
    place shed = disc((0.5 m, 1 m), 20 cm)
    place gate = disc((3.5 m, 1 m), 20 cm)
    robot mower {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.5 m/s, max_turn = 3 rad/s)
    }
}

event at_shed = success(goto(shed))
predicate west = position.x < 2 m

task mow {
    observe west
    choose  goto(shed), goto(gate)
    end on at_shed
    end after 1 min
    reward {
        on at_shed: 1
        per 1 s:    -0.01
    }
}

learn mow { episodes = 300 }

test \"goes home\" of learned { tick => goto(shed) }
";

#[test]
fn learned_trees_are_tested() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join("yard.bt"), WORLD).unwrap();
    let output = btc(path, &["test", "--no-learn", "."]);
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        out(&output),
        "./yard.bt: goes home: skipped, for `learned` is not learned\n"
    );
    let exact = ["--shape", "exact"];
    let output = btc(path, &[&["test", ".", "--accept"], &exact[..]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", err(&output));
    assert_eq!(
        out(&output),
        "./yard.bt: goes home: ok\n./yard.bt: learned: every node is ticked\n"
    );
    assert_eq!(
        err(&output).lines().last(),
        Some("1 passed, 0 failed, 1 accepted")
    );
    // The snapshot has the tree, and so has what is learned into a folder.
    let output = btc(path, &["test", "--no-learn", "yard.learned.bt"]);
    assert_eq!(
        out(&output),
        "yard.learned.bt: goes home: ok\nyard.learned.bt: learned: every node is ticked\n"
    );
    // A program that uses another one does not learn it.
    fs::write(
        path.join("more.bt"),
        "use \"yard.bt\"\n\ntest \"goes on\" of learned { tick => goto(shed) }\n",
    )
    .unwrap();
    let output = btc(path, &["test", "more.bt"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("error[E0504]"), "{}", err(&output));
    fs::write(
        path.join("more.bt"),
        "use \"yard.learned.bt\"\n\ntest \"goes on\" of learned { tick => goto(gate) }\n",
    )
    .unwrap();
    let output = btc(path, &["test", "more.bt"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("error[E0612]"), "{}", err(&output));
    // One that expects what the learned tree does not have fails; the program has no mistake.
    let other = WORLD.replace("{ tick => goto(shed) }", "{ tick => wander }");
    fs::write(path.join("yard.bt"), other).unwrap();
    let output = btc(path, &["test", "--no-learn", "yard.learned.bt"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err(&output).contains("error[E0612]"), "{}", err(&output));
}
