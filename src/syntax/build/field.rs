//! Fields, which nothing has but a point: what reads or calls them in other languages is written otherwise.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, UnaryOp};
use crate::syntax::grammar::{Node, Parts, Rule};
use crate::syntax::words::{FUNCTIONS, NODES};

/// What reads something of a target.
const READS: [&str; 6] = [
    "distance",
    "direction",
    "bearing",
    "visible",
    "inside",
    "facing",
];

/// What sensors and drives are set up by, which nothing reads.
const SETTINGS: [&str; 12] = [
    "range",
    "noise",
    "from",
    "to",
    "at",
    "sector",
    "target",
    "max_speed",
    "max_turn",
    "speed_noise",
    "turn_noise",
    "body",
];

/// What declares families.
const FAMILIES: [&str; 4] = ["state", "event", "predicate", "let"];

/// What asks how a behaviour ended.
const ENDS: [&str; 3] = ["success", "failure", "running"];

/// What other tools command a motion by.
const MOTIONS: [&str; 5] = ["cmd_vel", "twist", "velocity", "linear", "angular"];

/// How long a frame takes, elsewhere.
const FRAMES: [&str; 4] = ["deltaTime", "delta_time", "delta", "dt"];

impl<'i> Builder<'i> {
    /// `a.b`, which reads nothing but the coordinates of a point.
    pub(super) fn wrong_field(&mut self, of: Expr, node: Node<'i>) -> Expr {
        let place = self.span(&node);
        let span = of.span.to(place);
        if matches!(of.kind, ExprKind::Error) {
            return self.error_expr(span);
        }
        let mark = match node.as_str().starts_with("::") {
            true => "::",
            false => ".",
        };
        let mut parts = Parts::of(node);
        let name = parts
            .maybe(Rule::field_name)
            .map_or("", |node| node.as_str());
        let args = parts.maybe(Rule::args);
        let owner = self.slice(of.span);
        if matches!(name, "x" | "y") && args.is_none() {
            let diagnostic = Diagnostic::new(Code::E0310, place, "a coordinate is not set alone")
                .label("a point is set as a whole")
                .help(format!("write `{owner} = (…, …)`"));
            self.report(diagnostic);
            return self.error_expr(span);
        }
        let diagnostic =
            Diagnostic::new(Code::E0133, place, format!("nothing has a field `{name}`")).label(
                match mark {
                    "::" => "there are no paths: a name stands alone".to_owned(),
                    _ => format!("`{mark}` reads only `x` and `y` of a point"),
                },
            );
        let is_name = matches!(&of.kind, ExprKind::Ref(reference) if reference.args.is_none());
        let args = args.map(|args| self.slice(self.span(&args)));
        let rest = self.text.get(span.range().end..).unwrap_or_default();
        let rest = rest.trim_start_matches(' ');
        let is_set = rest.starts_with('=') && !rest.starts_with("==");
        let diagnostic = match self.without_field(owner, name, args, (is_name, is_set)) {
            Ok(right) => diagnostic.fix(
                format!("write `{right}`"),
                span,
                right,
                Applicability::Unsafe,
            ),
            Err(Some(help)) => diagnostic.help(help),
            Err(None) => diagnostic,
        };
        self.report(diagnostic);
        self.error_expr(span)
    }

    /// What stands for a field here, or else advice where there is any; whether its owner is a mere name, and whether it is
    /// set.
    fn without_field(
        &self,
        owner: &str,
        name: &str,
        args: Option<&str>,
        (is_name, is_set): (bool, bool),
    ) -> Result<String, Option<String>> {
        let one_of = |words: &[&str]| words.contains(&name);
        if MOTIONS.contains(&owner) || one_of(&["linear", "angular"]) {
            let help = "a motion is commanded by `drive(speed = …, turn = …)`";
            return Err(Some(help.to_owned()));
        }
        if one_of(&FRAMES) {
            return Ok("tick".to_owned());
        }
        if one_of(&["z"]) {
            return Err(Some(
                "the world is flat: a point has `x` and `y`".to_owned(),
            ));
        }
        if one_of(&["center", "centre"]) {
            return Err(Some(format!(
                "the middle of a place is meant by its name alone: `{owner}`"
            )));
        }
        if let Some(args) = args.filter(|_| NODES.iter().any(|(node, _)| *node == name)) {
            let args = if args == "()" { "" } else { args };
            return Ok(format!("{name}{args} {{ {owner} }}"));
        }
        // The robot that acts is meant without a name.
        if let (Some(args), "self" | "this") = (args, owner) {
            return Ok(format!("{name}{args}"));
        }
        let of_another_language = ["Math", "math", "np", "numpy", "std", "random"];
        if let Some(args) = args.filter(|_| owner == "std" && !FUNCTIONS.contains(&name)) {
            return Ok(format!("{name}{args}"));
        }
        if let Some(args) = args.filter(|_| of_another_language.contains(&owner)) {
            return match FUNCTIONS.contains(&name) {
                true => Ok(format!("{name}{args}")),
                false => Err(None),
            };
        }
        if let Some(args) = args.filter(|_| FUNCTIONS.contains(&name)) {
            let rest = args.trim_start_matches('(');
            let comma = if rest.trim() == ")" { "" } else { ", " };
            return Ok(format!("{name}({owner}{comma}{rest}"));
        }
        if args == Some("()") && one_of(&READS) {
            return Ok(format!("{name}({owner})"));
        }
        if let Some(args) = args.filter(|_| self.glance().declares_by(&["robot"], owner)) {
            let inner = args
                .strip_prefix('(')
                .and_then(|args| args.strip_suffix(')'));
            if let Some(inner) = inner.filter(|_| one_of(&ENDS) || name == "inside") {
                return Ok(format!("{name}({inner}, by = {owner})"));
            }
            if let Some(inner) = inner.filter(|inner| name == "distance" && !inner.is_empty()) {
                return Ok(format!("{name}({owner}, {inner})"));
            }
            return Err(Some(format!(
                "what another robot does is asked so: `success({name}{args}, by = {owner})`"
            )));
        }
        if one_of(&READS) || one_of(&ENDS) || self.glance().declares_called(&FAMILIES, name) {
            return Ok(format!("{name}({owner})"));
        }
        let oneself = ["robot", "self", "this", "pose"];
        if one_of(&["position", "heading", "pose"]) && !oneself.contains(&owner) {
            if is_set {
                return Ok(format!("{name}({owner})"));
            }
            if one_of(&["heading"]) {
                return Err(None);
            }
            // `pose(b).position`: that is a point already.
            let is_point = owner.starts_with("pose(");
            if is_point || self.glance().declares_by(&["state", "let"], owner) {
                return Ok(owner.to_owned());
            }
            return Ok(format!("pose({owner})"));
        }
        if READS.contains(&owner) && self.glance().declares(name) {
            return Ok(format!("{owner}({name}{})", args.unwrap_or_default()));
        }
        let own = matches!(owner, "self" | "this" | "robot" | "me");
        if own && args.is_none() && one_of(&["max_speed", "max_turn"]) {
            return Ok(name.to_owned());
        }
        if args.is_none()
            && self.glance().declares_called(&FAMILIES, owner)
            && self.glance().declares(name)
        {
            return Ok(format!("{owner}({name})"));
        }
        if args.is_none() && self.glance().declares_by(&["input"], owner) {
            return Ok(match self.glance().lists(name) {
                true => format!("{owner} == {name}"),
                false => owner.to_owned(),
            });
        }
        if args.is_none() && one_of(&["X", "Y"]) {
            return Ok(format!("{owner}.{}", name.to_ascii_lowercase()));
        }
        let known = self.glance().declares(name) && !SETTINGS.contains(&name)
            || one_of(&["position", "heading", "touching"]);
        match is_name && args.is_none() && (known || self.glance().lists(name)) {
            true => Ok(name.to_owned()),
            false if args.is_some() => Err(None),
            false if self.glance().declares_by(&["state"], owner) => {
                Err(Some(format!("a value is compared: `{owner} == …`")))
            }
            false => Err(None),
        }
    }

    /// Warns of a sign that is taken for another one than it looks like: `-0.5` on a line of its own goes on with the line
    /// above.
    pub(super) fn odd_sign(&mut self, left: Span, sign: Span, right: Span) {
        let gap = self.text.get(left.range().end..sign.range().start);
        let on_new_line = gap.is_some_and(|gap| gap.contains('\n'));
        if !on_new_line || sign.end != right.start {
            return;
        }
        let mark = self.slice(sign);
        let diagnostic = Diagnostic::new(
            Code::W0102,
            sign.to(right),
            "this goes on with the line above",
        )
        .label(format!("taken as `… {mark} {}`", self.slice(right)))
        .help(
            "if it is to be so, put a blank after the sign; a line of its own begins with a word",
        );
        self.report(diagnostic);
    }

    /// Reports `++n` on a line of its own, which would go on with the line above.
    pub(super) fn by_one(&mut self, left: Span, sign: Span, right: &Expr) -> bool {
        let (end, start) = (left.range().end, sign.range().start);
        let on_new_line = (self.text.get(end..start)).is_some_and(|gap| gap.contains('\n'));
        let ExprKind::Unary { operand, .. } = &right.kind else {
            return false;
        };
        // Both signs are one token.
        let place = Span::new(self.file, start, start + 2);
        let mark = match self.slice(place) {
            "++" => '+',
            "--" => '-',
            _ => return false,
        };
        if !on_new_line || operand.span.start != place.end {
            return false;
        }
        let right = format!("{} {mark}= 1", self.slice(operand.span));
        let message = format!("`{mark}{mark}` is no operator here");
        let diagnostic = Diagnostic::new(Code::E0110, place, message).write(
            place.to(operand.span),
            right,
            Applicability::Unsafe,
        );
        self.report(diagnostic);
        true
    }

    /// Warns of `--5`, which is 5 and looks like something else.
    pub(super) fn doubled_sign(&mut self, sign: &Node<'i>, operand: &Expr) {
        let ExprKind::Unary { op, operand: inner } = &operand.kind else {
            return;
        };
        let span = self.span(sign);
        let signs = span.to(op.span);
        let is_sign = |op: UnaryOp| matches!(op, UnaryOp::Neg | UnaryOp::Pos);
        if !is_sign(op.node) || sign.as_rule() != Rule::sign {
            return;
        }
        let right = match (sign.as_str(), op.node) {
            ("+", UnaryOp::Neg) | ("-", UnaryOp::Pos) => "-",
            _ => "",
        };
        let value = format!("{right}{}", self.slice(inner.span));
        let diagnostic = Diagnostic::new(
            Code::W0102,
            signs,
            format!("`{}` is two signs", self.slice(signs)),
        )
        .label(format!("taken as `{value}`"))
        .fix("keep one", signs, "-", Applicability::Unsafe);
        self.report(diagnostic);
    }

    /// Warns of `=-` and `=+`, which set a value and do not change it.
    pub(super) fn odd_assignment(&mut self, sign: Span, value: Span) {
        let after = self.text.get(sign.range().end..).unwrap_or_default();
        let mut letters = after.chars();
        let (mark, blank) = (letters.next(), letters.next());
        let (Some(mark @ ('-' | '+')), Some(' ')) = (mark, blank) else {
            return;
        };
        if self.slice(sign) != "=" || value.start != sign.end {
            return;
        }
        let span = Span {
            end: sign.end + 1,
            ..sign
        };
        let right = format!("{mark}=");
        let diagnostic = Diagnostic::new(Code::W0102, span, format!("`={mark}` is `= {mark}`"))
            .label("this sets the value and does not change it")
            .fix(
                format!("if it is to change, write `{right}`"),
                span,
                right,
                Applicability::Unsafe,
            );
        self.report(diagnostic);
    }
}
