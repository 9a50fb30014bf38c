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
each tick { wet = chance(1%) }
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

/// The transitions that the program uses.
struct Recorded(String);

impl Reader for Recorded {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        assert_eq!(path, "transitions.csv");
        Ok(self.0.clone().into())
    }
}

fn loaded() -> Loaded {
    let loaded = load("yard.bt", PROGRAM.into(), &mut Recorded(TABLE.into()));
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

/// What is declared only may fail, and `stay` never does.
const WATCH: &str = "predicate dark\npredicate wet\n\
    behavior look\nbehavior call\nbehavior hide\nbehavior stay { control {} }\n\
    tree plain    = selector { dark => look, stay }\n\
    tree guarded  = selector { not dark => stay, look }\n\
    tree also     = selector { dark => look, dark => hide, stay }\n\
    tree twice    = selector { dark => look, dark => look, stay }\n\
    tree careful  = selector { not dark => stay, wet => memory sequence { look, call }, look }\n\
    tree trusting = selector { not dark => stay, wet => memory sequence { look, call }, look, hide }\n";

/// Equal is what trees select; where they go on differently after a failure, such a tick is shown.
#[test]
fn trees_that_are_equal_may_go_on_differently() {
    let loaded = load("watch.bt", WATCH.into(), &mut program::NoFiles);
    // One child stands twice.
    let codes = loaded.diagnostics.iter().map(|it| it.code);
    assert_eq!(codes.collect::<Vec<_>>(), [btc::diagnostic::Code::W0606]);
    let mut told = String::new();
    for (left, right) in [
        ("plain", "guarded"),
        ("plain", "also"),
        ("plain", "twice"),
        ("careful", "trusting"),
    ] {
        let proved = verify::trees(&loaded, left, right).unwrap();
        told.push_str(&format!("{}\n\n", proved.text));
    }
    crate::snapshot::check("verdicts.onward", told.trim_end());
}

/// Along recorded transitions, a failure is one that was recorded.
#[test]
fn failures_are_those_that_were_recorded() {
    let text =
        |status: &str| TABLE.replace("1,goto(A),success,,3", &format!("1,goto(A),{status},,3"));
    for (status, differ) in [("success", false), ("failure", true)] {
        let table = text(status);
        let program = PROGRAM.replace(
            "tree other",
            "tree back for delivery     = selector { goto(A), goto(B) }\ntree other",
        );
        let loaded = load("yard.bt", program.into(), &mut Recorded(table));
        let proved = verify::trees(&loaded, "recorded", "back").unwrap();
        assert!(proved.holds(), "{}", proved.text);
        let told = proved
            .text
            .contains("if it fails, `recorded` goes on to nothing and `back` to goto(B)");
        assert_eq!(told, differ, "{}", proved.text);
    }
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
