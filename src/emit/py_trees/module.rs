//! What stands around the tree in its module: imports, the class to derive from, a way to draw it.

use super::code::{Code, WIDTH, quoted, wrapped};
use crate::emit::leaves::{Family, Leaves};
use crate::emit::notes;
use crate::emit::steps::Steps;
use crate::ir::task::History;
use crate::ir::tree::{Decorator, Status, Tree};
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

// The classes that a module has where its tree needs them.
const CONDITION: &str = include_str!("condition.py");
const STEP: &str = include_str!("step.py");
const LIMIT: &str = include_str!("limit.py");
const HISTORY: &str = include_str!("history.py");

/// What a module is made of.
pub(super) struct Parts<'a> {
    pub leaves: &'a Leaves,
    /// What the history window holds, as far as it is known.
    pub history: Option<History>,
    pub imports: Imports,
    /// Whether a node has to see if a behaviour was ticked under it.
    pub notes: bool,
    pub steps: Steps,
}

impl Parts<'_> {
    /// The module.
    pub fn module(mut self, tree: &Tree, tick: Option<f64>, root: &Code) -> String {
        let families = &self.leaves.families;
        let conditions = families.iter().any(|family| !family.is_action());
        let remembers = self.leaves.ask_history;
        self.imports.take("behaviour", "Behaviour");
        self.imports.take("display", "unicode_tree");
        if self.leaves.actions().next().is_some() {
            self.imports.take("behaviours", "Dummy");
        }
        if remembers {
            self.imports.take("common", "Status");
            self.imports.take("decorators", "Decorator");
        }
        let limits = notes::has_decorator(&tree.root, &is_timeout);
        let mut out = docstring(tree, tick, self.steps);
        out.push_str("\nimport abc\n");
        if limits {
            out.push_str("import time\n");
        }
        if remembers {
            out.push_str("from collections import deque\n");
        }
        let names = [
            (conditions, "Callable"),
            (remembers, "Container"),
            (limits || remembers || self.notes, "Iterator"),
        ];
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
        let asked = || families.iter().filter(|family| !family.is_history());
        asked().for_each(|family| out.push_str(&method(family)));
        out.push('\n');
        let history = self.history();
        let classes = [
            (conditions, CONDITION),
            (remembers, history.as_str()),
            (self.notes, STEP),
            (limits, LIMIT),
        ];
        for (_, class) in classes.iter().filter(|(is, _)| *is) {
            out.push_str(class);
            out.push_str("\n\n");
        }
        out.push_str(match (remembers, self.history) {
            (false, _) => "def create_root(robot: Robot) -> Behaviour:\n",
            (true, Some(_)) => {
                "def create_root(robot: Robot, history: History | None = None) -> Behaviour:\n"
            }
            (true, None) => "def create_root(robot: Robot, history: History) -> Behaviour:\n",
        });
        out.push_str("    \"\"\"The tree, with a behaviour of its own at each place.\"\"\"\n");
        if remembers && self.history.is_some() {
            out.push_str("    history = history or History()\n");
        }
        root.clone().after("return ").write(4, "", &mut out);
        out.push_str("\n\nclass Sketch(Robot):\n");
        out.push_str("    \"\"\"A robot that does nothing, to draw the tree with.\"\"\"\n\n");
        asked().for_each(|family| out.push_str(&sketched(family)));
        let none = match asked().next() {
            Some(_) => "",
            None => "    pass\n\n",
        };
        out.push_str(none);
        out.push_str("\nif __name__ == \"__main__\":\n");
        out.push_str(match (remembers, self.history) {
            (true, None) => "    print(unicode_tree(create_root(Sketch(), History(1, ()))))\n",
            _ => "    print(unicode_tree(create_root(Sketch())))\n",
        });
        out
    }

    /// The class that keeps the history; what is not known of the window has to be given.
    fn history(&self) -> String {
        let mut parameters = vec!["self".to_owned()];
        match self.history {
            Some(history) => {
                let kinds = notes::kinds(history).map(|status| match status {
                    Status::Success => "Status.SUCCESS, ",
                    _ => "Status.FAILURE, ",
                });
                let kinds: String = kinds.collect();
                let kinds = match kinds.matches(", ").count() {
                    1 => kinds.trim_end(),
                    _ => kinds.trim_end_matches(", "),
                };
                parameters.push(format!("last: int = {}", history.window));
                parameters.push(format!("of: Container[Status] = ({kinds})"));
            }
            None => parameters.extend(["last: int", "of: Container[Status]"].map(str::to_owned)),
        }
        let parameters = parameters.into_iter().map(Code::Plain).collect();
        let mut head = String::new();
        Code::call("def __init__", parameters).write(4, " -> None:", &mut head);
        let doc = format!("Keeps the last {}.", notes::held(self.history));
        HISTORY
            .replace("{doc}", &doc)
            .replace("    def __init__({parameters}) -> None:\n", &head)
    }
}

/// The abstract method of a family.
fn method(family: &Family) -> String {
    let name = signature(family);
    let says = match family.is_action() {
        true => format!("A new `{name}`."),
        false => format!("Whether `{name}` holds."),
    };
    format!(
        "    @abc.abstractmethod\n{}        \"\"\"{}\"\"\"\n\n",
        head(family),
        in_docstring(&says)
    )
}

fn is_timeout(kind: Decorator) -> bool {
    matches!(kind, Decorator::Timeout(_))
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
    let answer = if family.is_action() {
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
    let body = if family.is_action() {
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
