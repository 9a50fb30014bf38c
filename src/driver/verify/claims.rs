//! The claims of a program.

use super::{Pair, Proved, compared};
use crate::driver::learn::Learned;
use crate::driver::load::Loaded;
use crate::driver::{Refused, target, world};
use crate::ir::task::{Claim, ClaimKind, Occurrence, Task, TreeRef};
use crate::ir::tree::Node;
use crate::ir::{Id, Name, Program};
use crate::report::verdict::Answer;
use crate::tree::equivalence::Environment;
use crate::trial::claim::Tests;

/// Proves or tests every claim of the program whose trees exist.
///
/// # Errors
/// As [`trees`](super::trees), or the world cannot be built.
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
            answer: Answer::Holds,
            text: "the program claims nothing".to_owned(),
        });
    }
    Ok(results)
}

fn not_learned(claim: &str) -> Proved {
    Proved {
        answer: Answer::Holds,
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
        environment: Environment::Greedy(&learned.policy),
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
    let (answer, verdict, side) = match tested.refuted {
        true => (Answer::Fails, "refuted", "above"),
        false => (Answer::Holds, "not refuted", "below"),
    };
    Ok(Proved {
        answer,
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
        return Some((&learner.name, &learned.tree.root));
    }
    match tree {
        TreeRef::Tree(id) => {
            let tree = &program.trees[id];
            Some((&tree.name, &tree.root))
        }
        TreeRef::Learned(_) => None,
    }
}
