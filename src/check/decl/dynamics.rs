//! State variables, events, and what they do.

use crate::check::Checker;
use crate::check::context::{Binding, Context, Region};
use crate::check::decl::statement::Home;
use crate::check::names::{Decl, TypeDecl, unknown};
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::Expr;
use crate::ir::name::Coordinate;
use crate::ir::program::{Effect, Event, State, ValueKind};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, Ident, Ref, Trigger};

/// The id of an event.
pub type EventId = Id<Event>;

/// The variables behind a declared state: one, or two for a point.
#[derive(Clone, Debug)]
pub struct StateSlot {
    /// The declared type.
    pub ty: Type,
    /// The variables.
    pub ids: Vec<Id<State>>,
}

impl<'a> Checker<'a> {
    /// `state name: type = constant`
    pub fn state(&mut self, state: &'a ast::State) {
        self.context = Context::new(Region::World);
        if let Some(params) = &state.params {
            let scope = self.unknown_parameters(Some(params));
            self.context.scope = scope;
            self.declared(state.ty.as_ref(), &state.value, &state.name.name);
            self.context.scope.clear();
            self.not_yet(params.span, "families of state variables");
            return;
        }
        let value = self.declared(state.ty.as_ref(), &state.value, &state.name.name);
        let kind = match &value.ty {
            Type::Error => return,
            Type::Bool => ValueKind::Bool,
            Type::Enum(name) => ValueKind::Enum(self.variants(name)),
            Type::Point | Type::Quantity(_) | Type::Ratio => ValueKind::Quantity,
            other => {
                self.report(
                    Diagnostic::new(
                        Code::E0302,
                        value.span,
                        format!("a state cannot hold {other}"),
                    )
                    .label("numbers, truth values, points and enums can be held"),
                );
                return;
            }
        };
        let name = Name::word(&state.name.name);
        let parts = match value.value {
            Value::Scalar(id) => vec![(name, id)],
            Value::Point(x, y) => vec![
                (name.coordinate(Coordinate::X), x),
                (name.coordinate(Coordinate::Y), y),
            ],
            _ => return,
        };
        let mut ids = Vec::new();
        for (name, initial) in parts {
            let part = Typed {
                value: Value::Scalar(initial),
                ..value.clone()
            };
            if self
                .constant_of(&part, "the first value of a state")
                .is_none()
            {
                return;
            }
            ids.push(self.program.states.push(State {
                name,
                kind: kind.clone(),
                initial,
            }));
        }
        let slot = StateSlot { ty: value.ty, ids };
        self.states.insert(&state.name.name, slot);
    }

    /// `enum name { … }`: names are collected already; an empty one is a mistake.
    pub fn enumeration(&mut self, decl: &'a ast::Enum) {
        if decl.variants.is_empty() {
            self.report(
                Diagnostic::new(
                    Code::E0312,
                    decl.name.span,
                    format!("the enum `{}` has no variants", decl.name.name),
                )
                .label("nothing could be of it"),
            );
        }
    }

    fn variants(&self, name: &str) -> Vec<Name> {
        match self.names.types.get(name) {
            Some(TypeDecl::Enum(decl)) => {
                decl.variants.iter().map(|v| Name::word(&v.name)).collect()
            }
            _ => Vec::new(),
        }
    }

    /// A state variable as it is now.
    pub fn state_value(&mut self, state: &'a ast::State, reference: &'a Ref) -> Typed {
        let span = reference.span;
        if self.context.region == Region::World {
            self.report(
                Diagnostic::new(
                    Code::E0303,
                    span,
                    format!("the state `{}` is no constant", reference.name.name),
                )
                .label("this changes as the program runs"),
            );
            return Typed::error(span);
        }
        if state.params.is_some() {
            let params = state.params.as_ref();
            let bound = self.bind_arguments(params, false, reference, Region::Let);
            if bound.is_none() {
                return Typed::error(span);
            }
            let ty = state
                .ty
                .as_ref()
                .map_or(Type::Error, |ty| self.type_expr(ty));
            return Typed {
                ty,
                value: Value::Unknown,
                span,
            };
        }
        if reference.args.is_some() {
            self.report(
                Diagnostic::new(
                    Code::E0203,
                    reference.name.span,
                    format!("`{}` takes no arguments", reference.name.name),
                )
                .label("this is a state variable"),
            );
            return Typed::error(span);
        }
        let Some(slot) = self.states.get(state.name.name.as_str()).cloned() else {
            return Typed::error(span);
        };
        let pool = &mut self.program.pool;
        let mut leaves = slot.ids.iter().map(|id| pool.leaf(Expr::State(*id)));
        let value = match (leaves.next(), leaves.next()) {
            (Some(x), Some(y)) => Value::Point(x, y),
            (Some(id), None) => Value::Scalar(id),
            _ => Value::Unknown,
        };
        Typed {
            ty: slot.ty,
            value,
            span,
        }
    }

    /// `event name = expr`
    pub fn event(&mut self, event: &'a ast::Event) {
        let scope = self.unknown_parameters(event.params.as_ref());
        let mut when = None;
        self.body_for_itself(&event.name, Region::Event, scope, |checker| {
            let role = format!("the event `{}`", event.name.name);
            when = checker.expect(&event.value, &Type::Bool, &role).scalar();
        });
        if let Some(params) = &event.params {
            self.not_yet(params.span, "families of events");
            return;
        }
        let never = self.program.pool.bool(false);
        let id = self.program.events.push(Event {
            name: Name::word(&event.name.name),
            when: when.unwrap_or(never),
        });
        self.events.insert(&event.name.name, id);
    }

    /// Whether an event happens in this tick.
    pub fn event_value(&mut self, event: &'a ast::Event, reference: &'a Ref) -> Typed {
        let span = reference.span;
        if event.params.is_some() {
            let params = event.params.as_ref();
            let bound = self.bind_arguments(params, false, reference, Region::Let);
            if bound.is_none() {
                return Typed::error(span);
            }
            return Typed {
                ty: Type::Bool,
                value: Value::Unknown,
                span,
            };
        }
        if reference.args.is_some() {
            self.report(
                Diagnostic::new(
                    Code::E0203,
                    reference.name.span,
                    format!("`{}` takes no arguments", reference.name.name),
                )
                .label("this is an event"),
            );
            return Typed::error(span);
        }
        if !self.context.region.sees_events() {
            self.report(
                Diagnostic::new(
                    Code::E0307,
                    span,
                    format!(
                        "the event `{}` cannot be asked in {}",
                        reference.name.name,
                        self.context.region.name()
                    ),
                )
                .label("events are known to events, effects and rewards only")
                .help("remember it in a state: `on EVENT { seen = true }`"),
            );
            return Typed::error(span);
        }
        if self
            .open_bodies
            .iter()
            .any(|open| open.at == event.name.span)
        {
            self.report(
                Diagnostic::new(
                    Code::E0205,
                    span,
                    format!("the event `{}` is defined by itself", reference.name.name),
                )
                .label("an event that waits for itself")
                .also(event.name.span, "its definition starts here"),
            );
            return Typed::error(span);
        }
        match self.events.get(event.name.name.as_str()) {
            Some(id) => self.leaf(Expr::Event(*id), Type::Bool, span),
            None => {
                self.report(
                    Diagnostic::new(
                        Code::E0206,
                        span,
                        format!("the event `{}` is declared later", reference.name.name),
                    )
                    .label("events are evaluated in the order of their declaration")
                    .also(event.name.span, "declared here"),
                );
                Typed::error(span)
            }
        }
    }

    /// `each tick { … }`
    pub fn each_tick(&mut self, block: &'a ast::Block) {
        self.context = Context::new(Region::EachTick);
        if let Some(block) = self.block(block, &Home::Effect) {
            self.program.each_tick.0.extend(block.0);
        }
    }

    /// The family behind `on name(params)`; that families are not built yet is said where it is declared.
    fn family_of_events(&mut self, name: &Ident) {
        let diagnostic = match self.names.value(&name.name, false) {
            Some((Decl::Event(event), _)) if event.params.is_some() => return,
            Some((decl, _)) => {
                let found = match decl {
                    Decl::Event(_) => "a single event",
                    other => other.what(),
                };
                Diagnostic::new(
                    Code::E0203,
                    name.span,
                    format!("`{}` is no family of events", name.name),
                )
                .label(format!("this is {found}"))
            }
            None => {
                let events = self.names.values(|decl| matches!(decl, Decl::Event(_)));
                unknown(name, "event", events)
            }
        };
        self.report(diagnostic);
    }

    /// `on event { … }`
    pub fn on(&mut self, on: &'a ast::On) {
        self.context = Context::new(Region::Event);
        match &on.trigger {
            Trigger::Expr(event) => {
                let when = self.expect(event, &Type::Bool, "what an `on` waits for");
                self.context = Context::new(Region::Effect);
                let block = self.block(&on.block, &Home::Effect);
                if let (Some(on), Some(block)) = (when.scalar(), block) {
                    self.program.effects.push(Effect { on, block });
                }
            }
            Trigger::Family { name, params } => {
                self.family_of_events(name);
                let scope: Vec<Binding> = self.unknown_parameters(Some(params));
                self.context = Context::new(Region::Effect);
                self.context.scope = scope;
                self.block(&on.block, &Home::Effect);
            }
        }
        self.context.scope.clear();
    }
}
