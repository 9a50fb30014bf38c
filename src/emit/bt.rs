//! Trees as text of the language; laid out by the formatter, so that what is printed parses back.

use crate::ir::Program;
use crate::ir::tree::{Composite, Decorator, Guard, Node, Tree};
use crate::source::FileId;
use crate::syntax;

/// A tree as an item of the language, with its documentation.
pub fn tree(program: &Program, tree: &Tree) -> String {
    let mut text = String::new();
    for line in &tree.docs {
        text.push_str(&format!("/// {line}\n"));
    }
    text.push_str(&format!("tree {}", tree.name));
    if let Some(task) = tree.task {
        text.push_str(&format!(" for {}", program.tasks[task].name));
    }
    text.push_str(" = ");
    node(program, &tree.root, &mut text);
    text.push('\n');
    laid_out(text)
}

/// A program of declared names and its trees as a file, with a `//!` line each of `docs`.
pub fn declared(program: &Program, docs: &[String]) -> String {
    let mut text = String::new();
    for line in docs {
        text.push_str(&format!("//! {line}\n"));
    }
    for predicate in program.predicates.values() {
        text.push_str(&format!("\npredicate {}", predicate.name));
    }
    text.push('\n');
    for behavior in program.behaviors.values() {
        text.push_str(&format!("\nbehavior {}", behavior.name));
    }
    text.push('\n');
    for tree in program.trees.values() {
        text.push('\n');
        text.push_str(&self::tree(program, tree));
    }
    laid_out(text)
}

/// A guard on one line.
pub fn guard(program: &Program, guard: &Guard) -> String {
    let mut text = String::new();
    formula(program, guard, 0, &mut text);
    text
}

/// The text as the formatter lays it out.
fn laid_out(text: String) -> String {
    let (file, mistakes) = syntax::parse(FileId::default(), &text);
    if mistakes.is_empty() {
        syntax::print::file(&file, Some(&text))
    } else {
        text
    }
}

fn node(program: &Program, at: &Node, text: &mut String) {
    match at {
        Node::Condition(guard) => formula(program, guard, 0, text),
        Node::Behavior(id) => text.push_str(&program.behaviors[*id].name.to_string()),
        Node::Composite {
            kind: Composite::Sequence,
            memory: false,
            children,
        } if is_unit(children) => {
            for (i, child) in children.iter().enumerate() {
                if i > 0 {
                    text.push_str(" => ");
                }
                node(program, child, text);
            }
        }
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            if *memory {
                text.push_str("memory ");
            }
            text.push_str(match kind {
                Composite::Selector => "selector",
                Composite::Sequence => "sequence",
            });
            list(program, children, text);
        }
        Node::Parallel {
            successes,
            children,
        } => {
            text.push_str(&format!("parallel({successes})"));
            list(program, children, text);
        }
        Node::Decorator { kind, child } => {
            match kind {
                Decorator::Invert => text.push_str("invert"),
                Decorator::Succeed => text.push_str("succeed"),
                Decorator::Fail => text.push_str("fail"),
                Decorator::Retry(n) => text.push_str(&format!("retry({n})")),
                Decorator::Repeat(n) => text.push_str(&format!("repeat({n})")),
                Decorator::Timeout(ticks) => text.push_str(&format!("timeout({ticks} ticks)")),
            }
            list(program, std::slice::from_ref(child), text);
        }
    }
}

/// Whether a reactive sequence is a unit of the paper, `guard => node`.
fn is_unit(children: &[Node]) -> bool {
    matches!(children, [Node::Condition(_), second] if !matches!(second, Node::Condition(_)))
}

fn list(program: &Program, children: &[Node], text: &mut String) {
    text.push_str(" { ");
    for (i, child) in children.iter().enumerate() {
        if i > 0 {
            text.push_str(", ");
        }
        node(program, child, text);
    }
    text.push_str(" }");
}

/// `binding` is how tightly the surroundings bind: 0 nothing, 1 `or`, 2 `and`, 3 `not`.
fn formula(program: &Program, at: &Guard, binding: u8, text: &mut String) {
    let (parts, word, own): (&[Guard], &str, u8) = match at {
        Guard::Const(value) => return text.push_str(if *value { "true" } else { "false" }),
        Guard::Atom(atom) => return text.push_str(&program.atom_name(*atom).to_string()),
        Guard::Not(inner) => {
            text.push_str("not ");
            return formula(program, inner, 3, text);
        }
        Guard::And(parts) => (parts, " and ", 2),
        Guard::Or(parts) => (parts, " or ", 1),
    };
    let brackets = binding > own;
    if brackets {
        text.push('(');
    }
    for (i, part) in parts.iter().enumerate() {
        if i > 0 {
            text.push_str(word);
        }
        formula(program, part, own, text);
    }
    if brackets {
        text.push(')');
    }
}
