//! Trees as JSON: every node an object with its kind under `node`.

use crate::ir::Program;
use crate::ir::tree::{Composite, Decorator, Guard, Node};
use serde_json::{Value, json};

/// A tree as JSON.
pub fn tree(root: &Node, program: &Program) -> Value {
    let all = |children: &[Node]| -> Vec<Value> {
        children.iter().map(|child| tree(child, program)).collect()
    };
    match root {
        Node::Condition(condition) => {
            json!({ "node": "condition", "condition": guard(condition, program) })
        }
        Node::Behavior(id) => {
            json!({ "node": "behavior", "behavior": program.behaviors[*id].name })
        }
        Node::Composite {
            kind,
            memory,
            children,
        } => {
            let node = match kind {
                Composite::Selector => "selector",
                Composite::Sequence => "sequence",
            };
            json!({ "node": node, "memory": memory, "children": all(children) })
        }
        Node::Parallel {
            successes,
            children,
        } => json!({ "node": "parallel", "successes": successes, "children": all(children) }),
        Node::Decorator { kind, child } => {
            let child = tree(child, program);
            match kind {
                Decorator::Invert => json!({ "node": "invert", "child": child }),
                Decorator::Succeed => json!({ "node": "succeed", "child": child }),
                Decorator::Fail => json!({ "node": "fail", "child": child }),
                Decorator::Retry(times) => {
                    json!({ "node": "retry", "times": times, "child": child })
                }
                Decorator::Repeat(times) => {
                    json!({ "node": "repeat", "times": times, "child": child })
                }
                Decorator::Timeout(ticks) => {
                    json!({ "node": "timeout", "ticks": ticks, "child": child })
                }
            }
        }
    }
}

/// A guard as JSON: a name, `true` or `false`, `{"not": …}`, `{"and": […]}` or `{"or": […]}`.
pub fn guard(guard: &Guard, program: &Program) -> Value {
    let all = |guards: &[Guard]| -> Vec<Value> {
        guards
            .iter()
            .map(|part| self::guard(part, program))
            .collect()
    };
    match guard {
        Guard::Const(value) => json!(value),
        Guard::Atom(atom) => json!(program.atom_name(*atom)),
        Guard::Not(inner) => json!({ "not": self::guard(inner, program) }),
        Guard::And(guards) => json!({ "and": all(guards) }),
        Guard::Or(guards) => json!({ "or": all(guards) }),
    }
}
