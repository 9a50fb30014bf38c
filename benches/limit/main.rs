//! How near a tick of btc is to one written by hand: the two deliveries under their trees `expert`, beside plain Rust loops
//! that do the same, in one run on one core.
//!
//! `cargo bench --bench limit [-- --rounds 15]`
//!
//! The loops are checked first: over 10 000 ticks the robot has to be where btc's is, to 10⁻⁹ m and rad, and every
//! episode has to earn the same. Both then play the same episodes in turns; the figures are medians.
#![allow(
    clippy::unwrap_used,
    clippy::indexing_slicing,
    reason = "a bench fails where it goes wrong"
)]

mod examples;
mod growth;
mod hand;
mod large;
mod small;

use btc::driver::load::{Reader, load};
use btc::ir::Program;
use btc::learn::episode::{Controller, play};
use btc::random::Random;
use btc::trial::play::{Ticked, ready};
use btc::world::{Simulator, Start};
use hand::Loop;
use std::time::Instant;

/// How many ticks are checked.
const CHECKED: u64 = 10_000;
/// About how many ticks a round plays on each side.
const ROUND: u64 = 400_000;
const SEED: u64 = 1;

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

/// A program's world and the tree that a person wrote for it, `expert` or `hand`.
fn world(program: &Program) -> (Simulator, Ticked) {
    let expert = program
        .trees
        .values()
        .find(|tree| ["expert", "hand"].map(Into::into).contains(&tree.name));
    let task = program.tasks.ids().next().unwrap();
    ready(program, task, &expert.unwrap().root).unwrap()
}

fn start(episode: u64) -> Start {
    Start {
        seed: SEED,
        episode,
        limit: 5000,
        ..Start::default()
    }
}

/// Holds a loop against btc, tick by tick; answers how far they were apart at most.
fn check<L: Loop>(simulator: &Simulator, tree: &Ticked, patience: Option<u64>) -> f64 {
    let (mut simulation, mut tree) = (simulator.simulation(), tree.clone());
    let (mut worst, mut ticks) = (0.0_f64, 0);
    for episode in 0.. {
        simulation.start(start(episode));
        tree.reset();
        let mut own = L::start(Random::new(SEED, 0, episode));
        loop {
            let (pose, robot) = (simulation.pose(), own.robot());
            let turned = hand::wrap(pose.heading - robot.heading);
            let apart = [
                pose.position[0] - robot.x,
                pose.position[1] - robot.y,
                turned,
            ];
            worst = apart.iter().fold(worst, |worst, gap| worst.max(gap.abs()));
            assert!(
                worst < 1e-9,
                "episode {episode}, tick {}",
                simulation.ticks()
            );
            simulation.begin_tick();
            tree.tick(&mut simulation);
            let tick = simulation.end_tick();
            let over = own.tick();
            assert_eq!(tick.end.is_some(), over, "episode {episode}");
            ticks += 1;
            if over {
                break;
            }
        }
        let played = play(&mut simulation, &mut tree, start(episode), patience);
        let gap = played.total - own.total();
        assert!(gap.abs() < 1e-9, "episode {episode} earns {}", played.total);
        if ticks >= CHECKED {
            break;
        }
    }
    worst
}

fn median(mut figures: Vec<f64>) -> f64 {
    figures.sort_by(f64::total_cmp);
    figures[figures.len() / 2]
}

/// The ticks a second of something that plays ticks.
fn speed(play: impl FnOnce() -> u64) -> f64 {
    let begun = Instant::now();
    let ticks = play();
    ticks as f64 / begun.elapsed().as_secs_f64()
}

fn row<L: Loop>(name: &str, text: &str, rounds: u64) {
    let program = program(text);
    let patience = program.tasks.values().next().unwrap().patience;
    let (simulator, tree) = world(&program);
    let apart = check::<L>(&simulator, &tree, patience);
    let (mut simulation, mut controller) = (simulator.simulation(), tree.clone());
    let episodes = ROUND / 5000;
    let (mut of_btc, mut of_hand) = (Vec::new(), Vec::new());
    for round in 0..rounds {
        let all = round * episodes..(round + 1) * episodes;
        of_btc.push(speed(|| {
            let played = all.clone().map(|episode| {
                play(&mut simulation, &mut controller, start(episode), patience).ticks
            });
            played.sum()
        }));
        of_hand.push(speed(|| {
            let mut ticks = 0;
            for episode in all {
                let mut own = L::start(Random::new(SEED, 0, episode));
                ticks += 1;
                while !own.tick() {
                    ticks += 1;
                }
                std::hint::black_box(own.total());
            }
            ticks
        }));
    }
    let ratios = of_btc.iter().zip(&of_hand).map(|(a, b)| a / b).collect();
    println!(
        "| {name} | {:.1} M | {:.1} M | {:.2} | {apart:.0e} |",
        median(of_btc) / 1e6,
        median(of_hand) / 1e6,
        median(ratios),
    );
}

fn main() {
    let words: Vec<String> = std::env::args().collect();
    let at = words.iter().position(|word| word == "--rounds");
    let rounds = at.map_or(15, |at| words[at + 1].parse().unwrap());
    println!("| world | btc, ticks/s | by hand | btc / by hand | apart at most |");
    println!("| --- | ---: | ---: | ---: | ---: |");
    let small = include_str!("../../examples/delivery_small.bt");
    row::<small::Small>("small delivery", small, rounds);
    let large = include_str!("../../examples/delivery_large.bt");
    row::<large::Large>("large delivery", large, rounds);
    growth::tables(rounds);
    examples::table(rounds);
}
