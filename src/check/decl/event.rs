//! Events, and the effects that they have.

use crate::check::Checker;
use crate::check::context::{Context, Region};
use crate::check::names::Decl;
use crate::check::types::{Type, Typed};
use crate::diagnostic::Code;
use crate::ir::expr::Expr;
use crate::ir::program::{Effect, Event};
use crate::ir::{Id, Name};
use crate::syntax::ast::{self, Ident, Ref, Trigger};

/// The id of an event.
pub type EventId = Id<Event>;

impl<'a> Checker<'a> {
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
    pub fn event_value(&mut self, event: &'a ast::Event, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let name = &reference.name.name;
        if let Some(params) = &event.params {
            self.bind_arguments(Some(params), false, reference)?;
            return Some(Typed::unknown(Type::Bool, span));
        }
        if self.gives_arguments(reference, "an event") {
            return None;
        }
        let region = self.context.region;
        if !region.sees_events() {
            return self
                .error(
                    Code::E0307,
                    span,
                    format!("the event `{name}` cannot be asked in {}", region.name()),
                )
                .label("events are known to events, effects and rewards only")
                .help("remember it in a state: `on EVENT { seen = true }`")
                .none();
        }
        if self.bodies.is_open(event.name.span) {
            return self
                .error(
                    Code::E0205,
                    span,
                    format!("the event `{name}` is defined by itself"),
                )
                .label("an event that waits for itself")
                .also(event.name.span, "its definition starts here")
                .none();
        }
        match self.events.get(event.name.name.as_str()) {
            Some(id) => Some(self.leaf(Expr::Event(*id), Type::Bool, span)),
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
            Trigger::Expr(event) => {
                let when = self.expect(event, &Type::Bool, "what an `on` waits for");
                self.context = Context::new(Region::Effect);
                let block = self.block(&on.block);
                if let (Some(on), Some(block)) = (when.scalar(), block) {
                    self.program.effects.push(Effect { on, block });
                }
            }
            Trigger::Family { name, params } => {
                self.family_of_events(name);
                let scope = self.unknown_parameters(Some(params));
                self.context = Context::new(Region::Effect);
                self.context.scope = scope;
                self.block(&on.block);
            }
        }
        self.context.scope.clear();
    }

    /// The family behind `on name(params)`; that families are not built yet is reported where it is declared.
    fn family_of_events(&mut self, name: &Ident) {
        let found = match self.names.value(&name.name, false) {
            Some((Decl::Event(event), _)) if event.params.is_some() => return,
            Some((Decl::Event(_), _)) => "a single event",
            Some((decl, _)) => decl.what(),
            None => {
                self.undeclared_value(name, "event", |decl| matches!(decl, Decl::Event(_)));
                return;
            }
        };
        self.error(
            Code::E0203,
            name.span,
            format!("`{}` is not a family of events", name.name),
        )
        .this_is(found);
    }
}
