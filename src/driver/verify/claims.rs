//! The claims of a program.

use super::{Pair, Proved, compared};
use crate::diagnostic::render::on_one_line;
use crate::driver::learn::Learned;
use crate::driver::load::Loaded;
use crate::driver::run::Subject;
use crate::driver::trace::{self, Step};
use crate::driver::{Refused, target, world};
use crate::ir::task::{Claim, ClaimKind, Occurrence, Task, TreeRef};
use crate::ir::tree::{Node, Tree};
use crate::ir::{Id, Name, Program};
use crate::report::verdict::Answer;
use crate::report::words;
use crate::tree::equivalence::Environment;
use crate::trial::claim::{Finding, SEED, Tests};

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
            ClaimKind::Equals(TreeRef::Tree(other)) => {
                compared(loaded, id, *other)?.of(&claim.text)
            }
            ClaimKind::Equals(TreeRef::Learned(_)) => not_learned(&claim.text),
            ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence) => {
                let task = target::task_of(loaded, Some(id))?;
                let (mut proved, shortest) =
                    tested(loaded, &mut tests, (task, &tree.root), claim, occurrence)?;
                if let Some(shortest) = shortest {
                    let file = loaded.sources.get(loaded.main);
                    let file = file.map_or("FILE", |file| &file.name);
                    let told = failing(loaded, (id, file), &claim.kind, shortest)?;
                    proved.text.push_str(&told);
                }
                proved
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

/// The claims of a program as the language writes them, each with whether its trees are there, in the order of their
/// answers.
pub fn claimed(program: &Program) -> impl Iterator<Item = (&str, bool)> {
    program.claims.iter().map(|claim| {
        let other = match &claim.kind {
            ClaimKind::Equals(other) => *other,
            ClaimKind::Never(_) | ClaimKind::Reaches(_) => claim.tree,
        };
        let is_there = |tree| matches!(tree, TreeRef::Tree(_));
        (claim.text.as_str(), is_there(claim.tree) && is_there(other))
    })
}

impl Proved {
    /// The answer to this claim.
    fn of(self, claim: &str) -> Self {
        Self {
            text: format!("{claim}: {}", self.text),
            ..self
        }
    }
}

fn not_learned(claim: &str) -> Proved {
    let proved = Proved {
        answer: Answer::Holds,
        text: "not learned yet".to_owned(),
    };
    proved.of(claim)
}

/// Proves or tests the claims on the tree that was just learned; proofs go along the greedy transitions of its policy.
/// `file` is where the tree is written.
///
/// # Errors
/// A claim asks what the policy does not observe, or the world cannot be built.
pub fn claims_of_learned(
    loaded: &Loaded,
    learned: &Learned,
    file: &str,
) -> Result<Vec<Proved>, Refused> {
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
                    results.push(pair.prove(left, right)?.of(&claim.text));
                }
            }
            (ClaimKind::Never(occurrence) | ClaimKind::Reaches(occurrence), Some((_, root)))
                if own =>
            {
                let (mut proved, shortest) =
                    tested(loaded, &mut tests, (task, root), claim, occurrence)?;
                if let Some(shortest) = shortest {
                    let (with, tree) = with_learned(loaded, learned);
                    let told = failing(&with, (tree, file), &claim.kind, shortest)?;
                    proved.text.push_str(&told);
                }
                results.push(proved);
            }
            _ => {}
        }
    }
    Ok(results)
}

/// The test of a claim on an event; of a refuted one with the shortest episode in which it fails, and its ticks.
fn tested<'a>(
    loaded: &Loaded,
    tests: &mut Tests<'a>,
    subject: (Id<Task>, &'a Node),
    claim: &Claim,
    occurrence: &Occurrence,
) -> Result<(Proved, Option<(u64, u64)>), Refused> {
    let reaches = matches!(claim.kind, ClaimKind::Reaches(_));
    let tested = tests
        .event(subject, occurrence, reaches)
        .map_err(|why| world::unplayable(loaded, why))?;
    let (answer, verdict) = match tested.finding {
        Finding::Refuted => (Answer::Fails, "refuted"),
        Finding::Kept => (Answer::Holds, "not refuted"),
        Finding::Open => (Answer::Undecided, "undecided"),
    };
    let [low, high] = tested.trials.interval95().map(|rate| 100.0 * rate);
    let failed = match tested.trials.hits() {
        0 => format!("none of them, a rate below {high:.2} %"),
        failed => format!("{failed} of them, a rate from {low:.2} % to {high:.2} %"),
    };
    let proved = Proved {
        answer,
        text: format!(
            "{verdict} in {}; it fails in {failed} (95 %)",
            words::counted(tested.trials.trials() as usize, "episode"),
        ),
    };
    let proved = proved.of(&claim.text);
    Ok((proved, tested.shortest.filter(|_| tested.refuted())))
}

/// How many decisions of a failing episode are told.
const TOLD: usize = 6;

/// The end of an episode in which a claim fails, or what led to the event that never was to happen, and how to see the whole of
/// it.
fn failing(
    loaded: &Loaded,
    (tree, file): (Id<Tree>, &str),
    kind: &ClaimKind,
    (episode, ticks): (u64, u64),
) -> Result<String, Refused> {
    let subject = Subject::Tree(tree);
    let episodes = episode..episode + 1;
    let mut trace = trace::trace(loaded, &subject, episodes, SEED, Step::Decision)?;
    trace.lines.retain(|line| line.found.tick < ticks);
    if let ClaimKind::Never(never) = kind {
        let lines = &mut trace.lines;
        let first = lines
            .iter()
            .position(|line| line.events.contains(&never.event));
        lines.truncate(first.map_or(lines.len(), |at| at + 1));
    }
    let file = on_one_line(file);
    let mut text = format!(
        "\n  the shortest run in which it fails, shown by `btc run {file} --tree {} --episode {episode} --trace -`:",
        loaded.program.trees[tree].name
    );
    let lines = trace.told();
    if lines.len() > TOLD {
        text.push_str("\n      …");
    }
    for line in lines.iter().skip(lines.len().saturating_sub(TOLD)) {
        text.push_str(&format!("\n      {line}"));
    }
    Ok(text)
}

/// The program with the tree that was learned.
fn with_learned(loaded: &Loaded, learned: &Learned) -> (Loaded, Id<Tree>) {
    let mut with = loaded.clone();
    let tree = with.program.trees.push(learned.tree.clone());
    (with, tree)
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
