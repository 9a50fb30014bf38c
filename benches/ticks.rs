//! How fast the world ticks, and how fast its geometry is beside parry's.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a bench fails where it goes wrong"
)]

use btc::driver::load::{Reader, load};
use btc::geometry::Shape;
use btc::ir::law::Behavior;
use btc::ir::task::Task;
use btc::ir::{Id, Program};
use btc::learn::process::{End, Process};
use btc::random::Random;
use btc::world::{Scene, Simulation, Simulator, Start};
use criterion::{BatchSize, Criterion, Throughput, criterion_group, criterion_main};
use parry2d_f64::math::{Pose, Vector};
use parry2d_f64::query::{PointQuery, Ray, RayCast};
use parry2d_f64::shape::{Polyline, Segment};
use std::hint::black_box;

const TICKS: u64 = 100_000;

struct NoFiles;

impl Reader for NoFiles {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        Err(format!("{path} is not read here"))
    }
}

fn program(text: &str) -> Program {
    let loaded = load("example.bt", text.into(), &mut NoFiles);
    assert!(!loaded.has_errors());
    loaded.program
}

fn small() -> Program {
    program(include_str!("../examples/delivery_small.bt"))
}

fn large() -> Program {
    program(include_str!("../examples/delivery_large.bt"))
}

/// Runs [`TICKS`] ticks under a policy, one episode after the other.
fn run(
    simulation: &mut Simulation,
    choose: &[Id<Behavior>],
    limit: u64,
    patience: Option<u64>,
    policy: fn(u128) -> usize,
) {
    let (mut left, mut episode) = (TICKS, 0);
    while left > 0 {
        episode += 1;
        simulation.start(Start {
            seed: 1,
            episode,
            limit: limit.min(left),
            ..Start::default()
        });
        loop {
            let behavior = choose[policy(simulation.key())];
            let transition = simulation.decide(behavior, patience, 0);
            left -= transition.ticks.min(left);
            if transition.end != End::Not {
                break;
            }
        }
    }
    black_box(simulation.key());
}

/// Figure 8 of the paper: the bits are carrying, low, done(goto(A)) ….
fn small_expert(key: u128) -> usize {
    match (key & 1 != 0, key & 2 != 0) {
        (_, true) if key & 1 << 4 != 0 => 3,
        (_, true) => 2,
        (true, _) => 1,
        _ => 0,
    }
}

/// A person's tree for large delivery: the bits are carrying, low, vis(A), vis(B), vis(C), done(goto(A)) ….
fn large_expert(key: u128) -> usize {
    let bit = |i: u32| key >> i & 1 == 1;
    if bit(1) && bit(4) {
        if bit(7) { 3 } else { 2 }
    } else if bit(0) {
        if bit(3) { 1 } else { 4 }
    } else if bit(2) {
        0
    } else {
        4
    }
}

fn ticks(c: &mut Criterion) {
    let mut group = c.benchmark_group("ticks");
    group.throughput(Throughput::Elements(TICKS));
    let mut world = |name: &str, program: &Program, limit, patience, policy: fn(u128) -> usize| {
        let task = Id::new(0);
        let Task { start, choose, .. } = &program.tasks[task];
        let simulator = Simulator::build(program, task, &[start], &[]).unwrap();
        let mut simulation = simulator.simulation();
        group.bench_function(name, |b| {
            b.iter(|| run(&mut simulation, choose, limit, patience, policy));
        });
    };
    let (small, large) = (small(), large());
    world("small, expert", &small, 5000, None, small_expert);
    world("large, expert", &large, 300, Some(600), large_expert);
    world("large, follow_wall", &large, 300, Some(600), |_| 4);
    group.finish();
}

fn geometry(c: &mut Criterion) {
    let program = large();
    let world = program.world.as_ref().unwrap();
    let scene = Scene::new(world);
    let mut corners = Vec::new();
    let mut chains = vec![vec![
        [0.0, 0.0],
        [6.0, 0.0],
        [6.0, 4.0],
        [0.0, 4.0],
        [0.0, 0.0],
    ]];
    for wall in world.walls.values() {
        if let Shape::Polyline(points) = &wall.shape {
            chains.push(points.clone());
        }
    }
    let (mut segments, mut indices) = (Vec::new(), Vec::new());
    for chain in &chains {
        for pair in chain.windows(2) {
            let [a, b] = [pair[0], pair[1]].map(|[x, y]| Vector::new(x, y));
            indices.push([corners.len() as u32, corners.len() as u32 + 1]);
            corners.extend([a, b]);
            segments.push(Segment::new(a, b));
        }
    }
    let tree = Polyline::new(corners, Some(indices));
    let mut random = Random::new(1, 0, 0);
    let mut query = move || {
        let (sin, cos) = btc::math::sin_cos(random.uniform(-3.0, 3.0));
        (
            [random.uniform(0.2, 5.8), random.uniform(0.2, 3.8)],
            [cos, sin],
        )
    };
    let queries: Vec<_> = (0..1024).map(|_| query()).collect();

    let mut group = c.benchmark_group("ray");
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function("btc", |b| {
        b.iter(|| queries.iter().map(|&(p, u)| scene.ray(p, u)).sum::<f64>());
    });
    let ray = |p: [f64; 2], u: [f64; 2]| Ray::new(p.into(), u.into());
    group.bench_function("parry, loop", |b| {
        b.iter(|| {
            queries
                .iter()
                .map(|&(p, u)| {
                    segments
                        .iter()
                        .filter_map(|s| s.cast_local_ray(&ray(p, u), 100.0, true))
                        .fold(f64::INFINITY, f64::min)
                })
                .sum::<f64>()
        });
    });
    group.bench_function("parry, tree", |b| {
        b.iter(|| {
            queries
                .iter()
                .filter_map(|&(p, u)| tree.cast_ray(&Pose::IDENTITY, &ray(p, u), 100.0, true))
                .sum::<f64>()
        });
    });
    group.finish();

    let mut group = c.benchmark_group("nearest wall");
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function("btc", |b| {
        b.iter(|| {
            queries
                .iter()
                .map(|&(p, _)| scene.nearest(p)[0])
                .sum::<f64>()
        });
    });
    group.bench_function("parry, loop", |b| {
        b.iter(|| {
            queries
                .iter()
                .map(|&(p, _)| {
                    segments
                        .iter()
                        .map(|s| s.distance_to_local_point(p.into(), true))
                        .fold(f64::INFINITY, f64::min)
                })
                .sum::<f64>()
        });
    });
    group.bench_function("parry, tree", |b| {
        b.iter(|| {
            queries
                .iter()
                .map(|&(p, _)| tree.distance_to_local_point(p.into(), true))
                .sum::<f64>()
        });
    });
    group.finish();

    let half = [([1.0, 0.0], [-1.0, 0.0])];
    let mut group = c.benchmark_group("scanner of half a turn");
    group.throughput(Throughput::Elements(queries.len() as u64));
    group.bench_function("btc", |b| {
        b.iter_batched(
            || &queries,
            |queries| {
                queries
                    .iter()
                    .filter_map(|&(p, u)| scene.scan(p, u, &half, 3.0))
                    .map(|v| v[0])
                    .sum::<f64>()
            },
            BatchSize::SmallInput,
        );
    });
    group.finish();
}

criterion_group!(benches, ticks, geometry);
criterion_main!(benches);
