//! Slack: decisions of a table that may be exchanged for others of nearly the same value, where that makes the tree
//! smaller.
//!
//! The values of a table know nothing of what follows from a change, so a tree with slack is never called equal, and
//! every minterm that it decides otherwise is listed.

use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::policy::{Policy, Row};
use crate::tree::canonicalise::canonicalise;
use crate::tree::decanonicalise::{Decanonicalised, Options, decanonicalise};

/// How often minterms that a tree decides as they may not be decided are taken back before all are.
const ROUNDS: usize = 6;

/// The part of the work that the search of one of many trees may take.
const SHARE: u64 = 20;

/// How many trees are tried for a table of one row, and at least and at most for any.
const TRIES: (usize, usize, usize) = (400_000, 8, 200);

/// A tree that does not take all decisions of its table.
#[derive(Clone, Debug)]
pub(super) struct Slack {
    /// The tree, proved on the table with the changes.
    pub(super) found: Decanonicalised,
    /// The changes, in the order of the rows.
    pub(super) otherwise: Vec<Change>,
}

/// A minterm that is decided otherwise.
#[derive(Clone, Copy, Debug)]
pub(super) struct Change {
    /// The number of its row.
    pub(super) row: usize,
    /// What the tree does.
    pub(super) tree: Id<Behavior>,
    /// How much less that is worth.
    pub(super) loss: f64,
}

/// The smallest tree that is found when any behaviour may be taken that is worth at most `slack` less than the table's;
/// `None` if no tree is smaller than the exact one.
pub(super) fn loosen(
    policy: &Policy,
    exact: &Decanonicalised,
    options: &Options,
    slack: f64,
) -> Option<Slack> {
    let (all, least, most) = TRIES;
    let mut search = Search {
        policy,
        allowed: policy
            .rows
            .iter()
            .map(|row| allowed(policy, row, slack))
            .collect(),
        options: Options {
            effort: options.effort / SHARE,
            ..*options
        },
        left: (all / policy.rows.len().max(1)).clamp(least, most),
    };
    if search.allowed.iter().all(|choices| choices.len() == 1) {
        return None;
    }
    let own: Vec<_> = policy.rows.iter().map(|row| Some(row.behavior)).collect();
    let mut best = Taken {
        found: search.tree(&own)?,
        behaviors: own.into_iter().flatten().collect(),
    };
    let fewest = search.fewest();
    search.improve(&mut best, fewest.iter().map(|b| Some(*b)).collect());
    search.improve(&mut best, search.free(None, &fewest));
    loop {
        let before = best.found.size;
        for behavior in policy.behaviors.clone() {
            let start = search.free(Some(behavior), &best.behaviors);
            search.improve(&mut best, start);
        }
        if best.found.size == before || search.left == 0 {
            break;
        }
    }
    search.options = *options;
    search.left = 1;
    let taken: Vec<_> = best.behaviors.iter().map(|b| Some(*b)).collect();
    let found = search.tree(&taken)?;
    (found.size < exact.size).then(|| Slack {
        otherwise: changes(policy, &best.behaviors),
        found,
    })
}

/// What may be done in a row: what the table says first. A row that leaves atoms free is decided as the table says.
fn allowed(policy: &Policy, row: &Row, slack: f64) -> Vec<Id<Behavior>> {
    let mut choices = vec![row.behavior];
    if let (Some(own), None) = (value(policy, row, row.behavior), &row.free) {
        let others = policy.behaviors.iter().copied();
        choices.extend(others.filter(|behavior| {
            let worth = value(policy, row, *behavior);
            *behavior != row.behavior && worth.is_some_and(|q| q >= own - slack)
        }));
    }
    choices
}

fn value(policy: &Policy, row: &Row, behavior: Id<Behavior>) -> Option<f64> {
    let at = policy.behaviors.iter().position(|b| *b == behavior)?;
    row.values.get(at).copied().flatten().map(|value| value.q)
}

fn changes(policy: &Policy, behaviors: &[Id<Behavior>]) -> Vec<Change> {
    let rows = policy.rows.iter().zip(behaviors).enumerate();
    rows.filter(|(_, (row, tree))| row.behavior != **tree)
        .map(|(at, (row, tree))| {
            let worth = |behavior| value(policy, row, behavior).unwrap_or(0.0);
            Change {
                row: at,
                tree: *tree,
                loss: worth(row.behavior) - worth(*tree),
            }
        })
        .collect()
}

/// What is done in each row, and the tree that does it.
struct Taken {
    behaviors: Vec<Id<Behavior>>,
    found: Decanonicalised,
}

struct Search<'a> {
    policy: &'a Policy,
    /// What may be done in each row.
    allowed: Vec<Vec<Id<Behavior>>>,
    options: Options,
    /// How many trees may still be tried.
    left: usize,
}

impl Search<'_> {
    /// A choice in every row that needs few behaviours: again and again the one that may be taken in most of the rows
    /// that are left.
    fn fewest(&self) -> Vec<Id<Behavior>> {
        let mut taken: Vec<Option<Id<Behavior>>> = vec![None; self.allowed.len()];
        loop {
            let open = || self.allowed.iter().zip(&taken).filter(|(_, t)| t.is_none());
            let count =
                |b: Id<Behavior>| open().filter(|(choices, _)| choices.contains(&b)).count();
            let known = self.policy.behaviors.iter().copied();
            // Of equals the first.
            let most = known.rev().max_by_key(|b| count(*b));
            let Some(behavior) = most.filter(|b| count(*b) > 0) else {
                break;
            };
            for (slot, choices) in taken.iter_mut().zip(&self.allowed) {
                if slot.is_none() && choices.contains(&behavior) {
                    *slot = Some(behavior);
                }
            }
        }
        let rows = self.policy.rows.iter().zip(taken);
        rows.map(|(row, taken)| taken.unwrap_or(row.behavior))
            .collect()
    }

    /// A choice with rows left open: those with several that may be taken, or of these only the ones that `behavior` is
    /// taken in.
    fn free(
        &self,
        behavior: Option<Id<Behavior>>,
        taken: &[Id<Behavior>],
    ) -> Vec<Option<Id<Behavior>>> {
        let open = |taken: &Id<Behavior>| behavior.is_none_or(|behavior| behavior == *taken);
        let rows = self.allowed.iter().zip(taken);
        let start: Vec<_> = rows
            .map(|(choices, taken)| (choices.len() == 1 || !open(taken)).then_some(*taken))
            .collect();
        // Nothing is asked of a tree without rows.
        if start.iter().all(Option::is_none) {
            return taken.iter().map(|taken| Some(*taken)).collect();
        }
        start
    }

    /// Lets a tree decide the open rows, and takes it if it is smaller.
    fn improve(&mut self, best: &mut Taken, mut start: Vec<Option<Id<Behavior>>>) {
        for round in 0.. {
            if start.iter().all(Option::is_some) {
                break;
            }
            let Some(found) = self.tree(&start) else {
                return;
            };
            let Ok(canonical) = canonicalise(&found.root) else {
                return;
            };
            let mut refused = Vec::new();
            let mut decided = start.clone();
            for (at, (row, choices)) in self.policy.rows.iter().zip(&self.allowed).enumerate() {
                let mut holds = |atom: Atom| {
                    let at = self.policy.atoms.iter().position(|a| *a == atom);
                    at.is_some_and(|i| row.minterm.get(i))
                };
                let Some(slot) = decided.get_mut(at).filter(|slot| slot.is_none()) else {
                    continue;
                };
                let tree = canonical.select(&mut holds).filter(|b| choices.contains(b));
                *slot = Some(tree.unwrap_or(row.behavior));
                if tree.is_none() {
                    refused.push((at, row.behavior));
                }
            }
            if refused.is_empty() || round + 1 >= ROUNDS {
                start = decided;
                break;
            }
            for (at, behavior) in refused {
                if let Some(slot) = start.get_mut(at) {
                    *slot = Some(behavior);
                }
            }
        }
        if let Some(found) = self.tree(&start)
            && found.size < best.found.size
        {
            let behaviors = start.into_iter().flatten().collect();
            *best = Taken { behaviors, found };
        }
    }

    /// A tree for the rows that are not open.
    fn tree(&mut self, taken: &[Option<Id<Behavior>>]) -> Option<Decanonicalised> {
        self.left = self.left.checked_sub(1)?;
        let rows = self.policy.rows.iter().zip(taken);
        let rows = rows.filter_map(|(row, taken)| {
            Some(Row {
                behavior: (*taken)?,
                ..row.clone()
            })
        });
        let policy = Policy {
            rows: rows.collect(),
            atoms: self.policy.atoms.clone(),
            behaviors: self.policy.behaviors.clone(),
            history: self.policy.history,
            ..Policy::default()
        };
        decanonicalise(&policy, &self.options).ok()
    }
}
