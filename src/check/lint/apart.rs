//! How near a robot's centre comes to what its body does not go into: walls, and other robots.

use super::ranges::range;
use super::view::View;
use crate::check::report::short;
use crate::geometry::{Point, minus};
use crate::ir::expr::{Binary, Echo, Expr, ExprId, Pose, Unary};
use crate::ir::world::{Robot, Sensor, SensorKind, World};
use crate::ir::{Id, Program};
use crate::math::hypot;

/// What bodies in touch are nearer than their radii say, at most: a bound that no rounding reaches.
pub const SLACK: f64 = 1e-6;

/// What a length is off that is told in centimetres.
const ROUNDED: f64 = 1e-5;

/// The least distance that an expression can be, in metres, if it is one from a robot's centre to a wall or to
/// another robot, or what a sensor without noise measures to them.
pub fn least(View { program, robot, .. }: View, id: ExprId) -> Option<f64> {
    let world = program.world.as_ref()?;
    let radius = |id| world.robot_of(id).radius;
    let bound = match program.pool.get(id) {
        Expr::NearestWall(Echo::Distance) if !has_doors(world) => radius(robot),
        Expr::Wall(wall, Echo::Distance) if world.walls[wall].when.is_none() => radius(robot),
        Expr::Sensor(sensor, Echo::Distance) if !has_doors(world) => {
            echo(&world.robot_of(robot).sensors[sensor])?.min(radius(robot))
        }
        _ => {
            let both = robots(program, id)?.map(|of| of.unwrap_or(robot));
            both.map(radius).iter().sum()
        }
    };
    Some(bound - SLACK)
}

/// The most that the distance to the nearest wall, or to one wall, can be: the arena ends somewhere.
pub fn most(View { program, .. }: View, id: ExprId) -> Option<f64> {
    let world = program.world.as_ref()?;
    let (low, high) = world.arena.bounds();
    let [width, height] = minus(high, low);
    let bound = match program.pool.get(id) {
        Expr::NearestWall(Echo::Distance) => width.min(height) / 2.0,
        Expr::Wall(wall, Echo::Distance) => {
            let shape = &world.walls[wall].shape;
            let center = shape.rim().map(|_| shape.center());
            let points = shape.corners().into_iter().chain(center);
            let corners = [low, [low[0], high[1]], [high[0], low[1]], high];
            let farthest = |from: Point| {
                let ways = corners.map(|corner| minus(corner, from));
                ways.map(|[x, y]| hypot(x, y))
                    .into_iter()
                    .fold(0.0, f64::max)
            };
            points.map(farthest).reduce(f64::min)?
        }
        _ => return None,
    };
    Some(bound + SLACK)
}

/// How far a sensor reads that measures what bodies do not go into, exactly.
fn echo(sensor: &Sensor) -> Option<f64> {
    match sensor.kind {
        SensorKind::Scanner { range, .. } | SensorKind::RangeFinder { range, .. } => {
            (sensor.noise == 0.0).then_some(range)
        }
        SensorKind::Beacon { .. } => None,
    }
}

/// A number that is compared with a constant, and that constant.
fn compared(program: &Program, part: ExprId) -> Option<(ExprId, f64)> {
    let Expr::Binary(Binary::Lt | Binary::Le, one, other) = program.pool.get(part) else {
        return None;
    };
    match [one, other].map(|id| program.pool.constant(id)) {
        [None, Some(with)] => Some((one, with)),
        [Some(with), None] => Some((other, with)),
        _ => None,
    }
}

/// Why a condition may hold never or always, as a note: it compares a distance with less or more than it can be, or asks for a line
/// of sight where nothing is in the way.
pub fn because<'p>(view: impl Into<View<'p>>, condition: ExprId) -> Option<String> {
    let view = view.into();
    let program = view.program;
    let world = program.world.as_ref()?;
    let too_near = |part: ExprId| {
        let (compared, with) = compared(program, part)?;
        let mut parts = parts(program, compared).into_iter();
        parts.find_map(|id| Some((id, least(view, id).filter(|least| *least >= with - SLACK)?)))
    };
    let asked = conditions(program, condition);
    let Some((distance, least)) = asked.iter().find_map(|part| too_near(*part)) else {
        return beyond(view, &asked);
    };
    let centimetres = ((least + SLACK) * 1000.0).round() / 10.0;
    let of = match robots(program, distance) {
        None => "a wall".to_owned(),
        Some(both) => {
            let name = |id| format!("`{}`", world.robot_of(id).name.bare());
            let robots = both.into_iter().flatten().map(name);
            robots.collect::<Vec<_>>().join(" or ")
        }
    };
    Some(format!(
        "distances are from the robot's centre, which comes no nearer than {centimetres} cm to {of}: there the bodies touch"
    ))
}

/// Why one of these conditions, the first of which is the whole, may hold never or always: it compares a distance with more than the
/// arena has room for, or asks whether something is seen where nothing is in the way.
fn beyond(view: View, asked: &[ExprId]) -> Option<String> {
    let program = view.program;
    let world = program.world.as_ref()?;
    let whole = asked.first().map(|whole| program.pool.get(*whole));
    if view.open && matches!(whole, Some(Expr::Visible(..))) {
        return Some(
            "no wall is in this world, and no corner of the arena is in the way".to_owned(),
        );
    }
    let (low, high) = world.arena.bounds();
    let [width, height] = minus(high, low).map(short);
    asked.iter().find_map(|part| {
        let (distance, with) = compared(program, *part)?;
        let of_the_world = matches!(
            program.pool.get(distance),
            Expr::NearestWall(Echo::Distance)
                | Expr::Wall(_, Echo::Distance)
                | Expr::Binary(Binary::Hypot, ..)
        );
        let (_, most) = range(view, distance).ends();
        if !of_the_world || most > with + SLACK {
            return None;
        }
        let most = short(((most - ROUNDED) * 100.0).ceil() / 100.0);
        Some(format!(
            "the arena is {width} m × {height} m: this distance is never more than {most} m"
        ))
    })
}

/// How many parts of a condition are looked at.
const MOST: usize = 400;

/// A condition and the conditions that it is made of, and what the events in it wait for.
fn conditions(program: &Program, id: ExprId) -> Vec<ExprId> {
    let mut found = vec![id];
    let mut at = 0;
    while let Some(&part) = found.get(at).filter(|_| found.len() < MOST) {
        match program.pool.get(part) {
            Expr::Event(event) => found.push(program.events[event].when),
            Expr::Unary(Unary::Not, of) => found.push(of),
            Expr::Binary(Binary::And | Binary::Or, one, other) => found.extend([one, other]),
            _ => {}
        }
        at += 1;
    }
    found
}

/// A number and what it is the least or the greatest of, the sum of, or one of.
fn parts(program: &Program, id: ExprId) -> Vec<ExprId> {
    let mut parts = vec![id];
    let mut at = 0;
    while let Some(&part) = parts.get(at).filter(|_| parts.len() < MOST) {
        match program.pool.get(part) {
            Expr::Binary(Binary::Min | Binary::Max | Binary::Add | Binary::Sub, one, other)
            | Expr::Select(_, one, other) => parts.extend([one, other]),
            _ => {}
        }
        at += 1;
    }
    parts
}

/// The two robots whose distance this is; `None` among them is the one that reads.
fn robots(program: &Program, id: ExprId) -> Option<[Option<Id<Robot>>; 2]> {
    let pool = &program.pool;
    let Expr::Binary(Binary::Hypot, dx, dy) = pool.get(id) else {
        return None;
    };
    let along = |difference: ExprId, axis: Pose| {
        let Expr::Binary(Binary::Sub, one, other) = pool.get(difference) else {
            return None;
        };
        let robot = |id: ExprId| match pool.get(id) {
            Expr::Pose(pose) if pose == axis => Some(None),
            Expr::Robot(robot, pose) if pose == axis => Some(Some(robot)),
            _ => None,
        };
        Some([robot(one)?, robot(other)?])
    };
    let [one, other] = along(dx, Pose::X)?;
    (along(dy, Pose::Y)? == [one, other] && one != other).then_some([one, other])
}

fn has_doors(world: &World) -> bool {
    world.walls.values().any(|wall| wall.when.is_some())
}
