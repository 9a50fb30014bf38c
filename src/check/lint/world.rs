//! Parts of a world that do nothing: walls outside the arena, places that coincide, places that no way leads to.

use super::geometry::{clearance, gap, is_free};
use super::starts::starts;
use crate::check::Checker;
use crate::check::builtin::Constant;
use crate::check::expr::plain_ref;
use crate::check::report::short;
use crate::diagnostic::{Code, Diagnostic};
use crate::geometry::{Point, Shape, minus};
use crate::ir::Name;
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::task::StartLine;
use crate::ir::world::{Place, World};
use crate::source::Span;
use crate::syntax::ast::{self, Ident, Item, ItemKind, RobotEntryKind, WorldEntryKind};
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::FRAC_1_SQRT_2;
use std::ops::Range;

/// The part of the free arena from which on a start that may be shut in is told.
const SHUT_IN: f64 = 0.002;

/// Where a body of this part of the size would fit everywhere, its size is the mistake.
const TENTH: f64 = 10.0;

/// The blocks of the grid on which ways are looked for, and the cells of a block, along each axis.
const BLOCKS: usize = 120;
const CELLS: usize = 4;

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
                self.places_out_of_reach(declared, &world, &anywhere);
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

    /// Places that no way leads to, or that the robot does not fit into; of most places for a body that is too large, one warning
    /// is enough.
    fn places_out_of_reach(&mut self, declared: &'a ast::World, world: &World, anywhere: &[Span]) {
        let (found, too_small) = self.out_of_reach(declared, world, anywhere);
        let is_place = |found: &&Diagnostic| found.code == Code::W0401;
        let apart: Vec<Span> = found
            .iter()
            .filter(is_place)
            .map(Diagnostic::span)
            .collect();
        let sent = self.sent_to();
        let wanted = places(declared, world).filter(|(.., it)| sent.contains(&it.name.to_string()));
        // What one gap keeps it from, that gap is the mistake of.
        let most = too_small > 0 && apart.len() >= 2 && 2 * apart.len() > wanted.count();
        let body = body(declared, world).filter(|_| most);
        let too_large = body.filter(|_| {
            let mut small = world.clone();
            small.robot.radius /= TENTH;
            let (left, _) = self.out_of_reach(declared, &small, &[]);
            !left.iter().any(|found| is_place(&found))
        });
        match too_large {
            Some(at) => {
                let message = "the robot is too large for most of the places that it is sent to";
                let width = short(2.0 * world.robot.radius);
                self.warning(Code::W0402, at, message)
                    .label(format!("it is {width} m wide"))
                    .and_at(&apart, "it does not get here");
            }
            None => self.diagnostics.extend(found),
        }
    }

    /// What is to be told of places that the robot does not get to, and how many of them it does not fit into.
    fn out_of_reach(
        &mut self,
        declared: &'a ast::World,
        world: &World,
        anywhere: &[Span],
    ) -> (Vec<Diagnostic>, usize) {
        let before = self.diagnostics.len();
        self.places_apart(declared, world, anywhere);
        let apart = self.diagnostics.len();
        self.places_too_small(declared, world);
        let too_small = self.diagnostics.len() - apart;
        (self.diagnostics.split_off(before), too_small)
    }

    /// Places that the robot is sent to and no way leads to: from where it starts, or if that may be anywhere from the one of
    /// these places from which it gets furthest. The grid is generous by less than a cell. Doors are open.
    fn places_apart(&mut self, declared: &'a ast::World, world: &World, anywhere: &[Span]) {
        let sent = self.sent_to();
        let wanted: Vec<_> = places(declared, world)
            .filter(|(.., place)| sent.contains(&place.name.to_string()))
            .collect();
        if wanted.is_empty() || world.walls.is_empty() {
            return;
        }
        let grid = Grid::new(world);
        let free = grid.free();
        let (from, reached) = match self.starts() {
            Some(starts) => (String::new(), grid.flood(&free, grid.near(&free, &starts))),
            None => {
                // Of several that get as far the first is taken, and one in reach of another gets no further than that.
                let mut ways: Vec<(String, Cells)> = Vec::new();
                for (name, _, place) in &wanted {
                    let starts = grid.near(&free, &[place.shape.center()]);
                    let within =
                        |(_, reached): &(_, Cells)| starts.iter().all(|at| reached.contains(*at));
                    if !ways.iter().any(within) {
                        ways.push((format!(" from `{}`", name.name), grid.flood(&free, starts)));
                    }
                }
                let furthest = ways.into_iter().rev();
                let furthest = furthest.max_by_key(|(_, reached)| reached.iter().count());
                match furthest {
                    Some(furthest) => furthest,
                    None => return,
                }
            }
        };
        // A start in a wall is reported where it is said.
        if reached.iter().next().is_none() {
            return;
        }
        let gets_to = |place: &Place, cells: &Cells| {
            let near =
                |at: Point| place.shape.contains(at) || clearance(&place.shape, at) <= grid.step;
            cells.iter().any(|cell| near(grid.center(cell)))
        };
        // One that the robot does not fit into is told as such.
        let is_apart = |place: &Place| !gets_to(place, &reached) && gets_to(place, &free);
        let apart = wanted.iter().filter(|(.., place)| is_apart(place));
        let apart: Vec<_> = apart.collect();
        for (name, span, _) in &apart {
            let message = format!("no way leads{from} to the place `{}`", name.name);
            self.warning(Code::W0401, *span, message)
                .label("the robot does not fit through to it");
        }
        // Where a place is apart, that is why a start may be.
        let shut = match apart.is_empty() {
            true => grid.shut_in(&free, &reached),
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

/// Where the body of the robot that learns is declared.
fn body(declared: &ast::World, world: &World) -> Option<Span> {
    declared.entries.iter().find_map(|entry| match &entry.kind {
        WorldEntryKind::Robot { name, entries, .. } if world.robot.name.is(&name.name) => {
            entries.iter().find_map(|entry| match &entry.kind {
                RobotEntryKind::Field(field) if field.name.name == "body" => Some(field.value.span),
                _ => None,
            })
        }
        _ => None,
    })
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

/// A cell, by its column and its row.
type Cell = (usize, usize);

/// Some cells, row by row in their columns.
struct Cells(Vec<bool>);

/// The cells along each axis.
const ALL: usize = BLOCKS * CELLS;

impl Cells {
    fn none() -> Self {
        Self(vec![false; ALL * ALL])
    }

    fn place((column, row): Cell) -> Option<usize> {
        (column < ALL && row < ALL).then(|| column * ALL + row)
    }

    fn contains(&self, cell: Cell) -> bool {
        Self::place(cell).is_some_and(|at| self.0.get(at).copied().unwrap_or_default())
    }

    /// Whether it was not among them before.
    fn insert(&mut self, cell: Cell) -> bool {
        let own = Self::place(cell).and_then(|at| self.0.get_mut(at));
        own.is_some_and(|own| !std::mem::replace(own, true))
    }

    fn iter(&self) -> impl Iterator<Item = Cell> {
        let all = self.0.iter().enumerate().filter(|(_, own)| **own);
        all.map(|(at, _)| (at / ALL, at % ALL))
    }
}

/// Square cells over the arena, and square blocks of them.
struct Grid<'w> {
    world: &'w World,
    low: Point,
    step: f64,
}

impl<'w> Grid<'w> {
    fn new(world: &'w World) -> Self {
        let (low, high) = world.arena.bounds();
        let [width, height] = minus(high, low);
        let step = width.max(height) / ALL as f64;
        Self { world, low, step }
    }

    fn center(&self, cell: Cell) -> Point {
        self.middle(cell, self.step)
    }

    /// The middle of a square of this grid, or of one whose squares have such sides.
    fn middle(&self, (column, row): Cell, side: f64) -> Point {
        let along = |low: f64, cell: usize| low + (cell as f64 + 0.5) * side;
        [along(self.low[0], column), along(self.low[1], row)]
    }

    /// The cells that a robot may pass: a way that it fits through goes no further than half a diagonal from the middle of
    /// each of its cells.
    fn free(&self) -> Cells {
        let radius = self.world.robot.radius - self.step * FRAC_1_SQRT_2;
        let radius = radius.max(self.step / 4.0);
        let side = self.step * CELLS as f64;
        let mut free = Cells::none();
        for block in square(0..BLOCKS, 0..BLOCKS) {
            // Within the block it changes by no more than this.
            let change = side * FRAC_1_SQRT_2;
            let gap = gap(self.world, self.middle(block, side));
            if gap < radius - change {
                continue;
            }
            let [columns, rows] = [block.0, block.1].map(|at| at * CELLS..(at + 1) * CELLS);
            for cell in square(columns, rows) {
                if gap >= radius + change || self.fits(cell, radius) {
                    free.insert(cell);
                }
            }
        }
        free
    }

    /// Whether a body with this radius fits in the middle of a cell.
    fn fits(&self, cell: Cell, radius: f64) -> bool {
        gap(self.world, self.center(cell)) >= radius
    }

    /// The part of the arena in which the robot fits that is not among the cells which were reached. One cell of each block is
    /// asked.
    fn shut_in(&self, free: &Cells, reached: &Cells) -> f64 {
        let (mut shut, mut count) = (0, 0);
        for (column, row) in square(0..BLOCKS, 0..BLOCKS) {
            let cell = (column * CELLS + CELLS / 2, row * CELLS + CELLS / 2);
            if free.contains(cell) && self.fits(cell, self.world.robot.radius) {
                count += 1;
                shut += usize::from(!reached.contains(cell));
            }
        }
        shut as f64 / f64::max(count as f64, 1.0)
    }

    /// The free cells around some points.
    fn near(&self, free: &Cells, points: &[Point]) -> Vec<Cell> {
        let mut found = Vec::new();
        for point in points {
            let [column, row] = minus(*point, self.low).map(|way| (way / self.step) as usize);
            let around = |at: usize| at.saturating_sub(1)..at.saturating_add(2);
            let cells = square(around(column), around(row));
            found.extend(cells.filter(|cell| free.contains(*cell)));
        }
        found
    }

    /// The free cells that ways lead to from some of them.
    fn flood(&self, free: &Cells, mut open: Vec<Cell>) -> Cells {
        let mut reached = Cells::none();
        open.retain(|cell| reached.insert(*cell));
        while let Some((column, row)) = open.pop() {
            for next in [
                (column + 1, row),
                (column, row + 1),
                (column.wrapping_sub(1), row),
                (column, row.wrapping_sub(1)),
            ] {
                if free.contains(next) && reached.insert(next) {
                    open.push(next);
                }
            }
        }
        reached
    }
}

/// All cells in these columns and rows.
fn square(columns: Range<usize>, rows: Range<usize>) -> impl Iterator<Item = Cell> {
    columns.flat_map(move |column| rows.clone().map(move |row| (column, row)))
}
