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

/// A behaviour alone that hardly ever does anything by a plainer name: of those that return the same in each of a few episodes, the
/// one that fails least, if it returns the same in `episodes`, too. Where doing nothing is best, one that always fails would be read
/// as if it did something.
pub(super) fn plainest<W: World>(
    judge: &mut Judge<'_, '_, W>,
    trials: &Trials<'_, W>,
    root: Node,
    episodes: usize,
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
    let does = |choice, entrant: &Entrant| entrant.contender.driven(choice);
    let totals = |entrant: &Entrant| entrant.contender.each(|episode| episode.total);
    let shown = judge.scaled(NAMED);
    let Some((first, others)) = entrants.split_first_mut() else {
        return root;
    };
    judge.play(trials, std::slice::from_mut(first), shown, None);
    if does(own, first) >= DOES {
        return root;
    }
    judge.play(trials, others, shown, None);
    let same = totals(first);
    let alike = alone.into_iter().skip(1).zip(others);
    let alike = alike.filter(|(_, entrant)| totals(entrant) == same);
    let driven = alike.map(|(choice, entrant)| (does(choice, entrant), choice, entrant));
    let best = driven.reduce(|best, next| if next.0 > best.0 { next } else { best });
    let Some((_, choice, plain)) = best.filter(|(part, ..)| *part >= DOES) else {
        return root;
    };
    // What is lost seldom shows late.
    for entrant in [&mut *first, &mut *plain] {
        judge.play(trials, std::slice::from_mut(entrant), episodes, None);
    }
    match totals(plain) == totals(first) {
        true => Node::Behavior(choice),
        false => root,
    }
}
