//! The shortest cube on some ON rows.

use super::bits::Bits;
use super::cube::{Cube, Literal};
use super::instance::Instance;

/// A cube with fewer than `limit` literals, all of them among `literals`, that meets no OFF row; a shortest one where the
/// search goes through no more than `budget` words of rows. `None` where none was found.
///
/// It is a smallest set of literals that hits, for every OFF row, the literals that exclude it.
pub(super) fn shortest(
    instance: &Instance,
    literals: &[Literal],
    limit: usize,
    budget: &mut usize,
) -> Option<Cube> {
    let all = Cube::new(literals.iter().copied());
    if !instance
        .off
        .cube_meets(&all, &instance.all_off())
        .is_empty()
    {
        return None;
    }
    let excludes = literals.iter().map(|literal| {
        let mut rows = instance.all_off();
        if let (Some(column), meets) = instance.off.meeting(*literal) {
            rows.keep(column, !meets);
        }
        rows
    });
    let mut search = Search {
        excludes: excludes.collect(),
        chosen: Vec::new(),
        best: None,
        limit,
        budget,
    };
    search.extend(&instance.all_off(), &Bits::full(literals.len()));
    let best = search.best?;
    let chosen = best.into_iter().filter_map(|i| literals.get(i).copied());
    Some(Cube::new(chosen))
}

struct Search<'a> {
    /// The OFF rows that each literal excludes.
    excludes: Vec<Bits>,
    chosen: Vec<usize>,
    best: Option<Vec<usize>>,
    /// What is found has fewer literals.
    limit: usize,
    budget: &'a mut usize,
}

impl Search<'_> {
    /// Adds literals out of `open` until none of the rows in `left` is left.
    fn extend(&mut self, left: &Bits, open: &Bits) {
        let rows = left.count();
        if rows == 0 {
            self.limit = self.chosen.len();
            self.best = Some(self.chosen.clone());
            return;
        }
        if *self.budget == 0 || self.chosen.len() + 1 >= self.limit {
            return;
        }
        *self.budget = self
            .budget
            .saturating_sub(open.count() * left.words().len());
        let counts = open
            .iter()
            .filter_map(|i| Some((self.excludes.get(i)?.count_both(left), i)));
        let mut counts: Vec<(usize, usize)> = counts.filter(|(count, _)| *count > 0).collect();
        counts.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
        let most: Vec<usize> = counts.iter().map(|(count, _)| *count).collect();
        let mut open = open.clone();
        // One of what excludes most is chosen first; what comes after it in the list never with it.
        for (at, (_, literal)) in counts.into_iter().enumerate() {
            let may = self.limit.saturating_sub(1 + self.chosen.len());
            if most.iter().skip(at).take(may).sum::<usize>() < rows {
                return;
            }
            open.remove(literal);
            let Some(excludes) = self.excludes.get(literal) else {
                continue;
            };
            let after = left.minus(excludes);
            self.chosen.push(literal);
            self.extend(&after, &open);
            self.chosen.pop();
        }
    }
}
