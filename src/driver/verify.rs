//! `btc verify`: proofs that two trees take the same decisions, and tests of claims on events.

mod rows;

pub use rows::table;

use super::learn::Learned;
use super::load::Loaded;
use super::refused::Refused;
use super::{table as tables, target, world};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::task::{Claim, ClaimKind, History, Occurrence, Task, TreeRef};
use crate::ir::tree::{Atom, Node, Tree};
use crate::ir::{Id, Name, Program};
use crate::policy::Policy;
use crate::report::difference;
use crate::tree::atoms::atoms;
use crate::tree::equivalence::{Environment, Side, Verdict, compare};
use crate::trial::claim::Tests;

/// The outcome of a proof or a test.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Proved {
    /// Whether the claim holds.
    pub holds: bool,
    /// The answer in words: equal, with environment and care set, or the shortest trace on which they part.
    pub text: String,
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
            history: assumed(&[&a.root, &b.root]),
            recorded: None,
        };
        return pair.prove((&a.name, &a.root), (&b.name, &b.root));
    }
    let task = target::task_of(loaded, Some(left))?;
    let other = target::task_of(loaded, Some(right))?;
    if task != other {
        let (first, second) = (&program.tasks[task].name, &program.tasks[other].name);
        let diagnostic = Diagnostic::new(
            Code::E0504,
            target::end_of_file(loaded),
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
        history: program.tasks[task].history,
        recorded: recorded.as_ref(),
    };
    pair.prove((&a.name, &a.root), (&b.name, &b.root))
}

/// Proves or tests every claim of the program whose trees exist.
///
/// # Errors
/// As [`trees`], or the world cannot be built.
pub fn claims(loaded: &Loaded) -> Result<Vec<Proved>, Refused> {
    let program = &loaded.program;
    let mut results = Vec::new();
    let mut tests = Tests::new(program);
    for claim in &program.claims {
        let TreeRef::Tree(id) = claim.tree else {
            results.push(not_learned(&claim.text));
            continue;
        };
        let tree = &program.trees[id];
        results.push(match &claim.kind {
            ClaimKind::Equals(TreeRef::Tree(other)) => compared(loaded, id, *other)?,
            ClaimKind::Equals(TreeRef::Learned(_)) => not_learned(&claim.text),
            ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence) => {
                let task = target::task_of(loaded, Some(id))?;
                tested(loaded, &mut tests, (task, &tree.root), claim, occurrence)?
            }
        });
    }
    if results.is_empty() {
        results.push(Proved {
            holds: true,
            text: "the program claims nothing".to_owned(),
        });
    }
    Ok(results)
}

fn not_learned(claim: &str) -> Proved {
    Proved {
        holds: true,
        text: format!("{claim}: not learned yet"),
    }
}

/// Proves or tests the claims on the tree that was just learned; proofs go along the greedy transitions of its policy.
///
/// # Errors
/// A claim asks what the policy does not observe, or the world cannot be built.
pub fn claims_of_learned(loaded: &Loaded, learned: &Learned) -> Result<Vec<Proved>, Refused> {
    let program = &loaded.program;
    let task = program.learners[learned.learner].task;
    let pair = Pair {
        loaded,
        history: program.tasks[task].history,
        recorded: Some(&learned.policy),
    };
    let mut tests = Tests::new(program);
    let mut results = Vec::new();
    for claim in &program.claims {
        let subject = side(program, learned, claim.tree);
        let own = is_learned(program, learned, claim.tree);
        match (&claim.kind, subject) {
            (ClaimKind::Equals(other), Some(left)) => {
                let own = own || is_learned(program, learned, *other);
                if let (true, Some(right)) = (own, side(program, learned, *other)) {
                    results.push(pair.prove(left, right)?);
                }
            }
            (ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence), Some((_, root)))
                if own =>
            {
                results.push(tested(loaded, &mut tests, (task, root), claim, occurrence)?);
            }
            _ => {}
        }
    }
    Ok(results)
}

/// The test of a claim on an event.
fn tested<'a>(
    loaded: &Loaded,
    tests: &mut Tests<'a>,
    subject: (Id<Task>, &'a Node),
    claim: &Claim,
    occurrence: &Occurrence,
) -> Result<Proved, Refused> {
    let reaches = matches!(claim.kind, ClaimKind::Reaches(_));
    let tested = tests
        .event(subject, occurrence, reaches)
        .map_err(|why| world::unplayable(loaded, why))?;
    let (verdict, side) = match tested.refuted {
        true => ("refuted", "above"),
        false => ("not refuted", "below"),
    };
    Ok(Proved {
        holds: !tested.refuted,
        text: format!(
            "{}: {verdict} in {} episodes; it fails in {} of them, a rate {side} {:.2} % at 95 %",
            claim.text,
            tested.episodes,
            tested.failed,
            100.0 * tested.bound()
        ),
    })
}

/// Whether a claim is about the tree that was learned: through the learner, or through an earlier result of the same
/// name, which the new one replaces.
fn is_learned(program: &Program, learned: &Learned, tree: TreeRef) -> bool {
    match tree {
        TreeRef::Tree(id) => program.trees[id].name == program.learners[learned.learner].name,
        TreeRef::Learned(id) => id == learned.learner,
    }
}

fn side<'a>(
    program: &'a Program,
    learned: &'a Learned,
    tree: TreeRef,
) -> Option<(&'a Name, &'a Node)> {
    if is_learned(program, learned, tree) {
        let learner = &program.learners[learned.learner];
        return Some((&learner.name, &learned.root));
    }
    match tree {
        TreeRef::Tree(id) => {
            let tree = &program.trees[id];
            Some((&tree.name, &tree.root))
        }
        TreeRef::Learned(_) => None,
    }
}

/// Two trees in their environment.
struct Pair<'a> {
    loaded: &'a Loaded,
    history: History,
    recorded: Option<&'a Policy>,
}

impl Pair<'_> {
    fn prove(
        &self,
        (left, a): (&Name, &Node),
        (right, b): (&Name, &Node),
    ) -> Result<Proved, Refused> {
        let program = &self.loaded.program;
        let environment = match self.recorded {
            Some(policy) => Environment::Greedy(policy),
            None => Environment::Any(self.history),
        };
        let verdict = compare(Side::Tree(a), Side::Tree(b), environment).map_err(|unknown| {
            let diagnostic = Diagnostic::new(
                Code::E0610,
                self.place_of_table(),
                format!(
                    "the table does not say whether `{}` holds, and a tree asks it",
                    program.atom_name(unknown.0)
                ),
            )
            .label("named here");
            Refused::program(self.loaded, [diagnostic])
        })?;
        Ok(match verdict {
            Verdict::Equal(explored) => Proved {
                holds: true,
                text: match self.recorded {
                    Some(policy) => {
                        let open = match explored.open {
                            0 => "closed under them".to_owned(),
                            n => format!(
                                "with {n} places where the table says nothing of what follows"
                            ),
                        };
                        format!(
                            "equal: `{left}` and `{right}` select the same behaviour on {} minterms and {} of {} greedy \
                             transitions, {open}",
                            explored.minterms,
                            explored.transitions,
                            policy.transitions.len()
                        )
                    }
                    None => format!(
                        "equal: `{left}` and `{right}` select the same behaviour in every environment that is \
                         consistent with {} ({})",
                        self.window(),
                        explored.means_text()
                    ),
                },
            },
            Verdict::Differ(trace) => Proved {
                holds: false,
                text: {
                    let along = match self.recorded {
                        Some(_) => "along the greedy transitions".to_owned(),
                        None => format!("in an environment consistent with {}", self.window()),
                    };
                    difference::text(program, (left, right), &along, &trace)
                },
            },
            Verdict::Undecided(explored) => Proved {
                holds: false,
                text: format!(
                    "undecided: `{left}` and `{right}` agree on the {} states explored, and there are more",
                    explored.states
                ),
            },
        })
    }

    fn place_of_table(&self) -> crate::source::Span {
        let end = target::end_of_file(self.loaded);
        self.loaded.tables.first().map_or(end, |(_, span)| *span)
    }

    /// The history window in words.
    fn window(&self) -> String {
        if self.loaded.program.tasks.is_empty() {
            let window = self.history.window;
            return format!("a history of {window}, as no task says another");
        }
        "the history window".to_owned()
    }
}

/// The window of a program without a task: the paper's if one of these trees has memory or asks the history, else none.
fn assumed(trees: &[&Node]) -> History {
    let asks = |atom: &Atom| !matches!(atom, Atom::Predicate(_));
    let remembered = |root: &&Node| root.remembers() || atoms(root).iter().any(asks);
    let remembers = trees.iter().any(remembered);
    History {
        window: usize::from(remembers),
        success: remembers,
        failure: remembers,
    }
}
