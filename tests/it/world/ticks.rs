//! What a tick means.

use crate::examples::example;
use crate::program::{named, shown};
use btc::geometry::Shape;
use btc::ir::expr::{Draw, Echo};
use btc::ir::law::{Behavior, Stmt};
use btc::ir::task::{History, StartLine};
use btc::ir::tree::{Atom, Status};
use btc::ir::world::Wall;
use btc::ir::{Expr, Id, Name, Program};
use btc::learn::process::{End, Process};
use btc::world::{BuildError, Simulation, Simulator, Start};
use std::path::Path;

/// One world is shared between threads.
#[test]
fn a_simulator_can_be_shared() {
    fn shared<T: Send + Sync>() {}
    shared::<Simulator>();
}

/// The simulator of an example's task, and the behaviours to choose from.
fn delivery(program: &Program) -> (Simulator, &[Id<Behavior>]) {
    let task = &program.tasks[Id::new(0)];
    let simulator = Simulator::build(program, Id::new(0), &[&task.start], &[]).unwrap();
    (simulator, &task.choose)
}

/// The expert of the paper's Figure 8 delivers for thousands of ticks without dying.
#[test]
fn an_expert_delivers_in_the_small_world() {
    let program = example("delivery_small").program;
    let (simulator, choose) = delivery(&program);
    let mut simulation = simulator.simulation();
    let (mut deliveries, mut deaths) = (0, 0);
    for episode in 0..20 {
        simulation.start(Start {
            seed: 1,
            episode,
            limit: 5000,
            ..Start::default()
        });
        loop {
            let key = simulation.key();
            let behavior = match (key & 1 != 0, key & 2 != 0) {
                (_, true) if key & 1 << 4 != 0 => 3,
                (_, true) => 2,
                (true, _) => 1,
                _ => 0,
            };
            let transition = simulation.decide(choose[behavior], None, 0);
            if transition.end != End::Not {
                let end = transition.end;
                deaths += u32::from(end == End::Terminal(0));
                break;
            }
        }
        deliveries += simulation.counts()[1];
    }
    assert_eq!(deaths, 0);
    assert!(deliveries > 200, "{deliveries}");
}

// The behaviours of `small_program`.
const DONE: usize = 0;
const REFUSED: usize = 1;
const TALLY: usize = 2;
const LOOK: usize = 3;
const GO: usize = 4;

// Its states.
const CARRYING: usize = 0;
const BATTERY: usize = 1;
const SEEN: usize = 2;
const AGAIN: usize = 3;

/// A program of behaviours that each show one thing; see the file. `tally` copies its local and how long it has run to
/// two states, `look` a noisy sensor to both, which only the IR can say.
pub(crate) fn small_program() -> Program {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/cases/world/ticks.bt");
    let loaded = named("ticks.bt", Path::new(path));
    assert!(!loaded.has_errors(), "{}", shown(&loaded));
    let mut program = loaded.program;
    // `low` is there to be asked for besides the task's atoms.
    program.tasks[Id::new(0)].observe.truncate(1);
    let ahead = Expr::Sensor(Id::new(0), Echo::Distance);
    for (behavior, shows) in [
        (TALLY, [Expr::Local(Id::new(0)), Expr::Elapsed]),
        (LOOK, [ahead, ahead]),
    ] {
        let law = program.behaviors[Id::new(behavior)].law.as_mut().unwrap();
        for (state, leaf) in [SEEN, AGAIN].into_iter().zip(shows) {
            let value = program.pool.leaf(leaf);
            law.control.0.push(Stmt::SetState(Id::new(state), value));
        }
    }
    program
}

fn build(program: &Program) -> Result<Simulator, BuildError> {
    let task = Id::new(0);
    let start = &program.tasks[task].start;
    Simulator::build(program, task, &[start], &[Atom::Predicate(Id::new(1))])
}

fn option(simulation: &mut Simulation, behavior: usize) -> btc::learn::process::Step {
    simulation.decide(Id::new(behavior), Some(1), 0)
}

fn state(simulation: &Simulation, id: usize) -> f64 {
    simulation.state(Id::new(id))
}

#[test]
fn success_and_outright_failure_take_one_tick_each() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    let before = simulation.key();
    let refused = option(&mut simulation, REFUSED);
    assert_eq!((refused.status, refused.ticks), (Status::Failure, 1));
    assert_eq!(refused.to, before);
    assert_eq!(state(&simulation, BATTERY), 0.75);
    let done = option(&mut simulation, DONE);
    assert_eq!((done.status, done.ticks), (Status::Success, 1));
    // carrying and done(done), from bit 1; low is bit 6, after the five behaviours.
    assert_eq!(done.to, 0b11);
    assert_eq!(simulation.ticks(), 2);
    let go = simulation.decide(Id::new(GO), None, 0);
    assert_eq!((go.status, go.ticks), (Status::Running, 2));
    assert_eq!(go.end, End::Terminal(0));
}

#[test]
fn a_death_and_a_pickup_in_one_tick_are_a_death_and_both_happen() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    for _ in 0..3 {
        let go = option(&mut simulation, GO);
        assert_eq!((go.reward, go.closed, go.end), (-0.1, false, End::Not));
    }
    let last = option(&mut simulation, DONE);
    assert_eq!((last.reward, last.closed), (-5.0, true));
    assert_eq!(last.end, End::Terminal(0));
    assert_eq!(
        simulation.fired().map(Id::index).collect::<Vec<_>>(),
        [0, 2]
    );
    assert_eq!(simulation.counts(), [1, 0, 1]);
    assert_eq!(state(&simulation, CARRYING), 1.0);
}

#[test]
fn rewards_and_conditions_of_effects_read_the_state_before_effects() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    // 1 + carrying, which is still 0; and the second effect does not undo the first.
    assert_eq!(option(&mut simulation, DONE).reward, 1.0);
    assert_eq!(state(&simulation, CARRYING), 1.0);
    let dropoff = option(&mut simulation, DONE);
    assert_eq!((dropoff.reward, dropoff.closed), (-0.1, false));
    assert_eq!(state(&simulation, CARRYING), 0.0);
    assert_eq!(simulation.counts(), [1, 1, 0]);
}

#[test]
fn locals_live_as_long_as_every_tick_ticks_their_behaviour() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    let mut tick = |behaviors: &[usize]| {
        simulation.begin_tick();
        for &behavior in behaviors {
            simulation.act(Id::new(behavior));
        }
        simulation.end_tick();
        (state(&simulation, SEEN), state(&simulation, AGAIN))
    };
    assert_eq!(tick(&[TALLY]), (1.0, 0.0));
    assert_eq!(tick(&[TALLY]), (2.0, 0.5));
    // A tree may try something else first in the same tick.
    assert_eq!(tick(&[REFUSED, TALLY]), (3.0, 1.0));
    assert_eq!(tick(&[GO]), (3.0, 1.0));
    assert_eq!(tick(&[TALLY]), (1.0, 0.0));
}

#[test]
fn the_window_holds_the_last_terminations_of_its_kinds() {
    let mut program = small_program();
    let task = Id::new(0);
    program.tasks[task].observe.clear();
    program.tasks[task].end_on.clear();
    let names = |window, failure| {
        let mut program = program.clone();
        program.tasks[task].history = History {
            window,
            success: true,
            failure,
        };
        let simulator = build(&program).unwrap();
        let mut simulation = simulator.simulation();
        simulation.start(Start::default());
        let mut seen = Vec::new();
        for behavior in [DONE, REFUSED, REFUSED, GO, DONE] {
            let key = option(&mut simulation, behavior).to;
            let atoms = program.atoms(task);
            let held = atoms
                .iter()
                .enumerate()
                .filter(|&(i, _)| key >> i & 1 == 1)
                .map(|(_, atom)| match atom {
                    Atom::Done(id) => format!("+{}", id.index()),
                    Atom::Failed(id) => format!("-{}", id.index()),
                    Atom::Predicate(_) => unreachable!(),
                });
            seen.push(held.collect::<String>());
        }
        assert!(simulation.window().len() <= window);
        seen.join(" ")
    };
    assert_eq!(names(0, true), "    ");
    assert_eq!(names(1, false), "+0 +0 +0 +0 +0");
    assert_eq!(names(1, true), "+0 -1 -1 -1 +0");
    assert_eq!(names(2, true), "+0 +0-1 -1 -1 +0-1");
    assert_eq!(names(3, true), "+0 +0-1 +0-1 +0-1 +0-1");
}

#[test]
fn noise_is_drawn_once_a_tick() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    let mut readings = Vec::new();
    for _ in 0..3 {
        option(&mut simulation, LOOK);
        assert_eq!(state(&simulation, SEEN), state(&simulation, AGAIN));
        let reading = state(&simulation, SEEN);
        assert!((reading - 3.0).abs() < 0.6 && reading != 3.0, "{reading}");
        readings.push(reading);
    }
    assert!(readings[0] != readings[1] && readings[1] != readings[2]);
}

#[test]
fn a_blocked_robot_touches_for_a_tick() {
    let mut program = small_program();
    program.tasks[Id::new(0)].end_on.clear();
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    let mut touches = Vec::new();
    for behavior in [GO, GO, GO, GO, GO, GO, TALLY] {
        option(&mut simulation, behavior);
        touches.push(simulation.is_touching());
    }
    // From x = 1 in steps of 0.5 up to 3.5; 4 is the wall.
    assert_eq!(simulation.pose().position, [3.5, 2.0]);
    assert_eq!(touches, [false, false, false, false, false, true, false]);
}

#[test]
fn a_decision_waits_for_patience_and_dwell() {
    let mut program = small_program();
    let task = Id::new(0);
    program.tasks[task].end_on.clear();
    program.tasks[task].observe = vec![Id::new(1)];
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    let start = Start {
        limit: 20,
        ..Start::default()
    };
    let go = Id::new(GO);
    // The battery is low after the fourth tick; from then on `dead` fires in every tick.
    program.tasks[task].reward.clear();
    simulation.start(start);
    assert_eq!(simulation.decide(go, Some(2), 0).ticks, 2);
    assert_eq!(simulation.decide(go, Some(9), 0).ticks, 2);
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(start);
    assert_eq!(simulation.decide(go, None, 6).ticks, 6);
    let rest = simulation.decide(go, None, 0);
    assert_eq!((rest.ticks, rest.end), (14, End::Cut));
}

#[test]
fn atoms_beyond_the_tasks_can_be_asked_for() {
    let program = small_program();
    let simulator = build(&program).unwrap();
    assert_eq!(simulator.atoms().len(), 7);
    assert_eq!(simulator.atoms()[6], Atom::Predicate(Id::new(1)));
    assert_eq!(simulator.observed(), 0b11_1111);
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    for _ in 0..4 {
        assert_eq!(simulation.atoms() >> 6, 0);
        option(&mut simulation, GO);
    }
    assert_eq!((simulation.atoms() >> 6, simulation.key()), (1, 0));
}

#[test]
fn an_episode_does_not_depend_on_what_ran_before_it() {
    let program = example("delivery_large").program;
    let (simulator, choose) = delivery(&program);
    let trace = |simulation: &mut Simulation, episode| {
        simulation.start(Start {
            seed: 7,
            stream: 1,
            episode,
            limit: 300,
            ..Start::default()
        });
        let mut trace = Vec::new();
        for i in 0.. {
            let transition = simulation.decide(choose[4 + i % 2], Some(50), 0);
            let pose = simulation.pose();
            trace.push((transition.to, pose.position.map(f64::to_bits)));
            if transition.end != End::Not {
                return trace;
            }
        }
        trace
    };
    let mut reused = simulator.simulation();
    let traces: Vec<_> = (0..10).map(|e| trace(&mut reused, e)).collect();
    for episode in (0..10).rev() {
        let mut fresh = simulator.simulation();
        assert_eq!(trace(&mut fresh, episode), traces[episode as usize]);
        assert_eq!(trace(&mut reused, episode), traces[episode as usize]);
    }
    assert!(traces.windows(2).all(|pair| pair[0] != pair[1]));
}

#[test]
fn what_cannot_run_is_refused_when_it_is_built() {
    let edit = |edit: fn(&mut Program)| {
        let mut program = small_program();
        edit(&mut program);
        build(&program).err()
    };
    assert_eq!(edit(|_| {}), None);
    assert_eq!(edit(|p| p.world = None), Some(BuildError::NoWorld));
    assert_eq!(
        edit(|p| p.behaviors[Id::new(GO)].law = None),
        Some(BuildError::Declared("go".into()))
    );
    assert_eq!(
        edit(|p| p.predicates[Id::new(0)].when = None),
        Some(BuildError::Declared("loaded".into()))
    );
    assert_eq!(
        edit(|p| p.world.as_mut().unwrap().robot.radius = 2.1),
        Some(BuildError::NoFreeArea)
    );
    assert_eq!(
        edit(|p| {
            let wall = Wall {
                name: Name::default(),
                shape: Shape::Disc {
                    center: [1.0, 2.0],
                    radius: 0.3,
                },
                when: None,
            };
            p.world.as_mut().unwrap().walls.push(wall);
        }),
        Some(BuildError::StartBlocked(0, None))
    );
    assert_eq!(
        edit(|p| {
            for _ in 0..130 {
                let predicate = p.predicates[Id::new(0)].clone();
                let id = p.predicates.push(predicate);
                p.tasks[Id::new(0)].observe.push(id);
            }
        }),
        Some(BuildError::TooManyAtoms(137))
    );
}

/// A start that is only sometimes free is drawn until it is.
#[test]
fn a_start_is_drawn_again_until_it_is_free() {
    let mut program = small_program();
    let pool = &mut program.pool;
    let (low, high, one) = (pool.num(-4.0), pool.num(4.0), pool.num(1.0));
    let x = pool.draw(Draw::Uniform(low, high));
    program.tasks[Id::new(0)].start = vec![StartLine::Position(x, one)];
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    for episode in 0..100 {
        let start = Start {
            episode,
            ..Start::default()
        };
        assert!(simulation.start(start));
        let [x, y] = simulation.pose().position;
        assert!((0.2..=3.8).contains(&x) && y == 1.0);
    }
}

/// A behaviour that is declared only can be named by a tree; it fails.
#[test]
fn a_declared_behavior_fails() {
    let mut program = small_program();
    program.tasks[Id::new(0)].choose.pop();
    program.behaviors[Id::new(GO)].law = None;
    let simulator = build(&program).unwrap();
    let mut simulation = simulator.simulation();
    simulation.start(Start::default());
    assert_eq!(option(&mut simulation, GO).status, Status::Failure);
}

/// The same bits on every machine and in every build.
#[test]
fn a_seed_is_a_course_to_the_last_bit() {
    let program = example("delivery_large").program;
    let (simulator, choose) = delivery(&program);
    let mut simulation = simulator.simulation();
    simulation.start(Start {
        seed: 1,
        limit: 1000,
        ..Start::default()
    });
    let mut course = 0u64;
    for i in 0.. {
        let transition = simulation.decide(choose[i % 6], Some(40), 0);
        let pose = simulation.pose();
        for value in [pose.position[0], pose.position[1], pose.heading] {
            course = course.rotate_left(5) ^ value.to_bits();
        }
        if transition.end != End::Not {
            break;
        }
    }
    assert_eq!(course, 0xa59b_7c32_6709_d990, "{course:#x}");
}
