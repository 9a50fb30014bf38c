//! Nodes without effect in subtrees with parameters and in the scripts of robots, and times that no episode lasts.
//!
//! A subtree with parameters has a body for each set of arguments, and a script one for each robot. What is said of it
//! holds for all that the program uses.

use super::cases::Cases;
use crate::check::Checker;
use crate::check::names::Decl;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Name;
use crate::ir::tree::{Decorator, Node};
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, Expr, ExprKind, Item, ItemKind, NodeKind};
use std::collections::BTreeMap;

/// How many uses of one subtree are looked at; of one with more, nothing is said.
const MOST: usize = 100;

/// The subtrees with parameters, by where their names stand, each with what it is under the arguments of its uses.
type Uses<'a> = BTreeMap<Span, (&'a ast::Tree, Vec<Node>)>;

impl<'a> Checker<'a> {
    /// Warns of nodes in subtrees with parameters that have no effect whatever the arguments are, and of timeouts that
    /// never run out.
    pub fn subtrees_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut uses = Uses::new();
        for item in items {
            let ItemKind::Tree(tree) = &item.kind else {
                continue;
            };
            let name = Name::word(&tree.name.name);
            let Some(id) = self.program.trees.named(&name) else {
                continue;
            };
            let built = &self.program.trees[id];
            let episode = built.task.map(|task| self.program.tasks[task].end_after);
            let root = built.root.clone();
            self.timeouts(&tree.root, &root, episode.unwrap_or(0));
            self.uses(&tree.root, &root, &mut uses);
        }
        self.scripts_used(&mut uses);
        for (tree, nodes) in uses.into_values() {
            let mut told: Option<Vec<Diagnostic>> = None;
            for node in nodes.iter().take(MOST) {
                let always = Cases::constant(true);
                let ((), found) = self.captured(|checker| {
                    checker.nodes_of(&tree.root, node, &always, &always);
                });
                told = Some(match told {
                    None => found,
                    Some(told) => told.into_iter().filter(|it| found.contains(it)).collect(),
                });
            }
            if nodes.len() <= MOST {
                self.diagnostics.extend(told.into_iter().flatten());
            }
        }
    }

    /// Collects the trees that other robots run.
    fn scripts_used(&self, uses: &mut Uses<'a>) {
        let others = self
            .program
            .world
            .iter()
            .flat_map(|world| world.others.values());
        for ((_, runs), other) in self.scripts.iter().zip(others) {
            let (Some(tree), Some(node)) = (self.called(runs), &other.script) else {
                continue;
            };
            let (_, nodes) = uses.entry(tree.name.span).or_insert((tree, Vec::new()));
            nodes.push(node.clone());
            self.uses(&tree.root, node, uses);
        }
    }

    /// Collects the uses of subtrees with parameters.
    fn uses(&self, written: &'a ast::Node, node: &Node, uses: &mut Uses<'a>) {
        match (&written.kind, node.children()) {
            (NodeKind::Guarded { node: inner, .. }, [_, rest]) => self.uses(inner, rest, uses),
            (NodeKind::Composite { children, .. }, nodes) if children.len() == nodes.len() => {
                for (written, node) in children.iter().zip(nodes) {
                    self.uses(written, node, uses);
                }
            }
            (NodeKind::Leaf(leaf), _) => {
                let Some(tree) = self.called(leaf) else {
                    return;
                };
                if tree.params.is_some() {
                    let (_, nodes) = uses.entry(tree.name.span).or_insert((tree, Vec::new()));
                    if nodes.len() > MOST {
                        return;
                    }
                    nodes.push(node.clone());
                }
                self.uses(&tree.root, node, uses);
            }
            _ => {}
        }
    }

    /// The subtree that a leaf calls.
    fn called(&self, leaf: &'a Expr) -> Option<&'a ast::Tree> {
        match &leaf.kind {
            ExprKind::Ref(reference) => match self.names.value(&reference.name.name, false) {
                Some((Decl::Tree(tree), _)) => Some(tree),
                _ => None,
            },
            ExprKind::Paren(inner) => self.called(inner),
            _ => None,
        }
    }

    /// Warns of timeouts of a tree that last as long as an episode, of `episode` ticks.
    fn timeouts(&mut self, written: &'a ast::Node, node: &Node, episode: u64) {
        match (&written.kind, node) {
            (NodeKind::Guarded { node: inner, .. }, node) => {
                if let [_, rest] = node.children() {
                    self.timeouts(inner, rest, episode);
                }
            }
            (
                NodeKind::Composite { args, children, .. },
                Node::Decorator {
                    kind: Decorator::Timeout(ticks),
                    child,
                },
            ) => {
                let arg = args.as_deref().and_then(<[ast::Arg]>::first);
                if episode > 0
                    && *ticks >= episode
                    && let Some(ArgKind::Positional(time)) = arg.map(|arg| &arg.kind)
                {
                    self.warning(Code::W0512, time.span, "no episode lasts so long")
                        .label("so this timeout never runs out")
                        .note(format!("an episode ends after {episode} ticks"));
                }
                if let [only] = children.as_slice() {
                    self.timeouts(only, child, episode);
                }
            }
            (NodeKind::Composite { children, .. }, node) => {
                for (written, node) in children.iter().zip(node.children()) {
                    self.timeouts(written, node, episode);
                }
            }
            _ => {}
        }
    }
}
