//! The rest of a list: what greedily decides the rows that a partial list leaves.

use super::Beam;
use crate::logic::Bits;
use crate::tree::decanonicalise::list::{Child, List};
use crate::tree::decanonicalise::rules::{Applied, Rules};
use std::rc::Rc;

impl Beam<'_, '_> {
    /// The rest of these rows; `None` where the effort is spent.
    pub(super) fn rest(&mut self, rows: &Bits) -> Option<Rc<List>> {
        if let Some(known) = self.rests.get(rows) {
            return known.clone();
        }
        if self.stock.minimiser.account.is_spent() {
            return None;
        }
        let found = self.greedy(rows).map(Rc::new);
        self.rests.insert(rows.clone(), found.clone());
        found
    }

    fn greedy(&self, rows: &Bits) -> Option<List> {
        let stock = &self.stock;
        let mut list = List::default();
        let mut left = rows.clone();
        while !left.is_empty() {
            let applied = || stock.applied(&left);
            let (child, rows) = match self.sole(&left) {
                Some(sole) => (Child::Bare(sole), left.clone()),
                None => match applied().into_iter().min_by_key(|a| self.order(a)) {
                    Some(best) => (Child::Ruled(best.subunit, vec![best.rule]), best.rows),
                    None => self.first_whole(&left)?,
                },
            };
            let price = stock.price(&child);
            list = list.with(Rc::new(child), price);
            left.subtract(&rows);
        }
        Some(list)
    }

    /// The first subunit that may decide all of its rows left at once, for rows to which no rule applies.
    fn first_whole(&self, left: &Bits) -> Option<(Child, Bits)> {
        let minimiser = self.stock.minimiser;
        let mut subunits = self.stock.subunits.iter().enumerate();
        subunits.find_map(|(number, subunit)| {
            let own = subunit.rows.and(left);
            let off = left.minus(&own);
            let child = match subunit.guards_itself {
                _ if own.is_empty() => return None,
                true if own != subunit.rows => return None,
                true => Child::Bare(number),
                false if !minimiser.may_minimise(&own, &off) => return None,
                false => Child::Guarded(number, minimiser.guard(&own, &off)?),
            };
            Some((child, own))
        })
    }

    /// Where an applied rule stands among others: first those that decide most rows for their nodes.
    pub(super) fn order(&self, applied: &Applied) -> (std::cmp::Reverse<usize>, usize) {
        // A sequence and a leaf, and the literals.
        let nodes = 2 + self.stock.rules.literals(applied.rule);
        let worth = Rules::per_node(applied.rows.count(), nodes);
        (std::cmp::Reverse(worth), applied.rule)
    }
}
