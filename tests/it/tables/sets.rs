//! Tables whose rows allow more than a rule says, at random: the freedom makes no tree larger.

use super::{USUAL, compared, made, text};
use btc::driver::decanonicalize::Options;
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

/// A table of truth values.
fn truths(table: &BTreeMap<Vec<bool>, String>) -> String {
    let atoms = table.keys().next().map_or(0, Vec::len);
    let names: Vec<String> = (0..atoms).map(|atom| format!("p{atom}")).collect();
    let mut text = format!("{},action\n", names.join(","));
    for (row, behaviors) in table {
        let cells: Vec<&str> = row.iter().map(|on| if *on { "1" } else { "0" }).collect();
        text += &format!("{},{behaviors}\n", cells.join(","));
    }
    text
}

fn nodes(table: &str, effort: u64) -> usize {
    let table = text("allows.csv", table.as_bytes());
    let options = Options { effort, ..USUAL };
    let made = made(table, None, &options).unwrap();
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
        let found = nodes(&text, USUAL.effort);
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
    let found = nodes(&truths(&table), USUAL.effort);
    assert!(found <= 21, "{found} nodes");
}

/// A list of rules over truth values.
struct Long {
    atoms: usize,
    rules: usize,
    fewest: usize,
    rows: usize,
    /// With what chance a row allows each behaviour that its rule does not say.
    chance: f64,
}

impl Long {
    /// A table of random rows, and the nodes of the tree that it is of.
    fn planted(&self, all: &[&str], seed: u64) -> (String, usize) {
        let mut random = Random::new(seed, 0, 0);
        let mut draw = |of: usize| random.uniform(0.0, of as f64) as usize % of;
        let rules: Vec<(Vec<(usize, bool)>, &str)> = (0..self.rules)
            .map(|_| {
                let literals = self.fewest + draw(5 - self.fewest);
                let cube = (0..literals).map(|_| (draw(self.atoms), draw(2) == 1));
                (cube.collect(), all[draw(all.len())])
            })
            .collect();
        let mut table = BTreeMap::new();
        while table.len() < self.rows {
            let row: Vec<bool> = (0..self.atoms).map(|_| random.chance(0.5)).collect();
            let mut holds = rules
                .iter()
                .filter(|(cube, _)| cube.iter().all(|(atom, value)| row[*atom] == *value));
            let rule = holds.next().map_or("a", |(_, behavior)| *behavior);
            let behaviors = allowed(&mut random, all, rule, self.chance);
            table.entry(row).or_insert(behaviors);
        }
        let planted = 2 + rules.iter().map(|(cube, _)| 2 + cube.len()).sum::<usize>();
        (truths(&table), planted)
    }
}

/// Twenty-five rules over a hundred truth values: what is found for a part of the rows is made right on all of them.
#[test]
fn long_lists_are_found_though_other_behaviors_are_allowed() {
    let long = Long {
        atoms: 100,
        rules: 25,
        fewest: 1,
        rows: 10_000,
        chance: 0.4,
    };
    for seed in [3, 5, 7] {
        let (table, planted) = long.planted(&["a", "b", "c", "d", "e"], seed);
        let found = nodes(&table, 30);
        assert!(found <= planted, "{found} nodes for {planted}");
    }
}

/// Thirty rules, so long that a decision tree for some of the rows has a leaf for each third of them: nothing seems to be in the table,
/// and a partition of all rows has thousands of nodes.
#[test]
fn long_lists_over_many_columns_are_found() {
    let long = Long {
        atoms: 60,
        rules: 30,
        fewest: 2,
        rows: 20_000,
        chance: 0.0,
    };
    for seed in [1, 2] {
        let (table, planted) = long.planted(&["a", "b", "c", "d", "e", "f", "g"], seed);
        let partition = nodes(&table, 0);
        assert!(partition > 4000, "{partition} nodes");
        let found = nodes(&table, USUAL.effort);
        assert!(
            found <= planted + planted / 4,
            "{found} nodes for {planted}"
        );
    }
}

/// The sides of a box: between which numbers those are that it is about.
type Sides = BTreeMap<usize, (usize, usize)>;

/// Ten boxes over six numbers with hundreds of values each: of the thousands of cuts, those that make the list short.
#[test]
fn lists_of_boxes_are_found() {
    const NUMBERS: usize = 6;
    let all = ["a", "b", "c", "d"];
    for (seed, chance) in [(3, 0.0), (4, 0.0), (5, 0.0), (3, 0.3), (4, 0.3), (5, 0.3)] {
        let mut random = Random::new(seed, 0, 0);
        let mut draw = |of: usize| random.uniform(0.0, of as f64) as usize % of;
        let rules: Vec<(Sides, &str)> = (0..10)
            .map(|_| {
                let sides = (0..=draw(3)).map(|_| {
                    let low = draw(600);
                    (draw(NUMBERS), (low, low + 100 + draw(300)))
                });
                (sides.collect(), all[draw(all.len())])
            })
            .collect();
        let mut table = BTreeMap::new();
        while table.len() < 2000 {
            let mut number = || (random.uniform(0.0, 1000.0)) as usize;
            let row: Vec<usize> = (0..NUMBERS).map(|_| number()).collect();
            let inside = |sides: &Sides| {
                let mut sides = sides.iter();
                sides.all(|(at, (low, high))| (*low..*high).contains(&row[*at]))
            };
            let mut holds = rules.iter().filter(|(sides, _)| inside(sides));
            let rule = holds.next().map_or("a", |(_, behavior)| *behavior);
            let behaviors = allowed(&mut random, &all, rule, chance);
            table.entry(row).or_insert(behaviors);
        }
        let names: Vec<String> = (0..NUMBERS).map(|at| format!("v{at}:number")).collect();
        let mut text = format!("{},action\n", names.join(","));
        for (row, behaviors) in &table {
            let cells: Vec<String> = row.iter().map(|number| number.to_string()).collect();
            text += &format!("{},{behaviors}\n", cells.join(","));
        }
        // Two comparisons a side.
        let planted: usize = 2 + rules
            .iter()
            .map(|(sides, _)| 2 + 2 * sides.len())
            .sum::<usize>();
        let found = nodes(&text, USUAL.effort);
        let most = if chance > 0.0 { 2.2 } else { 1.6 };
        assert!(
            found as f64 <= most * planted as f64,
            "{found} nodes for {planted}"
        );
    }
}

/// Rows of 24 truth values of which most are open, that allow a choice: the tree that is made of them is held against them.
#[test]
fn open_rows_that_allow_a_choice_are_compared() {
    let names: Vec<String> = (0..24).map(|atom| format!("p{atom}")).collect();
    let mut source = format!("{},action\n", names.join(","));
    for rule in 0..24_usize {
        let cells = (0..24).map(|atom| match atom {
            _ if atom < rule => "0",
            _ if atom == rule => "1",
            _ => "-",
        });
        let cells: Vec<&str> = cells.collect();
        let behaviors = ["go|wait", "wait|turn", "turn", "go"][rule % 4];
        source += &format!("{},{behaviors}\n", cells.join(","));
    }
    let nodes = nodes(&source, 10);
    assert!(nodes <= 54, "{nodes}");
    // One of the rows allows something else.
    let table = text("allows.csv", source.as_bytes());
    let tree = made(table, None, &USUAL).unwrap();
    let other = source.replacen(",turn\n", ",dock\n", 1);
    assert!(!compared(&tree, text("allows.csv", other.as_bytes())).holds());
}
