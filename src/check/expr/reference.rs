//! References: names and calls.

use crate::check::Checker;
use crate::check::builtin;
use crate::check::context::Region;
use crate::check::expr::plain_ref;
use crate::check::names::{Decl, is_built_in};
use crate::check::report::{LISTED, listed};
use crate::check::task::history::NO_END;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Applicability, Code, suggest};
use crate::ir::expr::Expr;
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{Arg, ArgKind, Ident, Ref};
use crate::syntax::words::UNITS;

/// How many places a world has at most where one is looked for to name it.
const LOOKED_AT: usize = 100;

impl<'a> Checker<'a> {
    /// A name, or a call.
    pub fn reference(&mut self, reference: &'a Ref) -> Option<Typed> {
        // What an argument is to be, its parameter says.
        let wanted = self.wanted.take();
        let name = reference.name.name.as_str();
        let span = reference.span;
        if reference.args.is_none() {
            if let Some((Decl::Input(input), _)) = self.names.value(name, self.context.library)
                && self.context.lookup(name).is_none()
            {
                return self.input_value(input, reference);
            }
            if let Some(binding) = self.context.lookup(name).cloned() {
                self.reads(binding.name.span);
                self.stands_for(&reference.name, binding.name.span);
                self.is_of_type(binding.name, &binding.ty);
                return Some(Typed::new(binding.ty, binding.value, span));
            }
            // It was declared again, which is told there.
            if self.names.is_lost(name) && is_built_in(name) {
                return None;
            }
            if let Some(value) = builtin::Constant::named(name) {
                self.is_built_in(&reference.name);
                return self.built_in_value(value, span);
            }
        }
        let own = self.names.value(name, self.context.library).is_some();
        let given = reference.args.as_ref().is_some_and(|args| !args.is_empty());
        if name == builtin::Constant::Heading.name() && given && !own && self.has_world {
            self.is_built_in(&reference.name);
            return self.heading_of(reference);
        }
        if let Some(args) = &reference.args
            && builtin::Constant::named(name).is_some()
            && !own
        {
            for arg in args {
                self.stray_argument(arg);
            }
            let draft = self
                .error(
                    Code::E0203,
                    reference.name.span,
                    format!("`{name}` takes no arguments"),
                )
                .label("this is built in, and a value of the moment");
            let place = reference.name.span.after().to(span.after());
            return match args.is_empty() {
                true => draft.fix("drop the parentheses", place, "", Applicability::Safe),
                false if name == "touching" => {
                    let help = "it says whether the robot touches anything; how near something is: `distance(…) < 50 cm`";
                    draft.help(help)
                }
                false if name == "position" => {
                    let title = "if it is of a robot, write `pose`";
                    draft.fix(title, reference.name.span, "pose", Applicability::Unsafe)
                }
                false => draft,
            }
            .none();
        }
        if let Some(called) = builtin::BuiltIn::named(name)
            && !(own && called.gives_way())
        {
            self.is_built_in(&reference.name);
            return self.built_in_call(called, reference);
        }
        if reference.args.is_none()
            && let Some(sensor) = self.sensor_of_subject(name)
        {
            self.stands_for_sensor(&reference.name);
            return Some(Typed::new(Type::Sensor, sensor, span));
        }
        match self.value_of(&reference.name) {
            Some((decl, library)) => self.declared_reference(decl, library, reference),
            None if self.context.region == Region::StartHistory
                && reference.args.is_none()
                && name == NO_END =>
            {
                Some(self.no_end(span))
            }
            None => self.unknown_reference(reference, wanted.as_ref()),
        }
    }

    /// The sensor of that name of the robot at hand, where that is not the acting one. In a body that is checked for itself
    /// it may be any robot's.
    fn sensor_of_subject(&self, name: &str) -> Option<Value> {
        let world = self.program.world.as_ref()?;
        let of = |robot: &Robot| robot.sensors.find(|sensor| sensor.name.is(name));
        if self.subject != World::acting() {
            return of(world.robot_of(self.subject)).map(Value::Sensor);
        }
        let unread = self.names.value(name, self.context.library).is_none();
        let unknown = unread && self.bodies.of_any_reader();
        let known = unknown
            && world
                .others
                .values()
                .any(|other| of(&other.robot).is_some());
        known.then_some(Value::Unknown)
    }

    /// Reports that the robot which reads what is at hand has no such sensor, as another has.
    fn sensor_of_another(&mut self, reference: &Ref) -> Option<Typed> {
        let sensor = &reference.name.name;
        let reads = self.subject_robot().map(|robot| robot.name.clone());
        // A robot without a name is none: that no robot learns is reported.
        let reads = reads.filter(|name| !name.family.is_empty())?;
        let mut others = self.names.other_sensors.iter();
        let other = others.find(|(_, name)| name.name == *sensor);
        let acting = self.program.world.as_ref().map(|world| &world.robot.name);
        let has = match other {
            Some((robot, _)) => Some(robot.name.clone()),
            None => acting.map(Name::to_string),
        };
        let message = format!("the robot `{reads}` has no sensor `{sensor}`");
        let draft = self.error(Code::E0406, reference.span, message);
        let draft = draft.label(format!("`{reads}` reads here"));
        match has {
            Some(has) => draft.help(format!(
                "`{has}` has one, which what `{has}` runs can read; give `{reads}` one, too"
            )),
            None => draft,
        }
        .none()
    }

    /// Reports that no value of the enum `of` is called so, unless the name is like another one.
    fn no_value_of(&mut self, name: &Ident, of: Option<String>, wanted: Option<&Type>) -> bool {
        let Some(of) = of else { return false };
        // An enum or a kind is no misspelt value.
        if self.names.types.contains_key(name.name.as_str()) {
            return false;
        }
        let help = self.values_of(&Type::Enum(of.clone()));
        let variants = self.variants(&of);
        let variants: Vec<String> = variants.iter().map(ToString::to_string).collect();
        let variants = || variants.iter().map(String::as_str);
        let meant = suggest::nearest(&name.name, variants());
        let scope = self.context.scope.iter();
        let scope = scope.map(|bound| bound.name.name.as_str());
        let elsewhere = self.likely(&name.name, scope.chain(self.names.values(|_| true)));
        let elsewhere = elsewhere.or_else(|| self.parameter_meant(wanted));
        if meant.is_none() && elsewhere.is_some() {
            return false;
        }
        let message = format!("`{}` is not declared", name.name);
        let draft = self
            .error(Code::E0202, name.span, message)
            .label(format!("no value of `{of}` has this name"));
        match meant {
            Some(meant) => draft.likely(name, Some(meant)).emit(),
            None => draft.help_if(help).emit(),
        }
        true
    }

    /// The name of the body at hand, if it has no parameters: what is not declared in it may be one that it lacks.
    fn body_without_parameters(&self) -> Option<String> {
        let open = self.bodies.open.last()?;
        self.context.scope.is_empty().then(|| open.name.to_owned())
    }

    /// Whether a call is given a value of an enum, a place, a wall or a robot first, and no number.
    fn is_given_names(&self, reference: &Ref) -> bool {
        let first = reference.args.as_deref().and_then(<[Arg]>::first);
        let Some(ArgKind::Positional(first)) = first.map(|arg| &arg.kind) else {
            return false;
        };
        let named = plain_ref(first).filter(|named| named.args.is_none());
        let decl = named.and_then(|named| self.names.value(&named.name.name, false));
        decl.is_some_and(|(decl, _)| {
            matches!(
                decl,
                Decl::Variant(..) | Decl::Place(..) | Decl::Wall(..) | Decl::Robot(_)
            )
        })
    }

    fn unknown_reference(&mut self, reference: &Ref, wanted: Option<&Type>) -> Option<Typed> {
        let name = &reference.name;
        let mut others = self.names.other_sensors.iter();
        if reference.args.is_none() && others.any(|(_, other)| other.name == name.name) {
            return self.sensor_of_another(reference);
        }
        if self.may_be_lost(&name.name) || self.names.lost_values && reference.args.is_none() {
            return None;
        }
        // Only a sensor of the acting robot can be missing from a body of the library.
        let user = self.bodies.open.iter().find(|open| open.library);
        if let Some(user) = user.filter(|_| self.context.library) {
            let missing = &name.name;
            let message = format!("`{}` needs a sensor `{missing}`", user.name);
            return self
                .error(Code::E0406, reference.span, message)
                .label("read here, and the robot has none")
                .help(format!(
                    "add it to the robot: `sensor {missing} = scanner(from = …, to = …, range = …)`"
                ))
                .none();
        }
        let of = match wanted {
            Some(Type::Enum(of)) => Some(of.clone()),
            _ => None,
        };
        if reference.args.is_none() && self.no_value_of(name, of, wanted) {
            return None;
        }
        if reference.args.is_none() && name.name.len() == 1 {
            self.names.lacking.extend(self.body_without_parameters());
        }
        let called = reference.args.is_some();
        let likely = self.likely_value(reference, wanted);
        let likely = likely.or_else(|| self.parameter_meant(wanted).filter(|_| !called));
        let likely = likely.map(|likely| match likely {
            "uniform" if self.is_given_names(reference) => "one_of",
            _ => likely,
        });
        if self.names.lost_type && likely.is_none() && !called {
            return None;
        }
        let named = wanted.is_some_and(|wanted| {
            *wanted == Type::Target || *wanted == Type::Behavior || wanted.is_named_target()
        });
        let what = match reference.args {
            Some(_) => "function, predicate or `let`",
            // What a unit is called is no number where something with a name is wanted.
            None if named && UNITS.contains(&name.name.as_str()) => "parameter, state or place",
            None => "state, event, place or `let`",
        };
        // A kind is no place, and a letter more likely a parameter that is missing.
        let is_kind = self.names.types.contains_key(name.name.as_str());
        let is_letter = name.name.len() == 1 && self.context.region != Region::Tree;
        let places = match likely {
            None if !called && !is_kind && !is_letter => self.places_of(wanted),
            None if !called && !is_kind && named => self.parameter_missing(&name.name, wanted),
            _ => None,
        };
        self.undeclared(name, what, likely).or_help(places).none()
    }

    /// The declared name that was likely meant by one that nothing declares: first of those that may stand there, then of
    /// the others that may be meant by mistake.
    fn likely_value(&self, reference: &Ref, wanted: Option<&Type>) -> Option<&'a str> {
        let name = &reference.name.name;
        let called = reference.args.is_some();
        let given = reference.args.as_ref().is_some_and(|args| !args.is_empty());
        let scope = self.context.scope.iter();
        let scope = scope.map(|bound| -> &'a str { &bound.name.name });
        let scope = scope.filter(|_| !called);
        let fits = |decl: Decl| {
            let called = !called || may_be_called(decl, given);
            may_be(decl, wanted) && called
        };
        let built_in = builtin::names().map(|name| -> &'a str { name });
        let built_in = built_in.filter(|name| called != builtin::Constant::named(name).is_some());
        let known = scope.chain(self.names.values(fits)).chain(built_in);
        let fitting = self.likely(name, known);
        fitting.or_else(|| {
            let others = |decl| called && may_be_called(decl, false);
            self.likely(name, self.names.values(others))
        })
    }

    /// The one parameter of the body at hand that is of a type and that nothing has read.
    fn parameter_meant(&self, wanted: Option<&Type>) -> Option<&'a str> {
        let wanted = wanted?;
        let scope = self.context.scope.iter();
        let mut free = scope.filter(|bound| bound.ty.fits(wanted) && self.is_unread(bound.name));
        let only = free.next().filter(|bound| bound.ty != Type::Error)?;
        free.next().is_none().then_some(only.name.name.as_str())
    }

    /// How the parameter is declared that the body at hand seems to lack.
    fn parameter_missing(&self, name: &str, wanted: Option<&Type>) -> Option<String> {
        let body = self.body_without_parameters()?;
        let ty = match wanted? {
            Type::Target => "place".to_owned(),
            wanted => wanted.written()?,
        };
        let (body, name) = (spelled(&body), spelled(name));
        Some(format!(
            "a parameter stands behind the name: `{body}({name}: {ty})`"
        ))
    }

    /// The only sensor of the acting robot that nothing reads.
    fn sensor_unused(&self) -> Option<&'a str> {
        let sensors = self.names.values(|decl| matches!(decl, Decl::Sensor(_)));
        let mut unused = sensors.filter(|name| self.names.is_unused(name));
        let only = unused.next().filter(|name| !name.starts_with('_'))?;
        unused.next().is_none().then_some(only)
    }

    /// The places that are meant where one is wanted, as advice; a long list says little.
    fn places_of(&self, wanted: Option<&Type>) -> Option<String> {
        if *wanted? == Type::Target
            && let Some(sensor) = self.sensor_unused()
        {
            return Some(format!("a sensor that nothing reads is `{sensor}`"));
        }
        let kind = match wanted? {
            Type::Place(kind) => kind,
            Type::Target => &None,
            _ => return None,
        };
        let of_kind = self.kinds.places.iter().take(LOOKED_AT);
        let of_kind = of_kind.filter(|(_, of)| kind.is_none() || of == kind);
        let names: Vec<String> = of_kind.map(|(name, _)| name.to_string()).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        match names.as_slice() {
            [] => None,
            several if several.len() <= LISTED && self.kinds.places.len() <= LOOKED_AT => {
                Some(format!("the places are {}", listed(several, "and")))
            }
            _ => None,
        }
    }

    fn declared_reference(
        &mut self,
        decl: Decl<'a>,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Typed> {
        let span = reference.span;
        match decl {
            Decl::Let(shared) => return self.shared_call(shared, library, reference),
            Decl::Predicate(predicate) => {
                return self.predicate_value(predicate, library, reference);
            }
            Decl::Behavior(behavior) => {
                let value = self.behavior_instance(behavior, library, reference)?;
                return Some(Typed::new(Type::Behavior, value, span));
            }
            Decl::Input(input) => return self.input_value(input, reference),
            Decl::State(state) => return self.state_value(state, reference),
            Decl::Event(event) => return self.event_value(event, reference),
            _ => {}
        }
        if self.gives_arguments(reference, decl.what()) {
            return None;
        }
        let name = Name::word(&decl.ident().name);
        let world = self.program.world.as_ref();
        let (ty, value) = match decl {
            Decl::Variant(_, of, index) => {
                let id = self.program.pool.num(index as f64);
                (Type::Enum(of.name.name.clone()), Some(Value::Scalar(id)))
            }
            Decl::Place(_, kind) => {
                let known = world.filter(|_| !self.kinds.unknown.contains(&name));
                let id = known.and_then(|world| world.places.named(&name));
                let kind = kind.map(|kind| kind.name.clone());
                (Type::Place(kind), id.map(Value::Place))
            }
            Decl::Wall(_, kind) => {
                let known = world.filter(|_| !self.kinds.unknown.contains(&name));
                let id = known.and_then(|world| world.walls.named(&name));
                let kind = kind.map(|kind| kind.name.clone());
                (Type::Wall(kind), id.map(Value::Wall))
            }
            Decl::Sensor(_) => {
                let acting = self.subject == World::acting() || self.bodies.for_itself();
                if !acting {
                    return self.sensor_of_another(reference);
                }
                let sensors = world.map(|world| &world.robot.sensors);
                let id = sensors.and_then(|all| all.named(&name));
                (Type::Sensor, id.map(Value::Sensor))
            }
            Decl::Robot(_) => {
                let mut robots = world.into_iter().flat_map(World::robots);
                let at = robots.position(|robot| robot.name == name);
                (Type::Robot, at.map(|at| Value::Robot(Id::new(at))))
            }
            _ => {
                return self
                    .error(
                        Code::E0203,
                        span,
                        format!("`{}` has no value", reference.name.name),
                    )
                    .this_is(decl.what())
                    .none();
            }
        };
        Some(Typed::new(ty, value, span))
    }

    /// Whether a reference gives arguments, where `what` it names takes none: then they are reported.
    pub fn gives_arguments(&mut self, reference: &'a Ref, what: &str) -> bool {
        let Some(args) = &reference.args else {
            return false;
        };
        let name = &reference.name;
        if self.names.lacking.contains(&name.name) {
            return true;
        }
        self.error(
            Code::E0203,
            name.span,
            format!("`{}` takes no arguments", name.name),
        )
        .this_is(what)
        .fix_if(args.is_empty().then(|| {
            let place = name.span.after().to(reference.span.after());
            ("drop the parentheses".to_owned(), place, String::new())
        }));
        for arg in args {
            self.stray_argument(arg);
        }
        true
    }

    /// A leaf of the pool with its type.
    pub fn leaf(&mut self, expr: Expr, ty: Type, span: Span) -> Typed {
        let id = self.program.pool.leaf(expr);
        Typed::new(ty, Value::Scalar(id), span)
    }
}

/// Whether what is declared so may be called, with arguments or, if it is not `given` any, without.
fn may_be_called(decl: Decl, given: bool) -> bool {
    match decl {
        Decl::State(it) => it.params.is_some() || !given,
        Decl::Event(it) => it.params.is_some() || !given,
        Decl::Let(it) => it.params.is_some() || !given,
        Decl::Predicate(it) => it.params.is_some() || !given,
        Decl::Behavior(it) => it.params.is_some() || !given,
        _ => false,
    }
}

/// Whether what is declared so may be a value of a type.
fn may_be(decl: Decl, wanted: Option<&Type>) -> bool {
    let Some(wanted) = wanted else {
        return !matches!(decl, Decl::Tree(_));
    };
    let named = matches!(wanted, Type::Target | Type::Nowhere) || wanted.is_named_target();
    match decl {
        Decl::State(_) | Decl::Let(_) => *wanted != Type::Behavior,
        Decl::Tree(_) => false,
        Decl::Input(_) => !named,
        Decl::Predicate(_) | Decl::Event(_) => *wanted == Type::Bool,
        Decl::Variant(..) => matches!(wanted, Type::Enum(_)),
        Decl::Behavior(_) => *wanted == Type::Behavior,
        Decl::Place(..) | Decl::Wall(..) | Decl::Robot(_) | Decl::Sensor(_) => named,
    }
}
