//! How fast the examples are learned from, Q-learning and all, in ticks per second on one core.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a bench fails where it goes wrong"
)]

use btc::driver::load::{Loaded, Reader, load};
use btc::ir::Id;
use btc::ir::task::Objective;
use btc::learn::average;
use btc::learn::discount::Discounting;
use btc::learn::method::{self, Settings};
use btc::learn::schedule::Schedule;
use btc::learn::simulated::Purpose;
use btc::learn::train::{Counts, Course, Trained, train};
use btc::world::{Simulator, Start};
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;

struct NoFiles;

impl Reader for NoFiles {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        Err(format!("{path} is not read here"))
    }
}

/// The first learner of a program, on a number of its episodes.
fn learn(loaded: &Loaded, simulator: &Simulator, episodes: u64) -> Counts {
    let program = &loaded.program;
    let learner = &program.learners[Id::new(0)];
    let task = &program.tasks[learner.task];
    let start = Start {
        seed: 1,
        stream: Purpose::Learn as u64,
        limit: learner.episode_ticks,
        ..Start::default()
    };
    let mut process = simulator.simulation();
    let settings = Settings {
        average: false,
        choices: task.choose.len(),
        initial: learner.initial,
        rate: Schedule::new(&program.pool, learner.rate),
        seed: 1,
    };
    let mut method = method::of(learner.method, &settings);
    let course = Course {
        choices: &task.choose,
        patience: task.patience,
        start,
        episodes,
        explore: Schedule::new(&program.pool, learner.explore),
        discounting: Discounting {
            discount: match learner.objective {
                Objective::Discounted(discount) => discount,
                Objective::Average(_) => average::discount(0.1),
            },
            tick: program.world.as_ref().unwrap().tick,
        },
        dwell: learner.dwell,
    };
    let mut trained = Trained::new(1);
    train(
        &mut process,
        method.as_mut(),
        &course,
        &mut trained,
        |_, _| {},
        |_, _| {},
    );
    trained.counts
}

fn examples(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("learning");
    group.sample_size(20);
    for (name, text, episodes) in [
        (
            "small delivery",
            include_str!("../examples/delivery_small.bt"),
            100,
        ),
        (
            "large delivery",
            include_str!("../examples/delivery_large.bt"),
            1000,
        ),
    ] {
        let loaded = load("example.bt", text.as_bytes().to_vec(), &mut NoFiles);
        assert!(!loaded.has_errors());
        let learner = &loaded.program.learners[Id::new(0)];
        let simulator =
            Simulator::build(&loaded.program, learner.task, &[&learner.start], &[]).unwrap();
        let ticks = learn(&loaded, &simulator, episodes).ticks;
        group.throughput(Throughput::Elements(ticks));
        group.bench_function(name, |bencher| {
            bencher.iter(|| black_box(learn(&loaded, &simulator, episodes)));
        });
    }
    group.finish();
}

criterion_group!(benches, examples);
criterion_main!(benches);
