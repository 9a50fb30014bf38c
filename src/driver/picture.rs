//! `btc run --svg`: the beginning of an episode as a picture.

use super::load::Loaded;
use super::run::{self, Subject};
use super::target;
use crate::diagnostic::Diagnostic;
use crate::emit::svg;
use crate::emit::svg::track::{Stand, Step, Track};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::task::Task;
use crate::ir::tree::Status;
use crate::learn::simulated::Purpose;
use crate::world::{End, Simulation, Start};

/// Draws the world with the first `ticks` ticks of episode 0 of a seed, which is also the first that [`run::run`]
/// plays.
///
/// # Errors
/// As [`run::run`].
pub fn draw(
    loaded: &Loaded,
    subject: Subject,
    seed: u64,
    ticks: u64,
) -> Result<String, Diagnostic> {
    let program = &loaded.program;
    let begin = |task: Id<Task>| Start {
        seed,
        stream: Purpose::Run as u64,
        limit: program.tasks[task].end_after,
        ..Start::default()
    };
    let (name, task, (start, steps, end)) = match subject {
        Subject::Tree(id) => {
            let tree = &program.trees[id];
            let task = target::task_of(loaded, Some(id))?;
            let (simulator, mut runner) = run::ready(loaded, task, &tree.root)?;
            let mut simulation = simulator.simulation();
            simulation.start(begin(task));
            let recorded = record(&mut simulation, ticks, |simulation| {
                let (mut driver, mut drives) = (None, false);
                let atoms = simulation.atoms();
                runner.tick_key(atoms, |behavior| {
                    let status = simulation.act(behavior);
                    if !drives {
                        driver = Some(behavior);
                        drives = status == Status::Running;
                    }
                    status
                });
                driver
            });
            (format!("tree {}", tree.name), task, recorded)
        }
        Subject::Policy(policy, task) => {
            let simulator = run::simulator(loaded, task, &[])?;
            let choices = run::choices(policy);
            let unseen = run::unseen(program, task);
            let mut simulation = simulator.simulation();
            simulation.start(begin(task));
            let recorded = record(&mut simulation, ticks, |simulation| {
                let behavior = choices.get(&simulation.key()).copied().unwrap_or(unseen);
                simulation.act(behavior);
                Some(behavior)
            });
            ("policy".to_owned(), task, recorded)
        }
    };
    let task = &program.tasks[task];
    let track = Track {
        choices: task.choose.clone(),
        start,
        steps,
    };
    let mut caption = format!("{name}, seed {seed}, {} ticks", track.steps.len());
    if let Some(End::On(line)) = end
        && let Some(name) = run::end_names(program, task).get(line)
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
) -> (Stand, Vec<Step>, Option<End>) {
    let start = stand(simulation);
    let mut steps = Vec::new();
    for _ in 0..ticks {
        simulation.begin_tick();
        let behavior = tick(simulation);
        let outcome = simulation.end_tick();
        steps.push(Step {
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
