//! Names, and calls with their arguments.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Expr, ExprKind, Ident, Ref};
use crate::syntax::diagnose::no_such_unit;
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::tokens::{Kind, is_blank};
use crate::syntax::words::{RANGING, RATE, TIMES, UNITS};

/// What comes next of a range whose `..` is another word.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Range {
    Word,
    End,
}

impl<'i> Builder<'i> {
    pub(super) fn name_or_call(&mut self, node: Node<'i>) -> ExprKind {
        let call = self.reference(node);
        if std::mem::take(&mut self.unbound) {
            return ExprKind::Error;
        }
        let right = match call.name.name.as_str() {
            "True" | "TRUE" => "true",
            "False" | "FALSE" => "false",
            _ => return ExprKind::Ref(call),
        };
        if call.args.is_some()
            || self.glance().declares(&call.name.name)
            || self.slice(call.span).starts_with('`')
        {
            return ExprKind::Ref(call);
        }
        let message = format!("`{}` is written `{right}`", call.name.name);
        self.respell(Code::E0119, call.span, message, right);
        ExprKind::Bool(right == "true")
    }

    pub(super) fn reference(&mut self, node: Node<'i>) -> Ref {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let written = parts.maybe(Rule::name);
        let name = written.as_ref().map_or(
            Ident {
                name: String::new(),
                span,
            },
            |node| self.name(node),
        );
        let args = parts.maybe(Rule::args).map(|args| {
            if let Some(written) = written.as_ref() {
                self.touching(written, &args);
            }
            let ranges = RANGING.contains(&name.name.as_str());
            let outer = std::mem::replace(&mut self.ranging, ranges);
            let args = self.args(args, &name.name);
            self.ranging = outer;
            args
        });
        Ref { name, args, span }
    }

    /// Reports blanks between a name and its parenthesis.
    pub(super) fn touching(&mut self, name: &Node<'i>, args: &Node<'i>) {
        let (end, start) = (self.ends(name), self.starts(args));
        if end == start {
            return;
        }
        let open = Span::new(self.file, start, start + 1);
        let diagnostic = Diagnostic::new(Code::E0113, open, "the `(` of a call touches its name")
            .label("a blank stands before this")
            .fix(
                "drop the blank",
                Span::new(self.file, end, start),
                "",
                Applicability::Safe,
            );
        self.report(diagnostic);
    }

    /// The arguments of what is called `owner`.
    pub(super) fn args(&mut self, node: Node<'i>, owner: &str) -> Vec<Arg> {
        let mut args: Vec<Arg> = Vec::new();
        let mut is_rest = false;
        let mut range = None;
        for part in Parts::of(node) {
            if part.as_rule() == Rule::missing_arg_comma && self.binder_is_meant(&part) {
                return args;
            }
            match (part.as_rule(), range) {
                // The word that was to be `..`, then the end of the range.
                (Rule::arg, Some(Range::Word)) => range = Some(Range::End),
                (Rule::arg, Some(Range::End)) => {
                    range = None;
                    let end = self.arg(part);
                    if let (Some(Arg { kind, .. }), ArgKind::Positional(high)) =
                        (args.last_mut(), end.kind)
                        && let ArgKind::Positional(low) = kind
                    {
                        *kind = ArgKind::Range(low.clone(), high);
                    }
                    continue;
                }
                (Rule::missing_arg_comma, Some(_)) => continue,
                (Rule::missing_arg_comma, None) if self.range_is_meant(&part, owner) => {
                    range = Some(Range::Word);
                    continue;
                }
                _ => {}
            }
            if range == Some(Range::End) {
                continue;
            }
            match part.as_rule() {
                // What was to be a unit or a condition is no argument.
                Rule::arg if std::mem::take(&mut is_rest) => {
                    if let Some(Arg { kind, .. }) = args.last_mut()
                        && let ArgKind::Positional(value) | ArgKind::Named(_, value) = kind
                    {
                        value.kind = ExprKind::Error;
                    }
                }
                Rule::arg if self.decimal_comma(args.last_mut(), &part) => {}
                Rule::arg => args.push(self.arg(part)),
                Rule::missing_arg_comma if self.no_argument(&part, args.last()) => is_rest = true,
                Rule::missing_arg_comma => {
                    let before = args.last().map(|arg| arg.span);
                    self.missing_comma(&part, before, "arguments");
                }
                _ => {}
            }
        }
        args
    }

    /// Reports `speed = 0,2 m/s`: a number without a unit, and one with a unit that touches it.
    fn decimal_comma(&mut self, before: Option<&mut Arg>, node: &Node<'i>) -> bool {
        // By position it may be an argument of its own: `uniform(0,5%)`.
        let Some(ArgKind::Named(_, value)) = before.map(|arg| &mut arg.kind) else {
            return false;
        };
        let ExprKind::Number(literal) = &value.kind else {
            return false;
        };
        let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        let (start, end) = (value.span.range().end, self.starts(node));
        let (number, unit) = match node.as_str().find([' ', '%']) {
            Some(at) => node.as_str().split_at(at),
            None => return false,
        };
        let unit = unit.trim();
        let torn = literal.unit.is_none()
            && is_digits(&literal.digits)
            && is_digits(number)
            && self.text.get(start..end) == Some(",")
            && UNITS.contains(&unit.split('/').next().unwrap_or_default());
        if !torn {
            return false;
        }
        let right = format!("{}.{number}", literal.digits);
        let span = Span::new(self.file, value.span.range().start, end + number.len());
        value.kind = ExprKind::Error;
        let diagnostic = Diagnostic::new(Code::E0101, span, "a decimal fraction has a point")
            .write(span, right, Applicability::Unsafe);
        self.report(diagnostic);
        true
    }

    /// Reports `of` and its like in `any(g of gem: …)`, where they should be `in`.
    fn binder_is_meant(&mut self, node: &Node<'i>) -> bool {
        let Some(word) = self.token_at(self.starts(node)) else {
            return false;
        };
        let is_binder =
            self.ranging && matches!(word.of(self.text), "of" | "from" | "over" | "among");
        if is_binder {
            let span = Span::new(self.file, word.start, word.end);
            let message = "what ranges over a kind binds a name: `x in KIND: …`".to_owned();
            self.respell(Code::E0127, span, message, "in");
            self.unbound = true;
        }
        is_binder
    }

    /// Reports `to` between the ends of a range.
    fn range_is_meant(&mut self, node: &Node<'i>, owner: &str) -> bool {
        let Some(word) = self.token_at(self.starts(node)) else {
            return false;
        };
        let rest = self.text.get(word.end..).unwrap_or_default();
        let rest = rest.trim_start_matches(is_blank);
        let is_named = rest.starts_with('=') && !rest.starts_with("==");
        let is_to = word.of(self.text) == "to" && !is_named;
        let span = Span::new(self.file, word.start, word.end);
        if is_to && owner == "uniform" {
            let gap = self.text.get(..word.start).unwrap_or_default();
            let blanks = gap.len() - gap.trim_end_matches(is_blank).len();
            let place = Span::new(self.file, word.start - blanks, word.end);
            let message = "the ends of `uniform` are parted by a comma";
            let diagnostic = Diagnostic::new(Code::E0127, span, message)
                .label("write `,`")
                .fix("write `,`", place, ",", Applicability::Safe);
            self.report(diagnostic);
        } else if is_to {
            let message = "a range is written with `..`, not with `to`".to_owned();
            self.respell(Code::E0127, span, message, "..");
        }
        is_to
    }

    /// Reports a word that follows a number as no unit, rather than as an argument of its own.
    fn unit_is_meant(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        let value = before.map(|arg| &arg.kind);
        let (Some(ArgKind::Positional(value) | ArgKind::Named(_, value)), Some(word)) =
            (value, self.token_at(self.starts(node)))
        else {
            return false;
        };
        let bare = matches!(&value.kind, ExprKind::Number(literal) if literal.unit.is_none());
        let gap = self
            .text
            .get(value.span.range().end..word.start)
            .unwrap_or_default();
        if !bare || gap.contains('\n') || word.kind != Kind::Word {
            return false;
        }
        let span = Span::new(self.file, word.start, word.end);
        let diagnostic = no_such_unit(span, self.slice(span), &[]);
        self.report(diagnostic);
        true
    }

    /// Reports what follows an argument without a comma, and is none.
    fn no_argument(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        self.condition_follows(node, before)
            || self.kind_goes_first(node, before)
            || self.unit_is_meant(node, before)
            || self.rate_is_meant(node, before)
    }

    /// Reports `max(a - 2% per tick, 0%)`, where a value has a rate behind it.
    fn rate_is_meant(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        let (Some(before), Some(word)) = (before, self.token_at(self.starts(node))) else {
            return false;
        };
        let gap = self.text.get(before.span.range().end..word.start);
        match gap.unwrap_or_default().trim_matches(is_blank) {
            "" if word.of(self.text) == "per" && self.time_follows(word.end) => {
                let span = Span::new(self.file, word.start, word.end);
                let diagnostic = match self.quotient(before.span, word.end) {
                    Some((place, right)) => {
                        let message = "a unit is divided by `/`, not by `per`";
                        Diagnostic::new(Code::E0101, span, message)
                            .label("between two units")
                            .fix("write `/`", place, right, Applicability::Unsafe)
                    }
                    None => Diagnostic::new(Code::E0101, span, "`per` cannot stand here")
                        .label("a value ends before this")
                        .help(RATE),
                };
                self.report(diagnostic);
                true
            }
            // What it is by the time of was reported with `per`.
            "per" => true,
            _ => false,
        }
    }

    /// What to write for `m per s`, where the word `per` ends at byte `end` behind `before`, and the place of ` per s`.
    fn quotient(&self, before: Span, end: usize) -> Option<(Span, String)> {
        let below = self.token_at(end)?;
        let unit = self.slice(before).rsplit(' ').next()?;
        let both = UNITS.contains(&unit) && UNITS.contains(&below.of(self.text));
        let place = Span::new(self.file, before.range().end, below.end);
        both.then(|| (place, format!("/{}", below.of(self.text))))
    }

    /// Whether the next token is a unit of time, or a number.
    fn time_follows(&self, end: usize) -> bool {
        self.token_at(end).is_some_and(|next| {
            let word = next.of(self.text);
            let spelt = matches!(word, "second" | "minute" | "hour");
            next.kind == Kind::Number || spelt || TIMES.contains(&word)
        })
    }

    /// Reports `nearest(b in bush where …)`, whose condition follows a colon.
    fn condition_follows(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        let binds =
            before.is_some_and(|arg| matches!(arg.kind, ArgKind::Binder { body: None, .. }));
        let word = self.token_at(self.starts(node));
        let Some(word) = word.filter(|_| binds && self.ranging) else {
            return false;
        };
        if !matches!(
            word.of(self.text),
            "where" | "with" | "when" | "such" | "that"
        ) {
            return false;
        }
        let span = Span::new(self.file, word.start, word.end);
        let message = "what is asked of each member follows a `:`".to_owned();
        let gap = before.map_or(span, |before| before.span.after().to(span));
        let diagnostic =
            Diagnostic::new(Code::E0101, span, message).write(gap, ":", Applicability::Unsafe);
        self.report(diagnostic);
        self.unbound = true;
        self.failed_at = Some(word.end);
        true
    }

    /// Reports `nearest(bush b: …)` and `on picked(bush b)`, which bind a name behind its kind.
    fn kind_goes_first(&mut self, node: &Node<'i>, before: Option<&Arg>) -> bool {
        let (Some(before), Some(name)) = (before, self.token_at(self.starts(node))) else {
            return false;
        };
        let kind = self.slice(before.span);
        let after = self.token_at(name.end);
        let after = after.map_or("", |after| after.of(self.text));
        let binds = match self.ranging {
            true => after == ":",
            false => matches!(after, ")" | ",") && self.glance().is_kind(kind),
        };
        if !binds || name.kind != Kind::Word {
            return false;
        }
        let head = self.text.get(..before.span.range().start);
        let line = head.and_then(|head| head.rsplit('\n').next());
        let declares = !self.ranging && line.is_some_and(|line| line.starts_with("on "));
        let mark = if declares { ":" } else { " in" };
        let right = format!("{}{mark} {kind}", name.of(self.text));
        let span = before.span.to(Span::new(self.file, name.start, name.end));
        let message = "the name that ranges over a kind goes before it".to_owned();
        let diagnostic =
            Diagnostic::new(Code::E0101, span, message).write(span, right, Applicability::Unsafe);
        self.report(diagnostic);
        if declares {
            self.lost.names.push(name.of(self.text).to_owned());
        }
        self.unbound = true;
        true
    }

    fn arg(&mut self, node: Node<'i>) -> Arg {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        let kind = if let Some(node) = parts.maybe(Rule::binder) {
            self.binder(node)
        } else if let Some(node) = parts.maybe(Rule::named) {
            self.named(node)
        } else {
            let value = self.take_expr(&mut parts);
            if parts.has(Rule::range_to) {
                ArgKind::Range(value, self.take_expr(&mut parts))
            } else {
                ArgKind::Positional(value)
            }
        };
        Arg { kind, span }
    }

    fn binder(&mut self, node: Node<'i>) -> ArgKind {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        parts.has(Rule::kw_in);
        let domain = self.take_name(&mut parts);
        let body = parts.has(Rule::colon).then(|| self.take_expr(&mut parts));
        let span = name.span;
        let member = Box::new(Expr {
            kind: ExprKind::Ref(Ref {
                name: name.clone(),
                args: None,
                span,
            }),
            span,
        });
        ArgKind::Binder {
            name,
            domain,
            body,
            member,
        }
    }

    /// The name behind a colon, if places or walls are of a kind that is called so.
    fn kind_after(&self, colon: Option<&Node<'i>>) -> Option<String> {
        let kind = self.token_at(self.ends(colon?))?.of(self.text);
        let glance = self.glance();
        let is_kind = matches!(kind, "robot" | "place" | "wall")
            || glance.is_kind(kind)
            || glance.declares_by(&["enum"], kind);
        is_kind.then(|| kind.to_owned())
    }

    fn named(&mut self, node: Node<'i>) -> ArgKind {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        let sign = parts.maybe(Rule::named_is);
        let colon = sign.filter(|sign| sign.as_str() == ":");
        if let (Some(sign), true) = (&colon, self.ranging) {
            self.unbound = true;
            let mark = self.span(sign);
            let message = "what ranges over a kind binds a name: `x in KIND: …`";
            let diagnostic = Diagnostic::new(Code::E0127, name.span.to(mark), message);
            // `any(r: robot, …)`
            let kind = self.kind_after(colon.as_ref());
            let right = match &kind {
                Some(kind) => format!("{} in {kind}", name.name),
                None => format!("x in {}", name.name),
            };
            let diagnostic = diagnostic.label(format!("write `{right}:`"));
            self.report(match kind {
                Some(_) => diagnostic,
                None => diagnostic
                    .help(format!("each `{}` behind it is called `x` then", name.name))
                    .fix(
                        format!("write `{right}`"),
                        name.span,
                        right,
                        Applicability::Unsafe,
                    ),
            });
        } else if let (Some(sign), Some(kind)) = (&colon, self.kind_after(colon.as_ref())) {
            self.unbound = true;
            let span = self.span(sign);
            let message = format!("all of a kind are meant by `in`: `x in {kind}`");
            self.report(
                Diagnostic::new(Code::E0127, span, message)
                    .label("write `in`")
                    .fix("write `in`", span, " in", Applicability::Unsafe),
            );
        } else if let Some(sign) = colon {
            let span = self.span(&sign);
            let diagnostic = Diagnostic::new(
                Code::E0127,
                span,
                format!(
                    "the argument `{}` is given with `=`, not with `:`",
                    name.name
                ),
            )
            .label("write `=`")
            .fix(
                "write `=`",
                name.span.after().to(span),
                " =",
                Applicability::Safe,
            );
            self.report(diagnostic);
        }
        let value = self.take_expr(&mut parts);
        ArgKind::Named(name, value)
    }
}
