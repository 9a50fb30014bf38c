//! Claims that speak of more time than there is.

use crate::check::Checker;
use crate::check::tree::written;
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::task::{ClaimKind, Task, TreeRef};
use crate::syntax::ast::{Item, ItemKind};

impl<'a> Checker<'a> {
    /// `within` a time that no episode of the task lasts.
    pub fn claims_beyond_episodes(&mut self, items: impl Iterator<Item = &'a Item>) {
        for item in items {
            let ItemKind::Claim(claim) = &item.kind else {
                continue;
            };
            let text = written(claim);
            let checked = self.program.claims.iter().find(|found| found.text == text);
            let Some((time, checked)) = claim.within.as_ref().zip(checked) else {
                continue;
            };
            let (ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence)) = &checked.kind
            else {
                continue;
            };
            let limit = self
                .claimed_in(checked.tree)
                .map(|task| self.program.tasks[task].end_after);
            if let Some(limit) = limit.filter(|limit| occurrence.within > Some(*limit)) {
                self.warning(Code::W0512, time.span, "no episode lasts so long")
                    .label("so the claim is about whole episodes")
                    .note(format!("an episode ends after {limit} ticks"))
                    .help("leave `within` out, or let `end after` be as late");
            }
        }
    }

    /// The task that a claim on a tree is tested in; `None` if that is not clear.
    fn claimed_in(&self, tree: TreeRef) -> Option<Id<Task>> {
        let program = &self.program;
        let own = match tree {
            TreeRef::Tree(id) => program.trees[id].task,
            TreeRef::Learned(id) => Some(program.learners[id].task),
        };
        let only = || program.tasks.ids().next();
        own.or_else(|| only().filter(|_| program.tasks.len() == 1))
    }
}
