//! The time from a table to its tree: the proof, Algorithm 1 and the search, on planted lists of rules.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a bench fails where it goes wrong"
)]

#[allow(dead_code, unreachable_pub, reason = "shared with the tests")]
#[path = "../tests/it/planted.rs"]
mod planted;

use btc::ir::Id;
use btc::ir::tree::Atom;
use btc::policy::{Minterm, Policy, Row};
use btc::tree::decanonicalise::{Method, Options, decanonicalise};
use btc::tree::prove::Prover;
use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use planted::{BEHAVIORS, planted};
use std::hint::black_box;

/// Predicates and rows, and whether Algorithm 1 is run as well: it minimises one behaviour against all others.
const SIZES: [(usize, usize, bool); 5] = [
    (11, 61, true),
    (24, 10_000, true),
    (64, 10_000, true),
    (128, 10_000, false),
    (32, 100_000, false),
];

/// A planted list as a table.
fn table(atoms: usize, rows: usize) -> Policy {
    let planted = planted(atoms, rows, 0);
    let behavior = |r: usize| planted.classes.iter().position(|class| class.contains(r));
    let rows = planted.rows.iter().enumerate().map(|(r, words)| Row {
        minterm: Minterm::new((0..atoms).map(|a| words.get(a / 64).unwrap() >> (a % 64) & 1 == 1)),
        free: None,
        behavior: Id::new(behavior(r).unwrap()),
        visits: 0,
        values: Vec::new(),
    });
    let mut rows: Vec<Row> = rows.collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    rows.dedup_by(|a, b| a.minterm == b.minterm);
    Policy {
        atoms: (0..atoms).map(|i| Atom::Predicate(Id::new(i))).collect(),
        behaviors: (0..BEHAVIORS).map(Id::new).collect(),
        rows,
        ..Policy::default()
    }
}

fn stages(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("trees");
    group.sample_size(10);
    for (atoms, rows, paper) in SIZES {
        let name = format!("{atoms} × {rows}");
        let policy = table(atoms, rows);
        let found = decanonicalise(&policy, &Options::default()).unwrap();
        let prover = Prover::new(&policy);
        group.throughput(Throughput::Elements(policy.rows.len() as u64));
        group.bench_function(BenchmarkId::new("transpose", &name), |bencher| {
            bencher.iter(|| black_box(Prover::new(&policy)));
        });
        group.bench_function(BenchmarkId::new("prove", &name), |bencher| {
            bencher.iter(|| black_box(prover.prove(&found.root).unwrap()));
        });
        for method in [Method::Paper, Method::Search] {
            if method == Method::Paper && !paper {
                continue;
            }
            let options = Options {
                method,
                ..Options::default()
            };
            let name = BenchmarkId::new(format!("{method:?}"), &name);
            group.bench_function(name, |bencher| {
                bencher.iter(|| black_box(decanonicalise(&policy, &options).unwrap()));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, stages);
criterion_main!(benches);
