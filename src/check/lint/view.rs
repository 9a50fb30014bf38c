//! A program as one of its robots reads it.

use super::interval::Interval;
use crate::geometry::Shape;
use crate::ir::expr::{Expr, ExprId};
use crate::ir::law::{Behavior, Law};
use crate::ir::program::Stays;
use crate::ir::world::{Robot, World};
use crate::ir::{Id, Name, Pool, Program};

/// A program, and the robot that reads what it says: heading, distances, sensors.
#[derive(Clone, Copy, Debug)]
pub struct View<'p> {
    /// The program.
    pub program: &'p Program,
    /// The robot.
    pub robot: Id<Robot>,
    /// Where it is; `None` for anywhere in the arena.
    pub near: Option<[Interval; 2]>,
    /// Whether nothing is taken to be between two points: a family may be written for other worlds, too.
    pub open: bool,
    /// The law whose locals are read; `None` where nothing is known of locals.
    pub law: Option<&'p Law>,
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
            near: None,
            open: false,
            law: None,
        }
    }

    /// Of the clauses of a behaviour.
    pub fn of_behavior(program: &'p Program, behavior: &'p Behavior) -> Self {
        Self {
            law: behavior.law.as_ref(),
            ..Self::of(program, &behavior.name)
        }
    }

    /// The values that a state, a local or a name that a statement binds may have.
    pub fn stays(self, variable: Expr) -> Option<&'p Stays> {
        match variable {
            Expr::Temp(temp) => Some(&self.program.temps[temp].stays),
            Expr::State(state) => Some(&self.program.states[state].stays),
            Expr::Local(local) => self.law.map(|law| &law.locals[local].stays),
            _ => None,
        }
    }

    /// Of a predicate without parameters, which is written for this world: where no wall is, nothing is ever between two points.
    pub fn of_predicate(program: &'p Program, name: &Name) -> Self {
        let world = program.world.as_ref();
        let open = world.is_some_and(|world| world.walls.is_empty() && world.arena.is_convex());
        Self {
            open: open && name.arguments.is_empty(),
            ..Self::of(program, name)
        }
    }

    /// Whether the robot is in a shape, as far as that is known.
    pub fn is_in(&self, shape: &Shape) -> bool {
        let Some([x, y]) = self.near else {
            return false;
        };
        let ((left, right), (bottom, top)) = (x.ends(), y.ends());
        let corners = [[left, bottom], [right, bottom], [left, top], [right, top]];
        shape.is_convex() && corners.into_iter().all(|corner| shape.contains(corner))
    }
}

/// Of events, effects and rewards: the robot that learns reads them.
impl<'p> From<&'p Program> for View<'p> {
    fn from(program: &'p Program) -> Self {
        Self {
            program,
            robot: World::acting(),
            near: None,
            open: false,
            law: None,
        }
    }
}

/// Whether an expression reads something of the world that another robot may read otherwise.
pub fn is_of_a_robot(pool: &Pool, id: ExprId) -> bool {
    pool.any(id, &mut |expr| {
        matches!(
            expr,
            Expr::Pose(_)
                | Expr::Robot(..)
                | Expr::Visible(..)
                | Expr::NearestWall(_)
                | Expr::Wall(..)
                | Expr::Sensor(..)
                | Expr::Inside(_)
                | Expr::Ended(..)
                | Expr::Event(_)
                | Expr::Draw(..)
        )
    })
}
