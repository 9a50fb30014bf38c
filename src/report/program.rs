//! What was built from a program.

use super::words::{self, counted};
use crate::geometry::Shape;
use crate::ir::Program;
use crate::ir::name::{self, Name};
use crate::ir::world::DriveKind;
use crate::tree::Size;

/// The items of a program, a line each.
pub fn summary(program: &Program) -> String {
    let mut text = String::new();
    let names = |names: Vec<&Name>| match names.as_slice() {
        [] => "none".to_owned(),
        _ => name::list(names),
    };
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
                "{} for {}: {} of {} ticks, seed {}",
                learner.name,
                program.tasks[learner.task].name,
                words::numbered(learner.episodes, "episode"),
                learner.episode_ticks,
                learner.seed
            ),
        );
    }
    for tree in program.trees.values() {
        let size = Size::of(&tree.root);
        line(
            "tree",
            format!(
                "{}: {}, depth {}",
                tree.name,
                words::size(&size),
                size.depth
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
