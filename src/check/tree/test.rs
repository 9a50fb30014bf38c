//! Tests of trees without a world.

mod lines;

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::names::Decl;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::task::Task;
use crate::ir::test::{Subject, Test};
use crate::ir::tree::Node;
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind, Ref};
use crate::syntax::print;
use std::collections::BTreeMap;

/// The tree that a test ticks.
struct Tested {
    subject: Subject,
    task: Option<Id<Task>>,
    /// The robot that runs it.
    robot: Id<Robot>,
    /// Its root, where the test has to fit it. A tree that was learned anew in another file may do otherwise: then the test
    /// fails.
    root: Option<Node>,
}

impl<'a> Checker<'a> {
    /// `test "title" of tree { … }`. `lost`: it was not understood what a robot runs, so nobody knows which robot a script is read by.
    pub fn test(&mut self, test: &'a ast::Test, lost: bool) {
        self.context = Context::new(Region::Tree);
        let (tested, told) = self.captured(|checker| checker.tested(test));
        let told = told
            .into_iter()
            .filter(|found| !(lost && of_a_robot(found)));
        self.diagnostics.extend(told);
        let robot = tested.as_ref().map_or(World::acting(), |it| it.robot);
        let root = tested.as_ref().and_then(|tested| tested.root.as_ref());
        let (lines, told) = self
            .captured(|checker| checker.as_robot(robot, |checker| checker.test_lines(test, root)));
        // Where the tree was not understood, nobody knows which robot runs it, nor that a tree named there is this one.
        let of_the_tree = |found: &Diagnostic| matches!(found.code, Code::E0203 | Code::E0613);
        let follows =
            |found: &Diagnostic| tested.is_none() && (of_a_robot(found) || of_the_tree(found));
        let told = told.into_iter().filter(|found| !follows(found));
        self.diagnostics.extend(told);
        if let (Some(tested), Some(lines)) = (tested, lines) {
            self.program.tests.push(Test {
                title: test.title.name.clone(),
                tree: called(&test.tree),
                subject: tested.subject,
                task: tested.task,
                lines,
            });
        }
    }

    /// Whether a mistake was told of what another robot runs, or of a robot that runs nothing.
    pub fn a_script_is_lost(&self) -> bool {
        let scripts = self.scripts.iter().map(|(_, runs)| runs.span);
        let scripts: BTreeMap<_, Span> = scripts.map(|at| ((at.file, at.start), at)).collect();
        let mut told = self.diagnostics.iter();
        self.robots_unsure
            || told.any(|found| {
                let place = found.span();
                let before = scripts.range(..=(place.file, place.start)).next_back();
                let within = |script: &Span| script.file == place.file && place.end <= script.end;
                found.code == Code::E0408
                    || found.is_error() && before.is_some_and(|(_, script)| within(script))
            })
    }

    fn tested(&mut self, test: &'a ast::Test) -> Option<Tested> {
        let tree = &test.tree;
        let name = tree.name.name.as_str();
        let learner = self.names.learners.get(name).copied();
        let Some((Decl::Tree(decl), library)) = self.names.value(name, false) else {
            return self.learned(tree);
        };
        self.value_of(&tree.name);
        let robot = self.runs(decl);
        let runner = robot.unwrap_or(World::acting());
        let whole = decl.params.is_none() && tree.args.is_none() && robot.is_none();
        let (subject, root, task) = if whole {
            let called = Name::word(name);
            let Some(id) = self.program.trees.named(&called) else {
                self.needed.push((decl, tree.span));
                return None;
            };
            let known = &self.program.trees[id];
            (Subject::Tree(id), known.root.clone(), known.task)
        } else {
            self.asked.clear();
            let root = self.as_robot(runner, |checker| checker.subtree(decl, library, tree));
            let Some(root) = root else {
                self.needed.push((decl, tree.span));
                return None;
            };
            let task = self.task_for(decl).filter(|_| robot.is_none());
            if let Some(task) = task {
                self.asks_kept_history(task);
            }
            (Subject::Subtree(root.clone()), root, task)
        };
        let fits = decl.name.span.file == test.title.span.file || learner.is_none();
        Some(Tested {
            subject,
            task,
            robot: runner,
            root: fits.then_some(root),
        })
    }

    /// The task that a tree is for, or the only one.
    fn task_for(&self, tree: &ast::Tree) -> Option<Id<Task>> {
        let tasks = &self.program.tasks;
        match &tree.task {
            Some(task) => tasks.named(&Name::word(&task.name)),
            None => tasks.ids().next().filter(|_| tasks.len() == 1),
        }
    }

    /// The tree that a learner is yet to learn.
    fn learned(&mut self, tree: &'a Ref) -> Option<Tested> {
        let name = tree.name.name.as_str();
        let Some(learn) = self.names.learners.get(name).copied() else {
            let trees = self.names.values(|decl| matches!(decl, Decl::Tree(_)));
            let trees = trees.chain(self.names.learners.keys().copied());
            let likely = self.likely(name, trees);
            return match self.value_of(&tree.name) {
                Some((decl, _)) => {
                    let mut scripts = self.scripts.iter();
                    let script = scripts.find(|(robot, _)| robot.name == name);
                    let help = script
                        .map(|(_, tree)| format!("test what it runs: `of {}`", print::expr(tree)));
                    self.error(Code::E0203, tree.span, "a tree is needed here")
                        .label(format!("`{name}` is {}", decl.what()))
                        .help_if(help)
                        .none()
                }
                None => self.undeclared(&tree.name, "tree", likely).none(),
            };
        };
        if let Some(name) = &learn.name {
            self.stands_for(&tree.name, name.span);
        }
        let called = Name::word(name);
        let id = self.program.learners.named(&called)?;
        Some(Tested {
            subject: Subject::Learned(id),
            task: Some(self.program.learners[id].task),
            robot: World::acting(),
            root: None,
        })
    }
}

/// Whether something is told of the robot that reads.
fn of_a_robot(found: &Diagnostic) -> bool {
    matches!(found.code, Code::E0406 | Code::E0411)
}

/// A reference as it is written.
fn called(reference: &Ref) -> String {
    print::expr(&Expr {
        kind: ExprKind::Ref(reference.clone()),
        span: reference.span,
    })
}
