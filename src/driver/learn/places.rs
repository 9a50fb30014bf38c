//! Where in the program something stands that a result is about.

use crate::driver::load::Loaded;
use crate::driver::target;
use crate::ir::Name;
use crate::ir::task::{Learner, Task, Written};
use crate::source::Span;
use crate::syntax::ast::{self, Aspect, AspectKind, ItemKind};

/// The places of a learner and its task. What cannot be found stands at the task's name, or at the end of the file.
pub(super) struct Places<'a> {
    /// The program.
    pub loaded: &'a Loaded,
    task: Option<&'a ast::Task>,
    written: &'a Written,
    /// The name of the learner's task, where the learner stands.
    pub learner: Span,
}

impl<'a> Places<'a> {
    pub(super) fn of(loaded: &'a Loaded, learner: &Learner, task: &'a Task) -> Self {
        let mut found = Self {
            loaded,
            task: None,
            written: &task.written,
            learner: target::end_of_file(loaded),
        };
        for item in loaded.asts().flat_map(|file| &file.items) {
            match &item.kind {
                ItemKind::Task(item) if task.name.is(&item.name.name) => found.task = Some(item),
                ItemKind::Learn(item) if task.name.is(&item.task.name) => {
                    let name = item.name.as_ref().map_or("learned", |name| &name.name);
                    if learner.name.is(name) {
                        found.learner = item.name.as_ref().unwrap_or(&item.task).span;
                    }
                }
                _ => {}
            }
        }
        found
    }

    /// The name of a tree, where it stands.
    pub(super) fn tree(&self, name: &Name) -> Span {
        let mut items = self.loaded.asts().flat_map(|file| &file.items);
        let found = items.find_map(|item| match &item.kind {
            ItemKind::Tree(tree) if name.is(&tree.name.name) => Some(tree.name.span),
            _ => None,
        });
        found.unwrap_or(self.learner)
    }

    /// The first that is found in an aspect of the task.
    fn find(&self, of: impl Fn(&'a Aspect) -> Option<Span>) -> Span {
        let found = self.task.and_then(|task| task.aspects.iter().find_map(of));
        found
            .or(self.task.map(|task| task.name.span))
            .unwrap_or(self.learner)
    }

    /// A behaviour of `choose`, by its place there.
    pub(super) fn choice(&self, at: usize) -> Span {
        let at = self.written.choose.get(at).copied().unwrap_or(at);
        self.find(|aspect| match &aspect.kind {
            AspectKind::Choose(choices) => choices.get(at).map(|choice| choice.span),
            _ => None,
        })
    }

    /// A line of `reward`, by its place there: its event.
    pub(super) fn reward(&self, at: usize) -> Span {
        let at = self.written.reward.get(at).copied().unwrap_or(at);
        self.find(|aspect| match &aspect.kind {
            AspectKind::Reward { lines, .. } => lines.get(at).map(|line| line.paid.span()),
            _ => None,
        })
    }

    /// The rewards of the task.
    pub(super) fn rewards(&self) -> Span {
        self.find(|aspect| match &aspect.kind {
            AspectKind::Reward { lines, otherwise } => {
                let line = lines.first().map(|line| line.span);
                line.or(otherwise.as_ref().map(|value| value.span))
            }
            _ => None,
        })
    }

    /// A line of `end on`, by its place among them.
    pub(super) fn end(&self, at: usize) -> Span {
        let at = self.written.end_on.get(at).copied().unwrap_or(at);
        let aspects = self.task.map(|task| task.aspects.as_slice());
        let ends = aspects.unwrap_or_default().iter();
        let mut ends = ends.filter_map(|aspect| match &aspect.kind {
            AspectKind::EndOn(event) => Some(event.span),
            _ => None,
        });
        ends.nth(at).unwrap_or_else(|| self.find(|_| None))
    }
}
