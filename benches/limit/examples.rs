//! How fast each example ticks under the tree that a person wrote.

use super::{median, program, speed, start, world};
use btc::learn::episode::play;

const EXAMPLES: [(&str, &str); 8] = [
    (
        "delivery, small",
        include_str!("../../examples/delivery_small.bt"),
    ),
    (
        "delivery, large",
        include_str!("../../examples/delivery_large.bt"),
    ),
    ("foraging", include_str!("../../examples/foraging.bt")),
    ("grasp", include_str!("../../examples/grasp.bt")),
    ("guard", include_str!("../../examples/guard.bt")),
    ("rooms", include_str!("../../examples/rooms.bt")),
    ("vacuum", include_str!("../../examples/vacuum.bt")),
    ("warehouse", include_str!("../../examples/warehouse.bt")),
];

/// The least ticks of a round.
const ROUND: u64 = 400_000;

/// Prints the ticks a second of each example.
pub fn table(rounds: u64) {
    println!();
    println!("| example | ticks/s |");
    println!("| --- | ---: |");
    for (name, text) in EXAMPLES {
        let program = program(text);
        let patience = program.tasks.values().next().unwrap().patience;
        let (simulator, mut tree) = world(&program);
        let mut simulation = simulator.simulation();
        let mut episodes = 0..;
        let mut round = || {
            let mut ticks = 0;
            while ticks < ROUND {
                let start = start(episodes.next().unwrap());
                ticks += play(&mut simulation, &mut tree, start, patience).ticks;
            }
            ticks
        };
        let speeds = (0..rounds).map(|_| speed(&mut round)).collect();
        println!("| {name} | {:.1} M |", median(speeds) / 1e6);
    }
}
