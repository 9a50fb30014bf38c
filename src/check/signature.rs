//! Arguments, and the parameters that they are for.

use super::Checker;
use super::context::{Binding, Context, Region};
use super::report::listed;
use super::types::Type;
use crate::diagnostic::Code;
use crate::syntax::ast::{Arg, ArgKind, Expr, Param, Params, Ref};

/// What can be given to something that is called, and how.
pub struct Signature<'s> {
    /// Who takes the arguments, as a message names it: `` `goto` ``.
    pub owner: &'s str,
    /// What is taken.
    pub takes: Takes<'s>,
}

/// What is taken, and how.
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

/// The value that an argument gives; a binder gives none.
fn value(arg: &Arg) -> Option<&Expr> {
    match &arg.kind {
        ArgKind::Positional(value) | ArgKind::Named(_, value) => Some(value),
        ArgKind::Binder { .. } => None,
    }
}

impl<'a> Checker<'a> {
    /// Finds the parameter of each argument. What finds none is reported, and checked for its own mistakes.
    pub fn matched(&mut self, signature: &Signature, args: &'a [Arg]) -> Matched<'a> {
        let names = signature.takes.names();
        let mut matched = Matched {
            given: vec![None; names.len()],
            fine: true,
        };
        let mut position = 0;
        for arg in args {
            let Some(slot) = self.slot(signature, arg, &mut position, matched.fine) else {
                matched.fine = false;
                continue;
            };
            match (matched.given.get_mut(slot), &signature.takes) {
                (Some(free @ None), _) => *free = Some(arg),
                (Some(Some(first)), takes) => {
                    let name = names.get(slot).copied().unwrap_or_default();
                    match (takes, &first.kind, &arg.kind) {
                        (
                            Takes::Settings { .. },
                            ArgKind::Named(first, _),
                            ArgKind::Named(again, _),
                        ) => self.said_twice(name, again.span, first.span),
                        _ => self
                            .error(Code::E0305, arg.span, format!("`{name}` is given twice"))
                            .label("given a second time")
                            .emit(),
                    }
                    matched.fine = false;
                }
                (None, Takes::Parameters { words, .. }) => {
                    if matched.fine {
                        let owner = signature.owner;
                        self.error(Code::E0305, arg.span, format!("{owner} takes {words}"))
                            .label(if names.is_empty() {
                                "there is no parameter for it"
                            } else {
                                "one too many"
                            });
                    }
                    self.stray_argument(arg);
                    matched.fine = false;
                }
                (None, _) => matched.given.push(Some(arg)),
            }
        }
        matched
    }

    /// The place of an argument among the parameters; what can have none is reported, unless it is like what was
    /// reported before.
    fn slot(
        &mut self,
        signature: &Signature,
        arg: &'a Arg,
        position: &mut usize,
        first_mistake: bool,
    ) -> Option<usize> {
        let owner = signature.owner;
        match (&arg.kind, &signature.takes) {
            (ArgKind::Positional(_) | ArgKind::Binder { .. }, Takes::Settings { names }) => {
                // One message is enough to say that all of them need their names.
                if first_mistake {
                    self.error(
                        Code::E0305,
                        arg.span,
                        format!("{owner} takes its settings by name"),
                    )
                    .label("which setting is this?")
                    .help(format!("it has {}", listed(names, "and")));
                }
                None
            }
            (ArgKind::Positional(_), _) => {
                *position += 1;
                Some(*position - 1)
            }
            (ArgKind::Named(name, _), Takes::Values) => {
                if first_mistake {
                    self.error(
                        Code::E0305,
                        name.span,
                        format!("{owner} takes its arguments by position"),
                    )
                    .label("no parameter has a name");
                }
                self.stray_argument(arg);
                None
            }
            (ArgKind::Named(name, _), Takes::Parameters { names, .. }) => {
                let slot = names.iter().position(|known| *known == name.name);
                if slot.is_none() {
                    self.unknown_to(owner, Code::E0305, name, "parameter", names);
                    self.stray_argument(arg);
                }
                slot
            }
            (ArgKind::Named(name, _), Takes::Settings { names }) => {
                let slot = names.iter().position(|known| *known == name.name);
                if slot.is_none() {
                    self.unknown_to(owner, Code::E0403, name, "setting", names);
                }
                slot
            }
            (ArgKind::Binder { .. }, _) => self
                .error(Code::E0305, arg.span, format!("{owner} takes no `in`"))
                .label("only any, all, count and nearest range over a kind")
                .none(),
        }
    }

    /// Checks an argument that has no parameter, for its own mistakes.
    pub fn stray_argument(&mut self, arg: &'a Arg) {
        if let Some(value) = value(arg) {
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
            return self
                .error(
                    Code::E0305,
                    reference.span,
                    format!("`{name}` is a function"),
                )
                .label(format!("call it: `{name}(…)`"))
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
        self.error(
            Code::E0305,
            surplus,
            format!("`{name}` takes {wanted}, not {}", values.len()),
        )
        .label(if values.len() > most {
            "one too many"
        } else {
            "too few"
        });
        for value in values {
            self.expr(value);
        }
        None
    }

    /// Parameters that are known by their type only.
    pub fn unknown_parameters(&mut self, params: Option<&'a Params>) -> Vec<Binding<'a>> {
        let mut bindings: Vec<Binding<'a>> = Vec::new();
        for param in params.map_or(&[][..], |params| &params.params) {
            let name = &param.name;
            let ty = self.type_expr(&param.ty);
            if let Some(default) = &param.default {
                let role = format!("`{}`", name.name);
                let region = std::mem::replace(&mut self.context.region, Region::Let);
                self.expect(default, &ty, &role);
                self.context.region = region;
            }
            if let Some(first) = bindings.iter().find(|other| other.name.name == name.name) {
                self.error(
                    Code::E0201,
                    name.span,
                    format!("two parameters are called `{}`", name.name),
                )
                .label("declared again here")
                .also(first.name.span, "first declared here");
            }
            self.binds(name, "parameter");
            bindings.push(Binding::unknown(name, ty));
        }
        bindings
    }

    /// The parameters of a declaration with the values that a reference gives them, by position, by name or by
    /// default; `library` says whether the declaration is of the library. Every mistake is reported; `None` if there
    /// are any.
    pub fn bind_arguments(
        &mut self,
        params: Option<&'a Params>,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Vec<Binding<'a>>> {
        let params: &'a [Param] = params.map_or(&[], |params| &params.params);
        let name = &reference.name.name;
        let names: Vec<&str> = params
            .iter()
            .map(|param| param.name.name.as_str())
            .collect();
        let signature = Signature {
            owner: &format!("`{name}`"),
            takes: Takes::Parameters {
                names: &names,
                words: &words(params),
            },
        };
        let args = reference.args.as_deref().unwrap_or_default();
        let matched = self.matched(&signature, args);
        let mut fine = matched.fine;
        let mut bindings: Vec<Binding<'a>> = Vec::new();
        for (param, given) in params.iter().zip(matched.values()) {
            let role = format!("`{}` of `{name}`", param.name.name);
            let ty = self.in_library(library, |checker| checker.type_expr(&param.ty));
            let value = match (given, &param.default) {
                (Some(value), _) => self.expect(value, &ty, &role),
                (None, Some(default)) => {
                    let context = Context {
                        region: Region::Let,
                        library,
                        scope: bindings.clone(),
                    };
                    let outer = std::mem::replace(&mut self.context, context);
                    let (value, _) = self.captured(|checker| checker.expect(default, &ty, &role));
                    self.context = outer;
                    value
                }
                (None, None) => {
                    // Another wrong argument may have been meant for it.
                    if fine {
                        self.error(
                            Code::E0305,
                            reference.span,
                            format!("`{name}` needs its argument `{}`", param.name.name),
                        )
                        .label(format!("{ty} is missing"))
                        .also(param.span, "it is declared here");
                    }
                    fine = false;
                    continue;
                }
            };
            fine &= value.ty != Type::Error;
            let ty = if ty == Type::Error { value.ty } else { ty };
            bindings.push(Binding::new(&param.name, ty, value.value));
        }
        fine.then_some(bindings)
    }

    fn in_library<T>(&mut self, library: bool, pass: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.context.library, library);
        let result = pass(self);
        self.context.library = outer;
        result
    }
}

/// How many arguments parameters take, in words.
fn words(params: &[Param]) -> String {
    let most = if params.iter().any(|param| param.default.is_some()) {
        "at most "
    } else {
        ""
    };
    match params.len() {
        0 => "no arguments".to_owned(),
        1 => format!("{most}one argument"),
        n => format!("{most}{n} arguments"),
    }
}
