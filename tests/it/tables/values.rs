//! Tables of numbers and words: the tree that is printed takes the decision of each row, with its values.

use super::{USUAL, compared, is_found, loaded, made, shown, text};
use crate::laws::naive::{self, Memory};
use crate::program::{self, NoFiles};
use crate::snapshot;
use btc::diagnostic::Code;
use btc::driver::decanonicalize::Options;
use btc::driver::load::load;
use btc::driver::verify;
use btc::emit::form::TreeForm;
use btc::ir::tree::{Atom, Status};
use btc::policy::reader::Format;
use btc::tree::Size;
use proptest::prelude::*;
use std::collections::BTreeMap;

const NUMBERS: [&str; 7] = ["-12", "-0.5", "0", "0.1", "0.30", "2e1", "7"];
const WORDS: [&str; 4] = ["kitchen", "living room", "dock", "if"];
const BEHAVIORS: [&str; 3] = ["go", "wait here", "kitchen"];
const HEADER: &str = "x:number,y:number cm,\"at:{kitchen,living room,dock,if,hall}\",loaded,action";

/// The cells of a row: two numbers, a word and a truth value, some of them open; with what is done.
type Row = ([Option<usize>; 4], usize);

fn overlap(a: &Row, b: &Row) -> bool {
    let mut pairs = a.0.iter().zip(&b.0);
    pairs.all(|(a, b)| a.is_none() || b.is_none() || a == b)
}

fn rows() -> impl Strategy<Value = Vec<Row>> {
    let cell = |values: usize| prop::option::weighted(0.9, 0..values);
    let cells = (cell(7), cell(7), cell(4), cell(2)).prop_map(|(a, b, c, d)| [a, b, c, d]);
    // Most tables follow a rule or two.
    let rule = (0..7_usize, 0..7_usize, 0..4_usize, any::<bool>());
    let rows = prop::collection::vec((cells, 0..BEHAVIORS.len()), 1..40);
    (rows, rule).prop_map(|(rows, (x, y, word, ruled))| {
        let mut kept: Vec<Row> = Vec::new();
        for (cells, chosen) in rows {
            let done = match cells {
                [Some(a), ..] if ruled && a <= x => 0,
                [_, Some(b), Some(c), _] if ruled && b > y && c == word => 1,
                _ => chosen,
            };
            let row = (cells, done);
            if !kept.iter().any(|other| overlap(other, &row)) {
                kept.push(row);
            }
        }
        kept
    })
}

fn csv(rows: &[Row]) -> String {
    let mut text = format!("{HEADER}\n");
    for ([x, y, word, loaded], done) in rows {
        let cell = |at: &Option<usize>, of: &[&str]| at.map_or("-".to_owned(), |at| of[at].into());
        let cells = [
            cell(x, &NUMBERS),
            cell(y, &NUMBERS),
            cell(word, &WORDS),
            cell(loaded, &["0", "1"]),
            BEHAVIORS[*done].to_owned(),
        ];
        text += &format!("{}\n", cells.join(","));
    }
    text
}

/// The comparisons that a program prints, each by its name: the input, and the number or the value.
fn printed(text: &str) -> BTreeMap<String, (String, String)> {
    let bare = |name: &str| name.trim().trim_matches('`').to_owned();
    let lines = text
        .lines()
        .filter_map(|line| line.strip_prefix("predicate "));
    let defined = lines.filter_map(|line| {
        let (name, when) = line.split_once(" = ")?;
        let (input, with) = when
            .split_once(" <= ")
            .or_else(|| when.split_once(" == "))?;
        let with = with.trim_end_matches(" cm");
        Some((bare(name), (bare(input), bare(with))))
    });
    defined.collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    #[test]
    fn the_tree_takes_the_decision_of_each_row(rows in rows()) {
        let source = csv(&rows);
        let table = text("t.csv", source.as_bytes());
        let tree = made(table, None, &USUAL).unwrap_or_else(|r| panic!("{source}{}", shown(&r)));
        let proved = compared(&tree, table);
        prop_assert!(proved.holds(), "{source}{}{}", tree.text, proved.text);
        // Read as a person reads it.
        let loaded = loaded(&tree);
        let program = &loaded.program;
        let root = &program.trees.values().next().unwrap().root;
        let comparisons = printed(&tree.text);
        for ([x, y, word, is_loaded], done) in &rows {
            let (Some(x), Some(y), Some(word), Some(is_loaded)) = (x, y, word, is_loaded) else {
                continue;
            };
            let number = |text: &str| text.parse::<f64>().unwrap();
            let holds = |atom: Atom| {
                let Atom::Predicate(id) = atom else { unreachable!() };
                let name = program.predicates[id].name.bare();
                let Some((input, with)) = comparisons.get(&name) else {
                    assert_eq!(name, "loaded");
                    return *is_loaded == 1;
                };
                match input.as_str() {
                    "x" => number(NUMBERS[*x]) <= number(with),
                    "y" => number(NUMBERS[*y]) <= number(with),
                    _ => WORDS[*word] == with,
                }
            };
            let ticked = naive::tick(root, &Memory::new(), &holds, &mut |_| Status::Running);
            let selected = ticked.ticked.first().map(|id| program.behaviors[*id].name.bare());
            prop_assert_eq!(selected.as_deref(), Some(BEHAVIORS[*done]));
        }
        let mut other = rows.clone();
        other[0].1 = (other[0].1 + 1) % BEHAVIORS.len();
        is_found(&tree, &csv(&other));
    }
}

/// The grid world of the documentation, in and out, and in the forms for robots.
#[test]
fn a_grid_world_becomes_a_tree() {
    let read = |file: &str| {
        let path = format!("{}/examples/{file}", env!("CARGO_MANIFEST_DIR"));
        std::fs::read(path).unwrap()
    };
    let table = read("grid.csv");
    let table = text("grid.csv", &table);
    let options = Options {
        effort: Options::default().effort,
        ..USUAL
    };
    let tree = made(table, None, &options).unwrap();
    assert_eq!(tree.text, String::from_utf8(read("grid.bt")).unwrap());
    let proved = compared(&tree, table);
    assert!(proved.holds());
    snapshot::check(
        "grid",
        &format!("{}\n{}\n", tree.report.join("\n"), proved.text),
    );
    for form in [TreeForm::BtCpp, TreeForm::PyTrees] {
        let quick = Options {
            form,
            effort: 1,
            ..options
        };
        let exported = made(table, None, &quick).unwrap().text;
        assert!(exported.contains("battery_at_most_30"), "{exported}");
        // Who runs it has to know what is asked.
        let says = "`battery_at_most_30` is `battery <= 30%`.";
        assert!(exported.contains(says), "{exported}");
    }
}

#[test]
fn a_tree_that_decides_otherwise_is_told_the_values() {
    let program = "input x: length\ninput location: {hall, kitchen, dock}\ninput heat: number\n\
                   predicate near = x <= 1.5 m\npredicate here = location == kitchen\n\
                   predicate warm = heat / 2 > 3\npredicate odd = x / 1 m > heat\n\
                   predicate loaded\nbehavior go\nbehavior wait_here\n\
                   tree other = selector { near => go, wait_here }\n\
                   tree same = selector { here and not loaded => go, wait_here }\n\
                   tree hot = selector { warm => go, wait_here }\n\
                   tree odd_one = selector { odd => go, wait_here }\n\
                   tree held = memory sequence { go, wait_here }\n\
                   predicate far\n\
                   tree asks = selector { far => go, wait_here }\n";
    let loaded = load("other.bt", program.into(), &mut NoFiles);
    assert_eq!(program::shown(&loaded), "");
    let verified = |tree: &str, table: &str| {
        let table = text("t.csv", table.as_bytes());
        match verify::table(&loaded, tree, (table, None), None) {
            Ok(proved) => proved.text,
            Err(refused) => shown(&refused),
        }
    };
    let table = "x:number cm,location:{kitchen,hall},loaded,action\n\
                 100,kitchen,0,go\n150,hall,0,wait_here\n-,kitchen,1,wait_here\n300,kitchen,0,go|wait_here\n";
    let metres = "x:number,location:{kitchen,hall},loaded,action\n1,kitchen,0,go\n";
    let garden = "x:number m,location:{kitchen,garden},loaded,action\n1,garden,0,go\n";
    let heat = "heat:number,action\n5,wait_here\n7,go\n-,go\n";
    let exact = "heat:number,action\n5,wait_here\n7,go\n";
    let found = [
        verified("other", table),
        verified("same", table),
        verified("asks", table),
        verified("held", table),
        verified("other", metres),
        verified("same", garden),
        verified("hot", table),
        verified("hot", heat),
        verified("hot", exact),
        verified(
            "odd_one",
            "heat:number,x:number m,action\n5,6,go\n7,1,wait_here\n",
        ),
        verified(
            "odd_one",
            "heat:number,x:number m,action\n5,6,go\n-,1,wait_here\n",
        ),
    ];
    snapshot::check("table_verify_values", &found.join("\n\n"));
}

/// The kind of a file may be told where its name and its text do not tell it.
#[test]
fn the_kind_of_a_file_may_be_told() {
    let table = text("policy.txt", b"x:number,action\n1,go\n3,wait\n");
    let of = |from| {
        let options = Options { from, ..USUAL };
        made(table, None, &options).map(|made| made.text)
    };
    assert_eq!(of(None).unwrap(), of(Some(Format::Csv)).unwrap());
    let refused = of(Some(Format::Storm)).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, Code::E0811);
    // Slack and transitions are of minterms.
    let options = Options {
        slack: 1.0,
        ..USUAL
    };
    let refused = made(table, None, &options).unwrap_err();
    assert_eq!(refused.diagnostics[0].code, Code::E0826);
}

/// Beyond these there is a mistake to tell; see `docs/book/src/limits.md`.
#[test]
fn what_is_too_much_is_refused() {
    let digits = |count: usize| format!("x:number,action\n{},go\n3,wait\n", "1".repeat(count));
    let code = |source: &str| {
        let refused = made(text("t.csv", source.as_bytes()), None, &USUAL).err()?;
        Some(refused.diagnostics[0].code)
    };
    assert_eq!(code(&digits(64)), None);
    assert_eq!(code(&digits(65)), Some(Code::E0814));
    let mut to_and_fro = "x:number,action\n".to_owned();
    for x in 0..40_000 {
        to_and_fro += &format!("{x},{}\n", if x % 2 == 0 { "go" } else { "wait" });
    }
    assert_eq!(code(&to_and_fro), Some(Code::E0826));
    let program = |cuts: usize| {
        let mut items = "input x: number\ninput y: number\nbehavior go\nbehavior wait\n".to_owned();
        let mut guard = vec!["x_0".to_owned()];
        for cut in 0..cuts {
            for input in ["x", "y"] {
                items += &format!("predicate {input}_{cut} = {input} <= {cut}\n");
                guard.push(format!("{input}_{cut}"));
            }
        }
        format!(
            "{items}tree t = selector {{ {} => go, go }}\n",
            guard.join(" or ")
        )
    };
    let verified = |cuts: usize| {
        let loaded = load("t.bt", program(cuts).into(), &mut NoFiles);
        let table = text("t.csv", b"x:number,y:number,action\n-,-,go\n");
        verify::table(&loaded, "t", (table, None), None)
    };
    // What a row leaves open is read together until something decides.
    assert!(verified(260).unwrap().holds());
}

/// Many values: the comparisons stay few, and the tree stays equal.
#[test]
fn many_values_make_few_comparisons() {
    let mut source = "x:number,y:number,action\n".to_owned();
    for i in 0..1500_u64 {
        let x = (i * 7919) % 1501;
        let y = (i * 104_729) % 1499;
        let done = match (x / 300, y / 500) {
            (0, _) => "a",
            (2, 1) => "b",
            (_, 2) => "c",
            _ => "d",
        };
        source += &format!("{}.5,{}.25,{done}\n", x, y);
    }
    let table = text("t.csv", source.as_bytes());
    let tree = made(table, None, &USUAL).unwrap();
    let proved = compared(&tree, table);
    assert!(proved.holds(), "{}", proved.text);
    assert_eq!(printed(&tree.text).len(), 5, "{}", tree.text);
}

/// A list of seven rules on as many numbers of ten values; all that a rule does not ask is left open.
fn much_open(rows: usize, wrong: bool) -> String {
    let mut text =
        String::from("a:number,b:number,c:number,d:number,e:number,f:number,g:number,action\n");
    let mut state = 7_u64;
    let mut below = |n: u64| {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1);
        (state >> 33) % n
    };
    for row in 0..rows {
        let rule = row % 8;
        let cells = (0..7).map(|column| match column {
            _ if column < rule => (4 + below(6)).to_string(),
            _ if column == rule => below(4).to_string(),
            _ => "-".to_owned(),
        });
        let cells: Vec<String> = cells.collect();
        let behavior = if wrong && row + 1 == rows { 0 } else { rule };
        text += &format!("{},b{behavior}\n", cells.join(","));
    }
    text
}

/// Rows that leave much open stay cubes: they are not written out, and not refused.
#[test]
fn rows_that_leave_much_open_are_cubes() {
    let source = much_open(80, false);
    let table = text("t.csv", source.as_bytes());
    let tree = made(table, None, &USUAL).unwrap_or_else(|r| panic!("{}", shown(&r)));
    let nodes = Size::of(&tree.program.trees[tree.tree].root).nodes;
    assert!(nodes <= 23, "{}", tree.text);
    let proved = compared(&tree, table);
    assert!(proved.holds(), "{}", proved.text);
    let source = much_open(80, true);
    let other = text("t.csv", source.as_bytes());
    let refuted = compared(&tree, other);
    assert!(!refuted.holds());
    assert!(refuted.text.contains("t.csv:81: "), "{}", refuted.text);
}
