//! Tests of trees, with the nodes that they tick.

use super::words::{command_data, command_property, counted};
use crate::emit::bt;
use crate::ir::Program;
use crate::ir::test::Test;
use crate::ir::tree::{Composite, Node};
use crate::tree::size::Price;
use crate::trial::test::Answers;
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

/// The nodes of a tree, with how often tests have ticked each.
#[derive(Clone, Debug)]
pub struct Coverage {
    /// The tree, as the tests name it.
    pub tree: String,
    /// Its nodes, in pre-order.
    pub nodes: Vec<Covered>,
}

/// A node.
#[derive(Clone, Debug)]
pub struct Covered {
    /// What it is.
    pub node: String,
    /// How many nodes it is drawn as, as in every [size](crate::tree::size::Size): a guard of two literals is two or more.
    pub drawn: usize,
    /// The node that it stands under.
    pub parent: Option<usize>,
    /// Where it is written.
    pub place: Option<Place>,
    /// What it has answered, all tests together.
    pub answers: Answers,
}

/// A place in a file; lines and columns are counted from one.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: String,
    /// The line.
    pub line: usize,
    /// The column, in characters.
    pub column: usize,
}

impl Coverage {
    /// What one test has ticked of a tree; `written` gives the place of a node by its place in pre-order, and what is called
    /// there if it is a subtree.
    pub fn of(
        program: &Program,
        tree: &str,
        root: &Node,
        answers: &[Answers],
        written: impl Fn(usize) -> (Option<Place>, Option<String>),
    ) -> Self {
        let mut nodes = Vec::new();
        walk(program, root, None, &mut nodes);
        for (at, node) in nodes.iter_mut().enumerate() {
            let (place, called) = written(at);
            node.place = place;
            node.node = called.unwrap_or_else(|| std::mem::take(&mut node.node));
            node.answers = answers.get(at).copied().unwrap_or_default();
        }
        Self {
            tree: tree.to_owned(),
            nodes,
        }
    }

    /// How many nodes were ticked: those of a guard that was asked.
    fn ticked(&self) -> usize {
        let nodes = self.nodes.iter();
        let ticked = nodes.filter(|node| node.answers.ticks() > 0);
        ticked.map(|node| node.drawn).sum()
    }

    /// How many nodes there are.
    fn size(&self) -> usize {
        self.nodes.iter().map(|node| node.drawn).sum()
    }

    /// The nodes that no test has ticked, without those under them.
    fn never(&self) -> impl Iterator<Item = &Covered> {
        let is_ticked = |at: usize| {
            let node = self.nodes.get(at);
            node.is_some_and(|node| node.answers.ticks() > 0)
        };
        let nodes = self.nodes.iter();
        nodes.filter(move |node| node.answers.ticks() == 0 && node.parent.is_none_or(is_ticked))
    }

    /// How many of its nodes were ticked, in a line.
    fn headline(&self) -> String {
        let (tree, ticked, all) = (&self.tree, self.ticked(), self.size());
        match ticked == all {
            true => format!("{tree}: every node is ticked"),
            false => format!("{tree}: {ticked} of {} ticked", counted(all, "node")),
        }
    }
}

/// The nodes under a parent, itself told with its place among those that were found.
fn walk(program: &Program, node: &Node, parent: Option<(usize, &Node)>, found: &mut Vec<Covered>) {
    let at = found.len();
    found.push(Covered {
        node: word(program, node),
        drawn: Price::of_node(node, parent.map(|(_, parent)| parent)).nodes,
        parent: parent.map(|(at, _)| at),
        place: None,
        answers: Answers::default(),
    });
    for child in node.children() {
        walk(program, child, Some((at, node)), found);
    }
}

/// A node in a few words: a guard, a behaviour, `memory sequence`, `low => …`.
pub fn word(program: &Program, node: &Node) -> String {
    match node {
        Node::Condition(guard) => bt::guard(program, guard),
        Node::Behavior(id) => program.behaviors[*id].name.to_string(),
        Node::Composite {
            kind,
            memory,
            children,
        } => match (kind, memory, children.as_slice()) {
            (Composite::Sequence, false, [Node::Condition(guard), then]) => {
                format!("{} => {}", bt::guard(program, guard), word(program, then))
            }
            _ => kind.word(*memory).to_owned(),
        },
        Node::Parallel { successes, .. } => format!("parallel({successes})"),
        Node::Decorator { kind, .. } => match kind.to_string().split_once(' ') {
            Some((word, much)) => format!("{word}({much})"),
            None => kind.to_string(),
        },
    }
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
        let coverage = self.coverage.iter().map(|tree| {
            let nodes = tree.nodes.iter().map(|node| {
                let place = node.place.as_ref();
                let place = place
                    .map(|it| json!({ "file": it.file, "line": it.line, "column": it.column }));
                json!({
                    "node": node.node,
                    "parent": node.parent,
                    "place": place,
                    "ticks": node.answers.ticks(),
                    "success": node.answers.success,
                    "failure": node.answers.failure,
                    "running": node.answers.running,
                })
            });
            json!({
                "tree": tree.tree,
                "nodes": tree.size(),
                "ticked": tree.ticked(),
                "each": nodes.collect::<Vec<_>>(),
            })
        });
        let document = json!({
            "file": self.file,
            "tests": tests.collect::<Vec<_>>(),
            "coverage": coverage.collect::<Vec<_>>(),
        });
        format!("{document:#}\n")
    }
}
