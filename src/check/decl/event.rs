//! Events, and the effects that they have.

use crate::check::Checker;
use crate::check::context::{Binding, Context, Region};
use crate::check::expr::plain_ref;
use crate::check::lint::Mentions;
use crate::check::members::{Member, Robots};
use crate::check::names::Decl;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::ir::expr::ExprId;
use crate::ir::program::{Effect, Event};
use crate::ir::{self, Id};
use crate::source::Span;
use crate::syntax::ast::{self, Arg, ArgKind, Ident, Params, Ref, Trigger};

/// The id of an event.
pub type EventId = Id<Event>;

impl<'a> Checker<'a> {
    /// `event name(params) = expr`
    pub fn event(&mut self, event: &'a ast::Event) {
        let mut scope = self.unknown_parameters(event.params.as_ref());
        if let Some(params) = &event.params {
            self.only_ranging(params, &mut scope);
        }
        let mut when = None;
        let told = self.diagnostics.len();
        self.body_for_itself(&event.name, Region::Event, scope, |checker| {
            when = checker.event_condition(event);
        });
        self.of_another_type(event.params.as_ref(), told);
        let mut members = vec![(Vec::new(), when)];
        if let Some(params) = &event.params {
            let clean = self.bodies.clean.get(&event.name.span) == Some(&true);
            let Some(scopes) = self.combinations(params, Robots::Others).filter(|_| clean) else {
                self.events.insert(&event.name.name, Vec::new());
                return;
            };
            self.context = Context::new(Region::Event);
            members = self.for_each_member(scopes, |checker, scope| {
                (scope.to_vec(), checker.event_condition(event))
            });
        }
        let mut family = Vec::new();
        for (scope, when) in members {
            let never = self.program.pool.bool(false);
            let name = self.member_name(&event.name.name, &scope);
            let when = when.unwrap_or(never);
            let is = self.program.events.push(Event { name, when });
            let codes = self.member_codes(&scope).unwrap_or_default();
            family.push(Member { codes, is });
        }
        self.events.insert(&event.name.name, family);
    }

    /// Of the parameters that a body takes for something else, as it has been told since so many diagnostics, it is not sure what
    /// they are meant to be.
    fn of_another_type(&mut self, params: Option<&Params>, told: usize) {
        let found = self.diagnostics.get(told..).unwrap_or_default().iter();
        let found = found.filter(|found| found.code == Code::E0302);
        let named: Vec<Span> = found
            .filter_map(|found| self.meanings.declaration(found.span()))
            .collect();
        let params = params.iter().flat_map(|params| &params.params);
        let unsure = params.filter(|param| named.contains(&param.name.span));
        self.unsure.extend(unsure.map(|param| param.span));
    }

    fn event_condition(&mut self, event: &'a ast::Event) -> Option<ExprId> {
        let role = format!("the event `{}`", event.name.name);
        let when = self.expect(&event.value, &Type::Bool, &role).scalar();
        self.asks(event.value.span, when);
        when
    }

    /// Whether an event happens in this tick.
    pub fn event_value(&mut self, event: &'a ast::Event, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let name = &reference.name.name;
        let codes = match &event.params {
            Some(params) => {
                let scope = self.bind_arguments(Some(params), false, reference)?;
                self.codes(&scope)
            }
            None if self.gives_arguments(reference, "an event") => return None,
            None => Some(Vec::new()),
        };
        let region = self.context.region;
        if !region.sees_events() {
            return self
                .error(
                    Code::E0307,
                    span,
                    format!("the event `{name}` cannot be asked in {}", region.name()),
                )
                .label(match region {
                    Region::EachTick => "what happens in a tick is found out later in it",
                    _ => "events are known to events, effects and rewards only",
                })
                .help("remember it in a state: `on EVENT { seen = true }`")
                .none();
        }
        if self.bodies.is_open(event.name.span) {
            return self.closes_a_circle(event.name.span, reference);
        }
        match self.events.get(event.name.name.as_str()).cloned() {
            Some(family) => {
                let Some(codes) = codes else {
                    return Some(Typed::unknown(Type::Bool, span));
                };
                let mut happens = Vec::new();
                for Member { codes, is } in family {
                    let is = vec![self.program.pool.leaf(ir::Expr::Event(is))];
                    happens.push(Member { codes, is });
                }
                let none = self.nothing(&Type::Bool, 1);
                let happens = self.member_parts(&codes, &happens, &none);
                Some(Typed::new(Type::Bool, Value::of_parts(&happens), span))
            }
            None => self
                .error(
                    Code::E0206,
                    span,
                    format!("the event `{name}` is declared later"),
                )
                .label("events are evaluated in the order of their declaration")
                .also(event.name.span, "declared here")
                .none(),
        }
    }

    /// `each tick { … }`
    pub fn each_tick(&mut self, block: &'a ast::Block) {
        self.context = Context::new(Region::EachTick);
        if let Some(block) = self.block(block) {
            self.program.each_tick.0.extend(block.0);
        }
    }

    /// `on event { … }`
    pub fn on(&mut self, on: &'a ast::On) {
        self.context = Context::new(Region::Event);
        match &on.trigger {
            Trigger::Expr(event) if self.unbound_members(event, ": ").is_some() => {}
            Trigger::Expr(event) => {
                let scopes = match plain_ref(event) {
                    Some(reference) => self.ranges(reference),
                    None => Some(vec![Vec::new()]),
                };
                self.for_each_member(scopes.unwrap_or_default(), |checker, _| {
                    checker.context.region = Region::Event;
                    let when = checker.waited_for(event);
                    checker.asks(event.span, when.scalar());
                    checker.effect(when.scalar(), &on.block);
                });
            }
            Trigger::Family { name, params } => self.on_family(name, params, &on.block),
        }
        self.context.scope.clear();
    }

    /// The condition of an `on`.
    fn waited_for(&mut self, event: &'a ast::Expr) -> Typed {
        let role = "what an `on` waits for";
        let is_tick =
            plain_ref(event).is_some_and(|it| it.name.name == "tick" && it.args.is_none());
        let typed = self.expr(event);
        if is_tick && typed.ty.dim().is_some() {
            let message = format!("{role} is {}, not {}", Type::Bool, typed.ty);
            return self
                .unlike(&typed, &Type::Bool, message)
                .this_is(&typed.ty)
                .help("what is done in every tick stands in `each tick { … }`")
                .typed();
        }
        self.coerce(typed, event, &Type::Bool, role)
    }

    /// Whether a value reads what a family of events is about, by a name that nothing else has.
    pub fn reads_parameter_of(&self, event: &'a ast::Expr, value: &'a ast::Expr) -> bool {
        let named = plain_ref(event).map(|event| event.name.name.as_str());
        let Some((Decl::Event(family), _)) = named.and_then(|name| self.names.value(name, false))
        else {
            return false;
        };
        let mut read = Mentions::default();
        read.expr(value);
        let mut params = family.params.iter().flat_map(|params| &params.params);
        params.any(|param| {
            let name = param.name.name.as_str();
            read.read.contains(name) && self.may_bind(name)
        })
    }

    /// Whether a name that stands for a member may be meant to bind it: nothing is called so, nor nearly so.
    pub fn may_bind(&self, name: &str) -> bool {
        let members = |decl: Decl<'_>| {
            matches!(
                decl,
                Decl::Place(..) | Decl::Wall(..) | Decl::Robot(_) | Decl::Variant(..)
            )
        };
        self.names.value(name, false).is_none()
            && !self.may_be_lost(name)
            && self.likely(name, self.names.values(members)).is_none()
    }

    /// Reports `on picked` and `on picked(b)` where `picked` is a family and nothing is called `b`: what binds a member
    /// says its type, behind `binds`.
    pub fn unbound_members(&mut self, waited_for: &'a ast::Expr, binds: &str) -> Option<()> {
        let reference = plain_ref(waited_for)?;
        let (Decl::Event(event), _) = self.names.value(&reference.name.name, false)? else {
            return None;
        };
        let params = event.params.as_ref()?;
        self.names_no_member(reference, ("an event", &event.name, params), binds)
    }

    /// Reports the name of a family, which is declared with these parameters, where it has no arguments, or some that nothing is
    /// called: what binds a member says its type, behind `binds`.
    pub fn names_no_member(
        &mut self,
        reference: &'a Ref,
        (what, declared, params): (&str, &Ident, &Params),
        binds: &str,
    ) -> Option<()> {
        let params = &params.params;
        if params.is_empty() {
            return None;
        }
        let args = reference.args.as_deref().unwrap_or_default();
        let unbound = |arg: &Arg| match &arg.kind {
            ArgKind::Positional(value) => {
                let name = plain_ref(value).filter(|name| name.args.is_none());
                name.is_some_and(|name| {
                    let name = name.name.name.as_str();
                    // The name that the family itself binds is no misspelt member, however near one is.
                    let binds = params.iter().any(|param| param.name.name == name);
                    let binds = binds && self.names.value(name, false).is_none();
                    binds || self.names.types.contains_key(name) || self.may_bind(name)
                })
            }
            _ => false,
        };
        let given: Vec<&str> = args
            .iter()
            .filter(|arg| unbound(arg))
            .filter_map(|arg| match &arg.kind {
                ArgKind::Positional(value) => Some(plain_ref(value)?.name.name.as_str()),
                _ => None,
            })
            .collect();
        if given.len() != args.len() || !args.is_empty() && args.len() != params.len() {
            return None;
        }
        let typed = params.iter().enumerate().map(|(at, param)| {
            // Who names the kind alone has not said what a member is called.
            let given = given.get(at).copied();
            let given = given.filter(|name| !self.names.types.contains_key(name));
            let name = given.unwrap_or(&param.name.name);
            let factors = param.ty.factors.iter().map(|(name, _)| name.name.as_str());
            format!("{name}{binds}{}", factors.collect::<String>())
        });
        let name = &reference.name.name;
        let right = format!("{name}({})", typed.collect::<Vec<_>>().join(", "));
        let message = format!("`{name}` is {what} for each member of a kind");
        self.error(Code::E0128, reference.span, message)
            .label("nothing says which of them is meant")
            .also(declared.span, "the family is declared here")
            .fix(
                format!("write `{right}`"),
                reference.span,
                right,
                Applicability::Unsafe,
            );
        Some(())
    }

    /// What is done where a condition holds, in the scope at hand.
    fn effect(&mut self, on: Option<ExprId>, block: &'a ast::Block) {
        self.context.region = Region::Effect;
        self.assignments.clear();
        let (Some(done), Some(on)) = (self.block(block), on) else {
            return;
        };
        self.done_by_effect(&block.stmts);
        self.program.effects.push(Effect { on, block: done });
    }

    /// `on name(params) { … }`: for each member, with the parameters bound to what the event is about.
    fn on_family(&mut self, name: &'a Ident, params: &'a Params, block: &'a ast::Block) {
        let event = self.family_of_events(name);
        let mut scope = self.unknown_parameters(Some(params));
        for param in &params.params {
            self.needs(param.name.span);
        }
        let fits = event.is_some_and(|event| self.binds_as_declared(event, params, &mut scope));
        // Once for itself, so that a mistake is told once.
        self.context = Context::new(Region::Effect);
        self.context.scope = scope;
        let (_, found) = self.captured(|checker| checker.block(block));
        self.context.scope.clear();
        let wrong = found.iter().any(Diagnostic::is_error);
        self.diagnostics.extend(found);
        if wrong || !fits {
            return;
        }
        let Some(scopes) = self.combinations(params, Robots::Others) else {
            return;
        };
        let family = self.events.get(name.name.as_str()).cloned();
        let family = family.unwrap_or_default();
        self.for_each_member(scopes, |checker, scope| {
            let codes = checker.member_codes(scope)?;
            let member = family.iter().find(|member| member.codes == codes)?;
            let on = checker.program.pool.leaf(ir::Expr::Event(member.is));
            checker.effect(Some(on), block);
            Some(())
        });
    }

    /// Whether what an `on` binds agrees with the parameters of its family; reported if not.
    fn binds_as_declared(
        &mut self,
        event: &'a ast::Event,
        params: &'a Params,
        bound: &mut [Binding<'a>],
    ) -> bool {
        let declared = event.params.as_ref().map_or(&[][..], |p| &p.params);
        let name = &event.name.name;
        if declared.len() != params.params.len() {
            let message = format!(
                "`{name}` has {} parameters, not {}",
                declared.len(),
                params.params.len()
            );
            self.error(Code::E0305, params.span, message)
                .label("each of them is bound to what the event is about")
                .also(event.name.span, "the family is declared here");
            return false;
        }
        let mut fits = true;
        for ((declared, param), bound) in declared.iter().zip(&params.params).zip(bound) {
            if self.unsure.contains(&declared.span) {
                bound.ty = Type::Error;
                fits = false;
                continue;
            }
            let wanted = self.type_expr(&declared.ty);
            if !bound.ty.fits(&wanted) {
                let message = format!("`{}` of `{name}` is {wanted}", declared.name.name);
                self.error(Code::E0302, param.ty.span, message)
                    .this_is(&bound.ty)
                    .also(declared.span, "declared here");
                bound.ty = Type::Error;
                fits = false;
            }
        }
        fits
    }

    /// The family behind `on name(params)`; reported if there is none.
    fn family_of_events(&mut self, name: &Ident) -> Option<&'a ast::Event> {
        let found = match self.value_of(name) {
            Some((Decl::Event(event), _)) if event.params.is_some() => return Some(event),
            // What its body lacks is told there.
            Some((Decl::Event(_), _)) if self.names.lacking.contains(&name.name) => return None,
            Some((Decl::Event(_), _)) => "a single event",
            Some((decl, _)) => decl.what(),
            None => {
                return self
                    .undeclared_value(name, "event", |decl| matches!(decl, Decl::Event(_)))
                    .none();
            }
        };
        self.error(
            Code::E0203,
            name.span,
            format!("`{}` is not a family of events", name.name),
        )
        .this_is(found)
        .none()
    }
}
