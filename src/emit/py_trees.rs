//! Trees for py_trees 2: a Python module.
//!
//! It has an abstract class `Robot`, a method for each condition and each behaviour, and `create_root(robot)`, which
//! builds the tree. Where the tree asks the history, the module keeps it. Run as a program it draws the tree.

mod code;
mod module;

use super::calls;
use super::leaves::{self, Leaves, Subject, Words};
use super::notes;
use super::refusal::{self, Reason, Refusal};
use super::steps::{self, Drives, Steps};
use crate::ir::law::Behavior;
use crate::ir::tree::{Composite, Decorator, Node, Tree};
use crate::ir::{Id, Program};
use crate::tree::drawing::{Drawing, Shape};
use code::{Code, string};
use module::Imports;

/// Python's keywords, and the names that the module reads where the methods' own names and parameters are in scope.
pub const RESERVED: &[&str] = &[
    "Behaviour",
    "Dummy",
    "False",
    "None",
    "True",
    "abc",
    "and",
    "as",
    "assert",
    "async",
    "await",
    "bool",
    "break",
    "class",
    "continue",
    "def",
    "del",
    "elif",
    "else",
    "except",
    "finally",
    "for",
    "from",
    "global",
    "if",
    "import",
    "in",
    "is",
    "lambda",
    "nonlocal",
    "not",
    "or",
    "pass",
    "raise",
    "return",
    "self",
    "str",
    "try",
    "while",
    "with",
    "yield",
];

/// A tree as a module for py_trees 2.
///
/// # Errors
/// The first node that has no counterpart there.
pub fn tree(program: &Program, tree: &Tree, steps: Steps) -> Result<String, Refusal> {
    let tick = notes::tick(program);
    if let Some(refused) = refusal::first(&tree.root, &|node| reason(node, tick)) {
        return Err(refused);
    }
    let program = &*calls::called(program);
    let leaves = Leaves::of(tree, program, &mut Words::new(RESERVED));
    let mut writer = Writer {
        program,
        leaves: &leaves,
        tick: tick.unwrap_or_default(),
        imports: Imports::default(),
        steps,
        notes: false,
    };
    let mut root = writer.node(&Drawing::of(&tree.root), Some(&tree.name.family));
    if leaves.ask_history {
        root = remembering("Remembering", "history", root);
    }
    let history = tree.task.map(|task| program.tasks[task].history);
    let parts = module::Parts {
        leaves: &leaves,
        history,
        notes: writer.notes,
        imports: writer.imports,
        steps,
    };
    Ok(parts.module(tree, tick, &root))
}

/// Why a node has no counterpart.
fn reason(node: &Node, tick: Option<f64>) -> Option<Reason> {
    match node {
        Node::Parallel {
            successes,
            children,
        } => (u32::try_from(children.len()) != Ok(*successes)).then_some(Reason::Partial),
        Node::Decorator {
            kind: Decorator::Timeout(_),
            ..
        } => tick.is_none().then_some(Reason::Ticks),
        _ => None,
    }
}

struct Writer<'a> {
    program: &'a Program,
    leaves: &'a Leaves,
    /// The length of a tick in milliseconds; no `timeout` is written where it is unknown.
    tick: f64,
    imports: Imports,
    steps: Steps,
    /// Whether a node has to see if a behaviour was ticked under it.
    notes: bool,
}

impl Writer<'_> {
    /// A node; inner ones are called by what they ask, or by their word of the language, unless they have a name.
    fn node(&mut self, drawing: &Drawing, name: Option<&str>) -> Code {
        match drawing.shape {
            Shape::Composite(kind, memory) => {
                let word = self.asked(drawing);
                let word = word.unwrap_or_else(|| kind.word(memory).to_owned());
                let class = match kind {
                    Composite::Selector => "Selector",
                    Composite::Sequence => "Sequence",
                };
                self.imports.take("composites", class);
                let steps = memory && self.steps == Steps::Exact;
                let children = match steps {
                    true => self.step_by_step(kind, drawing),
                    false => self.children(drawing),
                };
                let memory = if memory {
                    "memory=True"
                } else {
                    "memory=False"
                };
                let arguments = vec![
                    string(name.unwrap_or(&word)),
                    Code::Plain(memory.to_owned()),
                    children,
                ];
                Code::call(class, arguments)
            }
            Shape::Parallel(successes) => {
                self.imports.take("common", "ParallelPolicy");
                self.imports.take("composites", "Parallel");
                let policy = "policy=ParallelPolicy.SuccessOnAll(synchronise=False)";
                let word = format!("parallel({successes})");
                let arguments = vec![
                    string(name.unwrap_or(&word)),
                    Code::Plain(policy.to_owned()),
                    self.children(drawing),
                ];
                Code::call("Parallel", arguments)
            }
            Shape::Decorator(kind) => {
                let child = drawing.children.first().map(|child| self.node(child, None));
                self.decorator(kind, name, child)
            }
            Shape::Behavior(id) => self.action(id),
            Shape::Literal(atom, true) => self.condition(Subject::Condition(atom)),
            Shape::Literal(atom, false) => {
                let subject = Subject::Condition(atom);
                let asked = self.condition(subject);
                let name = format!("not {}", subject.name(self.program).bare());
                self.imports.take("decorators", "Inverter");
                Code::call("Inverter", vec![string(&name), asked])
            }
            Shape::Const(value) => {
                let (class, name) = if value {
                    ("Success", "true")
                } else {
                    ("Failure", "false")
                };
                self.imports.take("behaviours", class);
                Code::call(class, vec![string(name)])
            }
        }
    }

    fn children(&mut self, drawing: &Drawing) -> Code {
        let children = drawing.children.iter().map(|child| self.node(child, None));
        Code::list("children", children.collect())
    }

    /// The children of a node with memory; behind each that has driven, it waits for the next tick.
    fn step_by_step(&mut self, kind: Composite, drawing: &Drawing) -> Code {
        let last = drawing.children.len().saturating_sub(1);
        let goes_on = match kind {
            Composite::Selector => "Status.FAILURE",
            Composite::Sequence => "Status.SUCCESS",
        };
        let mut children = Vec::new();
        for (at, child) in drawing.children.iter().enumerate() {
            let code = self.node(child, None);
            match steps::drives(child, kind) {
                Drives::Sometimes if at < last => {
                    self.notes = true;
                    self.imports.take("common", "Status");
                    self.imports.take("decorators", "Decorator");
                    let on = Code::Plain(goes_on.to_owned());
                    children.push(Code::call("Step", vec![string("step"), code, on]));
                }
                Drives::Always if at < last => {
                    self.imports.take("common", "Status");
                    self.imports.take("behaviours", "TickCounter");
                    let rest = format!("duration=1, completion_status={goes_on}");
                    let waits = vec![string("next tick"), Code::Plain(rest)];
                    children.extend([code, Code::call("TickCounter", waits)]);
                }
                _ => children.push(code),
            }
        }
        Code::list("children", children)
    }

    fn decorator(&mut self, kind: Decorator, name: Option<&str>, child: Option<Code>) -> Code {
        let word = kind.word();
        let (class, words, setting) = match kind {
            Decorator::Invert => ("Inverter", word.to_owned(), None),
            Decorator::Succeed => ("FailureIsSuccess", word.to_owned(), None),
            Decorator::Fail => ("SuccessIsFailure", word.to_owned(), None),
            // The first attempt is none of the retries.
            Decorator::Retry(times) => {
                let failures = format!("num_failures={times}");
                ("Retry", format!("{word}({times})"), Some(failures))
            }
            Decorator::Repeat(times) => {
                let successes = format!("num_success={times}");
                ("Repeat", format!("{word}({times})"), Some(successes))
            }
            Decorator::Timeout(ticks) => {
                self.imports.take("common", "Status");
                // It has to be over when the next tick comes.
                let seconds = (ticks as f64 - 0.5) * self.tick / 1e3;
                let duration = format!("duration={seconds:?}");
                ("Limit", format!("{word}({ticks} ticks)"), Some(duration))
            }
        };
        self.imports.take(
            "decorators",
            if class == "Limit" { "Timeout" } else { class },
        );
        let mut arguments = vec![string(name.unwrap_or(&words))];
        arguments.extend(child);
        arguments.extend(setting.map(Code::Plain));
        Code::call(class, arguments)
    }

    /// What a group is called that asks something, alone or before it does something else: `a or not b`, `a =>`.
    fn asked(&self, drawing: &Drawing) -> Option<String> {
        if let Some(question) = self.question(drawing) {
            return Some(question);
        }
        if drawing.shape != Shape::Composite(Composite::Sequence, false) {
            return None;
        }
        let asked = drawing.children.iter().map_while(|child| self.part(child));
        let asked: Vec<String> = asked.collect();
        (!asked.is_empty()).then(|| format!("{} =>", asked.join(" and ")))
    }

    /// A group that only asks, as the language writes it.
    fn question(&self, drawing: &Drawing) -> Option<String> {
        let word = match drawing.shape {
            Shape::Composite(Composite::Selector, false) => " or ",
            Shape::Composite(Composite::Sequence, false) => " and ",
            _ => return None,
        };
        let parts = drawing.children.iter().map(|child| self.part(child));
        let parts: Vec<String> = parts.collect::<Option<_>>()?;
        Some(parts.join(word))
    }

    /// A part of a group that only asks.
    fn part(&self, drawing: &Drawing) -> Option<String> {
        let name = |atom| Subject::Condition(atom).name(self.program).bare();
        match drawing.shape {
            Shape::Literal(atom, true) => Some(name(atom)),
            Shape::Literal(atom, false) => Some(format!("not {}", name(atom))),
            Shape::Const(value) => Some(value.to_string()),
            _ => Some(format!("({})", self.question(drawing)?)),
        }
    }

    /// `robot.goto("A")`
    fn action(&self, id: Id<Behavior>) -> Code {
        let Some((method, arguments)) = self.method(Subject::Action(id)) else {
            return Code::Plain("None".to_owned());
        };
        let acts = Code::call(&format!("robot.{method}"), arguments);
        match self.leaves.ask_history {
            true => {
                let name = leaves::known_as(&self.program.behaviors[id].name);
                remembering("Noted", &name, acts)
            }
            false => acts,
        }
    }

    /// `Condition("low", robot.low)`, `Condition("vis(A)", lambda: robot.vis("A"))`
    fn condition(&mut self, subject: Subject) -> Code {
        self.imports.take("common", "Status");
        let name = string(&subject.name(self.program).bare());
        let whose = match subject.asks_history() {
            true => "history",
            false => "robot",
        };
        let asked = match self.method(subject) {
            Some((method, arguments)) if arguments.is_empty() => {
                Code::Plain(format!("{whose}.{method}"))
            }
            Some((method, arguments)) => {
                Code::call(&format!("{whose}.{method}"), arguments).after("lambda: ")
            }
            None => Code::Plain("None".to_owned()),
        };
        Code::call("Condition", vec![name, asked])
    }

    /// The method that a leaf calls, and its arguments: by position as long as none is left out, then by name.
    fn method(&self, subject: Subject) -> Option<(String, Vec<Code>)> {
        let (family, values) = self.leaves.call(subject)?;
        let arguments = values.iter().enumerate().map(|(at, (parameter, value))| {
            let declared = family.parameters.get(at);
            if declared.is_some_and(|declared| declared.id == parameter.id) {
                string(value)
            } else {
                string(value).after(&format!("{}=", parameter.id))
            }
        });
        Some((family.id.clone(), arguments.collect()))
    }
}

/// `Noted("goto(A)", robot.goto("A"), history)`
fn remembering(class: &str, name: &str, child: Code) -> Code {
    Code::call(
        class,
        vec![string(name), child, Code::Plain("history".to_owned())],
    )
}
