//! Arguments and the parameters that they are given to.

use super::Checker;
use super::context::{Binding, Context, Region};
use super::names::stranger;
use super::types::{Type, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{self, Arg, ArgKind, Param, Params, Ref};

impl<'a> Checker<'a> {
    /// Parameters that are known by their type only.
    pub fn unknown_parameters(&mut self, params: Option<&'a Params>) -> Vec<Binding> {
        let mut bindings: Vec<Binding> = Vec::new();
        for param in params.map_or(&[][..], |params| &params.params) {
            let ty = self.type_expr(&param.ty);
            if let Some(default) = &param.default {
                let role = format!("`{}`", param.name.name);
                let region = std::mem::replace(&mut self.context.region, Region::Let);
                self.expect(default, &ty, &role);
                self.context.region = region;
            }
            if let Some(first) = bindings.iter().find(|b| b.name == param.name.name) {
                let first = first.span;
                self.report(
                    Diagnostic::new(
                        Code::E0201,
                        param.name.span,
                        format!("two parameters are called `{}`", param.name.name),
                    )
                    .label("declared again here")
                    .also(first, "first declared here"),
                );
            }
            self.binds(&param.name, "parameter");
            bindings.push(Binding {
                name: param.name.name.clone(),
                ty,
                value: Value::Unknown,
                locals: Vec::new(),
                settable: false,
                span: param.name.span,
            });
        }
        bindings
    }

    /// Matches arguments to parameters: by position, by name, by default. Every mistake is reported; `None` if there
    /// were any.
    pub fn bind_arguments(
        &mut self,
        params: Option<&'a Params>,
        library: bool,
        reference: &'a Ref,
        default_region: Region,
    ) -> Option<Vec<Binding>> {
        let params: &'a [Param] = params.map_or(&[], |params| &params.params);
        let args: &'a [Arg] = reference.args.as_deref().unwrap_or_default();
        let mut given: Vec<Option<&'a ast::Expr>> = vec![None; params.len()];
        let mut fine = true;
        let mut position = 0;
        for arg in args {
            let (slot, value) = match &arg.kind {
                ArgKind::Positional(value) => {
                    position += 1;
                    (Some(position - 1), value)
                }
                ArgKind::Named(name, value) => {
                    let slot = params.iter().position(|p| p.name.name == name.name);
                    if slot.is_none() {
                        let known: Vec<&str> =
                            params.iter().map(|p| p.name.name.as_str()).collect();
                        let owner = format!("`{}`", reference.name.name);
                        self.report(stranger(Code::E0305, name, &owner, "parameter", &known));
                        self.expr(value);
                        fine = false;
                        continue;
                    }
                    (slot, value)
                }
                ArgKind::Binder { .. } => {
                    self.report(no_binder(&reference.name.name, arg.span));
                    fine = false;
                    continue;
                }
            };
            match slot.and_then(|slot| given.get_mut(slot)) {
                Some(place @ None) => *place = Some(value),
                Some(Some(_)) => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            arg.span,
                            format!("`{}` is given twice", param_name(params, slot)),
                        )
                        .label("given a second time"),
                    );
                    fine = false;
                }
                None => {
                    if fine {
                        self.report(too_many(&reference.name.name, params, arg.span));
                    }
                    self.expr(value);
                    fine = false;
                }
            }
        }
        let mut bindings: Vec<Binding> = Vec::new();
        for (param, given) in params.iter().zip(given) {
            let role = format!("`{}` of `{}`", param.name.name, reference.name.name);
            let ty = self.in_library(library, |checker| checker.type_expr(&param.ty));
            let value = match (given, &param.default) {
                (Some(value), _) => self.expect(value, &ty, &role),
                (None, Some(default)) => {
                    let outer = std::mem::replace(
                        &mut self.context,
                        Context {
                            region: default_region,
                            library,
                            scope: bindings.clone(),
                        },
                    );
                    let (value, _) = self.captured(|checker| checker.expect(default, &ty, &role));
                    self.context = outer;
                    value
                }
                (None, None) => {
                    // Another wrong argument may have been meant for it.
                    if fine {
                        self.report(
                            Diagnostic::new(
                                Code::E0305,
                                reference.span,
                                format!(
                                    "`{}` needs its argument `{}`",
                                    reference.name.name, param.name.name
                                ),
                            )
                            .label(format!("{ty} is missing"))
                            .also(param.span, "it is declared here"),
                        );
                    }
                    fine = false;
                    continue;
                }
            };
            fine &= value.ty != Type::Error;
            bindings.push(Binding {
                name: param.name.name.clone(),
                ty: if ty == Type::Error { value.ty } else { ty },
                value: value.value,
                locals: Vec::new(),
                settable: false,
                span: param.name.span,
            });
        }
        fine.then_some(bindings)
    }

    /// The positional arguments, if there are as many as are wanted.
    pub fn positional(
        &mut self,
        reference: &'a Ref,
        least: usize,
        most: usize,
    ) -> Option<Vec<&'a ast::Expr>> {
        let Some(args) = &reference.args else {
            self.report(
                Diagnostic::new(
                    Code::E0305,
                    reference.span,
                    format!("`{}` is a function", reference.name.name),
                )
                .label(format!("call it: `{}(…)`", reference.name.name)),
            );
            return None;
        };
        let mut values = Vec::new();
        for arg in args {
            match &arg.kind {
                ArgKind::Positional(value) => values.push(value),
                ArgKind::Named(name, value) => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            name.span,
                            format!("`{}` takes its arguments by position", reference.name.name),
                        )
                        .label("no parameter has a name"),
                    );
                    self.expr(value);
                    return None;
                }
                ArgKind::Binder { .. } => {
                    self.report(no_binder(&reference.name.name, arg.span));
                    return None;
                }
            }
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
        self.report(
            Diagnostic::new(
                Code::E0305,
                surplus,
                format!(
                    "`{}` takes {wanted}, not {}",
                    reference.name.name,
                    values.len()
                ),
            )
            .label(if values.len() > most {
                "one too many"
            } else {
                "too few"
            }),
        );
        for value in values {
            self.expr(value);
        }
        None
    }

    /// Checks an argument whose function is not known, for its own mistakes.
    pub fn stray_argument(&mut self, arg: &'a Arg) {
        match &arg.kind {
            ArgKind::Positional(value) | ArgKind::Named(_, value) => {
                self.expr(value);
            }
            ArgKind::Binder { .. } => {}
        }
    }

    pub fn in_library<T>(&mut self, library: bool, pass: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.context.library, library);
        let result = pass(self);
        self.context.library = outer;
        result
    }
}

/// A binder among the arguments of what ranges over nothing.
pub fn no_binder(name: &str, span: Span) -> Diagnostic {
    Diagnostic::new(Code::E0305, span, format!("`{name}` takes no `in`"))
        .label("only any, all, count and nearest range over a kind")
}

/// The name of the parameter in a slot.
fn param_name(params: &[Param], slot: Option<usize>) -> &str {
    slot.and_then(|slot| params.get(slot))
        .map_or("", |param| &param.name.name)
}

/// An argument beyond the last parameter.
fn too_many(name: &str, params: &[Param], span: Span) -> Diagnostic {
    let most = if params.iter().any(|param| param.default.is_some()) {
        "at most "
    } else {
        ""
    };
    let message = match params.len() {
        0 => format!("`{name}` takes no arguments"),
        1 => format!("`{name}` takes {most}one argument"),
        n => format!("`{name}` takes {most}{n} arguments"),
    };
    let label = if params.is_empty() {
        "there is no parameter for it"
    } else {
        "one too many"
    };
    Diagnostic::new(Code::E0305, span, message).label(label)
}
