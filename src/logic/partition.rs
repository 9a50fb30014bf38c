//! Partitions of rows into classes by one atom after the other: decision trees (CART: Breiman, Friedman, Olshen and Stone
//! 1984).

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::Literal;
use super::impurity::{self, Impurity, Mixture};
use rustc_hash::FxHashMap;

/// Rows divided until each part holds one class.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Partition {
    /// The class of all rows of the part.
    Leaf(usize),
    /// Parts by the value of an atom.
    Split {
        /// The atom.
        atom: usize,
        /// Where it is 0, and where it is 1.
        parts: Box<[Partition; 2]>,
    },
}

impl Partition {
    /// The number of parts that are not divided.
    pub fn leaves(&self) -> usize {
        match self {
            Self::Leaf(_) => 1,
            Self::Split { parts, .. } => parts.iter().map(Self::leaves).sum(),
        }
    }
}

/// Rows of classes that are to be divided, by one measure or by several.
pub struct Classified<'a> {
    columns: &'a Columns,
    turns: Turns,
    rows: Vec<Row>,
}

impl<'a> Classified<'a> {
    /// The rows of these classes; a row may be of several, each of which is right.
    pub fn new(columns: &'a Columns, classes: &[Bits]) -> Self {
        let mut rows: Vec<Row> = Vec::new();
        for (class, members) in (0..).zip(classes) {
            rows.extend(members.iter().map(|number| Row { number, class }));
        }
        rows.sort_unstable_by_key(|row| row.number);
        Self {
            columns,
            turns: Turns::new(columns),
            rows,
        }
    }

    /// The rows divided by the atom that makes the parts least mixed, and so on; `None` if the account is spent.
    ///
    /// A row that leaves the atom free goes to both parts.
    pub fn partition(&self, impurity: Impurity, account: &Account) -> Option<Partition> {
        let search = Search {
            columns: self.columns,
            turns: &self.turns,
            impurity,
            account,
        };
        search.divide(&self.rows, 0)
    }
}

/// On which sides of an atom a row is: where it is 0, where it is 1, or both where the row leaves it free.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Sides {
    zero: bool,
    one: bool,
}

/// Where every row is before the first atom.
const BEFORE: Sides = Sides {
    zero: true,
    one: false,
};

/// The atoms at which a row is on other sides than at the atom before. They say as much as the values, and are few where the atoms
/// compare one number with ascending ones.
struct Turns {
    /// Where those of each row begin; those of the last end at the last number.
    starts: Vec<usize>,
    all: Vec<(u32, Sides)>,
}

impl Turns {
    fn new(columns: &Columns) -> Self {
        let rows = columns.rows();
        let on = |atom: usize, positive: bool| columns.meeting(Literal { atom, positive });
        let mut counts = vec![0_usize; rows + 1];
        let mut found: Vec<(u32, Sides)> = Vec::new();
        // Twice over the columns: first to count, then to place.
        for placing in [false, true] {
            if placing {
                let mut sum = 0;
                for count in &mut counts {
                    sum += std::mem::replace(count, sum);
                }
                found = vec![(0, BEFORE); sum];
            }
            let mut before = [Bits::full(rows), Bits::empty(rows)];
            for atom in 0..columns.atoms() {
                let here = [false, true].map(|positive| {
                    let mut rows = Bits::full(rows);
                    if let (Some(column), inside) = on(atom, positive) {
                        rows.keep(column, inside);
                    }
                    rows
                });
                let [zero, one] = &here;
                let [zero_before, one_before] = &before;
                for row in zero
                    .differing(zero_before)
                    .or(&one.differing(one_before))
                    .iter()
                {
                    let Some(count) = counts.get_mut(row) else {
                        continue;
                    };
                    if let Some(slot) = found.get_mut(*count) {
                        let sides = Sides {
                            zero: zero.contains(row),
                            one: one.contains(row),
                        };
                        *slot = (atom as u32, sides);
                    }
                    *count += 1;
                }
                before = here;
            }
        }
        // Each start was moved to its end.
        counts.rotate_right(1);
        if let Some(first) = counts.first_mut() {
            *first = 0;
        }
        Self {
            starts: counts,
            all: found,
        }
    }

    fn of(&self, row: usize) -> &[(u32, Sides)] {
        match self.starts.get(row..row + 2) {
            Some([from, to]) => self.all.get(*from..*to).unwrap_or_default(),
            _ => &[],
        }
    }
}

/// The first class of which all of these rows are.
fn sole(rows: &[Row], local: &[usize], classes: usize) -> Option<usize> {
    let mut counts = vec![0_usize; classes.max(1)];
    for class in local {
        if let Some(count) = counts.get_mut(*class) {
            *count += 1;
        }
    }
    let all = rows.chunk_by(|a, b| a.number == b.number).count();
    let sole = counts.iter().position(|count| *count == all)?;
    let at = local.iter().position(|class| *class == sole);
    Some(at.and_then(|at| rows.get(at)).map_or(0, |row| row.class))
}

#[derive(Clone, Copy)]
struct Row {
    number: usize,
    class: usize,
}

/// So many more rows of a class on each side of an atom than of the atom before.
#[derive(Clone, Copy, Default)]
struct Change {
    atom: u32,
    class: u32,
    zero: i32,
    one: i32,
}

impl Change {
    fn turn(&mut self, from: Sides, to: Sides) {
        self.zero += i32::from(to.zero) - i32::from(from.zero);
        self.one += i32::from(to.one) - i32::from(from.one);
    }
}

struct Search<'a> {
    columns: &'a Columns,
    turns: &'a Turns,
    impurity: Impurity,
    account: &'a Account,
}

impl Search<'_> {
    fn divide(&self, rows: &[Row], depth: usize) -> Option<Partition> {
        // The classes in this part, numbered from 0.
        let mut numbers: FxHashMap<usize, usize> = FxHashMap::default();
        let local = rows.iter().map(|row| {
            let next = numbers.len();
            *numbers.entry(row.class).or_insert(next)
        });
        let local: Vec<usize> = local.collect();
        let classes = numbers.len();
        if let Some(class) = sole(rows, &local, classes) {
            return Some(Partition::Leaf(class));
        }
        let turns = rows.iter().map(|row| self.turns.of(row.number).len());
        let turns: usize = turns.sum();
        self.account.spend((8 * rows.len() + 4 * turns) as u64);
        if self.account.is_spent() {
            return None;
        }
        let evenly = impurity::evenly(classes, rows.len(), depth);
        let atom = self.best(rows, (&local, classes), turns, evenly)?;
        let part = |positive| {
            let (column, inside) = self.columns.meeting(Literal { atom, positive });
            let meets =
                |row: &&Row| column.is_some_and(|column| column.contains(row.number) == inside);
            rows.iter().filter(meets).copied().collect::<Vec<Row>>()
        };
        let below = depth + 1;
        let parts = [
            self.divide(&part(false), below)?,
            self.divide(&part(true), below)?,
        ];
        Some(Partition::Split {
            atom,
            parts: Box::new(parts),
        })
    }

    /// The atom that makes the parts least mixed, or that divides the rows most evenly; `None` where every atom leaves all rows on one
    /// side.
    fn best(
        &self,
        rows: &[Row],
        (local, classes): (&[usize], usize),
        turns: usize,
        evenly: bool,
    ) -> Option<usize> {
        let total = rows.len() as u32;
        let mut zero = Mixture::new(self.impurity, classes);
        let mut one = zero.clone();
        for class in local {
            zero.change(*class, 1);
        }
        let mut best: Option<(f64, usize)> = None;
        let changes = self.changes(rows, local, classes, turns);
        for changes in changes.chunk_by(|a, b| a.atom == b.atom) {
            for change in changes {
                zero.change(change.class as usize, change.zero);
                one.change(change.class as usize, change.one);
            }
            // Some rows are on one side only, and some on the other.
            let divides = zero.total() < total && one.total() < total;
            let mixed = impurity::of_division([&zero, &one], evenly);
            if divides && best.is_none_or(|(least, _)| Impurity::better(mixed, least)) {
                best = changes.first().map(|change| (mixed, change.atom as usize));
            }
        }
        best.map(|(_, atom)| atom)
    }

    /// The changes from each atom to the next, in the order of the atoms.
    fn changes(&self, rows: &[Row], local: &[usize], classes: usize, turns: usize) -> Vec<Change> {
        let all = rows.iter().zip(local).flat_map(|(row, class)| {
            let turns = self.turns.of(row.number).iter();
            turns.scan(BEFORE, move |from, (atom, to)| {
                let mut change = Change {
                    atom: *atom,
                    class: *class as u32,
                    ..Change::default()
                };
                change.turn(std::mem::replace(from, *to), *to);
                Some(change)
            })
        });
        let cells = classes * self.columns.atoms();
        if cells > 2 * turns {
            let mut all: Vec<Change> = all.collect();
            all.sort_unstable_by_key(|change| (change.atom, change.class));
            return all;
        }
        let mut sums = vec![[0_i32; 2]; cells];
        for change in all {
            if let Some([zero, one]) =
                sums.get_mut(change.atom as usize * classes + change.class as usize)
            {
                *zero += change.zero;
                *one += change.one;
            }
        }
        let sums = sums.into_iter().enumerate();
        let changed = sums.filter(|(_, sum)| *sum != [0, 0]);
        let changed = changed.map(|(cell, [zero, one])| Change {
            atom: (cell / classes) as u32,
            class: (cell % classes) as u32,
            zero,
            one,
        });
        changed.collect()
    }
}

#[cfg(test)]
mod tests {
    use super::{Classified, Partition};
    use crate::logic::impurity::{DEPTH, Impurity};
    use crate::logic::{Account, Bits, Columns};

    fn depth(partition: &Partition) -> usize {
        match partition {
            Partition::Leaf(_) => 0,
            Partition::Split { parts, .. } => 1 + parts.iter().map(depth).max().unwrap_or(0),
        }
    }

    /// Numbers from 0, and whether each is at most 0, at most 1, and so on.
    fn numbers(count: usize) -> Columns {
        let words = count.div_ceil(64);
        let rows = (0..count).map(|row| {
            let asks = |word: usize| {
                let bits = (0..64).filter(|bit| word * 64 + bit >= row);
                bits.fold(0_u64, |asks, bit| asks | 1 << bit)
            };
            (0..words).map(asks).collect()
        });
        let rows: Vec<Vec<u64>> = rows.collect();
        Columns::new(count - 1, rows.iter().map(Vec::as_slice))
    }

    #[test]
    fn no_part_is_deep() {
        const COUNT: usize = 1500;
        let columns = numbers(COUNT);
        for (behaviors, most) in [(2, DEPTH + 11), (COUNT, 11)] {
            let own = |class: usize| (0..COUNT).filter(move |row| row % behaviors == class);
            let classes = (0..behaviors).map(|class| Bits::collect(COUNT, own(class)));
            let classes: Vec<Bits> = classes.collect();
            for impurity in Impurity::ALL {
                let partition = Classified::new(&columns, &classes)
                    .partition(impurity, &Account::unlimited())
                    .unwrap();
                assert_eq!(partition.leaves(), COUNT);
                assert!(depth(&partition) <= most, "{behaviors} {impurity:?}");
            }
        }
    }
}
