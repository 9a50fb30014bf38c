//! What a tick means.

use crate::world_delivery;
use btc::ir::Id;
use btc::world::{End, Simulator, Start};

/// The expert of the paper's Figure 8 delivers for thousands of ticks without dying.
#[test]
fn an_expert_delivers_in_the_small_world() {
    let (program, task) = world_delivery::small();
    let start = &program.tasks[task].start;
    let simulator = Simulator::build(&program, task, &[start], &[]).unwrap();
    let mut simulation = simulator.simulation();
    let (mut deliveries, mut deaths, mut docking) = (0, 0, false);
    for episode in 0..20 {
        simulation.start(Start {
            seed: 1,
            episode,
            limit: 5000,
            ..Start::default()
        });
        loop {
            let key = simulation.key();
            let (carrying, low) = (key & 1 != 0, key & 2 != 0);
            docking = low && (docking || key & 1 << 4 != 0);
            let behavior = match (carrying, low) {
                (_, true) if docking => 3,
                (_, true) => 2,
                (true, _) => 1,
                _ => 0,
            };
            let transition = simulation.run_option(Id::new(behavior), None, 0);
            if let Some(end) = transition.end {
                deaths += u32::from(end == End::On(0));
                break;
            }
        }
        deliveries += simulation.counts()[1];
    }
    assert_eq!(deaths, 0);
    assert!(deliveries > 200, "{deliveries}");
}
