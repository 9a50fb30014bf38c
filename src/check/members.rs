//! Members of types: what families, loops and binders range over, and targets that are chosen while the program runs.
//!
//! A program has finitely many places, walls, robots and variants, so all that ranges over them is written out when it is
//! checked. Where it is known only at run time which member is meant, its *code* says so: a number of its own for each.

use super::Checker;
use super::builtin::Function;
use super::context::Binding;
use super::types::{Type, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, ExprId};
use crate::ir::name::{Argument, Given};
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{ArgKind, Ident, Params, Ref};
use std::collections::BTreeSet;

/// The places and walls of the world in the order of their declaration, each with its kind.
#[derive(Clone, Debug, Default)]
pub struct Kinds {
    /// The places.
    pub places: Vec<(Name, Option<String>)>,
    /// The walls.
    pub walls: Vec<(Name, Option<String>)>,
    /// Those of them whose shapes were not understood: they are members of their kinds, and nothing more is known of them.
    pub unknown: BTreeSet<Name>,
}

/// The most members that a family may have.
const MOST: usize = 10_000;

/// The code of `nowhere`.
const NOWHERE: f64 = -1.0;

/// The code of the nearest wall, beyond those of all walls.
const NEAREST_WALL: f64 = 1e9;

/// Which robots a parameter of a family stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Robots {
    /// All but the one that reads: a robot is never its own target.
    Others,
    /// It, too.
    All,
}

/// One of a family, with the codes of its arguments.
#[derive(Clone, Debug)]
pub struct Member<T> {
    /// The codes of its arguments.
    pub codes: Vec<f64>,
    /// What it is.
    pub is: T,
}

/// The code of a target.
fn code(target: &Value) -> Option<f64> {
    match target {
        Value::Place(id) => Some(id.index() as f64),
        Value::Wall(id) => Some(id.index() as f64),
        Value::Sensor(id) => Some(id.index() as f64),
        Value::Robot(id) => Some(id.index() as f64),
        Value::NearestWall => Some(NEAREST_WALL),
        Value::Nowhere => Some(NOWHERE),
        _ => None,
    }
}

impl<'a> Checker<'a> {
    /// The members of a type, in the order of their declaration; `None` if it has none that can be listed.
    pub fn members(&mut self, ty: &Type) -> Option<Vec<Value>> {
        match ty {
            Type::Bool => {
                let both = [false, true].map(|value| self.program.pool.bool(value));
                Some(both.map(Value::Scalar).to_vec())
            }
            Type::Enum(name) => {
                let count = self.variants(name).len();
                let variants = (0..count).map(|i| self.program.pool.num(i as f64));
                Some(variants.map(Value::Scalar).collect())
            }
            Type::Place(kind) => {
                let of_kind = |(name, of): &(Name, Option<String>)| {
                    (kind.is_none() || of == kind).then(|| name.clone())
                };
                let world = self.program.world.as_ref()?;
                let names = self.kinds.places.iter().filter_map(of_kind);
                let ids = names.filter_map(|name| world.places.named(&name));
                Some(ids.map(Value::Place).collect())
            }
            Type::Wall(kind) => {
                let of_kind = |(name, of): &(Name, Option<String>)| {
                    (kind.is_none() || of == kind).then(|| name.clone())
                };
                let world = self.program.world.as_ref()?;
                let names = self.kinds.walls.iter().filter_map(of_kind);
                let ids = names.filter_map(|name| world.walls.named(&name));
                Some(ids.map(Value::Wall).collect())
            }
            Type::Sensor => {
                let sensors = &self.subject_robot()?.sensors;
                Some(sensors.ids().map(Value::Sensor).collect())
            }
            // The others: a robot is never its own target.
            Type::Robot => {
                let count = self.program.world.as_ref()?.others.len() + 1;
                let all = (0..count).map(Id::new);
                let others = all.filter(|id| *id != self.subject);
                Some(others.map(Value::Robot).collect())
            }
            _ => None,
        }
    }

    /// The members of the type that is written at `span`; one that has none is reported.
    pub fn members_of(&mut self, ty: &Type, span: Span, called: &str) -> Option<Vec<Value>> {
        if *ty == Type::Error {
            return None;
        }
        let members = self.members(ty);
        let of_a_world = matches!(
            ty,
            Type::Place(_) | Type::Wall(_) | Type::Robot | Type::Sensor
        );
        if of_a_world && self.program.world.is_none() {
            let what = format!("what ranges over `{called}`");
            return self
                .no_world(span, &what, "there is no world to have any")
                .none();
        }
        if members.is_none() {
            self.error(
                Code::E0302,
                span,
                format!("`{called}` has no members to range over"),
            )
            .label("a kind of places or walls, `robot`, or an enum is needed");
        }
        members
    }

    /// The robot that reads what is at hand.
    pub fn subject_robot(&self) -> Option<&Robot> {
        let world = self.program.world.as_ref()?;
        Some(world.robot_of(self.subject))
    }

    /// Runs a pass for another robot.
    pub fn as_robot<T>(&mut self, robot: Id<Robot>, pass: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.subject, robot);
        let result = pass(self);
        self.subject = outer;
        result
    }

    /// The name of what belongs to the robot at hand: that of another robot says so.
    pub fn owned(&self, name: Name) -> Name {
        match self.subject_robot() {
            Some(robot) if self.subject != World::acting() => name.of_robot(&robot.name),
            _ => name,
        }
    }

    /// The number that says at run time which member or variant a value is.
    pub fn code(&mut self, value: &Value) -> Option<ExprId> {
        match value {
            Value::Scalar(id) | Value::Chosen(id, _) => Some(*id),
            target => code(target).map(|code| self.program.pool.num(code)),
        }
    }

    /// The numbers that hold a value while the program runs: a target is held by its code.
    pub fn held_parts(&mut self, value: &Value) -> Vec<ExprId> {
        match value.parts() {
            parts if parts.is_empty() => self.code(value).into_iter().collect(),
            parts => parts,
        }
    }

    /// The target of a type that these numbers hold; a number, a truth value or a point as they are.
    pub fn held(&mut self, ty: &Type, parts: &[ExprId]) -> Value {
        match (ty.is_named_target(), parts) {
            (true, &[code]) => {
                let mut of = self.members(ty).unwrap_or_default();
                if *ty == Type::Wall(None) {
                    of.push(Value::NearestWall);
                }
                of.push(Value::Nowhere);
                Value::Chosen(code, of)
            }
            _ => Value::of_parts(parts),
        }
    }

    /// One of two targets, whichever the condition says.
    pub fn either(&mut self, condition: ExprId, then: &Value, otherwise: &Value) -> Option<Value> {
        if let Some(holds) = self.program.pool.constant(condition) {
            return Some(if holds != 0.0 { then } else { otherwise }.clone());
        }
        if then == otherwise {
            return Some(then.clone());
        }
        let (a, b) = (self.code(then)?, self.code(otherwise)?);
        let mut of: Vec<Value> = Vec::new();
        for side in [then, otherwise] {
            let these = match side {
                Value::Chosen(_, these) => these.as_slice(),
                one => std::slice::from_ref(one),
            };
            for one in these {
                if !of.contains(one) {
                    of.push(one.clone());
                }
            }
        }
        // The last one is what is left where no code fits.
        of.sort_by_key(|one| *one == Value::Nowhere);
        Some(Value::Chosen(self.program.pool.select(condition, a, b), of))
    }

    /// What is read of a target, whichever of those that it may be it is.
    pub fn of_each(
        &mut self,
        target: &Value,
        read: &mut impl FnMut(&mut Self, &Value) -> Option<ExprId>,
    ) -> Option<ExprId> {
        let Value::Chosen(which, of) = target else {
            return read(self, target);
        };
        let mut result = None;
        for one in of.iter().rev() {
            let value = read(self, one)?;
            result = Some(match result {
                None => value,
                Some(rest) => {
                    let is = self.is_code(*which, code(one)?);
                    self.program.pool.select(is, value, rest)
                }
            });
        }
        result
    }

    fn is_code(&mut self, which: ExprId, code: f64) -> ExprId {
        let code = self.program.pool.num(code);
        self.program.pool.binary(Binary::Eq, which, code)
    }

    /// The codes of arguments; `None` if one is known by its type only.
    pub fn codes(&mut self, scope: &[Binding<'a>]) -> Option<Vec<ExprId>> {
        scope
            .iter()
            .map(|binding| self.code(&binding.value))
            .collect()
    }

    /// Whether a member of a family is the one that these codes mean.
    pub fn is_member(&mut self, codes: &[ExprId], member: &[f64]) -> ExprId {
        let mut is = self.program.pool.bool(true);
        for (&which, &code) in codes.iter().zip(member) {
            let same = self.is_code(which, code);
            is = self.program.pool.and(is, same);
        }
        is
    }

    /// The numbers of the member of a family that these codes mean; zeros for what is nowhere.
    pub fn member_parts(
        &mut self,
        codes: &[ExprId],
        members: &[Member<Vec<ExprId>>],
        none: &[ExprId],
    ) -> Vec<ExprId> {
        let mut result = none.to_vec();
        for member in members.iter().rev() {
            let is = self.is_member(codes, &member.codes);
            for (result, part) in result.iter_mut().zip(&member.is) {
                *result = self.program.pool.select(is, *part, *result);
            }
        }
        result
    }

    /// Every way to give parameters members of their types; what has none is reported.
    pub fn combinations(
        &mut self,
        params: &'a Params,
        robots: Robots,
    ) -> Option<Vec<Vec<Binding<'a>>>> {
        let mut ranges = Vec::new();
        for param in &params.params {
            if self.unsure.contains(&param.span) {
                return None;
            }
            let ty = self.type_expr(&param.ty);
            let words = param.ty.factors.iter().map(|(name, _)| name.name.as_str());
            let called = words.collect::<Vec<_>>().join("/");
            let mut members = self.members_of(&ty, param.ty.span, &called)?;
            if ty == Type::Robot && robots == Robots::All {
                members.insert(0, Value::Robot(self.subject));
            }
            ranges.push((&param.name, ty, members));
        }
        self.products(ranges, params.span)
    }

    /// Reports the parameters of a family whose type has no members; what they stand for is not known.
    pub fn only_ranging(&mut self, params: &'a Params, scope: &mut [Binding<'a>]) {
        for (param, bound) in params.params.iter().zip(scope) {
            let words = param.ty.factors.iter().map(|(name, _)| name.name.as_str());
            let called = words.collect::<Vec<_>>().join("/");
            if self.members_of(&bound.ty, param.ty.span, &called).is_none() {
                bound.ty = Type::Error;
                self.unsure.push(param.span);
            }
        }
    }

    fn products(
        &mut self,
        ranges: Vec<(&'a Ident, Type, Vec<Value>)>,
        span: Span,
    ) -> Option<Vec<Vec<Binding<'a>>>> {
        let mut all = vec![Vec::new()];
        for (name, ty, members) in ranges {
            if all.len().saturating_mul(members.len()) > MOST {
                self.too_much(span, "these have too many members");
                return None;
            }
            let with = |scope: Vec<Binding<'a>>| {
                let one = |member: &Value| {
                    let mut scope = scope.clone();
                    scope.push(Binding::new(name, ty.clone(), member.clone()));
                    scope
                };
                members.iter().map(one).collect::<Vec<_>>()
            };
            all = all.into_iter().flat_map(with).collect();
        }
        Some(all)
    }

    /// The constant codes of members that a scope binds.
    pub fn member_codes(&mut self, scope: &[Binding<'a>]) -> Option<Vec<f64>> {
        let codes = self.codes(scope)?;
        let pool = &self.program.pool;
        codes.into_iter().map(|code| pool.constant(code)).collect()
    }

    /// The name of the member of a family whose parameters a scope binds.
    pub fn member_name(&self, family: &str, scope: &[Binding]) -> Name {
        let arguments = scope.iter().map(|binding| Argument {
            parameter: binding.name.name.clone(),
            value: self.given_member(&binding.ty, &binding.value),
        });
        Name::instance(family, arguments.collect())
    }

    /// The name of a target or a variant.
    pub fn name_of(&self, ty: &Type, value: &Value) -> Option<Name> {
        let world = self.program.world.as_ref();
        match (value, ty) {
            (Value::Place(id), _) => Some(world?.places[*id].name.clone()),
            (Value::Wall(id), _) => Some(world?.walls[*id].name.clone()),
            (Value::Sensor(id), _) => Some(self.subject_robot()?.sensors[*id].name.clone()),
            (Value::Robot(id), _) => Some(world?.robot_of(*id).name.clone()),
            (Value::Behavior(id), _) => Some(self.program.behaviors[*id].name.clone()),
            (Value::Scalar(id), Type::Enum(name)) => {
                let index = self.program.pool.constant(*id)?;
                self.variants(name).into_iter().nth(index as usize)
            }
            _ => None,
        }
    }

    /// A member as an argument in a name.
    pub fn given_member(&self, ty: &Type, value: &Value) -> Option<Given> {
        match (value, ty) {
            (Value::Scalar(id), Type::Bool) => {
                let holds = self.program.pool.constant(*id)? != 0.0;
                Some(Given::Text(holds.to_string()))
            }
            _ => self.name_of(ty, value).map(Given::Name),
        }
    }

    /// The names of all targets of a type, by their codes.
    pub fn target_names(&self, ty: &Type) -> Vec<Name> {
        let Some(world) = &self.program.world else {
            return Vec::new();
        };
        match ty {
            Type::Place(_) => world.places.values().map(|it| it.name.clone()).collect(),
            Type::Wall(_) => world.walls.values().map(|it| it.name.clone()).collect(),
            Type::Robot => world.robots().map(|it| it.name.clone()).collect(),
            _ => Vec::new(),
        }
    }

    /// Runs a pass under each of these bindings. A mistake that several members make is reported once.
    pub fn for_each_member<T>(
        &mut self,
        members: Vec<Vec<Binding<'a>>>,
        mut pass: impl FnMut(&mut Self, &[Binding<'a>]) -> T,
    ) -> Vec<T> {
        let mut results = Vec::new();
        for bindings in members {
            let depth = self.context.scope.len();
            self.context.scope.extend(bindings.iter().cloned());
            let (result, found) = self.captured(|checker| pass(checker, &bindings));
            self.context.scope.truncate(depth);
            results.push(result);
            for new in found {
                let same = |old: &Diagnostic| (old.code, old.span()) == (new.code, new.span());
                if !self.diagnostics.iter().any(same) {
                    self.diagnostics.push(new);
                }
            }
        }
        results
    }

    /// Every way to bind the names that range over something in a call: `due(r in room)`. A call without such names is
    /// one way, with nothing bound.
    pub fn ranges(&mut self, reference: &'a Ref) -> Option<Vec<Vec<Binding<'a>>>> {
        if !Self::ranging(reference) {
            return Some(vec![Vec::new()]);
        }
        let mut ranges = Vec::new();
        for arg in reference.args.iter().flatten() {
            let ArgKind::Binder {
                name, domain, body, ..
            } = &arg.kind
            else {
                continue;
            };
            if let Some(body) = body {
                self.error(
                    Code::E0305,
                    body.span,
                    "a call of a family ranges over all members",
                )
                .label("a condition on them has no place here")
                .help("ask it in the family itself");
                return None;
            }
            let ty = self.named_type(domain);
            self.binds_member(name, &ty);
            let members = self.members_of(&ty, domain.span, &domain.name)?;
            ranges.push((name, ty, members));
        }
        self.products(ranges, reference.span)
    }

    /// Whether a name of a call is bound to one member after the other.
    pub fn is_ranging(&self, name: &Ident) -> bool {
        let bound = self.context.lookup(&name.name);
        bound.is_some_and(|bound| bound.name.span == name.span)
    }

    /// Whether an expression is a call of a family in which names range over members; `any` and its relatives are none.
    pub fn ranging(reference: &Ref) -> bool {
        let function = Function::named(&reference.name.name);
        if let Some(Function::Any | Function::All | Function::Count | Function::Nearest) = function
        {
            return false;
        }
        let args = reference.args.iter().flatten();
        args.into_iter()
            .any(|arg| matches!(arg.kind, ArgKind::Binder { .. }))
    }

    /// A value of a type that stands for nothing: of what is nowhere.
    pub fn nothing(&mut self, ty: &Type, count: usize) -> Vec<ExprId> {
        let zero = match ty {
            Type::Bool => self.program.pool.bool(false),
            ty if ty.is_named_target() => self.program.pool.num(NOWHERE),
            _ => self.program.pool.num(0.0),
        };
        vec![zero; count]
    }
}
