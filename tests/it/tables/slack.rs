//! Slack: smaller trees that are not equal to their tables, and say so.

use super::{USUAL, compared, made, text};
use crate::snapshot;
use btc::diagnostic::Code;
use btc::driver::decanonicalize::Options;
use btc::random::Random;
use btc::tree::Size;
use proptest::prelude::*;

fn with(slack: f64) -> Options<'static> {
    Options { slack, ..USUAL }
}

/// Three behaviours, of which the third is worth nearly as much as another in both of its minterms.
const TABLE: &str = "\
a,b,c,behavior,q:x,q:y,q:z
0,0,0,x,1,0,0
0,0,1,x,1,0,0
0,1,0,x,1,0,0
0,1,1,z,0.95,0,1
1,0,0,y,0,1,0
1,0,1,y,0,1,0
1,1,0,z,0,0.96,1
1,1,1,y,0,1,0
";

#[test]
fn minterms_that_are_decided_otherwise_are_listed() {
    let table = text("t.csv", TABLE.as_bytes());
    let exact = made(table, None, &USUAL).unwrap();
    let loose = made(table, None, &with(0.1)).unwrap();
    let lines = [&loose.warnings[..], &loose.report[..]].concat().join("\n");
    snapshot::check("table_slack", &format!("{}\n{lines}\n", loose.text));
    assert!(loose.text.len() < exact.text.len());
    assert!(loose.text.contains("NOT equal"));
    assert!(!compared(&loose, table).holds());
    assert_eq!(loose.warnings.len(), 3);
}

/// Slack makes no larger tree than the same table whose rows allow what the slack does.
#[test]
fn slack_is_as_good_as_rows_that_allow_as_much() {
    let mut random = Random::new(5, 0, 0);
    let all = ["w", "x", "y", "z"];
    let mut with_values = String::from("a,b,c,d,e,behavior,q:w,q:x,q:y,q:z\n");
    let mut with_sets = String::from("a,b,c,d,e,behavior\n");
    for row in 0..32 {
        let cells: Vec<String> = (0..5).map(|bit| (row >> bit & 1).to_string()).collect();
        let values: Vec<f64> = all.iter().map(|_| random.uniform(0.0, 1.0)).collect();
        let most = values.iter().copied().fold(0.0, f64::max);
        let best = values.iter().position(|value| *value == most).unwrap();
        let allowed = all
            .iter()
            .zip(&values)
            .filter(|(_, value)| **value >= most - 0.4);
        let allowed: Vec<&str> = allowed.map(|(name, _)| *name).collect();
        let cells = cells.join(",");
        let [w, x, y, z] = values[..] else {
            unreachable!()
        };
        with_values += &format!("{cells},{},{w},{x},{y},{z}\n", all[best]);
        with_sets += &format!("{cells},{}\n", allowed.join("|"));
    }
    let nodes = |table: &str, options: &Options| {
        let made = made(text("t.csv", table.as_bytes()), None, options).unwrap();
        Size::of(&made.program.trees[made.tree].root).nodes
    };
    let (slack, sets) = (nodes(&with_values, &with(0.4)), nodes(&with_sets, &USUAL));
    assert!(slack <= sets, "{slack} nodes, {sets} with sets");
}

/// What is worth too little, and what has no value, is never taken.
#[test]
fn slack_that_is_too_small_changes_nothing() {
    let table = text("t.csv", TABLE.as_bytes());
    let exact = made(table, None, &USUAL).unwrap();
    let tight = made(table, None, &with(0.03)).unwrap();
    assert_eq!(tight.text, exact.text);
    let unknown = TABLE.replace("0.95", "").replace("0.96", "");
    let table = text("t.csv", unknown.as_bytes());
    assert_eq!(made(table, None, &with(0.5)).unwrap().text, exact.text);
}

/// A behaviour that rows choose and that has no column of values is told: its rows would never be decided otherwise.
#[test]
fn a_behavior_without_values_is_told() {
    let lines = TABLE.lines().map(|line| line.rsplit_once(',').unwrap().0);
    let table: String = lines.map(|line| format!("{line}\n")).collect();
    let Err(refused) = made(text("t.csv", table.as_bytes()), None, &with(0.1)) else {
        panic!("`z` has no column");
    };
    let found = &refused.diagnostics[0];
    assert_eq!(found.code, Code::E0817);
    assert_eq!(found.span().range().start, table.find(",z,").unwrap() + 1);
}

/// A table over four predicates in which each of three behaviours has a value.
fn valued() -> impl Strategy<Value = String> {
    let row = proptest::collection::vec(0..20_u32, 3);
    proptest::collection::btree_map(0..16_u32, row, 2..14).prop_map(|rows| {
        let mut table = "a,b,c,d,behavior,q:x,q:y,q:z\n".to_owned();
        for (bits, values) in rows {
            let cells: Vec<String> = (0..4).map(|i| (bits >> i & 1).to_string()).collect();
            let best = (0..3).max_by_key(|i| values[*i]).unwrap();
            let values: Vec<String> = values
                .iter()
                .map(|v| format!("{}", f64::from(*v) / 10.0))
                .collect();
            table += &format!(
                "{},{},{}\n",
                cells.join(","),
                ["x", "y", "z"][best],
                values.join(",")
            );
        }
        table
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 48, ..ProptestConfig::default() })]

    /// Without slack the tree is the exact one; with slack it is smaller or the same, and every change is within it.
    #[test]
    fn slack_is_kept(table in valued(), slack in 1..8_u32) {
        let table = text("t.csv", table.as_bytes());
        let slack = f64::from(slack) / 10.0;
        let exact = made(table, None, &USUAL).unwrap();
        prop_assert_eq!(&made(table, None, &with(0.0)).unwrap().text, &exact.text);
        let loose = made(table, None, &with(slack)).unwrap();
        let proved = compared(&loose, table);
        // Proved or refuted, it says which.
        prop_assert_eq!(proved.holds(), loose.warnings.is_empty());
        prop_assert_eq!(proved.holds(), loose.text == exact.text);
        for line in loose.warnings.iter().skip(1) {
            let loss: f64 = line.split("worth ").nth(1).unwrap().split(' ').next().unwrap().parse().unwrap();
            prop_assert!(loss <= slack + 1e-9, "{}", line);
        }
    }
}
