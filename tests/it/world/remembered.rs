//! What the simulator remembers of distances and lines of sight changes nothing but the time: along any way, what the code
//! reads is what the scene says to one who asks for the first time.

use super::geometry::twin;
use super::ticks::small_program;
use crate::program::named;
use btc::geometry::{Point, Shape};
use btc::ir::expr::{Binary, Draw, Echo};
use btc::ir::law::{Block, Stmt};
use btc::ir::task::StartLine;
use btc::ir::world::{Contact, DriveKind, Sensor, SensorKind, World};
use btc::ir::{Expr, Id, Program, Table};
use btc::learn::episode::Controller;
use btc::random::Random;
use btc::trial::play::ready;
use btc::world::{Gone, Scene, Simulator, Start};
use proptest::prelude::*;
use std::f64::consts::PI;
use std::path::Path;

/// The behaviour that drives about.
const ROAM: usize = 0;

/// The states in which the code keeps what it reads.
const SEES: usize = 0;
const LEFT: usize = 1;
const AHEAD: usize = 2;
const NEAR: usize = 3;

fn scaled(shape: &Shape, scale: f64) -> Shape {
    let point = |p: &Point| p.map(|c| c * scale);
    let points = |points: &[Point]| points.iter().map(point).collect();
    match shape {
        Shape::Disc { center, radius } => Shape::Disc {
            center: point(center),
            radius: radius * scale,
        },
        Shape::Rect { min, max } => Shape::Rect {
            min: point(min),
            max: point(max),
        },
        Shape::Polygon(corners) => Shape::Polygon(points(corners)),
        Shape::Polyline(chain) => Shape::Polyline(points(chain)),
    }
}

/// The left half plane, nearer than `range`, and straight ahead.
fn sensors(range: f64) -> Table<Sensor> {
    let left = SensorKind::Scanner {
        from: 0.0,
        to: PI,
        range,
    };
    let ahead = SensorKind::RangeFinder { at: 0.0, range };
    let sensors = [left, ahead].map(|kind| Sensor {
        name: "sensor".into(),
        kind,
        noise: 0.0,
    });
    sensors.into_iter().collect()
}

/// A program whose robot roams the world and notes in each tick whether it sees `goal`, what its sensors read, and whether the
/// nearest wall is nearer than `near`.
fn program(world: World, goal: Point, near: f64) -> Program {
    let mut program = small_program();
    let speed = world.robot.drive.max_speed;
    program.world = Some(world);
    let pool = &mut program.pool;
    let mut uniform = |number: u32, least: f64, most: f64| {
        let (least, most) = (pool.num(least), pool.num(most));
        pool.leaf(Expr::Draw(number, Draw::Uniform(least, most)))
    };
    let drive = Stmt::Drive {
        speed: uniform(1000, -0.2 * speed, speed),
        strafe: uniform(1001, -0.5 * speed, 0.5 * speed),
        turn: uniform(1002, -3.0, 3.5),
    };
    let [x, y] = goal.map(|c| pool.num(c));
    let nearest = pool.leaf(Expr::NearestWall(Echo::Distance));
    let near = pool.num(near);
    let asked = [
        (SEES, pool.leaf(Expr::Visible(x, y))),
        (LEFT, pool.leaf(Expr::Sensor(Id::new(0), Echo::Distance))),
        (AHEAD, pool.leaf(Expr::Sensor(Id::new(1), Echo::Distance))),
        (NEAR, pool.binary(Binary::Lt, nearest, near)),
    ];
    let set = |(state, value)| Stmt::SetState(Id::new(state), value);
    program.each_tick = Block(asked.into_iter().map(set).collect());
    let truth = program.pool.bool(true);
    let falsehood = program.pool.bool(false);
    let law = program.behaviors[Id::new(ROAM)].law.as_mut().unwrap();
    (law.requires, law.succeed, law.fail) = (truth, falsehood, falsehood);
    law.control = Block(vec![drive]);
    let task = &mut program.tasks[Id::new(0)];
    task.start = vec![StartLine::Anywhere(None)];
    task.end_on.clear();
    program
}

/// Drives through a random world of this scale and compares each tick.
fn roam(seed: u64, scale: f64, native: bool) -> Result<(), TestCaseError> {
    let random = &mut Random::new(seed, 1, 0);
    let contact = match random.chance(0.5) {
        true => Contact::Stop,
        false => Contact::Slide,
    };
    let mut world = twin(random, contact).world;
    world.arena = scaled(&world.arena, scale);
    for wall in world.walls.ids().collect::<Vec<_>>() {
        world.walls[wall].shape = scaled(&world.walls[wall].shape, scale);
    }
    let range = random.uniform(0.5, 8.0) * scale;
    let robot = &mut world.robot;
    robot.radius *= scale;
    robot.drive.max_speed = random.uniform(0.2, 6.0) * scale;
    if random.chance(0.5) {
        robot.drive.kind = DriveKind::Differential;
    }
    robot.sensors = sensors(range);
    // Now and then a goal in line with a wall, at its end, or on a rim.
    let mut goal = [random.uniform(-2.5, 2.5), random.uniform(-2.0, 2.0)].map(|c| c * scale);
    if let Some(wall) = world.walls.values().next()
        && random.chance(0.4)
    {
        let corners = wall.shape.corners();
        if let [a, b, ..] = corners[..] {
            let t = random.below(5) as f64 - 1.0;
            goal = [0, 1].map(|i| a[i] + t * (b[i] - a[i]));
        }
    }
    let near = random.uniform(0.0, 1.0) * scale;
    let scene = Scene::new(&world);
    let program = program(world, goal, near);
    let task = Id::new(0);
    let start = &program.tasks[task].start;
    let Ok(simulator) = Simulator::build(&program, task, &[start], &[]) else {
        // No room for a robot.
        return Ok(());
    };
    if native {
        simulator.compile();
    }
    let mut simulation = simulator.simulation();
    for episode in 0..2 {
        let start = Start {
            seed,
            episode,
            ..Start::default()
        };
        if !simulation.start(start) {
            return Ok(());
        }
        for tick in 0..300 {
            let pose = simulation.pose();
            let p = pose.position;
            simulation.begin_tick();
            let length = |v: Point| (v[0] * v[0] + v[1] * v[1]).sqrt();
            let left = scene.scan(p, pose.ahead, &[([1.0, 0.0], [-1.0, -0.0])], range);
            let ahead = scene.ray(p, pose.ahead);
            let ahead = match ahead < range {
                true => length(pose.ahead.map(|c| ahead * c)),
                false => range,
            };
            let expected = [
                f64::from(scene.sees(p, goal)),
                left.map_or(range, length),
                ahead,
                f64::from(length(scene.nearest(p)) < near),
            ];
            let read = [SEES, LEFT, AHEAD, NEAR].map(|state| simulation.state(Id::new(state)));
            prop_assert_eq!(
                read,
                expected,
                "episode {}, tick {} at {:?}",
                episode,
                tick,
                pose
            );
            simulation.act(Id::new(ROAM));
            simulation.end_tick();
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn what_is_remembered_is_what_a_new_look_says(seed: u64) {
        roam(seed, 1.0, false)?;
    }

    #[test]
    fn at_any_scale(seed: u64, exponent in -6i32..7) {
        roam(seed, 10f64.powi(exponent), seed % 2 == 0)?;
    }
}

/// Ticks that go on by themselves are the ticks that are gone through one by one.
#[test]
fn going_on_is_many_ticks() {
    for seed in 0..30 {
        let mut world = twin(&mut Random::new(seed, 2, 0), Contact::Slide).world;
        world.robot.drive.max_speed = 2.0;
        world.robot.sensors = sensors(3.0);
        let program = program(world, [0.5, 0.5], 0.4);
        let task = Id::new(0);
        let start = &program.tasks[task].start;
        let simulator = Simulator::build(&program, task, &[start], &[]).unwrap();
        let (mut one, mut other) = (simulator.simulation(), simulator.simulation());
        let start = Start {
            seed,
            limit: 500,
            ..Start::default()
        };
        assert!(one.start(start) && other.start(start));
        loop {
            let (ticks, gone) = one.go_on(Id::new(ROAM), 37, |_| {});
            let Gone::Ended(tick) = gone else {
                panic!("{gone:?}");
            };
            let mut last = None;
            for _ in 0..ticks {
                other.begin_tick();
                other.act(Id::new(ROAM));
                last = Some(other.end_tick());
            }
            assert_eq!(last, Some(tick), "seed {seed}");
            assert_eq!(one.pose(), other.pose());
            assert_eq!(one.ticks(), other.ticks());
            if tick.end.is_some() {
                break;
            }
        }
        assert_eq!(one.ticks(), 500);
    }
}

/// The programs of a folder with the name of its file, without those that lie in folders of it.
fn programs(folder: &str) -> Vec<(String, Program)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join(folder);
    let paths = std::fs::read_dir(folder).unwrap();
    let paths = paths.map(|entry| entry.unwrap().path());
    let mut paths: Vec<_> = paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "bt"))
        .collect();
    paths.sort();
    let loaded = paths.iter().map(|path| {
        let name = path.file_name().unwrap().to_str().unwrap();
        (name.to_owned(), named(name, path))
    });
    let sound = loaded.filter(|(_, loaded)| !loaded.has_errors());
    sound.map(|(name, loaded)| (name, loaded.program)).collect()
}

/// Worlds with doors that swing, robots that run scripts and all else that programs have are the same to a simulation that
/// remembers and to one that forgets before and within each tick.
#[test]
fn who_forgets_in_each_tick_sees_the_same() {
    let folders = ["examples", "tests/worlds", "tests/cases/run"];
    let (mut played, mut with_doors, mut with_others) = (0, 0, 0);
    for (name, program) in folders.into_iter().flat_map(programs) {
        let Some(world) = &program.world else {
            continue;
        };
        for tree in program.trees.values() {
            let Some(task) = tree.task.or(program.tasks.ids().next()) else {
                continue;
            };
            let Ok((simulator, controller)) = ready(&program, task, &tree.root) else {
                continue;
            };
            let (mut one, mut other) = (simulator.simulation(), simulator.simulation());
            let (mut first, mut second) = (controller.clone(), controller);
            for episode in 0..2 {
                let start = Start {
                    seed: 3,
                    episode,
                    limit: 1500,
                    ..Start::default()
                };
                one.start(start);
                other.start(start);
                first.reset();
                second.reset();
                loop {
                    one.begin_tick();
                    other.forget();
                    other.begin_tick();
                    first.tick(&mut one);
                    other.forget();
                    second.tick(&mut other);
                    let (tick, forgotten) = (one.end_tick(), other.end_tick());
                    let at = format!("{name}, {:?}, tick {}", tree.name, one.ticks());
                    assert_eq!(tick, forgotten, "{at}");
                    assert_eq!(one.atoms(), other.atoms(), "{at}");
                    assert_eq!(one.pose(), other.pose(), "{at}");
                    assert!(one.others().eq(other.others()), "{at}");
                    if tick.end.is_some() {
                        break;
                    }
                }
            }
            played += 1;
            with_doors += usize::from(world.walls.values().any(|wall| wall.when.is_some()));
            with_others += usize::from(!world.others.is_empty());
        }
    }
    assert!(
        played > 25 && with_doors > 2 && with_others > 2,
        "{played}, {with_doors}, {with_others}"
    );
}
