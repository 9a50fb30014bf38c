//! Nodes: composites, decorators, behaviours, subtrees unrolled.

use super::uncounted::TIMEOUT;
use crate::check::Checker;
use crate::check::context::Region;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::types::{Type, Value};
use crate::diagnostic::{Applicability, Code};
use crate::ir::tree::{Composite, Decorator, Node};
use crate::source::Span;
use crate::syntax::ast::{self, Arg, ArgKind, Expr, NodeKind, Ref, Spanned, Word};

impl<'a> Checker<'a> {
    /// A node with what is under it; `None` if something in it is wrong or unknown.
    pub fn node(&mut self, node: &'a ast::Node) -> Option<Node> {
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
        let name = word.node.spelling();
        if let Some(span) = memory
            && !matches!(word.node, Word::Selector | Word::Sequence)
        {
            self.error(Code::E0604, span, format!("`{name}` has no memory"))
                .label("only a selector or a sequence resumes at its running child")
                .fix("take it away", span, "", Applicability::Unsafe);
        }
        let number = match args {
            Some([arg]) if word.node == Word::Parallel && self.counts_children(arg, children) => {
                None
            }
            args => self.node_argument(word, args),
        };
        let built: Vec<Option<Node>> = children.iter().map(|child| self.node(child)).collect();
        if children.is_empty() {
            return self
                .error(Code::E0602, word.span, format!("this `{name}` is empty"))
                .label("it has no child to tick")
                .none();
        }
        let decorator = !matches!(word.node, Word::Selector | Word::Sequence | Word::Parallel);
        if decorator && let Some(second) = children.get(1) {
            return self
                .error(
                    Code::E0603,
                    second.span,
                    format!("`{name}` decorates one node"),
                )
                .label("a second child")
                .help("put them under a `sequence { … }` or a `selector { … }`")
                .none();
        }
        if word.node == Word::Parallel {
            self.one_drives(children, &built);
            let at = args.and_then(<[Arg]>::first).map(|arg| arg.span);
            self.enough_children(number, children.len(), at.unwrap_or(word.span));
        }
        let mut children: Vec<Node> = built.into_iter().collect::<Option<_>>()?;
        let composite = |kind, children| Node::Composite {
            kind,
            memory: memory.is_some(),
            children,
        };
        let times = |number: Option<u64>| Some(u32::try_from(number?).unwrap_or(u32::MAX));
        let kind = match word.node {
            Word::Selector => return Some(composite(Composite::Selector, children)),
            Word::Sequence => return Some(composite(Composite::Sequence, children)),
            Word::Parallel => {
                return Some(Node::Parallel {
                    successes: times(number)?,
                    children,
                });
            }
            Word::Invert => Decorator::Invert,
            Word::Succeed => Decorator::Succeed,
            Word::Fail => Decorator::Fail,
            Word::Retry => Decorator::Retry(times(number)?),
            Word::Repeat => Decorator::Repeat(times(number)?),
            Word::Timeout => Decorator::Timeout(number?),
        };
        Some(Node::Decorator {
            kind,
            child: Box::new(children.pop()?),
        })
    }

    /// Reports `parallel(all)` and `parallel(any)`: so many successes are written as a number.
    fn counts_children(&mut self, arg: &Arg, children: &[ast::Node]) -> bool {
        let ArgKind::Positional(value) = &arg.kind else {
            return false;
        };
        let word = plain_ref(value).filter(|word| word.args.is_none());
        let number = match word.map(|word| word.name.name.as_str()) {
            Some("all" | "every") => children.len(),
            Some("any" | "one") => 1,
            _ => return false,
        };
        let right = number.to_string();
        self.error(Code::E0606, arg.span, "`parallel` takes a number")
            .label("so many of its children have to succeed")
            .fix(
                format!("write `{right}`"),
                arg.span,
                right,
                Applicability::Unsafe,
            );
        true
    }

    /// The number of `parallel(n)`, `retry(n)`, `repeat(n)`, the ticks of `timeout(t)`; the other words have none.
    fn node_argument(&mut self, word: Spanned<Word>, args: Option<&'a [Arg]>) -> Option<u64> {
        let name = word.node.spelling();
        let takes = matches!(
            word.node,
            Word::Parallel | Word::Retry | Word::Repeat | Word::Timeout
        );
        match (takes, args) {
            (false, None) => None,
            (false, Some(args)) => {
                let span = args.first().map_or(word.span, |arg| arg.span);
                self.error(Code::E0606, span, format!("`{name}` takes no argument"))
                    .label("this has no effect here")
                    .none()
            }
            (true, Some([arg])) => match &arg.kind {
                ArgKind::Positional(value) if word.node == Word::Timeout => match self.has_world {
                    true => self.ticks(value, TIMEOUT),
                    false => self.counted_ticks(value),
                },
                ArgKind::Positional(value) => self.times(name, value),
                ArgKind::Named(parameter, value) => {
                    let until_value = Span {
                        end: value.span.start,
                        ..parameter.span
                    };
                    self.error(Code::E0606, arg.span, format!("`{name}` takes a number"))
                        .label("it has no name here")
                        .fix("drop the name", until_value, "", Applicability::Unsafe)
                        .none()
                }
                _ => self
                    .error(Code::E0606, arg.span, format!("`{name}` takes a number"))
                    .label("not a number")
                    .none(),
            },
            (true, _) => {
                let example = match word.node {
                    Word::Timeout => "timeout(10 s) { … }".to_owned(),
                    _ => format!("{name}(2) {{ … }}"),
                };
                self.error(
                    Code::E0606,
                    word.span,
                    format!("`{name}` takes one argument"),
                )
                .label("how many?")
                .help(format!("for example: `{example}`"))
                .none()
            }
        }
    }

    fn times(&mut self, name: &str, value: &'a Expr) -> Option<u64> {
        let role = format!("the number of `{name}`");
        let number = self.constant(value, &Type::NUMBER, &role)?;
        if number.fract() == 0.0 && (1.0..=1e6).contains(&number) {
            return Some(number as u64);
        }
        self.out_of_range(
            value.span,
            format!("{role} is a whole number from 1 to a million"),
            "this is not",
        )
        .none()
    }

    /// A robot has one drive: of the children of a `parallel` one at most may use it.
    fn one_drives(&mut self, children: &'a [ast::Node], built: &[Option<Node>]) {
        let drives = |node: &Node| {
            let mut drives = false;
            node.visit_behaviors(&mut |id| {
                let law = self.program.behaviors[id].law.as_ref();
                drives |= law.is_none_or(|law| law.control.may_drive());
            });
            drives
        };
        let children = children.iter().zip(built);
        let mut driving = children
            .filter(|(_, node)| node.as_ref().is_some_and(drives))
            .map(|(child, _)| child.span);
        if let (Some(first), Some(second)) = (driving.next(), driving.next()) {
            self.error(Code::E0605, second, "two children of a `parallel` drive")
                .label("this one drives too")
                .also(first, "this one drives")
                .help("a robot has one drive: use one tree for each actuator");
        }
    }

    /// A `parallel` asks for as many successes as it has children, or fewer.
    fn enough_children(&mut self, successes: Option<u64>, children: usize, at: Span) {
        if let Some(n) = successes
            && n > children as u64
        {
            self.error(
                Code::E0606,
                at,
                format!("{n} children cannot succeed: there are {children}"),
            )
            .label("more than there are");
        }
    }

    /// A behaviour, a subtree, or a condition.
    pub fn leaf_node(&mut self, expr: &'a Expr) -> Option<Node> {
        let condition = |checker: &mut Self| checker.guard(expr).map(Node::Condition);
        let Some(reference) = plain_ref(expr) else {
            return condition(self);
        };
        let name = reference.name.name.as_str();
        let Some((decl, library)) = self.value_of(&reference.name) else {
            if matches!(name, "done" | "failed") {
                return condition(self);
            }
            let what = "behaviour, subtree or predicate";
            if self.names.tasks.contains_key(name) {
                let message = format!("`{name}` is not a node of a tree");
                return self
                    .error(Code::E0203, reference.span, message)
                    .label("this is a task")
                    .help("a node is a behaviour, a subtree, or a predicate")
                    .none();
            }
            return self
                .undeclared_value(&reference.name, what, |decl| {
                    matches!(decl, Decl::Behavior(_) | Decl::Tree(_) | Decl::Predicate(_))
                })
                .none();
        };
        if self.context.lookup(name).is_some() {
            return condition(self);
        }
        match decl {
            Decl::Behavior(behavior) => {
                match self.behavior_instance(behavior, library, reference)? {
                    Value::Behavior(id) => Some(Node::Behavior(id)),
                    _ => None,
                }
            }
            Decl::Tree(tree) => self.subtree(tree, library, reference),
            Decl::Predicate(_) => condition(self),
            decl => self
                .error(
                    Code::E0203,
                    reference.span,
                    format!("`{name}` is not a node of a tree"),
                )
                .this_is(decl.what())
                .help("a node is a behaviour, a subtree, or a predicate")
                .none(),
        }
    }

    /// A subtree under the arguments of a reference.
    pub(super) fn subtree(
        &mut self,
        tree: &'a ast::Tree,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Node> {
        let scope = self.bind_arguments(tree.params.as_ref(), library, reference)?;
        if scope.iter().any(|binding| binding.value == Value::Unknown) {
            return None;
        }
        let body = tree.name.span;
        self.unrolled(body, reference, library, Region::Tree, scope, |checker| {
            checker.node(&tree.root)
        })
        .flatten()
    }
}
