//! The minterms that matter, with what each choice is worth there, and how a tree decides in them.
//!
//! A tree is scored by the advantage of its decisions over those of another, weighted by visits: the sum over minterms
//! approximates the difference of their returns (the performance difference lemma: Kakade and Langford 2002).

use super::evidence::{Cell, Evidence, Sight, Visits};
use super::ground::Ground;
use super::reader::{Drive, Reader};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::learn::process::{Key, World};
use crate::learn::solve::Problem;

/// By whose decisions what follows is judged.
#[derive(Clone, Copy, Debug)]
pub enum Aim<'n> {
    /// The best ones, as far as the counts tell.
    Best,
    /// Those of a tree.
    Of(&'n Node),
}

/// A minterm that matters.
#[derive(Clone, Debug)]
pub struct Spot {
    /// The minterm.
    pub key: Key,
    /// How often it is visited in an episode.
    pub weight: f64,
    /// What each choice is worth, and what it is worth below a behaviour that fails at once.
    values: Vec<[f64; 2]>,
    /// Whether a choice fails at once.
    refuses: Vec<bool>,
    /// What it is worth to select nothing.
    nothing: f64,
}

impl Spot {
    /// What a tree is worth that does this here.
    pub fn worth(&self, drive: Drive) -> f64 {
        let value = drive.choice.and_then(|choice| self.values.get(choice));
        value.map_or(
            self.nothing,
            |[plain, fallen]| if drive.fell { *fallen } else { *plain },
        )
    }

    /// The choices that cost at most `slack` an episode in place of what a tree does here, which is one of them.
    pub fn permitted(&self, drive: Drive, slack: f64) -> Vec<usize> {
        let own = self.worth(drive);
        let choices = self.values.iter().zip(&self.refuses).enumerate();
        let permitted = choices.filter(|(choice, ([plain, _], refuses))| {
            let is_own = drive.choice == Some(*choice);
            is_own || !**refuses && self.weight * (own - plain) <= slack
        });
        permitted.map(|(choice, _)| choice).collect()
    }

    /// The best choice.
    pub fn best(&self) -> f64 {
        let values = self.values.iter().map(|[plain, _]| *plain);
        values.fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The minterms that matter.
#[derive(Debug)]
pub struct Field<'w> {
    /// The minterms, the most visited first.
    pub spots: Vec<Spot>,
    /// The atoms of a minterm.
    pub atoms: &'w [Atom],
    /// The behaviours to choose from.
    pub choices: &'w [Id<Behavior>],
    reader: Reader<'w>,
}

/// The most minterms that are scored.
const SPOTS: usize = 350;

impl<'w> Field<'w> {
    /// What is known, with the visits of a tree.
    pub fn new<W: World>(
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        sight: Sight,
        visits: &Visits,
        aim: Aim,
    ) -> Self {
        let mut problem = evidence.problem(sight);
        let policy = match aim {
            Aim::Best => None,
            Aim::Of(root) => {
                let refusing = evidence.refusing();
                let minterms = evidence.keys().iter().zip(&refusing);
                let minterms = minterms.map(|(key, refuses)| (*key, refuses.as_slice()));
                Reader::new(ground, minterms).policy(root, &problem)
            }
        };
        let values = match policy {
            None => problem.estimate_from(problem.unsolved()).values,
            Some(policy) => {
                // What is not known of the tree is about as bad as anything else that it does.
                problem.unknown = problem.low(&problem.estimate(&policy));
                problem.estimate(&policy)
            }
        };
        Self::with(ground, evidence, &problem, &values, visits)
    }

    /// What is known, with the visits of a tree, where rows are worth so much.
    pub fn with<W: World>(
        ground: &Ground<'w, W>,
        evidence: &Evidence,
        problem: &Problem,
        values: &[f64],
        visits: &Visits,
    ) -> Self {
        let refusal = evidence.refusal();
        let mut spots: Vec<Spot> = visits
            .iter()
            .filter_map(|(key, weight)| {
                let row = evidence.row(*key)?;
                let states = problem.states.get(row)?;
                let mut worths: Vec<Option<f64>> = vec![None; ground.choices.len()];
                for (choice, outlook) in states {
                    if let Some(worth) = worths.get_mut(*choice) {
                        *worth = Some(problem.lasting(row, outlook, values));
                    }
                }
                let known = || worths.iter().flatten().copied();
                let least = known().fold(f64::INFINITY, f64::min);
                if !least.is_finite() {
                    return None;
                }
                let cells = evidence.cells(row);
                let values = cells.iter().zip(&worths).map(|(cell, worth)| {
                    // What nobody tried is no better than the worst that somebody did.
                    let plain = worth.unwrap_or(least);
                    let due = (cell.ticks() - 1.0).max(0.0);
                    [plain, plain + due.min(100.0) * refusal.min(0.0)]
                });
                Some(Spot {
                    key: *key,
                    weight: *weight,
                    values: values.collect(),
                    refuses: cells.iter().map(Cell::refuses).collect(),
                    nothing: least + refusal.min(0.0),
                })
            })
            .collect();
        spots.sort_by(|a, b| b.weight.total_cmp(&a.weight).then(a.key.cmp(&b.key)));
        spots.truncate(SPOTS);
        let minterms = spots.iter();
        let minterms = minterms.map(|spot| (spot.key, spot.refuses.as_slice()));
        Self {
            reader: Reader::new(ground, minterms),
            spots,
            atoms: ground.atoms(),
            choices: ground.choices,
        }
    }

    /// What a tree does in each minterm; `None` if it asks what the world does not know.
    pub fn drives(&self, root: &Node) -> Option<Vec<Drive>> {
        self.reader.drives(root)
    }

    /// How much more a tree returns than another that does `now`, as far as the counts tell.
    pub fn gain(&self, drives: &[Drive], now: &[Drive]) -> f64 {
        let pairs = self.spots.iter().zip(drives.iter().zip(now));
        let gains = pairs.map(|(spot, (new, old))| {
            if new == old {
                0.0
            } else {
                spot.weight * (spot.worth(*new) - spot.worth(*old))
            }
        });
        gains.sum()
    }
}

#[cfg(test)]
mod tests {
    use super::{Drive, Spot};

    #[test]
    fn what_costs_little_is_permitted() {
        let spot = Spot {
            key: 0,
            weight: 2.0,
            values: [5.0, 4.75, 1.0, 6.0, 5.0].map(|worth| [worth; 2]).to_vec(),
            refuses: vec![false, false, false, false, true],
            nothing: 0.0,
        };
        let drive = |choice| Drive {
            choice,
            fell: false,
        };
        assert_eq!(spot.permitted(drive(Some(0)), 0.4), [0, 3]);
        assert_eq!(spot.permitted(drive(Some(0)), 0.5), [0, 1, 3]);
        // Its own choice always is, also one that fails at once.
        assert_eq!(spot.permitted(drive(Some(4)), 0.0), [0, 3, 4]);
        assert_eq!(spot.permitted(drive(None), 0.0), [0, 1, 2, 3]);
    }
}
