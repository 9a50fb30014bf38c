//! The cubes that may stand next.

use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::covering::table::Table;
use crate::logic::cube::{Cube, Literal};
use crate::logic::impurity::n_log_n;

/// Literals, pairs of them, and pairs that are tried with a third.
const LITERALS: usize = 8;
const PAIRS: usize = 16;
const TRIPLES: usize = 12;
/// The most atoms that are tried in pairs, those that say most alone.
const PAIRED: usize = 160;

/// Cubes that say much of the class of a row: pairs that say more than their literals say alone, the same with a third literal, and
/// literals.
pub(super) fn cubes(table: &Table, account: &Account) -> Vec<Cube> {
    let counts = Counts::of(table, account);
    let mut atoms: Vec<(f64, usize)> = (0..table.columns.atoms())
        .map(|atom| (counts.alone(atom), atom))
        .collect();
    atoms.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let singles = atoms.iter().take(LITERALS);
    let singles = singles.filter(|(said, _)| *said > 0.0);
    let singles = singles.flat_map(|(_, atom)| {
        [true, false].map(|positive| {
            Cube::new([Literal {
                atom: *atom,
                positive,
            }])
        })
    });
    let paired = atoms.iter().take(PAIRED);
    let pairs = counts.pairs(paired.map(|(_, atom)| *atom).collect(), account);
    let triples = pairs.iter().take(TRIPLES);
    let triples = triples.filter_map(|pair| counts.with_a_third(pair, account));
    let triples: Vec<Cube> = triples.collect();
    let pairs = pairs.into_iter().map(|(_, cube)| cube);
    pairs.chain(triples).chain(singles).collect()
}

/// How the classes of rows fall.
struct Counts<'t> {
    table: &'t Table,
    /// The rows of each class, and of all.
    sizes: Vec<usize>,
    all: usize,
    /// What is not known of the class of a row before anything is asked, in bits, times the rows.
    unknown: f64,
    /// For each atom, the rows of each class in which it holds.
    ones: Vec<Vec<usize>>,
}

impl<'t> Counts<'t> {
    fn of(table: &'t Table, account: &Account) -> Self {
        let sizes: Vec<usize> = table.classes.iter().map(|(_, own)| own.count()).collect();
        let all = sizes.iter().sum();
        let words = table.columns.rows().div_ceil(64);
        account.spend((table.columns.atoms() * table.classes.len() * (1 + words)) as u64);
        let ones = table.columns.iter().map(|(_, column)| {
            let classes = table.classes.iter();
            classes.map(|(_, own)| own.count_both(column)).collect()
        });
        Self {
            ones: ones.collect(),
            unknown: mixed(sizes.iter().copied()),
            table,
            sizes,
            all,
        }
    }

    fn ones(&self, atom: usize) -> &[usize] {
        self.ones.get(atom).map_or(&[], Vec::as_slice)
    }

    /// What it says of the class of a row that it is inside or outside of a cube with so many rows of each class; nothing where all are
    /// on one side.
    fn said(&self, inside: impl Iterator<Item = usize> + Clone) -> f64 {
        let within: usize = inside.clone().sum();
        if within == 0 || within == self.all {
            return 0.0;
        }
        let outside = self.sizes.iter().zip(inside.clone());
        let outside = outside.map(|(size, inside)| size - inside);
        self.unknown - mixed(inside) - mixed(outside)
    }

    /// What an atom says alone.
    fn alone(&self, atom: usize) -> f64 {
        self.said(self.ones(atom).iter().copied())
    }

    /// The pairs of literals that say most beyond what each of them says alone, with what they say.
    fn pairs(&self, mut atoms: Vec<usize>, account: &Account) -> Vec<(f64, Cube)> {
        atoms.sort_unstable();
        let words = 1 + self.table.columns.rows().div_ceil(64);
        let each = atoms.len() * atoms.len() / 2 * self.sizes.len();
        account.spend((each * (words + 2)) as u64);
        let alone: Vec<f64> = atoms.iter().map(|atom| self.alone(*atom)).collect();
        let columns: Vec<&Bits> = self.table.columns.iter().map(|(_, c)| c).collect();
        let mut found: Vec<(f64, f64, [Literal; 2])> = Vec::new();
        let mut least = 0.0;
        for (at, (one, of_one)) in atoms.iter().zip(&alone).enumerate() {
            let Some(column) = columns.get(*one) else {
                continue;
            };
            let own = self.table.classes.iter().map(|(_, own)| own.and(column));
            let own: Vec<Bits> = own.collect();
            for (other, of_other) in atoms.iter().zip(&alone).skip(at + 1) {
                let Some(column) = columns.get(*other) else {
                    continue;
                };
                let both: Vec<usize> = own.iter().map(|own| own.count_both(column)).collect();
                for (is_one, is_other) in SIGNS {
                    let inside = self.sizes.iter().zip(self.ones(*one));
                    let inside = inside.zip(self.ones(*other)).zip(&both);
                    let inside =
                        inside.map(|(((size, one), other), both)| match (is_one, is_other) {
                            (true, true) => *both,
                            (true, false) => one - both,
                            (false, true) => other - both,
                            (false, false) => size + both - one - other,
                        });
                    let said = self.said(inside);
                    let beyond = said - of_one - of_other;
                    if said > 0.0 && (found.len() < PAIRS || beyond > least) {
                        let literal = |atom: &usize, positive| Literal {
                            atom: *atom,
                            positive,
                        };
                        let pair = [literal(one, is_one), literal(other, is_other)];
                        found.push((beyond, said, pair));
                    }
                    if found.len() >= 4 * PAIRS {
                        least = best(&mut found);
                    }
                }
            }
        }
        best(&mut found);
        let found = found.into_iter();
        found
            .map(|(_, said, pair)| (said, Cube::new(pair)))
            .collect()
    }

    /// A pair with the literal that says most with it, if that is more than the pair says.
    fn with_a_third(&self, (said, pair): &(f64, Cube), account: &Account) -> Option<Cube> {
        let all = Bits::full(self.table.columns.rows());
        let inside = self.table.columns.cube_rows(pair, &all);
        let classes = self.table.classes.iter().map(|(_, own)| own.and(&inside));
        let classes: Vec<Bits> = classes.collect();
        let sizes: Vec<usize> = classes.iter().map(Bits::count).collect();
        let words = 1 + self.table.columns.rows().div_ceil(64);
        account.spend((self.table.columns.atoms() * classes.len() * words) as u64);
        let mut best: Option<(f64, Literal)> = None;
        for (atom, column) in self.table.columns.iter() {
            let ones: Vec<usize> = classes.iter().map(|own| own.count_both(column)).collect();
            let zeros = sizes.iter().zip(&ones).map(|(size, one)| size - one);
            let zeros: Vec<usize> = zeros.collect();
            for (positive, counts) in [(true, ones), (false, zeros)] {
                let more = self.said(counts.into_iter());
                if more > best.map_or(*said, |(most, _)| most) {
                    best = Some((more, Literal { atom, positive }));
                }
            }
        }
        let (_, third) = best?;
        let literals = pair.literals().iter().copied();
        Some(Cube::new(literals.chain([third])))
    }
}

/// The values of two atoms.
const SIGNS: [(bool, bool); 4] = [(true, true), (true, false), (false, true), (false, false)];

/// Keeps the best, best first, and gives the least of them.
fn best(found: &mut Vec<(f64, f64, [Literal; 2])>) -> f64 {
    found.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.2.cmp(&b.2)));
    found.truncate(PAIRS);
    found.last().map_or(0.0, |(beyond, ..)| *beyond)
}

/// The entropy of classes with so many rows each, times all rows.
fn mixed(counts: impl Iterator<Item = usize> + Clone) -> f64 {
    let all: usize = counts.clone().sum();
    let terms: f64 = counts.map(|count| n_log_n(count as u32)).sum();
    n_log_n(all as u32) - terms
}
