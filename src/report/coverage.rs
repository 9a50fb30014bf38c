//! The nodes of a tree that tests or episodes have ticked.

use super::words::counted;
use crate::emit::bt;
use crate::ir::Program;
use crate::ir::tree::{Composite, Node};
use crate::tree::size::Price;
use crate::tree::unit::parts;
use crate::trial::test::Answers;
use serde_json::{Value, json};
use std::fmt::Write;

/// The nodes of a tree, with how often tests or episodes have ticked each.
#[derive(Clone, Debug, PartialEq)]
pub struct Coverage {
    /// The tree, as it is named where it is ticked.
    pub tree: String,
    /// Its nodes, in pre-order.
    pub nodes: Vec<Covered>,
}

/// A node.
#[derive(Clone, Debug, PartialEq)]
pub struct Covered {
    /// What it is.
    pub node: String,
    /// How many nodes it is drawn as, as in every [size](crate::tree::size::Size): a guard of two literals is two or more.
    pub drawn: usize,
    /// The node that it stands under.
    pub parent: Option<usize>,
    /// Whether it is `guard => node`: the guard comes next, and then what it guards.
    pub guarded: bool,
    /// Where it is written.
    pub place: Option<Place>,
    /// What it has answered, all together.
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
    /// What has been ticked of a tree; `written` gives the place of a node by its place in pre-order, and what is called
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
    pub fn never(&self) -> impl Iterator<Item = &Covered> {
        let is_ticked = |at: usize| {
            let node = self.nodes.get(at);
            node.is_some_and(|node| node.answers.ticks() > 0)
        };
        let nodes = self.nodes.iter();
        nodes.filter(move |node| node.answers.ticks() == 0 && node.parent.is_none_or(is_ticked))
    }

    /// How many of its nodes were ticked, in a line.
    pub fn headline(&self) -> String {
        let (tree, ticked, all) = (&self.tree, self.ticked(), self.size());
        match ticked == all {
            true => format!("{tree}: every node is ticked"),
            false => format!("{tree}: {ticked} of {} ticked", counted(all, "node")),
        }
    }

    /// A line for each node: in how many ticks it was reached, and in how many of them it succeeded and failed.
    pub fn table(&self) -> String {
        let most = self.nodes.iter().map(|node| node.answers.ticks());
        let width = most.max().unwrap_or(0).to_string().len().max(9);
        let mut text = format!(
            "{:>width$} {:>width$} {:>width$}  {}\n",
            "ticks", "succeeded", "failed", self.tree
        );
        // How deep each node stands in the table; what is guarded stands in the line of its guard.
        let mut depths: Vec<usize> = Vec::new();
        let is_ticked = |parent: Option<usize>| {
            let parent = parent.map(|parent| self.nodes.get(parent));
            parent.is_none_or(|parent| parent.is_some_and(|it| it.answers.ticks() > 0))
        };
        for (at, node) in self.nodes.iter().enumerate() {
            let parent = node.parent.and_then(|parent| self.nodes.get(parent));
            let above = node.parent.and_then(|parent| depths.get(parent)).copied();
            let is_part = parent.is_some_and(|parent| parent.guarded);
            depths.push(match (above, is_part) {
                (None, _) => 0,
                (Some(above), true) => above,
                (Some(above), false) => above + 1,
            });
            if is_part {
                continue;
            }
            let depth = depths.last().copied().unwrap_or(0);
            let (asked, answers) = self.guarded_by(at);
            let why = match (answers.ticks(), asked) {
                (0, Some(asked)) if asked > 0 => "   // the guard never holds",
                (0, _) if is_ticked(node.parent) => "   // never reached",
                _ => "",
            };
            // Writing to a string does not fail.
            let _ = writeln!(
                text,
                "{:>width$} {:>width$} {:>width$}  {}{}{why}",
                answers.ticks(),
                answers.success,
                answers.failure,
                "  ".repeat(depth + 1),
                node.node
            );
        }
        text
    }

    /// The answers of a node or, if it is guarded, of what its guards let through, and how often the last of these was asked.
    fn guarded_by(&self, mut at: usize) -> (Option<u64>, Answers) {
        let mut asked = None;
        while self.nodes.get(at).is_some_and(|node| node.guarded) {
            let guard = self.nodes.get(at + 1);
            asked = guard.map(|guard| guard.answers.ticks());
            at += 2;
        }
        let node = self.nodes.get(at);
        (asked, node.map(|node| node.answers).unwrap_or_default())
    }

    /// As a part of a JSON document.
    pub fn json(&self) -> Value {
        let nodes = self.nodes.iter().map(|node| {
            let place = node.place.as_ref();
            let place =
                place.map(|it| json!({ "file": it.file, "line": it.line, "column": it.column }));
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
            "tree": self.tree,
            "nodes": self.size(),
            "ticked": self.ticked(),
            "each": nodes.collect::<Vec<_>>(),
        })
    }
}

/// The nodes under a parent, itself told with its place among those that were found.
fn walk(program: &Program, node: &Node, parent: Option<(usize, &Node)>, found: &mut Vec<Covered>) {
    let at = found.len();
    found.push(Covered {
        node: word(program, node),
        drawn: Price::of_node(node, parent.map(|(_, parent)| parent)).nodes,
        parent: parent.map(|(at, _)| at),
        guarded: parts(node).is_some(),
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
