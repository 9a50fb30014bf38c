//! Programs and trees as JSON: every node of a tree is an object with its kind under `node`.

use crate::ir::tree::{self, Composite, Decorator, Tree};
use crate::ir::{Name, Program};
use serde::Serialize;

/// The program's names, sizes and trees.
pub fn program(program: &Program) -> String {
    let tasks = program.tasks.iter().map(|(id, task)| Task {
        name: &task.name,
        atoms: program
            .atoms(id)
            .into_iter()
            .map(|atom| program.atom_name(atom))
            .collect(),
        choose: task
            .choose
            .iter()
            .map(|id| &program.behaviors[*id].name)
            .collect(),
        window: task.history.window,
    });
    text(&Whole {
        world: program.world.as_ref().map(|world| World {
            name: &world.name,
            tick: world.tick,
            places: world.places.values().map(|place| &place.name).collect(),
            walls: world.walls.values().map(|wall| &wall.name).collect(),
            robot: &world.robot.name,
            sensors: world.robot.sensors.values().map(|s| &s.name).collect(),
        }),
        states: program.states.values().map(|state| &state.name).collect(),
        events: program.events.values().map(|event| &event.name).collect(),
        predicates: program.predicates.values().map(|p| &p.name).collect(),
        behaviors: program.behaviors.values().map(|b| &b.name).collect(),
        tasks: tasks.collect(),
        trees: program
            .trees
            .values()
            .map(|tree| Item::of(program, tree))
            .collect(),
    })
}

/// One tree.
pub fn tree(program: &Program, tree: &Tree) -> String {
    text(&Item::of(program, tree))
}

fn text(document: &impl Serialize) -> String {
    let mut text = serde_json::to_string_pretty(document).unwrap_or_default();
    text.push('\n');
    text
}

#[derive(Serialize)]
struct Whole<'p> {
    world: Option<World<'p>>,
    states: Vec<&'p Name>,
    events: Vec<&'p Name>,
    predicates: Vec<&'p Name>,
    behaviors: Vec<&'p Name>,
    tasks: Vec<Task<'p>>,
    trees: Vec<Item<'p>>,
}

#[derive(Serialize)]
struct World<'p> {
    name: &'p Name,
    tick: f64,
    places: Vec<&'p Name>,
    walls: Vec<&'p Name>,
    robot: &'p Name,
    sensors: Vec<&'p Name>,
}

#[derive(Serialize)]
struct Task<'p> {
    name: &'p Name,
    atoms: Vec<Name>,
    choose: Vec<&'p Name>,
    window: usize,
}

/// A tree with its name.
#[derive(Serialize)]
struct Item<'p> {
    name: &'p Name,
    task: Option<&'p Name>,
    docs: &'p [String],
    root: Node<'p>,
}

#[derive(Serialize)]
#[serde(tag = "node", rename_all = "snake_case")]
enum Node<'p> {
    Condition {
        condition: Guard,
    },
    Behavior {
        behavior: &'p Name,
    },
    Selector {
        memory: bool,
        children: Vec<Node<'p>>,
    },
    Sequence {
        memory: bool,
        children: Vec<Node<'p>>,
    },
    Parallel {
        successes: u32,
        children: Vec<Node<'p>>,
    },
    Invert {
        child: Box<Node<'p>>,
    },
    Succeed {
        child: Box<Node<'p>>,
    },
    Fail {
        child: Box<Node<'p>>,
    },
    Retry {
        times: u32,
        child: Box<Node<'p>>,
    },
    Repeat {
        times: u32,
        child: Box<Node<'p>>,
    },
    Timeout {
        ticks: u64,
        child: Box<Node<'p>>,
    },
}

/// A guard: a name, `true` or `false`, `{"not": …}`, `{"and": […]}` or `{"or": […]}`.
#[derive(Serialize)]
#[serde(untagged)]
enum Guard {
    Const(bool),
    Atom(Name),
    Not { not: Box<Guard> },
    And { and: Vec<Guard> },
    Or { or: Vec<Guard> },
}

impl<'p> Item<'p> {
    fn of(program: &'p Program, tree: &'p Tree) -> Self {
        Self {
            name: &tree.name,
            task: tree.task.map(|task| &program.tasks[task].name),
            docs: &tree.docs,
            root: Node::of(program, &tree.root),
        }
    }
}

impl<'p> Node<'p> {
    fn of(program: &'p Program, node: &tree::Node) -> Self {
        let children = || {
            let children = node.children().iter();
            children.map(|child| Node::of(program, child)).collect()
        };
        match node {
            tree::Node::Condition(guard) => Self::Condition {
                condition: Guard::of(program, guard),
            },
            tree::Node::Behavior(id) => Self::Behavior {
                behavior: &program.behaviors[*id].name,
            },
            tree::Node::Composite { kind, memory, .. } => {
                let (memory, children) = (*memory, children());
                match kind {
                    Composite::Selector => Self::Selector { memory, children },
                    Composite::Sequence => Self::Sequence { memory, children },
                }
            }
            tree::Node::Parallel { successes, .. } => Self::Parallel {
                successes: *successes,
                children: children(),
            },
            tree::Node::Decorator { kind, child } => {
                let child = Box::new(Node::of(program, child));
                match *kind {
                    Decorator::Invert => Self::Invert { child },
                    Decorator::Succeed => Self::Succeed { child },
                    Decorator::Fail => Self::Fail { child },
                    Decorator::Retry(times) => Self::Retry { times, child },
                    Decorator::Repeat(times) => Self::Repeat { times, child },
                    Decorator::Timeout(ticks) => Self::Timeout { ticks, child },
                }
            }
        }
    }
}

impl Guard {
    fn of(program: &Program, guard: &tree::Guard) -> Self {
        let all = |guards: &[tree::Guard]| {
            let guards = guards.iter();
            guards.map(|part| Guard::of(program, part)).collect()
        };
        match guard {
            tree::Guard::Const(value) => Self::Const(*value),
            tree::Guard::Atom(atom) => Self::Atom(program.atom_name(*atom)),
            tree::Guard::Not(inner) => Self::Not {
                not: Box::new(Guard::of(program, inner)),
            },
            tree::Guard::And(parts) => Self::And { and: all(parts) },
            tree::Guard::Or(parts) => Self::Or { or: all(parts) },
        }
    }
}
