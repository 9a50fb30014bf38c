//! Slack: decisions of a table that may be exchanged for others of nearly the same value, where that makes the tree
//! smaller.
//!
//! The values of a table do not show what follows from an exchange. So a tree made with slack is never called equal to
//! its table, and every minterm in which it deviates is listed.

use super::{Decanonicalised, Options, allowing, decanonicalise};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Atom;
use crate::policy::{Policy, Row};
use crate::tree::canonicalise::canonicalise;

/// Rounds in which the rows that a tree may not decide as it does are fixed one after the other; after the last round all
/// rows are fixed.
const ROUNDS: usize = 6;

/// The effort of the search for one of many trees is the whole effort divided by this.
const SHARE: u64 = 20;

/// The trees that are tried: this many divided by the number of rows, within these bounds.
const TRIES: usize = 400_000;
const FEWEST_TRIES: usize = 8;
const MOST_TRIES: usize = 200;

/// A tree that deviates from its table.
#[derive(Clone, Debug)]
pub struct Loosened {
    /// The tree, proved on the table with the deviations.
    pub found: Decanonicalised,
    /// The deviations, in the order of the rows.
    pub deviations: Vec<Deviation>,
}

/// A minterm in which a tree deviates from its table.
#[derive(Clone, Copy, Debug)]
pub struct Deviation {
    /// The number of its row.
    pub row: usize,
    /// What the tree does there.
    pub behavior: Id<Behavior>,
    /// How much less that is worth than what the table does.
    pub loss: f64,
}

/// The smallest tree that is found where every behaviour is allowed that is worth at most `slack` less than the table's;
/// `None` if no such tree is smaller than the exact one.
pub fn loosen(
    policy: &Policy,
    exact: &Decanonicalised,
    options: &Options,
    slack: f64,
) -> Option<Loosened> {
    let rows = policy.rows.iter();
    let mut trials = Trials {
        policy,
        allowed: rows.map(|row| allowed(policy, row, slack)).collect(),
        options: Options {
            effort: options.effort / SHARE,
            ..*options
        },
        left: (TRIES / policy.rows.len().max(1)).clamp(FEWEST_TRIES, MOST_TRIES),
    };
    if trials.allowed.iter().all(|allowed| allowed.len() == 1) {
        return None;
    }
    let own: Vec<_> = policy.rows.iter().map(|row| row.behavior).collect();
    // Rows that allow several behaviours are what other tables have, too; what is found so may still grow smaller.
    let by_sets = allowing(&trials.plain(), &trials.allowed, options).ok();
    let mut best = match by_sets {
        Some((chosen, found)) if found.size < exact.size => Fitted {
            behaviors: chosen.rows.iter().map(|row| row.behavior).collect(),
            found,
        },
        _ => Fitted {
            found: trials.tree(&fixed(&own))?,
            behaviors: own,
        },
    };
    let fewest = trials.fewest();
    trials.improve(&mut best, fixed(&fewest));
    trials.improve(&mut best, trials.opened(None, &fewest));
    loop {
        let before = best.found.size;
        for behavior in &policy.behaviors {
            let start = trials.opened(Some(*behavior), &best.behaviors);
            trials.improve(&mut best, start);
        }
        if best.found.size == before || trials.left == 0 {
            break;
        }
    }
    trials.options = *options;
    trials.left = 1;
    let found = trials.tree(&fixed(&best.behaviors))?;
    if found.size < best.found.size {
        best.found = found;
    }
    (best.found.size < exact.size).then(|| Loosened {
        deviations: deviations(policy, &best.behaviors),
        found: best.found,
    })
}

/// The behaviours that are allowed in a row, the table's first. A row with free atoms keeps the table's behaviour.
fn allowed(policy: &Policy, row: &Row, slack: f64) -> Vec<Id<Behavior>> {
    let mut allowed = vec![row.behavior];
    if let (Some(own), None) = (value(policy, row, row.behavior), &row.free) {
        let others = policy.behaviors.iter().copied();
        allowed.extend(others.filter(|behavior| {
            let worth = value(policy, row, *behavior);
            *behavior != row.behavior && worth.is_some_and(|q| q >= own - slack)
        }));
    }
    allowed
}

fn value(policy: &Policy, row: &Row, behavior: Id<Behavior>) -> Option<f64> {
    let at = policy.behaviors.iter().position(|b| *b == behavior)?;
    row.values.get(at).copied().flatten().map(|value| value.q)
}

fn deviations(policy: &Policy, behaviors: &[Id<Behavior>]) -> Vec<Deviation> {
    let rows = policy.rows.iter().zip(behaviors).enumerate();
    rows.filter(|(_, (row, behavior))| row.behavior != **behavior)
        .map(|(at, (row, behavior))| {
            let worth = |behavior| value(policy, row, behavior).unwrap_or(0.0);
            Deviation {
                row: at,
                behavior: *behavior,
                loss: worth(row.behavior) - worth(*behavior),
            }
        })
        .collect()
}

/// For each row the behaviour that a tree has to take there; an open row has none.
type Wanted = Vec<Option<Id<Behavior>>>;

/// No row open.
fn fixed(behaviors: &[Id<Behavior>]) -> Wanted {
    behaviors.iter().map(|behavior| Some(*behavior)).collect()
}

/// A behaviour for each row, and the tree that takes them.
struct Fitted {
    behaviors: Vec<Id<Behavior>>,
    found: Decanonicalised,
}

/// The trees that are tried.
struct Trials<'a> {
    policy: &'a Policy,
    /// The behaviours that are allowed in each row.
    allowed: Vec<Vec<Id<Behavior>>>,
    options: Options,
    /// How many more trees may be tried.
    left: usize,
}

impl Trials<'_> {
    /// The policy without its transitions.
    fn plain(&self) -> Policy {
        Policy {
            rows: self.policy.rows.clone(),
            atoms: self.policy.atoms.clone(),
            behaviors: self.policy.behaviors.clone(),
            history: self.policy.history,
            ..Policy::default()
        }
    }

    /// Allowed behaviours for all rows, few different ones: greedily the one that is allowed in most open rows.
    fn fewest(&self) -> Vec<Id<Behavior>> {
        let mut chosen: Wanted = vec![None; self.allowed.len()];
        loop {
            let open = || {
                self.allowed
                    .iter()
                    .zip(&chosen)
                    .filter(|(_, c)| c.is_none())
            };
            let count =
                |b: Id<Behavior>| open().filter(|(allowed, _)| allowed.contains(&b)).count();
            let known = self.policy.behaviors.iter().copied();
            // The first of equals.
            let most = known.rev().max_by_key(|b| count(*b));
            let Some(behavior) = most.filter(|b| count(*b) > 0) else {
                break;
            };
            for (slot, allowed) in chosen.iter_mut().zip(&self.allowed) {
                if slot.is_none() && allowed.contains(&behavior) {
                    *slot = Some(behavior);
                }
            }
        }
        let rows = self.policy.rows.iter().zip(chosen);
        rows.map(|(row, chosen)| chosen.unwrap_or(row.behavior))
            .collect()
    }

    /// These behaviours, with the rows open that allow several; if a behaviour is given, only those of them that have it.
    fn opened(&self, behavior: Option<Id<Behavior>>, behaviors: &[Id<Behavior>]) -> Wanted {
        let opens = |own: &Id<Behavior>| behavior.is_none_or(|behavior| behavior == *own);
        let rows = self.allowed.iter().zip(behaviors);
        let wanted: Wanted = rows
            .map(|(allowed, own)| (allowed.len() == 1 || !opens(own)).then_some(*own))
            .collect();
        // A tree without rows would be any tree.
        match wanted.iter().all(Option::is_none) {
            true => fixed(behaviors),
            false => wanted,
        }
    }

    /// Lets a tree for the fixed rows decide the open ones, and takes the result if its tree is smaller than the best.
    fn improve(&mut self, best: &mut Fitted, mut wanted: Wanted) {
        for round in 0.. {
            if wanted.iter().all(Option::is_some) {
                break;
            }
            let Some((decided, refused)) = self.decided(&wanted) else {
                return;
            };
            if refused.is_empty() || round + 1 >= ROUNDS {
                wanted = fixed(&decided);
                break;
            }
            for row in refused {
                if let (Some(slot), Some(behavior)) = (wanted.get_mut(row), decided.get(row)) {
                    *slot = Some(*behavior);
                }
            }
        }
        if let Some(found) = self.tree(&wanted)
            && found.size < best.found.size
        {
            let behaviors = wanted.into_iter().flatten().collect();
            *best = Fitted { behaviors, found };
        }
    }

    /// The behaviours that a tree for the fixed rows takes in all rows, and the open rows in which it takes one that is
    /// not allowed: these have the table's.
    fn decided(&mut self, wanted: &Wanted) -> Option<(Vec<Id<Behavior>>, Vec<usize>)> {
        let found = self.tree(wanted)?;
        let canonical = canonicalise(&found.root, found.proof.reading).ok()?;
        let atoms = &self.policy.atoms;
        let mut refused = Vec::new();
        let rows = self.policy.rows.iter().zip(&self.allowed).zip(wanted);
        let decided = rows.enumerate().map(|(at, ((row, allowed), wanted))| {
            let mut holds = |atom: Atom| {
                let at = atoms.iter().position(|a| *a == atom);
                at.is_some_and(|i| row.minterm.get(i))
            };
            let selected = || canonical.select(&mut holds).filter(|b| allowed.contains(b));
            wanted.or_else(selected).unwrap_or_else(|| {
                refused.push(at);
                row.behavior
            })
        });
        Some((decided.collect(), refused))
    }

    /// A tree for the fixed rows.
    fn tree(&mut self, wanted: &Wanted) -> Option<Decanonicalised> {
        self.left = self.left.checked_sub(1)?;
        let rows = self.policy.rows.iter().zip(wanted);
        let rows = rows.filter_map(|(row, wanted)| {
            Some(Row {
                behavior: (*wanted)?,
                ..row.clone()
            })
        });
        let policy = Policy {
            rows: rows.collect(),
            ..self.plain()
        };
        decanonicalise(&policy, &self.options).ok()
    }
}
