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
/// episodes.
pub(super) fn trimmed<W: World>(
    judge: &mut Judge<'_, '_, W>,
    trials: &Trials<'_, W>,
    (root, requirements): (Node, &[Requirement]),
    episodes: usize,
) -> Node {
    let Some(mut base) = judge.entrant(trials, &root).filter(|it| it.nodes <= MOST) else {
        return root;
    };
    let mut ways = vec![root];
    while let Some(next) = smaller(judge, trials, &mut base, requirements) {
        ways.push(next.root.clone());
        base = next;
    }
    // What is lost seldom shows late.
    let mut ways = ways.into_iter();
    let Some(root) = ways.next() else {
        return base.root;
    };
    let Some(mut whole) = judge.entrant(trials, &root).filter(|_| ways.len() > 0) else {
        return root;
    };
    judge.play(trials, std::slice::from_mut(&mut whole), episodes, None);
    for way in ways.rev() {
        let Some(mut less) = judge.entrant(trials, &way) else {
            continue;
        };
        judge.play(
            trials,
            std::slice::from_mut(&mut less),
            episodes,
            Some(&whole),
        );
        if does_the_same(judge, &less, &whole) {
            return way;
        }
    }
    root
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
