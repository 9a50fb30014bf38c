//! A program as one of its robots reads it.

use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name, Program};

/// A program, and the robot that reads what it says: heading, distances, sensors.
#[derive(Clone, Copy, Debug)]
pub struct View<'p> {
    /// The program.
    pub program: &'p Program,
    /// The robot.
    pub robot: Id<Robot>,
}

impl<'p> View<'p> {
    /// Of a predicate or a behaviour: it says itself whose it is.
    pub fn of(program: &'p Program, name: &Name) -> Self {
        let named = |robot: &Robot| name.robot().is_some_and(|name| robot.name.is(name));
        let world = program.world.as_ref();
        let at = world.and_then(|world| world.robots().position(named));
        Self {
            program,
            robot: at.map_or_else(World::acting, Id::new),
        }
    }
}

/// Of events, effects and rewards: the robot that learns reads them.
impl<'p> From<&'p Program> for View<'p> {
    fn from(program: &'p Program) -> Self {
        Self {
            program,
            robot: World::acting(),
        }
    }
}
