//! The time of each stage of minimisation, and the size of the lists that are found for planted ones.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    clippy::panic,
    reason = "a bench fails where it goes wrong"
)]

#[path = "../tests/it/functions.rs"]
mod functions;
#[path = "../tests/it/planted.rs"]
mod planted;

use btc::logic::complement::complement;
use btc::logic::packed::Packed;
use btc::logic::pla::read;
use btc::logic::{Bits, Columns, Cover, Effort, Order, list, minimise_with};
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use functions::{Kind, pla};
use planted::{planted, size};
use std::hint::black_box;

/// Atoms and rows of planted lists.
const LISTS: [(usize, usize); 6] = [
    (11, 61),
    (24, 10_000),
    (64, 10_000),
    (128, 10_000),
    (32, 100_000),
    (256, 1_000_000),
];

/// One sweep of EXPAND and the cover that comes of it, nothing more.
fn sweep() -> Effort {
    Effort {
        exact_rows: 0,
        rounds: 0,
        ..Effort::default()
    }
}

/// Rows into columns.
fn transpose(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("transpose");
    for (atoms, rows) in [(24, 10_000), (128, 10_000), (32, 100_000)] {
        let planted = planted(atoms, rows, 0);
        group.throughput(Throughput::Elements(rows as u64));
        group.bench_function(BenchmarkId::new(atoms.to_string(), rows), |bencher| {
            bencher.iter(|| Columns::new(atoms, planted.rows.iter().map(|row| &**row)));
        });
    }
    group.finish();
}

/// EXPAND and cover, then with improvement; all primes and the cheapest cover, where there are few rows.
fn covers(criterion: &mut Criterion) {
    for (name, effort) in [("sweep", sweep()), ("improve", Effort::default())] {
        let mut group = criterion.benchmark_group(name);
        group.sample_size(10);
        for kind in Kind::ALL {
            for (atoms, rows) in [(20, 100), (24, 300), (64, 300)] {
                let text = pla(kind, atoms, rows, 0);
                let pla = read(&text).unwrap();
                let columns = pla.columns();
                let function = pla.function(&columns, 0, 0).unwrap();
                let id = BenchmarkId::new(kind.name(), format!("{atoms}x{rows}"));
                group.bench_function(id, |bencher| {
                    bencher.iter(|| minimise_with(&columns, &function.on, &function.off, &effort));
                });
            }
        }
        group.finish();
    }
    let mut group = criterion.benchmark_group("exact");
    for rows in [30, 60] {
        let planted = planted(8, rows, 0);
        let off = Bits::full(rows).minus(&planted.classes[0]);
        group.bench_function(BenchmarkId::new("8", rows), |bencher| {
            let effort = Effort::default();
            bencher.iter(|| minimise_with(&planted.columns, &planted.classes[0], &off, &effort));
        });
    }
    group.finish();
}

fn complements(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("complement");
    for (atoms, rows) in [(20, 50), (20, 200)] {
        let text = pla(Kind::Cubes, atoms, rows, 0);
        let pla = read(&text).unwrap();
        let cubes: Vec<Packed> = (0..pla.rows()).map(|row| pla.cube(row)).collect();
        group.bench_function(BenchmarkId::new(atoms.to_string(), rows), |bencher| {
            bencher.iter(|| complement(atoms, black_box(&cubes), usize::MAX));
        });
    }
    group.finish();
}

/// Decision lists; their sizes are printed.
fn lists(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("list");
    group.sample_size(10);
    let effort = Effort::default();
    println!("atoms × rows: literals planted, in the order that is learned, in the planted order");
    for (atoms, rows) in LISTS {
        let seeds = if rows > 100_000 { 1 } else { 10 };
        let mut sums = [0; 3];
        for seed in 0..seeds {
            let planted = planted(atoms, rows, seed);
            sums[0] += planted.size().1;
            for (sum, order) in sums[1..].iter_mut().zip([Order::Learned, Order::Given]) {
                let list = list(&planted.columns, &planted.classes, order, &effort);
                let covers: Vec<Cover> = list.into_iter().map(|(_, cover)| cover).collect();
                *sum += size(&covers).1;
            }
        }
        println!("{atoms} × {rows}: {sums:?} over {seeds}");
        let planted = planted(atoms, rows, 0);
        group.bench_function(BenchmarkId::new(atoms.to_string(), rows), |bencher| {
            let classes = &planted.classes;
            bencher.iter(|| list(&planted.columns, classes, Order::Learned, &effort));
        });
    }
    group.finish();
}

criterion_group!(benches, transpose, covers, complements, lists);
criterion_main!(benches);
