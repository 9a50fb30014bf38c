//! Statements.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::{
    AssignOp, Binding, Block, Branch, Else, Expr, ExprKind, Ref, Stmt, StmtKind,
};
use crate::syntax::diagnose::{self, no_such_unit};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::tokens::Kind;
use crate::syntax::words::{CHOICE, RATE, SWITCHES, TYPES, name_of_words};

/// The words that declare what statements set.
const SET: [&str; 2] = ["state", "local"];

impl<'i> Builder<'i> {
    pub(super) fn take_block(&mut self, parts: &mut Parts<'i>) -> Block {
        match parts.maybe(Rule::block) {
            Some(node) => self.block(node),
            None => Block {
                stmts: Vec::new(),
                span: Span::new(self.file, 0, 0),
            },
        }
    }

    /// The block that a production ends with.
    pub(super) fn last_block(&mut self, node: Node<'i>) -> Block {
        let mut parts = Parts::of(node);
        while parts.ahead().is_some_and(|rule| rule != Rule::block) {
            parts.next();
        }
        self.take_block(&mut parts)
    }

    fn block(&mut self, node: Node<'i>) -> Block {
        let span = self.span(&node);
        let mut stmts: Vec<Stmt> = Vec::new();
        self.entries(Parts::of(node), Rule::strict_stmt, |builder, node, span| {
            if span.range().start < builder.lost_until {
                let kind = StmtKind::Error;
                stmts.push(Stmt { kind, span });
                return;
            }
            let known = builder.units_missed;
            let gives = stmts
                .last_mut()
                .is_some_and(|last| builder.lacks_its_equals(last, node.as_ref(), span));
            let node = node.filter(|_| !gives);
            let kind = node.map_or(StmtKind::Error, |node| builder.stmt(node));
            // What was to be a unit, or the rest of a value, makes what stands before it one without meaning.
            let is_rest = matches!(kind, StmtKind::Error)
                && stmts
                    .last()
                    .is_some_and(|last| builder.on_one_line(last.span, span));
            if (is_rest || builder.units_missed > known)
                && let Some(Stmt { kind, .. }) = stmts.last_mut()
                && let StmtKind::Let(Binding { value, .. }) | StmtKind::Assign { value, .. } = kind
            {
                value.kind = ExprKind::Error;
            }
            stmts.push(Stmt { kind, span });
        });
        Block { stmts, span }
    }

    /// Reports a state whose value follows without `=`, and says whether what stands at `span` is that value, which
    /// reads as a statement of its own.
    fn lacks_its_equals(&mut self, last: &mut Stmt, next: Option<&Node<'i>>, span: Span) -> bool {
        let Some(next) = next.filter(|_| self.on_one_line(last.span, span)) else {
            return false;
        };
        let name = match &last.kind {
            StmtKind::Call(target) => target.name.name.as_str(),
            // The name alone has been reported.
            StmtKind::Error if next.as_rule() == Rule::branch => {
                let written = self.slice(last.span);
                return self.glance().declares_by(&SET, written);
            }
            _ => return false,
        };
        if !self.glance().declares_by(&SET, name) {
            return false;
        }
        let Some(first) = self.token_at(span.range().start) else {
            return false;
        };
        let at = Span::new(self.file, first.start, first.end);
        let diagnostic = self.expected_equals(last.span, at);
        self.report(diagnostic);
        last.kind = StmtKind::Error;
        true
    }

    /// The message for what is set at `target` to what begins at `value`, without `=`.
    fn expected_equals(&mut self, target: Span, value: Span) -> Diagnostic {
        let (name, found) = (self.slice(target), self.slice(value));
        let rest = self.text.get(value.range().start..).unwrap_or_default();
        let look_alike = LOOK_ALIKES.iter().find(|(look, _)| rest.starts_with(look));
        if let Some((look, right)) = look_alike {
            let message = format!("`{look}` stands where `{right}` should");
            let end = value.range().start + look.len();
            return Diagnostic::new(Code::E0121, value, message).write(
                Span::new(self.file, value.range().start, end),
                *right,
                Applicability::Safe,
            );
        }
        let expected = |found: &str| format!("expected `=` after `{name}`, found `{found}`");
        if let Some(arrow) = ARROWS.into_iter().find(|arrow| rest.starts_with(arrow)) {
            let end = value.range().start + arrow.len();
            let span = Span::new(self.file, value.range().start, end);
            return Diagnostic::new(Code::E0101, span, expected(arrow)).write(
                span,
                "=",
                Applicability::Unsafe,
            );
        }
        let message = expected(found);
        let diagnostic = Diagnostic::new(Code::E0101, value, message).label("expected `=`");
        if let Some(joined) = marked(name, rest).filter(|_| target.end == value.start) {
            return diagnostic.help(name_of_words(&joined));
        }
        let before = self.text.get(..target.range().start).unwrap_or_default();
        let mut words = before.trim_end().rsplit(|c: char| !c.is_alphanumeric());
        if words.next().is_some_and(|word| SWITCHES.contains(&word)) {
            return diagnostic.help(CHOICE);
        }
        let plain = name.split('(').next().unwrap_or(name);
        let begins =
            found.starts_with(|c: char| c.is_alphanumeric() || matches!(c, '_' | '`' | '-'));
        match begins && self.glance().declares_by(&SET, plain) {
            true => diagnostic.fix("put a `=`", target.after(), " =", Applicability::Unsafe),
            false => diagnostic.help(format!(
                "a call is written `{name}(…)`, an assignment `{name} = …`"
            )),
        }
    }

    /// Whether two places stand on one line.
    pub(super) fn on_one_line(&self, before: Span, after: Span) -> bool {
        let gap = self.text.get(before.range().end..after.range().start);
        gap.is_some_and(|gap| !gap.contains('\n'))
    }

    fn stmt(&mut self, node: Node<'i>) -> StmtKind {
        match node.as_rule() {
            Rule::binding => StmtKind::Let(self.binding(node)),
            Rule::for_stmt => {
                let mut parts = Parts::of(node);
                parts.has(Rule::kw_for);
                let name = self.take_name(&mut parts);
                parts.has(Rule::kw_in);
                let domain = self.take_name(&mut parts);
                let block = self.take_block(&mut parts);
                StmtKind::For {
                    name,
                    domain,
                    block,
                }
            }
            Rule::branch => StmtKind::Branch(self.branch(node)),
            Rule::simple_stmt => self.simple_stmt(node),
            _ => StmtKind::Error,
        }
    }

    pub(super) fn binding(&mut self, node: Node<'i>) -> Binding {
        let span = self.span(&node);
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_let);
        let name = self.take_name(&mut parts);
        let ty = self.maybe_type(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        Binding {
            name,
            ty,
            value,
            span,
        }
    }

    fn branch(&mut self, node: Node<'i>) -> Branch {
        self.branch_parts(Parts::of(node))
    }

    fn branch_parts(&mut self, mut parts: Parts<'i>) -> Branch {
        parts.has(Rule::kw_if);
        let cond = self.take_expr(&mut parts);
        let then = self.take_block(&mut parts);
        let otherwise = parts
            .maybe(Rule::branch_else)
            .map(|node| Box::new(self.branch_else(node)));
        Branch {
            cond,
            then,
            otherwise,
        }
    }

    fn branch_else(&mut self, node: Node<'i>) -> Else {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_else);
        if let Some(word) = parts.maybe(Rule::wrong_else_if) {
            self.else_if(&word);
            return Else::If(self.branch_parts(parts));
        }
        match parts.maybe(Rule::branch) {
            Some(branch) => Else::If(self.branch(branch)),
            None => Else::Block(self.take_block(&mut parts)),
        }
    }

    pub(super) fn else_if(&mut self, word: &Node<'i>) {
        let span = self.span(word);
        let written = word.as_str();
        self.respell(
            Code::E0117,
            span,
            format!("`{written}` is written `else if`"),
            "else if",
        );
    }

    fn simple_stmt(&mut self, node: Node<'i>) -> StmtKind {
        let mut parts = Parts::of(node);
        let Some(target) = parts.maybe(Rule::r#ref) else {
            return StmtKind::Error;
        };
        let target = self.reference(target);
        if self.fields_of_target(&mut parts, &target) {
            return StmtKind::Error;
        }
        let Some(sign) = parts.maybe(Rule::assign) else {
            if target.args.is_some() {
                return StmtKind::Call(target);
            }
            self.lone_name(target.span);
            return StmtKind::Error;
        };
        self.single_equals(&sign);
        let op = match sign.as_str() {
            "+=" => AssignOp::Add,
            "-=" => AssignOp::Sub,
            "*=" => AssignOp::Mul,
            "/=" => AssignOp::Div,
            _ => AssignOp::Set,
        };
        let op = self.spanned(&sign, op);
        let value = self.take_expr(&mut parts);
        self.odd_assignment(op.span, value.span);
        StmtKind::Assign { target, op, value }
    }

    /// Reports the word at `span` as no unit, where it follows a number on its line.
    fn unit_of_statement(&mut self, span: Span) -> bool {
        let start = span.range().start;
        let index = self.tokens.partition_point(|token| token.end <= start);
        let before = index.checked_sub(1).and_then(|at| self.tokens.get(at));
        let Some(number) = before.filter(|token| token.kind == Kind::Number) else {
            return false;
        };
        let gap = self.text.get(number.end..start).unwrap_or_default();
        if gap.contains('\n') {
            return false;
        }
        self.failed_at = Some(span.range().end);
        let diagnostic = no_such_unit(span, self.slice(span), &[]);
        self.report(diagnostic);
        self.units_missed += 1;
        true
    }

    /// Reports `a.b` where something is set, and says whether it was there.
    pub(super) fn fields_of_target(&mut self, parts: &mut Parts<'i>, target: &Ref) -> bool {
        let mut found = false;
        let mut owner = Expr {
            kind: ExprKind::Ref(target.clone()),
            span: target.span,
        };
        while let Some(node) = parts.maybe(Rule::wrong_field) {
            owner = self.wrong_field(owner, node);
            found = true;
        }
        found
    }

    /// Reports a name that stands where a statement should.
    fn lone_name(&mut self, span: Span) {
        if self.is_reported(span.range().start) {
            return;
        }
        let name = self.slice(span);
        if self.unit_of_statement(span) {
            return;
        }
        let next = self.token_at(span.range().end);
        let (at, found) = next.map_or((span, ""), |token| {
            (
                Span::new(self.file, token.start, token.end),
                token.of(self.text),
            )
        });
        let same_line = self
            .text
            .get(span.range().end..at.range().start)
            .is_some_and(|gap| !gap.contains('\n'));
        self.failed_at = Some(if same_line {
            at.range().start
        } else {
            span.range().end
        });
        let meant = match name {
            "int" | "float" | "double" | "var" | "const" | "auto" | "bool" | "number" | "local"
            | "mut" | "val" | "def" | "real" | "string" => Some("let"),
            "when" | "while" | "switch" | "match" | "unless" => Some("if"),
            "foreach" | "loop" => Some("for"),
            _ => misspelt(name, self.text.get(span.range().end..).unwrap_or_default()),
        };
        if let Some(meant) = meant.filter(|_| same_line && found != "}") {
            let diagnostic = Diagnostic::new(
                Code::E0123,
                span,
                format!("`{name}` does not begin a statement"),
            )
            .label(format!("did you mean `{meant}`?"))
            .note("a statement begins with `let`, `if`, `for` or the name of what it sets")
            .fix(
                format!("write `{meant}`"),
                span,
                meant,
                Applicability::Unsafe,
            );
            self.report(diagnostic);
            return;
        }
        // A value that does not parse leaves the name before it alone.
        if same_line && matches!(found, "=" | "+=" | "-=" | "*=" | "/=") {
            let start = span.range().start;
            let failure = self.failure(Rule::strict_stmt, start, start);
            if failure.at > at.range().start {
                let (until, diagnostic) =
                    diagnose::failure(self.file, self.text, (self.tokens, self.glance()), &failure);
                self.failed_at = Some(until);
                self.report(diagnostic);
                if self
                    .token_at(at.range().end)
                    .is_some_and(|value| value.of(self.text) == "if")
                {
                    self.lose_layout(start);
                }
                return;
            }
        }
        if name == "per" && self.goes_on(span.range().start) {
            let diagnostic = Diagnostic::new(Code::E0101, span, "`per` cannot stand here")
                .label("a statement ends before this")
                .help(RATE);
            self.report(diagnostic);
            return;
        }
        let mark = Span::new(self.file, at.range().start, at.range().start + 2);
        let written = self.slice(mark);
        if let Some(right) = step_by_one(name, written).filter(|_| same_line) {
            let message = format!("`{written}` is no operator here");
            let whole = span.to(mark);
            self.failed_at = Some(mark.range().end);
            self.report(Diagnostic::new(Code::E0110, mark, message).write(
                whole,
                right,
                Applicability::Unsafe,
            ));
            return;
        }
        if same_line && matches!(name, "mod" | "rem" | "modulo") {
            self.report(diagnose::no_remainder(span, name));
            return;
        }
        let after = self.text.get(at.range().end..).unwrap_or_default();
        let goes_on = after.starts_with([' ', '\t']) && !after.trim_start().starts_with('\n');
        if same_line && goes_on && matches!(found, "+" | "-" | "*" | "/") {
            let right = format!("{found}=");
            // `+ =`: one operator in two pieces.
            let second = after.trim_start().strip_prefix('=');
            let (message, length) = match second {
                Some(rest) => (
                    format!("`{right}` is written in one piece"),
                    after.len() - rest.len(),
                ),
                None => (format!("`{name} {found} …` changes nothing"), 0),
            };
            let whole = Span::new(self.file, at.range().start, at.range().end + length);
            self.report(Diagnostic::new(Code::E0101, whole, message).write(
                whole,
                right,
                Applicability::Unsafe,
            ));
            return;
        }
        if let Some(clause) = clause_in_control(name, if same_line { found } else { "" }) {
            let diagnostic = Diagnostic::new(
                Code::E0123,
                span,
                format!("`{name}` is no statement: how a behaviour ends stands beside `control`"),
            )
            .label("not in a block of statements")
            .help(format!("a clause of the behaviour: `{clause}`"));
            self.report(diagnostic);
            return;
        }
        let spare = [
            "set", "return", "then", "do", "call", "run", "assign", "begin",
        ];
        let word = found.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if same_line && spare.contains(&name) && word && !found.is_empty() {
            let diagnostic = Diagnostic::new(
                Code::E0123,
                span,
                format!("`{name}` does not begin a statement"),
            )
            .label("this is not said here")
            .fix(
                format!("drop `{name}`"),
                span.to(at.before()),
                "",
                Applicability::Unsafe,
            );
            self.report(diagnostic);
            return;
        }
        let rest = self.text.get(at.range().end..).unwrap_or_default();
        let inner = rest.split_once(']').map(|(inner, _)| inner);
        if let Some(inner) = inner.filter(|inner| found == "[" && !inner.contains('\n')) {
            let right = format!("({inner})");
            let place = Span::new(
                self.file,
                at.range().start,
                at.range().end + inner.len() + 1,
            );
            self.failed_at = Some(place.range().end);
            let diagnostic = Diagnostic::new(Code::E0101, place, "arguments stand in parentheses")
                .write(place, right, Applicability::Unsafe);
            self.report(diagnostic);
            return;
        }
        let typed = TYPES.contains(&name);
        let declares = same_line && word && !found.is_empty() && typed;
        if declares && self.slice(span) == name {
            let span = span.to(at);
            let right = format!("let {found}: {name}");
            let diagnostic = Diagnostic::new(
                Code::E0101,
                span,
                "the name of a value goes before its type",
            )
            .write(span, right, Applicability::Unsafe);
            self.report(diagnostic);
            return;
        }
        if name == "return" && !same_line {
            let diagnostic = Diagnostic::new(Code::E0101, span, "nothing is returned")
                .label("a block is done as a whole")
                .fix("drop it", span, "", Applicability::Unsafe);
            self.report(diagnostic);
            return;
        }
        let diagnostic = if same_line && !matches!(found, "}" | "") {
            self.expected_equals(span, at)
        } else {
            Diagnostic::new(
                Code::E0101,
                span,
                format!("the name `{name}` alone is not a statement"),
            )
            .label("a statement sets something or calls something")
            .help(format!(
                "a call is written `{name}(…)`, an assignment `{name} = …`"
            ))
        };
        self.report(diagnostic);
    }
}

/// What may stand where a statement sets something, for `=`.
const ARROWS: [&str; 3] = ["->", "<-", "=>"];

/// What looks like a sign that changes a value.
const LOOK_ALIKES: [(&str, &str); 4] = [("−=", "-="), ("–=", "-="), ("×=", "*="), ("÷=", "/=")];

/// The word that begins a statement, where one is nearly written so, and what follows it has the form of that statement.
fn misspelt(name: &str, rest: &str) -> Option<&'static str> {
    let line = rest.lines().next().unwrap_or_default();
    let line = line.split("//").next().unwrap_or_default();
    let words = ["let", "if", "for", "else", "while", "unless"];
    let opens = line.contains('{');
    let second = line.split_whitespace().nth(1);
    let goes_on = |word: &str| match word {
        "else" => line.trim_start().starts_with(['{']) || line.trim_start().starts_with("if "),
        "let" => line.contains('=') && !opens,
        "for" => second == Some("in") && opens,
        _ => opens,
    };
    let word = (words.into_iter()).find(|word| suggest::is_near(name, word))?;
    goes_on(word).then_some(match word {
        // There is no loop, and no other branch.
        "while" | "unless" => "if",
        word => word,
    })
}

/// The clause of a behaviour that is meant by a word among the statements of its control law.
fn clause_in_control(name: &str, next: &str) -> Option<&'static str> {
    let ends = |word| matches!(word, "success" | "succeed" | "SUCCESS" | "true");
    let fails = |word| matches!(word, "failure" | "fail" | "FAILURE" | "false");
    match (name, next) {
        ("requires", _) => Some("requires CONDITION"),
        ("succeed" | "success", _) => Some("succeed when CONDITION"),
        ("fail" | "failure", _) => Some("fail when CONDITION"),
        ("return", next) if ends(next) => Some("succeed when CONDITION"),
        ("return", next) if fails(next) => Some("fail when CONDITION"),
        _ => None,
    }
}

/// The assignment for `x++`, `x--`.
fn step_by_one(name: &str, mark: &str) -> Option<String> {
    match mark {
        "++" => Some(format!("{name} += 1")),
        "--" => Some(format!("{name} -= 1")),
        _ => None,
    }
}

/// The name that `wet-ness += …` sets, of what stands before the `-` and what follows.
fn marked(name: &str, rest: &str) -> Option<String> {
    let in_name = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '-');
    let end = rest.find(|c: char| !in_name(c))?;
    let (words, value) = (rest.get(..end)?, rest.get(end..)?.trim_start());
    let sets = ["=", "+=", "-=", "*=", "/="];
    let is_set = sets.iter().any(|sign| value.starts_with(sign)) && !value.starts_with("==");
    let is_marked = words.starts_with('-') && words.len() > 1 && is_set;
    is_marked.then(|| format!("{name}{}", words.replace('-', "_")))
}
