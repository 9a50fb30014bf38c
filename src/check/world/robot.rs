//! Robots: body, drive and contact.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::{Context, Region};
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::ir::table::Table;
use crate::ir::tree::Node;
use crate::ir::world::{Contact, Drive, DriveKind, Robot, Scripted};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{
    self, ArgKind, Expr, ExprKind, Ident, Ref, RobotEntry, RobotEntryKind, WorldEntryKind,
};

impl<'a> Checker<'a> {
    /// The robot that learns, and those that run trees of their own.
    pub fn robots(&mut self, world: &'a ast::World) {
        let mut acting: Option<&'a ast::Ident> = None;
        // Whether one of its entries is not understood: it may say what that robot runs.
        let mut unsure = false;
        for entry in &world.entries {
            let WorldEntryKind::Robot { name, entries } = &entry.kind else {
                continue;
            };
            let runs = entries.iter().find_map(|entry| match &entry.kind {
                RobotEntryKind::Field(field) if field.name.name == "runs" => Some(field),
                _ => None,
            });
            if let Some(runs) = runs {
                if let Some(robot) = self.robot(name, entries)
                    && let Some(world) = &mut self.program.world
                {
                    let script = None;
                    world.others.push(Scripted { robot, script });
                    self.scripts.push((name, &runs.value));
                }
                continue;
            }
            let odd = entries.iter().any(|entry| match &entry.kind {
                RobotEntryKind::Field(field) => !FIELDS.contains(&field.name.name.as_str()),
                RobotEntryKind::Error => true,
                RobotEntryKind::Sensor { .. } => false,
            });
            self.robots_unsure |= odd || acting.is_some();
            if acting.is_some() && odd {
                // What it runs is likely what is unknown.
                self.robot(name, entries);
                continue;
            }
            if let Some(first) = acting {
                if unsure {
                    continue;
                }
                self.error(Code::E0408, name.span, "one robot learns")
                    .label("a second robot without `runs`")
                    .also(first.span, "the first is declared here");
                continue;
            }
            acting = Some(name);
            unsure = odd;
            if let Some(robot) = self.robot(name, entries)
                && let Some(world) = &mut self.program.world
            {
                world.robot = robot;
            }
        }
        if acting.is_none() && !self.scripts.is_empty() {
            self.error(
                Code::E0402,
                world.name.span,
                "no robot of this world learns",
            )
            .label("every robot has `runs`")
            .help("leave out `runs` of the robot that is to learn");
        } else if acting.is_none() {
            self.missing(
                Code::E0402,
                world.name.span,
                "the world",
                "robot",
                "robot NAME { body = disc(17 cm) drive = differential(…) }",
            );
        }
    }

    /// What the other robots run, once all trees are known.
    pub fn scripts(&mut self) {
        for (index, (name, runs)) in self.scripts.clone().into_iter().enumerate() {
            let robot = Id::new(index + 1);
            if plain_ref(runs).is_none() {
                self.not_named(runs, "a tree", "tree NAME = …");
                continue;
            }
            self.context = Context::new(Region::Tree);
            let (script, told) = self.captured(|checker| checker.script(robot, name, runs));
            // Of the tree of another robot, one mistake says that it is the wrong one.
            let named = plain_ref(runs).map(|tree| tree.name.name.as_str());
            let tree = named.and_then(|tree| self.names.value(tree, false));
            let task = match tree {
                Some((Decl::Tree(tree), _)) => tree.task.as_ref(),
                _ => None,
            };
            let mut mistakes = told.iter().filter(|found| found.is_error());
            match task.zip(mistakes.next()) {
                Some((task, first)) => {
                    let (who, task) = (&name.name, &task.name);
                    let help = format!(
                        "this tree is for the task `{task}` of the robot that learns: let `{who}` run one of its own"
                    );
                    self.diagnostics.push(first.clone().help(help));
                }
                None => self.diagnostics.extend(told),
            }
            if let Some(world) = &mut self.program.world {
                world.others[Id::new(index)].script = script;
            }
        }
    }

    /// What a robot runs.
    fn script(&mut self, robot: Id<Robot>, name: &Ident, runs: &'a Expr) -> Option<Node> {
        self.asked.clear();
        let script = self.as_robot(robot, |checker| checker.leaf_node(runs));
        if let Some((span, _)) = self.asked.first().copied() {
            let message = format!("the robot `{}` keeps no history", name.name);
            self.error(Code::E0607, span, message)
                .label("this could never hold")
                .help("only the robot that learns keeps one");
        }
        script
    }

    fn robot(&mut self, name: &'a ast::Ident, entries: &'a [RobotEntry]) -> Option<Robot> {
        let fields = entries.iter().filter_map(|entry| match &entry.kind {
            RobotEntryKind::Field(field) => Some(field),
            _ => None,
        });
        let [body, drive, contact, _] = self.fields(fields, FIELDS, "a robot");
        let mut robot = Robot {
            name: Name::word(&name.name),
            ..no_robot()
        };
        for (field, name_of, example) in [
            (body, "body", "body = disc(17 cm)"),
            (
                drive,
                "drive",
                "drive = differential(max_speed = 0.4 m/s, max_turn = 2 rad/s)",
            ),
        ] {
            if field.is_none() {
                self.missing(Code::E0402, name.span, "the robot", name_of, example);
            }
        }
        if let Some(radius) = body.and_then(|field| self.body(&field.value)) {
            robot.radius = radius;
        }
        match drive.and_then(|field| self.drive(&field.value)) {
            Some(drive) => robot.drive = drive,
            None => self.drive_unsure = true,
        }
        if let Some(field) = contact {
            match word(&field.value) {
                "stop" => robot.contact = Contact::Stop,
                "slide" => robot.contact = Contact::Slide,
                _ => self.choice_of(&field.value, "`contact`", &["stop", "slide"]),
            }
        }
        for entry in entries {
            if let RobotEntryKind::Sensor { name, value } = &entry.kind
                && let Some(sensor) = self.sensor(name, value)
            {
                robot.sensors.push(sensor);
            }
        }
        Some(robot)
    }

    /// Reports `disc(centre, radius)` as a body, whose centre is the robot's own.
    fn centred_body(&mut self, reference: &Ref) -> bool {
        let args = reference.args.as_deref().unwrap_or_default();
        let [center, radius] = args else { return false };
        let ArgKind::Positional(Expr {
            kind: ExprKind::Point(..),
            ..
        }) = center.kind
        else {
            return false;
        };
        let gap = Span {
            end: radius.span.start,
            ..center.span
        };
        let message = "the disc of a body takes its radius alone";
        self.error(Code::E0305, center.span, message)
            .label("its centre is where the robot is")
            .fix("drop the centre", gap, "", Applicability::Unsafe);
        true
    }

    /// `body = disc(radius)`
    fn body(&mut self, value: &'a Expr) -> Option<f64> {
        if let ExprKind::Ref(reference) = &value.kind
            && Function::named(&reference.name.name) == Some(Function::Disc)
        {
            if self.centred_body(reference) {
                return None;
            }
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
        let [max_speed, max_turn, speed_noise, turn_noise] = self.settings(
            reference?,
            [
                ("max_speed", Type::SPEED, None),
                ("max_turn", Type::TURN_RATE, None),
                ("speed_noise", Type::SPEED, Some(0.0)),
                ("turn_noise", Type::TURN_RATE, Some(0.0)),
            ],
        )?;
        for (limit, span) in [max_speed, max_turn] {
            if limit <= 0.0 {
                let label = "this robot could not move";
                return self
                    .out_of_range(span, "the limit of a drive is above zero", label)
                    .none();
            }
        }
        self.noise(speed_noise)?;
        self.noise(turn_noise)?;
        Some(Drive {
            kind,
            max_speed: max_speed.0,
            max_turn: max_turn.0,
            speed_noise: speed_noise.0,
            turn_noise: turn_noise.0,
        })
    }
}

/// The fields of a robot.
const FIELDS: [&str; 4] = ["body", "drive", "contact", "runs"];

/// The value as a word; empty if it is not one.
fn word(value: &Expr) -> &str {
    match &value.kind {
        ExprKind::Ref(Ref {
            name, args: None, ..
        }) => &name.name,
        _ => "",
    }
}

/// A stand-in for the robot until it is checked.
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
