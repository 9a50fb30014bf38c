//! The world: arena, walls, places and the robot.

use super::Checker;
use super::builtin::{Constant, Function};
use super::context::{Context, Region};
use super::names::unknown;
use super::types::{Type, Value};
use super::units::Dim;
use crate::diagnostic::{Code, Diagnostic, suggest};
use crate::ir::table::Table;
use crate::ir::world::{
    Contact, Drive, DriveKind, Place, Point, Robot, Sensor, SensorKind, Shape, Wall, World,
};
use crate::source::Span;
use crate::syntax::ast::{
    self, Arg, ArgKind, Expr, ExprKind, Field, Item, ItemKind, Ref, RobotEntry, RobotEntryKind,
    WorldEntryKind,
};
use std::f64::consts::TAU;

impl<'a> Checker<'a> {
    /// The one world of a program.
    pub(super) fn worlds(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut first: Option<&'a ast::World> = None;
        for item in items {
            let ItemKind::World(world) = &item.kind else {
                continue;
            };
            match first {
                None => first = Some(world),
                Some(first) => self.report(
                    Diagnostic::new(Code::E0401, world.name.span, "a program has one world")
                        .label("a second world")
                        .also(first.name.span, "the first is declared here"),
                ),
            }
        }
        if let Some(world) = first {
            self.has_world = true;
            self.context = Context::new(Region::World);
            self.world(world);
        }
    }

    /// The tick comes first, since everything may be counted in it; places may be referred to by sensors, so the robot
    /// comes last.
    fn world(&mut self, world: &'a ast::World) {
        let fields: Vec<&'a Field> = world
            .entries
            .iter()
            .filter_map(|entry| match &entry.kind {
                WorldEntryKind::Field(field) => Some(field),
                _ => None,
            })
            .collect();
        let known = ["tick", "arena"];
        self.fields(&fields, &known, "a world");
        let find = |name: &str| fields.iter().copied().find(|field| field.name.name == name);
        for missing in known.into_iter().filter(|name| find(name).is_none()) {
            let example = match missing {
                "tick" => "tick = 100 ms",
                _ => "arena = rect((0 m, 0 m), (6 m, 4 m))",
            };
            self.missing(world.name.span, "world", missing, example);
        }
        if let Some(field) = find("tick") {
            let time = Type::Quantity(Dim::TIME);
            if let Some(tick) = self.constant(&field.value, &time, "the length of a tick") {
                if tick > 0.0 {
                    self.tick = Some(tick);
                } else {
                    self.out_of_range(field.value.span, "a tick takes time");
                }
            }
        }
        let arena = find("arena").and_then(|field| {
            let shape = self.shape_of(&field.value, "the arena")?;
            if matches!(shape, Shape::Polyline(_)) {
                self.report(
                    Diagnostic::new(Code::E0404, field.value.span, "an arena encloses an area")
                        .label("a line has none"),
                );
                return None;
            }
            Some(shape)
        });
        self.program.world = Some(World {
            name: world.name.name.clone(),
            tick: self.tick.unwrap_or(0.1),
            arena: arena.clone().unwrap_or(Shape::Disc {
                center: [0.0; 2],
                radius: 1.0,
            }),
            walls: Table::default(),
            places: Table::default(),
            robot: no_robot(),
        });
        for entry in &world.entries {
            match &entry.kind {
                WorldEntryKind::Place {
                    name,
                    shape,
                    facing,
                    ..
                } => self.place(name, shape, facing.as_ref(), arena.as_ref()),
                WorldEntryKind::Wall {
                    name, shape, when, ..
                } => self.wall(name, shape, when.as_ref()),
                _ => {}
            }
        }
        self.robots(world);
    }

    fn place(
        &mut self,
        name: &'a ast::Ident,
        shape: &'a Expr,
        facing: Option<&'a Expr>,
        arena: Option<&Shape>,
    ) {
        let span = shape.span;
        let shape = self.shape_of(shape, "a place");
        let angle = Type::Quantity(Dim::ANGLE);
        let facing = facing.and_then(|facing| self.constant(facing, &angle, "`facing`"));
        let Some(shape) = shape else { return };
        if arena.is_some_and(|arena| !contains(arena, shape.center())) {
            self.report(
                Diagnostic::new(
                    Code::E0404,
                    span,
                    format!("the place `{}` lies outside the arena", name.name),
                )
                .label("its centre is out of every robot's reach"),
            );
        }
        if let Some(world) = &mut self.program.world {
            world.places.push(Place {
                name: spelled(&name.name),
                shape,
                facing: facing.map(crate::math::wrap),
            });
        }
    }

    fn wall(&mut self, name: &'a ast::Ident, shape: &'a Expr, when: Option<&'a Expr>) {
        let shape = self.shape_of(shape, "a wall");
        if let Some(when) = when {
            let outer = std::mem::replace(&mut self.context, Context::new(Region::Predicate));
            let (_, found) = self.captured(|checker| checker.expr(when));
            self.context = outer;
            // States are not declared yet: of the condition, only its place is certain.
            drop(found);
            self.not_yet(when.span, "walls that stand under a condition");
        }
        if let (Some(shape), Some(world)) = (shape, &mut self.program.world) {
            world.walls.push(Wall {
                name: spelled(&name.name),
                shape,
            });
        }
    }

    fn robots(&mut self, world: &'a ast::World) {
        let mut acting: Option<&'a ast::Ident> = None;
        for entry in &world.entries {
            let WorldEntryKind::Robot { name, entries } = &entry.kind else {
                continue;
            };
            let runs = entries.iter().find_map(|entry| match &entry.kind {
                RobotEntryKind::Field(field) if field.name.name == "runs" => Some(field),
                _ => None,
            });
            if let Some(runs) = runs {
                self.not_yet(runs.name.span, "robots that run a tree of their own");
                continue;
            }
            if let Some(first) = acting {
                self.report(
                    Diagnostic::new(Code::E0408, name.span, "one robot learns")
                        .label("a second robot without `runs`")
                        .also(first.span, "the first is declared here"),
                );
                continue;
            }
            acting = Some(name);
            self.robot(name, entries);
        }
        if acting.is_none() {
            self.missing(
                world.name.span,
                "world",
                "robot",
                "robot NAME { body = disc(17 cm) drive = differential(…) }",
            );
        }
    }

    fn robot(&mut self, name: &'a ast::Ident, entries: &'a [RobotEntry]) {
        let fields: Vec<&'a Field> = entries
            .iter()
            .filter_map(|entry| match &entry.kind {
                RobotEntryKind::Field(field) => Some(field),
                _ => None,
            })
            .collect();
        self.fields(&fields, &["body", "drive", "contact", "runs"], "a robot");
        let find = |name: &str| fields.iter().copied().find(|field| field.name.name == name);
        let mut robot = Robot {
            name: spelled(&name.name),
            ..no_robot()
        };
        match find("body") {
            Some(field) => {
                if let Some(radius) = self.body(&field.value) {
                    robot.radius = radius;
                }
            }
            None => self.missing(name.span, "robot", "body", "body = disc(17 cm)"),
        }
        match find("drive") {
            Some(field) => {
                if let Some(drive) = self.drive(&field.value) {
                    robot.drive = drive;
                }
            }
            None => self.missing(
                name.span,
                "robot",
                "drive",
                "drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)",
            ),
        }
        if let Some(field) = find("contact") {
            let word = match &field.value.kind {
                ExprKind::Ref(Ref {
                    name, args: None, ..
                }) => name.name.as_str(),
                _ => "",
            };
            match word {
                "stop" => robot.contact = Contact::Stop,
                "slide" => robot.contact = Contact::Slide,
                _ => self.choice_of(&field.value, "`contact`", &["stop", "slide"]),
            }
        }
        if let Some(world) = &mut self.program.world {
            world.robot = robot;
        }
        for entry in entries {
            if let RobotEntryKind::Sensor { name, value } = &entry.kind {
                let sensor = self.sensor(name, value);
                if let (Some(sensor), Some(world)) = (sensor, &mut self.program.world) {
                    world.robot.sensors.push(sensor);
                }
            }
        }
    }

    /// `body = disc(radius)`
    fn body(&mut self, value: &'a Expr) -> Option<f64> {
        if let ExprKind::Ref(reference) = &value.kind
            && Function::named(&reference.name.name) == Some(Function::Disc)
        {
            let values = self.positional(reference, 1, 1)?;
            return self.radius(values.first()?);
        }
        self.choice_of(value, "`body`", &["disc(17 cm)"]);
        None
    }

    /// `drive = differential(…)`, `drive = holonomic(…)`
    fn drive(&mut self, value: &'a Expr) -> Option<Drive> {
        let reference = match &value.kind {
            ExprKind::Ref(reference) => Some(reference),
            _ => None,
        };
        let kind = match reference.map(|reference| reference.name.name.as_str()) {
            Some("differential") => DriveKind::Differential,
            Some("holonomic") => DriveKind::Holonomic,
            _ => {
                self.choice_of(value, "`drive`", &["differential(…)", "holonomic(…)"]);
                return None;
            }
        };
        let speed = Type::Quantity(Dim::SPEED);
        let turn = Type::Quantity(Dim::TURN_RATE);
        let mut settings = self.settings(
            reference?,
            &[
                ("max_speed", speed.clone(), None),
                ("max_turn", turn.clone(), None),
                ("speed_noise", speed, Some(0.0)),
                ("turn_noise", turn, Some(0.0)),
            ],
        )?;
        for (value, span) in settings.iter().take(2) {
            if *value <= 0.0 {
                self.out_of_range(*span, "the limit of a drive is above zero");
                return None;
            }
        }
        let mut next = settings.drain(..).map(|(value, _)| value);
        Some(Drive {
            kind,
            max_speed: next.next()?,
            max_turn: next.next()?,
            speed_noise: next.next()?,
            turn_noise: next.next()?,
        })
    }

    /// `sensor name = scanner(…)`, `range_finder(…)`, `beacon(…)`
    fn sensor(&mut self, name: &'a ast::Ident, value: &'a Expr) -> Option<Sensor> {
        let ExprKind::Ref(reference) = &value.kind else {
            self.choice_of(value, "a sensor", &SENSORS);
            return None;
        };
        let angle = Type::Quantity(Dim::ANGLE);
        let length = Type::Quantity(Dim::LENGTH);
        let noise = ("noise", length.clone(), Some(0.0));
        let (kind, noise) = match reference.name.name.as_str() {
            "scanner" => {
                let set = self.settings(
                    reference,
                    &[
                        ("from", angle.clone(), None),
                        ("to", angle, None),
                        ("range", length, None),
                        noise,
                    ],
                )?;
                let [(from, at), (to, _), (range, far), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                if !(from < to && to - from <= TAU + 1e-9) {
                    self.out_of_range(at, "a sector goes counter-clockwise, at most once round");
                    return None;
                }
                self.positive(range, far)?;
                (SensorKind::Scanner { from, to, range }, noise)
            }
            "range_finder" => {
                let set = self.settings(
                    reference,
                    &[("at", angle, None), ("range", length, None), noise],
                )?;
                let [(at, _), (range, far), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                self.positive(range, far)?;
                (SensorKind::RangeFinder { at, range }, noise)
            }
            "beacon" => {
                let (target, facing) = self.beacon_target(reference)?;
                let set = self.settings(
                    reference,
                    &[("range", length, None), ("sector", angle, Some(TAU)), noise],
                )?;
                let [(range, far), (sector, _), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                self.positive(range, far)?;
                let kind = SensorKind::Beacon {
                    target,
                    range,
                    facing,
                    sector,
                };
                (kind, noise)
            }
            _ => {
                self.choice_of(value, "a sensor", &SENSORS);
                return None;
            }
        };
        Some(Sensor {
            name: spelled(&name.name),
            kind,
            noise,
        })
    }

    /// The `target` of a beacon: a place, whose `facing` is the way that it sends, against the robot that faces it.
    fn beacon_target(&mut self, reference: &'a Ref) -> Option<(Point, f64)> {
        let named = reference
            .args
            .iter()
            .flatten()
            .find_map(|arg| match &arg.kind {
                ArgKind::Named(name, value) if name.name == "target" => Some(value),
                _ => None,
            });
        let Some(value) = named else {
            self.missing(reference.span, "beacon", "target", "beacon(target = C, …)");
            return None;
        };
        let target = self.expect(value, &Type::Place(None), "the target of a beacon");
        let Value::Place(id) = target.value else {
            return None;
        };
        let place = &self.program.world.as_ref()?.places[id];
        let sends = place.facing.map_or(0.0, |facing| {
            crate::math::wrap(facing + std::f64::consts::PI)
        });
        Some((place.shape.center(), sends))
    }

    /// Constant settings by name; those without a default have to be there. Values with their places, in the order of
    /// `wanted`.
    fn settings(
        &mut self,
        reference: &'a Ref,
        wanted: &[(&str, Type, Option<f64>)],
    ) -> Option<Vec<(f64, Span)>> {
        let args: &'a [Arg] = reference.args.as_deref().unwrap_or_default();
        let mut fine = true;
        for arg in args {
            match &arg.kind {
                ArgKind::Named(name, _) => {
                    let target = reference.name.name == "beacon" && name.name == "target";
                    if !target && wanted.iter().all(|(known, ..)| *known != name.name) {
                        let diagnostic =
                            unknown(name, "setting", wanted.iter().map(|(name, ..)| *name));
                        self.report(diagnostic);
                        fine = false;
                    }
                }
                ArgKind::Positional(_) | ArgKind::Binder { .. } => {
                    self.report(
                        Diagnostic::new(
                            Code::E0305,
                            arg.span,
                            format!("`{}` takes its settings by name", reference.name.name),
                        )
                        .label("write `name = value`"),
                    );
                    fine = false;
                }
            }
        }
        let mut values = Vec::new();
        for (name, ty, default) in wanted {
            let given = args.iter().find_map(|arg| match &arg.kind {
                ArgKind::Named(known, value) if known.name == *name => Some(value),
                _ => None,
            });
            let value = match (given, default) {
                (Some(value), _) => self
                    .constant(value, ty, &format!("`{name}`"))
                    .map(|number| (number, value.span)),
                (None, Some(default)) => Some((*default, reference.span)),
                (None, None) if fine => {
                    self.missing(
                        reference.span,
                        &reference.name.name,
                        name,
                        &format!("{name} = …"),
                    );
                    None
                }
                (None, None) => None,
            };
            values.push(value);
        }
        let values: Option<Vec<_>> = values.into_iter().collect();
        values.filter(|_| fine)
    }

    /// Reports fields that are unknown or there twice.
    fn fields(&mut self, fields: &[&'a Field], known: &[&str], what: &str) {
        for (i, field) in fields.iter().enumerate() {
            let name = &field.name;
            let before = fields
                .iter()
                .take(i)
                .find(|other| other.name.name == name.name);
            if let Some(first) = before {
                self.report(
                    Diagnostic::new(
                        Code::E0403,
                        name.span,
                        format!("`{}` is there twice", name.name),
                    )
                    .label("said again here")
                    .also(first.name.span, "first said here"),
                );
            } else if !known.contains(&name.name.as_str()) {
                let mut diagnostic = Diagnostic::new(
                    Code::E0403,
                    name.span,
                    format!("{what} has no `{}`", name.name),
                )
                .label("unknown");
                diagnostic = match suggest::nearest(&name.name, known.iter().copied()) {
                    Some(likely) => diagnostic.fix(
                        format!("did you mean `{likely}`?"),
                        name.span,
                        likely,
                        crate::diagnostic::Applicability::Unsafe,
                    ),
                    None => diagnostic.help(format!("it has: {}", known.join(", "))),
                };
                self.report(diagnostic);
            }
        }
    }

    fn missing(&mut self, span: Span, what: &str, missing: &str, example: &str) {
        self.report(
            Diagnostic::new(
                Code::E0402,
                span,
                format!("the {what} does not say its `{missing}`"),
            )
            .label(format!("`{missing}` is missing"))
            .help(format!("for example: `{example}`")),
        );
    }

    fn choice_of(&mut self, value: &Expr, what: &str, choices: &[&str]) {
        if matches!(value.kind, ExprKind::Error) {
            return;
        }
        let choices: Vec<String> = choices.iter().map(|choice| format!("`{choice}`")).collect();
        self.report(
            Diagnostic::new(
                Code::E0403,
                value.span,
                format!("{what} is {}", choices.join(" or ")),
            )
            .label("not one of them"),
        );
    }

    fn positive(&mut self, value: f64, span: Span) -> Option<()> {
        if value > 0.0 {
            return Some(());
        }
        self.out_of_range(span, "a range is above zero");
        None
    }

    /// A number that makes no sense where it stands.
    pub(super) fn out_of_range(&mut self, span: Span, why: &str) {
        self.report(Diagnostic::new(Code::E0309, span, why).label("out of range"));
    }
}

/// What a sensor can be, as it is offered.
const SENSORS: [&str; 3] = ["scanner(…)", "range_finder(…)", "beacon(…)"];

/// A name as the language writes it: in backquotes if it is no identifier or means something already.
pub(super) fn spelled(name: &str) -> String {
    crate::syntax::print::name(name)
}

/// The robot of a world that has not said it yet.
fn no_robot() -> Robot {
    Robot {
        name: String::new(),
        radius: 0.1,
        drive: Drive {
            kind: DriveKind::Differential,
            max_speed: 1.0,
            max_turn: 1.0,
            speed_noise: 0.0,
            turn_noise: 0.0,
        },
        contact: Contact::Stop,
        sensors: Table::default(),
    }
}

/// Whether a point lies in a closed shape.
fn contains(shape: &Shape, [x, y]: Point) -> bool {
    match shape {
        Shape::Disc {
            center: [cx, cy],
            radius,
        } => crate::math::hypot(x - cx, y - cy) <= *radius,
        Shape::Rect {
            min: [x0, y0],
            max: [x1, y1],
        } => (*x0..=*x1).contains(&x) && (*y0..=*y1).contains(&y),
        Shape::Polygon(points) => {
            let next = points.iter().cycle().skip(1);
            let crossings = points.iter().zip(next).filter(|(a, b)| {
                (a[1] > y) != (b[1] > y) && x < (b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]
            });
            crossings.count() % 2 == 1
        }
        Shape::Polyline(_) => false,
    }
}

/// Whether a name is one that the compiler knows.
pub(super) fn is_built_in(name: &str) -> bool {
    Constant::named(name).is_some() || Function::named(name).is_some()
}
