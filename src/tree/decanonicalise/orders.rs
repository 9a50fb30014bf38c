//! Decision lists of whole subunits in a given order.

use super::minimiser::Minimiser;
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover, Effort, Order, list_within};
use crate::tree::unit::{guarded, selector};

/// The subunits from the left: the number of each, and its cover against those that follow; `None` if the account is spent.
pub(super) fn in_order(
    minimiser: &Minimiser,
    subunits: &[Subunit],
    order: Order,
) -> Option<Vec<(usize, Cover)>> {
    let classes: Vec<Bits> = subunits
        .iter()
        .map(|subunit| subunit.rows.clone())
        .collect();
    list_within(
        minimiser.problem.columns(),
        &classes,
        order,
        &Effort::default(),
        &minimiser.account,
    )
}

/// The list as a tree. The guard of a unit is its factored cover or the negated one of all that follows, whichever is
/// smaller.
pub(super) fn tree(minimiser: &Minimiser, subunits: &[Subunit], list: &[(usize, Cover)]) -> Node {
    let mut left = minimiser.problem.all();
    let units = list.iter().filter_map(|(number, cover)| {
        let subunit = subunits.get(*number)?;
        left.subtract(&subunit.rows);
        if subunit.guards_itself {
            return Some(subunit.body.clone());
        }
        let mut guard = minimiser.factored(cover);
        if cover.cubes().len() > 1 && minimiser.may_minimise(&subunit.rows, &left) {
            let other = minimiser.guard(&subunit.rows, &left);
            if let Some(other) = other.filter(|other| other.price < guard.price) {
                guard = (*other).clone();
            }
        }
        Some(guarded(guard.guard, subunit.body.clone()))
    });
    selector(units)
}
