//! The programs together have what the language has: every production of its grammar, and every word of the book's tables on it.

use super::PROGRAMS;
use super::author::Author;
use crate::book::pages::pages;
use pest_meta::ast::RuleType;
use pest_meta::optimizer::{OptimizedExpr, OptimizedRule};
use pest_vm::Vm;
use std::collections::BTreeSet;

/// Productions that stand for mistakes, by how their names begin.
const MISTAKES: [&str; 5] = ["bad_", "missing_", "stray_", "unclosed_", "wrong_"];

/// Productions of programs without a world, of files that are used, and those that only a mistake leads to.
const ELSEWHERE: [&str; 10] = [
    "input",
    "known_word",
    "kw_input",
    "list_expr",
    "paid_unit",
    "pin",
    "price_time",
    "string",
    "unopened",
    "values",
];

/// What the tables call arguments that have no name in a program.
const ARGUMENTS: [&str; 8] = [
    "centre",
    "corner",
    "deviation",
    "high",
    "limit",
    "low",
    "mean",
    "radius",
];

fn texts() -> impl Iterator<Item = String> {
    (0..PROGRAMS).map(|seed| Author::new(seed).program().0)
}

/// The productions that a tree can have nodes of, from one on.
fn productions(rules: &[OptimizedRule], name: &str, found: &mut BTreeSet<String>) {
    let Some(rule) = rules.iter().find(|rule| rule.name == name) else {
        return;
    };
    if MISTAKES.iter().any(|mistake| name.starts_with(mistake)) || found.contains(name) {
        return;
    }
    found.insert(name.to_owned());
    if rule.ty != RuleType::Atomic {
        within(&rule.expr, &mut |name| productions(rules, name, found));
    }
}

/// The productions that an expression names, but for those that are only looked ahead at.
fn within(expr: &OptimizedExpr, name: &mut impl FnMut(&str)) {
    match expr {
        OptimizedExpr::Ident(rule) => name(rule),
        OptimizedExpr::Seq(a, b) | OptimizedExpr::Choice(a, b) => {
            within(a, name);
            within(b, name);
        }
        OptimizedExpr::Opt(a) | OptimizedExpr::Rep(a) | OptimizedExpr::RestoreOnErr(a) => {
            within(a, name);
        }
        _ => {}
    }
}

#[test]
fn they_have_every_production() {
    let grammar = include_str!("../../../grammar/bt.pest");
    let (_, rules) = pest_meta::parse_and_optimize(grammar).expect("it is a grammar");
    let mut expected = BTreeSet::new();
    productions(&rules, "file", &mut expected);
    let silent = |rule: &&OptimizedRule| rule.ty == RuleType::Silent;
    for silent in rules.iter().filter(silent) {
        expected.remove(&silent.name);
    }
    let machine = Vm::new(rules);
    let mut found = BTreeSet::new();
    for text in texts() {
        let tree = machine.parse("file", &text).expect("it parses");
        found.extend(tree.flatten().map(|node| node.as_rule().to_owned()));
    }
    assert!(expected.len() > 100, "{expected:?}");
    let missing: Vec<&str> = expected.difference(&found).map(String::as_str).collect();
    assert_eq!(missing, ELSEWHERE);
}

#[test]
fn they_have_every_word_of_the_tables() {
    let programs: String = texts().collect();
    let is_of_word = |letter: char| letter.is_ascii_alphanumeric() || letter == '_';
    let known: BTreeSet<&str> = programs.split(|letter| !is_of_word(letter)).collect();
    let mut missing = BTreeSet::new();
    for page in pages()
        .into_iter()
        .filter(|page| page.name.starts_with("language"))
    {
        for row in page.text.lines().filter(|line| line.starts_with("| `")) {
            let cell = row.split(" | ").next().unwrap_or_default();
            let code = cell.split('`').skip(1).step_by(2);
            let words = code.flat_map(|code| code.split(|letter| !is_of_word(letter)));
            let words = words.filter(|word| {
                word.len() > 1
                    && word
                        .chars()
                        .all(|letter| letter.is_ascii_lowercase() || letter == '_')
            });
            missing.extend(
                words
                    .filter(|word| !known.contains(word))
                    .map(str::to_owned),
            );
        }
    }
    missing.retain(|word| !ARGUMENTS.contains(&word.as_str()));
    assert!(missing.is_empty(), "{missing:?}");
}
