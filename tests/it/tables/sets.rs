//! Tables whose rows allow more than a rule says, at random: the freedom makes no tree larger.

use super::{USUAL, compared, made, text};
use btc::random::Random;
use btc::tree::Size;
use std::collections::BTreeMap;

/// The behaviours of a row: the one that the rule says, and each other one with a chance.
fn allowed(random: &mut Random, all: &[&str], rule: &str, chance: f64) -> String {
    let others = all
        .iter()
        .filter(|name| **name == rule || random.chance(chance));
    others.copied().collect::<Vec<_>>().join("|")
}

fn nodes(table: &str) -> usize {
    let table = text("allows.csv", table.as_bytes());
    let made = made(table, None, &USUAL).unwrap();
    assert!(compared(&made, table).holds());
    Size::of(&made.program.trees[made.tree].root).nodes
}

/// Three numbers, six thresholds: nobody needs the hundreds of cuts at which what is allowed changes.
#[test]
fn numbers_are_cut_where_a_choice_has_to_be_made() {
    let all = ["dock", "go", "wait", "turn"];
    for (rows, chance) in [(600, 0.4), (3000, 0.05), (3000, 0.4)] {
        let mut random = Random::new(7, 0, 0);
        let mut table = BTreeMap::new();
        while table.len() < rows {
            let mut number = || (random.uniform(0.0, 10.0) * 100.0).round() as u32;
            let (x, y, z) = (number(), number(), number());
            let rule = match (x, y, z) {
                (..=200, 301.., _) => "dock",
                (..=500, ..=700, ..=400) => "go",
                (_, ..=700, ..=400) => "wait",
                (_, _, 801..) => "turn",
                (_, ..=300, _) => "wait",
                _ => "dock",
            };
            let behaviors = allowed(&mut random, &all, rule, chance);
            table.entry([x, y, z]).or_insert(behaviors);
        }
        let mut text = "x:number,y:number,z:number,action\n".to_owned();
        for (row, behaviors) in &table {
            let cells = row.map(|number| format!("{}.{:02}", number / 100, number % 100));
            text += &format!("{},{behaviors}\n", cells.join(","));
        }
        let found = nodes(&text);
        assert!(found <= 20, "{found} nodes for {rows} rows at {chance}");
    }
}

/// Forty truth values, eight of which a list of 21 nodes asks.
#[test]
fn lists_are_found_though_other_behaviors_are_allowed() {
    const ATOMS: usize = 40;
    let all = ["a", "b", "c", "d"];
    let mut random = Random::new(11, 0, 0);
    let mut table = BTreeMap::new();
    while table.len() < 5000 {
        let row: Vec<bool> = (0..ATOMS).map(|_| random.chance(0.5)).collect();
        let rule = match row.as_slice() {
            [true, false, ..] => "a",
            [_, _, true, true, ..] => "b",
            [_, true, _, _, false, ..] => "c",
            [_, _, _, _, _, true, true, ..] => "a",
            [_, _, _, _, _, _, _, true, ..] => "d",
            _ => "b",
        };
        let behaviors = allowed(&mut random, &all, rule, 0.4);
        table.entry(row).or_insert(behaviors);
    }
    let names: Vec<String> = (0..ATOMS).map(|atom| format!("p{atom}")).collect();
    let mut text = format!("{},action\n", names.join(","));
    for (row, behaviors) in &table {
        let cells: Vec<&str> = row.iter().map(|on| if *on { "1" } else { "0" }).collect();
        text += &format!("{},{behaviors}\n", cells.join(","));
    }
    let found = nodes(&text);
    assert!(found <= 21, "{found} nodes");
}
