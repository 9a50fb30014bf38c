//! Worlds with a trap each: the report names it.

use super::runs::OPTIONS;
use crate::program;
use crate::snapshot;
use btc::diagnostic::Code;
use btc::driver::learn::{Learned, Options, learn};
use std::path::Path;

fn learned(name: &str) -> Learned {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/worlds/traps");
    let file = format!("{name}.bt");
    let loaded = program::named(&file, &folder.join(&file));
    assert!(!loaded.has_errors(), "{name}");
    let options = Options {
        episodes: None,
        roll_outs: 60,
        ..OPTIONS
    };
    learn(&loaded, &options, &|_| {}).unwrap()
}

#[test]
fn a_report_names_the_trap_of_a_world() {
    let cases: [(&str, &[Code]); 6] = [
        ("zero_reward", &[Code::W0505]),
        ("never_succeeds", &[Code::W0502, Code::W0503]),
        ("unreachable_goal", &[Code::W0502, Code::W0503]),
        ("unseen_deaths", &[Code::W0506]),
        ("nothing_pays", &[]),
        ("deceptive_reward", &[]),
    ];
    let mut text = String::new();
    for (name, expected) in cases {
        let learned = learned(name);
        assert_eq!(learned.headline.len(), 5);
        let codes: Vec<Code> = learned.warnings.iter().map(|found| found.code).collect();
        for code in expected {
            assert!(codes.contains(code), "{name}: {code} is not in {codes:?}");
        }
        text.push_str(&format!("{name}\n"));
        for warning in &learned.warnings {
            text.push_str(&format!("  {}: {}\n", warning.code, warning.message));
        }
    }
    snapshot::check("traps", &text);
}
