//! `btc compile`: what was built, in a summary or in a form of its own.

use super::export::{self, Runtime};
use super::load::Loaded;
use super::target;
use crate::diagnostic::{Code, Diagnostic};
use crate::emit;
use crate::ir::Id;
use crate::ir::name::{self, Name};
use crate::ir::tree::Tree;
use crate::ir::world::{DriveKind, Shape};
use crate::syntax::print;

/// The forms that a program or a tree can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The syntax tree.
    Ast,
    /// The checked program.
    Ir,
    /// The language.
    Bt,
    /// Graphviz.
    Dot,
    /// JSON.
    Json,
    /// A picture of a tree.
    Svg,
    /// A tree for a robot.
    Robot(Runtime),
}

/// Writes a program, or one of its trees, in a form.
///
/// # Errors
/// There is no such tree, it is not said which one of several, or a robot's library has no counterpart for a node.
pub fn emit(loaded: &Loaded, form: Form, tree: Option<&str>) -> Result<String, Diagnostic> {
    let program = &loaded.program;
    let named = tree.map(|name| target::tree(loaded, name)).transpose()?;
    Ok(match (form, named) {
        (Form::Ast, _) => emit::ast::file(&loaded.ast),
        (Form::Ir, _) => emit::ir::program(program),
        (Form::Bt, None) => {
            let text = loaded.sources.get(loaded.main).map(|s| s.text.as_str());
            print::file(&loaded.ast, text)
        }
        (Form::Bt, Some(id)) => emit::bt::tree(program, &program.trees[id]),
        (Form::Dot, named) => {
            let tree = &program.trees[one_tree(loaded, named)?];
            emit::dot::tree(program, tree)
        }
        (Form::Svg, named) => {
            let tree = &program.trees[one_tree(loaded, named)?];
            emit::svg::tree::tree(program, tree)
        }
        (Form::Robot(runtime), named) => {
            export::of_program(loaded, one_tree(loaded, named)?, runtime)?
        }
        (Form::Json, named) => emit::json::program(program, named),
    })
}

fn one_tree(loaded: &Loaded, named: Option<Id<Tree>>) -> Result<Id<Tree>, Diagnostic> {
    let trees = &loaded.program.trees;
    if let Some(id) = named {
        return Ok(id);
    }
    let ids: Vec<Id<Tree>> = trees.ids().collect();
    match ids.as_slice() {
        [one] => Ok(*one),
        _ => {
            let names = name::list(trees.values().map(|tree| &tree.name));
            Err(Diagnostic::new(
                Code::E0504,
                target::end_of_file(loaded),
                match ids.as_slice() {
                    [] => "the program has no tree".to_owned(),
                    _ => format!("the program has several trees: {names}"),
                },
            )
            .label(match ids.as_slice() {
                [] => "`tree NAME = …` is missing",
                _ => "say which one with `--tree NAME`",
            }))
        }
    }
}

/// What was built, for a person.
pub fn summary(loaded: &Loaded) -> String {
    let program = &loaded.program;
    let mut text = String::new();
    let mut line = |head: &str, rest: String| text.push_str(&format!("{head:<12}{rest}\n"));
    if let Some(world) = &program.world {
        let robot = &world.robot;
        line(
            "world",
            format!(
                "{}: {}, {}, tick {} s",
                world.name,
                shape(&world.arena),
                counted(world.walls.len(), "wall"),
                world.tick
            ),
        );
        let names = |names: Vec<&Name>| match names.as_slice() {
            [] => "none".to_owned(),
            _ => name::list(names),
        };
        line(
            "places",
            names(world.places.values().map(|p| &p.name).collect()),
        );
        line(
            "robot",
            format!(
                "{}: radius {} m, {} {} m/s, {} rad/s; sensors: {}",
                robot.name,
                robot.radius,
                match robot.drive.kind {
                    DriveKind::Differential => "differential",
                    DriveKind::Holonomic => "holonomic",
                },
                robot.drive.max_speed,
                robot.drive.max_turn,
                names(robot.sensors.values().map(|s| &s.name).collect())
            ),
        );
    }
    let list = |names: Vec<&Name>| match names.len() {
        0 => "none".to_owned(),
        n => format!("{n}: {}", name::list(names)),
    };
    let predicates = program.predicates.values();
    line("predicates", list(predicates.map(|p| &p.name).collect()));
    let behaviors = program.behaviors.values();
    line("behaviours", list(behaviors.map(|b| &b.name).collect()));
    let events = program.events.values();
    line("events", list(events.map(|e| &e.name).collect()));
    for (id, task) in program.tasks.iter() {
        let atoms = program.atoms(id).len();
        let history = atoms - task.observe.len();
        line(
            "task",
            format!(
                "{}: {} and {} of history make {} atoms; table of at most 2^{atoms} minterms × {} choices",
                task.name,
                counted(task.observe.len(), "predicate"),
                counted(history, "predicate"),
                atoms,
                task.choose.len()
            ),
        );
    }
    for learner in program.learners.values() {
        line(
            "learner",
            format!(
                "{} for {}: {} episodes of {} ticks, seed {}",
                learner.name,
                program.tasks[learner.task].name,
                learner.episodes,
                learner.episode_ticks,
                learner.seed
            ),
        );
    }
    for tree in program.trees.values() {
        let size = crate::tree::Size::of(&tree.root);
        line(
            "tree",
            format!(
                "{}: {} nodes, {} literals, depth {}",
                tree.name, size.nodes, size.literals, size.depth
            ),
        );
    }
    text
}

fn shape(shape: &Shape) -> String {
    match shape {
        Shape::Disc { radius, .. } => format!("disc of radius {radius} m"),
        Shape::Rect { min, max } => format!("{} m × {} m", max[0] - min[0], max[1] - min[1]),
        Shape::Polygon(points) => format!("polygon of {} corners", points.len()),
        Shape::Polyline(points) => format!("line of {} points", points.len()),
    }
}

/// How many there are, in words.
pub(super) fn counted(n: usize, what: &str) -> String {
    match n {
        0 => format!("no {what}s"),
        1 => format!("1 {what}"),
        n => format!("{n} {what}s"),
    }
}
