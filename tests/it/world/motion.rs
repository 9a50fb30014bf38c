//! A robot never ends a tick inside a wall, nor goes through one.

use super::geometry::{Twin, free, twin};
use btc::ir::world::Contact;
use btc::random::Random;
use btc::world::{Command, Motion, Pose, Scene};
use proptest::prelude::*;
use std::f64::consts::PI;

const RADIUS: f64 = 0.15;

/// Drives with random commands, gentle and wild, and checks every tick against parry.
fn drive(seed: u64, contact: Contact) -> Result<(), TestCaseError> {
    let random = &mut Random::new(seed, 0, 0);
    let mut twin: Twin = twin(random, contact);
    twin.world.robot.drive.speed_noise = 0.1;
    twin.world.robot.drive.turn_noise = 0.1;
    let scene = Scene::new(&twin.world);
    let motion = Motion::new(&twin.world.robot, twin.world.tick);
    let Some(start) = free(&scene, random, RADIUS) else {
        return Ok(());
    };
    let mut pose = Pose::new(start, random.uniform(-PI, PI));
    let mut slack = 0.0;
    let mut command = Command::default();
    for tick in 0..200 {
        if tick % 10 == 0 {
            let fast = if random.chance(0.2) { 100.0 } else { 1.0 };
            let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
            let mut value = |scale: f64| {
                if random.chance(0.02) {
                    odd[random.below(3) as usize]
                } else {
                    random.uniform(-scale, scale)
                }
            };
            command = Command {
                speed: value(fast),
                strafe: value(fast),
                turn: value(3.0),
            };
        }
        let before = pose;
        let touched = motion.step(&scene, &[], command, random, &mut pose, &mut slack);
        prop_assert!(pose.heading >= -PI && pose.heading < PI);
        let length = btc::math::hypot(pose.ahead[0], pose.ahead[1]);
        prop_assert!((length - 1.0).abs() < 1e-12);
        let off = btc::math::atan2(pose.ahead[1], pose.ahead[0]) - pose.heading;
        prop_assert!(
            btc::math::wrap(off).abs() < 1e-9,
            "heading and its vector agree"
        );
        prop_assert!(
            scene.is_free(pose.position, RADIUS - 1e-9),
            "{:?} is not free",
            pose.position
        );
        prop_assert!(twin.distance(pose.position) >= RADIUS - 1e-7);
        prop_assert!(
            !twin.hits(before.position, pose.position, RADIUS - 1e-6),
            "went through a wall from {:?} to {:?}",
            before.position,
            pose.position
        );
        if contact == Contact::Stop && touched {
            prop_assert_eq!(before.position, pose.position);
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 200, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_stopping_robot_stays_out_of_walls(seed: u64) {
        drive(seed, Contact::Stop)?;
    }

    #[test]
    fn a_sliding_robot_stays_out_of_walls(seed: u64) {
        drive(seed, Contact::Slide)?;
    }
}

/// A world without walls, 6 m × 4 m from the origin.
fn empty(contact: Contact) -> Twin {
    let mut twin = twin(&mut Random::new(1, 0, 0), contact);
    twin.world.walls = std::iter::empty().collect();
    twin.world.arena = btc::geometry::Shape::Rect {
        min: [0.0, 0.0],
        max: [6.0, 4.0],
    };
    twin
}

fn step(twin: &Twin, command: Command, pose: &mut Pose) -> bool {
    let scene = Scene::new(&twin.world);
    let motion = Motion::new(&twin.world.robot, twin.world.tick);
    let mut slack = 0.0;
    motion.step(
        &scene,
        &[],
        command,
        &mut Random::new(0, 0, 0),
        pose,
        &mut slack,
    )
}

#[test]
fn a_blocked_move_is_dropped_and_its_turn_kept() {
    let mut pose = Pose::new([5.8, 2.0], 0.0);
    let command = Command {
        speed: 1.0,
        turn: 1.0,
        ..Command::default()
    };
    assert!(step(&empty(Contact::Stop), command, &mut pose));
    assert_eq!(pose.position, [5.8, 2.0]);
    assert!((pose.heading - 0.1).abs() < 1e-12);
}

#[test]
fn a_slide_keeps_the_part_along_the_wall() {
    let mut pose = Pose::new([5.84, 2.0], PI / 4.0);
    let command = Command {
        speed: 1.0,
        ..Command::default()
    };
    assert!(step(&empty(Contact::Slide), command, &mut pose));
    assert!((pose.position[0] - 5.84).abs() < 1e-9, "{pose:?}");
    assert!(
        (pose.position[1] - (2.0 + 0.1 * 0.5f64.sqrt())).abs() < 1e-9,
        "{pose:?}"
    );
}

#[test]
fn a_holonomic_robot_is_limited_in_any_direction() {
    let mut twin = empty(Contact::Stop);
    twin.world.robot.drive.max_speed = 1.0;
    let mut pose = Pose::new([3.0, 2.0], PI / 2.0);
    let command = Command {
        speed: 3.0,
        strafe: 4.0,
        turn: 0.0,
    };
    assert!(!step(&twin, command, &mut pose));
    assert!((pose.position[0] - 2.92).abs() < 1e-9, "{pose:?}");
    assert!((pose.position[1] - 2.06).abs() < 1e-9, "{pose:?}");
}
