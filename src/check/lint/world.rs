//! Parts of a world that do nothing: walls outside the arena, places that coincide, places that no way leads to.

use super::geometry::{clearance, is_free};
use super::starts::starts;
use crate::check::Checker;
use crate::check::builtin::Constant;
use crate::check::expr::plain_ref;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::{Point, Shape, minus};
use crate::ir::Name;
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::task::StartLine;
use crate::ir::world::{Place, World};
use crate::source::Span;
use crate::syntax::ast::{self, Ident, Item, ItemKind, RobotEntryKind, WorldEntryKind};
use rustc_hash::FxHashSet;
use std::collections::{BTreeMap, BTreeSet};

/// The part of the free arena from which on a start that may be shut in is told.
const SHUT_IN: f64 = 0.002;

/// The most cells of the grid on which ways are looked for, along each axis.
const CELLS: usize = 120;

impl<'a> Checker<'a> {
    /// Warns of walls and places that cannot matter.
    pub fn world_without_effect(&mut self, items: impl Iterator<Item = &'a Item>) {
        let Some(world) = self.program.world.clone() else {
            return;
        };
        let items: Vec<&Item> = items.collect();
        let anywhere: Vec<Span> = items.iter().flat_map(|item| anywhere(item)).collect();
        for item in items {
            if let ItemKind::World(declared) = &item.kind {
                self.walls_outside(declared, &world);
                self.walls_alike(declared, &world);
                self.sensors_alike(declared, &world);
                self.places_alike(declared, &world);
                self.places_apart(declared, &world, &anywhere);
                self.places_too_small(declared, &world);
            }
        }
    }

    fn walls_outside(&mut self, declared: &'a ast::World, world: &World) {
        let (low, high) = world.arena.bounds();
        for entry in &declared.entries {
            let WorldEntryKind::Wall { name, shape, .. } = &entry.kind else {
                continue;
            };
            let Some(wall) = world.walls.named(&Name::word(&name.name)) else {
                continue;
            };
            let (from, to) = world.walls[wall].shape.bounds();
            let apart = |low: Point, high: Point| low[0] >= high[0] || low[1] >= high[1];
            if apart(low, to) || apart(from, high) {
                let message = format!("the wall `{}` lies outside the arena", name.name);
                self.warning(Code::W0401, shape.span, message)
                    .label("no robot meets it");
            }
        }
    }

    /// Walls that are there once already. Those that stand at times may take turns.
    fn walls_alike(&mut self, declared: &'a ast::World, world: &World) {
        let walls = declared.entries.iter().filter_map(|entry| {
            let WorldEntryKind::Wall { name, shape, .. } = &entry.kind else {
                return None;
            };
            let wall = &world.walls[world.walls.named(&Name::word(&name.name))?];
            let stands = wall.when.is_none();
            stands.then(|| (format!("{:?}", wall.shape), name, shape.span))
        });
        for [(first, at), (name, here)] in alike(walls) {
            let message = format!("the walls `{}` and `{}` coincide", first.name, name.name);
            self.the_same(here, message, "wall", at);
        }
    }

    /// Sensors of a robot that read the same. Of two with noise, each has its own.
    fn sensors_alike(&mut self, declared: &'a ast::World, world: &World) {
        for entry in &declared.entries {
            let WorldEntryKind::Robot { name, entries, .. } = &entry.kind else {
                continue;
            };
            let Some(robot) = world.robots().find(|robot| robot.name.is(&name.name)) else {
                continue;
            };
            let sensors = entries.iter().filter_map(|entry| {
                let RobotEntryKind::Sensor { name, value } = &entry.kind else {
                    return None;
                };
                let mut sensors = robot.sensors.values();
                let sensor = sensors.find(|sensor| sensor.name.is(&name.name))?;
                let exact = sensor.noise == 0.0;
                exact.then(|| (format!("{:?}", sensor.kind), name, value.span))
            });
            for [(first, at), (name, here)] in alike(sensors) {
                let message = format!("`{}` and `{}` read the same", first.name, name.name);
                self.the_same(here, message, "sensor", at);
            }
        }
    }

    fn places_alike(&mut self, declared: &'a ast::World, world: &World) {
        let places = places(declared, world).map(|(name, span, place)| {
            (format!("{:?} {:?}", place.shape, place.facing), name, span)
        });
        for [(first, at), (name, here)] in alike(places) {
            let message = format!("the places `{}` and `{}` coincide", first.name, name.name);
            self.the_same(here, message, "place", at);
        }
    }

    fn the_same(&mut self, here: Span, message: String, what: &str, first: Span) {
        self.warning(Code::W0401, here, message)
            .label(format!("the same {what} under another name"))
            .also(first, "the first");
    }

    /// Places that the robot is sent to and no way leads to: from where it starts, or if that may be anywhere from the one of
    /// these places from which it gets furthest. The grid is generous: a robot a cell smaller than this one would not get
    /// there. Doors are open.
    fn places_apart(&mut self, declared: &'a ast::World, world: &World, anywhere: &[Span]) {
        let sent = self.sent_to();
        let wanted: Vec<_> = places(declared, world)
            .filter(|(.., place)| sent.contains(&place.name.to_string()))
            .collect();
        if wanted.is_empty() || world.walls.is_empty() {
            return;
        }
        let grid = Grid::new(world);
        let free = grid.free(world);
        let (from, reached) = match self.starts() {
            Some(starts) => (String::new(), grid.flood(&free, grid.near(&free, &starts))),
            None => {
                // Of several that get as far the first is taken, and one in reach of another gets no further than that.
                let mut ways: Vec<(String, Cells)> = Vec::new();
                for (name, _, place) in &wanted {
                    let starts = grid.near(&free, &[place.shape.center()]);
                    let within =
                        |(_, reached): &(_, Cells)| starts.iter().all(|at| reached.contains(at));
                    if !ways.iter().any(within) {
                        ways.push((format!(" from `{}`", name.name), grid.flood(&free, starts)));
                    }
                }
                let furthest = ways.into_iter().rev();
                let furthest = furthest.max_by_key(|(_, reached)| reached.len());
                furthest.unwrap_or_default()
            }
        };
        // A start in a wall is reported where it is said.
        if reached.is_empty() {
            return;
        }
        let is_reached = |place: &Place| {
            let near =
                |at: Point| place.shape.contains(at) || clearance(&place.shape, at) <= grid.step;
            reached.iter().any(|cell| near(grid.center(*cell)))
        };
        let apart = wanted.iter().filter(|(.., place)| !is_reached(place));
        let apart: Vec<_> = apart.collect();
        for (name, span, _) in &apart {
            let message = format!("no way leads{from} to the place `{}`", name.name);
            self.warning(Code::W0401, *span, message)
                .label("the robot does not fit through to it");
        }
        // Where a place is apart, that is why a start may be.
        let shut = match apart.is_empty() {
            true => grid.shut_in(world, &free, &reached),
            false => 0.0,
        };
        for at in anywhere.iter().filter(|_| shut >= SHUT_IN) {
            let message = "an episode may start where walls shut the robot in";
            let part = 100.0 * shut;
            self.warning(Code::W0310, *at, message)
                .label(format!(
                    "about {part:.1} % of the free arena: no way leads from there to where the robot is sent"
                ))
                .help("leave a way out, fill that part with a wall, or start in a place: `pose = anywhere(PLACE)`");
        }
    }

    /// The places that a robot is sent to.
    pub(super) fn sent_to(&self) -> BTreeSet<String> {
        let behaviors = self.program.behaviors.values();
        let sent = behaviors.filter(|behavior| behavior.name.family == "goto");
        let targets = sent.filter_map(|behavior| behavior.name.given().next());
        targets.map(|(_, given)| given.to_string()).collect()
    }

    /// Places in which the robot is to be, or which it is to dock at, and does not fit so near to.
    fn places_too_small(&mut self, declared: &'a ast::World, world: &World) {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        if width.min(height) <= 2.0 * world.robot.radius {
            return;
        }
        let near = |place: &Place| {
            let needs = self.program.behaviors.values().filter_map(|behavior| {
                let given = behavior.name.given().next();
                let at = given.map(|(_, given)| given.to_string())?;
                match behavior.name.family.as_str() {
                    _ if at != place.name.to_string() => None,
                    "goto" => Some(0.0),
                    "dock" => self.at_most(behavior.law.as_ref()?.requires),
                    _ => None,
                }
            });
            needs.reduce(f64::min)
        };
        let wanted: Vec<_> = places(declared, world)
            .filter_map(|(name, span, place)| Some((name, span, place, near(place)?)))
            .collect();
        for (name, span, place, near) in wanted {
            let said = |it: &Diagnostic| it.span() == span;
            if has_room(world, &place.shape, near) || self.diagnostics.iter().any(said) {
                continue;
            }
            let message = format!("the robot does not fit into the place `{}`", name.name);
            let radius = world.robot.radius * 100.0;
            let label = match near {
                0.0 => "its centre never lies in it: it would touch a wall".to_owned(),
                near => format!("it comes no nearer than {} cm to it", near * 100.0),
            };
            self.warning(Code::W0401, span, message)
                .label(label)
                .help(format!(
                    "make the place larger, or move it: the robot keeps {radius} cm from every wall"
                ));
        }
    }

    /// The constant that a distance is at most, where that is asked, or the greater of two.
    fn at_most(&self, asked: ExprId) -> Option<f64> {
        let pool = &self.program.pool;
        match pool.get(asked) {
            Expr::Binary(Binary::Or, one, other) => {
                let either = [one, other].into_iter();
                either.filter_map(|it| self.at_most(it)).reduce(f64::max)
            }
            Expr::Binary(Binary::Le, distance, most) => {
                let is_distance = matches!(pool.get(distance), Expr::Binary(Binary::Hypot, ..));
                pool.constant(most).filter(|_| is_distance)
            }
            _ => None,
        }
    }

    /// Where episodes start; `None` if some may start anywhere.
    fn starts(&self) -> Option<Vec<Point>> {
        let tasks = self.program.tasks.values().map(|task| &task.start);
        let learners = self.program.learners.values().map(|learner| &learner.start);
        let fixed = |lines: &Vec<StartLine>| {
            lines.iter().find_map(|line| match line {
                StartLine::Position(x, y) => {
                    let pool = &self.program.pool;
                    Some([pool.constant(*x)?, pool.constant(*y)?])
                }
                _ => None,
            })
        };
        let starts: Option<Vec<Point>> = tasks.chain(learners).map(fixed).collect();
        starts.filter(|starts| !starts.is_empty())
    }
}

/// Of things with a text that says all of them but their names, those that are there already, each behind the first.
fn alike<'a>(
    things: impl Iterator<Item = (String, &'a Ident, Span)>,
) -> Vec<[(&'a Ident, Span); 2]> {
    let mut seen: BTreeMap<String, (&'a Ident, Span)> = BTreeMap::new();
    let pairs =
        things.map(|(what, name, at)| [*seen.entry(what).or_insert((name, at)), (name, at)]);
    pairs.filter(|[(_, first), (_, at)]| first != at).collect()
}

/// The lines of an item by which episodes start anywhere.
fn anywhere(item: &Item) -> Vec<Span> {
    let is_anywhere = |value: &&ast::Expr| {
        let named = plain_ref(value);
        named.is_some_and(|it| it.name.name == Constant::Anywhere.name() && it.args.is_none())
    };
    let lines = starts(item).into_iter().flat_map(|start| &start.lines);
    let values = lines
        .filter(|line| line.target.name.name == "pose" && line.target.args.is_none())
        .map(|line| &line.value);
    values.filter(is_anywhere).map(|value| value.span).collect()
}

/// The places of a world as they are declared, each with the place of its shape.
fn places<'a, 'w>(
    declared: &'a ast::World,
    world: &'w World,
) -> impl Iterator<Item = (&'a Ident, Span, &'w Place)> {
    declared.entries.iter().filter_map(|entry| {
        let WorldEntryKind::Place { name, shape, .. } = &entry.kind else {
            return None;
        };
        let place = world.places.named(&Name::word(&name.name))?;
        Some((name, shape.span, &world.places[place]))
    })
}

/// Into how many steps the surroundings of a place are divided along each axis.
const STEPS: usize = 60;

/// Whether a robot fits somewhere within `near` of a shape, with a little to spare.
fn has_room(world: &World, shape: &Shape, near: f64) -> bool {
    let (low, high) = shape.bounds();
    let [width, height] = minus(high, low);
    let step = (width.max(height) + 2.0 * near) / STEPS as f64;
    let radius = (world.robot.radius - 2.0 * step).max(0.0);
    let middle = shape.center();
    let along = |middle: f64, at: usize| middle + (at as f64 - STEPS as f64 / 2.0) * step;
    let points = (0..=STEPS).flat_map(|column| {
        (0..=STEPS).map(move |row| [along(middle[0], column), along(middle[1], row)])
    });
    let reaches = |at: Point| shape.contains(at) || clearance(shape, at) <= near;
    let mut points = points.filter(|at| reaches(*at));
    points.any(|at| is_free(world, at, radius))
}

/// A cell by its column and its row.
type Cell = (usize, usize);

/// Some cells, in no order.
type Cells = FxHashSet<Cell>;

/// Square cells over the arena.
struct Grid {
    low: Point,
    step: f64,
}

impl Grid {
    fn new(world: &World) -> Self {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        let step = width.max(height) / CELLS as f64;
        Self { low, step }
    }

    fn center(&self, (column, row): Cell) -> Point {
        let along = |low: f64, cell: usize| low + (cell as f64 + 0.5) * self.step;
        [along(self.low[0], column), along(self.low[1], row)]
    }

    /// The cells in which a robot a cell smaller fits.
    fn free(&self, world: &World) -> Cells {
        let radius = (world.robot.radius - self.step).max(self.step / 4.0);
        let cells = (0..CELLS).flat_map(|column| (0..CELLS).map(move |row| (column, row)));
        cells
            .filter(|cell| is_free(world, self.center(*cell), radius))
            .collect()
    }

    /// The part of the arena in which the robot fits that is not among the cells which were reached.
    fn shut_in(&self, world: &World, free: &Cells, reached: &Cells) -> f64 {
        let fits = |cell: &&Cell| is_free(world, self.center(**cell), world.robot.radius);
        let all = free.iter().filter(fits);
        let (mut shut, mut count) = (0, 0);
        for cell in all {
            count += 1;
            shut += usize::from(!reached.contains(cell));
        }
        shut as f64 / f64::max(count as f64, 1.0)
    }

    /// The free cells next to some points.
    fn near(&self, free: &Cells, points: &[Point]) -> Vec<Cell> {
        let next_to = |cell: &Cell, point: Point| {
            let [dx, dy] = minus(self.center(*cell), point);
            dx.abs().max(dy.abs()) <= self.step
        };
        let near = |cell: &&Cell| points.iter().any(|point| next_to(cell, *point));
        free.iter().filter(near).copied().collect()
    }

    /// The free cells that ways lead to from some of them.
    fn flood(&self, free: &Cells, mut open: Vec<Cell>) -> Cells {
        let mut reached: Cells = open.iter().copied().collect();
        while let Some((column, row)) = open.pop() {
            for next in [
                (column + 1, row),
                (column, row + 1),
                (column.wrapping_sub(1), row),
                (column, row.wrapping_sub(1)),
            ] {
                if free.contains(&next) && reached.insert(next) {
                    open.push(next);
                }
            }
        }
        reached
    }
}
