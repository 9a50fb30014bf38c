//! Neighbours in a list that change places.

use super::{Cost, Entry, union, within};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::{Cover, Cube};
use crate::logic::minimise::Effort;

/// Lets neighbours change places while that makes their covers cheaper.
///
/// Taking the cheapest first may take a class whose cover would be cheaper still after a neighbour that costs the same
/// before and after.
pub(super) fn exchange(columns: &Columns, list: &mut [Entry], effort: &Effort, account: &Account) {
    let mut changed = true;
    while changed && !account.is_spent() {
        changed = false;
        let mut after = Bits::empty(columns.rows());
        for at in (1..list.len()).rev() {
            let Some([first, second]) = list.get_mut(at - 1..=at) else {
                continue;
            };
            if let Some(exchanged) = exchanged(columns, first, second, &after, effort, account) {
                (*first, *second) = exchanged;
                changed = true;
            }
            after.unite(second.class.rows);
        }
    }
}

/// The two in the other order, if that is cheaper; `after` are the rows of all that follow.
fn exchanged<'a>(
    columns: &Columns,
    first: &Entry<'a>,
    second: &Entry<'a>,
    after: &Bits,
    effort: &Effort,
    account: &Account,
) -> Option<(Entry<'a>, Entry<'a>)> {
    let limit = add(first.cost(), second.cost());
    let off = union(columns, [after, first.class.rows].into_iter());
    let cover = within(columns, second.class, &off, limit, effort, account)?;
    let earlier = Entry {
        cover,
        ..second.clone()
    };
    let rest = (limit.0.checked_sub(earlier.cost().0)?, usize::MAX);
    let cover = match after.is_empty() {
        true => Cover::new([Cube::default()]),
        false => within(columns, first.class, after, rest, effort, account)?,
    };
    let later = Entry {
        cover,
        ..first.clone()
    };
    (add(earlier.cost(), later.cost()) < limit).then_some((earlier, later))
}

fn add(a: Cost, b: Cost) -> Cost {
    (a.0 + b.0, a.1 + b.1)
}
