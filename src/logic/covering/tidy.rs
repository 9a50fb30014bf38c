//! What a list can do without.

use super::List;
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;

/// Drops rules whose rows among these the rules behind them decide as well, and literals without which a rule still holds on rows of
/// its class only, until there are none, or the account is spent.
pub(super) fn tidy(
    columns: &Columns,
    classes: &[Bits],
    among: &Bits,
    list: &mut List,
    account: &Account,
) {
    while !account.is_spent() && dropped(columns, classes, among, list, account) {}
}

fn dropped(
    columns: &Columns,
    classes: &[Bits],
    among: &Bits,
    list: &mut List,
    account: &Account,
) -> bool {
    let words = 8 + columns.rows().div_ceil(64);
    account.spend((8 * list.rules.len() * words) as u64);
    let all = Bits::full(columns.rows());
    let none = Bits::empty(columns.rows());
    let own = |class: usize| classes.get(class).unwrap_or(&none);
    // For each place in the list the rows that are decided rightly if they come there.
    let mut right = vec![own(list.last).clone()];
    for rule in list.rules.iter().rev() {
        let meets = columns.cube_meets(&rule.cube, &all);
        let inside = columns.cube_rows(&rule.cube, own(rule.class));
        let after = right
            .last()
            .map_or(none.clone(), |after| after.minus(&meets));
        right.push(after.or(&inside));
    }
    right.reverse();
    let mut reach = among.clone();
    let mut dropped = false;
    let mut at = 0;
    // What goes changes nothing of what is right behind it.
    for after in right.iter().skip(1) {
        let Some(rule) = list.rules.get_mut(at) else {
            break;
        };
        if reach.is_subset(after) {
            list.rules.remove(at);
            dropped = true;
            continue;
        }
        let pure = |cube: &_| columns.cube_meets(cube, &reach).is_subset(own(rule.class));
        loop {
            let literals = rule.cube.literals();
            account.spend((2 * literals.len() * literals.len() * words) as u64);
            let mut shorter = literals.iter().map(|literal| rule.cube.without(*literal));
            let Some(shorter) = shorter.find(pure) else {
                break;
            };
            rule.cube = shorter;
            dropped = true;
        }
        reach.subtract(&columns.cube_rows(&rule.cube, &reach));
        at += 1;
    }
    dropped
}
