//! What holds of every table.

use super::{USUAL, compared, is_found, made, shown, text};
use btc::driver::decanonicalize::Options;
use btc::policy::reader::{self, Format};
use btc::tree::decanonicalise::{Method, Order};
use proptest::prelude::*;

/// The names of atoms, such as tables of any origin have them.
const ATOMS: [&str; 5] = ["low", "is near", "done(`go to`)", "if", "failed(x-1)"];
/// The names of behaviours.
const BEHAVIORS: [&str; 4] = ["go to", "x-1", "while", "goto(A, \"B\")"];

/// Rows of cells `0`, `1` and `-`, no two of which overlap, with what is done in each.
fn rows() -> impl Strategy<Value = Vec<(Vec<char>, usize)>> {
    let cell = prop_oneof![3 => Just('0'), 3 => Just('1'), 1 => Just('-')];
    let row = (
        proptest::collection::vec(cell, ATOMS.len()),
        0..BEHAVIORS.len(),
    );
    proptest::collection::vec(row, 1..16).prop_map(|rows| {
        let mut kept: Vec<(Vec<char>, usize)> = Vec::new();
        for (cells, behavior) in rows {
            if !kept.iter().any(|(other, _)| overlap(&cells, other)) {
                kept.push((cells, behavior));
            }
        }
        kept
    })
}

fn overlap(cells: &[char], other: &[char]) -> bool {
    let mut pairs = cells.iter().zip(other);
    pairs.all(|(a, b)| a == b || *a == '-' || *b == '-')
}

/// A table each of whose rows allows some of three behaviours. Those that overlap allow the same.
fn permissive() -> impl Strategy<Value = String> {
    let cell = prop_oneof![2 => Just('0'), 2 => Just('1'), 2 => Just('-')];
    let row = (proptest::collection::vec(cell, 4), 1..8_usize);
    proptest::collection::vec(row, 1..12).prop_map(|rows| {
        let mut kept: Vec<(Vec<char>, usize)> = Vec::new();
        for (cells, allowed) in rows {
            // A row that overlaps others takes what the first of them allows, if that makes all of them agree.
            let mut met = kept.iter().filter(|(other, _)| overlap(&cells, other));
            let allowed = met.next().map_or(allowed, |(_, first)| *first);
            if met.all(|(_, other)| *other == allowed) {
                kept.push((cells, allowed));
            }
        }
        let mut text = "a,b,c,d,action\n".to_owned();
        for (cells, allowed) in kept {
            let names = ["x", "y", "z"].into_iter().enumerate();
            let names = names.filter(|(bit, _)| allowed >> bit & 1 == 1);
            let names: Vec<&str> = names.map(|(_, name)| name).collect();
            let cells: Vec<String> = cells.iter().map(char::to_string).collect();
            text += &format!("{},{}\n", cells.join(","), names.join("|"));
        }
        text
    })
}

fn csv(rows: &[(Vec<char>, usize)]) -> String {
    let quoted = |name: &str| format!("\"{}\"", name.replace('"', "\"\""));
    let mut text = format!("{},action\n", ATOMS.map(quoted).join(","));
    for (cells, behavior) in rows {
        let cells: Vec<String> = cells.iter().map(char::to_string).collect();
        text += &format!("{},{}\n", cells.join(","), quoted(BEHAVIORS[*behavior]));
    }
    text
}

/// The rows with each cube as its minterms.
fn minterms(rows: &[(Vec<char>, usize)]) -> Vec<(Vec<char>, usize)> {
    let mut all = Vec::new();
    for (cells, behavior) in rows {
        let mut open = vec![cells.clone()];
        while let Some(cells) = open.pop() {
            match cells.iter().position(|cell| *cell == '-') {
                Some(at) => open.extend(['0', '1'].map(|value| {
                    let mut cells = cells.clone();
                    cells[at] = value;
                    cells
                })),
                None => all.push((cells, *behavior)),
            }
        }
    }
    all
}

/// The number of nodes of the tree that is made of a table.
fn nodes(table: &str) -> usize {
    let made = made(text("table.csv", table.as_bytes()), None, &USUAL);
    let report = made.unwrap_or_else(|r| panic!("{}", shown(&r))).report;
    let tree = report.iter().find_map(|line| line.strip_prefix("tree "));
    let number = tree.and_then(|line| line.split_whitespace().next());
    number.unwrap().parse().unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Cubes say what their minterms say: their tree is no larger.
    #[test]
    fn cubes_have_no_larger_tree_than_their_minterms(rows in rows()) {
        let (cubes, minterms) = (csv(&rows), csv(&minterms(&rows)));
        prop_assert!(nodes(&cubes) <= nodes(&minterms), "{}", cubes);
    }
}

fn json(rows: &[(Vec<char>, usize)]) -> String {
    let mut text = String::new();
    for (cells, behavior) in rows {
        let mut object = serde_json::Map::new();
        for (name, cell) in ATOMS.iter().zip(cells) {
            let value = match cell {
                '0' => false.into(),
                '1' => 1.into(),
                _ => serde_json::Value::Null,
            };
            object.insert((*name).to_owned(), value);
        }
        object.insert("behavior".to_owned(), BEHAVIORS[*behavior].into());
        text += &format!("{}\n", serde_json::Value::Object(object));
    }
    text
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 64, ..ProptestConfig::default() })]

    /// Table to tree to text to tree is equal to the table, whatever is asked; both formats are one table.
    #[test]
    fn what_is_made_is_equal_to_the_table(
        rows in rows(),
        order in prop_oneof![Just(Order::Learned), Just(Order::Given), Just(Order::Rarest)],
        paper in any::<bool>(),
    ) {
        let options = Options {
            method: if paper { Method::Paper } else { Method::Search },
            order,
            ..USUAL
        };
        let (table, lines) = (csv(&rows), json(&rows));
        let source = table.clone();
        let table = text("t.csv", source.as_bytes());
        let tree = made(table, None, &options).unwrap_or_else(|r| panic!("{source}{}", shown(&r)));
        let proved = compared(&tree, table);
        prop_assert!(proved.holds(), "{}", proved.text);
        let lines = made(text("t.jsonl", lines.as_bytes()), None, &options).unwrap();
        prop_assert_eq!(tree.text.replace("t.csv", "t.jsonl"), lines.text);
        let mut other = rows.clone();
        other[0].1 = (other[0].1 + 1) % BEHAVIORS.len();
        is_found(&tree, &csv(&other));
    }

    /// What is made of a table that allows several behaviours takes one of them in each row.
    #[test]
    fn what_is_made_takes_an_allowed_behaviour(source in permissive()) {
        let table = text("t.csv", source.as_bytes());
        let tree = made(table, None, &USUAL).unwrap_or_else(|r| panic!("{source}{}", shown(&r)));
        let proved = compared(&tree, table);
        prop_assert!(proved.holds(), "{source}{}", proved.text);
    }

    /// Bytes of any kind are read or refused.
    #[test]
    fn reading_is_total(bytes in proptest::collection::vec(any::<u8>(), 0..80)) {
        total(&bytes);
    }

    /// So are the remains of good tables.
    #[test]
    fn reading_mutants_is_total(
        rows in rows(),
        lines in any::<bool>(),
        edits in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>(), 0..4_u8), 1..6),
    ) {
        let good = if lines { json(&rows) } else { csv(&rows) };
        let mut bytes = good.into_bytes();
        for (at, byte, what) in edits {
            if bytes.is_empty() {
                break;
            }
            let at = at.index(bytes.len());
            let mark = [b',', b'"', b'\n', b'-', b'{', b'`'][usize::from(byte) % 6];
            match what {
                0 => drop(bytes.remove(at)),
                1 => bytes.insert(at, byte),
                2 => bytes[at] = mark,
                _ => bytes.truncate(at.max(1)),
            }
        }
        total(&bytes);
    }
}

/// Every mistake lies in the text, and what has none becomes a tree that is equal to it.
fn total(bytes: &[u8]) {
    let formats = [
        Format::Csv,
        Format::Jsonl,
        Format::Dtcontrol,
        Format::Storm,
        Format::RefinePlan,
    ];
    for format in formats {
        if let Err(mistakes) = reader::read(bytes, format, &btc::check::unit) {
            assert!(!mistakes.is_empty());
            for mistake in mistakes {
                assert!(mistake.span.start <= mistake.span.end, "{mistake:?}");
                assert!(mistake.span.end <= bytes.len(), "{mistake:?}");
            }
        }
    }
    let table = text("mutant", bytes);
    match made(table, None, &USUAL) {
        Ok(made) => assert!(compared(&made, table).holds()),
        Err(refused) => {
            assert!(!refused.diagnostics.is_empty());
            shown(&refused);
        }
    }
}
