//! Matching arguments to parameters.

use super::Checker;
use super::context::Region;
use super::expr::plain_ref;
use super::names::is_built_in;
use super::report::listed;
use crate::diagnostic::{Applicability, Code};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Expr, ExprKind, Ident, Literal, Ref};
use crate::syntax::print;
use crate::syntax::words::SHAPES;

/// The arguments that something takes.
pub struct Signature<'s> {
    /// The callee as a message names it: `` `goto` ``.
    pub owner: &'s str,
    /// Which arguments, and whether by position or by name.
    pub takes: Takes<'s>,
}

/// Which arguments, and whether by position or by name.
pub enum Takes<'s> {
    /// Values by position: functions.
    Values,
    /// A value for each name, by position or by name: families, behaviours, statements. `words` says what they are.
    Parameters {
        names: &'s [&'s str],
        words: &'s str,
    },
    /// A value for each name, by name: drives and sensors.
    Settings { names: &'s [&'s str] },
}

impl Takes<'_> {
    fn names(&self) -> &[&str] {
        match self {
            Takes::Values => &[],
            Takes::Parameters { names, .. } | Takes::Settings { names } => names,
        }
    }
}

/// Arguments at their parameters.
pub struct Matched<'a> {
    /// The argument of each parameter that has one.
    given: Vec<Option<&'a Arg>>,
    /// Whether every argument has a parameter of its own; reported if not.
    pub fine: bool,
}

impl<'a> Matched<'a> {
    /// The argument of each parameter that has one, with its value.
    pub fn args(&self) -> impl Iterator<Item = Option<(&'a Arg, &'a Expr)>> {
        let args = self.given.iter();
        args.map(|arg| arg.and_then(|arg| Some((arg, value(arg)?))))
    }

    /// The value of each parameter that has one.
    pub fn values(&self) -> impl Iterator<Item = Option<&'a Expr>> {
        self.args().map(|arg| arg.map(|(_, value)| value))
    }
}

/// The parameter that an argument names.
fn name(arg: &Arg) -> Option<&Ident> {
    match &arg.kind {
        ArgKind::Named(name, _) => Some(name),
        ArgKind::Positional(_) | ArgKind::Range(..) | ArgKind::Binder { .. } => None,
    }
}

/// The value that an argument gives: what a name that ranges over members stands for; a range gives none.
fn value(arg: &Arg) -> Option<&Expr> {
    match &arg.kind {
        ArgKind::Positional(value) | ArgKind::Named(_, value) => Some(value),
        ArgKind::Binder { member, .. } => Some(member),
        ArgKind::Range(..) => None,
    }
}

impl<'a> Checker<'a> {
    /// Finds the parameter of each argument. An argument without one is reported, and checked for its own mistakes.
    pub fn matched(&mut self, signature: &Signature, args: &'a [Arg]) -> Matched<'a> {
        let mut matched = Matched {
            given: vec![None; signature.takes.names().len()],
            fine: true,
        };
        let mut position = 0;
        if let [
            Arg {
                kind: ArgKind::Positional(value),
                ..
            },
        ] = args
        {
            let owner = signature.owner.trim_matches('`').to_owned();
            self.context.argument = Some((value.span, owner));
        }
        let mut named: Option<&Ident> = None;
        for arg in args {
            match (name(arg), named) {
                (Some(name), _) => named = Some(name),
                (None, Some(named)) if matched.fine => {
                    self.after_a_name(signature, named, arg, position);
                }
                (None, _) => {}
            }
            let slot = self.slot(signature, arg, &mut position, matched.fine);
            match slot.map(|slot| matched.given.get_mut(slot)) {
                Some(Some(free @ None)) => {
                    *free = Some(arg);
                    continue;
                }
                Some(Some(Some(first))) => self.given_twice(signature, first, arg),
                Some(None) if matches!(signature.takes, Takes::Values) => {
                    matched.given.push(Some(arg));
                    continue;
                }
                Some(None) => {
                    if matched.fine {
                        self.one_too_many(signature, arg);
                    }
                    self.stray_argument(arg);
                }
                None if matches!(signature.takes, Takes::Settings { .. }) => {}
                None => self.stray_argument(arg),
            }
            matched.fine = false;
        }
        matched
    }

    /// Reports an argument by position behind one by name, where arguments are given in either way.
    fn after_a_name(&mut self, signature: &Signature, named: &Ident, arg: &Arg, position: usize) {
        let Takes::Parameters { names, .. } = signature.takes else {
            return;
        };
        let message = "arguments by position stand before those by name";
        let draft = self
            .error(Code::E0305, arg.span, message)
            .label("by position")
            .also(named.span, "by name");
        if let Some(meant) = names.get(position) {
            let title = format!("say which it is: `{meant} = …`");
            let name = format!("{meant} = ");
            draft.fix(title, arg.span.before(), name, Applicability::Unsafe);
        }
    }

    /// The place of an argument among the parameters. One that has none is reported, but a lack of names or a name too
    /// many only as the first mistake.
    fn slot(
        &mut self,
        signature: &Signature,
        arg: &'a Arg,
        position: &mut usize,
        first_mistake: bool,
    ) -> Option<usize> {
        let owner = signature.owner;
        match (&arg.kind, &signature.takes) {
            (
                ArgKind::Positional(_) | ArgKind::Range(..) | ArgKind::Binder { .. },
                Takes::Settings { names },
            ) => {
                if first_mistake {
                    let message = format!("{owner} takes its settings by name");
                    let draft = self
                        .error(Code::E0305, arg.span, message)
                        .label("which setting is this?")
                        .help(format!("it has {}", listed(names, "and")));
                    if let (ArgKind::Positional(_), Some(first)) = (&arg.kind, names.first()) {
                        let title = format!("if it is `{first}`, say so");
                        let name = format!("{first} = ");
                        draft.fix(title, arg.span.before(), name, Applicability::Unsafe);
                    }
                }
                None
            }
            // Its name is bound to each member in turn.
            (ArgKind::Binder { name, .. }, Takes::Parameters { .. }) if self.is_ranging(name) => {
                *position += 1;
                Some(*position - 1)
            }
            (ArgKind::Binder { name, .. }, _) => {
                // What it would have bound is told of here.
                self.names.lose(&name.name);
                self.error(Code::E0305, arg.span, format!("{owner} takes no `in`"))
                .label("nothing ranges over a kind here")
                .help("`any`, `all`, `count`, `nearest` range over a kind, and so do the lines of `observe`, `choose` and `reward`, and states in those of `start`")
                .none()
            }
            (ArgKind::Range(low, high), _) => {
                let right = format!("{}, {}", print::expr(low), print::expr(high));
                self.error(Code::E0305, arg.span, format!("{owner} takes no range"))
                    .label("only `tune` takes one")
                    .fix(
                        format!("give both ends: `{right}`"),
                        arg.span,
                        right,
                        Applicability::Unsafe,
                    )
                    .none()
            }
            (ArgKind::Positional(_), _) => {
                *position += 1;
                Some(*position - 1)
            }
            (ArgKind::Named(name, value), Takes::Values) => {
                if first_mistake {
                    let message = format!("{owner} takes its arguments by position");
                    let until_value = Span {
                        end: value.span.start,
                        ..name.span
                    };
                    let shape = owner.trim_matches('`');
                    let draft = self.error(Code::E0305, name.span, message);
                    match name.name.as_str() {
                        "facing" if SHAPES.contains(&shape) => {
                            let way = print::expr(value);
                            draft
                                .label("which way a place faces is said behind its shape")
                                .help(format!("write `{shape}(…) facing {way}`"))
                        }
                        _ => draft.label("no parameter has a name").fix(
                            "drop the name",
                            until_value,
                            "",
                            Applicability::Unsafe,
                        ),
                    };
                }
                None
            }
            (ArgKind::Named(name, _), takes) => {
                let names = takes.names();
                let slot = names.iter().position(|known| *known == name.name);
                if slot.is_none() {
                    let (code, what) = match takes {
                        Takes::Settings { .. } => (Code::E0403, "setting"),
                        _ => (Code::E0305, "parameter"),
                    };
                    self.unknown_to(owner, code, name, what, names);
                }
                slot
            }
        }
    }

    fn given_twice(&mut self, signature: &Signature, first: &Arg, again: &Arg) {
        match (&signature.takes, name(first), name(again)) {
            (Takes::Settings { .. }, Some(first), Some(again)) => {
                self.said_twice(&again.name, again.span, first.span);
            }
            (_, first, second) => {
                let name = second.or(first).map_or("", |name| &name.name);
                self.error(Code::E0305, again.span, format!("`{name}` is given twice"))
                    .label("given a second time");
            }
        }
    }

    fn one_too_many(&mut self, signature: &Signature, arg: &Arg) {
        let Takes::Parameters { names, words } = signature.takes else {
            return;
        };
        let message = format!("{} takes {words}", signature.owner);
        self.error(Code::E0305, arg.span, message)
            .label(if names.is_empty() {
                "there is no parameter for it"
            } else {
                "one too many"
            });
    }

    /// Checks an argument that has no parameter, for its own mistakes. A name that is not declared belongs to the parameter that
    /// there is not.
    pub fn stray_argument(&mut self, arg: &'a Arg) {
        if let ArgKind::Named(_, value) = &arg.kind
            && let Some(name) = plain_ref(value).filter(|name| name.args.is_none())
            && self.context.lookup(&name.name.name).is_none()
            && self
                .names
                .value(&name.name.name, self.context.library)
                .is_none()
            && !is_built_in(&name.name.name)
        {
            return;
        }
        if let ArgKind::Positional(value) | ArgKind::Named(_, value) = &arg.kind {
            self.expr(value);
        }
    }

    /// The arguments of a function, if they are as many as it takes.
    pub fn positional(
        &mut self,
        reference: &'a Ref,
        least: usize,
        most: usize,
    ) -> Option<Vec<&'a Expr>> {
        let name = &reference.name.name;
        let Some(args) = &reference.args else {
            if name == "min" && self.context.region == Region::Schedule {
                let message = "a time is a number with its unit";
                return self
                    .error(Code::E0301, reference.span, message)
                    .label("how many minutes?")
                    .fix(
                        "of one minute: write `1 min`",
                        reference.span,
                        "1 min",
                        Applicability::Unsafe,
                    )
                    .none();
            }
            // A kind may be called as a function is.
            if self.names.types.contains_key(name.as_str()) {
                return self.not_one_of_them(&reference.name).none();
            }
            return self
                .error(
                    Code::E0305,
                    reference.span,
                    format!("`{name}` is a function"),
                )
                .label(format!("call it: `{name}(…)`"))
                .help_if((name == "min").then(|| "one minute is `1 min`".to_owned()))
                .help_if(
                    (name == "pose").then(|| "where the robot at hand is: `position`".to_owned()),
                )
                .none();
        };
        let signature = Signature {
            owner: &format!("`{name}`"),
            takes: Takes::Values,
        };
        let matched = self.matched(&signature, args);
        let values: Vec<&'a Expr> = matched.values().flatten().collect();
        if !matched.fine {
            return None;
        }
        if (least..=most).contains(&values.len()) {
            return Some(values);
        }
        let wanted = match (least, most) {
            (1, 1) => "one argument".to_owned(),
            (a, usize::MAX) => format!("{a} arguments or more"),
            (a, b) if a == b => format!("{a} arguments"),
            (a, b) => format!("{a} or {b} arguments"),
        };
        let surplus = args.get(most).map_or(reference.span, |arg| arg.span);
        let torn = (values.len() > most).then(|| decimal_comma(&values));
        let message = format!("`{name}` takes {wanted}, not {}", values.len());
        let draft = self
            .error(Code::E0305, surplus, message)
            .label(match values.len() > most {
                true => "one too many",
                false => "too few",
            });
        match torn.flatten() {
            Some((place, number)) => {
                let title = "a decimal fraction has a point";
                draft.fix(title, place, number, Applicability::Unsafe);
            }
            None => draft.emit(),
        }
        for value in values {
            self.expr(value);
        }
        None
    }
}

/// The comma of the first decimal fraction that is written with one, as in `0,18 m`, and a point in its place.
fn decimal_comma(values: &[&Expr]) -> Option<(Span, &'static str)> {
    let digits = |literal: &Literal| literal.digits.bytes().all(|byte| byte.is_ascii_digit());
    values
        .iter()
        .zip(values.get(1..)?)
        .find_map(|(whole, rest)| {
            let (ExprKind::Number(one), ExprKind::Number(other)) = (&whole.kind, &rest.kind) else {
                return None;
            };
            let comma = Span {
                start: whole.span.end,
                end: rest.span.start,
                ..whole.span
            };
            let torn = one.unit.is_none() && digits(one) && digits(other);
            (torn && comma.range().len() == 1).then_some((comma, "."))
        })
}
