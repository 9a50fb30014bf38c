//! Trees for BehaviorTree.CPP 4, as Groot2 and Nav2 open them.
//!
//! Reactive nodes become `ReactiveFallback` and `ReactiveSequence`, nodes with memory `Fallback` and `Sequence`, which
//! start over when they finish and when they are halted. (`SequenceWithMemory` does not.) A guard is a condition under
//! a reactive node, so that it is asked in every tick; the attributes `_skipIf`, `_failureIf` and their like are asked
//! only where the node is idle.

mod xml;

use super::leaves::{Leaves, Subject, Words};
use super::notes;
use super::refusal::{self, Reason, Refusal, answers_at_once};
use crate::ir::Program;
use crate::ir::task::History;
use crate::ir::tree::{Atom, Composite, Decorator, Node, Tree};
use crate::tree::drawing::{Drawing, Shape};
use xml::{Element, comment};

/// The ids that the library registers itself, through all versions of 4, and the names of its elements.
pub const RESERVED: &[&str] = &[
    "Action",
    "AlwaysFailure",
    "AlwaysSuccess",
    "AsyncFallback",
    "AsyncSequence",
    "BehaviorTree",
    "Condition",
    "Control",
    "Decorator",
    "Delay",
    "Fallback",
    "ForceFailure",
    "ForceSuccess",
    "IfThenElse",
    "Inverter",
    "KeepRunningUntilFailure",
    "LoopBool",
    "LoopDouble",
    "LoopInt",
    "LoopString",
    "ManualSelector",
    "Parallel",
    "ParallelAll",
    "Precondition",
    "ReactiveFallback",
    "ReactiveSequence",
    "Repeat",
    "RetryUntilSuccessful",
    "RunOnce",
    "Script",
    "ScriptCondition",
    "Sequence",
    "SequenceStar",
    "SequenceWithMemory",
    "SetBlackboard",
    "SkipUnlessUpdated",
    "Sleep",
    "SubTree",
    "SubTreePlus",
    "Switch2",
    "Switch3",
    "Switch4",
    "Switch5",
    "Switch6",
    "Timeout",
    "TreeNodesModel",
    "TryCatch",
    "Undefined",
    "UnsetBlackboard",
    "WaitValueUpdate",
    "WasEntryUpdated",
    // Attributes that every node has.
    "ID",
    "name",
    // Elements of a file.
    "include",
    "inout_port",
    "input_port",
    "output_port",
    "root",
];

/// A tree as a file of BehaviorTree.CPP 4.
///
/// # Errors
/// The first node that has no counterpart there.
pub fn tree(program: &Program, tree: &Tree) -> Result<String, Refusal> {
    let tick = notes::tick(program);
    if let Some(refused) = refusal::first(&tree.root, &|node| reason(node, tick)) {
        return Err(refused);
    }
    let mut words = Words::new(RESERVED);
    let leaves = Leaves::of(&tree.root, program, &mut words);
    let id = words.new_id(&tree.name.family);
    let writer = Writer {
        program,
        leaves: &leaves,
        tick: tick.unwrap_or_default(),
    };
    let root = Element::new("BehaviorTree")
        .with("ID", &id)
        .holding(vec![writer.node(&Drawing::of(&tree.root))]);
    let history = tree.task.map(|task| program.tasks[task].history);
    let model = Element::new("TreeNodesModel").holding(model(&leaves, history));
    let file = Element::new("root")
        .with("BTCPP_format", 4)
        .with("main_tree_to_execute", &id)
        .holding(vec![root, model]);
    let mut out = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned();
    comment(&remarks(tree, tick), &mut out);
    file.write(0, &mut out);
    Ok(out)
}

/// Why a node has no counterpart.
fn reason(node: &Node, tick: Option<f64>) -> Option<Reason> {
    match node {
        Node::Parallel { children, .. } => {
            let finished = children.len() > 1 && !children.iter().all(answers_at_once);
            finished.then_some(Reason::Finished)
        }
        Node::Decorator {
            kind: Decorator::Timeout(ticks),
            ..
        } => {
            let fits = tick.is_some_and(|tick| *ticks as f64 * tick <= f64::from(u32::MAX));
            (!fits).then_some(Reason::Time)
        }
        _ => None,
    }
}

/// What a reader of the file has to know.
fn remarks(tree: &Tree, tick: Option<f64>) -> Vec<String> {
    let mut lines = tree.docs.clone();
    if !lines.is_empty() {
        lines.push(String::new());
    }
    lines.push(format!(
        "The behaviour tree {}, written by btc for BehaviorTree.CPP 4.",
        tree.name.family
    ));
    if let Some(tick) = tick {
        lines.push(format!("Tick it every {tick} ms."));
    }
    if notes::moves_on(&tree.root) {
        lines.push(
            "Sequence and Fallback go on to their next child in the tick in which one ends, btc"
                .into(),
        );
        lines.push("in the next one: here each such step comes one tick earlier.".into());
    }
    let counts = |kind| matches!(kind, Decorator::Retry(_) | Decorator::Repeat(_));
    if notes::has_decorator(&tree.root, &counts) {
        lines.push(
            "RetryUntilSuccessful and Repeat may start over in the tick in which their child"
                .into(),
        );
        lines.push("ends, btc does in the next one.".into());
    }
    if notes::has_decorator(&tree.root, &|kind| matches!(kind, Decorator::Timeout(_))) {
        lines.push("Timeout goes by the clock, btc by the ticks in which it is reached.".into());
    }
    lines
}

struct Writer<'a> {
    program: &'a Program,
    leaves: &'a Leaves,
    /// The length of a tick in milliseconds; no `timeout` is written where it is unknown.
    tick: f64,
}

impl Writer<'_> {
    fn node(&self, drawing: &Drawing) -> Element {
        let element = match drawing.shape {
            Shape::Composite(kind, memory) => Element::new(match (kind, memory) {
                (Composite::Selector, false) => "ReactiveFallback",
                (Composite::Sequence, false) => "ReactiveSequence",
                (Composite::Selector, true) => "Fallback",
                (Composite::Sequence, true) => "Sequence",
            }),
            Shape::Parallel(successes) => {
                // It fails when so many have failed that the rest is too few.
                let children = u32::try_from(drawing.children.len()).unwrap_or(u32::MAX);
                Element::new("Parallel")
                    .with("success_count", successes)
                    .with("failure_count", children.saturating_sub(successes) + 1)
            }
            Shape::Decorator(kind) => self.decorator(kind),
            Shape::Behavior(id) => self.leaf(Subject::Action(id)),
            Shape::Literal(atom, true) => self.leaf(Subject::Condition(atom)),
            Shape::Literal(atom, false) => {
                let asked = self.leaf(Subject::Condition(atom));
                return Element::new("Inverter").holding(vec![asked]);
            }
            Shape::Const(true) => Element::new("AlwaysSuccess"),
            Shape::Const(false) => Element::new("AlwaysFailure"),
        };
        element.holding(drawing.children.iter().map(|c| self.node(c)).collect())
    }

    fn decorator(&self, kind: Decorator) -> Element {
        match kind {
            Decorator::Invert => Element::new("Inverter"),
            Decorator::Succeed => Element::new("ForceSuccess"),
            Decorator::Fail => Element::new("ForceFailure"),
            Decorator::Retry(times) => {
                Element::new("RetryUntilSuccessful").with("num_attempts", times)
            }
            Decorator::Repeat(times) => Element::new("Repeat").with("num_cycles", times),
            Decorator::Timeout(ticks) => {
                Element::new("Timeout").with("msec", (ticks as f64 * self.tick).round())
            }
        }
    }

    fn leaf(&self, subject: Subject) -> Element {
        let Some((family, values)) = self.leaves.call(subject) else {
            return Element::new("AlwaysFailure");
        };
        let mut element = Element::new(&family.id);
        if family.id != family.name {
            element = element.with("name", subject.name(self.program).bare());
        }
        for (parameter, value) in values {
            element = element.with(&parameter.id, value);
        }
        element
    }
}

/// What the robot has to register, with its ports.
fn model(leaves: &Leaves, history: Option<History>) -> Vec<Element> {
    let families = leaves.families.iter().map(|family| {
        let first = family.subjects.first();
        let kind = match first {
            Some(Subject::Action(_)) => "Action",
            _ => "Condition",
        };
        let ports = family.parameters.iter().map(|parameter| {
            let port = Element::new("input_port")
                .with("name", &parameter.id)
                .with("type", "std::string");
            match first {
                Some(Subject::Condition(Atom::Done(_))) => {
                    port.saying(notes::window("success", "it", history))
                }
                Some(Subject::Condition(Atom::Failed(_))) => {
                    port.saying(notes::window("failure", "it", history))
                }
                _ => port,
            }
        });
        Element::new(kind)
            .with("ID", &family.id)
            .holding(ports.collect())
    });
    families.collect()
}
