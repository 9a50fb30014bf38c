//! Why a test fails: what was expected, what was done instead, and how the guards of the tree led there.

use crate::diagnostic::{Code, Diagnostic};
use crate::ir::Program;
use crate::ir::test::Test;
use crate::ir::tree::{Atom, Decorator, Guard, Node, Status};
use crate::report::coverage;
use crate::source::Span;
use crate::syntax::ast::{self, Step, TestLineKind};
use crate::trial::test::{Failed, Parts};

/// The failure of a test. The places of the nodes are in pre-order; a tree that stands in no file has none.
pub(super) fn of(
    program: &Program,
    (test, written): (&Test, &ast::Test),
    (root, places): (&Node, &[Span]),
    failed: &Failed,
) -> Diagnostic {
    let (message, label) = said(program, test, failed);
    let steps = match written.lines.get(failed.line).map(|line| &line.kind) {
        Some(TestLineKind::Tick { steps, .. }) => steps.as_slice(),
        _ => &[],
    };
    let step = match failed.parts {
        Parts::Behavior(at) => steps.get(at),
        Parts::More(_) | Parts::Answer => steps.last(),
    };
    let span = step.map_or(written.title.span, Step::span);
    let message = format!(
        "\"{}\" fails in tick {}: {message}",
        test.title, failed.tick
    );
    let mut diagnostic = Diagnostic::new(Code::E0612, span, message).label(label);
    let mut pointed: Vec<Span> = Vec::new();
    for (at, says) in asked(program, root, failed) {
        match places.get(at) {
            // A subtree that stands in a tree twice has one text.
            Some(place) if pointed.contains(place) => {}
            Some(place) => {
                pointed.push(*place);
                diagnostic = diagnostic.also(*place, says);
            }
            None => diagnostic = diagnostic.note(format!("{}: {says}", word(program, root, at))),
        }
    }
    diagnostic.note(held(program, root, failed))
}

/// The message, and what is said at the expectation.
fn said(program: &Program, test: &Test, failed: &Failed) -> (String, String) {
    let tree = &test.tree;
    let expected = test.lines.get(failed.line);
    let expected = expected.and_then(|line| line.expected.as_ref());
    let name = |id| format!("`{}`", program.behaviors[id].name);
    let wanted = |at: usize| {
        let behaviors = expected.map(|expected| expected.behaviors.as_slice());
        let behavior = behaviors.unwrap_or_default().get(at);
        behavior.map_or_else(String::new, |(id, _)| name(*id))
    };
    let done = |at: usize| failed.ticked.get(at).map(|(id, _)| name(*id));
    let answers = format!("`{tree}` {}", answers(failed.answer));
    match failed.parts {
        Parts::Behavior(0) => match done(0) {
            Some(done) => (
                format!("{} is expected, and {done} is selected", wanted(0)),
                format!("{done} is selected"),
            ),
            None => (
                format!("{} is expected, and nothing is selected", wanted(0)),
                format!("nothing is selected: {answers}"),
            ),
        },
        Parts::Behavior(at) => {
            let expects = format!("{} is expected after {}", wanted(at), wanted(at - 1));
            match done(at) {
                Some(done) => (
                    format!("{expects}, and {done} is ticked"),
                    format!("{done} is ticked"),
                ),
                None => (
                    format!("{expects}, and nothing more is ticked"),
                    format!("nothing more is ticked: {answers}"),
                ),
            }
        }
        Parts::More(at) => {
            let done = done(at).unwrap_or_default();
            match at {
                0 => (
                    format!("nothing is expected to be selected, and {done} is"),
                    format!("{done} is selected"),
                ),
                _ => (
                    format!("nothing more is expected, and {done} is ticked"),
                    format!("{done} is ticked, too"),
                ),
            }
        }
        Parts::Answer => {
            let wanted = expected.and_then(|expected| expected.answer);
            let wanted = match wanted {
                Some(Status::Success) => "succeed",
                Some(Status::Failure) => "fail",
                Some(Status::Running) | None => "run",
            };
            let does = match failed.answer {
                Status::Success => "it succeeds",
                Status::Failure => "it fails",
                Status::Running => "it runs",
            };
            (
                format!("`{tree}` is expected to {wanted}, and {does}"),
                does.to_owned(),
            )
        }
    }
}

fn answers(status: Status) -> &'static str {
    match status {
        Status::Success => "succeeds",
        Status::Failure => "fails",
        Status::Running => "runs",
    }
}

/// What each node that decides has said, by its place in pre-order: guards, behaviours, what has memory or counts.
fn asked(program: &Program, root: &Node, failed: &Failed) -> Vec<(usize, String)> {
    let nodes = nodes(root);
    let reached = |at: usize| failed.path.iter().any(|(other, _)| *other == at);
    let mut behaviors = 0;
    let said = failed.path.iter().filter_map(|&(at, status)| {
        let says = match nodes.get(at)? {
            Node::Condition(guard) => {
                let holds = match status {
                    Status::Success => "holds",
                    Status::Failure | Status::Running => "does not hold",
                };
                match literals(program, guard, &failed.held) {
                    Some(literals) => format!("{holds}: {literals}"),
                    None => holds.to_owned(),
                }
            }
            Node::Behavior(_) => {
                behaviors += 1;
                match (behaviors, status) {
                    (1, Status::Running) => "this is selected".to_owned(),
                    (1, _) => format!("this is selected, and {}", answers(status)),
                    _ => format!("this {}", answers(status)),
                }
            }
            Node::Composite { memory: true, .. } if !reached(at + 1) => {
                "goes on where it was".to_owned()
            }
            Node::Decorator {
                kind: Decorator::Timeout(_),
                ..
            } if !reached(at + 1) => "its time is up".to_owned(),
            _ => return None,
        };
        Some((at, says))
    });
    said.collect()
}

/// The nodes of a tree, in pre-order.
fn nodes(root: &Node) -> Vec<&Node> {
    fn walk<'n>(node: &'n Node, found: &mut Vec<&'n Node>) {
        found.push(node);
        node.children().iter().for_each(|child| walk(child, found));
    }
    let mut found = Vec::new();
    walk(root, &mut found);
    found
}

/// What a guard over several atoms has found of them.
fn literals(program: &Program, guard: &Guard, held: &[Atom]) -> Option<String> {
    let mut literals: Vec<String> = Vec::new();
    guard.visit_atoms(&mut |atom| {
        let name = program.atom_name(atom);
        let literal = match held.contains(&atom) {
            true => name.to_string(),
            false => format!("not {name}"),
        };
        if !literals.contains(&literal) {
            literals.push(literal);
        }
    });
    (literals.len() > 1).then(|| literals.join(", "))
}

/// What held in the tick, of all that the tree asks.
fn held(program: &Program, root: &Node, failed: &Failed) -> String {
    let names = failed
        .held
        .iter()
        .map(|atom| program.atom_name(*atom).to_string());
    let names: Vec<String> = names.collect();
    let mut asks = false;
    root.visit_atoms(&mut |_| asks = true);
    match (names.as_slice(), asks) {
        ([], false) => "the tree asks nothing".to_owned(),
        ([], true) => format!("nothing that the tree asks holds in tick {}", failed.tick),
        ([one], _) => format!("{one} holds in tick {}", failed.tick),
        ([first @ .., last], _) => {
            format!(
                "{} and {last} hold in tick {}",
                first.join(", "),
                failed.tick
            )
        }
    }
}

/// What a node is called that stands in no file.
fn word(program: &Program, root: &Node, at: usize) -> String {
    let nodes = nodes(root);
    let node = nodes.get(at).copied().unwrap_or(root);
    coverage::word(program, node)
}
