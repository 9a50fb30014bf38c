//! Tables in which a row may allow several behaviours.
//!
//! A row is no exception to any behaviour that it allows. So lists of rules are found for classes of rows that overlap, and
//! each gives every row one of its behaviours: a policy as any other, which the tree is made of and proved on.

use super::alone::{REACH, THOROUGH};
use super::core::part;
use super::{Decanonicalised, Options, decanonicalise};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::logic::covering::{Known, List, lists};
use crate::logic::{Account, Bits, Columns};
use crate::policy::{Policy, Row};
use crate::tree::prove::{Prover, Refuted};

/// The part of the effort that the choice of behaviours may take, and that the trees that are compared may.
const PARTS: u64 = 4;

/// The rows of the first core of a table, how many cores there are, and the part of the effort that one may take.
const FIRST: usize = 600;
const CORES: usize = 8;
const OF_A_CORE: u64 = 10;

/// The smallest tree found that takes an allowed behaviour in every row, with the policy on which it is proved. `allowed` are the
/// behaviours that each row allows.
///
/// # Errors
/// The policy has no rows, or the tree that was found is refuted: with the counterexample.
pub fn allowing(
    policy: &Policy,
    allowed: &[Vec<Id<Behavior>>],
    options: &Options,
) -> Result<(Policy, Decanonicalised), Refuted> {
    chosen_by(policy, allowed, options, true)
}

/// The same, with a tree for a core of rows among what is tried, or without.
fn chosen_by(
    policy: &Policy,
    allowed: &[Vec<Id<Behavior>>],
    options: &Options,
    with_core: bool,
) -> Result<(Policy, Decanonicalised), Refuted> {
    let classes: Vec<Bits> = policy
        .behaviors
        .iter()
        .map(|behavior| {
            let rows = allowed.iter().enumerate();
            let own = rows.filter(|(_, all)| all.contains(behavior));
            Bits::collect(allowed.len(), own.map(|(row, _)| row))
        })
        .collect();
    let words = |row: &Row| {
        let free = row.free.as_ref().map(|free| free.words().to_vec());
        (row.minterm.words().to_vec(), free)
    };
    let words: Vec<_> = policy.rows.iter().map(words).collect();
    let rows = words.iter().map(|(ones, free)| (&**ones, free.as_deref()));
    let columns = Columns::with_free(policy.atoms.len(), rows);
    let effort = options.effort.saturating_mul(super::EFFORT) / PARTS;
    let (mut known, account) = (Known::default(), Account::new(effort));
    let found = lists(&columns, &classes, REACH, THOROUGH, &mut known, &account);
    let lists = found.iter().rev();
    let mut choices: Vec<Vec<usize>> = lists.map(|list| by_list(&columns, list)).collect();
    if with_core {
        choices.extend(by_core(policy, allowed, options));
    }
    choices.push(by_frequency(&classes, allowed.len()));
    choices.dedup();
    let policies = choices.iter().map(|choice| chosen(policy, choice));
    let policies: Vec<Policy> = policies.collect();
    let quick = Options {
        effort: (options.effort / (PARTS * policies.len().max(1) as u64)).max(1),
        ..*options
    };
    let mut best: Option<(Policy, Decanonicalised)> = None;
    for policy in policies {
        let found = decanonicalise(&policy, &quick)?;
        if best
            .as_ref()
            .is_none_or(|(_, known)| found.size < known.size)
        {
            best = Some((policy, found));
        }
    }
    let (policy, first) = best.ok_or(Refuted::Empty)?;
    let found = decanonicalise(&policy, options)?;
    let smallest = if first.size < found.size {
        first
    } else {
        found
    };
    Ok((policy, smallest))
}

/// The behaviour of each row by a list, by its number.
fn by_list(columns: &Columns, list: &List) -> Vec<usize> {
    let mut choice = vec![list.last; columns.rows()];
    let mut left = Bits::full(columns.rows());
    for rule in &list.rules {
        let decided = columns.cube_rows(&rule.cube, &left);
        for row in decided.iter() {
            if let Some(slot) = choice.get_mut(row) {
                *slot = rule.class;
            }
        }
        left.subtract(&decided);
    }
    choice
}

/// The behaviour of each row by a tree that is made for a few rows, which grow by some in which it takes what they do not allow.
/// `None` in a small table, and where that does not end soon.
fn by_core(
    policy: &Policy,
    allowed: &[Vec<Id<Behavior>>],
    options: &Options,
) -> Option<Vec<usize>> {
    let count = policy.rows.len();
    if count < 2 * FIRST || policy.rows.iter().any(|row| row.free.is_some()) {
        return None;
    }
    let quick = Options {
        effort: (options.effort / OF_A_CORE).max(1),
        ..*options
    };
    let prover = Prover::new(policy);
    let mut core = Bits::collect(count, (0..count).step_by(count.div_ceil(FIRST)));
    for _ in 0..CORES {
        if 2 * core.count() > count {
            return None;
        }
        let part = part(policy, &core);
        let rows = core.iter();
        let own: Vec<_> = rows.filter_map(|row| allowed.get(row).cloned()).collect();
        let (_, found) = chosen_by(&part, &own, &quick, false).ok()?;
        let decided = prover.decided(&found.root).ok()?;
        let numbers = decided.iter().zip(allowed).map(|(behavior, all)| {
            let behavior = behavior.filter(|behavior| all.contains(behavior))?;
            policy.behaviors.iter().position(|known| *known == behavior)
        });
        let numbers: Vec<Option<usize>> = numbers.collect();
        let wrong = numbers.iter().enumerate();
        let wrong = wrong.filter_map(|(row, number)| number.is_none().then_some(row));
        let wrong: Vec<usize> = wrong.collect();
        if wrong.is_empty() {
            return numbers.into_iter().collect();
        }
        let step = wrong.len().div_ceil(core.count() / 2).max(1);
        core.unite(&Bits::collect(count, wrong.into_iter().step_by(step)));
    }
    None
}

/// The behaviour of each row with as few behaviours as possible: again and again the one that most rows left allow.
fn by_frequency(classes: &[Bits], rows: usize) -> Vec<usize> {
    let mut choice = vec![0; rows];
    let mut left = Bits::full(rows);
    while !left.is_empty() {
        let counts = classes.iter().enumerate();
        let counts = counts.map(|(class, own)| (own.count_both(&left), std::cmp::Reverse(class)));
        let Some((1.., std::cmp::Reverse(class))) = counts.max() else {
            break;
        };
        let Some(own) = classes.get(class) else {
            break;
        };
        for row in own.and(&left).iter() {
            if let Some(slot) = choice.get_mut(row) {
                *slot = class;
            }
        }
        left.subtract(own);
    }
    choice
}

/// The policy that takes these of its behaviours.
fn chosen(policy: &Policy, choice: &[usize]) -> Policy {
    let rows = policy.rows.iter().zip(choice);
    let rows = rows.map(|(row, class)| Row {
        behavior: policy
            .behaviors
            .get(*class)
            .copied()
            .unwrap_or(row.behavior),
        ..row.clone()
    });
    Policy {
        rows: rows.collect(),
        ..policy.clone()
    }
}
