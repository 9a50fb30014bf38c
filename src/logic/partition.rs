//! Partitions of rows into classes by one atom after the other: decision trees (CART: Breiman, Friedman, Olshen and Stone
//! 1984).

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::Literal;
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

/// How mixed a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Impurity {
    /// The chance that two of its rows are of different classes.
    Gini,
    /// The entropy of the classes of its rows.
    Entropy,
    /// The rows that are not of its most frequent class.
    Error,
}

impl Impurity {
    /// Every measure.
    pub const ALL: [Self; 3] = [Self::Gini, Self::Entropy, Self::Error];

    /// The impurity of a part with these numbers of rows in each class, times the number of its rows.
    fn of(self, counts: impl Iterator<Item = u32> + Clone) -> f64 {
        let total: f64 = counts.clone().map(f64::from).sum();
        if total == 0.0 {
            return 0.0;
        }
        let counts = counts.filter(|count| *count > 0).map(f64::from);
        match self {
            Self::Gini => total - counts.map(|n| n * n).sum::<f64>() / total,
            Self::Entropy => counts.map(|n| n * (total / n).log2()).sum(),
            Self::Error => total - counts.fold(0.0, f64::max),
        }
    }
}

/// The classes of rows, each divided by the atom that makes the parts least mixed; `None` if the account is spent.
///
/// A row that leaves the atom free goes to both parts.
pub fn partition(
    columns: &Columns,
    classes: &[Bits],
    impurity: Impurity,
    account: &Account,
) -> Option<Partition> {
    let mut rows: Vec<Row> = Vec::new();
    for (class, members) in (0..).zip(classes) {
        rows.extend(members.iter().map(|number| Row { number, class }));
    }
    rows.sort_unstable_by_key(|row| row.number);
    let search = Search {
        atoms: columns.atoms(),
        width: columns.atoms().div_ceil(64),
        ones: by_rows(columns, true),
        zeros: match columns.are_minterms() {
            true => Vec::new(),
            false => by_rows(columns, false),
        },
        impurity,
        account,
    };
    search.divide(&rows)
}

/// The literals of one sign that hold on each row, a bit for each atom.
fn by_rows(columns: &Columns, positive: bool) -> Vec<u64> {
    let width = columns.atoms().div_ceil(64);
    let mut words = vec![0; columns.rows() * width];
    let all = Bits::full(columns.rows());
    for atom in 0..columns.atoms() {
        let mut rows = all.clone();
        columns.restrict(&mut rows, Literal { atom, positive });
        for row in rows.iter() {
            if let Some(word) = words.get_mut(row * width + atom / 64) {
                *word |= 1 << (atom % 64);
            }
        }
    }
    words
}

#[derive(Clone, Copy)]
struct Row {
    number: usize,
    class: usize,
}

struct Search<'a> {
    atoms: usize,
    /// The words of a row.
    width: usize,
    /// The atoms that are 1 in each row.
    ones: Vec<u64>,
    /// The atoms that are 0 in each row; empty where these are all others.
    zeros: Vec<u64>,
    impurity: Impurity,
    account: &'a Account,
}

impl Search<'_> {
    fn divide(&self, rows: &[Row]) -> Option<Partition> {
        // The classes in this part, numbered from 0.
        let mut numbers: FxHashMap<usize, usize> = FxHashMap::default();
        let local = rows.iter().map(|row| {
            let next = numbers.len();
            *numbers.entry(row.class).or_insert(next)
        });
        let local: Vec<usize> = local.collect();
        let classes = numbers.len();
        if classes <= 1 {
            return Some(Partition::Leaf(rows.first().map_or(0, |row| row.class)));
        }
        let work = rows.len() * (8 + self.atoms) + classes * self.atoms;
        self.account.spend(work as u64);
        if self.account.is_spent() {
            return None;
        }
        let atom = self.best(rows, &local, classes)?;
        let bit = |words: &[u64], row: &Row| {
            let word = words.get(row.number * self.width + atom / 64);
            word.is_some_and(|word| word >> (atom % 64) & 1 == 1)
        };
        let is_one = |row: &Row| match self.zeros.is_empty() {
            true => bit(&self.ones, row),
            false => !bit(&self.zeros, row),
        };
        let part = |stays: &dyn Fn(&Row) -> bool| {
            let rows = rows.iter().filter(|row| stays(row));
            rows.copied().collect::<Vec<Row>>()
        };
        let zero = part(&|row| !bit(&self.ones, row));
        let one = part(&is_one);
        let parts = [self.divide(&zero)?, self.divide(&one)?];
        Some(Partition::Split {
            atom,
            parts: Box::new(parts),
        })
    }

    /// The atom that makes the parts least mixed; `None` where every atom leaves all rows on one side.
    fn best(&self, rows: &[Row], local: &[usize], classes: usize) -> Option<usize> {
        let ones = self.count(&self.ones, rows, local, classes);
        let zeros = self.count(&self.zeros, rows, local, classes);
        let mut totals = vec![0_u32; classes];
        for class in local {
            if let Some(total) = totals.get_mut(*class) {
                *total += 1;
            }
        }
        let mut best: Option<(f64, usize)> = None;
        for atom in 0..self.atoms {
            let of = |counts: &[u32], class: usize| {
                let count = counts.get(class * self.atoms + atom);
                count.copied().unwrap_or(0)
            };
            let fixed = |class: usize, total: &u32| {
                let one = of(&ones, class);
                let zero = match self.zeros.is_empty() {
                    true => total - one,
                    false => of(&zeros, class),
                };
                [zero, one]
            };
            let all = totals.iter().enumerate();
            let sides = all.map(|(class, total)| (fixed(class, total), *total));
            let sides: Vec<([u32; 2], u32)> = sides.collect();
            let none = |side: fn(&[u32; 2]) -> u32| sides.iter().all(|(n, _)| side(n) == 0);
            if none(|[zero, _]| *zero) || none(|[_, one]| *one) {
                continue;
            }
            // A row that leaves the atom free is on both sides.
            let zero = sides.iter().map(|([_, one], total)| total - one);
            let one = sides.iter().map(|([zero, _], total)| total - zero);
            let mixed = self.impurity.of(zero) + self.impurity.of(one);
            // Smaller by more than rounding.
            if best.is_none_or(|(least, _)| mixed < least - 1e-9 * (1.0 + least)) {
                best = Some((mixed, atom));
            }
        }
        best.map(|(_, atom)| atom)
    }

    /// For each class and atom the rows that have a bit there.
    fn count(&self, words: &[u64], rows: &[Row], local: &[usize], classes: usize) -> Vec<u32> {
        if words.is_empty() {
            return Vec::new();
        }
        let mut counts = vec![0_u32; classes * self.atoms];
        for (row, class) in rows.iter().zip(local) {
            let start = row.number * self.width;
            let own = words.get(start..start + self.width).unwrap_or_default();
            let from = class * self.atoms;
            let Some(counts) = counts.get_mut(from..from + self.atoms) else {
                continue;
            };
            for (word, counts) in own.iter().zip(counts.chunks_mut(64)) {
                let mut left = *word;
                while left != 0 {
                    if let Some(count) = counts.get_mut(left.trailing_zeros() as usize) {
                        *count += 1;
                    }
                    left &= left - 1;
                }
            }
        }
        counts
    }
}
