//! `btc check`: mistakes that show only when the world of a program is built.

use super::load::Loaded;
use super::world;
use crate::diagnostic::{Applicability, Diagnostic};
use crate::ir::Program;
use crate::ir::task::{StartLine, Task};
use crate::source::Span;
use crate::world::Simulator;

/// The first world that cannot be built: the robot fits nowhere, or not where it starts, or the task is too large. Tasks
/// that use something that is declared only are not meant to run, and are left out.
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
        let error = Simulator::build(program, id, &starts, &[]).err()?;
        Some(world::unbuilt(loaded, &error))
    })
}

/// The changes to the main file that may be made unseen: the fixes that keep or restore what was meant, as far as they do
/// not touch each other.
pub fn fixes(loaded: &Loaded) -> Vec<(Span, String)> {
    let mut edits: Vec<(Span, String)> = Vec::new();
    let fixes = loaded.diagnostics.iter().flat_map(|found| &found.fixes);
    for fix in fixes.filter(|fix| fix.applicability == Applicability::Safe) {
        let fits = |(span, _): &(Span, String)| {
            span.file == loaded.main
                && edits
                    .iter()
                    .all(|(other, _)| span.end < other.start || other.end < span.start)
        };
        if fix.edits.iter().all(fits) {
            edits.extend(fix.edits.iter().cloned());
        }
    }
    edits
}

fn is_defined(program: &Program, task: &Task) -> bool {
    let predicates = &mut task.observe.iter().map(|&id| &program.predicates[id]);
    let behaviors = &mut task.choose.iter().map(|&id| &program.behaviors[id]);
    predicates.all(|predicate| predicate.when.is_some())
        && behaviors.all(|behavior| behavior.law.is_some())
}
