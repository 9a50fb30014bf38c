//! Every reader of tables takes any bytes, its messages lie in them, and what is read becomes a tree that is equal to it.

use super::check::{NoFiles, shown};
use btc::check;
use btc::diagnostic::{Code, render};
use btc::driver::decanonicalize::{self, Options};
use btc::driver::load::{Loaded, load};
use btc::driver::table::{self, Recorded};
use btc::driver::{Refused, Text, verify};
use btc::ir::Id;
use btc::policy::Policy;
use btc::policy::reader::{self, Format};
use std::sync::LazyLock;

/// The most bytes of a table that becomes a tree.
const SMALL: usize = 600;

const FORMATS: [Format; 5] = [
    Format::Csv,
    Format::Jsonl,
    Format::Dtcontrol,
    Format::Storm,
    Format::RefinePlan,
];

/// A program whose policies and transitions are read, too.
static DELIVERY: LazyLock<Loaded> = LazyLock::new(|| {
    let text = include_str!("../../../examples/delivery_small.bt");
    load("delivery_small.bt", text.into(), &mut NoFiles)
});

/// The law.
pub fn holds(bytes: &[u8]) {
    for format in FORMATS {
        match reader::read(bytes, format, &check::unit) {
            Ok(_) if bytes.len() <= SMALL => becomes_a_tree(bytes, format),
            Ok(_) => {}
            Err(errors) => {
                assert!(!errors.is_empty());
                for error in errors {
                    assert!(bytes.get(error.span.clone()).is_some(), "{error:?}");
                }
            }
        }
    }
    of_a_program(bytes);
}

/// The tree of a table is read back and proved equal to it.
fn becomes_a_tree(bytes: &[u8], format: Format) {
    let text = Text {
        name: "table",
        bytes,
    };
    let options = Options {
        effort: 1,
        from: Some(format),
        ..Options::default()
    };
    let asked = decanonicalize::read(text, None, None, &options);
    let made = match asked.and_then(|asked| decanonicalize::decanonicalize(asked, &options)) {
        Ok(made) => made,
        Err(refused) => return lie_in_their_texts(&refused),
    };
    let loaded = load("made.bt", made.text.clone().into(), &mut NoFiles);
    assert!(!loaded.has_errors(), "{}\n{}", made.text, shown(&loaded));
    match verify::table(&loaded, "learned", (text, Some(format)), None) {
        Ok(proved) => assert!(proved.holds(), "{}\n{}", made.text, proved.text),
        Err(refused) => {
            let codes: Vec<Code> = refused.diagnostics.iter().map(|found| found.code).collect();
            assert_eq!(codes, [Code::E0823], "{}", made.text);
        }
    }
}

/// The readers of what is written under the names of a program.
fn of_a_program(bytes: &[u8]) {
    let program = &DELIVERY.program;
    let text = Text {
        name: "table.csv",
        bytes,
    };
    let task = Id::new(0);
    if let Err(refused) = table::policy(program, text, task) {
        lie_in_their_texts(&refused);
    }
    let mut policy = Policy {
        atoms: program.atoms(task),
        behaviors: program.tasks[task].choose.clone(),
        history: program.tasks[task].history,
        ..Policy::default()
    };
    let recorded = Recorded {
        transitions: text,
        starts: Some(text),
    };
    if let Err(refused) = table::record(&mut policy, program, recorded) {
        lie_in_their_texts(&refused);
    }
}

fn lie_in_their_texts(refused: &Refused) {
    for found in &refused.diagnostics {
        for label in &found.labels {
            let source = refused.sources.get(label.span.file).unwrap();
            assert!(source.text.get(label.span.range()).is_some(), "{found:?}");
        }
    }
    render::human(&refused.sources, &refused.diagnostics, false);
}
