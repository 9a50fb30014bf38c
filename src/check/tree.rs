//! Trees, each with its task.

mod claim;
mod guard;
mod node;
mod test;
mod uncounted;

pub use claim::written;

use super::Checker;
use super::context::Region;
use super::expr::plain_ref;
use super::names::Decl;
use crate::diagnostic::{Applicability, Code};
use crate::ir::task::Task;
use crate::ir::tree::Tree;
use crate::ir::world::Robot;
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, Ident};

impl<'a> Checker<'a> {
    /// `tree name(params) for task = node`
    ///
    /// A tree of a used file gives way to one of its name in a file that uses it.
    pub fn tree(&mut self, tree: &'a ast::Tree, docs: &[String]) {
        if let Some((Decl::Tree(known), _)) = self.names.value(&tree.name.name, false)
            && known.name.span.file != tree.name.span.file
        {
            return;
        }
        if let Some(robot) = self.runs(tree) {
            if let Some(task) = &tree.task {
                self.for_a_robot(tree, task);
            }
            let scope = self.unknown_parameters(tree.params.as_ref());
            self.as_robot(robot, |checker| {
                checker.body_for_itself(&tree.name, Region::Tree, scope, |checker| {
                    checker.node(&tree.root);
                });
            });
            return;
        }
        let task = match &tree.task {
            Some(name) => self.task_of(name),
            None if self.program.tasks.len() == 1 => self.program.tasks.ids().next(),
            None => None,
        };
        let scope = self.unknown_parameters(tree.params.as_ref());
        let mut root = None;
        self.asked.clear();
        self.bodies.of_the_acting = tree.task.is_some() && !self.robots_unsure;
        self.body_for_itself(&tree.name, Region::Tree, scope, |checker| {
            root = checker.node(&tree.root);
        });
        self.bodies.of_the_acting = false;
        let Some(root) = root.filter(|_| tree.params.is_none()) else {
            return;
        };
        if let Some(task) = task {
            self.asks_kept_history(task);
        }
        self.program.trees.push(Tree {
            name: Name::word(&tree.name.name),
            docs: docs.to_vec(),
            task,
            root,
        });
    }

    /// The first of the robots that run a tree as their own, if it is not for a task.
    fn runs(&self, tree: &'a ast::Tree) -> Option<Id<Robot>> {
        let runs = |runs: &Expr| {
            let reference = plain_ref(runs)?;
            Some(reference.name.name == tree.name.name)
        };
        let mut scripts = self.scripts.iter();
        let at = scripts.position(|(_, script)| runs(script) == Some(true))?;
        let for_no_task = tree.task.as_ref().is_none_or(|task| self.is_scripted(task));
        for_no_task.then(|| Id::new(at + 1))
    }

    /// Whether a robot of this name runs a tree of its own.
    fn is_scripted(&self, name: &Ident) -> bool {
        self.scripts
            .iter()
            .any(|(robot, _)| robot.name == name.name)
    }

    /// Reports `tree NAME for ROBOT`: which robot runs a tree is said in the world.
    fn for_a_robot(&mut self, tree: &'a ast::Tree, robot: &'a Ident) {
        let before = tree
            .params
            .as_ref()
            .map_or(tree.name.span, |params| params.span);
        let called = &robot.name;
        self.error(
            Code::E0203,
            robot.span,
            format!("`{called}` is a robot, not a task"),
        )
        .label("only a task is named here")
        .fix(
            format!("`runs` in the world says what `{called}` runs"),
            Span {
                start: before.end,
                ..robot.span
            },
            "",
            Applicability::Safe,
        );
    }

    /// `done(b)` and `failed(b)` ask a window that the task has to keep.
    fn asks_kept_history(&mut self, task: Id<Task>) {
        let task = &self.program.tasks[task];
        let (name, history) = (task.name.clone(), task.history);
        for (place, outcome) in std::mem::take(&mut self.asked) {
            self.unkept((&name, history), place, outcome, "this could never hold");
        }
    }
}
