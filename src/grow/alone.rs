//! Behaviours alone, and which of them shows best that nothing is done.

use super::race::{Entrant, Judge};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::trial::paired::Trials;

/// The episodes in which behaviours that do the same are compared, and the part of its ticks from which on one does something.
const NAMED: usize = 24;
const DOES: f64 = 0.5;

/// A behaviour alone that hardly ever does anything by a plainer name: of those that return the same in each episode, the one that
/// fails least. Where doing nothing is best, one that always fails would be read as if it did something.
pub(super) fn plainest<W: World>(
    judge: &mut Judge<'_, '_, W>,
    trials: &Trials<'_, W>,
    root: Node,
) -> Node {
    let Node::Behavior(own) = root else {
        return root;
    };
    let choices = judge.ground.choices.iter();
    let others = choices.copied().filter(|choice| *choice != own);
    let alone: Vec<Id<Behavior>> = std::iter::once(own).chain(others).collect();
    let ready = alone.iter().map(|choice| Node::Behavior(*choice));
    let ready = ready.filter_map(|root| judge.entrant(trials, &root));
    let mut entrants: Vec<Entrant> = ready.collect();
    if entrants.len() < alone.len() {
        return root;
    }
    let (first, others) = entrants.split_at_mut(1);
    let episodes = judge.scaled(NAMED);
    judge.play(trials, first, episodes, None);
    let does = |choice, entrant: &Entrant| entrant.contender.driven(choice);
    let totals = |entrant: &Entrant| entrant.contender.each(|episode| episode.total);
    let Some(same) = first.first().filter(|it| does(own, it) < DOES).map(totals) else {
        return root;
    };
    judge.play(trials, others, episodes, None);
    let alike = alone.into_iter().zip(&entrants);
    let alike = alike.filter(|(_, entrant)| totals(entrant) == same);
    let driven = alike.map(|(choice, entrant)| (choice, does(choice, entrant)));
    let best = driven.reduce(|best, next| if next.1 > best.1 { next } else { best });
    best.map_or(root, |(choice, _)| Node::Behavior(choice))
}
