//! How learned trees do on the sample worlds of `tests/worlds/`, beside the trees by hand: a table in Markdown, and how many
//! trees do well.
//!
//! `cargo bench --bench worlds [-- WORLD…] [--seeds 1,2] [--episodes 300] [--with-hand]`
//!
//! A world is a name in `tests/worlds/` or the path of a program that has a tree called `hand`. What is learned never
//! sees the trees of the program, unless `--with-hand` is given. All trees of a row are measured on the same fresh
//! episodes, from the task's own starts. The files of each learner are left in `target/worlds/`.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a bench fails where it goes wrong"
)]

use btc::source::{Source, Sources};
use btc::syntax::ast::ItemKind;
use btc::syntax::{parse, print};
use btc::{LearnOptions, Program};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// As the command line has it, so that the seconds are those of its users.
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

const ROOT: &str = env!("CARGO_MANIFEST_DIR");

struct Arguments {
    worlds: Vec<PathBuf>,
    seeds: Vec<u64>,
    episodes: u64,
    runs: Option<u64>,
    effort: u64,
    with_hand: bool,
}

impl Arguments {
    fn read() -> Self {
        let mut read = Self {
            worlds: Vec::new(),
            seeds: (1..=5).collect(),
            episodes: 300,
            runs: None,
            effort: LearnOptions::default().effort,
            with_hand: false,
        };
        let mut words = std::env::args().skip(1);
        while let Some(word) = words.next() {
            match word.as_str() {
                "--bench" => {}
                "--seeds" => {
                    let seeds = words.next().unwrap();
                    read.seeds = seeds.split(',').map(|seed| seed.parse().unwrap()).collect();
                }
                "--episodes" => read.episodes = words.next().unwrap().parse().unwrap(),
                "--runs" => read.runs = Some(words.next().unwrap().parse().unwrap()),
                "--effort" => read.effort = words.next().unwrap().parse().unwrap(),
                "--with-hand" => read.with_hand = true,
                name if name.ends_with(".bt") => read.worlds.push(name.into()),
                name => read.worlds.push(folder().join(format!("{name}.bt"))),
            }
        }
        if read.worlds.is_empty() {
            let entries = fs::read_dir(folder()).unwrap();
            let paths = entries.map(|entry| entry.unwrap().path());
            read.worlds = paths.filter(|path| path.is_file()).collect();
            read.worlds.sort();
        }
        read
    }
}

fn folder() -> PathBuf {
    Path::new(ROOT).join("tests/worlds")
}

/// A program without its trees and what it claims of them.
fn without_trees(path: &Path) -> Program {
    let text = fs::read_to_string(path).unwrap();
    let file = Sources::default().add(Source::new("world.bt", text.clone()));
    let (mut ast, _) = parse(file, &text);
    ast.items
        .retain(|item| !matches!(item.kind, ItemKind::Tree(_) | ItemKind::Claim(_)));
    Program::from_text(&print::file(&ast, None)).unwrap()
}

/// A tree in fresh episodes. Every `end on` of the sample worlds is to the robot's loss.
struct Measured {
    nodes: usize,
    mean: f64,
    deaths: u64,
}

impl Measured {
    fn of(program: &Program, tree: &str, episodes: u64, seed: u64) -> Self {
        let summary = program.run(tree, episodes, seed).unwrap().summary;
        Self {
            nodes: program.tree(tree).unwrap().size().nodes,
            mean: summary.total.mean,
            deaths: summary.ended.iter().sum(),
        }
    }

    fn cell(&self) -> String {
        format!("{} / {:.2} / {}", self.nodes, self.mean, self.deaths)
    }
}

/// What a grown tree is measured by, and whether it keeps to it.
struct Kept {
    returns: bool,
    more: bool,
    nodes: bool,
    harm: bool,
}

impl Kept {
    fn of(grown: &Measured, hand: &Measured, exact: &Measured) -> Self {
        let best = if hand.mean >= exact.mean { hand } else { exact };
        Self {
            returns: grown.mean >= best.mean - 0.02 * best.mean.abs(),
            more: grown.mean > best.mean,
            nodes: grown.nodes as f64 <= 1.3 * hand.nodes as f64,
            harm: grown.deaths <= best.deaths,
        }
    }
}

/// How many of the rows keep to each, in words.
fn counted(rows: &[Kept]) -> String {
    let count = |keeps: fn(&Kept) -> bool| rows.iter().filter(|row| keeps(row)).count();
    format!(
        "Of {} trees {} return at least 98 % of the better of the two others, {} more than both; {} have at most 1.3 times the nodes of \
         the tree by hand; under {} no more episodes end badly than under the better of the two others. Return, nodes and harm \
         together: {}.",
        rows.len(),
        count(|row| row.returns),
        count(|row| row.more),
        count(|row| row.nodes),
        count(|row| row.harm),
        count(|row| row.returns && row.nodes && row.harm),
    )
}

/// One line of the table.
fn row(world: &Path, seed: u64, arguments: &Arguments) -> (String, Kept) {
    let name = world.file_stem().unwrap().to_string_lossy();
    let source = fs::canonicalize(world).unwrap();
    let options = LearnOptions {
        seed: Some(seed),
        seeds: arguments.runs,
        effort: arguments.effort,
        source: source.to_str().unwrap(),
        ..LearnOptions::default()
    };
    let program = match arguments.with_hand {
        true => Program::from_file(world).unwrap(),
        false => without_trees(world),
    };
    let begun = Instant::now();
    let learned = program.learn(&options).unwrap();
    let seconds = begun.elapsed().as_secs_f64();

    let results = Path::new(ROOT).join(format!("target/worlds/{name}.{seed}"));
    fs::create_dir_all(&results).unwrap();
    for (file, text) in learned.files() {
        fs::write(results.join(file), text).unwrap();
    }
    let program = Program::from_file(results.join("learned.bt")).unwrap();
    let measured = |tree| Measured::of(&program, tree, arguments.episodes, seed);
    let hand = measured("hand");
    let grown = measured("learned");
    let exact = match program.tree("learned_exact") {
        Ok(_) => measured("learned_exact"),
        Err(_) => measured("learned"),
    };
    let best = hand.mean.max(exact.mean);
    let ratio = match best > 0.0 {
        true => format!("{:.3}", grown.mean / best),
        false => "–".to_owned(),
    };
    let metrics = learned.file("metrics.json").unwrap();
    let metrics: serde_json::Value = serde_json::from_str(metrics).unwrap();
    let of = |metrics: &serde_json::Value, at| metrics.pointer(at).and_then(|ticks| ticks.as_u64());
    let searched = ["/improved/ticks", "/grown/ticks"].map(|at| of(&metrics, at));
    let learned: u64 = match metrics["seeds"].as_array() {
        Some(runs) => {
            let each = runs
                .iter()
                .flat_map(|run| ["/ticks", "/validation/ticks"].map(|at| of(run, at)));
            each.flatten().sum()
        }
        None => of(&metrics, "/ticks").unwrap(),
    };
    let ticks = learned + searched.iter().flatten().sum::<u64>();
    let text = format!(
        "| {name} | {seed} | {} | {} | {} | {ratio} | {:.2} | {:.1} | {seconds:.1} |",
        hand.cell(),
        exact.cell(),
        grown.cell(),
        grown.nodes as f64 / hand.nodes as f64,
        ticks as f64 / 1e6
    );
    (text, Kept::of(&grown, &hand, &exact))
}

fn main() {
    let arguments = Arguments::read();
    println!(
        "Trees: nodes / return / deaths in {} episodes.\n",
        arguments.episodes
    );
    println!(
        "| world | seed | hand | exact | grown | grown / best of both | nodes, grown / hand | M ticks | s |"
    );
    println!("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |");
    let mut rows = Vec::new();
    for world in &arguments.worlds {
        for &seed in &arguments.seeds {
            let (text, kept) = row(world, seed, &arguments);
            println!("{text}");
            rows.push(kept);
        }
    }
    println!("\n{}", counted(&rows));
}
