//! `btc check`: what is known of a program before its first tick, though not from its text alone.

use super::load::Loaded;
use super::run;
use crate::diagnostic::Diagnostic;
use crate::ir::Program;
use crate::ir::task::{StartLine, Task};

/// Why the world of a task cannot be built: the robot fits nowhere, or not where it is to start, or the task is too
/// large. Tasks with something that is declared only are not meant to be run.
pub fn worlds(loaded: &Loaded) -> Option<Diagnostic> {
    let program = &loaded.program;
    if loaded.has_errors() || program.world.is_none() {
        return None;
    }
    let mut tasks = program.tasks.iter();
    tasks.find_map(|(id, task)| {
        if !is_defined(program, task) {
            return None;
        }
        let learners = program.learners.values();
        let own = learners
            .filter(|learner| learner.task == id)
            .map(|learner| learner.start.as_slice());
        let starts: Vec<&[StartLine]> = std::iter::once(task.start.as_slice()).chain(own).collect();
        run::build(loaded, id, &starts, &[]).err()
    })
}

fn is_defined(program: &Program, task: &Task) -> bool {
    let predicates = &mut task.observe.iter().map(|&id| &program.predicates[id]);
    let behaviors = &mut task.choose.iter().map(|&id| &program.behaviors[id]);
    predicates.all(|predicate| predicate.when.is_some())
        && behaviors.all(|behavior| behavior.law.is_some())
}
