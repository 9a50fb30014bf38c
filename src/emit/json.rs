//! Programs and trees as JSON: every node of a tree an object with its kind under `node`.

use crate::ir::tree::{Composite, Decorator, Guard, Node, Tree};
use crate::ir::{Id, Program};
use serde_json::{Value, json};

/// The program's names, sizes and trees, or one tree alone.
pub fn program(program: &Program, tree: Option<Id<Tree>>) -> String {
    let value = match tree {
        Some(id) => tree_value(program, &program.trees[id]),
        None => json!({
            "world": program.world.as_ref().map(|world| json!({
                "name": world.name,
                "tick": world.tick,
                "places": world.places.values().map(|p| &p.name).collect::<Vec<_>>(),
                "walls": world.walls.values().map(|w| &w.name).collect::<Vec<_>>(),
                "robot": world.robot.name,
                "sensors": world.robot.sensors.values().map(|s| &s.name).collect::<Vec<_>>(),
            })),
            "states": program.states.values().map(|s| &s.name).collect::<Vec<_>>(),
            "events": program.events.values().map(|e| &e.name).collect::<Vec<_>>(),
            "predicates": program.predicates.values().map(|p| &p.name).collect::<Vec<_>>(),
            "behaviors": program.behaviors.values().map(|b| &b.name).collect::<Vec<_>>(),
            "tasks": program.tasks.iter().map(|(id, task)| json!({
                "name": task.name,
                "atoms": program.atoms(id).into_iter().map(|a| program.atom_name(a)).collect::<Vec<_>>(),
                "choose": task.choose.iter().map(|b| &program.behaviors[*b].name).collect::<Vec<_>>(),
                "window": task.history.window,
            })).collect::<Vec<_>>(),
            "trees": program.trees.values().map(|t| tree_value(program, t)).collect::<Vec<_>>(),
        }),
    };
    let mut text = serde_json::to_string_pretty(&value).unwrap_or_default();
    text.push('\n');
    text
}

fn tree_value(program: &Program, tree: &Tree) -> Value {
    json!({
        "name": tree.name,
        "task": tree.task.map(|task| &program.tasks[task].name),
        "docs": tree.docs,
        "root": self::tree(&tree.root, program),
    })
}

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
