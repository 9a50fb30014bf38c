//! Lists of whole subunits in the order that is asked for.

use super::covers::{Covers, Priced};
use super::subunit::Subunit;
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover, Effort, Order, list};
use crate::tree::guard::factored;
use crate::tree::unit::{guarded, selector};

/// Every subunit in one place: its number and its cover among those that stand behind it.
pub(super) fn in_order(covers: &Covers, subunits: &[Subunit], order: Order) -> Vec<(usize, Cover)> {
    let classes: Vec<Bits> = subunits
        .iter()
        .map(|subunit| subunit.rows.clone())
        .collect();
    list(
        covers.problem.columns(),
        &classes,
        order,
        &Effort::default(),
    )
}

/// The list as a tree: guards with what their alternatives have in common taken out, or the negated guard of all that
/// stands behind, whichever is smaller.
pub(super) fn tree(covers: &Covers, subunits: &[Subunit], list: &[(usize, Cover)]) -> Node {
    let mut left = covers.problem.all();
    let units = list.iter().filter_map(|(number, cover)| {
        let subunit = subunits.get(*number)?;
        left.subtract(&subunit.rows);
        if subunit.guards_itself {
            return Some(subunit.body.clone());
        }
        let mut guard = Priced::new(factored(cover, &covers.problem.policy.atoms));
        if cover.cubes().len() > 1 && covers.may_minimise(&subunit.rows, &left) {
            let other = covers.guard(&subunit.rows, &left);
            if other.price < guard.price {
                guard = (*other).clone();
            }
        }
        Some(guarded(guard.guard, subunit.body.clone()))
    });
    selector(units)
}
