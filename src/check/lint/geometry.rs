//! Room for robots and places: what stands in a wall.

use crate::check::Checker;
use crate::diagnostic::Code;
use crate::geometry::{Point, Shape, dot, minus};
use crate::ir::Name;
use crate::ir::world::{Wall, World};
use crate::syntax::ast::{self, Item, ItemKind, RobotEntryKind, WorldEntryKind};

/// What a length may be off.
const SLACK: f64 = 1e-6;

impl<'a> Checker<'a> {
    /// Reports places that lie in a wall with all that belongs to them, and starts where the robot does not fit.
    pub fn blocked_places(&mut self, items: impl Iterator<Item = &'a Item>) {
        let Some(world) = self.program.world.clone() else {
            return;
        };
        for item in items {
            let ItemKind::World(declared) = &item.kind else {
                continue;
            };
            if self.bodies_too_large(declared, &world) {
                return;
            }
            for entry in &declared.entries {
                let WorldEntryKind::Place { name, shape, .. } = &entry.kind else {
                    continue;
                };
                let place = world.places.named(&Name::word(&name.name));
                let wall = place.and_then(|place| {
                    let place = &world.places[place];
                    let mut walls = standing(&world);
                    walls.find(|wall| holds(&wall.shape, &place.shape))
                });
                if let Some(wall) = wall {
                    let message =
                        format!("the place `{}` lies in the wall `{}`", name.name, wall.name);
                    self.error(Code::E0404, shape.span, message)
                        .label("no robot could be there, or see it");
                }
            }
        }
        for (span, robot, at) in std::mem::take(&mut self.positions) {
            let is_acting = robot == World::acting();
            let robot = world.robot_of(robot);
            if let Some(what) = obstacle(&world, at, robot.radius) {
                let who = match is_acting {
                    true => "the robot".to_owned(),
                    false => format!("the robot `{}`", robot.name),
                };
                let message = format!("{who} does not fit where it is to start");
                self.error(Code::E0404, span, message).label(what);
            }
        }
    }
}

impl<'a> Checker<'a> {
    /// Reports robots that are wider than the arena, and says whether there are any.
    fn bodies_too_large(&mut self, declared: &'a ast::World, world: &World) -> bool {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        let mut any = false;
        for entry in &declared.entries {
            let WorldEntryKind::Robot { name, entries, .. } = &entry.kind else {
                continue;
            };
            let mut robots = world.robots();
            let robot = robots.find(|robot| robot.name.is(&name.name));
            let body = entries.iter().find_map(|entry| match &entry.kind {
                RobotEntryKind::Field(field) if field.name.name == "body" => Some(&field.value),
                _ => None,
            });
            let Some((robot, body)) = robot.zip(body) else {
                continue;
            };
            if 2.0 * robot.radius >= width.min(height) {
                let message = format!("the robot `{}` does not fit into the arena", name.name);
                self.error(Code::E0409, body.span, message)
                    .label(format!("it is {} m wide", 2.0 * robot.radius))
                    .note(format!("the arena is {width} m × {height} m"));
                any = true;
            }
        }
        any
    }
}

/// Whether a solid wall holds the whole of a shape, as far as its centre and its rim show.
fn holds(wall: &Shape, shape: &Shape) -> bool {
    let rim = match shape {
        Shape::Disc {
            center: [x, y],
            radius,
        } => {
            let r = radius * std::f64::consts::FRAC_1_SQRT_2;
            vec![
                [x + radius, *y],
                [x + r, y + r],
                [*x, y + radius],
                [x - r, y + r],
                [x - radius, *y],
                [x - r, y - r],
                [*x, y - radius],
                [x + r, y - r],
            ]
        }
        other => other.corners(),
    };
    wall.contains(shape.center()) && rim.into_iter().all(|point| wall.contains(point))
}

/// What is in the way of a robot of this radius at a point, in words.
fn obstacle(world: &World, at: Point, radius: f64) -> Option<String> {
    if !world.arena.contains(at) {
        return Some("this is outside the arena".to_owned());
    }
    if clearance(&world.arena, at) < radius - SLACK {
        return Some("its body would reach over the boundary of the arena".to_owned());
    }
    let mut walls = standing(world);
    let wall = walls.find(|wall| is_in_the_way(&wall.shape, at, radius))?;
    Some(if wall.shape.contains(at) {
        format!("this is in the wall `{}`", wall.name)
    } else {
        format!("its body would touch the wall `{}`", wall.name)
    })
}

/// Whether a robot of this radius fits at a point.
pub fn is_free(world: &World, at: Point, radius: f64) -> bool {
    let mut walls = standing(world);
    world.arena.contains(at)
        && clearance(&world.arena, at) >= radius
        && !walls.any(|wall| is_in_the_way(&wall.shape, at, radius))
}

fn is_in_the_way(wall: &Shape, at: Point, radius: f64) -> bool {
    wall.contains(at) || clearance(wall, at) < radius - SLACK
}

/// How far a point of the arena is from all walls that always stand, and from its rim: less than nothing in a wall, or outside.
/// From one point to another it changes by no more than their distance.
pub fn gap(world: &World, at: Point) -> f64 {
    let signed = |shape: &Shape| match shape.contains(at) {
        true => clearance(shape, at),
        false => -clearance(shape, at),
    };
    let walls = standing(world).map(|wall| -signed(&wall.shape));
    walls.fold(signed(&world.arena), f64::min)
}

/// How far a point is from the rim of a shape.
pub fn clearance(shape: &Shape, at: Point) -> f64 {
    let distance = |way: Point| dot(way, way).sqrt();
    let outline = shape.outline();
    let outline = outline.iter().map(|segment| distance(segment.nearest(at)));
    let rim = shape.rim().map(|circle| distance(circle.nearest(at)));
    outline.chain(rim).fold(f64::INFINITY, f64::min)
}

/// The walls that always stand.
fn standing(world: &World) -> impl Iterator<Item = &Wall> {
    world.walls.values().filter(|wall| wall.when.is_none())
}
