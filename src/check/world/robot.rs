//! Robots: body, drive and contact.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::names::{Decl, unknown};
use crate::check::types::Type;
use crate::check::types::units::Dim;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Name;
use crate::ir::table::Table;
use crate::ir::world::{Contact, Drive, DriveKind, Robot};
use crate::syntax::ast::{
    self, Expr, ExprKind, Field, Ref, RobotEntry, RobotEntryKind, WorldEntryKind,
};

impl<'a> Checker<'a> {
    /// The robot that learns; others are checked, and not built yet.
    pub fn robots(&mut self, world: &'a ast::World) {
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
                let kept = self.program.world.as_ref().map(|world| world.robot.clone());
                self.robot(name, entries);
                if let (Some(world), Some(kept)) = (&mut self.program.world, kept) {
                    world.robot = kept;
                }
                self.runs(&runs.value);
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
                "the world",
                "robot",
                "robot NAME { body = disc(17 cm) drive = differential(…) }",
            );
        }
    }

    /// `runs = tree`
    fn runs(&mut self, value: &'a Expr) {
        let ExprKind::Ref(reference) = &value.kind else {
            self.not_named(value, "a tree", "tree NAME = …");
            return;
        };
        match self.names.value(&reference.name.name, false) {
            Some((Decl::Tree(_), _)) => {}
            Some((decl, _)) => self.wrong_kind(reference, "a tree", decl.what()),
            None => {
                let trees = self.names.values(|decl| matches!(decl, Decl::Tree(_)));
                let diagnostic = unknown(&reference.name, "tree", trees);
                self.report(diagnostic);
            }
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
            name: Name::word(&name.name),
            ..no_robot()
        };
        match find("body") {
            Some(field) => {
                if let Some(radius) = self.body(&field.value) {
                    robot.radius = radius;
                }
            }
            None => self.missing(name.span, "the robot", "body", "body = disc(17 cm)"),
        }
        match find("drive") {
            Some(field) => {
                if let Some(drive) = self.drive(&field.value) {
                    robot.drive = drive;
                }
            }
            None => self.missing(
                name.span,
                "the robot",
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
        self.choice_of(value, "`body`", &["disc(radius)"]);
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
                self.out_of_range(
                    *span,
                    "the limit of a drive is above zero",
                    "this robot could not move",
                );
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
}

/// The robot of a world that has not said it yet.
pub fn no_robot() -> Robot {
    Robot {
        name: Name::default(),
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
