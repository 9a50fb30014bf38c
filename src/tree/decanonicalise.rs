//! Policies to trees (paper, section VII).

mod allowed;
mod alone;
mod beam;
mod beams;
mod children;
mod choices;
mod complements;
mod core;
mod deferred;
mod exchanged;
mod list;
mod memory;
mod minimiser;
mod optimum;
mod orders;
mod pairs;
mod paper;
mod parted;
mod parts;
mod problem;
mod reach;
mod rules;
mod samples;
mod search;
mod share;
mod slack;
mod subtables;
mod subunit;
mod windows;

use super::Size;
use super::prove::{Proof, Prover, Refuted};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Node, Status};
use crate::logic::Account;
use crate::policy::{Minterm, Policy, Row};
use minimiser::Minimiser;
use problem::Problem;
use search::Found;
use serde::Serialize;
use std::borrow::Cow;
use std::collections::BTreeSet;

pub use crate::logic::Order;
pub use allowed::allowing;
pub use slack::{Deviation, Loosened, loosen};

/// How the tree is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Method {
    /// Algorithm 1 of the paper.
    Paper,
    /// The smallest tree that a search finds within its effort.
    #[default]
    Search,
}

/// In which minterms the tree has to take the policy's decision; the others are free.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Care {
    /// In all that were learned, as in the paper.
    #[default]
    Seen,
    /// In those that the greedy policy reaches.
    Reachable,
}

/// How a tree is searched for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// The method.
    pub method: Method,
    /// The care set.
    pub care: Care,
    /// The order of the units.
    pub order: Order,
    /// The work that the search may do, in units of about a twentieth of a second. It is counted in words of sets of rows that
    /// are read, never timed.
    pub effort: u64,
    /// Whether rules stand in groups behind a common guard, and small parts are solved exactly. It makes trees smaller, but
    /// a change in such a tree reaches further.
    pub tight: bool,
}

impl Default for Options {
    fn default() -> Self {
        Self {
            method: Method::default(),
            care: Care::default(),
            order: Order::default(),
            effort: 30,
            tight: true,
        }
    }
}

/// The words that one unit of effort allows to read.
const EFFORT: u64 = 25_000_000;

/// What is found with so many times less effort is found with more as well.
const FEWER: u64 = 3;

/// The most rows with a minterm each that stand in the place of cubes.
const MINTERMS: usize = 4096;

/// A part of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Stage {
    /// Algorithm 1.
    Paper,
    /// Which behaviours memory nodes join.
    Memory,
    /// The search for smaller trees.
    Search,
}

/// A tree that takes the decisions of a policy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Decanonicalised {
    /// The tree.
    pub root: Node,
    /// Its proof.
    pub proof: Proof,
    /// Its size.
    pub size: Size,
    /// The size of the tree that Algorithm 1 finds; `None` where it was not run to its end because the table is large.
    pub paper_size: Option<Size>,
    /// What was left unfinished because the effort was spent.
    pub unfinished: Vec<Stage>,
    /// Where a greedy transition shows the policy's decision failing, sorted by minterm.
    pub failing: Vec<Failing>,
}

/// A decision that was seen to fail. There the tree may tick another behaviour in the same tick.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failing {
    /// Where.
    pub minterm: Minterm,
    /// What fails.
    pub behavior: Id<Behavior>,
    /// How many times it failed.
    pub count: u64,
    /// How many of these times the minterm stayed the same, so that the policy repeats the decision.
    pub repeated: u64,
    /// What the tree may tick next in the same tick; `None` is nothing.
    pub then: Vec<Option<Id<Behavior>>>,
}

/// A tree that takes the decisions of the policy, proved.
///
/// # Errors
/// The policy has no rows, or the tree that was found is refuted: with the counterexample.
pub fn decanonicalise(policy: &Policy, options: &Options) -> Result<Decanonicalised, Refuted> {
    let found = searched(policy, options)?;
    let found = match options.method {
        Method::Search if options.order == Order::Learned => by_samples(policy, options, found),
        _ => found,
    };
    // A greater effort begins elsewhere, and may end with more.
    let less = (options.effort / FEWER).max(Options::default().effort);
    if options.effort <= less || options.method == Method::Paper {
        return Ok(found);
    }
    let quick = Options {
        effort: less,
        ..*options
    };
    let other = decanonicalise(policy, &quick)?;
    Ok(match other.size < found.size {
        true => other,
        false => found,
    })
}

/// A tree for a policy, with its proof.
fn proved(policy: &Policy, root: Node) -> Result<Decanonicalised, Refuted> {
    let proof = Prover::new(policy).prove(&root)?;
    Ok(Decanonicalised {
        size: Size::of(&root),
        paper_size: None,
        unfinished: Vec::new(),
        failing: failing(policy, &proof),
        root,
        proof,
    })
}

/// A smaller tree of a sample of the policy's minterms, if the policy has cubes and there is one; else this.
fn by_samples(policy: &Policy, options: &Options, found: Decanonicalised) -> Decanonicalised {
    if policy.rows.iter().all(|row| row.free.is_none()) || by_minterms(policy).is_some() {
        return found;
    }
    let other = samples::tree(policy, options).filter(|other| other.size < found.size);
    match other {
        Some(other) => Decanonicalised {
            paper_size: found.paper_size,
            unfinished: found.unfinished,
            failing: found.failing,
            ..other
        },
        None => found,
    }
}

fn searched(policy: &Policy, options: &Options) -> Result<Decanonicalised, Refuted> {
    let policy = &*cared(policy, options.care);
    let split = by_minterms(policy);
    let problem = Problem::new(split.as_ref().unwrap_or(policy));
    let account = Account::new(options.effort.saturating_mul(EFFORT));
    let by_paper = || paper::tree(&Minimiser::new(&problem, Account::unlimited()));
    let found = match (options.method, options.order) {
        (Method::Paper, _) => Found {
            tree: None,
            paper: by_paper(),
            unfinished: Vec::new(),
        },
        (Method::Search, Order::Learned) => search::tree(&problem, options.tight, &account),
        (Method::Search, order) => Found {
            tree: search::ordered(&problem, order, &account),
            paper: None,
            unfinished: Vec::new(),
        },
    };
    let paper_size = found.paper.as_ref().map(Size::of);
    let (root, proof) = match found.tree {
        Some((root, proof)) => (root, Some(proof)),
        None => {
            let paper = found.paper.or_else(by_paper);
            (paper.ok_or(Refuted::Undecided)?, None)
        }
    };
    let proof = match (&split, proof) {
        // What was found on minterms is proved on the cubes.
        (Some(_), _) => Prover::new(policy).prove(&root)?,
        (None, Some(proof)) => proof,
        (None, None) => problem.prover().prove(&root)?,
    };
    Ok(Decanonicalised {
        size: Size::of(&root),
        paper_size,
        unfinished: found.unfinished,
        failing: failing(policy, &proof),
        root,
        proof,
    })
}

/// The policy with a row for each minterm of its cubes; `None` if it has no cubes, or they hold more minterms than a
/// small table has rows. Only the row of a minterm is on one side of every literal.
fn by_minterms(policy: &Policy) -> Option<Policy> {
    let widths = || policy.rows.iter().map(Row::free_atoms);
    if widths().all(|free| free == 0) {
        return None;
    }
    let minterms = |free: usize| 1_usize.checked_shl(free as u32).unwrap_or(usize::MAX);
    let all = widths().map(minterms).fold(0, usize::saturating_add);
    (all <= MINTERMS).then(|| Policy {
        rows: policy.minterm_rows(),
        ..policy.clone()
    })
}

/// The policy on its care set.
fn cared(policy: &Policy, care: Care) -> Cow<'_, Policy> {
    if care == Care::Seen || policy.transitions.is_empty() {
        return Cow::Borrowed(policy);
    }
    let starts = policy.starts.iter().map(|(minterm, _)| minterm);
    let transitions = policy.transitions.iter();
    let reached: BTreeSet<Minterm> = starts
        .chain(transitions.flat_map(|t| std::iter::once(&t.from).chain(&t.to)))
        .cloned()
        .collect();
    let mut policy = policy.clone();
    policy.rows.retain(|row| reached.contains(&row.minterm));
    Cow::Owned(policy)
}

fn failing(policy: &Policy, proof: &Proof) -> Vec<Failing> {
    let mut found: Vec<Failing> = Vec::new();
    for t in &policy.transitions {
        if t.status != Status::Failure || policy.choice(&t.from) != Some(t.behavior) {
            continue;
        }
        let repeated = if t.to.as_ref() == Some(&t.from) {
            t.count
        } else {
            0
        };
        match found.iter_mut().find(|f| f.minterm == t.from) {
            Some(same) => {
                same.count += t.count;
                same.repeated += repeated;
            }
            None => found.push(Failing {
                minterm: t.from.clone(),
                behavior: t.behavior,
                count: t.count,
                repeated,
                then: proof
                    .explored
                    .after_failure
                    .get(&t.from)
                    .map(|next| next.iter().copied().collect())
                    .unwrap_or_default(),
            }),
        }
    }
    found.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    found
}
