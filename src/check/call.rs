//! References: names and calls, with their arguments matched to parameters.

use super::Checker;
use super::builtin;
use super::context::{Binding, Context, Region};
use super::names::{Decl, unknown};
use super::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::Expr;
use crate::source::Span;
use crate::syntax::ast::{self, Arg, ArgKind, LetBody, Param, Params, Ref};

impl<'a> Checker<'a> {
    /// A name, or a call.
    pub(super) fn reference(&mut self, reference: &'a Ref) -> Typed {
        let name = reference.name.name.as_str();
        let span = reference.span;
        if reference.args.is_none() {
            if let Some(binding) = self.context.lookup(name) {
                return Typed {
                    ty: binding.ty.clone(),
                    value: binding.value.clone(),
                    span,
                };
            }
            if let Some(value) = builtin::Constant::named(name) {
                return self.built_in_value(value, span);
            }
        }
        if let Some(function) = builtin::Function::named(name) {
            return self.built_in_call(function, reference);
        }
        match self.names.value(name, self.context.library) {
            Some((decl, library)) => self.declared_reference(decl, library, reference),
            None => {
                self.unknown_value(reference);
                Typed::error(span)
            }
        }
    }

    fn unknown_value(&mut self, reference: &Ref) {
        let called = reference.args.is_some();
        let mut candidates: Vec<&str> = Vec::new();
        candidates.extend(self.context.scope.iter().map(|bound| bound.name.as_str()));
        candidates.extend(self.names.values(|decl| !matches!(decl, Decl::Tree(_))));
        for name in builtin::names() {
            candidates.push(name);
        }
        let what = if called { "function" } else { "value" };
        let diagnostic = unknown(&reference.name, what, candidates);
        self.report(diagnostic);
    }

    fn declared_reference(&mut self, decl: Decl<'a>, library: bool, reference: &'a Ref) -> Typed {
        let span = reference.span;
        match decl {
            Decl::Let(shared) => return self.shared_call(shared, library, reference),
            Decl::Predicate(predicate) => {
                return self.predicate_value(predicate, library, reference);
            }
            Decl::Behavior(behavior) => {
                return match self.behavior_instance(behavior, library, reference) {
                    Some(value) => Typed {
                        ty: Type::Behavior,
                        value,
                        span,
                    },
                    None => Typed::error(span),
                };
            }
            Decl::State(state) => return self.state_value(state, reference),
            Decl::Event(event) => return self.event_value(event, reference),
            _ => {}
        }
        if let Some(args) = &reference.args {
            self.report(
                Diagnostic::new(
                    Code::E0203,
                    reference.name.span,
                    format!("`{}` takes no arguments", reference.name.name),
                )
                .label(format!("this is {}", decl.what())),
            );
            for arg in args {
                self.stray_argument(arg);
            }
            return Typed::error(span);
        }
        let world = self.program.world.as_ref();
        let known = |ty: Type, value: Option<Value>| Typed {
            ty,
            value: value.unwrap_or(Value::Unknown),
            span,
        };
        match decl {
            Decl::Variant(decl, index) => {
                let id = self.program.pool.num(index as f64);
                known(Type::Enum(decl.name.name.clone()), Some(Value::Scalar(id)))
            }
            Decl::Place(name, kind) => known(
                Type::Place(kind.map(|kind| kind.name.clone())),
                world
                    .and_then(|world| world.places.find(|place| place.name == name.name))
                    .map(Value::Place),
            ),
            Decl::Wall(name, kind) => known(
                Type::Wall(kind.map(|kind| kind.name.clone())),
                world
                    .and_then(|world| world.walls.find(|wall| wall.name == name.name))
                    .map(Value::Wall),
            ),
            Decl::Sensor(name) => known(
                Type::Sensor,
                world
                    .and_then(|world| world.robot.sensors.find(|sensor| sensor.name == name.name))
                    .map(Value::Sensor),
            ),
            Decl::Robot(_) => known(Type::Robot, Some(Value::Robot)),
            _ => {
                self.report(
                    Diagnostic::new(
                        Code::E0203,
                        span,
                        format!("`{}` has no value", reference.name.name),
                    )
                    .label(format!("this is {}", decl.what())),
                );
                Typed::error(span)
            }
        }
    }

    /// Checks an argument whose function is not known, for its own mistakes.
    pub(super) fn stray_argument(&mut self, arg: &'a Arg) {
        match &arg.kind {
            ArgKind::Positional(value) | ArgKind::Named(_, value) => {
                self.expr(value);
            }
            ArgKind::Binder { .. } => {}
        }
    }

    /// Checks a `let` for itself.
    pub(super) fn shared(&mut self, shared: &'a ast::Let) {
        if self.clean_bodies.contains_key(&shared.name.span) {
            return;
        }
        let bindings = self.unknown_parameters(shared.params.as_ref());
        self.body_for_itself(shared.name.span, Region::Let, bindings, |checker| {
            checker.shared_body(shared);
        });
    }

    fn shared_body(&mut self, shared: &'a ast::Let) -> Typed {
        match &shared.body {
            LetBody::Expr(value) => self.declared(shared.ty.as_ref(), value, &shared.name.name),
            LetBody::Yield(body) => {
                let typed = self.yielded(body);
                match &shared.ty {
                    Some(written) => {
                        let wanted = self.type_expr(written);
                        let role = format!("`{}`", shared.name.name);
                        self.coerce(typed, &body.value, &wanted, &role)
                    }
                    None => typed,
                }
            }
        }
    }

    fn shared_call(&mut self, shared: &'a ast::Let, library: bool, reference: &'a Ref) -> Typed {
        if !library {
            self.shared(shared);
        }
        let bound = self.bind_arguments(shared.params.as_ref(), library, reference, Region::Let);
        let Some(bindings) = bound else {
            return Typed::error(reference.span);
        };
        let body = shared.name.span;
        let region = self.context.region;
        let result = self.unrolled(body, reference, library, region, bindings, |checker| {
            checker.shared_body(shared)
        });
        let mut typed = result.unwrap_or_else(|| Typed::error(reference.span));
        typed.span = reference.span;
        typed
    }

    /// Checks a body with its parameters known by type only, and remembers whether it is free of mistakes.
    pub(super) fn body_for_itself(
        &mut self,
        body: Span,
        region: Region,
        scope: Vec<Binding>,
        pass: impl FnOnce(&mut Self),
    ) {
        self.clean_bodies.insert(body, true);
        let outer = std::mem::replace(
            &mut self.context,
            Context {
                region,
                library: false,
                scope,
            },
        );
        self.open_bodies.push(body);
        let ((), found) = self.captured(pass);
        self.open_bodies.pop();
        self.context = outer;
        let clean = !found.iter().any(Diagnostic::is_error);
        self.clean_bodies.insert(body, clean);
        self.diagnostics.extend(found);
    }

    /// Checks a body again under arguments. Mistakes that only these make are reported where they are given; `None`
    /// where there were any.
    pub(super) fn unrolled<T>(
        &mut self,
        body: Span,
        reference: &Ref,
        library: bool,
        region: Region,
        scope: Vec<Binding>,
        pass: impl FnOnce(&mut Self) -> T,
    ) -> Option<T> {
        let name = &reference.name.name;
        if self.open_bodies.contains(&body) {
            self.report(
                Diagnostic::new(
                    Code::E0205,
                    reference.name.span,
                    format!("`{name}` is defined by itself"),
                )
                .label("this use closes the circle"),
            );
            return None;
        }
        if self.clean_bodies.get(&body) == Some(&false) {
            return None;
        }
        let outer = std::mem::replace(
            &mut self.context,
            Context {
                region,
                library,
                scope,
            },
        );
        self.open_bodies.push(body);
        let (result, found) = self.captured(pass);
        self.open_bodies.pop();
        self.context = outer;
        let Some(inner) = found.iter().find(|diagnostic| diagnostic.is_error()) else {
            return Some(result);
        };
        let within = inner.code == Code::E0205 || inner.code == Code::E0406;
        let diagnostic = if within {
            let mut diagnostic = inner.clone();
            if library && let Some(primary) = diagnostic.labels.first_mut() {
                primary.span = reference.span;
            }
            diagnostic
        } else if library && inner.code == Code::E0202 {
            // Only a sensor of the acting robot can be missing from a body of the library.
            let missing = inner
                .message
                .split('`')
                .nth(1)
                .unwrap_or_default()
                .to_owned();
            Diagnostic::new(
                Code::E0406,
                reference.span,
                format!("`{name}` needs a sensor `{missing}`"),
            )
            .label("the robot has no such sensor")
            .also(inner.span(), "it is read here")
            .help(format!(
                "add it to the robot: `sensor {missing} = scanner(from = …, to = …, range = …)`"
            ))
        } else {
            let label = inner
                .labels
                .first()
                .map(|label| label.message.clone())
                .unwrap_or_default();
            Diagnostic::new(
                inner.code,
                reference.span,
                format!("`{name}` cannot be used so: {}", inner.message),
            )
            .label("with these arguments, or here")
            .also(inner.span(), label)
        };
        self.report(diagnostic);
        None
    }

    /// Parameters that are known by their type only.
    pub(super) fn unknown_parameters(&mut self, params: Option<&'a Params>) -> Vec<Binding> {
        let mut bindings: Vec<Binding> = Vec::new();
        for param in params.map_or(&[][..], |params| &params.params) {
            let ty = self.type_expr(&param.ty);
            if let Some(default) = &param.default {
                let role = format!("`{}`", param.name.name);
                self.expect(default, &ty, &role);
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
            bindings.push(Binding {
                name: param.name.name.clone(),
                ty,
                value: Value::Unknown,
                locals: Vec::new(),
                span: param.name.span,
            });
        }
        bindings
    }

    /// Matches arguments to parameters: by position, by name, by default. Every mistake is reported; `None` if there
    /// were any.
    pub(super) fn bind_arguments(
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
                        let known = params.iter().map(|param| param.name.name.as_str());
                        let diagnostic = unknown(name, "parameter", known);
                        self.report(diagnostic);
                        fine = false;
                        continue;
                    }
                    (slot, value)
                }
                ArgKind::Binder { .. } => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            arg.span,
                            format!("`{}` takes no `in`", reference.name.name),
                        )
                        .label("only any, all, count and nearest range over a kind"),
                    );
                    fine = false;
                    continue;
                }
            };
            match slot.and_then(|slot| given.get_mut(slot)) {
                Some(place @ None) => *place = Some(value),
                Some(Some(_)) => {
                    self.report(
                        Diagnostic::new(Code::E0305, arg.span, "this argument is given twice")
                            .label("given a second time"),
                    );
                    fine = false;
                }
                None => {
                    self.report(too_many(&reference.name.name, params, arg.span));
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
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            reference.span,
                            format!(
                                "`{}` needs its argument `{}`",
                                reference.name.name, param.name.name
                            ),
                        )
                        .label(format!("`{}` is not given", param.name.name))
                        .also(param.span, "declared here"),
                    );
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
                span: param.name.span,
            });
        }
        fine.then_some(bindings)
    }

    fn in_library<T>(&mut self, library: bool, pass: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.context.library, library);
        let result = pass(self);
        self.context.library = outer;
        result
    }

    /// A leaf of the pool with its type.
    pub(super) fn leaf(&mut self, expr: Expr, ty: Type, span: Span) -> Typed {
        let id = self.program.pool.leaf(expr);
        Typed {
            ty,
            value: Value::Scalar(id),
            span,
        }
    }
}

fn too_many(name: &str, params: &[Param], span: Span) -> Diagnostic {
    let message = match params.len() {
        0 => format!("`{name}` takes no arguments"),
        1 => format!("`{name}` takes one argument"),
        n => format!("`{name}` takes {n} arguments"),
    };
    Diagnostic::new(Code::E0305, span, message).label("one too many")
}
