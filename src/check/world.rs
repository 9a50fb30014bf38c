//! The world: arena, walls, places and the robot.

pub mod robot;
pub mod sensor;
pub mod setting;
pub mod shape;

use super::Checker;
use super::context::{Context, Region};
use super::types::Type;
use crate::diagnostic::{Applicability, Code};
use crate::geometry::Shape;
use crate::ir::Name;
use crate::ir::table::Table;
use crate::ir::world::{Place, Wall, World};
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind, Item, ItemKind, Literal, WorldEntryKind};
use robot::no_robot;
use std::ops::RangeInclusive;

/// How long a tick may take, in seconds.
const TICK: RangeInclusive<f64> = 1e-6..=3600.0;

impl<'a> Checker<'a> {
    /// The one world of a program.
    pub fn worlds(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut first: Option<&'a ast::World> = None;
        for item in items {
            let ItemKind::World(world) = &item.kind else {
                continue;
            };
            match first {
                None => first = Some(world),
                Some(first) => self
                    .error(Code::E0401, world.name.span, "a program has one world")
                    .label("a second world")
                    .also(first.name.span, "the first is declared here")
                    .emit(),
            }
        }
        if let Some(world) = first {
            self.has_world = true;
            self.context = Context::new(Region::World);
            self.world(world);
        } else if self.names.lost_world {
            self.has_world = true;
            self.drive_unsure = true;
            self.robots_unsure = true;
            self.stand_in(Name::default(), None);
        }
    }

    /// A world with nothing in it yet; its tick may not be known.
    fn stand_in(&mut self, name: Name, arena: Option<Shape>) {
        self.program.world = Some(World {
            name,
            tick: self.tick.unwrap_or(0.1),
            arena: arena.unwrap_or_else(no_shape),
            walls: Table::default(),
            places: Table::default(),
            robot: no_robot(),
            others: Table::default(),
        });
    }

    /// The tick comes first, since everything may be counted in it; places may be referred to by sensors, so the robot
    /// comes last.
    fn world(&mut self, world: &'a ast::World) {
        let fields = world.entries.iter().filter_map(|entry| match &entry.kind {
            WorldEntryKind::Field(field) => Some(field),
            _ => None,
        });
        let [tick, arena] = self.fields(fields, ["tick", "arena"], "a world");
        for (field, name, example) in [
            (tick, "tick", "tick = 100 ms"),
            (arena, "arena", "arena = rect((0 m, 0 m), (6 m, 4 m))"),
        ] {
            if field.is_none() {
                self.missing(Code::E0402, world.name.span, "the world", name, example);
            }
        }
        // What is not understood may be the robot.
        let is_lost = |entry: &ast::WorldEntry| entry.kind == WorldEntryKind::Error;
        self.entries_lost = world.entries.iter().any(is_lost);
        self.drive_unsure |= self.entries_lost;
        self.robots_unsure |= self.entries_lost;
        self.tick = tick.and_then(|field| self.tick(&field.value));
        let arena_field = arena;
        let arena = arena.and_then(|field| self.arena(&field.value));
        self.stand_in(Name::word(&world.name.name), arena.clone());
        let mut outside: Vec<(&'a ast::Ident, Span)> = Vec::new();
        let mut places = 0;
        for entry in &world.entries {
            match &entry.kind {
                WorldEntryKind::Place {
                    name,
                    of_kind,
                    shape,
                    facing,
                } => {
                    // One that is declared again is no second member.
                    if !self.names.counts(name) {
                        self.shape_of(shape, "a place");
                        continue;
                    }
                    let kind = of_kind.as_ref().map(|kind| kind.name.clone());
                    self.kinds.places.push((Name::word(&name.name), kind));
                    let away = self.place(name, shape, facing.as_ref(), arena.as_ref());
                    outside.extend(away.then_some((name, shape.span)));
                    places += 1;
                }
                WorldEntryKind::Wall {
                    name,
                    of_kind,
                    shape,
                    ..
                } => {
                    if !self.names.counts(name) {
                        self.shape_of(shape, "a wall");
                        continue;
                    }
                    let kind = of_kind.as_ref().map(|kind| kind.name.clone());
                    self.kinds.walls.push((Name::word(&name.name), kind));
                    self.wall(name, shape);
                }
                _ => {}
            }
        }
        self.places_outside(&outside, places, arena_field.map(|field| field.value.span));
        self.robots(world);
    }

    /// Reports places that lie outside the arena; where all of several do, the arena.
    fn places_outside(
        &mut self,
        outside: &[(&'a ast::Ident, Span)],
        places: usize,
        arena: Option<Span>,
    ) {
        if let (Some(arena), true) = (arena, places > 1 && outside.len() == places) {
            self.error(Code::E0404, arena, "all places lie outside the arena")
                .label("is it as large as it was meant to be?");
            return;
        }
        for (name, span) in outside {
            let message = format!("the place `{}` lies outside the arena", name.name);
            self.error(Code::E0404, *span, message)
                .label("its centre is out of every robot's reach");
        }
    }

    /// The length of a tick in seconds.
    fn tick(&mut self, value: &'a Expr) -> Option<f64> {
        let role = "the length of a tick";
        // So many seconds would be a long tick.
        if let ExprKind::Number(Literal {
            value: number,
            unit: None,
            ..
        }) = &value.kind
            && *number > 1.0
        {
            let message = format!("{role} is a time (s), not a plain number");
            return self
                .error(Code::E0301, value.span, message)
                .this_is(Type::NUMBER)
                .fix(
                    "give it its unit, ` ms`",
                    value.span.after(),
                    " ms",
                    Applicability::Unsafe,
                )
                .none();
        }
        let tick = self.constant(value, &Type::TIME, role)?;
        if TICK.contains(&tick) {
            return Some(tick);
        }
        let (message, label) = if tick <= 0.0 {
            ("a tick takes time", "the world would stand still")
        } else if tick < 1.0 {
            (
                "a tick takes a microsecond or more",
                "no episode would get anywhere",
            )
        } else {
            (
                "a tick takes an hour or less",
                "the robot would not act in time",
            )
        };
        self.out_of_range(value.span, message, label).none()
    }

    fn arena(&mut self, value: &'a Expr) -> Option<Shape> {
        let shape = self.shape_of(value, "the arena")?;
        if matches!(shape, Shape::Polyline(_)) {
            return self
                .error(Code::E0404, value.span, "an arena encloses an area")
                .label("a line has none")
                .none();
        }
        Some(shape)
    }

    /// `wall … when condition`: checked once the states are known.
    pub fn conditions_of_walls(&mut self, world: &'a ast::World) {
        for entry in &world.entries {
            if let WorldEntryKind::Wall {
                name,
                when: Some(when),
                ..
            } = &entry.kind
            {
                self.context = Context::new(Region::Predicate);
                let stands = self.expect(when, &Type::Bool, "the condition of a wall");
                self.asks(when.span, stands.scalar());
                let name = Name::word(&name.name);
                if let (Some(when), Some(world)) = (stands.scalar(), &mut self.program.world)
                    && let Some(wall) = world.walls.named(&name)
                {
                    world.walls[wall].when = Some(when);
                }
            }
        }
    }

    /// Declares a place; whether it lies outside the arena.
    fn place(
        &mut self,
        name: &'a ast::Ident,
        shape: &'a Expr,
        facing: Option<&'a Expr>,
        arena: Option<&Shape>,
    ) -> bool {
        let shape = self.shape_of(shape, "a place");
        // One that is wrong is one nevertheless.
        let facing = facing.map(|facing| {
            let angle = self.constant(facing, &Type::ANGLE, "`facing`");
            angle.unwrap_or_default()
        });
        let Some(shape) = shape else {
            let name = Name::word(&name.name);
            self.kinds.unknown.insert(name.clone());
            if let Some(world) = &mut self.program.world {
                let shape = no_shape();
                world.places.push(Place {
                    name,
                    shape,
                    facing: None,
                });
            }
            return false;
        };
        let outside = arena.is_some_and(|arena| !arena.contains(shape.center()));
        if let Some(world) = &mut self.program.world {
            world.places.push(Place {
                name: Name::word(&name.name),
                shape,
                facing: facing.map(crate::math::wrap),
            });
        }
        outside
    }

    fn wall(&mut self, name: &'a ast::Ident, shape: &'a Expr) {
        let shape = self.shape_of(shape, "a wall");
        let name = Name::word(&name.name);
        if shape.is_none() {
            self.kinds.unknown.insert(name.clone());
        }
        if let Some(world) = &mut self.program.world {
            let shape = shape.unwrap_or_else(no_shape);
            let when = None;
            world.walls.push(Wall { name, shape, when });
        }
    }
}

/// What stands for a shape that was not understood.
fn no_shape() -> Shape {
    Shape::Disc {
        center: [0.0; 2],
        radius: 1.0,
    }
}
