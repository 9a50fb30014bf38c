//! Learning in a world of a user's own: names become a program that declares them, results become texts.

use super::learn::pipeline::{self, Unlearned};
use super::learn::{Options, Stage};
use crate::environment::{Ended, Environment, Hosted};
use crate::ir::expr::Expr;
use crate::ir::law::Behavior;
use crate::ir::operator::Binary;
use crate::ir::program::{Event, Predicate};
use crate::ir::task::{Discount, History, Learner, Method, Objective, Task, Written};
use crate::ir::tree::{Node, Tree};
use crate::ir::{Id, Name, Program};
use crate::learn::episode::play_all;
use crate::learn::experiment::Experiment;
use crate::learn::process::World;
use crate::learn::simulated::Purpose;
use crate::learn::statistics::Mean;
use crate::policy::{decisions, evidence};
use crate::report;
use crate::tree::Runner;
use crate::trial::play::Ticked;
use std::collections::BTreeSet;
use std::fmt;

/// What is to be learned in an environment.
#[derive(Clone, Debug, PartialEq)]
pub struct Terms {
    /// The name of the tree.
    pub name: String,
    /// The names of the predicates, in order.
    pub predicates: Vec<String>,
    /// The names of the behaviours, in order.
    pub behaviors: Vec<String>,
    /// The terminations that are remembered.
    pub history: History,
    /// A decision is due after this many steps without another reason.
    pub patience: Option<u64>,
    /// The most steps of an episode.
    pub limit: u64,
    /// The factor on the reward of the next step.
    pub discount: f64,
    /// The value of what was never tried.
    pub initial: f64,
    /// The part of random decisions at the beginning of learning and at its end.
    pub explore: [f64; 2],
    /// The number of episodes to learn from.
    pub episodes: u64,
}

/// What is wrong with the terms.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unfit {
    /// There is no behaviour to choose.
    NoBehavior,
    /// Two predicates or two behaviours have this name.
    Twice(String),
    /// There are this many atoms; a minterm holds 128.
    TooManyAtoms(usize),
    /// This is not within its range.
    OutOfRange(&'static str),
    /// The tree has names of its own.
    OtherNames,
}

impl fmt::Display for Unfit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoBehavior => f.write_str("there is no behaviour to choose"),
            Self::Twice(name) => write!(f, "`{name}` is named twice"),
            Self::TooManyAtoms(n) => write!(f, "a minterm holds 128 atoms, these are {n}"),
            Self::OutOfRange(what) => f.write_str(what),
            Self::OtherNames => f.write_str("the tree is for an environment of other names"),
        }
    }
}

/// What was learned in an environment.
#[derive(Clone, Debug)]
pub struct Taught {
    /// The program that declares the names.
    pub program: Program,
    /// The tree that was asked for.
    pub tree: Tree,
    /// The exact tree, which is proved.
    pub exact: Tree,
    /// What was proved of it.
    pub proved: String,
    /// The return of an episode under the tree, on episodes that nothing was chosen by.
    pub returns: Mean,
    /// The policy as a table.
    pub policy: String,
    /// The Q-table.
    pub values: String,
    /// The report.
    pub report: Vec<String>,
}

/// Why nothing was learned in an environment.
#[derive(Clone, Debug, PartialEq)]
pub enum Untaught {
    /// The terms are unfit.
    Unfit(Unfit),
    /// Learning has no result.
    Unlearned(Unlearned),
}

impl fmt::Display for Untaught {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unfit(why) => why.fmt(f),
            Self::Unlearned(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for Untaught {}

impl Terms {
    fn check(&self) -> Result<(), Unfit> {
        let range = |fits: bool, what| match fits {
            true => Ok(()),
            false => Err(Unfit::OutOfRange(what)),
        };
        range(self.limit > 0, "an episode has at least one step")?;
        range(self.episodes > 0, "there is at least one episode")?;
        range(
            self.patience != Some(0),
            "a decision takes at least one step",
        )?;
        let part = |value: &f64| (0.0..=1.0).contains(value);
        range(
            part(&self.discount) && self.discount > 0.0,
            "the discount is above 0 and at most 1",
        )?;
        range(self.explore.iter().all(part), "exploration is from 0 to 1")?;
        range(self.initial.is_finite(), "an initial value is finite")?;
        if self.behaviors.is_empty() {
            return Err(Unfit::NoBehavior);
        }
        for names in [&self.predicates, &self.behaviors] {
            let mut known = BTreeSet::new();
            if let Some(twice) = names.iter().find(|name| !known.insert(*name)) {
                return Err(Unfit::Twice(twice.clone()));
            }
        }
        Ok(())
    }

    /// The program that declares the names, with a task and its learner.
    fn program(&self) -> Program {
        let mut program = Program::default();
        let no = program.pool.bool(false);
        let end_on = Ended::ALL.map(|end| {
            let event = program.events.push(Event {
                name: Name::word(end.name()),
                when: no,
            });
            program.pool.leaf(Expr::Event(event))
        });
        let declare = |name: &String| {
            program.predicates.push(Predicate {
                name: Name::word(name),
                when: None,
            })
        };
        let observe = self.predicates.iter().map(declare).collect();
        let declare = |name: &String| {
            program.behaviors.push(Behavior {
                name: Name::word(name),
                law: None,
            })
        };
        let choose = self.behaviors.iter().map(declare).collect();
        let zero = program.pool.num(0.0);
        let task = program.tasks.push(Task {
            name: Name::word("environment"),
            observe,
            choose,
            history: self.history,
            patience: self.patience,
            start: Vec::new(),
            end_on: end_on.to_vec(),
            end_after: self.limit,
            reward: Vec::new(),
            otherwise: zero,
            prices: Vec::new(),
            written: Written::default(),
        });
        let pool = &mut program.pool;
        let [from, to] = self.explore;
        let progress = pool.leaf(Expr::Progress);
        let slope = pool.num(to - from);
        let change = pool.binary(Binary::Mul, slope, progress);
        let from = pool.num(from);
        let explore = pool.binary(Binary::Add, from, change);
        program.learners.push(Learner {
            name: Name::word(&self.name),
            task,
            method: Method::Model,
            episodes: self.episodes,
            episode_ticks: self.limit,
            rate: zero,
            explore,
            objective: Objective::Discounted(Discount::PerTime(self.discount, 1.0)),
            initial: self.initial,
            unseen: None,
            seed: 1,
            dwell: 1,
            start: Vec::new(),
        });
        program
    }
}

/// The returns of episodes 0 … n − 1 under a tree, whose names belong to `program`.
///
/// # Errors
/// The tree has other names than the terms.
pub fn play<E: Environment>(
    make: impl Fn() -> E + Sync + Send,
    terms: &Terms,
    (program, tree): (&Program, &Tree),
    (episodes, seed): (u64, u64),
) -> Result<Vec<f64>, Untaught> {
    let other = Untaught::Unfit(Unfit::OtherNames);
    let predicates = program.predicates.values();
    let behaviors = program.behaviors.values();
    let same = predicates.map(|p| &p.name.family).eq(&terms.predicates)
        && behaviors.map(|b| &b.name.family).eq(&terms.behaviors);
    let (true, Some(task)) = (same, tree.task) else {
        return Err(other);
    };
    let atoms = program.atoms(task);
    let Ok(runner) = Runner::new(&tree.root, &atoms) else {
        return Err(other);
    };
    let world = Hosted::new(make, terms.behaviors.len(), atoms, terms.history);
    let start = Purpose::Run.start(seed, terms.limit);
    let episodes = play_all(episodes, start, terms.patience, || {
        (world.process(), Ticked(runner.clone()))
    });
    Ok(episodes.iter().map(|episode| episode.total).collect())
}

/// Learns in the environments that `make` makes.
///
/// # Errors
/// The terms are unfit, or nothing was learned.
pub fn learn<E: Environment>(
    make: impl Fn() -> E + Sync,
    terms: &Terms,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Taught, Untaught> {
    terms.check().map_err(Untaught::Unfit)?;
    let program = terms.program();
    let id = Id::new(0);
    let learner = &program.learners[id];
    let task = &program.tasks[learner.task];
    let atoms = program.atoms(learner.task);
    if atoms.len() > 128 {
        return Err(Untaught::Unfit(Unfit::TooManyAtoms(atoms.len())));
    }
    let world = Hosted::new(make, task.choose.len(), atoms, terms.history);
    let amount = (options.episodes, options.evidence);
    let experiment = Experiment::within(world, &program, id, amount);
    let results = pipeline::learn(&experiment, options, progress).map_err(Untaught::Unlearned)?;
    let named = |name: Name, docs: Vec<String>, root: &Node| Tree {
        name,
        docs,
        task: Some(learner.task),
        root: root.clone(),
    };
    let found = &results.trees.chosen().root;
    let origin = results.origin("an environment");
    let exact_name = match results.grown {
        Some(_) => Name::word(format!("{}_exact", terms.name)),
        None => learner.name.clone(),
    };
    let exact = named(exact_name, vec![origin.clone()], found);
    let (tree, returns) = match &results.grown {
        Some(grown) => {
            let docs = vec![origin, report::grown::doc(grown, &program, task)];
            let tree = named(learner.name.clone(), docs, &grown.root);
            (tree, grown.after.summary.total)
        }
        None => {
            let tested = results.tested.as_ref().unwrap_or(&results.summary);
            (exact.clone(), tested.total)
        }
    };
    let mut report = report::learned::lines(&results);
    if let Some(grown) = results.grown.as_ref().filter(|_| options.front) {
        report.extend(report::grown::front(grown));
    }
    Ok(Taught {
        proved: results.proved(),
        policy: decisions::write(&results.policy, &program),
        values: evidence::write(&results.policy, &program),
        report,
        returns,
        exact,
        tree,
        program,
    })
}
