//! `btc minimize`, from text to text.

use crate::laws::pla::{covers, run, separately};
use crate::planted::{below, planted};
use crate::snapshot::check;
use btc::driver::minimize::{Minimized, Order};
use btc::logic::pla::{Part, read};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use std::fmt::Write;

#[test]
fn outputs_share_rows_and_keep_their_names() {
    let text = "# adder\r\n.i 3\n.o 2\n.ilb a b c\n.ob carry sum\n.p 8\n\
        000 00\n001 01\n010|01 # one\n011 10\n100 01\n101 10\n110 10\n1 1 1 11\n.e\nrubbish\n";
    let found = run(text, None).unwrap();
    check(
        "minimize.adder",
        &format!("{}{}", found.text, found.statistics),
    );
}

/// Without a type, and of what is both 1 and free only what is needed: as Espresso has it.
#[test]
fn without_a_type_what_is_not_said_is_0() {
    let found = run(".i 3\n.o 1\n1-0 1\n11- 1\n-11 -\n.end\n", None).unwrap();
    assert_eq!(found.text, ".i 3\n.o 1\n.p 1\n1-0 1\n.e\n");
    let free = run(".i 3\n.o 1\n.type fr\n1-0 1\n11- 1\n0-- 0\n.end\n", None).unwrap();
    assert_eq!(free.text, ".i 3\n.o 1\n.p 1\n1-- 1\n.e\n");
}

#[test]
fn a_decision_list_of_outputs() {
    let text =
        ".i 3\n.o 3\n.type fr\n.ob a b c\n111 100\n110 100\n101 010\n001 010\n000 001\n010 001\n";
    let found = run(text, Some(Order::Learned)).unwrap();
    check(
        "minimize.list",
        &format!("{}{}", found.text, found.statistics),
    );
}

#[test]
fn mistakes_have_places() {
    let text = ".i 3\n.o 1\n.type fx\n.ilb a b\n11 1\n1x1 1\n.phase 0\n.mv 3 1 4\n";
    check("minimize.mistakes", &run(text, None).unwrap_err());
    let text = ".i 3\n.o 2\n.type fr\n1-1 10\n0-- 00\n-01 01 # here\n";
    check("minimize.contradiction", &run(text, None).unwrap_err());
}

/// As published files are: a title, names over two lines and too few of them, rows over several lines.
#[test]
fn files_are_read_as_they_are() {
    let text = "5-input something\n.i 3\n.o 4\n.ilb a\n b c\n.ob x y\n.type fr\n\
        111\n10\n01\n110 1000\n0 0 0 | 0\n010\n.e\n";
    let found = run(text, None).unwrap();
    check("minimize.as_they_are", &found.text);
    // A line of bars says nothing, wherever it stands.
    let bars = text.replace("111\n10", "|\n111\n| |\n10");
    let bars = bars.replace(".e", "|\n.e");
    assert_eq!(run(&bars, None).unwrap().text, found.text);
}

/// Names may stand before the sizes, over several lines, the type after them, and a phase of ones says nothing.
#[test]
fn names_may_stand_before_the_sizes() {
    let text = ".ob x\n.ilb a\n b c\n.i 3\n.o 2\n.phase 11\n.type fr\n110 10\n011 01\n.e\n";
    let usual = ".i 3\n.o 2\n.type fr\n.ilb a b c\n.ob x out1\n110 10\n011 01\n";
    let found = run(text, None).unwrap().text;
    assert_eq!(found, run(usual, None).unwrap().text);
    assert!(found.contains(".ilb a b c\n.ob x out1\n"), "{found}");
    let said = run(&text.replace(" b c", " b c d"), None).unwrap_err();
    assert!(said.contains("4 names for 3 columns"), "{said}");
}

/// The squares of six bits: together the outputs have fewer rows than each by itself.
#[test]
fn outputs_share_products() {
    let mut text = ".i 6\n.o 12\n.type fr\n".to_owned();
    for number in 0_u32..64 {
        writeln!(text, "{number:06b} {:012b}", number * number).unwrap();
    }
    covers(&text, &read(&text).unwrap());
    let rows = |text: &str| read(text).unwrap().rows();
    let together = rows(&run(&text, None).unwrap().text);
    let separate = rows(&separately(&text).unwrap().text);
    assert!(
        together <= 52 && together < separate,
        "{together} rows together, {separate} for each by itself"
    );
}

/// Random tables of several outputs: together they never have more rows than each by itself.
#[test]
fn shared_products_are_never_more() {
    for seed in 0..60 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(1_000 + seed);
        let outputs = 2 + below(&mut random, 3);
        let kind = ["fr", "fd", "f"][seed as usize % 3];
        let mut text = format!(".i 5\n.o {outputs}\n.type {kind}\n");
        let mut known = std::collections::BTreeSet::new();
        for _ in 0..4 + below(&mut random, 16) {
            let choices: &[char] = if kind == "fr" {
                &['0', '1']
            } else {
                &['0', '1', '-']
            };
            let inputs: String = (0..5)
                .map(|_| choices[below(&mut random, choices.len())])
                .collect();
            let said: String = (0..outputs)
                .map(|_| ['0', '1'][below(&mut random, 2)])
                .collect();
            if known.insert(inputs.clone()) {
                writeln!(text, "{inputs} {said}").unwrap();
            }
        }
        covers(&text, &read(&text).unwrap());
        let rows = |found: Minimized| read(&found.text).unwrap().rows();
        let together = rows(run(&text, None).unwrap());
        assert!(together <= rows(separately(&text).unwrap()), "{text}");
    }
}

#[test]
fn what_cannot_be_is_not_allocated() {
    for size in ["4000000000", "1048577", "99999999999999999999"] {
        for text in [
            format!(".i {size}\n.o 1\n1 1\n"),
            format!(".i 1\n.o {size}\n1 1\n"),
        ] {
            let said = run(&text, None).unwrap_err();
            assert!(said.contains("is at most 1048576"), "{said}");
        }
    }
}

#[test]
fn a_row_that_never_ends_is_reported_where_it_begins() {
    let text = ".i 3\n.o 2\n110 11\n11\n0 1\n001 11\n1\n.e\n";
    check("minimize.open", &run(text, None).unwrap_err());
}

/// Random PLAs of every type: the result is 1 and 0 where the input says so.
#[test]
fn results_agree_with_their_inputs() {
    let atoms = 6;
    for seed in 0..200 {
        let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
        let kind = ["f", "fd", "fr", "fdr"][seed as usize % 4];
        let mut text = format!(".i {atoms}\n.o 2\n.type {kind}\n");
        for _ in 0..below(&mut random, 14) {
            let inputs: String = (0..atoms)
                .map(|_| ['0', '1', '-'][below(&mut random, 3)])
                .collect();
            let outputs: String = (0..2)
                .map(|_| ['0', '1', '-', '~'][below(&mut random, 4)])
                .collect();
            writeln!(text, "{inputs} {outputs}").unwrap();
        }
        let before = read(&text).unwrap();
        covers(&text, &before);
    }
}

/// A planted list as a PLA comes out as a list that decides every row as it was.
#[test]
fn lists_decide_their_rows() {
    let planted = planted(24, 2_000, 1);
    let mut text = ".i 24\n.o 8\n.type fr\n".to_owned();
    for (r, row) in planted.rows.iter().enumerate() {
        let class = planted
            .classes
            .iter()
            .position(|rows| rows.contains(r))
            .unwrap();
        let inputs: String = (0..24)
            .map(|a| if row[0] >> a & 1 == 1 { '1' } else { '0' })
            .collect();
        let outputs: String = (0..8).map(|o| if o == class { '1' } else { '0' }).collect();
        writeln!(text, "{inputs} {outputs}").unwrap();
    }
    for order in [Order::Learned, Order::Given, Order::Rarest] {
        let found = read(&run(&text, Some(order)).unwrap().text).unwrap();
        for (r, row) in planted.rows.iter().enumerate() {
            let point = btc::logic::packed::Packed::new(24, row, &[]);
            let first = (0..found.rows())
                .find(|at| found.cube(*at).contains(&point))
                .unwrap();
            let output = (0..8).find(|o| found.part(first, *o) == Part::On).unwrap();
            assert!(planted.classes[output].contains(r));
        }
    }
}
