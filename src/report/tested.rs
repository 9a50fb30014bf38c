//! Tests of trees, with the nodes that they tick.

use super::coverage::{Coverage, Place};
use super::words::{command_data, command_property, counted};
use crate::ir::test::Test;
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// What came of the tests of a file.
#[derive(Clone, Debug)]
pub struct Tested {
    /// The file.
    pub file: String,
    /// The tests, in order.
    pub tests: Vec<One>,
    /// The trees that they tick, in the order of the first test of each.
    pub coverage: Vec<Coverage>,
}

/// What came of a test.
#[derive(Clone, Debug)]
pub struct One {
    /// What it says.
    pub title: String,
    /// The tree, as the test names it.
    pub tree: String,
    /// How many ticks it made.
    pub ticks: u64,
    /// Why it fails, for a person and as a JSON document.
    pub failure: Option<(String, String)>,
}

impl Tested {
    /// No tests of a file yet.
    pub fn of(file: &str) -> Self {
        Self {
            file: file.to_owned(),
            tests: Vec::new(),
            coverage: Vec::new(),
        }
    }

    /// Takes in a test.
    pub fn test(&mut self, test: &Test, ticks: u64, failure: Option<(String, String)>) {
        self.tests.push(One {
            title: test.title.clone(),
            tree: test.tree.clone(),
            ticks,
            failure,
        });
    }

    /// Takes in what a test has ticked of a tree.
    pub fn cover(&mut self, coverage: Coverage) {
        let known = self.coverage.iter_mut();
        match known.into_iter().find(|known| known.tree == coverage.tree) {
            None => self.coverage.push(coverage),
            Some(known) => {
                for (known, more) in known.nodes.iter_mut().zip(&coverage.nodes) {
                    known.answers.add(&more.answers);
                }
            }
        }
    }

    /// How many tests fail.
    pub fn failed(&self) -> usize {
        let tests = self.tests.iter();
        tests.filter(|test| test.failure.is_some()).count()
    }

    /// For a person at a terminal, who is shown the failures as well.
    pub fn human(&self) -> String {
        let mut lines: Vec<String> = Vec::new();
        for test in &self.tests {
            let says = if test.failure.is_some() {
                "failed"
            } else {
                "ok"
            };
            lines.push(format!("{}: {}: {says}", self.file, test.title));
        }
        for tree in &self.coverage {
            lines.push(format!("{}: {}", self.file, tree.headline()));
            // A subtree that is called twice stands in the text once.
            let mut told = BTreeSet::new();
            for node in tree.never() {
                let place = node.place.as_ref();
                let place = place.map(|it| format!("{}:{}:{}: ", it.file, it.line, it.column));
                let line = format!("  {}never {}", place.unwrap_or_default(), node.node);
                if node.place.is_none() || told.insert(line.clone()) {
                    lines.push(line);
                }
            }
        }
        lines.iter().map(|line| format!("{line}\n")).collect()
    }

    /// For a comment on a pull request.
    pub fn markdown(&self) -> String {
        let (all, failed) = (self.tests.len(), self.failed());
        let mut text = format!(
            "**{}: {} of {} passed**\n",
            self.file,
            all - failed,
            counted(all, "test")
        );
        for test in &self.tests {
            if let Some((failure, _)) = &test.failure {
                text.push_str(&format!("\n```\n{}\n```\n", failure.trim_end()));
            }
        }
        for tree in &self.coverage {
            text.push_str(&format!("\n{}", tree.headline()));
            for (at, node) in tree.never().enumerate() {
                text.push_str(if at == 0 { ", never " } else { ", " });
                text.push_str(&format!("`{}`", node.node));
            }
            text.push('\n');
        }
        text
    }

    /// Notices for GitHub at the nodes that no test has ticked.
    pub fn github(&self) -> String {
        let mut text = String::new();
        for tree in &self.coverage {
            for node in tree.never() {
                if let Some(Place { file, line, column }) = &node.place {
                    let (tree, node) = (command_data(&tree.tree), command_data(&node.node));
                    let file = command_property(file);
                    text.push_str(&format!(
                        "::notice file={file},line={line},col={column}::no test of {tree} ticks {node}\n"
                    ));
                }
            }
        }
        text
    }

    /// A JSON document.
    pub fn json(&self) -> String {
        let tests = self.tests.iter().map(|test| {
            let failure = test.failure.as_ref();
            let failure = failure.and_then(|(_, json)| serde_json::from_str::<Value>(json).ok());
            json!({
                "title": test.title,
                "tree": test.tree,
                "passed": test.failure.is_none(),
                "ticks": test.ticks,
                "failure": failure,
            })
        });
        let coverage = self.coverage.iter().map(Coverage::json);
        let document = json!({
            "file": self.file,
            "tests": tests.collect::<Vec<_>>(),
            "coverage": coverage.collect::<Vec<_>>(),
        });
        format!("{document:#}\n")
    }
}
