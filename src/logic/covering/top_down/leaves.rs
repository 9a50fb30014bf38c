//! How hard rows are to tell apart.

use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::covering::table::Table;
use crate::logic::impurity::{Impurity, n_log_n};

/// Rows that are so many times fewer than their table are read faster alone.
const FEW: usize = 4;

/// The work of the rows of a class, besides their words.
const CLASS: usize = 16;

/// The leaves of a decision tree for these rows, by the entropy of its parts; `None` if they are more than `most`, or the account is spent.
pub(super) fn leaves(table: &Table, among: &Bits, most: usize, account: &Account) -> Option<usize> {
    let mut left = most;
    count(table, among, &mut left, account)?;
    Some(most - left)
}

fn count(table: &Table, among: &Bits, left: &mut usize, account: &Account) -> Option<()> {
    let rows = table.columns.rows();
    if rows > 64 && FEW * among.count() <= rows {
        let alone = table.among(among, account).dividing(usize::MAX);
        let all = Bits::full(alone.columns.rows());
        return divide(&alone, &all, left, account);
    }
    divide(table, among, left, account)
}

fn divide(table: &Table, among: &Bits, left: &mut usize, account: &Account) -> Option<()> {
    account.spend((table.classes.len() * (CLASS + table.columns.rows() / 64)) as u64);
    let classes = table.classes.iter().map(|(_, own)| own.and(among));
    let classes: Vec<Bits> = classes.filter(|own| !own.is_empty()).collect();
    // A row may be of several classes.
    let rows = among.count();
    let mut sizes = classes.iter().map(Bits::count);
    if sizes.clone().sum::<usize>() == rows && classes.len() > *left {
        // Each class has a leaf at least.
        return None;
    }
    let divided = sizes.all(|own| own < rows);
    let atom = divided.then(|| best(table, &classes, account));
    let Some(atom) = atom.flatten() else {
        *left = left.checked_sub(1)?;
        return Some(());
    };
    let (_, column) = table.columns.iter().nth(atom)?;
    if account.is_spent() {
        return None;
    }
    let one = among.and(column);
    count(table, &one, left, account)?;
    count(table, &among.minus(&one), left, account)
}

/// The atom that makes the parts least mixed; `None` where there is nothing to divide.
fn best(table: &Table, classes: &[Bits], account: &Account) -> Option<usize> {
    if classes.len() < 2 {
        return None;
    }
    let sizes: Vec<usize> = classes.iter().map(Bits::count).collect();
    let all: usize = sizes.iter().sum();
    let words = 1 + table.columns.rows().div_ceil(64);
    account.spend((table.columns.atoms() * classes.len() * words) as u64);
    let mut best: Option<(f64, usize)> = None;
    for (atom, column) in table.columns.iter() {
        let (mut inside, mut terms) = (0, 0.0);
        for (own, size) in classes.iter().zip(&sizes) {
            let one = own.count_both(column);
            inside += one;
            terms += n_log_n(one as u32) + n_log_n((size - one) as u32);
        }
        if inside == 0 || inside == all {
            continue;
        }
        let mixed = n_log_n(inside as u32) + n_log_n((all - inside) as u32) - terms;
        if best.is_none_or(|(least, _)| Impurity::better(mixed, least)) {
            best = Some((mixed, atom));
        }
    }
    best.map(|(_, atom)| atom)
}
