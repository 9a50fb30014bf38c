//! References: names and calls, with their arguments matched to parameters.

use crate::check::Checker;
use crate::check::builtin;
use crate::check::context::Region;
use crate::check::names::{Decl, unknown};
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Name;
use crate::ir::expr::Expr;
use crate::source::Span;
use crate::syntax::ast::{self, LetBody, Ref};

impl<'a> Checker<'a> {
    /// A name, or a call.
    pub fn reference(&mut self, reference: &'a Ref) -> Typed {
        let name = reference.name.name.as_str();
        let span = reference.span;
        if reference.args.is_none() {
            if let Some(binding) = self.context.lookup(name) {
                let (at, typed) = (
                    binding.span,
                    Typed {
                        ty: binding.ty.clone(),
                        value: binding.value.clone(),
                        span,
                    },
                );
                self.reads(at);
                return typed;
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
        let span = reference.span;
        let mut candidates: Vec<&str> = Vec::new();
        candidates.extend(self.context.scope.iter().map(|bound| bound.name.as_str()));
        candidates.extend(self.names.values(|decl| !matches!(decl, Decl::Tree(_))));
        for name in builtin::names() {
            candidates.push(name);
        }
        // Only a sensor of the acting robot can be missing from a body of the library.
        let user = self.open_bodies.iter().find(|open| open.library);
        let diagnostic = match user {
            Some(open) if self.context.library => {
                let missing = &reference.name.name;
                let message = format!("`{}` needs a sensor `{missing}`", open.name);
                Diagnostic::new(Code::E0406, span, message)
                    .label("read here, and the robot has none")
                    .help(format!(
                        "add it to the robot: `sensor {missing} = scanner(from = …, to = …, range = …)`"
                    ))
            }
            _ if called => unknown(&reference.name, "function, predicate or `let`", candidates),
            _ => unknown(&reference.name, "state, event, place or `let`", candidates),
        };
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
                    .and_then(|world| {
                        world
                            .places
                            .find(|place| place.name == Name::word(&name.name))
                    })
                    .map(Value::Place),
            ),
            Decl::Wall(name, kind) => known(
                Type::Wall(kind.map(|kind| kind.name.clone())),
                world
                    .and_then(|world| world.walls.find(|wall| wall.name == Name::word(&name.name)))
                    .map(Value::Wall),
            ),
            Decl::Sensor(name) => known(
                Type::Sensor,
                world
                    .and_then(|world| {
                        world
                            .robot
                            .sensors
                            .find(|sensor| sensor.name == Name::word(&name.name))
                    })
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

    /// Checks a `let` for itself.
    pub fn shared(&mut self, shared: &'a ast::Let) {
        if self.clean_bodies.contains_key(&shared.name.span) {
            return;
        }
        let bindings = self.unknown_parameters(shared.params.as_ref());
        self.body_for_itself(&shared.name, Region::Let, bindings, |checker| {
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

    /// A leaf of the pool with its type.
    pub fn leaf(&mut self, expr: Expr, ty: Type, span: Span) -> Typed {
        let id = self.program.pool.leaf(expr);
        Typed {
            ty,
            value: Value::Scalar(id),
            span,
        }
    }
}
