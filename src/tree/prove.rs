//! Proofs that a tree takes the decisions of a policy.

mod cube;
mod plan;
mod rows;

use super::atoms::atoms;
use super::canonicalise::Irreducible;
use super::equivalence::{Environment, Explored, Side, Trace, Verdict, compare};
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::logic::{Bits, Columns};
use crate::policy::{Minterm, Policy, Row};
use cube::{Cube, Fault};
pub use plan::Reading;
use plan::{Plan, plan};
use rows::{Held, Rows};
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

/// Why a tree is not equal to a policy.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Refuted {
    /// The policy has no rows.
    Empty,
    /// The tree has no canonical form.
    Irreducible(Irreducible),
    /// With memory read from the history it decides otherwise here.
    Decides {
        /// The minterm.
        minterm: Minterm,
        /// What the policy does.
        policy: Id<Behavior>,
        /// What the tree does.
        tree: Option<Id<Behavior>>,
    },
    /// It asks what the policy does not observe.
    Unknown(Atom),
    /// On this path it decides otherwise; left is the tree, right the policy.
    Parts(Trace),
    /// There was too much to explore.
    Undecided,
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
        let atoms = policy.atoms.iter().enumerate();
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
            positions: atoms.map(|(i, atom)| (*atom, i)).collect(),
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
            Ok((plan, _)) => !plan.remembers() || self.paths(root).is_ok(),
            Err(_) => false,
        }
    }

    /// Proves it.
    ///
    /// # Errors
    /// The counterexample.
    pub fn prove(&self, root: &Node) -> Result<Proof, Refuted> {
        let (plan, reading) = self.read(root)?;
        let recorded = !self.policy.transitions.is_empty();
        // Without memory and records, a path is nothing but its minterms.
        let explored = match recorded || plan.remembers() {
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
    fn read<'t>(&self, root: &'t Node) -> Result<(Plan<'t>, Reading), Refuted> {
        if self.policy.rows.is_empty() {
            return Err(Refuted::Empty);
        }
        let plan = plan(root).map_err(Refuted::Irreducible)?;
        if let Some(unknown) = atoms(root).into_iter().find(|atom| !self.knows(*atom)) {
            return Err(Refuted::Unknown(unknown));
        }
        let furthest = self.read_by(&plan, Reading::Furthest);
        let reading = match furthest {
            Ok(()) => Reading::Furthest,
            Err(_) if plan.remembers() && self.read_by(&plan, Reading::Unfinished).is_ok() => {
                Reading::Unfinished
            }
            Err(refuted) => return Err(refuted),
        };
        Ok((plan, reading))
    }

    fn read_by(&self, plan: &Plan, reading: Reading) -> Result<(), Refuted> {
        let none = Bits::empty(self.policy.rows.len());
        let plain = self.plain.iter();
        let all = plain.fold(none.clone(), |all, (_, rows)| all.or(rows));
        let mut selected: Vec<(Id<Behavior>, Bits)> = Vec::new();
        let mut wrong = none;
        let mut rows = Rows {
            table: self,
            reading,
            selected: |behavior, rows: &Bits| {
                let own = self.plain.iter().find(|(b, _)| *b == behavior);
                let other = own.map_or_else(|| rows.clone(), |(_, own)| rows.minus(own));
                if !other.is_empty() {
                    wrong = wrong.or(&other);
                    selected.push((behavior, other));
                }
            },
        };
        let nothing = rows.read(plan, &all);
        if let Some(first) = wrong.or(&nothing).first() {
            let tree = selected.iter().find(|(_, rows)| rows.contains(first));
            return Err(self.decides(first, None, tree.map(|(behavior, _)| *behavior)));
        }
        let mut steps = CUBES;
        for i in &self.wide {
            let Some(row) = self.policy.rows.get(*i) else {
                continue;
            };
            let mut cube = Cube::new(row, &self.positions, reading);
            match cube.selects(plan, row.behavior, &mut steps) {
                Ok(()) => {}
                Err(Fault::Spent) => return Err(Refuted::Undecided),
                Err(Fault::Decides(minterm, tree)) => {
                    return Err(self.decides(*i, Some(minterm), tree));
                }
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

    /// Whether the policy tells an atom, if only by that its window never remembers it.
    fn knows(&self, atom: Atom) -> bool {
        let history = self.policy.history;
        self.positions.contains_key(&atom)
            || match atom {
                Atom::Predicate(_) => false,
                Atom::Done(_) => history.window == 0 || !history.success,
                Atom::Failed(_) => history.window == 0 || !history.failure,
            }
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

impl Held for Prover<'_> {
    fn held(&self, atom: Atom) -> Option<&Bits> {
        self.column(atom)
    }
}
