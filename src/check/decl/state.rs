//! State variables and enums.

use crate::check::Checker;
use crate::check::context::{Binding, Context, Region};
use crate::check::members::{Member, Robots};
use crate::check::names::TypeDecl;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Expr, ExprId};
use crate::ir::name::Coordinate;
use crate::ir::program::{State, Stays, ValueKind};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, Ref};

/// A type, and the variables of this type that a reference may mean, each with the condition that it does.
type Meant = (Type, Vec<(ExprId, Vec<Id<State>>)>);

/// The variables behind a declared state: of each member of a family, one, or two for a point. A single state is a family
/// of one.
#[derive(Clone, Debug)]
pub struct StateSlot {
    /// The declared type.
    pub ty: Type,
    /// The variables.
    members: Vec<Member<Vec<Id<State>>>>,
}

impl<'a> Checker<'a> {
    /// `state name(params): type = constant`
    pub fn state(&mut self, state: &'a ast::State) {
        self.context = Context::new(Region::World);
        let Some(params) = &state.params else {
            if let Some((ty, ids)) = self.state_member(state, &[]) {
                let member = Member {
                    codes: Vec::new(),
                    is: ids,
                };
                let members = vec![member];
                self.is_of_type(&state.name, &ty);
                let slot = StateSlot { ty, members };
                self.states.insert(&state.name.name, slot);
            }
            return;
        };
        // Once for itself, so that a mistake is told once.
        let mut scope = self.unknown_parameters(Some(params));
        self.only_ranging(params, &mut scope);
        self.context.scope = scope;
        for param in &params.params {
            self.reads(param.name.span);
        }
        let (_, found) = self.captured(|checker| {
            checker.declared(state.ty.as_ref(), &state.value, &state.name.name)
        });
        self.context.scope.clear();
        let wrong = found.iter().any(Diagnostic::is_error);
        self.diagnostics.extend(found);
        let Some(members) = self.combinations(params, Robots::All).filter(|_| !wrong) else {
            // What is done with it has mistakes of its own to tell.
            if let Some(written) = &state.ty {
                let (ty, members) = (self.type_expr(written), Vec::new());
                let slot = StateSlot { ty, members };
                self.states.insert(&state.name.name, slot);
            }
            return;
        };
        let members = self.for_each_member(members, |checker, scope| {
            let codes = checker.member_codes(scope)?;
            let (ty, is) = checker.state_member(state, scope)?;
            Some((ty, Member { codes, is }))
        });
        let Some(members) = members.into_iter().collect::<Option<Vec<_>>>() else {
            return;
        };
        let (types, members): (Vec<Type>, Vec<_>) = members.into_iter().unzip();
        let ty = match (types.first(), &state.ty) {
            (Some(ty), _) => ty.clone(),
            (None, Some(written)) => self.type_expr(written),
            (None, None) => return,
        };
        self.is_of_type(&state.name, &ty);
        let slot = StateSlot { ty, members };
        self.states.insert(&state.name.name, slot);
    }

    /// The variables of one member of a family of states, its parameters bound in `scope`.
    fn state_member(
        &mut self,
        state: &'a ast::State,
        scope: &[Binding<'a>],
    ) -> Option<(Type, Vec<Id<State>>)> {
        let value = self.declared(state.ty.as_ref(), &state.value, &state.name.name);
        let kind = match &value.ty {
            Type::Error => return None,
            Type::Bool => ValueKind::Bool,
            Type::Enum(name) => ValueKind::Enum(self.variants(name)),
            Type::Point | Type::Quantity(_) | Type::Ratio => ValueKind::Quantity,
            ty if ty.is_named_target() => ValueKind::Enum(self.target_names(ty)),
            other => {
                return self
                    .error(
                        Code::E0302,
                        value.span,
                        format!("a state cannot hold {other}"),
                    )
                    .label("numbers, truth values, points, enums, places, walls and robots can be held")
                    .none();
            }
        };
        if value.value == Value::Unknown {
            return None;
        }
        let name = self.member_name(&state.name.name, scope);
        let parts = match value.value {
            Value::Scalar(id) => vec![(name, id)],
            Value::Point(x, y) => vec![
                (name.coordinate(Coordinate::X), x),
                (name.coordinate(Coordinate::Y), y),
            ],
            ref target => vec![(name, self.code(target)?)],
        };
        let mut ids = Vec::new();
        for (name, initial) in parts {
            let role = "the first value of a state";
            self.constant_part(initial, value.span, role)?;
            ids.push(self.program.states.push(State {
                name,
                kind: kind.clone(),
                initial,
                stays: Stays::ANY,
            }));
        }
        Some((value.ty, ids))
    }

    /// `enum name { … }`: names are collected already; an empty one is a mistake.
    pub fn enumeration(&mut self, decl: &'a ast::Enum) {
        if decl.variants.is_empty() {
            // What is not declared may be one of them.
            self.names.lost_values = true;
            self.error(
                Code::E0312,
                decl.name.span,
                format!("the enum `{}` has no variants", decl.name.name),
            )
            .label("no value could be of this type")
            .help(format!(
                "name them: `enum {} {{ a, b, c }}`",
                decl.name.name
            ));
        }
    }

    /// The variants of the enum of that name.
    pub fn variants(&self, name: &str) -> Vec<Name> {
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
        let (slot, codes) = self.state_slot(state, reference)?;
        let Some(codes) = codes else {
            return Some(Typed::unknown(slot.ty, span));
        };
        // Its kind has no members that are known: what was not understood is told.
        if slot.members.is_empty() && state.params.is_some() {
            return Some(Typed::unknown(slot.ty, span));
        }
        let count = slot.members.first().map_or(1, |member| member.is.len());
        let none = self.nothing(&slot.ty, count);
        let leaf = |checker: &mut Self, ids: &[Id<State>]| {
            let pool = &mut checker.program.pool;
            let leaves = ids.iter().map(|id| pool.leaf(Expr::State(*id)));
            leaves.collect::<Vec<_>>()
        };
        let members: Vec<_> = slot
            .members
            .into_iter()
            .map(|member| Member {
                is: leaf(self, &member.is),
                codes: member.codes,
            })
            .collect();
        let parts = self.member_parts(&codes, &members, &none);
        let value = self.held(&slot.ty, &parts);
        Some(Typed::new(slot.ty, value, span))
    }

    /// The variables behind a state with the codes of the arguments that a reference gives; no codes where an argument is
    /// known by its type only.
    fn state_slot(
        &mut self,
        state: &'a ast::State,
        reference: &'a Ref,
    ) -> Option<(StateSlot, Option<Vec<ExprId>>)> {
        let codes = match &state.params {
            Some(params) => {
                let scope = self.bind_arguments(Some(params), false, reference)?;
                self.codes(&scope)
            }
            None if self.gives_arguments(reference, "a state variable") => return None,
            None => Some(Vec::new()),
        };
        let slot = self.states.get(state.name.name.as_str())?.clone();
        Some((slot, codes))
    }

    /// The type of a state, and the variables that a reference may mean, each with the condition that it does; no
    /// variables where an argument is known by its type only.
    pub fn state_variables(&mut self, state: &'a ast::State, reference: &'a Ref) -> Option<Meant> {
        let (slot, codes) = self.state_slot(state, reference)?;
        let Some(codes) = codes else {
            return Some((slot.ty, Vec::new()));
        };
        let mut variables = Vec::new();
        for member in slot.members {
            let is = self.is_member(&codes, &member.codes);
            if self.program.pool.constant(is) != Some(0.0) {
                variables.push((is, member.is));
            }
        }
        Some((slot.ty, variables))
    }
}
