//! How the predicates of planted tables fall.

use crate::laws::random::Random;

/// How the predicates of a planted table fall.
#[derive(Clone, Copy, Debug)]
pub(super) enum Falls {
    /// A coin for each.
    Evenly,
    /// Some hold seldom, some mostly.
    Skewed,
    /// Half of them mostly as another, or as its negation.
    Together,
}

impl Falls {
    /// So many rows over `atoms` predicates.
    pub(super) fn rows(self, random: &mut Random, atoms: usize, rows: usize) -> Vec<Vec<bool>> {
        let chances: Vec<usize> = (0..atoms)
            .map(|_| match self {
                Self::Skewed => [15, 30, 50, 70, 85][random.below(5)],
                Self::Evenly | Self::Together => 50,
            })
            .collect();
        // The predicate that each is like, whether it is its negation, and how often it is not.
        let like: Vec<Option<(usize, bool, usize)>> = (0..atoms)
            .map(|atom| match self {
                Self::Together if atom > 0 && random.chance(50) => Some((
                    random.below(atom),
                    random.chance(50),
                    10 + 15 * random.below(2),
                )),
                _ => None,
            })
            .collect();
        let row = |_| {
            let mut values: Vec<bool> = Vec::new();
            for (chance, like) in chances.iter().zip(&like) {
                let value = match like {
                    Some((other, negated, unlike)) => {
                        values[*other] ^ negated ^ random.chance(*unlike)
                    }
                    None => random.chance(*chance),
                };
                values.push(value);
            }
            values
        };
        (0..rows).map(row).collect()
    }
}
