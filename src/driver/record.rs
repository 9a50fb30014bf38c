//! One episode of a tree or a policy, tick by tick, for those who look on.

use super::load::Loaded;
use super::refused::Refused;
use super::run::Subject;
use super::world;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Status};
use crate::ir::{Id, Program};
use crate::learn::greedy::Greedy;
use crate::trial::play;
use crate::world::{Simulation, Simulator, Start, Tick};

/// A behaviour that was ticked, with its answer.
pub type Answered = (Id<Behavior>, Status);

/// What was done in a tick.
#[derive(Clone, Debug)]
pub struct Done {
    /// The behaviour that drove the robot; where none did, the first that goes on or, if none does, that was ticked last.
    pub behavior: Option<Answered>,
    /// The others that were ticked, in order.
    pub beside: Vec<Answered>,
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
                let mut calls = Vec::new();
                ticked.tick_noting(simulation, |behavior, status| {
                    calls.push((behavior, status));
                });
                let driver = driver(program, &calls);
                (driver.map(|at| calls.remove(at)), calls)
            });
        }
        Subject::Policy(policy, _) => {
            let starts = &program.tasks[id].start;
            let simulator = Simulator::build(program, id, &[starts], &[])
                .map_err(|error| world::unplayable(loaded, error))?;
            let mut greedy = Greedy::new(policy, program, id);
            play_through(&simulator, start, look, |simulation| {
                let behavior = greedy.choose(simulation.key());
                (Some((behavior, simulation.act(behavior))), Vec::new())
            });
        }
    }
    Ok(())
}

/// Which of the behaviours that were ticked one looks at first.
fn driver(program: &Program, calls: &[Answered]) -> Option<usize> {
    let goes_on = |(_, status): &Answered| *status == Status::Running;
    let drives = |(id, _): &Answered| {
        let law = program.behaviors[*id].law.as_ref();
        law.is_some_and(|law| law.control.may_drive())
    };
    let driver = calls.iter().position(|call| goes_on(call) && drives(call));
    let driver = driver.or_else(|| calls.iter().position(goes_on));
    driver.or(calls.len().checked_sub(1))
}

fn play_through(
    simulator: &Simulator,
    start: Start,
    look: &mut Look<'_>,
    mut act: impl FnMut(&mut Simulation) -> (Option<Answered>, Vec<Answered>),
) {
    let mut simulation = simulator.simulation();
    simulation.start(start);
    let mut goes_on = look(simulator.atoms(), &simulation, None);
    while goes_on {
        simulation.begin_tick();
        let (behavior, beside) = act(&mut simulation);
        let tick = simulation.end_tick();
        let done = Done {
            behavior,
            beside,
            tick,
        };
        goes_on = look(simulator.atoms(), &simulation, Some(done)) && tick.end.is_none();
    }
}
