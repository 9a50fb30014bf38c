//! State variables and enums.

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::names::TypeDecl;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::Code;
use crate::ir::expr::Expr;
use crate::ir::name::Coordinate;
use crate::ir::program::{State, ValueKind};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, Ref};

/// The variables behind a declared state: one, or two for a point.
#[derive(Clone, Debug)]
pub struct StateSlot {
    /// The declared type.
    ty: Type,
    /// The variables.
    ids: Vec<Id<State>>,
}

impl<'a> Checker<'a> {
    /// `state name: type = constant`
    pub fn state(&mut self, state: &'a ast::State) {
        self.context = Context::new(Region::World);
        self.context.scope = self.unknown_parameters(state.params.as_ref());
        let value = self.declared(state.ty.as_ref(), &state.value, &state.name.name);
        self.context.scope.clear();
        if let Some(params) = &state.params {
            self.not_yet(params.span, "families of state variables");
            return;
        }
        let kind = match &value.ty {
            Type::Error => return,
            Type::Bool => ValueKind::Bool,
            Type::Enum(name) => ValueKind::Enum(self.variants(name)),
            Type::Point | Type::Quantity(_) | Type::Ratio => ValueKind::Quantity,
            other => {
                self.error(
                    Code::E0302,
                    value.span,
                    format!("a state cannot hold {other}"),
                )
                .label("numbers, truth values, points and enums can be held");
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
            let role = "the first value of a state";
            if self.constant_part(initial, value.span, role).is_none() {
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
            self.error(
                Code::E0312,
                decl.name.span,
                format!("the enum `{}` has no variants", decl.name.name),
            )
            .label("no value could be of this type");
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

    /// The current value of a state variable.
    pub fn state_value(&mut self, state: &'a ast::State, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        if self.context.region == Region::World {
            return self
                .error(
                    Code::E0303,
                    span,
                    format!("the state `{}` is not a constant", reference.name.name),
                )
                .label("this changes as the program runs")
                .none();
        }
        if let Some(params) = &state.params {
            self.bind_arguments(Some(params), false, reference)?;
            let ty = state.ty.as_ref();
            let ty = ty.map_or(Type::Error, |ty| self.type_expr(ty));
            return Some(Typed::unknown(ty, span));
        }
        if self.gives_arguments(reference, "a state variable") {
            return None;
        }
        let slot = self.states.get(state.name.name.as_str())?;
        let pool = &mut self.program.pool;
        let leaves: Vec<_> = slot
            .ids
            .iter()
            .map(|id| pool.leaf(Expr::State(*id)))
            .collect();
        Some(Typed::new(slot.ty.clone(), Value::of_parts(&leaves), span))
    }

    /// The variables behind the state of that name.
    pub fn state_variables(&self, name: &str) -> Vec<Id<State>> {
        self.states
            .get(name)
            .map_or_else(Vec::new, |slot| slot.ids.clone())
    }
}
