//! Trees and the claims about them.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::{
    self, Arg, ArgKind, Claim, ClaimWhat, Expr, ExprKind, Ident, NodeKind, Ref, Spanned, Tree, Word,
};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::words::{DRIVING, FOREIGN_NODES, NODES};

/// The composite with memory that a single word means elsewhere: `SequenceWithMemory`, `memory_selector`.
fn remembering(written: &str) -> Option<Word> {
    let plain = written.replace('_', "").to_ascii_lowercase();
    let ends = ["withmemory", "withmem", "memory", "mem", "star"];
    let rest = (ends.iter().find_map(|end| plain.strip_suffix(end)))
        .or_else(|| ends.iter().find_map(|start| plain.strip_prefix(start)))?;
    let mut words = NODES.iter().chain(&FOREIGN_NODES);
    let (_, word) = words.find(|(spelling, _)| *spelling == rest)?;
    matches!(word, Word::Selector | Word::Sequence).then_some(*word)
}

/// Whether an argument says `memory`, or `memory = true`.
fn is_memory(arg: &Arg) -> bool {
    match &arg.kind {
        ArgKind::Positional(Expr {
            kind: ExprKind::Ref(Ref { name, args, .. }),
            ..
        }) => name.name == "memory" && args.is_none(),
        ArgKind::Named(name, value) => name.name == "memory" && value.kind == ExprKind::Bool(true),
        _ => false,
    }
}

impl<'i> Builder<'i> {
    pub(super) fn tree(&mut self, node: Node<'i>) -> Tree {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_tree);
        let name = self.take_name(&mut parts);
        let params = self.maybe_params(&mut parts);
        let task = parts.has(Rule::kw_for).then(|| self.take_name(&mut parts));
        self.take_is(&mut parts);
        let root = self.take_node(&mut parts);
        Tree {
            name,
            params,
            task,
            root,
        }
    }

    fn take_node(&mut self, parts: &mut Parts<'i>) -> ast::Node {
        match parts.maybe(Rule::node) {
            Some(node) => {
                let span = self.span(&node);
                let kind = self.node(node);
                ast::Node { kind, span }
            }
            None => ast::Node {
                kind: NodeKind::Error,
                span: Span::new(self.file, 0, 0),
            },
        }
    }

    fn node(&mut self, node: Node<'i>) -> NodeKind {
        let mut parts = Parts::of(node);
        if let Some(composite) = parts.maybe(Rule::composite) {
            return self.composite(composite);
        }
        if let Some(branch) = parts.maybe(Rule::wrong_branch) {
            self.wrong_branch(branch);
            return NodeKind::Error;
        }
        let outer = std::mem::replace(&mut self.in_tree, true);
        let expr = self.take_expr(&mut parts);
        let expr = self.compared(expr, &mut parts, Rule::wrong_guard_equals);
        self.in_tree = outer;
        let Some(arrow) = parts.maybe(Rule::guards) else {
            return self.decorator_call(&expr).unwrap_or(NodeKind::Leaf(expr));
        };
        if arrow.as_str() != "=>" && self.is_behavior(&expr) {
            let span = self.span(&arrow);
            let written = arrow.as_str();
            let message =
                format!("the children of a node are parted by commas, not by `{written}`");
            let gap = expr.span.after().to(span);
            self.report(
                Diagnostic::new(Code::E0116, span, message)
                    .label("the next child follows")
                    .fix("put a comma", gap, ",", Applicability::Unsafe),
            );
            return NodeKind::Error;
        }
        self.guards(&arrow, "a guard is followed");
        let node = self.take_node(&mut parts);
        self.below_its_guard(&expr, self.span(&arrow), &node);
        NodeKind::Guarded {
            guard: expr,
            node: Box::new(node),
        }
    }

    /// Warns of a guard whose node begins the next line as a child of its own would.
    fn below_its_guard(&mut self, guard: &Expr, arrow: Span, node: &ast::Node) {
        let indent = |at: usize| {
            let line = self.text.get(..at)?.rsplit('\n').next()?;
            line.trim_start().is_empty().then_some(line)
        };
        let (first, below) = (guard.span.range().start, node.span.range().start);
        let aligned = indent(first).is_some() && indent(first) == indent(below);
        if aligned && !matches!(node.kind, NodeKind::Error) {
            let message = "this guard has nothing behind it on its line";
            let first_line = self.slice(node.span).lines().next().unwrap_or_default();
            let label = format!(
                "it guards `{}` below",
                first_line.trim_end_matches([' ', '{'])
            );
            self.report(
                Diagnostic::new(Code::W0103, arrow, message)
                    .label(label)
                    .help("write what it is to run, or what it guards on the same line"),
            );
        }
    }

    /// Whether an expression names what is run, as far as this file shows.
    pub(super) fn is_behavior(&self, expr: &Expr) -> bool {
        let ExprKind::Ref(reference) = &expr.kind else {
            return false;
        };
        let name = reference.name.name.as_str();
        DRIVING.contains(&name) || self.glance().declares_by(&["behavior", "tree"], name)
    }

    /// `if c { … }`, as other languages branch.
    fn wrong_branch(&mut self, node: Node<'i>) {
        let mut parts = Parts::of(node);
        let Some(word) = parts.maybe(Rule::kw_if) else {
            return;
        };
        let span = self.span(&word);
        let guard = self.take_expr(&mut parts);
        let children = parts.maybe(Rule::children);
        let body = children.as_ref().map(|children| self.span(children));
        let children = children.map(|children| self.children(children));
        let only = match children.as_deref() {
            Some([only]) => Some(only.span),
            _ => None,
        };
        let after = |body: Span| self.text.get(body.range().end..).unwrap_or_default();
        // What stands behind an `else` is the last child of a `selector`, which nobody can take over without the rest.
        let alone = |(body, _): &(Span, Span)| !after(*body).trim_start().starts_with("else");
        let chosen = body.zip(only).is_some_and(|both| !alone(&both));
        let guarded = body.zip(only).filter(alone).map(|(body, only)| {
            let rest = after(body);
            let comma = match rest.trim_start().starts_with([',', '}']) {
                true => "",
                false => ",",
            };
            let right = format!("{} => {}{comma}", self.slice(guard.span), self.slice(only));
            (span.to(body), right)
        });
        let guard = self.slice(guard.span);
        let diagnostic = Diagnostic::new(
            Code::E0116,
            span,
            "a tree has no `if`: what a condition guards follows `=>`",
        )
        .label("not a kind of node");
        let diagnostic = match guarded {
            Some((place, right)) => diagnostic.fix(
                format!("write `{right}`"),
                place,
                right,
                Applicability::Unsafe,
            ),
            None if chosen => diagnostic.help(format!("write `selector {{ {guard} => …, … }}`")),
            None => diagnostic.help(format!("write `{guard} => …`")),
        };
        self.report(diagnostic);
    }

    /// Reports an arrow other than `=>`; `before` says what stands before it.
    pub(super) fn guards(&mut self, arrow: &Node<'i>, before: &str) {
        let written = arrow.as_str();
        let span = self.span(arrow);
        match written {
            "=>" => {}
            "->" => self.respell(
                Code::E0116,
                span,
                format!("{before} by `=>`, not by `->`"),
                "=>",
            ),
            _ => self.respell(
                Code::E0121,
                span,
                format!("`{written}` is written `=>`"),
                "=>",
            ),
        }
    }

    fn composite(&mut self, node: Node<'i>) -> NodeKind {
        let mut parts = Parts::of(node);
        let memory = parts.maybe(Rule::kw_memory).map(|node| self.span(&node));
        let called = parts
            .maybe(Rule::wrong_node_call)
            .or_else(|| parts.maybe(Rule::wrong_spaced_call));
        if let Some(word) = called {
            return self.in_parentheses(memory, &word, parts);
        }
        let written = parts.maybe(Rule::node_word);
        let Some(written) = written.or_else(|| parts.maybe(Rule::known_word)) else {
            return NodeKind::Error;
        };
        let joined = remembering(written.as_str()).filter(|_| memory.is_none());
        let word = match joined {
            Some(_) => joined.map(|word| self.spanned(&written, word)),
            None => self.node_word(&written, memory.is_some()),
        };
        let list = parts.maybe(Rule::args);
        let mut wrong = joined.map(|_| self.span(&written));
        let args = list.as_ref().map(|args| self.span(args));
        let mut args = list.map(|list| {
            self.touching(&written, &list);
            (self.args(list, ""), args)
        });
        if let Some(late) = parts.maybe(Rule::wrong_memory) {
            wrong = Some(self.span(&late));
        } else if let Some((list, span)) = &args
            && list.as_slice().first().is_some_and(is_memory)
            && list.len() == 1
        {
            wrong = *span;
            args = None;
        }
        let args = args.map(|(args, _)| args);
        if let (Some(late), Some(word)) = (wrong, &word) {
            self.late_memory(late, *word, memory.is_some());
        }
        let memory = memory.or(wrong);
        if let Some(node) = parts.maybe(Rule::unopened) {
            // Where its children end nobody knows.
            self.children(node);
            return NodeKind::Error;
        }
        let children = parts
            .maybe(Rule::children)
            .map(|node| self.children(node))
            .unwrap_or_default();
        match word {
            Some(word) => NodeKind::Composite {
                memory,
                word,
                args,
                children,
            },
            None => NodeKind::Error,
        }
    }

    /// A composite whose children stand in parentheses, which is reported.
    fn in_parentheses(
        &mut self,
        memory: Option<Span>,
        written: &Node<'i>,
        mut parts: Parts<'i>,
    ) -> NodeKind {
        let (Some(word), Some(args)) = (
            self.node_word(written, memory.is_some()),
            parts.maybe(Rule::args),
        ) else {
            return NodeKind::Error;
        };
        let span = self.span(&args);
        let (open, close) = (span.range().start, span.range().end);
        let spelling = word.node.spelling();
        let place = Span::new(self.file, open, open + 1);
        let last = Span::new(self.file, close.saturating_sub(1), close);
        let mut diagnostic = Diagnostic::new(
            Code::E0101,
            place,
            format!("the children of a node stand in braces: `{spelling} {{ …, … }}`"),
        )
        .label("expected `{`")
        .fix("write braces", place, "{", Applicability::Safe);
        if let Some(fix) = diagnostic.fixes.first_mut() {
            fix.edits.push((last, "}".to_owned()));
        }
        self.report(diagnostic);
        let children = self.args(args, "").into_iter().map(|arg| ast::Node {
            span: arg.span,
            kind: match arg.kind {
                ArgKind::Positional(value) => NodeKind::Leaf(value),
                _ => NodeKind::Error,
            },
        });
        NodeKind::Composite {
            memory,
            word,
            args: None,
            children: children.collect(),
        }
    }

    /// `timeout(goto(B), 30 s)`: a decorator with its child among its arguments, which is reported.
    fn decorator_call(&mut self, expr: &Expr) -> Option<NodeKind> {
        let ExprKind::Ref(Ref { name, args, .. }) = &expr.kind else {
            return None;
        };
        let (_, word) = NODES.iter().find(|(spelling, _)| *spelling == name.name)?;
        if self.is_behavior(expr) || self.glance().declares_by(&["predicate"], &name.name) {
            return None;
        }
        let counted = matches!(word, Word::Timeout | Word::Retry | Word::Repeat);
        if !counted && *word != Word::Parallel {
            return self.children_of_call(name, args.as_deref()?, *word);
        }
        let value = |arg: &Arg| match &arg.kind {
            ArgKind::Positional(value) | ArgKind::Named(_, value) => Some(value.clone()),
            _ => None,
        };
        let is_child = |arg: &&Arg| value(arg).is_some_and(|value| self.is_behavior(&value));
        let (children, amounts): (Vec<&Arg>, Vec<&Arg>) = args.iter().flatten().partition(is_child);
        let [child] = children.as_slice() else {
            return None;
        };
        let child_value = value(child)?;
        let inner = self.slice(child_value.span).to_owned();
        let amount = match amounts.as_slice() {
            [] => None,
            [amount] => Some(value(amount)?),
            _ => return None,
        };
        let amount = amount.map_or("…", |amount| self.slice(amount.span));
        let spelling = word.spelling();
        let right = format!("{spelling}({amount}) {{ {inner} }}");
        let message = format!("the child of a `{spelling}` stands in braces");
        let diagnostic = Diagnostic::new(Code::E0101, child.span, message);
        let diagnostic = match amounts.is_empty() {
            true => diagnostic
                .label("not among the arguments")
                .help(format!("write `{right}`")),
            false => diagnostic.label("not among the arguments").fix(
                format!("write `{right}`"),
                expr.span,
                right,
                Applicability::Unsafe,
            ),
        };
        self.report(diagnostic);
        Some(NodeKind::Error)
    }

    /// `selector(a, b)`: a node with its children in parentheses, which is reported.
    fn children_of_call(&mut self, name: &Ident, args: &[Arg], word: Word) -> Option<NodeKind> {
        let (first, last) = (args.first()?, args.last()?);
        let whole = first.span.to(last.span);
        let is_value = |arg: &Arg| matches!(arg.kind, ArgKind::Positional(_));
        if !args.iter().all(is_value) {
            return None;
        }
        let spelling = word.spelling();
        let children = match word {
            Word::Selector | Word::Sequence => "…, …",
            _ => "…",
        };
        let message =
            format!("the children of a node stand in braces: `{spelling} {{ {children} }}`");
        let rest = self.text.get(whole.range().end..).unwrap_or_default();
        let gap = rest.len() - rest.trim_start_matches([' ', '\n', '\r', '\t']).len();
        let closes = rest.get(gap..).is_some_and(|rest| rest.starts_with(')'));
        let end = whole.range().end + gap + usize::from(closes);
        let diagnostic = Diagnostic::new(Code::E0101, name.span, message)
            .label("its children stand in parentheses")
            .fix(
                "write braces",
                Span::new(self.file, name.span.range().end, end),
                format!(" {{ {} }}", self.slice(whole)),
                Applicability::Unsafe,
            );
        self.report(diagnostic);
        Some(NodeKind::Error)
    }

    /// Reports `memory` where it does not stand before its node.
    fn late_memory(&mut self, late: Span, word: Spanned<Word>, twice: bool) {
        let right = match twice {
            true => word.node.spelling().to_owned(),
            false => format!("memory {}", word.node.spelling()),
        };
        let message = match twice {
            true => "`memory` is said twice".to_owned(),
            false => format!("`memory` goes before `{}`", word.node.spelling()),
        };
        let diagnostic = Diagnostic::new(Code::E0101, late, message).write(
            word.span.to(late),
            right,
            Applicability::Safe,
        );
        self.report(diagnostic);
    }

    /// The composite that `written` names; if none, what was likely meant.
    fn node_word(&mut self, written: &Node<'i>, memory: bool) -> Option<Spanned<Word>> {
        let name = written.as_str();
        let span = self.span(written);
        let find = |table: &[(&str, Word)], name: &str| {
            let entry = table.iter().find(|(spelling, _)| *spelling == name);
            entry.map(|&(_, word)| word)
        };
        if let Some(word) = find(&NODES, name) {
            return Some(Spanned { node: word, span });
        }
        let lower = name.to_ascii_lowercase();
        let meant = find(&NODES, &lower)
            .or_else(|| find(&FOREIGN_NODES, &lower))
            .or_else(|| {
                suggest::nearest(&lower, NODES.map(|(spelling, _)| spelling))
                    .and_then(|near| find(&NODES, near))
            });
        let mut diagnostic =
            Diagnostic::new(Code::E0120, span, format!("`{name}` is not a kind of node"));
        diagnostic = match meant {
            Some(word) => diagnostic
                .label(format!("did you mean `{}`?", word.spelling()))
                .fix(
                    format!("write `{}`", word.spelling()),
                    span,
                    word.spelling(),
                    Applicability::Unsafe,
                ),
            None => diagnostic.label("braces follow the words of composites and decorators only"),
        };
        let kinds = if memory {
            "`memory` goes before `selector` and `sequence`"
        } else {
            "the nodes with braces are `selector`, `sequence`, `parallel`, `invert`, `succeed`, `fail`, `retry`, \
             `repeat` and `timeout`"
        };
        self.report(diagnostic.note(kinds));
        meant.map(|word| Spanned { node: word, span })
    }

    fn children(&mut self, node: Node<'i>) -> Vec<ast::Node> {
        let mut children = Vec::new();
        self.entries(
            Parts::of(node),
            Rule::strict_child,
            |builder, node, span| {
                let kind = node.map_or(NodeKind::Error, |node| builder.node(node));
                children.push(ast::Node { kind, span });
            },
        );
        children
    }

    pub(super) fn claim(&mut self, node: Node<'i>) -> Claim {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_claim);
        let tree = self.take_name(&mut parts);
        let what = self.claimed(&mut parts, &tree);
        let likely = parts.maybe(Rule::probability);
        let within = parts.maybe(Rule::within).map(|node| {
            let mut parts = Parts::of(node);
            parts.has(Rule::kw_within);
            self.take_expr(&mut parts)
        });
        let probability = likely
            .or_else(|| parts.maybe(Rule::probability))
            .map(|node| self.probability(node));
        Claim {
            tree,
            what,
            within,
            probability,
        }
    }

    fn claimed(&mut self, parts: &mut Parts<'i>, tree: &ast::Ident) -> ClaimWhat {
        let Some(node) = parts.next() else {
            return ClaimWhat::Equals(tree.clone());
        };
        let rule = node.as_rule();
        let mut parts = Parts::of(node);
        parts.next();
        match rule {
            Rule::claim_never => ClaimWhat::Never(self.take_expr(&mut parts)),
            Rule::claim_reaches => ClaimWhat::Reaches(self.take_expr(&mut parts)),
            _ => ClaimWhat::Equals(self.take_name(&mut parts)),
        }
    }

    fn probability(&mut self, node: Node<'i>) -> (bool, ast::Expr) {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_with);
        parts.has(Rule::kw_probability);
        let strict = match parts.maybe(Rule::at_least) {
            Some(sign) if sign.as_str() == "≥" => {
                let span = self.span(&sign);
                self.respell(Code::E0121, span, "`≥` is written `>=`".into(), ">=");
                false
            }
            Some(sign) => sign.as_str() == ">",
            None => false,
        };
        (strict, self.take_expr(&mut parts))
    }
}
