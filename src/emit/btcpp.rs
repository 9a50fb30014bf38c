//! Trees for BehaviorTree.CPP 4, as Groot2 and Nav2 open them.
//!
//! Reactive nodes become `ReactiveFallback` and `ReactiveSequence`, nodes with memory `Fallback` and `Sequence`, which
//! start over when they finish and when they are halted. (`SequenceWithMemory` does not.) A guard is a condition under
//! a reactive node, so that it is asked in every tick; the attributes `_skipIf`, `_failureIf` and their like are asked
//! only where the node is idle.

use super::leaves::{Leaves, Subject, Words};
use super::notes;
use super::refusal::{self, Reason, Refusal, answers_at_once};
use super::xml::Xml;
use crate::ir::Program;
use crate::ir::task::History;
use crate::ir::tree::{Composite, Decorator, Node, Tree};
use crate::spelling::spelled;
use crate::tree::drawing::{Drawing, Shape};

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
    let leaves = Leaves::of(tree, program, &mut words);
    let id = words.new_id(&tree.name.family);
    let writer = Writer {
        program,
        leaves: &leaves,
        tick: tick.unwrap_or_default(),
    };
    let mut xml = Xml::default();
    xml.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    xml.comment(&remarks(tree, tick));
    let format = ("BTCPP_format", "4".to_owned());
    xml.open("root", &[format, ("main_tree_to_execute", id.clone())]);
    xml.open("BehaviorTree", &[("ID", id)]);
    writer.node(&Drawing::of(&tree.root), &mut xml);
    xml.close();
    model(
        &leaves,
        tree.task.map(|task| program.tasks[task].history),
        &mut xml,
    );
    Ok(xml.finish())
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

/// A tag with its attributes.
type Tag = (&'static str, Vec<(&'static str, String)>);

impl Writer<'_> {
    fn node(&self, drawing: &Drawing, xml: &mut Xml) {
        let (tag, attributes): Tag = match drawing.shape {
            Shape::Composite(Composite::Selector, false) => ("ReactiveFallback", Vec::new()),
            Shape::Composite(Composite::Sequence, false) => ("ReactiveSequence", Vec::new()),
            Shape::Composite(Composite::Selector, true) => ("Fallback", Vec::new()),
            Shape::Composite(Composite::Sequence, true) => ("Sequence", Vec::new()),
            Shape::Parallel(successes) => {
                // It fails when the children that have not failed are too few.
                let children = u32::try_from(drawing.children.len()).unwrap_or(u32::MAX);
                let failures = children.saturating_sub(successes) + 1;
                let counts = [("success_count", successes), ("failure_count", failures)];
                let counts = counts.map(|(name, count)| (name, count.to_string()));
                ("Parallel", counts.into())
            }
            Shape::Decorator(kind) => self.decorator(kind),
            Shape::Behavior(id) => return self.leaf(Subject::Action(id), xml),
            Shape::Literal(atom, true) => return self.leaf(Subject::Condition(atom), xml),
            Shape::Literal(atom, false) => {
                xml.open("Inverter", &[]);
                self.leaf(Subject::Condition(atom), xml);
                return xml.close();
            }
            Shape::Const(true) => return xml.leaf("AlwaysSuccess", &[]),
            Shape::Const(false) => return xml.leaf("AlwaysFailure", &[]),
        };
        xml.open(tag, &attributes);
        for child in &drawing.children {
            self.node(child, xml);
        }
        xml.close();
    }

    fn decorator(&self, kind: Decorator) -> Tag {
        let counted = |tag, count, n: String| (tag, vec![(count, n)]);
        match kind {
            Decorator::Invert => ("Inverter", Vec::new()),
            Decorator::Succeed => ("ForceSuccess", Vec::new()),
            Decorator::Fail => ("ForceFailure", Vec::new()),
            Decorator::Retry(n) => counted("RetryUntilSuccessful", "num_attempts", n.to_string()),
            Decorator::Repeat(n) => counted("Repeat", "num_cycles", n.to_string()),
            Decorator::Timeout(ticks) => {
                let time = (ticks as f64 * self.tick).round();
                counted("Timeout", "msec", time.to_string())
            }
        }
    }

    fn leaf(&self, subject: Subject, xml: &mut Xml) {
        let Some((family, values)) = self.leaves.call(subject) else {
            return xml.leaf("AlwaysFailure", &[]);
        };
        let mut attributes = Vec::new();
        if family.id != spelled(&family.name) {
            attributes.push(("name", subject.name(self.program).bare()));
        }
        let values = values.into_iter();
        attributes
            .extend(values.map(|(parameter, value)| (parameter.id.as_str(), value.to_owned())));
        xml.leaf(&family.id, &attributes);
    }
}

/// What the robot has to register, with its ports.
fn model(leaves: &Leaves, history: Option<History>, xml: &mut Xml) {
    if leaves.families.is_empty() {
        return xml.leaf("TreeNodesModel", &[]);
    }
    xml.open("TreeNodesModel", &[]);
    for family in &leaves.families {
        let first = family.subjects.first();
        let kind = match first {
            Some(Subject::Action(_)) => "Action",
            _ => "Condition",
        };
        let id = [("ID", family.id.clone())];
        if family.parameters.is_empty() {
            xml.leaf(kind, &id);
            continue;
        }
        xml.open(kind, &id);
        for parameter in &family.parameters {
            let port = [
                ("name", parameter.id.clone()),
                ("type", "std::string".to_owned()),
            ];
            let outcome = match first {
                Some(Subject::Condition(atom)) => atom.outcome(),
                _ => None,
            };
            match outcome {
                Some(outcome) => {
                    xml.text("input_port", &port, &notes::window(outcome, "it", history));
                }
                None => xml.leaf("input_port", &port),
            }
        }
        xml.close();
    }
    xml.close();
}
