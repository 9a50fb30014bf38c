//! The beam searches over one configuration, and what they have of an account.

use super::beam::{Beam, Bounds};
use super::minimiser::Minimiser;
use super::problem::Problem;
use super::rules::Rules;
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Account, Cover, Cube};
use rayon::prelude::*;

/// One without groups, and one with groups.
const BEAMS: [Bounds; 2] = [
    Bounds {
        width: 24,
        inner: 1,
        depth: 1,
    },
    Bounds {
        width: 8,
        inner: 2,
        depth: 3,
    },
];

/// The trees of both, by rules from these covers and cubes. Each has an equal part of what the account has left.
pub(super) fn trees(
    problem: &Problem,
    subunits: &[Subunit],
    covers: &[&Cover],
    cubes: &[&Cube],
    account: &Account,
) -> Vec<Node> {
    let searched = BEAMS.par_iter().map(|bounds| {
        let minimiser = Minimiser::new(problem, account.part(BEAMS.len()));
        let rules = Rules::new(&minimiser, covers, cubes);
        let trees = Beam::new(&minimiser, subunits, rules, *bounds).trees();
        (minimiser.account, trees)
    });
    let searched: Vec<(Account, Vec<Node>)> = searched.collect();
    searched.iter().for_each(|(part, _)| account.settle(part));
    searched.into_iter().flat_map(|(_, trees)| trees).collect()
}
