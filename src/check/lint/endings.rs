//! Endings that are asked for and never come.

use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::Name;
use crate::ir::law::Behavior;
use crate::ir::tree::Status;
use crate::ir::{Id, Program};
use crate::source::Span;
use std::collections::{BTreeMap, BTreeSet};

/// A place where the program asks whether a behaviour has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Asked {
    /// Where it asks.
    pub span: Span,
    /// The behaviour.
    pub behavior: Id<Behavior>,
    /// How it is to have ended, or that it runs.
    pub status: Status,
}

impl Checker<'_> {
    /// The name of a behaviour that is run and does what this one does, for the same robot: an alias of it.
    fn runs_as(&self, asked: Id<Behavior>, run: Option<&BTreeSet<Id<Behavior>>>) -> Option<&Name> {
        let asked = &self.program.behaviors[asked];
        let mut run = run?.iter().map(|id| &self.program.behaviors[*id]);
        let same = run.find(|it| {
            it.law.is_some() && it.law == asked.law && it.name.robot() == asked.name.robot()
        });
        same.map(|it| &it.name)
    }

    /// The behaviours that the robots beside the learning one run.
    pub fn run_by_others(&self) -> BTreeSet<Id<Behavior>> {
        by_others(&self.program)
    }

    /// `success(b)`, `failure(b)`, `done(b)`, `failed(b)` of a behaviour that never ends so: one message for each behaviour and
    /// outcome. These and `running(b)` of one that nothing runs: one message for each. Where one text stands for a family, one
    /// member of which it may hold is enough.
    pub fn endings_that_never_come(&mut self) {
        let run = run(&self.program);
        let asked = std::mem::take(&mut self.endings);
        let ends = |asked: &Asked| match asked.status {
            Status::Running => true,
            status => self.program.may_end(asked.behavior, status),
        };
        let may = |asked: &&Asked| {
            ends(asked) && run.as_ref().is_none_or(|run| run.contains(&asked.behavior))
        };
        let come: BTreeSet<Span> = asked.iter().filter(may).map(|asked| asked.span).collect();
        let mut places: BTreeMap<(Id<Behavior>, Option<Status>), Vec<Span>> = BTreeMap::new();
        for asked in asked.iter().filter(|asked| !come.contains(&asked.span)) {
            let never_ends = (!ends(asked)).then_some(asked.status);
            let key = (asked.behavior, never_ends);
            places.entry(key).or_default().push(asked.span);
        }
        for ((behavior, never_ends), places) in places {
            let Some((&first, more)) = places.split_first() else {
                continue;
            };
            let name = self.program.behaviors[behavior].name.clone();
            let draft = if let Some(status) = never_ends {
                let (verb, clause) = match status {
                    Status::Failure => ("fails", "neither `requires` nor `fail when`"),
                    _ => ("succeeds", "no `succeed when` that can hold"),
                };
                self.error(Code::E0611, first, format!("`{name}` never {verb}"))
                    .note(format!("it has {clause}"))
            } else if run.as_ref().is_some_and(|run| !run.contains(&behavior)) {
                let own = name.of_acting();
                let message = match name.robot() {
                    Some(robot) => format!("the robot `{robot}` never runs `{own}`"),
                    None => format!("no task chooses `{name}`, and no tree runs it"),
                };
                let family = run
                    .iter()
                    .flatten()
                    .map(|id| &self.program.behaviors[*id].name);
                let family: Vec<&Name> = family.filter(|run| run.family == name.family).collect();
                let mut same = family.iter().filter(|run| run.arguments == name.arguments);
                let elsewhere = same.find_map(|run| run.robot());
                let relatives = family.iter().filter(|run| run.robot() == name.robot());
                let relatives: Vec<&&Name> = relatives.collect();
                // Of the same place, or else any.
                let alike = |run: &&&&Name| run.arguments.first() == name.arguments.first();
                let relative = relatives.iter().find(alike).or(relatives.first());
                let help = match (elsewhere, relative, name.robot()) {
                    _ if let Some(same) = self.runs_as(behavior, run.as_ref()) => {
                        format!(
                            "`{}` is run, which does the same: ask that",
                            same.of_acting()
                        )
                    }
                    // Who names the robot means that one.
                    (Some(_), Some(relative), Some(robot)) if alike(&relative) => {
                        format!(
                            "`{robot}` runs `{}`, which is another behaviour: ask that, or let `{robot}` run `{own}`",
                            relative.of_acting()
                        )
                    }
                    (Some(robot), ..) => {
                        format!("the robot `{robot}` runs it: that is asked with `by = {robot}`")
                    }
                    (None, Some(relative), _) => {
                        format!(
                            "`{}` is run, which is another behaviour: ask that, or add `{own}`",
                            relative.of_acting()
                        )
                    }
                    (None, None, Some(robot)) => {
                        format!("let the tree that `{robot}` runs do it, or ask another behaviour")
                    }
                    (None, None, None) => {
                        format!("add `{name}` to `choose`, or ask another behaviour")
                    }
                };
                self.error(Code::E0611, first, message).help(help)
            } else {
                continue;
            };
            let draft = draft.label("so this never holds");
            more.iter()
                .fold(draft, |draft, place| draft.also(*place, "nor does this"))
                .emit();
        }
    }
}

/// The behaviours that tasks choose and trees run; `None` if the program has no task.
fn run(program: &Program) -> Option<BTreeSet<Id<Behavior>>> {
    if program.tasks.is_empty() {
        return None;
    }
    let mut run: BTreeSet<_> = program
        .tasks
        .values()
        .flat_map(|task| task.choose.iter().copied())
        .chain(
            program
                .learners
                .values()
                .filter_map(|learner| learner.unseen),
        )
        .collect();
    for tree in program.trees.values() {
        tree.root.visit_behaviors(&mut |id| {
            run.insert(id);
        });
    }
    run.extend(by_others(program));
    Some(run)
}

/// The behaviours that other robots run.
fn by_others(program: &Program) -> BTreeSet<Id<Behavior>> {
    let mut run = BTreeSet::new();
    let others = program.world.iter().flat_map(|world| world.others.values());
    for script in others.filter_map(|other| other.script.as_ref()) {
        script.visit_behaviors(&mut |id| {
            run.insert(id);
        });
    }
    run
}
