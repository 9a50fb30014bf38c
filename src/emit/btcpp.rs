//! Trees for BehaviorTree.CPP 4, as Groot2 and Nav2 open them.
//!
//! Reactive nodes become `ReactiveFallback` and `ReactiveSequence`, nodes with memory `Fallback` and `Sequence`, which
//! start over when they finish and when they are halted. (`SequenceWithMemory` does not.) A guard is a condition under
//! a reactive node, so that it is asked in every tick; the attributes `_skipIf`, `_failureIf` and their like are asked
//! only where the node is idle.
//!
//! Both nodes with memory begin their next child in the tick in which one ends, btc in the next one. Between them stands
//! an `AsyncSequence` of two nodes that succeed at once: it runs for one tick.

use super::calls;
use super::leaves::{self, Leaves, Subject, Words};
use super::notes;
use super::refusal::{self, Reason, Refusal, answers_at_once};
use super::steps::{self, Drives, Steps};
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
    "Root",
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
    "WhileDoElse",
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
pub fn tree(program: &Program, tree: &Tree, steps: Steps) -> Result<String, Refusal> {
    let tick = notes::tick(program);
    if let Some(refused) = refusal::first(&tree.root, &|node| reason(node, tick)) {
        return Err(refused);
    }
    let program = &*calls::called(program);
    let mut words = Words::new(RESERVED);
    let leaves = Leaves::of(tree, program, &mut words);
    let id = words.new_id(&tree.name.family);
    let mut writer = Writer {
        program,
        leaves: &leaves,
        tick: tick.unwrap_or_default(),
        steps,
        keys: 0,
        marks: Vec::new(),
    };
    let mut xml = Xml::default();
    xml.line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    xml.comment(&remarks(tree, tick, steps, leaves.ask_history));
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
        } => match tick {
            None => Some(Reason::Ticks),
            Some(tick) => (*ticks as f64 * tick > f64::from(u32::MAX)).then_some(Reason::Time),
        },
        _ => None,
    }
}

/// What a reader of the file has to know.
fn remarks(tree: &Tree, tick: Option<f64>, steps: Steps, asks_history: bool) -> Vec<String> {
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
    let moves_on = notes::moves_on(&tree.root);
    let counts = |kind| matches!(kind, Decorator::Retry(_) | Decorator::Repeat(_));
    let counts = notes::has_decorator(&tree.root, &counts);
    if steps == Steps::Exact && (moves_on || counts) {
        lines.push("An AsyncSequence stands for the next tick: call tickExactlyOnce().".into());
    }
    if steps == Steps::SameTick && moves_on {
        lines.push(
            "Sequence and Fallback go on to their next child in the tick in which one ends, btc"
                .into(),
        );
        lines.push("in the next one: here each such step comes one tick earlier.".into());
    }
    if steps == Steps::SameTick && counts {
        lines.push(
            "RetryUntilSuccessful and Repeat may start over in the tick in which their child"
                .into(),
        );
        lines.push("ends, btc does in the next one.".into());
    }
    if asks_history {
        lines.push(
            "The form btcpp_history of this tree is a header that answers done and failed.".into(),
        );
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
    steps: Steps,
    /// The entries of the blackboard that are in use.
    keys: usize,
    /// Those in which the behaviours at hand note that they have ended.
    marks: Vec<String>,
}

/// A tag with its attributes.
type Tag = (&'static str, Vec<(&'static str, String)>);

impl Writer<'_> {
    fn node(&mut self, drawing: &Drawing, xml: &mut Xml) {
        if self.steps == Steps::Exact {
            match drawing.shape {
                Shape::Composite(kind, true) => return self.step_by_step(kind, drawing, xml),
                Shape::Decorator(Decorator::Retry(times)) if times > 1 => {
                    return self.retry(times, drawing, xml);
                }
                Shape::Decorator(Decorator::Repeat(times)) if times > 1 => {
                    return self.repeat(times, drawing, xml);
                }
                _ => {}
            }
        }
        let (tag, attributes): Tag = match drawing.shape {
            Shape::Composite(Composite::Selector, false) => ("ReactiveFallback", Vec::new()),
            Shape::Composite(Composite::Sequence, false) => ("ReactiveSequence", Vec::new()),
            Shape::Composite(kind, true) => (resuming(kind), Vec::new()),
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

    /// A node with memory, which waits for the next tick behind each child that has driven.
    fn step_by_step(&mut self, kind: Composite, drawing: &Drawing, xml: &mut Xml) {
        xml.open(resuming(kind), &[]);
        let last = drawing.children.len().saturating_sub(1);
        for (at, child) in drawing.children.iter().enumerate() {
            match steps::drives(child, kind) {
                Drives::Sometimes if at < last => self.noted(kind, child, xml),
                Drives::Always if at < last => {
                    self.node(child, xml);
                    as_going_on(kind, xml, next_tick);
                }
                _ => self.node(child, xml),
            }
        }
        xml.close();
    }

    /// A child that may have driven or only asked: its behaviours note that they have ended, and what stands behind it
    /// waits if one has.
    fn noted(&mut self, kind: Composite, child: &Drawing, xml: &mut Xml) {
        let key = self.key("drove");
        xml.open("ReactiveSequence", &[]);
        script(&format!("{key} := 0"), xml);
        self.marks.push(key.clone());
        self.node(child, xml);
        self.marks.pop();
        xml.close();
        as_going_on(kind, xml, |xml| {
            xml.open("Fallback", &[]);
            asked(&format!("{key} == 0"), xml);
            next_tick(xml);
            xml.close();
        });
    }

    /// `retry`, which waits for the next tick behind each failure but the last.
    fn retry(&mut self, times: u32, drawing: &Drawing, xml: &mut Xml) {
        let key = self.key("failures");
        xml.open("Sequence", &[]);
        script(&format!("{key} := 0"), xml);
        xml.open(
            "RetryUntilSuccessful",
            &[("num_attempts", times.to_string())],
        );
        xml.open("Fallback", &[]);
        drawing
            .children
            .iter()
            .for_each(|child| self.node(child, xml));
        xml.open("Sequence", &[]);
        script(&format!("{key} += 1"), xml);
        asked(&format!("{key} < {times}"), xml);
        next_tick(xml);
        xml.leaf("AlwaysFailure", &[]);
        (0..4).for_each(|_| xml.close());
    }

    /// `repeat`, which waits for the next tick behind each success but the last.
    fn repeat(&mut self, times: u32, drawing: &Drawing, xml: &mut Xml) {
        let key = self.key("successes");
        xml.open("Sequence", &[]);
        script(&format!("{key} := 0"), xml);
        xml.open("Repeat", &[("num_cycles", times.to_string())]);
        xml.open("Sequence", &[]);
        drawing
            .children
            .iter()
            .for_each(|child| self.node(child, xml));
        script(&format!("{key} += 1"), xml);
        xml.open("Fallback", &[]);
        asked(&format!("{key} == {times}"), xml);
        next_tick(xml);
        (0..4).for_each(|_| xml.close());
    }

    /// An entry of the blackboard that nothing else uses.
    fn key(&mut self, what: &str) -> String {
        self.keys += 1;
        format!("btc_{what}_{}", self.keys)
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
                // It has to have fired when the next tick comes.
                let time = ((ticks as f64 - 0.5) * self.tick).round().max(1.0);
                counted("Timeout", "msec", time.to_string())
            }
        }
    }

    fn leaf(&self, subject: Subject, xml: &mut Xml) {
        let Some((family, values)) = self.leaves.call(subject) else {
            return xml.leaf("AlwaysFailure", &[]);
        };
        let mut attributes = Vec::new();
        if let (Subject::Action(id), true) = (subject, self.leaves.ask_history) {
            let name = leaves::known_as(&self.program.behaviors[id].name);
            attributes.push(("name", name));
        } else if family.id != spelled(&family.name) {
            attributes.push(("name", subject.name(self.program).bare()));
        }
        let values = values.into_iter();
        attributes
            .extend(values.map(|(parameter, value)| (parameter.id.as_str(), value.to_owned())));
        if matches!(subject, Subject::Action(_)) && !self.marks.is_empty() {
            let marks: Vec<String> = self.marks.iter().map(|key| format!("{key} := 1")).collect();
            let marks = marks.join("; ");
            attributes.push(("_onSuccess", marks.clone()));
            attributes.push(("_onFailure", marks));
        }
        xml.leaf(&family.id, &attributes);
    }
}

/// The library's node with memory.
fn resuming(kind: Composite) -> &'static str {
    match kind {
        Composite::Selector => "Fallback",
        Composite::Sequence => "Sequence",
    }
}

/// A node that succeeds, as one on which a composite goes on.
fn as_going_on(kind: Composite, xml: &mut Xml, node: impl Fn(&mut Xml)) {
    let inverts = kind == Composite::Selector;
    if inverts {
        xml.open("Inverter", &[]);
    }
    node(xml);
    if inverts {
        xml.close();
    }
}

/// What runs for one tick, and succeeds in the next.
fn next_tick(xml: &mut Xml) {
    xml.open("AsyncSequence", &[("name", "next tick".to_owned())]);
    xml.leaf("AlwaysSuccess", &[]);
    xml.leaf("AlwaysSuccess", &[]);
    xml.close();
}

fn script(code: &str, xml: &mut Xml) {
    xml.leaf("Script", &[("code", code.to_owned())]);
}

fn asked(code: &str, xml: &mut Xml) {
    xml.leaf("ScriptCondition", &[("code", code.to_owned())]);
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
