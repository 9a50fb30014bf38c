//! `btc run --svg`: the beginning of an episode as a picture.

use super::load::Loaded;
use super::refused::Refused;
use super::run::Subject;
use super::world;
use crate::emit::svg;
use crate::emit::svg::track::{Stand, Track, TrackTick};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::learn::greedy::Greedy;
use crate::learn::simulated::Purpose;
use crate::report::words::end_names;
use crate::trial::play;
use crate::world::{End, Simulation, Simulator};

/// Draws the world with the first `ticks` ticks of episode 0 of a seed, which is also the first that
/// [`run`](super::run::run) plays.
///
/// # Errors
/// As [`run`](super::run::run).
pub fn draw(loaded: &Loaded, subject: &Subject, seed: u64, ticks: u64) -> Result<String, Refused> {
    let program = &loaded.program;
    let id = subject.task(loaded)?;
    let task = &program.tasks[id];
    let begin = Purpose::Run.start(seed, task.end_after);
    let (name, (start, steps, end)) = match subject {
        Subject::Tree(tree) => {
            let tree = &program.trees[*tree];
            let (simulator, mut ticked) = play::ready(program, id, &tree.root)
                .map_err(|why| world::unplayable(loaded, why))?;
            let mut simulation = simulator.simulation();
            simulation.start(begin);
            let recorded = record(&mut simulation, ticks, |simulation| {
                let (mut driver, mut drives) = (None, false);
                ticked.tick_noting(simulation, |behavior, status| {
                    if !drives {
                        driver = Some(behavior);
                        drives = status == Status::Running;
                    }
                });
                driver
            });
            (format!("tree {}", tree.name), recorded)
        }
        Subject::Policy(policy, _) => {
            let simulator = Simulator::build(program, id, &[&task.start], &[])
                .map_err(|error| world::unplayable(loaded, error))?;
            let mut greedy = Greedy::new(policy, program, id);
            let mut simulation = simulator.simulation();
            simulation.start(begin);
            let recorded = record(&mut simulation, ticks, |simulation| {
                let behavior = greedy.choose(simulation.key());
                simulation.act(behavior);
                Some(behavior)
            });
            ("policy".to_owned(), recorded)
        }
    };
    let track = Track {
        choices: task.choose.clone(),
        start,
        steps,
    };
    let mut caption = format!("{name}, seed {seed}, {} ticks", track.steps.len());
    if let Some(End::On(line)) = end
        && let Some(name) = end_names(program, task).get(line)
    {
        caption.push_str(&format!(", ended by {name}"));
    }
    let world = program.world.as_ref();
    Ok(world.map_or_else(String::new, |world| {
        svg::world::world(program, world, &caption, Some(&track))
    }))
}

/// Runs an episode that has started. `tick` acts between the beginning and the end of a tick and gives the behaviour
/// that drove the robot or, where none did, was ticked last.
fn record(
    simulation: &mut Simulation,
    ticks: u64,
    mut tick: impl FnMut(&mut Simulation) -> Option<Id<Behavior>>,
) -> (Stand, Vec<TrackTick>, Option<End>) {
    let start = stand(simulation);
    let mut steps = Vec::new();
    for _ in 0..ticks {
        simulation.begin_tick();
        let behavior = tick(simulation);
        let outcome = simulation.end_tick();
        steps.push(TrackTick {
            behavior,
            stand: stand(simulation),
            events: simulation.fired().collect(),
        });
        if outcome.end.is_some() {
            return (start, steps, outcome.end);
        }
    }
    (start, steps, None)
}

fn stand(simulation: &Simulation) -> Stand {
    let pose = simulation.pose();
    Stand {
        position: pose.position,
        heading: pose.heading,
    }
}
