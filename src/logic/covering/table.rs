//! Some rows of a table alone, with their classes.

use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::random::Random;

#[derive(Clone)]
pub(super) struct Table {
    pub(super) columns: Columns,
    /// The classes that have rows here, with these.
    pub(super) classes: Vec<(usize, Bits)>,
}

impl Table {
    pub(super) fn of(columns: &Columns, classes: &[Bits], among: &Bits, account: &Account) -> Self {
        let classes = classes.iter().enumerate();
        Self::picked(columns, classes, among, account)
    }

    pub(super) fn among(&self, among: &Bits, account: &Account) -> Self {
        let classes = self.classes.iter().map(|(number, own)| (*number, own));
        Self::picked(&self.columns, classes, among, account)
    }

    fn picked<'c>(
        columns: &Columns,
        classes: impl Iterator<Item = (usize, &'c Bits)>,
        among: &Bits,
        account: &Account,
    ) -> Self {
        let rows: Vec<usize> = among.iter().collect();
        let own = |members: &Bits| {
            let own = rows.iter().enumerate();
            let own = own.filter(|(_, row)| members.contains(**row));
            Bits::collect(rows.len(), own.map(|(at, _)| at))
        };
        let classes = classes.filter(|(_, members)| !members.is_disjoint(among));
        let classes: Vec<(usize, Bits)> = classes
            .map(|(number, members)| (number, own(members)))
            .collect();
        account.spend(((4 + columns.atoms() + classes.len()) * rows.len()) as u64);
        Self {
            columns: columns.pick(&rows),
            classes,
        }
    }

    /// The same rows with at most so many of the atoms that divide them, if it does not matter which do.
    pub(super) fn dividing(self, most: usize) -> Self {
        Self {
            columns: self.columns.dividing(most),
            ..self
        }
    }

    /// The same rows, their classes exchanged at random.
    pub(super) fn shuffled(&self, random: &mut Random) -> Self {
        let mut places: Vec<usize> = (0..self.columns.rows()).collect();
        for at in (1..places.len()).rev() {
            places.swap(at, random.below(at + 1));
        }
        let moved = |own: &Bits| {
            let rows = own.iter().filter_map(|row| places.get(row).copied());
            Bits::collect(own.bound(), rows)
        };
        let classes = self.classes.iter();
        Self {
            columns: self.columns.clone(),
            classes: classes.map(|(class, own)| (*class, moved(own))).collect(),
        }
    }

    /// The class to which all of these rows belong.
    pub(super) fn sole(&self, rows: &Bits) -> Option<usize> {
        let mut classes = self.classes.iter();
        let sole = classes.find(|(_, own)| rows.is_subset(own));
        sole.map(|(class, _)| *class)
    }
}
