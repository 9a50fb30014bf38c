//! Claims that speak of more time than there is, or cannot hold.

use super::cases::of_expr;
use super::ranges::range;
use super::rewards::waits_for_others;
use super::view::View;
use crate::check::Checker;
use crate::check::tree::written;
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::expr::Expr;
use crate::ir::task::{self, ClaimKind, Occurrence, Task, TreeRef};
use crate::ir::tree::Atom;
use crate::source::Span;
use crate::syntax::ast::{
    self, AspectKind, Claim, ClaimWhat, ExprKind, Ident, Item, ItemKind, UnaryOp,
};

impl<'a> Checker<'a> {
    /// Warns of claims that speak of more time than there is, or cannot hold.
    pub fn claims_in_vain(&mut self, items: impl Iterator<Item = &'a Item> + Clone) {
        let mut earlier: Vec<(Span, task::Claim)> = Vec::new();
        for item in items.clone() {
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
                    if matches!(checked.kind, ClaimKind::Never(_)) {
                        self.pays_for_it(at, checked.tree, occurrence, items.clone());
                    }
                    if self.cannot_be_reached(claim, checked.tree, occurrence) {
                        continue;
                    }
                    if occurrence.probability == 0.0 {
                        self.always_holds(claim);
                        continue;
                    }
                }
            }
            if let Some((first, it)) = earlier.iter().find(|(_, it)| are_nested(it, &checked)) {
                let (first, weaker) = (*first, implies(it, &checked));
                self.claims_nothing_more(if weaker { [at, first] } else { [first, at] });
                continue;
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

    /// `on dead: +10` in the task of a tree that is never to have it.
    fn pays_for_it(
        &mut self,
        at: Span,
        tree: TreeRef,
        occurrence: &Occurrence,
        mut items: impl Iterator<Item = &'a Item>,
    ) {
        let program = &self.program;
        let Some(task) = self.claimed_in(tree).map(|task| &program.tasks[task]) else {
            return;
        };
        let asks = |id| program.pool.get(id) == Expr::Event(occurrence.event);
        let place = task.reward.iter().position(|line| asks(line.event));
        let place = place.and_then(|place| task.written.reward.get(place).copied());
        let aspects = items.find_map(|item| match &item.kind {
            ItemKind::Task(it) if task.name.is(&it.name.name) => Some(&it.aspects),
            _ => None,
        });
        let mut lines = aspects
            .into_iter()
            .flatten()
            .filter_map(|aspect| match &aspect.kind {
                AspectKind::Reward { lines, .. } => Some(lines),
                _ => None,
            });
        let line = lines.next().and_then(|lines| lines.get(place?));
        let paid = task.reward.iter().filter(|line| asks(line.event));
        let mut least = paid.map(|line| range(View::from(program), line.value).ends().0);
        let pays = least.all(|least| least > 0.0);
        // Of the second sign of `--10` that is told.
        let is_signed = |value: &ast::Expr| matches!(&value.kind, ExprKind::Unary { op, .. } if op.node == UnaryOp::Neg);
        if let Some(line) = line.filter(|line| pays && !is_signed(&line.value)) {
            let name = program.events[occurrence.event].name.clone();
            self.warning(
                Code::W0527,
                line.value.span,
                format!("this pays for `{name}`"),
            )
            .label("a claim rules it out")
            .also(at, "it is never to happen")
            .help("is the sign right?");
        }
    }

    /// Warns of a claim that another one implies, unless something else is told of one of them.
    fn claims_nothing_more(&mut self, [weaker, stronger]: [Span; 2]) {
        let told = self.told();
        if told.overlap(weaker) || told.overlap(stronger) {
            return;
        }
        let message = "this claim holds wherever another one does";
        self.warning(Code::W0303, weaker, message)
            .label("it claims nothing more")
            .also(stronger, "the other claim");
    }

    /// `reaches` an event that waits for the end of a behaviour which the tree does not run; warned of if so.
    fn cannot_be_reached(
        &mut self,
        claim: &'a Claim,
        tree: TreeRef,
        occurrence: &Occurrence,
    ) -> bool {
        let ClaimWhat::Reaches(event) = &claim.what else {
            return false;
        };
        let run = match tree {
            TreeRef::Tree(id) => {
                let mut run = self.run_by_others();
                self.program.trees[id].root.visit_behaviors(&mut |id| {
                    run.insert(id);
                });
                Some(run)
            }
            TreeRef::Learned(id) => self.run_in_learning(self.program.learners[id].task),
        };
        let event_of = &self.program.events[occurrence.event];
        let cases = of_expr(&self.program, event_of.when, true);
        let missing = run.and_then(|run| waits_for_others(&self.program, &run, &[cases]));
        let Some(missing) = missing.filter(|_| occurrence.probability > 0.0) else {
            return false;
        };
        let (tree, event_of) = (&claim.tree.name, event_of.name.clone());
        let behavior = self.program.behaviors[missing].name.clone();
        self.warning(
            Code::W0526,
            event.span,
            format!("`{tree}` never reaches `{event_of}`"),
        )
        .label(format!(
            "it waits for `{behavior}`, which the tree does not run"
        ));
        true
    }

    /// `with probability >= 0%`
    fn always_holds(&mut self, claim: &'a Claim) {
        if let Some((false, probability)) = &claim.probability
            && !self.is_told_within(Code::W0520, probability.span)
        {
            self.warning(
                Code::W0520,
                probability.span,
                "this claim holds whatever the tree does",
            )
            .label("no probability is less than 0%");
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

/// Whether one of two claims on one tree holds wherever the other does.
fn are_nested(one: &task::Claim, other: &task::Claim) -> bool {
    implies(one, other) || implies(other, one)
}

/// Whether the second claim holds wherever the first one does, on the same tree.
fn implies(one: &task::Claim, other: &task::Claim) -> bool {
    let long = |within: Option<u64>| within.unwrap_or(u64::MAX);
    let (strong, weak, no_weaker) = match (&one.kind, &other.kind) {
        (ClaimKind::Never(a), ClaimKind::Never(b)) => (a, b, long(a.within) >= long(b.within)),
        (ClaimKind::Reaches(a), ClaimKind::Reaches(b)) => (a, b, long(a.within) <= long(b.within)),
        _ => return false,
    };
    one.tree == other.tree
        && strong.event == weak.event
        && no_weaker
        && strong.probability >= weak.probability
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
