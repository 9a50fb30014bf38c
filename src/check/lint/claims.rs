//! Claims that speak of more time than there is, or cannot hold.

use crate::check::Checker;
use crate::check::tree::written;
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::task::{self, ClaimKind, Occurrence, Task, TreeRef};
use crate::ir::tree::Atom;
use crate::source::Span;
use crate::syntax::ast::{Claim, ClaimWhat, Ident, Item, ItemKind};

impl<'a> Checker<'a> {
    /// Warns of claims that speak of more time than there is, or cannot hold.
    pub fn claims_in_vain(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut earlier: Vec<(Span, task::Claim)> = Vec::new();
        for item in items {
            let ItemKind::Claim(claim) = &item.kind else {
                continue;
            };
            let at = claim.tree.span.to(item.span);
            let text = written(claim);
            let checked = self.program.claims.iter().find(|found| found.text == text);
            let Some(checked) = checked.cloned() else {
                continue;
            };
            match &checked.kind {
                ClaimKind::Equals(other) => {
                    if let ClaimWhat::Equals(right) = &claim.what {
                        self.cannot_be_equal(checked.tree, (right, *other));
                        self.cannot_be_equal(*other, (&claim.tree, checked.tree));
                    }
                }
                ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence) => {
                    self.beyond_episodes(claim, checked.tree, occurrence);
                }
            }
            match earlier.iter().find(|(_, it)| contradict(it, &checked)) {
                Some((first, _)) => {
                    let first = *first;
                    self.warning(
                        Code::W0526,
                        at,
                        "no tree satisfies this claim and another one",
                    )
                    .label("this contradicts what is claimed above")
                    .also(first, "the other claim");
                }
                None => earlier.push((at, checked)),
            }
        }
    }

    /// `within` a time that no episode of the task lasts.
    fn beyond_episodes(&mut self, claim: &'a Claim, tree: TreeRef, occurrence: &Occurrence) {
        let limit = self
            .claimed_in(tree)
            .map(|task| self.program.tasks[task].end_after);
        if let Some(time) = &claim.within
            && let Some(limit) = limit.filter(|limit| occurrence.within > Some(*limit))
        {
            self.warning(Code::W0512, time.span, "no episode lasts so long")
                .label("so the claim is about whole episodes")
                .note(format!("an episode ends after {limit} ticks"))
                .help("leave `within` out, or let `end after` be as late");
        }
    }

    /// A learned tree is to be equal to one, named in the claim, that asks or runs what its task does not offer.
    fn cannot_be_equal(&mut self, learned: TreeRef, (named, other): (&Ident, TreeRef)) {
        let (TreeRef::Learned(learner), TreeRef::Tree(tree)) = (learned, other) else {
            return;
        };
        let program = &self.program;
        let id = program.learners[learner].task;
        let (task, tree) = (&program.tasks[id], &program.trees[tree]);
        let known = program.atoms(id);
        let mut unknown = None;
        tree.root.visit_atoms(&mut |atom| {
            unknown = unknown.or((!known.contains(&atom)).then_some(atom));
        });
        let why = match (unknown, task.lacks(tree)) {
            (Some(atom), _) => {
                let seen = match atom {
                    Atom::Predicate(_) => format!("`{}` does not observe", task.name),
                    Atom::Done(_) | Atom::Failed(_) => {
                        format!("the history of `{}` does not keep", task.name)
                    }
                };
                format!("it asks `{}`, which {seen}", program.atom_name(atom))
            }
            (None, Some(behavior)) => {
                let name = &program.behaviors[behavior].name;
                format!("it runs `{name}`, which `{}` does not choose", task.name)
            }
            (None, None) => return,
        };
        let message = format!("no tree that is learned is equal to `{}`", named.name);
        self.warning(Code::W0526, named.span, message).label(why);
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

/// Whether two claims on one tree cannot both hold: more of its episodes would have to be with an event and without it than
/// there are.
fn contradict(one: &task::Claim, other: &task::Claim) -> bool {
    let (never, reaches) = match (&one.kind, &other.kind) {
        (ClaimKind::Never(never), ClaimKind::Reaches(reaches))
        | (ClaimKind::Reaches(reaches), ClaimKind::Never(never)) => (never, reaches),
        _ => return false,
    };
    let no_longer = match (never.within, reaches.within) {
        (None, _) => true,
        (Some(_), None) => false,
        (Some(never), Some(reaches)) => reaches <= never,
    };
    one.tree == other.tree
        && never.event == reaches.event
        && no_longer
        && never.probability + reaches.probability > 1.0
}
