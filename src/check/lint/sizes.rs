//! Sizes out of proportion to the arena or to the robot: most are written in a wrong unit.

use crate::check::Checker;
use crate::check::context::Region;
use crate::check::report::short;
use crate::diagnostic::Code;
use crate::geometry::{Shape, minus};
use crate::ir::Name;
use crate::ir::dimension::Dim;
use crate::ir::world::{Robot, SensorKind, World};
use crate::source::Span;
use crate::syntax::ast::{self, Item, ItemKind, RobotEntryKind, WorldEntryKind};

/// A robot hardly moves that does not get so part of the way through the arena.
const NEAR: f64 = 5.0;

/// A speed is a mistake that is so many times what a robot can do.
const FAST: f64 = 5.0;

/// A tick of so many seconds is likely a mistake.
const LONG_TICK: f64 = 1.0;

/// A number with its unit.
#[derive(Clone, Copy, Debug)]
pub enum Quantity {
    /// Seconds.
    Time(f64),
    /// Metres per second.
    Speed(f64),
}

impl<'a> Checker<'a> {
    /// Notes a time that a behaviour is given, or a speed in a control law or a value for one.
    pub fn notes_quantity(&mut self, dim: Dim, value: f64, at: Span) {
        let region = self.context.region;
        let quantity = match dim {
            Dim::TIME if self.given.is_some() => Quantity::Time(value),
            Dim::SPEED if matches!(region, Region::Control | Region::Let) => Quantity::Speed(value),
            _ => return,
        };
        if !self.context.library {
            self.quantities.insert(at, quantity);
        }
    }

    /// Warns of times that are over before a tick is, and of speeds that no robot comes near.
    fn quantities_out_of_proportion(&mut self, world: &World) {
        let speeds = world.robots().map(|robot| robot.drive.max_speed);
        let fastest = speeds.fold(0.0, f64::max);
        let told = self.told();
        for (at, quantity) in std::mem::take(&mut self.quantities) {
            match quantity {
                _ if told.overlap(at) => continue,
                Quantity::Time(time) if time > 0.0 && time < world.tick => self
                    .warning(
                        Code::W0402,
                        at,
                        "this time is over before the first tick is",
                    )
                    .label(format!(
                        "a tick of this world takes {} s",
                        short(world.tick)
                    )),
                Quantity::Speed(speed) if speed > FAST * fastest && fastest > 0.0 => self
                    .warning(Code::W0402, at, "no robot comes near this speed")
                    .label(format!("the fastest goes {} m/s", short(fastest))),
                _ => continue,
            };
        }
    }

    /// Warns of robots that cross the arena in a tick, of sensors that see no wall, and of places that are everywhere.
    pub fn sizes_out_of_proportion(&mut self, items: impl Iterator<Item = &'a Item>) {
        let Some(world) = self.program.world.clone() else {
            return;
        };
        self.quantities_out_of_proportion(&world);
        for item in items {
            let ItemKind::World(declared) = &item.kind else {
                continue;
            };
            for entry in &declared.entries {
                match &entry.kind {
                    WorldEntryKind::Field(field) if field.name.name == "tick" => {
                        self.tick_out_of_proportion(&world, field.value.span);
                    }
                    WorldEntryKind::Robot { name, entries, .. } => {
                        let named = |robot: &&Robot| robot.name.is(&name.name);
                        if let Some(robot) = world.robots().find(named) {
                            self.sizes_of(&world, robot, entries);
                        }
                    }
                    WorldEntryKind::Place { name, shape, .. } => {
                        let place = world.places.named(&Name::word(&name.name));
                        if place.is_some_and(|place| covers(&world.places[place].shape, &world)) {
                            let message = format!("the place `{}` is the whole arena", name.name);
                            self.warning(Code::W0402, shape.span, message)
                                .label("the robot is always in it");
                        }
                    }
                    WorldEntryKind::Wall { name, shape, .. } => {
                        let wall = world.walls.named(&Name::word(&name.name));
                        let beyond = wall.and_then(|wall| beyond(&world.walls[wall].shape, &world));
                        if let Some(beyond) = beyond {
                            let message = format!(
                                "the wall `{}` reaches {} m beyond the arena",
                                name.name,
                                short(beyond)
                            );
                            self.warning(Code::W0402, shape.span, message)
                                .label("no robot meets it there");
                        }
                    }
                    _ => {}
                }
            }
        }
    }

    /// A tick of seconds, in which a robot crosses the arena, is the mistake.
    fn tick_out_of_proportion(&mut self, world: &World, at: Span) {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        let speeds = world.robots().map(|robot| robot.drive.max_speed);
        let step = speeds.fold(0.0, f64::max) * world.tick;
        if step >= width.min(height) && world.tick >= LONG_TICK {
            self.warning(Code::W0402, at, "a robot may cross the arena in one tick")
                .label(format!("it may go {} m in this time", short(step)))
                .help("most ticks are some milliseconds long, such as `100 ms`");
        }
    }

    fn sizes_of(&mut self, world: &World, robot: &Robot, entries: &'a [ast::RobotEntry]) {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        for entry in entries {
            match &entry.kind {
                RobotEntryKind::Field(field) if field.name.name == "drive" => {
                    let step = robot.drive.max_speed * world.tick;
                    if step >= width.min(height) && world.tick < LONG_TICK {
                        let message = "the robot may cross the arena in one tick";
                        let label = format!("{} m in a tick of {} s", short(step), world.tick);
                        self.warning(Code::W0402, field.value.span, message)
                            .label(label)
                            .help("make it slower, or the tick shorter");
                    }
                    let (noise, speed) = (robot.drive.speed_noise, robot.drive.max_speed);
                    if noise > speed && speed > 0.0 {
                        let message = "the robot goes by chance, not as it is told";
                        let (noise, speed) = (short(noise), short(speed));
                        let label = format!("its noise is {noise} m/s, its speed {speed} m/s");
                        self.warning(Code::W0402, field.value.span, message)
                            .label(label);
                    }
                    let (noise, turn) = (robot.drive.turn_noise, robot.drive.max_turn);
                    if noise > turn && turn > 0.0 {
                        let message = "the robot turns by chance, not as it is told";
                        let (noise, turn) = (short(noise), short(turn));
                        let label =
                            format!("its noise is {noise} rad/s, its rate of turn {turn} rad/s");
                        self.warning(Code::W0402, field.value.span, message)
                            .label(label);
                    }
                    let learns = robot.name == world.robot.name;
                    let sent = self.sent_to();
                    let passed = world.places.values().find(|place| {
                        let small = learns && widest(&place.shape) < step;
                        small && sent.contains(&place.name.to_string())
                    });
                    if let Some(place) = passed.filter(|_| step < width.min(height)) {
                        let message = format!("the robot may pass over the place `{}`", place.name);
                        let label = format!(
                            "{} m in a tick of {} s, and the place is {} m wide",
                            short(step),
                            world.tick,
                            short(widest(&place.shape))
                        );
                        self.warning(Code::W0402, field.value.span, message)
                            .label(label)
                            .help("make it slower, or the tick shorter, or the place larger");
                    }
                    let ticks = self.program.tasks.values().map(|task| task.end_after).max();
                    let far = ticks.map(|ticks| step * ticks as f64);
                    if let Some(far) = far.filter(|far| learns && *far < width.min(height) / NEAR) {
                        let message = "the robot hardly moves in an episode";
                        let far = short(far);
                        let label =
                            format!("it gets {far} m far, in an arena of {width} m × {height} m");
                        self.warning(Code::W0402, field.value.span, message)
                            .label(label)
                            .help("make it faster, or the episodes longer");
                    }
                }
                RobotEntryKind::Sensor { name, value } => {
                    let mut sensors = robot.sensors.values();
                    let Some(sensor) = sensors.find(|sensor| sensor.name.is(&name.name)) else {
                        continue;
                    };
                    let (SensorKind::Scanner { range, .. }
                    | SensorKind::RangeFinder { range, .. }
                    | SensorKind::Beacon { range, .. }) = sensor.kind;
                    if sensor.noise >= range {
                        let message = format!("the sensor `{}` tells nothing", name.name);
                        let label = format!(
                            "its noise is {} m, its range {} m",
                            short(sensor.noise),
                            short(range)
                        );
                        self.warning(Code::W0402, value.span, message).label(label);
                    }
                    let echoes = !matches!(sensor.kind, SensorKind::Beacon { .. });
                    if echoes && range <= robot.radius {
                        let message = format!("the sensor `{}` never sees anything", name.name);
                        self.warning(Code::W0402, value.span, message)
                            .label("it sees no farther than the robot's own body reaches")
                            .note("its range begins at the robot's centre");
                    }
                }
                _ => {}
            }
        }
    }
}

/// Whether a place has all of the arena in it, as far as its bounds show.
pub(super) fn covers(place: &Shape, world: &World) -> bool {
    let ([left, bottom], [right, top]) = world.arena.bounds();
    let corners = [[left, bottom], [right, bottom], [left, top], [right, top]];
    place.is_convex() && corners.into_iter().all(|corner| place.contains(corner))
}

/// How wide a place is where it is widest, along an axis.
fn widest(place: &Shape) -> f64 {
    let (low, high) = place.bounds();
    let [width, height] = minus(high, low);
    width.max(height)
}

/// How far a wall that is within the arena in part reaches beyond it, if that is farther than the arena is wide.
fn beyond(wall: &Shape, world: &World) -> Option<f64> {
    let (low, high) = world.arena.bounds();
    let (from, to) = wall.bounds();
    let ([left, bottom], [right, top]) = (minus(low, from), minus(to, high));
    let (x, y) = (left.max(right), bottom.max(top));
    let [width, height] = minus(high, low);
    let meets = from[0] < high[0] && to[0] > low[0] && from[1] < high[1] && to[1] > low[1];
    (meets && (x > width || y > height)).then_some(x.max(y))
}
