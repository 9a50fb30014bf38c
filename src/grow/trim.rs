//! What a tree does without: parts whose loss changes no episode.
//!
//! A behaviour that fails at once where it cannot run needs no guard that keeps it from that, and a node that was never of
//! use in hundreds of episodes tells its reader nothing. The counts of a search cannot tell that; episodes can.

use super::race::{Entrant, Judge};
use crate::ir::tree::Node;
use crate::learn::process::World;
use crate::tree::prune::{Requirement, candidates};
use crate::trial::paired::Trials;

/// The episodes in which smaller trees are compared with the tree, step by step: few differences show late.
const STEPS: [usize; 3] = [2, 8, 24];
/// The most nodes of a tree that is looked at.
const MOST: usize = 120;
/// What rounding may change of a return, as a part of it.
const ROUNDED: f64 = 1e-9;

/// The smallest tree that one change after another makes of this one and that earned and harmed as it did in each of so many
/// episodes; those that it has played already are not played again.
pub(super) fn trimmed<W: World>(
    judge: &mut Judge<'_, '_, W>,
    trials: &Trials<'_, W>,
    (mut whole, requirements): (Entrant, &[Requirement]),
    episodes: usize,
) -> Node {
    if whole.nodes > MOST {
        return whole.root;
    }
    let mut ways: Vec<Entrant> = Vec::new();
    loop {
        let base = ways.last_mut().unwrap_or(&mut whole);
        let Some(next) = smaller(judge, trials, base, requirements) else {
            break;
        };
        ways.push(next);
    }
    if ways.is_empty() {
        return whole.root;
    }
    // What is lost seldom shows late.
    judge.play(trials, std::slice::from_mut(&mut whole), episodes, None);
    for mut less in ways.into_iter().rev() {
        let by = std::slice::from_mut(&mut less);
        judge.play(trials, by, episodes, Some(&whole));
        if does_the_same(judge, &less, &whole) {
            return less.root;
        }
    }
    whole.root
}

/// The smallest of the trees one change away that does the same as this one in a few episodes.
fn smaller<W: World>(
    judge: &mut Judge<'_, '_, W>,
    trials: &Trials<'_, W>,
    base: &mut Entrant,
    requirements: &[Requirement],
) -> Option<Entrant> {
    let less = candidates(&base.root, requirements).into_iter();
    let less = less.filter(|candidate| candidate.size.nodes < base.nodes);
    let less = less.filter_map(|candidate| judge.entrant(trials, &candidate.root));
    let mut less: Vec<Entrant> = less.collect();
    for episodes in STEPS {
        let episodes = judge.scaled(episodes);
        judge.play(trials, std::slice::from_mut(base), episodes, None);
        judge.play(trials, &mut less, episodes, Some(base));
        less.retain(|entrant| does_the_same(judge, entrant, base));
    }
    less.into_iter().min_by_key(|entrant| entrant.nodes)
}

/// Whether two trees earned and harmed alike in each of the episodes that both have played.
fn does_the_same<W: World>(judge: &Judge<'_, '_, W>, one: &Entrant, other: &Entrant) -> bool {
    let figures = [one, other].map(|entrant| {
        let contender = &entrant.contender;
        contender.each(|episode| (episode.total, judge.ground.harm(episode)))
    });
    let [one, other] = figures;
    one.iter().zip(&other).all(|((a, x), (b, y))| {
        let most = a.abs().max(b.abs());
        x == y && (a - b).abs() <= ROUNDED * most
    })
}
