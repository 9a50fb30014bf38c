//! Programs that nobody wrote: invented from a seed over the whole language, they check, print, are read back, run and can be
//! learned from.

mod author;
mod coverage;
mod expressions;
mod files;
mod items;
mod trees;
mod world;

use crate::program::{NoFiles, called, shown};
use author::Author;
use btc::diagnostic::render;
use btc::driver::compile::{self, Form};
use btc::driver::format::format;
use btc::driver::load::{Loaded, load};
use btc::driver::run::{Subject, run};
use btc::driver::test::due;
use btc::driver::trace::{Step, trace};
use btc::driver::{self, Text};
use btc::emit::form::TreeForm;
use btc::emit::ir;
use btc::geometry::Shape;
use btc::learn::episode::Controller;
use btc::report::trace::Found;
use btc::trial::play::ready;
use btc::world::{Simulation, Start};
use btc::{LearnOptions, Program};

/// How many programs are invented.
const PROGRAMS: u64 = 40;

/// How many of them are learned from.
const LEARNED: u64 = 4;

fn loaded(text: &str) -> Loaded {
    load("invented.bt", text.as_bytes().to_vec(), &mut NoFiles)
}

fn laid_out(text: &str) -> String {
    let (name, bytes) = ("invented.bt", text.as_bytes());
    format(Text { name, bytes }).expect("it parses")
}

/// What an invented program is asked, with its seed where it fails.
fn all(test: impl Fn(u64, &str, &Loaded, &[String])) {
    let only = std::env::var("BTC_INVENTED")
        .ok()
        .and_then(|seed| seed.parse().ok());
    for seed in only.map_or(0..PROGRAMS, |seed: u64| seed..seed + 1) {
        let (text, trees) = Author::new(seed).program();
        let loaded = loaded(&text);
        assert!(
            !loaded.has_errors(),
            "seed {seed}\n{text}\n{}",
            shown(&loaded)
        );
        test(seed, &text, &loaded, &trees);
    }
}

#[test]
fn they_are_read_back_from_print() {
    all(|seed, text, program, _| {
        let printed = laid_out(text);
        assert_eq!(laid_out(&printed), printed, "seed {seed}");
        let again = loaded(&printed);
        assert_eq!(
            ir::program(&again.program),
            ir::program(&program.program),
            "seed {seed}\n{printed}"
        );
    });
}

#[test]
fn they_run_without_a_robot_in_a_wall() {
    all(|seed, text, loaded, trees| {
        for tree in trees {
            let subject = Subject::tree(loaded, tree).unwrap();
            let first = trace(loaded, &subject, 0..1, seed, Step::Tick).unwrap();
            for line in &first.lines {
                stands_free(loaded, &line.found, &format!("seed {seed}, {tree}\n{text}"));
            }
            let second = trace(loaded, &subject, 0..1, seed, Step::Tick).unwrap();
            assert_eq!(first.csv(), second.csv(), "seed {seed}, {tree}");
            let played = || format!("{:?}", run(loaded, &subject, 2, seed).unwrap());
            assert_eq!(played(), played(), "seed {seed}, {tree}");
        }
    });
}

/// Two simulations of a world, of which only one was compiled for the processor, are the same in every tick.
#[test]
fn they_run_as_interpreted_when_compiled() {
    all(|seed, text, loaded, trees| {
        for name in trees {
            let trees = &loaded.program.trees;
            let tree = trees.values().find(|tree| tree.name == called(name));
            let tree = tree.unwrap();
            let task = tree.task.or(loaded.program.tasks.ids().next()).unwrap();
            let ready = || ready(&loaded.program, task, &tree.root).unwrap();
            let (interpreted, mut slow) = ready();
            let (compiled, mut fast) = ready();
            compiled.compile();
            let mut slowly = interpreted.simulation();
            let mut swiftly = compiled.simulation();
            for episode in 0..2 {
                let start = Start {
                    seed,
                    episode,
                    limit: 500,
                    ..Start::default()
                };
                slow.reset();
                fast.reset();
                assert_eq!(slowly.start(start), swiftly.start(start), "seed {seed}");
                loop {
                    slowly.begin_tick();
                    swiftly.begin_tick();
                    slow.tick(&mut slowly);
                    fast.tick(&mut swiftly);
                    let ended = slowly.end_tick();
                    let same = format!("{:?}", swiftly.end_tick());
                    let at = || format!("seed {seed}, {name}, tick {}\n{text}", slowly.ticks());
                    assert_eq!(same, format!("{ended:?}"), "{}", at());
                    assert_eq!(swiftly.atoms(), slowly.atoms(), "{}", at());
                    assert_eq!(swiftly.counts(), slowly.counts(), "{}", at());
                    let found = |it: &Simulation| {
                        format!("{:?}", (it.pose(), it.others().collect::<Vec<_>>()))
                    };
                    assert_eq!(found(&swiftly), found(&slowly), "{}", at());
                    if ended.end.is_some() {
                        break;
                    }
                }
            }
        }
    });
}

#[test]
fn their_trees_are_written_in_every_form() {
    all(|seed, text, loaded, trees| {
        for name in trees {
            for form in [
                TreeForm::Dot,
                TreeForm::Json,
                TreeForm::Svg,
                TreeForm::BtCpp,
                TreeForm::PyTrees,
            ] {
                // What a form has no counterpart for is refused.
                let _ = compile::emit(loaded, Form::Tree(form), Some(name));
            }
            let printed = compile::emit(loaded, Form::Tree(TreeForm::Bt), Some(name)).unwrap();
            let renamed = printed.replace(&format!("tree {name} "), &format!("tree {name}_again "));
            let again = self::loaded(&format!("{text}\n{renamed}"));
            assert!(
                !again.has_errors(),
                "seed {seed}\n{printed}\n{}",
                shown(&again)
            );
            let known = again.program.trees.values().last().unwrap();
            let tree = loaded
                .program
                .trees
                .values()
                .find(|tree| tree.name.to_string() == *name);
            assert_eq!(known.root, tree.unwrap().root, "seed {seed}\n{printed}");
        }
    });
}

/// Their tests say what nobody has thought about: some hold, others are told to fail, at their places.
#[test]
fn their_tests_are_run() {
    let failed = std::cell::Cell::new(0);
    let run = std::cell::Cell::new(0);
    all(|seed, text, program, trees| {
        let due = due(program);
        assert_eq!(due.len(), trees.len(), "seed {seed}\n{text}");
        let told = || {
            let results = driver::test::run(program, "invented.bt", &due, &[]);
            render::human(&program.sources, &results.failures, false)
        };
        let once = told();
        assert_eq!(told(), once, "seed {seed}");
        failed.set(failed.get() + once.matches("error[E0612]").count());
        run.set(run.get() + due.len());
    });
    let (failed, run) = (failed.get(), run.get());
    assert!(0 < failed && failed < run, "{failed} of {run}");
}

#[test]
fn they_can_be_learned_from() {
    for seed in 0..LEARNED {
        let (text, _) = Author::new(seed).program();
        let options = LearnOptions {
            roll_outs: 20,
            tests: 20,
            shape: btc::Shape::Exact,
            ..LearnOptions::default()
        };
        let learn = || Program::from_text(&text).unwrap().learn(&options);
        match (learn(), learn()) {
            (Ok(one), Ok(other)) => assert_eq!(
                one.file("learned.bt"),
                other.file("learned.bt"),
                "seed {seed}"
            ),
            (one, other) => assert_eq!(
                one.err().map(|e| e.to_string()),
                other.err().map(|e| e.to_string()),
                "seed {seed}"
            ),
        }
    }
}

/// No robot is in a wall that always stands, outside of the arena or in another robot.
fn stands_free(loaded: &Loaded, found: &Found, why: &str) {
    let world = loaded.program.world.as_ref().unwrap();
    let others = found
        .others
        .iter()
        .map(|(position, heading)| (*position, *heading));
    let poses: Vec<_> = std::iter::once((found.position, found.heading))
        .chain(others)
        .collect();
    let bodies: Vec<_> = poses.iter().zip(world.robots()).collect();
    for (at, ((position, heading), robot)) in bodies.iter().enumerate() {
        assert!(
            position
                .iter()
                .chain([heading])
                .all(|number| number.is_finite()),
            "{why}"
        );
        let gap = |shape: &Shape| distance_to(shape, *position);
        assert!(
            world.arena.contains(*position),
            "outside in tick {}: {why}",
            found.tick
        );
        assert!(
            gap(&world.arena) > robot.radius - 1e-9,
            "in the boundary in tick {}: {why}",
            found.tick
        );
        for wall in world.walls.values().filter(|wall| wall.when.is_none()) {
            let free = gap(&wall.shape) > robot.radius - 1e-9 && !wall.shape.contains(*position);
            assert!(
                free,
                "{} is in {} in tick {}: {why}",
                robot.name, wall.name, found.tick
            );
        }
        for ((other, _), body) in bodies.iter().skip(at + 1) {
            let apart = (position[0] - other[0]).hypot(position[1] - other[1]);
            assert!(
                apart > robot.radius + body.radius - 1e-9,
                "{} is in {} in tick {}: {why}",
                robot.name,
                body.name,
                found.tick
            );
        }
    }
}

/// How far a point is from the outline of a shape.
fn distance_to(shape: &Shape, p: [f64; 2]) -> f64 {
    if let Shape::Disc { center, radius } = shape {
        return ((p[0] - center[0]).hypot(p[1] - center[1]) - radius).abs();
    }
    let corners = shape.corners();
    let closed = !matches!(shape, Shape::Polyline(_));
    let edges = corners.len() - usize::from(!closed);
    let distances = (0..edges).map(|i| {
        let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
        let along = [b[0] - a[0], b[1] - a[1]];
        let length = along[0] * along[0] + along[1] * along[1];
        let t = ((p[0] - a[0]) * along[0] + (p[1] - a[1]) * along[1]) / length;
        let t = t.clamp(0.0, 1.0);
        (p[0] - a[0] - t * along[0]).hypot(p[1] - a[1] - t * along[1])
    });
    distances.fold(f64::INFINITY, f64::min)
}
