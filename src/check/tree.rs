//! Trees: composites, guards over atoms, subtrees unrolled.

pub mod claim;

use super::Checker;
use super::context::{Binding, Region};
use super::expr::ending::keeping;
use super::names::{Decl, unknown};
use super::types::{Type, Value};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::ir::law::{Block, Stmt};
use crate::ir::task::Task;
use crate::ir::tree::{Atom, Composite, Decorator, Guard, Node, Tree};
use crate::ir::{Id, Name, law};
use crate::source::Span;
use crate::syntax::ast::{
    self, Arg, ArgKind, BinaryOp, Expr, ExprKind, NodeKind, Outcome, Ref, Spanned, UnaryOp, Word,
};
use crate::syntax::print;

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
        let task = match &tree.task {
            Some(name) => {
                let called = Name::word(&name.name);
                let task = self.program.tasks.find(|task| task.name == called);
                if task.is_none() && !self.names.tasks.contains_key(name.name.as_str()) {
                    let diagnostic = unknown(name, "task", self.names.tasks.keys().copied());
                    self.report(diagnostic);
                }
                task
            }
            None if self.program.tasks.len() == 1 => self.program.tasks.ids().next(),
            None => None,
        };
        let scope = self.unknown_parameters(tree.params.as_ref());
        let mut root = None;
        self.asked.clear();
        self.body_for_itself(&tree.name, Region::Tree, scope, |checker| {
            root = checker.node(&tree.root);
        });
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

    /// `done(b)` and `failed(b)` ask a window that the task has to keep; one message for each outcome.
    fn asks_kept_history(&mut self, task: Id<Task>) {
        let history = self.program.tasks[task].history;
        for (kept, asks, outcome) in [
            (history.success, Outcome::Success, "success"),
            (history.failure, Outcome::Failure, "failure"),
        ] {
            let asked = self.asked.iter().find(|(_, outcome)| *outcome == asks);
            if let Some(&(span, _)) = asked
                && !kept
            {
                let name = &self.program.tasks[task].name;
                let message = format!("the task `{name}` keeps no {outcome} in its history");
                self.report(
                    Diagnostic::new(Code::E0607, span, message)
                        .label("this could never hold")
                        .help(format!("let the task say `{}`", keeping(history, outcome))),
                );
            }
        }
    }

    fn node(&mut self, node: &'a ast::Node) -> Option<Node> {
        match &node.kind {
            NodeKind::Composite {
                memory,
                word,
                args,
                children,
            } => self.composite(*memory, *word, args.as_deref(), children),
            NodeKind::Guarded { guard, node } => {
                let guard = self.guard(guard);
                let node = self.node(node);
                Some(Node::Composite {
                    kind: Composite::Sequence,
                    memory: false,
                    children: vec![Node::Condition(guard?), node?],
                })
            }
            NodeKind::Leaf(expr) => self.leaf_node(expr),
            NodeKind::Error => None,
        }
    }

    fn composite(
        &mut self,
        memory: Option<Span>,
        word: Spanned<Word>,
        args: Option<&'a [Arg]>,
        children: &'a [ast::Node],
    ) -> Option<Node> {
        let takes_memory = matches!(word.node, Word::Selector | Word::Sequence);
        if let Some(span) = memory
            && !takes_memory
        {
            self.report(
                Diagnostic::new(
                    Code::E0604,
                    span,
                    format!("`{}` has no memory", word_name(word.node)),
                )
                .label("only a selector or a sequence resumes at its running child")
                .fix("take it away", span, "", Applicability::Unsafe),
            );
        }
        let number = self.node_argument(word, args);
        let built: Vec<Option<Node>> = children.iter().map(|child| self.node(child)).collect();
        if children.is_empty() {
            self.report(
                Diagnostic::new(
                    Code::E0602,
                    word.span,
                    format!("this `{}` is empty", word_name(word.node)),
                )
                .label("it has no child to tick"),
            );
            return None;
        }
        let decorator = !matches!(word.node, Word::Selector | Word::Sequence | Word::Parallel);
        if decorator && let Some(second) = children.get(1) {
            self.report(
                Diagnostic::new(
                    Code::E0603,
                    second.span,
                    format!("`{}` decorates one node", word_name(word.node)),
                )
                .label("a second child")
                .help("put them under a `sequence { … }` or a `selector { … }`"),
            );
            return None;
        }
        if word.node == Word::Parallel {
            let at = args
                .and_then(<[Arg]>::first)
                .map_or(word.span, |arg| arg.span);
            self.one_drives(children, &built, number, at);
        }
        let mut children: Vec<Node> = built.into_iter().collect::<Option<_>>()?;
        let kind = match word.node {
            Word::Selector | Word::Sequence => {
                return Some(Node::Composite {
                    kind: if word.node == Word::Selector {
                        Composite::Selector
                    } else {
                        Composite::Sequence
                    },
                    memory: memory.is_some(),
                    children,
                });
            }
            Word::Parallel => {
                return Some(Node::Parallel {
                    successes: u32::try_from(number?).unwrap_or(u32::MAX),
                    children,
                });
            }
            Word::Invert => Decorator::Invert,
            Word::Succeed => Decorator::Succeed,
            Word::Fail => Decorator::Fail,
            Word::Retry => Decorator::Retry(u32::try_from(number?).unwrap_or(u32::MAX)),
            Word::Repeat => Decorator::Repeat(u32::try_from(number?).unwrap_or(u32::MAX)),
            Word::Timeout => Decorator::Timeout(number?),
        };
        Some(Node::Decorator {
            kind,
            child: Box::new(children.pop()?),
        })
    }

    /// The number of `parallel(n)`, `retry(n)`, `repeat(n)`, the ticks of `timeout(t)`; the other words have none.
    fn node_argument(&mut self, word: Spanned<Word>, args: Option<&'a [Arg]>) -> Option<u64> {
        let name = word_name(word.node);
        let takes = matches!(
            word.node,
            Word::Parallel | Word::Retry | Word::Repeat | Word::Timeout
        );
        match (takes, args) {
            (false, None) => None,
            (false, Some(args)) => {
                let span = args.first().map_or(word.span, |arg| arg.span);
                self.report(
                    Diagnostic::new(Code::E0606, span, format!("`{name}` takes no argument"))
                        .label("this says nothing here"),
                );
                None
            }
            (true, Some([arg])) => match &arg.kind {
                ArgKind::Positional(value) if word.node == Word::Timeout => {
                    self.ticks(value, "a timeout")
                }
                ArgKind::Positional(value) => {
                    let role = format!("the number of `{name}`");
                    let number = self.constant(value, &Type::NUMBER, &role)?;
                    if number.fract() == 0.0 && (1.0..=1e6).contains(&number) {
                        return Some(number as u64);
                    }
                    self.out_of_range(
                        value.span,
                        &format!("{role} is a whole number from 1 to a million"),
                        "this is not",
                    );
                    None
                }
                _ => {
                    self.report(
                        Diagnostic::new(Code::E0606, arg.span, format!("`{name}` takes a number"))
                            .label("not a number"),
                    );
                    None
                }
            },
            (true, _) => {
                let example = if word.node == Word::Timeout {
                    "timeout(10 s) { … }".to_owned()
                } else {
                    format!("{name}(2) {{ … }}")
                };
                self.report(
                    Diagnostic::new(
                        Code::E0606,
                        word.span,
                        format!("`{name}` takes one argument"),
                    )
                    .label("how many?")
                    .help(format!("for example: `{example}`")),
                );
                None
            }
        }
    }

    /// A robot has one drive: of the children of a `parallel` one at most may use it.
    fn one_drives(
        &mut self,
        children: &'a [ast::Node],
        built: &[Option<Node>],
        successes: Option<u64>,
        at: Span,
    ) {
        let drives = |node: &Option<Node>| {
            node.as_ref().is_some_and(|node| {
                let mut drives = false;
                node.visit_behaviors(&mut |id| {
                    let law = self.program.behaviors[id].law.as_ref();
                    drives |= law.is_none_or(|law| commands(&law.control));
                });
                drives
            })
        };
        let mut driving = children
            .iter()
            .zip(built)
            .filter(|(_, node)| drives(node))
            .map(|(child, _)| child.span);
        if let (Some(first), Some(second)) = (driving.next(), driving.next()) {
            self.report(
                Diagnostic::new(Code::E0605, second, "two children of a `parallel` drive")
                    .label("this one drives too")
                    .also(first, "this one drives")
                    .help("a robot has one drive: use one tree for each actuator"),
            );
        }
        if let Some(n) = successes
            && n > children.len() as u64
        {
            self.report(
                Diagnostic::new(
                    Code::E0606,
                    at,
                    format!(
                        "so many children cannot succeed: there are {}",
                        children.len()
                    ),
                )
                .label("more than there are"),
            );
        }
    }

    /// A behaviour, a subtree, or a condition.
    fn leaf_node(&mut self, expr: &'a Expr) -> Option<Node> {
        if let ExprKind::Ref(reference) = strip(expr) {
            let name = reference.name.name.as_str();
            let bound = self.context.lookup(name).is_some();
            match self.names.value(name, self.context.library) {
                Some((Decl::Behavior(behavior), library)) if !bound => {
                    return match self.behavior_instance(behavior, library, reference)? {
                        Value::Behavior(id) => Some(Node::Behavior(id)),
                        _ => None,
                    };
                }
                Some((Decl::Tree(tree), library)) if !bound => {
                    return self.subtree(tree, library, reference);
                }
                Some((Decl::Predicate(_), _)) => {}
                Some((decl, _)) if !bound => {
                    self.report(
                        Diagnostic::new(
                            Code::E0203,
                            reference.span,
                            format!("`{name}` is no node of a tree"),
                        )
                        .label(format!("this is {}", decl.what()))
                        .help("a node is a behaviour, a subtree, or a predicate"),
                    );
                    return None;
                }
                None if !matches!(name, "done" | "failed") => {
                    let nodes = self.names.values(|decl| {
                        matches!(decl, Decl::Behavior(_) | Decl::Tree(_) | Decl::Predicate(_))
                    });
                    let diagnostic =
                        unknown(&reference.name, "behaviour, subtree or predicate", nodes);
                    let diagnostic = self.perhaps_of_library(diagnostic, name);
                    self.report(diagnostic);
                    return None;
                }
                _ => {}
            }
        }
        self.guard(expr).map(Node::Condition)
    }

    fn subtree(&mut self, tree: &'a ast::Tree, library: bool, reference: &'a Ref) -> Option<Node> {
        let params = tree.params.as_ref();
        let scope: Vec<Binding> = self.bind_arguments(params, library, reference, Region::Let)?;
        if scope.iter().any(|binding| binding.value == Value::Unknown) {
            return None;
        }
        let body = tree.name.span;
        self.unrolled(body, reference, library, Region::Tree, scope, |checker| {
            checker.node(&tree.root)
        })
        .flatten()
    }

    /// A formula over predicates and the history.
    fn guard(&mut self, expr: &'a Expr) -> Option<Guard> {
        match &expr.kind {
            ExprKind::Bool(value) => Some(Guard::Const(*value)),
            ExprKind::Paren(inner) => self.guard(inner),
            ExprKind::Unary { op, operand } if op.node == UnaryOp::Not => {
                self.guard(operand).map(|guard| Guard::Not(Box::new(guard)))
            }
            ExprKind::Binary { op, left, right }
                if matches!(op.node, BinaryOp::And | BinaryOp::Or) =>
            {
                let (left, right) = (self.guard(left), self.guard(right));
                Some(joined(op.node == BinaryOp::And, left?, right?))
            }
            ExprKind::Ref(reference) => self.atom(reference).map(Guard::Atom),
            ExprKind::Error => None,
            ExprKind::Binary { op, .. } if op.node <= BinaryOp::Ge => {
                self.report(
                    Diagnostic::new(Code::E0601, expr.span, "a guard asks predicates by name")
                        .label("this comparison has none")
                        .help(format!(
                            "give it one: `predicate NAME = {}`",
                            print::expr(expr)
                        )),
                );
                None
            }
            _ => {
                self.report(
                    Diagnostic::new(Code::E0601, expr.span, "a guard asks predicates by name")
                        .label("this is neither a predicate nor `and`, `or`, `not` of some"),
                );
                None
            }
        }
    }

    fn atom(&mut self, reference: &'a Ref) -> Option<Atom> {
        let name = reference.name.name.as_str();
        if matches!(name, "done" | "failed") {
            let values = self.positional(reference, 1, 1)?;
            let ended = values.first().copied()?;
            let ExprKind::Ref(behavior) = strip(ended) else {
                self.report(
                    Diagnostic::new(
                        Code::E0203,
                        ended.span,
                        format!("`{name}` asks a behaviour"),
                    )
                    .label("this is an expression"),
                );
                return None;
            };
            let id = self.behavior_ref(behavior)?;
            let outcome = if name == "done" {
                Outcome::Success
            } else {
                Outcome::Failure
            };
            self.asked.push((reference.span, outcome));
            return Some(if name == "done" {
                Atom::Done(id)
            } else {
                Atom::Failed(id)
            });
        }
        match self.names.value(name, self.context.library) {
            Some((Decl::Predicate(predicate), library)) => self
                .predicate_instance(predicate, library, reference)
                .map(Atom::Predicate),
            Some((decl, _)) => {
                self.report(
                    Diagnostic::new(
                        Code::E0601,
                        reference.span,
                        "a guard asks predicates by name",
                    )
                    .label(format!("`{name}` is {}", decl.what()))
                    .help(match decl {
                        Decl::Behavior(_) | Decl::Tree(_) => {
                            "nodes that follow each other: `sequence { …, … }`".to_owned()
                        }
                        Decl::Event(_) => {
                            "remember it in a state, and ask that by a predicate".to_owned()
                        }
                        _ => named(reference),
                    }),
                );
                None
            }
            None if super::world::is_built_in(name) => {
                self.report(
                    Diagnostic::new(
                        Code::E0601,
                        reference.span,
                        "a guard asks predicates by name",
                    )
                    .label(format!("`{name}` is built in"))
                    .help(named(reference)),
                );
                None
            }
            None => {
                let predicates = self.names.values(|decl| matches!(decl, Decl::Predicate(_)));
                let diagnostic = unknown(&reference.name, "predicate", predicates);
                self.report(diagnostic);
                None
            }
        }
    }
}

/// How a predicate gives what is asked a name.
fn named(reference: &Ref) -> String {
    let asked = Expr {
        kind: ExprKind::Ref(reference.clone()),
        span: reference.span,
    };
    format!("give it a name: `predicate NAME = {}`", print::expr(&asked))
}

/// A conjunction or a disjunction, kept flat.
fn joined(and: bool, left: Guard, right: Guard) -> Guard {
    let mut parts = Vec::new();
    for side in [left, right] {
        match side {
            Guard::And(inner) if and => parts.extend(inner),
            Guard::Or(inner) if !and => parts.extend(inner),
            other => parts.push(other),
        }
    }
    if and {
        Guard::And(parts)
    } else {
        Guard::Or(parts)
    }
}

/// Whether a control law commands the drive on some path.
fn commands(block: &Block) -> bool {
    let law::Block(stmts) = block;
    stmts.iter().any(|stmt| match stmt {
        Stmt::Drive { .. } => true,
        Stmt::If(_, then, otherwise) => commands(then) || commands(otherwise),
        _ => false,
    })
}

fn strip(expr: &Expr) -> &ExprKind {
    match &expr.kind {
        ExprKind::Paren(inner) => strip(inner),
        other => other,
    }
}

/// A word as it is written.
fn word_name(word: Word) -> &'static str {
    match word {
        Word::Selector => "selector",
        Word::Sequence => "sequence",
        Word::Parallel => "parallel",
        Word::Invert => "invert",
        Word::Succeed => "succeed",
        Word::Fail => "fail",
        Word::Retry => "retry",
        Word::Repeat => "repeat",
        Word::Timeout => "timeout",
    }
}
