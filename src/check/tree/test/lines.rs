//! The lines of a test: what changes, and what is expected.

use super::called;
use crate::check::Checker;
use crate::check::expr::expect::is_literal;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::report::listed;
use crate::check::tree::uncounted::counted;
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::program::Predicate;
use crate::ir::test::{Expected, Line};
use crate::ir::tree::{Atom, Guard, Node, Status};
use crate::source::Span;
use crate::syntax::ast::{self, Answer, Expr, ExprKind, Ref, Spanned, Step, TestLineKind, UnaryOp};
use crate::syntax::print;
use std::collections::BTreeMap;

/// The most ticks that one line of a test may last.
const LONGEST: u64 = 10_000_000;

impl<'a> Checker<'a> {
    /// The lines of a test; `root` is the tree that they have to fit, if there is one.
    pub(super) fn test_lines(
        &mut self,
        test: &'a ast::Test,
        root: Option<&Node>,
    ) -> Option<Vec<Line>> {
        let built: Vec<Option<Line>> = (test.lines.iter())
            .map(|line| match &line.kind {
                TestLineKind::Given(changes) => Some(Line {
                    changes: self.changes(test, changes, root)?,
                    expected: None,
                }),
                TestLineKind::Tick {
                    changes,
                    lasting,
                    steps,
                } => {
                    let changes = self.changes(test, changes, root);
                    let ticks = match lasting {
                        Some(time) => self.lasting(time),
                        None => Some(1),
                    };
                    let expected = self.expected(test, steps, ticks, root);
                    Some(Line {
                        changes: changes?,
                        expected: Some(expected?),
                    })
                }
                TestLineKind::Error => None,
            })
            .collect();
        let ticks = |line: &ast::TestLine| !matches!(line.kind, TestLineKind::Given(_));
        if !test.lines.iter().any(ticks) {
            return self
                .error(Code::E0615, test.title.span, "this test expects nothing")
                .label("it ticks the tree in no line")
                .help("for example: `tick => goto(A)`")
                .none();
        }
        built.into_iter().collect()
    }

    /// What a line changes; whoever says a predicate twice in a line means two things.
    fn changes(
        &mut self,
        test: &'a ast::Test,
        changes: &'a [Expr],
        root: Option<&Node>,
    ) -> Option<Vec<(Id<Predicate>, bool)>> {
        let mut first: BTreeMap<Id<Predicate>, Span> = BTreeMap::new();
        let built: Vec<Option<(Id<Predicate>, bool)>> = (changes.iter())
            .map(|change| {
                let (id, holds) = self.change(change)?;
                if let Some(before) = first.insert(id, change.span) {
                    let name = &self.program.predicates[id].name;
                    let message = format!("`{name}` is set twice in a line");
                    return self
                        .error(Code::E0614, change.span, message)
                        .label("set again here")
                        .also(before, "first set here")
                        .none();
                }
                let mut asks = root.is_none();
                if let Some(root) = root {
                    root.visit_atoms(&mut |atom| asks |= atom == Atom::Predicate(id));
                }
                if !asks {
                    let (name, tree) = (&self.program.predicates[id].name, called(&test.tree));
                    let message = format!("`{tree}` does not ask `{name}`");
                    self.warning(Code::W0603, change.span, message)
                        .label("it does the same whether this holds or not");
                }
                Some((id, holds))
            })
            .collect();
        built.into_iter().collect()
    }

    /// A predicate that holds or, behind `not`, does not.
    fn change(&mut self, change: &'a Expr) -> Option<(Id<Predicate>, bool)> {
        let span = change.span;
        if let Some(reference) = plain_ref(denied(change))
            && let Some((decl @ Decl::Event(_), _)) = self.value_of(&reference.name)
        {
            let label = format!("`{}` is {}", reference.name.name, decl.what());
            return self
                .error(Code::E0614, span, "a test sets predicates, one by one")
                .label(label)
                .help("nothing happens in a test: say what holds once this has happened")
                .none();
        }
        let (label, help) = match self.guard(change)? {
            Guard::Atom(Atom::Predicate(id)) => return Some((id, true)),
            Guard::Not(inner) => match *inner {
                Guard::Atom(Atom::Predicate(id)) => return Some((id, false)),
                Guard::Atom(_) => history(),
                _ => (
                    "more than one predicate",
                    "part them by commas: `low, not full`",
                ),
            },
            Guard::Atom(_) => history(),
            Guard::And(_) => (
                "more than one predicate",
                "part them by commas: `low, not full`",
            ),
            Guard::Or(_) => (
                "this leaves open which of them holds",
                "say of each whether it holds: `low, not full`",
            ),
            Guard::Const(_) => ("this is no predicate", "say what holds: `low, not full`"),
        };
        self.error(Code::E0614, span, "a test sets predicates, one by one")
            .label(label)
            .help(help)
            .none()
    }

    /// For how many ticks a line lasts. Ticks themselves are counted without a world, too.
    fn lasting(&mut self, time: &'a Expr) -> Option<u64> {
        let ticks = match counted(time) {
            Some(ticks) => ticks,
            None if !self.has_world => {
                let count = is_literal(time).then(|| {
                    let title = format!("count them: write `{} ticks`", print::expr(time));
                    (title, time.span.after(), " ticks".to_owned())
                });
                let label = match count {
                    Some(_) => "this is a plain number",
                    None => "how many ticks are these?",
                };
                self.no_world(time.span, "a time", label).fix_if(count);
                return None;
            }
            None => self.ticks(time, "`for`")?,
        };
        if ticks > LONGEST {
            let message = "a line of a test lasts 10_000_000 ticks at most";
            return self
                .out_of_range(time.span, message, "this is too long")
                .none();
        }
        Some(ticks)
    }

    fn expected(
        &mut self,
        test: &'a ast::Test,
        steps: &'a [Step],
        ticks: Option<u64>,
        root: Option<&Node>,
    ) -> Option<Expected> {
        let mut behaviors = Vec::new();
        let mut answer: Option<(Status, Span)> = None;
        let mut fine = true;
        for step in steps {
            if let Some((_, of_tree)) = answer {
                self.error(
                    Code::E0615,
                    step.span(),
                    "what the tree answers is said last",
                )
                .label("this stands behind it")
                .also(of_tree, "move this to the end");
                return None;
            }
            if self.is_tested(test, &step.name, root) {
                answer = Some((self.answer_of_tree(step)?, step.span()));
                continue;
            }
            match self.stepped(test, &step.name, root) {
                Some(id) => {
                    let answer = step.answer.map_or(Status::Running, status);
                    if answer != Status::Running && !self.program.may_end(id, answer) {
                        self.answers_never(step, id);
                    }
                    behaviors.push((id, answer));
                }
                None => fine = false,
            }
        }
        fine.then_some(Expected {
            ticks: ticks?,
            behaviors,
            answer: answer.map(|(status, _)| status),
        })
    }

    /// Warns of an answer that a behaviour never gives.
    fn answers_never(&mut self, step: &Step, id: Id<Behavior>) {
        let name = self.program.behaviors[id].name.bare();
        let ends = match step.answer.map(|answer| answer.node) {
            Some(Answer::Fails) => "fails",
            _ => "succeeds",
        };
        self.warning(Code::W0609, step.span(), format!("`{name}` never {ends}"))
            .label("so nothing is ever like this");
    }

    /// Whether a reference names the tree that is tested. Where that was not understood, its arguments do not count.
    fn is_tested(&mut self, test: &'a ast::Test, name: &'a Ref, root: Option<&Node>) -> bool {
        let word = name.name.name.as_str();
        let learner = self.names.learners.get(word).copied();
        let is_tree = matches!(self.names.value(word, false), Some((Decl::Tree(_), _)));
        let named = name.name.name == test.tree.name.name;
        let same = called(name) == called(&test.tree) || root.is_none() && named;
        if !same || !is_tree && learner.is_none() {
            return false;
        }
        if let Some(learner) = learner.and_then(|learn| learn.name.as_ref()) {
            self.stands_for(&name.name, learner.span);
        }
        self.value_of(&name.name);
        true
    }

    fn answer_of_tree(&mut self, step: &'a Step) -> Option<Status> {
        match step.answer {
            Some(answer) => Some(status(answer)),
            None => {
                let tree = called(&step.name);
                self.error(Code::E0615, step.name.span, format!("what does `{tree}` answer?"))
                    .label("this is the tree that is tested")
                    .help(format!(
                        "say `{tree} succeeds`, `{tree} fails` or `{tree} runs`, or name the behaviour that it selects"
                    ))
                    .none()
            }
        }
    }

    /// The behaviour that is expected, if the tree has it.
    fn stepped(
        &mut self,
        test: &'a ast::Test,
        name: &'a Ref,
        root: Option<&Node>,
    ) -> Option<Id<Behavior>> {
        let id = self.behavior_ref(name)?;
        let Some(root) = root else { return Some(id) };
        let mut has: Vec<Id<Behavior>> = Vec::new();
        root.visit_behaviors(&mut |behavior| {
            if !has.contains(&behavior) {
                has.push(behavior);
            }
        });
        if has.contains(&id) {
            return Some(id);
        }
        let behavior = &self.program.behaviors[id].name;
        let message = format!(
            "`{}` does not have the behaviour `{behavior}`",
            called(&test.tree)
        );
        let names = has
            .iter()
            .map(|id| self.program.behaviors[*id].name.to_string());
        let names: Vec<String> = names.collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        let help = match names.as_slice() {
            [] => "it has none".to_owned(),
            names => format!("it has {}", listed(names, "and")),
        };
        self.error(Code::E0613, name.span, message)
            .label("it can never select this")
            .help(help)
            .none()
    }
}

/// What stands behind `not`, if that is there.
fn denied(change: &Expr) -> &Expr {
    match &change.kind {
        ExprKind::Unary { op, operand } if op.node == UnaryOp::Not => operand,
        _ => change,
    }
}

/// Why what the history says is not set, and what to do.
fn history() -> (&'static str, &'static str) {
    (
        "what has ended follows from the ticks before",
        "let the behaviour end: `tick => goto(A) succeeds`",
    )
}

fn status(answer: Spanned<Answer>) -> Status {
    match answer.node {
        Answer::Succeeds => Status::Success,
        Answer::Fails => Status::Failure,
        Answer::Runs => Status::Running,
    }
}
