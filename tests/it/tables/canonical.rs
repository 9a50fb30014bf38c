//! Canonical trees and policy tables of trees, and back.

use super::{USUAL, loaded, made, shown, text};
use crate::program::{self, NoFiles};
use crate::snapshot;
use btc::driver::canonicalize::{Form, canonicalize};
use btc::driver::load::{Loaded, Reader, load};
use btc::driver::table::Recorded;
use btc::driver::{size, verify};

/// Trees of the paper's figures, and nestings of them.
const TREES: &str = "\
predicate low
predicate carrying
predicate `is near`
behavior a
behavior b
behavior c
behavior `d-1`

tree plain = selector { low => sequence { `is near`, a }, carrying => b, c }
tree held = memory sequence { a, b, c }
tree tried = memory selector { a, b }
tree both = selector { low => memory sequence { a, b }, carrying => memory selector { c, `d-1` }, a }
tree shared = selector { low and carrying => a, not low => b, `is near` => a, `d-1` }
tree partial = selector { low => a, carrying => b }
tree alone = c
tree counted = selector { low => retry(3) { a }, b }
tree parallel_in = selector { low => b, sequence { carrying, parallel(1) { a, low } } }
tree silent = sequence { false, a }
";

fn program() -> Loaded {
    let loaded = load("trees.bt", TREES.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    loaded
}

#[test]
fn canonical_trees_and_tables() {
    let program = program();
    let mut shown = String::new();
    for name in [
        "plain", "held", "tried", "both", "shared", "partial", "alone",
    ] {
        let (tree, _) = canonicalize(&program, name, Form::Bt(Some("trees.bt"))).unwrap();
        let (table, warning) = canonicalize(&program, name, Form::Csv).unwrap();
        shown += &format!("{tree}\n{table}{}\n\n", warning.unwrap_or_default());
    }
    snapshot::check("canonical", &shown);
}

#[test]
fn what_hinders_a_canonical_form_has_a_place() {
    let program = program();
    let place = |name| {
        let found = canonicalize(&program, name, Form::Csv).unwrap_err();
        program.sources.text(found.diagnostics[0].span()).to_owned()
    };
    assert_eq!(place("counted"), "retry");
    assert_eq!(place("parallel_in"), "parallel");
    assert_eq!(place("silent"), "sequence");
}

/// A tree is equal to its table; the tree that is made of the table is equal to it as well; and so is the canonical one.
#[test]
fn tables_of_trees_read_back() {
    let program = program();
    for name in ["plain", "shared", "alone", "partial"] {
        let (table, _) = canonicalize(&program, name, Form::Csv).unwrap();
        let table = text("t.csv", table.as_bytes());
        let proved = verify::table(&program, name, (table, None), None).unwrap();
        assert!(proved.holds(), "{name}: {}", proved.text);
        let made = made(table, None, &USUAL).unwrap_or_else(|r| panic!("{}", shown(&r)));
        let (again, _) = canonicalize(&loaded(&made), "learned", Form::Csv).unwrap();
        let proved = verify::table(&loaded(&made), "learned", (table, None), None).unwrap();
        assert!(proved.holds(), "{name}: {}", proved.text);
        if name != "partial" {
            let proved = verify::table(
                &program,
                name,
                (text("a.csv", again.as_bytes()), None),
                None,
            );
            assert!(proved.unwrap().holds(), "{name}");
        }
    }
}

/// Names that a table reads otherwise stand in it as the language quotes them, and what is asked in vain has a column.
#[test]
fn odd_names_and_what_is_asked_in_vain_read_back() {
    let source = "\
predicate `a,b`
predicate `x:number`
predicate `m:{a,b}`
predicate visits
predicate `q:go`
predicate action
predicate ` lead`
predicate `done(c)`
behavior `c|d`
behavior ` sp `
behavior `-`
behavior c
tree t = selector {
    `a,b` => `c|d`,
    `x:number` => ` sp `,
    `m:{a,b}` and visits => `-`,
    `q:go` or action => c,
    ` lead` => ` sp `,
    c,
}
tree asks_history = selector { `done(c)` => `c|d`, c }
tree vain = selector { visits and not visits => `c|d`, action => c, ` sp ` }
";
    let program = load("odd.bt", source.into(), &mut NoFiles);
    for name in ["t", "vain"] {
        let (table, _) = canonicalize(&program, name, Form::Csv).unwrap();
        let proved = verify::table(
            &program,
            name,
            (text("t.csv", table.as_bytes()), None),
            None,
        );
        let proved = proved.unwrap_or_else(|refused| panic!("{table}\n{}", shown(&refused)));
        assert!(proved.holds(), "{name}: {}", proved.text);
    }
    let Err(refused) = canonicalize(&program, "asks_history", Form::Csv) else {
        panic!("a column of this name asks the history");
    };
    let message = &refused.diagnostics[0].message;
    assert_eq!(message, "no table can say the name `done(c)`");
}

/// The table of a tree with memory says what it lacks, and so does a comparison without it; in an environment that was
/// recorded the two are equal.
#[test]
fn a_table_of_memory_says_what_it_lacks() {
    let source = include_str!("../../../examples/delivery_small.bt");
    let delivery = load("delivery_small.bt", source.into(), &mut NoFiles);
    let trees = program();
    let all = [
        (&delivery, "expert"),
        (&trees, "held"),
        (&trees, "tried"),
        (&trees, "both"),
    ];
    for (program, name) in all {
        let (table, _) = canonicalize(program, name, Form::Csv).unwrap();
        let says =
            format!("## The decisions of `{name}` where its memory is what the history says.\n");
        assert!(table.starts_with(&says), "{table}");
        let table = text("t.csv", table.as_bytes());
        let proved = verify::table(program, name, (table, None), None).unwrap();
        assert!(!proved.holds());
        let (parts, agrees) = proved
            .text
            .split_once("\n  with memory read from the history")
            .unwrap();
        assert!(parts.starts_with("different: "), "{parts}");
        assert!(agrees.contains("`--transitions FILE`"), "{agrees}");
    }
    let (table, _) = canonicalize(&delivery, "expert", Form::Csv).unwrap();
    let recorded = "\
carrying_package,battery_low,done(goto(C)),behavior,status,\
next:carrying_package,next:battery_low,next:done(goto(C)),count
,,,,start,0,0,0,1
0,0,0,goto(A),success,1,0,0,1
1,0,0,goto(B),success,0,0,0,1
1,0,0,goto(B),running,1,1,0,1
1,1,0,goto(C),success,1,1,1,1
1,1,1,dock(C),success,1,0,0,1
";
    let recorded = Recorded {
        transitions: text("transitions.csv", recorded.as_bytes()),
        starts: None,
    };
    let table = (text("t.csv", table.as_bytes()), None);
    let proved = verify::table(&delivery, "expert", table, Some(recorded)).unwrap();
    assert!(proved.holds(), "{}", proved.text);
}

/// Beside its source a canonical tree is proved equal; memory is read from the history there.
#[test]
fn canonical_trees_are_equal_beside_their_source() {
    struct Source(String);
    impl Reader for Source {
        fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
            assert_eq!(path, "delivery_small.bt");
            Ok(self.0.clone().into())
        }
    }
    let text = include_str!("../../../examples/delivery_small.bt");
    let program = load("delivery_small.bt", text.into(), &mut NoFiles);
    let form = Form::Bt(Some("delivery_small.bt"));
    let (made, _) = canonicalize(&program, "expert", form).unwrap();
    snapshot::check("canonical_expert", &made);
    let (table, _) = canonicalize(&program, "expert", Form::Csv).unwrap();
    snapshot::check("canonical_expert_table", &table);
    let beside = load("canonical.bt", made.into(), &mut Source(text.to_owned()));
    assert_eq!(program::shown(&beside), "");
    // From standard input there is no path to lead to the source: it stands before the tree.
    let (whole, _) = canonicalize(&program, "expert", Form::Bt(None)).unwrap();
    let whole = load("whole.bt", whole.into(), &mut NoFiles);
    assert_eq!(program::shown(&whole), "");
    for loaded in [&beside, &whole] {
        // From fresh memory a window that holds a success already is read otherwise.
        let parted = verify::trees(loaded, "expert", "expert_canonical").unwrap();
        assert!(
            parted.text.contains("part after 0 ticks"),
            "{}",
            parted.text
        );
    }
    // Without memory the two are equal.
    let text = format!("{TREES}tree again = selector {{ low => b, `is near` => c, a }}\n");
    let program = load("trees.bt", text.clone().into(), &mut NoFiles);
    let (made, _) = canonicalize(&program, "again", Form::Bt(None)).unwrap();
    let both = format!("{text}{}", &made[made.find("/// The canonical").unwrap()..]);
    let both = load("both.bt", both.into(), &mut NoFiles);
    assert_eq!(program::shown(&both), "");
    let proved = verify::trees(&both, "again", "again_canonical").unwrap();
    assert!(proved.holds(), "{}", proved.text);
}

#[test]
fn sizes_are_a_row_a_tree() {
    let program = program();
    let all = size::sizes(&program, &[]).unwrap();
    snapshot::check("sizes", &all);
    let one = size::sizes(&program, &["both".to_owned(), "held".to_owned()]).unwrap();
    assert_eq!(one.lines().count(), 3);
    assert!(one.lines().nth(1).unwrap().starts_with("both"));
    let wrong = size::sizes(&program, &["bth".to_owned(), "hel".to_owned()]).unwrap_err();
    assert_eq!(wrong.diagnostics.len(), 2);
}
