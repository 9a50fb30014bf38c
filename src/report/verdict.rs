//! The verdict on two trees, in words.

use super::json::document;
use super::words;
use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::Status;
use crate::ir::{Id, Name, Program};
use crate::tree::equivalence::{Environment, Means, Onward, Parted, Trace, Verdict};
use serde::Serialize;
use std::fmt::Display;

/// What a proof or a test says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Answer {
    /// It holds, on evidence.
    Holds,
    /// It does not.
    Fails,
    /// There is too much to explore, or too little that was recorded.
    Undecided,
}

/// What was asked, with the answer to it.
#[derive(Clone, Debug, Serialize)]
pub struct Told<'t> {
    /// The claim as the language writes it.
    pub claim: String,
    /// The answer; `None` of a tree that is not learned yet.
    pub answer: Option<Answer>,
    /// The answer in words.
    pub text: &'t str,
}

/// Answers as a JSON document.
pub fn json(claims: &[Told]) -> String {
    #[derive(Serialize)]
    struct Document<'t> {
        claims: &'t [Told<'t>],
    }
    document(&Document { claims })
}

/// The verdict on two trees as an answer. Where greedy transitions were recorded but the trees take none of them, that
/// they agree at the start of episodes says nothing of how they go on.
pub fn answer(environment: &Environment, verdict: &Verdict) -> Answer {
    match verdict {
        Verdict::Equal(explored) => match environment {
            Environment::Greedy(_) if explored.transitions == 0 => Answer::Undecided,
            _ => Answer::Holds,
        },
        Verdict::Differ(_) => Answer::Fails,
        Verdict::Undecided(_) => Answer::Undecided,
    }
}

/// The verdict on two trees in an environment, with the shortest trace on which they part.
pub fn text(
    program: &Program,
    (left, right): (&Name, &Name),
    environment: &Environment,
    verdict: &Verdict,
) -> String {
    let (greedy, history) = match environment {
        Environment::Greedy(policy) => (Some(policy), policy.history),
        Environment::Observed(policy) => (None, policy.history),
        Environment::Any(history) | Environment::Possible(history, _) => (None, *history),
    };
    let mut window = window(program, history);
    if matches!(environment, Environment::Possible(..)) {
        window = format!("{POSSIBLE} and {window}");
    }
    match (verdict, greedy) {
        (Verdict::Equal(explored), Some(policy)) if explored.transitions == 0 => format!(
            "undecided: `{left}` and `{right}` take none of {} greedy transitions; they select the same behaviour on \
             the {} where episodes start, and the table does not say what follows",
            policy.transitions.len(),
            words::counted(explored.minterms, "minterm")
        ),
        (Verdict::Equal(explored), Some(policy)) => {
            let open = match explored.open {
                0 => "closed under them".to_owned(),
                n => format!("with {n} places where the table says nothing of what follows"),
            };
            format!(
                "equal: `{left}` and `{right}` select the same behaviour on {} minterms and {} of {} greedy transitions, \
                 {open}",
                explored.minterms,
                explored.transitions,
                policy.transitions.len()
            )
        }
        (Verdict::Equal(explored), None) => format!(
            "equal: `{left}` and `{right}` select the same behaviour in every environment that is consistent with {} ({})",
            window,
            explored.means_text()
        ),
        (Verdict::Differ(trace), Some(_)) => difference(
            program,
            (left, right),
            "along the greedy transitions",
            trace,
        ),
        (Verdict::Differ(trace), None) => {
            let along = format!("in an environment consistent with {window}");
            difference(program, (left, right), &along, trace)
        }
        (Verdict::Undecided(explored), greedy) => {
            let settles = match (greedy, explored.means) {
                (Some(_), _) => "fewer transitions would settle it",
                (None, Means::Solver { .. }) => {
                    "`use` of recorded transitions, or guards of fewer atoms, would settle it"
                }
                (None, _) => {
                    "`use` of recorded transitions, or less memory in the trees, would settle it"
                }
            };
            let explored = match explored.means {
                Means::Solver { atoms } => format!("are one hard question over {atoms} atoms"),
                _ => format!(
                    "agree on the {} states explored, and there are more",
                    explored.states
                ),
            };
            format!("undecided: `{left}` and `{right}` {explored}; {settles}")
        }
    }
}

/// How two trees that are equal go on in the tick in which what they select ends; nothing where that is alike.
pub fn onward(program: &Program, (left, right): (&Name, &Name), onward: &Onward) -> String {
    let parted = match onward {
        Onward::Alike => return String::new(),
        Onward::Undecided => {
            return format!("\n  the proof is of what they select first: {UNEXPLORED}");
        }
        Onward::Differ(parted) => parted,
    };
    let answer = parted.ended.first().map(|(_, answer)| *answer);
    format!(
        "\n  the proof is of what they select first: they go on differently in a tick in which that {}\n{}",
        ends(answer.unwrap_or(Status::Running)),
        parting(program, (left, right), parted)
    )
}

/// What is said where how two trees go on is not known.
pub const UNEXPLORED: &str =
    "whether they go on alike in a tick in which that ends is too much to explore";

/// The ticks to one in which two trees that are equal go on differently, and how they do.
pub fn parting(
    program: &Program,
    (left, right): (impl Display, impl Display),
    Parted { ended, trace }: &Parted,
) -> String {
    let name = name(program);
    let (left, right) = (quoted(&left), quoted(&right));
    let mut lines = steps(program, trace);
    let mut told = String::new();
    for (at, (behavior, answer)) in ended.iter().enumerate() {
        let both = match at {
            0 => "both select",
            _ => " both go on to",
        };
        let if_so = match answer {
            Status::Running => "while it runs".to_owned(),
            answer => format!("if it {}", ends(*answer)),
        };
        told.push_str(&format!("{both} {}; {if_so},", name(&Some(*behavior))));
    }
    lines.push(format!(
        "  tick {:<3} {}: {told} {left} goes on to {} and {right} to {}",
        trace.steps.len() + 1,
        words::minterm(program, &trace.atoms, &trace.valuation),
        name(&trace.left),
        name(&trace.right)
    ));
    lines.join("\n")
}

/// What a behaviour does that answers so.
pub fn ends(answer: Status) -> &'static str {
    match answer {
        Status::Failure => "fails",
        Status::Success => "succeeds",
        Status::Running => "runs",
    }
}

/// What a verdict is consistent with where what cannot hold at once is left out.
pub const POSSIBLE: &str = "what the predicates compare";

/// The history window in words.
fn window(program: &Program, history: History) -> String {
    if program.tasks.is_empty() {
        return format!("a history of {}, since no task sets one", history.window);
    }
    "the history window".to_owned()
}

/// What a side is called, in backquotes where it has none.
fn quoted(side: &impl Display) -> String {
    let side = side.to_string();
    match side.contains('`') {
        true => side,
        false => format!("`{side}`"),
    }
}

/// The ticks in which two sides agree, and the one in which they part.
pub fn difference(
    program: &Program,
    (left, right): (impl Display, impl Display),
    along: &str,
    trace: &Trace,
) -> String {
    let name = name(program);
    let (left, right) = (quoted(&left), quoted(&right));
    let mut lines = vec![format!(
        "different: {left} and {right} part after {} ticks {along}",
        trace.steps.len()
    )];
    lines.extend(steps(program, trace));
    lines.push(format!(
        "  tick {:<3} {}: {left} selects {}, {right} selects {}",
        trace.steps.len() + 1,
        words::minterm(program, &trace.atoms, &trace.valuation),
        name(&trace.left),
        name(&trace.right)
    ));
    lines.join("\n")
}

/// What a side ticks, by name.
fn name(program: &Program) -> impl Fn(&Option<Id<Behavior>>) -> String {
    |behavior| match behavior {
        Some(id) => program.behaviors[*id].name.to_string(),
        None => "nothing".to_owned(),
    }
}

/// The ticks in which two sides agree, a line for those that follow each other and are alike.
fn steps(program: &Program, trace: &Trace) -> Vec<String> {
    let name = name(program);
    let mut lines = Vec::new();
    let mut first = 1;
    for alike in trace.steps.chunk_by(|a, b| a == b) {
        let Some(step) = alike.first() else { continue };
        let last = first + alike.len() - 1;
        let ticks = if first == last {
            format!("tick {first:<3}")
        } else {
            format!("ticks {first} to {last}")
        };
        lines.push(format!(
            "  {ticks} {}: both select {}, which answers {}",
            words::minterm(program, &trace.atoms, &step.valuation),
            name(&step.behavior),
            step.status.name()
        ));
        first = last + 1;
    }
    lines
}
