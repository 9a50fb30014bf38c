//! One episode of a tree or a policy, tick by tick, for those who look on.

use super::load::Loaded;
use super::refused::Refused;
use super::run::Subject;
use super::world;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::learn::greedy::Greedy;
use crate::trial::play;
use crate::world::{Simulation, Simulator, Start, Tick};

/// What was done in a tick.
#[derive(Clone, Copy, Debug)]
pub struct Done {
    /// The behaviour that drove the robot or, where none did, was ticked last, with its answer.
    pub behavior: Option<(Id<Behavior>, Status)>,
    /// What the tick led to.
    pub tick: Tick,
}

/// Who looks on: shown the atoms, the world and what was done, it says whether to go on.
pub type Look<'l> = dyn FnMut(&[Atom], &Simulation, Option<Done>) -> bool + 'l;

/// Plays an episode; `look` is shown the world before the first tick and after every tick, with what was done in it, and
/// says whether to go on. The atoms are those that the bits of [`Simulation::atoms`] mean.
///
/// # Errors
/// As [`run`](super::run::run).
pub fn watch(
    loaded: &Loaded,
    subject: &Subject,
    start: Start,
    look: &mut Look<'_>,
) -> Result<(), Refused> {
    let program = &loaded.program;
    let id = subject.task(loaded)?;
    match subject {
        Subject::Tree(tree) => {
            let root = &program.trees[*tree].root;
            let (simulator, mut ticked) =
                play::ready(program, id, root).map_err(|why| world::unplayable(loaded, why))?;
            play_through(&simulator, start, look, |simulation| {
                let (mut driver, mut drives) = (None, false);
                ticked.tick_noting(simulation, |behavior, status| {
                    if !drives {
                        driver = Some((behavior, status));
                        drives = status == Status::Running;
                    }
                });
                driver
            });
        }
        Subject::Policy(policy, _) => {
            let starts = &program.tasks[id].start;
            let simulator = Simulator::build(program, id, &[starts], &[])
                .map_err(|error| world::unplayable(loaded, error))?;
            let mut greedy = Greedy::new(policy, program, id);
            play_through(&simulator, start, look, |simulation| {
                let behavior = greedy.choose(simulation.key());
                Some((behavior, simulation.act(behavior)))
            });
        }
    }
    Ok(())
}

fn play_through(
    simulator: &Simulator,
    start: Start,
    look: &mut Look<'_>,
    mut act: impl FnMut(&mut Simulation) -> Option<(Id<Behavior>, Status)>,
) {
    let mut simulation = simulator.simulation();
    simulation.start(start);
    let mut goes_on = look(simulator.atoms(), &simulation, None);
    while goes_on {
        simulation.begin_tick();
        let behavior = act(&mut simulation);
        let tick = simulation.end_tick();
        let done = Done { behavior, tick };
        goes_on = look(simulator.atoms(), &simulation, Some(done)) && tick.end.is_none();
    }
}
