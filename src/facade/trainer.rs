//! Learning in an environment of one's own.

use super::{Error, Tree};
use crate::driver::environment::{self, Taught, Terms};
use crate::driver::learn::Options;
use crate::environment::Environment;
use crate::ir::task::History;
use crate::learn::statistics::Mean;
use std::sync::Arc;

/// What is to be learned in an [`Environment`], and how long.
///
/// `make` makes environments, one for each thread; they must be alike. The seed decides everything, on any number of
/// threads.
#[derive(Clone, Debug)]
#[must_use]
pub struct Trainer<F> {
    make: F,
    terms: Terms,
}

impl<E: Environment, F: Fn() -> E + Sync> Trainer<F> {
    /// In environments that `make` makes: no names so far, no history, 1000 steps an episode, a discount of 0.99 a step,
    /// 1000 episodes of which the first decide at random and the last by a tenth.
    pub fn new(make: F) -> Self {
        let terms = Terms {
            name: "learned".to_owned(),
            predicates: Vec::new(),
            behaviors: Vec::new(),
            history: History::default(),
            patience: None,
            limit: 1000,
            discount: 0.99,
            initial: 0.0,
            explore: [1.0, 0.1],
            episodes: 1000,
        };
        Self { make, terms }
    }

    /// Calls the tree so; `learned` if not said.
    pub fn name(mut self, name: &str) -> Self {
        self.terms.name = name.to_owned();
        self
    }

    /// The names of the predicates: [`Environment::holds`] is asked for them by their places in this list.
    pub fn predicates<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.terms.predicates = names.into_iter().map(S::into).collect();
        self
    }

    /// The names of the behaviours: [`Environment::act`] is asked for them by their places in this list. The first is
    /// what is done where nothing was learned.
    pub fn behaviors<S: Into<String>>(mut self, names: impl IntoIterator<Item = S>) -> Self {
        self.terms.behaviors = names.into_iter().map(S::into).collect();
        self
    }

    /// Lets trees ask `done(…)` of the last `window` successes and failures and `failed(…)` likewise.
    pub fn history(mut self, window: usize) -> Self {
        self.terms.history = History {
            window,
            success: true,
            failure: true,
        };
        self
    }

    /// A decision is due after this many steps, even if nothing has changed.
    pub fn patience(mut self, steps: u64) -> Self {
        self.terms.patience = Some(steps);
        self
    }

    /// Episodes are cut after this many steps. What would have followed still counts.
    pub fn limit(mut self, steps: u64) -> Self {
        self.terms.limit = steps;
        self
    }

    /// What the reward of the next step counts, above 0 and at most 1.
    pub fn discount(mut self, a_step: f64) -> Self {
        self.terms.discount = a_step;
        self
    }

    /// The part of the decisions that are random, at the beginning of learning and at its end.
    pub fn explore(mut self, begin: f64, end: f64) -> Self {
        self.terms.explore = [begin, end];
        self
    }

    /// The number of episodes to learn from.
    pub fn episodes(mut self, episodes: u64) -> Self {
        self.terms.episodes = episodes;
        self
    }

    /// Learns a policy, turns it into a tree that is proved equal to it, and grows a smaller one that returns as much.
    ///
    /// Of the options, `learner` and `source` say nothing here; the seed is 1 if not said.
    ///
    /// # Errors
    /// Names or numbers do not fit, or nothing was learned.
    pub fn learn(&self, options: &Options) -> Result<Trained, Error> {
        let taught = environment::learn(&self.make, &self.terms, options, &|_| {})?;
        Ok(Trained::new(taught))
    }

    /// The returns of episodes 0 … n − 1 of a seed under a tree that was learned under these names. They are none of those
    /// that trees are learned from.
    ///
    /// # Errors
    /// The tree has other names.
    pub fn play(&self, tree: &Tree, episodes: u64, seed: u64) -> Result<Vec<f64>, Error> {
        let tree = (tree.program(), tree.ir());
        Ok(environment::play(
            &self.make,
            &self.terms,
            tree,
            (episodes, seed),
        )?)
    }
}

/// What was learned in an environment.
#[derive(Clone, Debug)]
pub struct Trained {
    tree: Tree,
    exact: Tree,
    proved: String,
    returns: Mean,
    policy: String,
    values: String,
    report: Vec<String>,
}

impl Trained {
    fn new(taught: Taught) -> Self {
        let program = Arc::new(taught.program);
        Self {
            tree: Tree::new(Arc::clone(&program), taught.tree),
            exact: Tree::new(program, taught.exact),
            proved: taught.proved,
            returns: taught.returns,
            policy: taught.policy,
            values: taught.values,
            report: taught.report,
        }
    }

    /// The tree: the grown one unless the exact one was asked for.
    pub fn tree(&self) -> &Tree {
        &self.tree
    }

    /// The tree that is proved equal to the policy.
    pub fn exact(&self) -> &Tree {
        &self.exact
    }

    /// On what the exact tree is proved.
    pub fn proved(&self) -> &str {
        &self.proved
    }

    /// The return of an episode under the tree, with its 95 % interval. For a grown tree it was measured on episodes that
    /// nothing was chosen by.
    pub fn returns(&self) -> Mean {
        self.returns
    }

    /// The policy as a table: a column for each predicate and one for the behaviour, as comma-separated values.
    pub fn policy(&self) -> &str {
        &self.policy
    }

    /// The Q-table: a row for each minterm and each behaviour that was tried in it, as comma-separated values.
    pub fn q_table(&self) -> &str {
        &self.values
    }

    /// What a person wants to know of the learning and of the tree, in lines.
    pub fn report(&self) -> &[String] {
        &self.report
    }
}
