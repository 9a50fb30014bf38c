//! Proofs that a tree takes the decisions of a policy.

mod refuted;
mod rows;

pub use refuted::Refuted;

use super::atoms::atoms;
use super::cube::{Cube, positions};
use super::equivalence::{Environment, Explored, Side, Verdict, compare};
use super::reading::{After, Answers, May, Plan, Reading, plan, read};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::logic::{Bits, Columns};
use crate::policy::{Minterm, Policy, Row};
use rows::RowSets;
use rustc_hash::FxHashMap;

/// What is known of a tree that was proved: in every care minterm it takes the policy's decision, with memory read from
/// the history (P1); and so does the tree itself, memory fresh, on every path of the environment (P2).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proof {
    /// The care minterms.
    pub minterms: usize,
    /// The greedy transitions that were gone through.
    pub transitions: usize,
    /// Whether no path leaves the care minterms.
    pub closed: bool,
    /// Whether the paths are those of recorded transitions; else any that the history window allows.
    pub recorded: bool,
    /// How memory is read from the history.
    pub reading: Reading,
    /// What was explored.
    pub explored: Explored,
}

/// Proves that a tree takes the decisions of a policy in all of its rows, along its greedy transitions where it has
/// any, else along every path that the history window allows.
///
/// # Errors
/// The counterexample.
pub fn prove(root: &Node, policy: &Policy) -> Result<Proof, Refuted> {
    Prover::new(policy).prove(root)
}

/// Cubes that the reading of all rows with free atoms may come to.
const CUBES: usize = 1 << 24;

/// A policy made ready for proofs: its rows transposed.
pub struct Prover<'a> {
    policy: &'a Policy,
    columns: Columns,
    positions: FxHashMap<Atom, usize>,
    /// The rows of each behaviour that stand for one minterm.
    plain: Vec<(Id<Behavior>, Bits)>,
    /// The rows that stand for several.
    wide: Vec<usize>,
}

impl<'a> Prover<'a> {
    /// Transposes the rows of a policy.
    pub fn new(policy: &'a Policy) -> Self {
        let words = |row: &'a Row| (row.minterm.words(), row.free.as_ref().map(Minterm::words));
        let mut numbers: FxHashMap<Id<Behavior>, usize> = FxHashMap::default();
        let mut plain: Vec<(Id<Behavior>, Bits)> = Vec::new();
        let mut wide = Vec::new();
        for (i, row) in policy.rows.iter().enumerate() {
            if row.free.is_some() {
                wide.push(i);
                continue;
            }
            let at = *numbers.entry(row.behavior).or_insert_with(|| {
                plain.push((row.behavior, Bits::empty(policy.rows.len())));
                plain.len() - 1
            });
            if let Some((_, rows)) = plain.get_mut(at) {
                rows.insert(i);
            }
        }
        Self {
            policy,
            columns: Columns::with_free(policy.atoms.len(), policy.rows.iter().map(words)),
            positions: positions(&policy.atoms),
            plain,
            wide,
        }
    }

    /// The rows, transposed.
    pub fn columns(&self) -> &Columns {
        &self.columns
    }

    /// The rows in which an atom is fixed to 1; `None` if the policy does not observe it.
    pub fn column(&self, atom: Atom) -> Option<&Bits> {
        let at = self.positions.get(&atom)?;
        self.columns.iter().nth(*at).map(|(_, column)| column)
    }

    /// Whether a tree takes the policy's decisions.
    pub fn proves(&self, root: &Node) -> bool {
        match self.read(root) {
            Ok(_) => !root.remembers() || self.paths(root).is_ok(),
            Err(_) => false,
        }
    }

    /// Proves it.
    ///
    /// # Errors
    /// The counterexample.
    pub fn prove(&self, root: &Node) -> Result<Proof, Refuted> {
        let reading = self.read(root)?;
        let recorded = !self.policy.transitions.is_empty();
        // Without memory and records, a path is nothing but its minterms.
        let explored = match recorded || root.remembers() {
            true => self.paths(root)?,
            false => Explored::default(),
        };
        Ok(Proof {
            minterms: self.policy.rows.len(),
            transitions: explored.transitions,
            closed: explored.open == 0,
            recorded,
            reading,
            explored,
        })
    }

    /// P1: the tree, memory read from the history, decides as the policy in every row.
    fn read(&self, root: &Node) -> Result<Reading, Refuted> {
        if self.policy.rows.is_empty() {
            return Err(Refuted::Empty);
        }
        let plan = plan(root, After::Anything, &mut May).map_err(Refuted::Irreducible)?;
        if let Some(unknown) = atoms(root).into_iter().find(|atom| !self.knows(*atom)) {
            return Err(Refuted::Unknown(unknown));
        }
        match self.read_by(&plan, Reading::Furthest) {
            Ok(()) => Ok(Reading::Furthest),
            Err(_) if root.remembers() && self.read_by(&plan, Reading::Unfinished).is_ok() => {
                Ok(Reading::Unfinished)
            }
            Err(refuted) => Err(refuted),
        }
    }

    /// The rows that stand for one minterm in which a tree without memory does not decide as the policy.
    pub fn wrong(&self, root: &Node) -> Result<Bits, Refuted> {
        let plan = plan(root, After::Anything, &mut May).map_err(Refuted::Irreducible)?;
        Ok(self.wrong_by(&plan, Reading::Furthest).0)
    }

    /// The rows that stand for one minterm in which the tree does not decide as the policy, and what it decides there.
    fn wrong_by(&self, plan: &Plan, by: Reading) -> (Bits, Vec<(Id<Behavior>, Bits)>) {
        let none = Bits::empty(self.policy.rows.len());
        let plain = self.plain.iter();
        let all = plain.fold(none.clone(), |all, (_, rows)| all.or(rows));
        let mut selected: Vec<(Id<Behavior>, Bits)> = Vec::new();
        let mut wrong = none;
        let mut rows = RowSets {
            table: self,
            selected: |behavior, rows: &Bits| {
                let own = self.plain.iter().find(|(b, _)| *b == behavior);
                let other = own.map_or_else(|| rows.clone(), |(_, own)| rows.minus(own));
                if !other.is_empty() {
                    wrong.unite(&other);
                    selected.push((behavior, other));
                }
            },
        };
        let Ok(Answers { success, failure }) = read(plan, by, all, &mut rows);
        // Where it answers without a behaviour, nothing is selected.
        (wrong.or(&success).or(&failure), selected)
    }

    fn read_by(&self, plan: &Plan, by: Reading) -> Result<(), Refuted> {
        let (wrong, selected) = self.wrong_by(plan, by);
        if let Some(first) = wrong.first() {
            let tree = selected.iter().find(|(_, rows)| rows.contains(first));
            return Err(self.decides(first, None, tree.map(|(behavior, _)| *behavior)));
        }
        let mut left = CUBES;
        for i in &self.wide {
            let Some(row) = self.policy.rows.get(*i) else {
                continue;
            };
            let mut wrong = None;
            let mut is_right = |part: &Cube, selected: Option<Id<Behavior>>| {
                let right = selected == Some(row.behavior);
                if !right {
                    wrong = Some((part.minterm(), selected));
                }
                right
            };
            let mut cube = Cube::new(
                &row.minterm,
                row.free.as_ref(),
                &self.positions,
                &self.policy.fields,
            );
            let parts = cube.parts((plan, by), &mut left, &mut is_right);
            parts.map_err(|_| Refuted::Undecided)?;
            if let Some((minterm, tree)) = wrong {
                return Err(self.decides(*i, Some(minterm), tree));
            }
        }
        Ok(())
    }

    /// The row as a counterexample.
    fn decides(&self, row: usize, at: Option<Minterm>, tree: Option<Id<Behavior>>) -> Refuted {
        match self.policy.rows.get(row) {
            Some(row) => Refuted::Decides {
                minterm: at.unwrap_or_else(|| row.minterm.clone()),
                policy: row.behavior,
                tree,
            },
            None => Refuted::Undecided,
        }
    }

    /// Whether the policy knows the value of an atom: it observes it, or its window never makes it true.
    fn knows(&self, atom: Atom) -> bool {
        let history = !matches!(atom, Atom::Predicate(_));
        self.positions.contains_key(&atom) || history && !self.policy.history.remembers(atom)
    }

    /// P2: so does the tree itself, memory fresh, on every path.
    fn paths(&self, root: &Node) -> Result<Explored, Refuted> {
        let policy = self.policy;
        let environment = match policy.transitions.is_empty() {
            true => Environment::Observed(policy),
            false => Environment::Greedy(policy),
        };
        match compare(Side::Tree(root), Side::Policy(policy), environment) {
            Ok(Verdict::Equal(explored)) => Ok(explored),
            Ok(Verdict::Differ(trace)) => Err(Refuted::Parts(trace)),
            Ok(Verdict::Undecided(_)) => Err(Refuted::Undecided),
            Err(unknown) => Err(Refuted::Unknown(unknown.0)),
        }
    }
}
