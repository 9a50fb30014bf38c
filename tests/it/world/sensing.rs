//! What sensors read, through a running program.

use super::ticks::small_program;
use btc::geometry::Shape;
use btc::ir::expr::Echo;
use btc::ir::law::{Block, Stmt};
use btc::ir::task::StartLine;
use btc::ir::world::{SensorKind, Wall};
use btc::ir::{Expr, Id};
use btc::world::{Simulator, Start};
use std::f64::consts::PI;

/// A source's distance, direction and whether it is seen, from (1, 2) in an arena of 4 m × 4 m with a thin wall from
/// (2.5, 1) to (2.5, 2.5).
fn read(heading: f64, sensor: SensorKind, source: fn(Echo) -> Expr) -> (f64, f64, bool) {
    let mut program = small_program();
    let world = program.world.as_mut().unwrap();
    world.walls.push(Wall {
        name: "wall".into(),
        shape: Shape::Polyline(vec![[2.5, 1.0], [2.5, 2.5]]),
        when: None,
    });
    let ahead = &mut world.robot.sensors[Id::new(0)];
    ahead.kind = sensor;
    ahead.noise = 0.0;
    let pool = &mut program.pool;
    let heading = pool.num(heading);
    let statements = [Echo::Distance, Echo::Direction, Echo::Seen]
        .into_iter()
        .enumerate()
        .map(|(i, echo)| Stmt::SetState(Id::new(i), pool.leaf(source(echo))))
        .collect();
    program.each_tick = Block(statements);
    let task = Id::new(0);
    program.tasks[task].start[1] = StartLine::Heading(heading);
    let start = &program.tasks[task].start;
    let simulator = Simulator::build(&program, task, &[start], &[]).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    simulation.begin_tick();
    let state = |i: usize| simulation.state(Id::new(i));
    (state(0), state(1), state(2) != 0.0)
}

fn sensor(echo: Echo) -> Expr {
    Expr::Sensor(Id::new(0), echo)
}

fn check(found: (f64, f64, bool), expected: (f64, f64, bool)) {
    let close = |a: f64, b: f64| (a - b).abs() < 1e-9;
    assert!(
        close(found.0, expected.0) && close(found.1, expected.1) && found.2 == expected.2,
        "{found:?} not {expected:?}"
    );
}

const ANY: SensorKind = SensorKind::RangeFinder {
    at: 0.0,
    range: 1.0,
};

#[test]
fn walls() {
    check(read(0.3, ANY, Expr::NearestWall), (1.0, -PI, true));
    check(
        read(0.3, ANY, |e| Expr::Wall(Id::new(0), e)),
        (1.5, 0.0, true),
    );
}

#[test]
fn range_finders() {
    let finder = |at, range| SensorKind::RangeFinder { at, range };
    check(read(0.0, finder(0.0, 5.0), sensor), (1.5, 0.0, true));
    check(read(0.5, finder(-0.5, 5.0), sensor), (1.5, 0.0, true));
    // Nothing within its range: the range, along the ray.
    check(read(0.5, finder(-0.5, 1.2), sensor), (1.2, 0.0, false));
}

#[test]
fn scanners() {
    let scanner = |from, to, range| SensorKind::Scanner { from, to, range };
    // Looking up: the left half is towards x = 0, the right half towards the thin wall.
    let up = PI / 2.0;
    check(read(up, scanner(0.0, PI, 5.0), sensor), (1.0, -PI, true));
    check(read(up, scanner(-PI, 0.0, 5.0), sensor), (1.5, 0.0, true));
    // All round; and in two parts, since more than half a turn is no half plane.
    check(read(up, scanner(-PI, PI, 5.0), sensor), (1.0, -PI, true));
    check(
        read(0.0, scanner(-0.7 * PI, 0.75 * PI, 5.0), sensor),
        (2f64.sqrt(), 0.75 * PI, true),
    );
    check(
        read(0.0, scanner(-0.2, 0.6, 1.2), sensor),
        (1.2, 0.2, false),
    );
}

#[test]
fn beacons() {
    let beacon = |target, facing| SensorKind::Beacon {
        target,
        range: 2.5,
        facing,
        sector: 1.0,
    };
    check(read(0.3, beacon([2.0, 2.0], PI), sensor), (1.0, 0.0, true));
    // Sends the other way; stands behind the wall; is too far. Then: the range, straight ahead.
    for silent in [
        beacon([2.0, 2.0], 0.0),
        beacon([3.2, 2.0], PI),
        beacon([3.9, 3.9], -0.75 * PI),
    ] {
        check(read(0.3, silent, sensor), (2.5, 0.3, false));
    }
}
