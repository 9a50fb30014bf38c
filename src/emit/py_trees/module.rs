//! What stands around the tree in its module: imports, the class to derive from, a way to draw it.

use super::code::{Code, WIDTH, quoted, wrapped};
use crate::emit::leaves::{Family, Leaves, Subject};
use crate::emit::notes;
use crate::emit::steps::Steps;
use crate::ir::task::History;
use crate::ir::tree::{Decorator, Tree};
use std::collections::{BTreeMap, BTreeSet};

/// The names that are imported from the modules of py_trees.
#[derive(Clone, Debug, Default)]
pub(super) struct Imports(BTreeMap<&'static str, BTreeSet<&'static str>>);

impl Imports {
    /// Imports a name.
    pub fn take(&mut self, module: &'static str, name: &'static str) {
        self.0.entry(module).or_default().insert(name);
    }

    fn lines(&self) -> String {
        let lines = self.0.iter().map(|(module, names)| {
            let names: Vec<&str> = names.iter().copied().collect();
            let line = format!("from py_trees.{module} import {}", names.join(", "));
            if line.chars().count() <= WIDTH {
                return format!("{line}\n");
            }
            let names: String = names.iter().map(|name| format!("    {name},\n")).collect();
            format!("from py_trees.{module} import (\n{names})\n")
        });
        lines.collect()
    }
}

const CONDITION: &str = r#"class Condition(Behaviour):
    """Succeeds in the ticks in which a predicate holds, fails in the others."""

    def __init__(self, name: str, holds: Callable[[], bool]) -> None:
        super().__init__(name)
        self.holds = holds

    def update(self) -> Status:
        return Status.SUCCESS if self.holds() else Status.FAILURE


"#;

const STEP: &str = r#"class Step(Decorator):
    """Ends one tick after its child has ended like this with a behaviour at work."""

    def __init__(self, name: str, child: Behaviour, on: Status) -> None:
        super().__init__(name, child)
        self.on = on
        self.waits = False

    def update(self) -> Status:
        return self.decorated.status

    def tick(self) -> Iterator[Behaviour]:
        waited = self.status == Status.RUNNING and self.waits
        self.waits = False
        status = self.on
        if not waited:
            drove = False
            for node in self.decorated.tick():
                drove = drove or is_at_work(node)
                yield node
            status = self.decorated.status
            self.waits = drove and status == self.on
        if self.waits:
            status = Status.RUNNING
        elif status != Status.RUNNING:
            self.stop(status)
        self.status = status
        yield self


def is_at_work(node: Behaviour) -> bool:
    """Whether a node is a behaviour of the robot, and not one that only asks or waits."""
    return not node.children and type(node).__name__ not in (
        "Condition",
        "Failure",
        "Success",
        "TickCounter",
    )


"#;

const LIMIT: &str = r#"class Limit(Timeout):
    """Fails once its time is over, without another tick of its child."""

    def tick(self) -> Iterator[Behaviour]:
        if self.status == Status.RUNNING and time.monotonic() > self.finish_time:
            self.stop(Status.FAILURE)
            self.status = Status.FAILURE
            yield self
        else:
            yield from super().tick()


"#;

/// What a module is made of.
pub(super) struct Parts<'a> {
    pub leaves: &'a Leaves,
    pub history: Option<History>,
    pub imports: Imports,
    /// Whether a node has to see if a behaviour was ticked under it.
    pub notes: bool,
    pub steps: Steps,
}

impl Parts<'_> {
    /// The module.
    pub fn module(mut self, tree: &Tree, tick: Option<f64>, root: &Code) -> String {
        let conditions = self.leaves.families.iter().any(|family| !is_action(family));
        let actions = self.leaves.families.iter().any(is_action);
        self.imports.take("behaviour", "Behaviour");
        self.imports.take("display", "unicode_tree");
        if actions {
            self.imports.take("behaviours", "Dummy");
        }
        let limits = notes::has_decorator(&tree.root, &is_timeout);
        let mut out = docstring(tree, tick, self.steps);
        out.push_str("\nimport abc\n");
        if limits {
            out.push_str("import time\n");
        }
        let names = [(conditions, "Callable"), (limits || self.notes, "Iterator")];
        let names = names.iter().filter(|(is, _)| *is).map(|(_, name)| *name);
        let names: Vec<&str> = names.collect();
        if !names.is_empty() {
            out.push_str(&format!(
                "from collections.abc import {}\n",
                names.join(", ")
            ));
        }
        out.push('\n');
        out.push_str(&self.imports.lines());
        out.push_str("\n\nclass Robot(abc.ABC):\n");
        out.push_str(
            "    \"\"\"What the tree asks of the robot, and what it has the robot do.\"\"\"\n\n",
        );
        for family in &self.leaves.families {
            out.push_str(&self.method(family));
        }
        out.push('\n');
        if conditions {
            out.push_str(CONDITION);
        }
        if self.notes {
            out.push_str(STEP);
        }
        if limits {
            out.push_str(LIMIT);
        }
        out.push_str("def create_root(robot: Robot) -> Behaviour:\n");
        out.push_str("    \"\"\"The tree, with a behaviour of its own at each place.\"\"\"\n");
        root.clone().after("return ").write(4, "", &mut out);
        out.push_str("\n\nclass Sketch(Robot):\n");
        out.push_str("    \"\"\"A robot that does nothing, to draw the tree with.\"\"\"\n\n");
        for family in &self.leaves.families {
            out.push_str(&sketched(family));
        }
        out.push_str("\nif __name__ == \"__main__\":\n");
        out.push_str("    print(unicode_tree(create_root(Sketch())))\n");
        out
    }

    /// The abstract method of a family.
    fn method(&self, family: &Family) -> String {
        let name = signature(family);
        let says = match family.subjects.first() {
            Some(Subject::Condition(atom)) => match atom.outcome() {
                Some(outcome) => {
                    let holds = notes::window(outcome, "`behavior`", self.history);
                    format!("Whether {holds}.")
                }
                None => format!("Whether `{name}` holds."),
            },
            _ => format!("A new `{name}`."),
        };
        format!(
            "    @abc.abstractmethod\n{}        \"\"\"{}\"\"\"\n\n",
            head(family),
            in_docstring(&says)
        )
    }
}

fn is_timeout(kind: Decorator) -> bool {
    matches!(kind, Decorator::Timeout(_))
}

fn is_action(family: &Family) -> bool {
    matches!(family.subjects.first(), Some(Subject::Action(_)))
}

/// `def goto(self, target: str) -> Behaviour:`
fn head(family: &Family) -> String {
    let mut parameters = vec![Code::Plain("self".to_owned())];
    // A parameter with a default stands behind those without.
    let mut left_out = false;
    for parameter in &family.parameters {
        left_out |= parameter.optional;
        let ty = if left_out { "str | None = None" } else { "str" };
        parameters.push(Code::Plain(format!("{}: {ty}", parameter.id)));
    }
    let answer = if is_action(family) {
        " -> Behaviour:"
    } else {
        " -> bool:"
    };
    let mut out = String::new();
    Code::call(&format!("def {}", family.id), parameters).write(4, answer, &mut out);
    out
}

/// `goto(target)`, by its name in the language.
fn signature(family: &Family) -> String {
    let name = &family.name;
    let parameters: Vec<&str> = family.parameters.iter().map(|p| p.id.as_str()).collect();
    match parameters.as_slice() {
        [] => name.clone(),
        _ => format!("{name}({})", parameters.join(", ")),
    }
}

/// The method of the robot that does nothing.
fn sketched(family: &Family) -> String {
    let body = if is_action(family) {
        let parameters: Vec<String> = family
            .parameters
            .iter()
            .map(|parameter| format!("{{{}}}", parameter.id))
            .collect();
        if parameters.is_empty() {
            format!("return Dummy({})", quoted(&family.name))
        } else {
            let name = family.name.replace('{', "{{").replace('}', "}}");
            let name = quoted(&format!("{name}({})", parameters.join(", ")));
            format!("return Dummy(f{name})")
        }
    } else {
        "return False".to_owned()
    };
    format!("{}        {body}\n\n", head(family))
}

/// What a reader of the module has to know.
fn docstring(tree: &Tree, tick: Option<f64>, steps: Steps) -> String {
    let name = &tree.name.family;
    let mut paragraphs = vec![format!(
        "The behaviour tree `{name}` for py_trees 2, written by btc."
    )];
    if !tree.docs.is_empty() {
        paragraphs.push(tree.docs.join("\n"));
    }
    let often = tick.map_or_else(
        || "each tick".to_owned(),
        |milliseconds| format!("every {milliseconds} ms"),
    );
    let mut say = |text: &str| paragraphs.push(wrapped(text, WIDTH));
    say(&format!(
        "Derive a class from `Robot` and tick `create_root(robot)` {often}. Run as a program, this module draws the tree."
    ));
    if steps == Steps::SameTick && notes::moves_on(&tree.root) {
        say(
            "A composite with memory goes on to its next child in the tick in which one ends, btc in the next one: here each such step comes one tick earlier.",
        );
    }
    if notes::has_decorator(&tree.root, &is_timeout) {
        say("`Limit` goes by the clock, btc by the ticks in which a timeout is reached.");
    }
    let text = in_docstring(&paragraphs.join("\n\n"));
    format!("\"\"\"{text}\n\"\"\"\n")
}

/// A text between triple quotes.
fn in_docstring(text: &str) -> String {
    let text: String = text
        .chars()
        .map(|c| if c.is_control() && c != '\n' { ' ' } else { c })
        .collect();
    text.replace('\\', "\\\\").replace("\"\"\"", "\\\"\\\"\\\"")
}
