//! Verdicts: equal on evidence, different, undecided, and what the command line answers to each.

use crate::program;
use btc::Answer;
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::verify;
use std::process::{Command, Stdio};

const PROGRAM: &str = r#"use "transitions.csv"
use std

world yard {
    tick  = 100 ms
    arena = rect((0 m, 0 m), (6 m, 4 m))
    place A = disc((1 m, 1 m), 15 cm)
    place B = disc((5 m, 1 m), 15 cm)
    robot digger {
        body  = disc(17 cm)
        drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)
    }
}

state wet: bool = false
predicate raining = wet

task delivery {
    observe raining
    choose goto(A), goto(B)
    end after 5_000 ticks
    reward { otherwise: -0.1 }
}

tree recorded for delivery = goto(A)
tree guarded for delivery  = selector { raining => goto(A), goto(A) }
tree other for delivery    = goto(B)
tree another for delivery  = selector { raining => goto(B), goto(B) }
"#;

const TABLE: &str = "raining,behavior,status,next:raining,count\n\
                     ,,start,0,4\n\
                     0,goto(A),success,1,3\n\
                     1,goto(A),success,,3\n";

struct Table;

impl Reader for Table {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        assert_eq!(path, "transitions.csv");
        Ok(TABLE.into())
    }
}

fn loaded() -> Loaded {
    let loaded = load("yard.bt", PROGRAM.into(), &mut Table);
    assert_eq!(program::shown(&loaded), "");
    loaded
}

#[test]
fn trees_are_equal_on_evidence_only() {
    let loaded = loaded();
    let of = |left, right| {
        let proved = verify::trees(&loaded, left, right).unwrap();
        (proved.answer, proved.text)
    };
    let (answer, text) = of("recorded", "guarded");
    assert_eq!(answer, Answer::Holds, "{text}");
    let (answer, text) = of("recorded", "other");
    assert_eq!(answer, Answer::Fails, "{text}");
    // The table knows what follows goto(A), and the two trees never do it.
    let (answer, text) = of("other", "another");
    assert_eq!(answer, Answer::Undecided, "{text}");
    assert_eq!(
        text,
        "undecided: `other` and `another` take none of 2 greedy transitions; they select the same behaviour on the 1 \
         minterm where episodes start, and the table does not say what follows"
    );
}

#[test]
fn each_answer_has_its_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("yard.bt");
    std::fs::write(&path, PROGRAM).unwrap();
    std::fs::write(folder.path().join("transitions.csv"), TABLE).unwrap();
    let code = |left, right| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_btc"));
        let command = command.arg("verify").arg(&path).args([left, right]);
        command.stdout(Stdio::null()).status().unwrap().code()
    };
    assert_eq!(code("recorded", "guarded"), Some(0));
    assert_eq!(code("recorded", "other"), Some(1));
    assert_eq!(code("other", "another"), Some(3));
}
