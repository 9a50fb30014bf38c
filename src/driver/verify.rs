//! `btc verify`: proofs that two trees take the same decisions, and tests of claims on events.

mod claims;
mod rows;
mod values;

pub use claims::{claimed, claims, claims_of_learned};
pub use rows::table;

use super::load::Loaded;
use super::refused::Refused;
use super::{table as tables, target};
use crate::check::exclusions;
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Exclusion, Node, Status, Tree};
use crate::ir::{Id, Name, Program};
use crate::report::verdict::{self, Answer};
use crate::tree::atoms::atoms;
use crate::tree::equivalence::{Environment, Onward, Side, Unknown, Verdict, compare_onward};
use std::collections::BTreeSet;

/// The outcome of a proof or a test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proved {
    /// Whether the claim holds.
    pub answer: Answer,
    /// The answer in words: equal, with environment and care set, or the shortest trace on which they part.
    pub text: String,
}

impl Proved {
    /// Whether the claim holds: not where it is undecided.
    pub fn holds(&self) -> bool {
        self.answer == Answer::Holds
    }
}

/// Compares two trees of a program, in the environment that its main file names or else in any that is consistent with
/// the history window.
///
/// # Errors
/// There is no such tree, the trees are for different tasks, or the table that is named does not fit.
pub fn trees(loaded: &Loaded, left: &str, right: &str) -> Result<Proved, Refused> {
    let left = target::tree(loaded, left)?;
    let right = target::tree(loaded, right)?;
    compared(loaded, left, right)
}

fn compared(loaded: &Loaded, left: Id<Tree>, right: Id<Tree>) -> Result<Proved, Refused> {
    let program = &loaded.program;
    let (a, b) = (&program.trees[left], &program.trees[right]);
    if program.tasks.is_empty() {
        let pair = Pair {
            loaded,
            environment: Environment::Any(assumed(&[&a.root, &b.root])),
        };
        return pair.prove((&a.name, &a.root), (&b.name, &b.root));
    }
    let task = target::task_of(loaded, Some(left))?;
    let other = target::task_of(loaded, Some(right))?;
    if task != other {
        let (first, second) = (&program.tasks[task].name, &program.tasks[other].name);
        let diagnostic = Diagnostic::new(
            Code::E0504,
            target::tree_span(loaded, b),
            format!(
                "`{}` is for the task `{first}`, `{}` for `{second}`",
                a.name, b.name
            ),
        )
        .label("trees for different tasks are not compared");
        return Err(Refused::program(loaded, [diagnostic]));
    }
    let recorded = match loaded.tables.as_slice() {
        [] => None,
        [(file, _), ..] => Some(tables::environment(loaded, *file, task)?),
    };
    let pair = Pair {
        loaded,
        environment: match &recorded {
            Some(policy) => Environment::Greedy(policy),
            None => Environment::Any(program.tasks[task].history),
        },
    };
    pair.prove((&a.name, &a.root), (&b.name, &b.root))
}

/// Two trees in their environment.
struct Pair<'a> {
    loaded: &'a Loaded,
    environment: Environment<'a>,
}

impl Pair<'_> {
    fn prove(
        &self,
        (left, a): (&Name, &Node),
        (right, b): (&Name, &Node),
    ) -> Result<Proved, Refused> {
        let program = &self.loaded.program;
        let excluded = exclusions(program, &asked(&[a, b]));
        let compared = within(program, (a, b), (self.environment, &excluded));
        let (environment, verdict, onward) = compared.map_err(|unknown| {
            let tables = self.loaded.tables.first();
            let end = target::end_of_file(self.loaded);
            let diagnostic = Diagnostic::new(
                Code::E0610,
                tables.map_or(end, |(_, span)| *span),
                format!(
                    "the table does not say whether `{}` holds, and a tree asks it",
                    program.atom_name(unknown.0)
                ),
            )
            .label("named here");
            Refused::program(self.loaded, [diagnostic])
        })?;
        let names = (left, right);
        let mut text = verdict::text(program, names, &environment, &verdict);
        let answer = verdict::answer(&environment, &verdict);
        if answer == Answer::Holds {
            text.push_str(&verdict::onward(program, names, &onward));
        }
        Ok(Proved { answer, text })
    }
}

/// Compares two trees in an environment; if anything may happen there and the trees are not alike in all of it, once more
/// in what the predicates leave possible. Told with the environment of the verdict.
pub(crate) fn within<'e>(
    program: &Program,
    (left, right): (&Node, &Node),
    (environment, excluded): (Environment<'e>, &'e [Exclusion]),
) -> Result<(Environment<'e>, Verdict, Onward), Unknown> {
    let may_end = |behavior: Id<Behavior>, status: Status| program.may_end(behavior, status);
    let compared = |environment| {
        let found = compare_onward(Side::Tree(left), Side::Tree(right), environment, &may_end);
        found.map(|(verdict, onward)| (environment, verdict, onward))
    };
    let found = compared(environment)?;
    match (environment, &found) {
        (_, (_, Verdict::Equal(_), Onward::Alike)) => Ok(found),
        (Environment::Any(history), _) if !excluded.is_empty() => {
            compared(Environment::Possible(history, excluded))
        }
        _ => Ok(found),
    }
}

/// What the guards of these trees ask.
fn asked(trees: &[&Node]) -> BTreeSet<Atom> {
    trees.iter().flat_map(|root| atoms(root)).collect()
}

/// The window of a program without a task: the paper's if one of these trees has memory or asks the history, else none.
pub(crate) fn assumed(trees: &[&Node]) -> History {
    let asks = |atom: &Atom| !matches!(atom, Atom::Predicate(_));
    let remembers = trees.iter().any(|root| root.remembers()) || asked(trees).iter().any(asks);
    History {
        window: usize::from(remembers),
        success: remembers,
        failure: remembers,
    }
}
