//! The world: geometry in metres, angles in radians, counter-clockwise from the x axis.

use super::expr::ExprId;
use super::name::Name;
use super::table::{Id, Table};
use super::tree::Node;
use crate::geometry::{Point, Shape};

/// A world with one acting robot, and perhaps others that run scripts.
#[derive(Clone, Debug, PartialEq)]
pub struct World {
    /// Its name.
    pub name: Name,
    /// The length of a tick in seconds.
    pub tick: f64,
    /// The free area; its boundary is a wall.
    pub arena: Shape,
    /// The walls and obstacles.
    pub walls: Table<Wall>,
    /// The places.
    pub places: Table<Place>,
    /// The robot that acts.
    pub robot: Robot,
    /// The other robots.
    pub others: Table<Scripted>,
}

/// A robot that runs a tree of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Scripted {
    /// The robot.
    pub robot: Robot,
    /// Its tree, whose behaviours and predicates are its own; `None` until it is checked.
    pub script: Option<Node>,
}

impl World {
    /// The acting robot among [`World::robots`].
    pub fn acting() -> Id<Robot> {
        Id::new(0)
    }

    /// All robots, the acting one first.
    pub fn robots(&self) -> impl Iterator<Item = &Robot> {
        let others = self.others.values().map(|other| &other.robot);
        std::iter::once(&self.robot).chain(others)
    }

    /// A robot by its place among [`World::robots`].
    pub fn robot_of(&self, id: Id<Robot>) -> &Robot {
        self.robots().nth(id.index()).unwrap_or(&self.robot)
    }
}

/// A wall or an obstacle. A polyline is thin, every other shape is solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name.
    pub name: Name,
    /// Its shape.
    pub shape: Shape,
    /// When it stands; `None` if always.
    pub when: Option<ExprId>,
}

/// A place. It stands in nobody's way.
#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// Its name.
    pub name: Name,
    /// Its shape.
    pub shape: Shape,
    /// The heading of a robot that stands here as it should.
    pub facing: Option<f64>,
}

/// A robot with a round body.
#[derive(Clone, Debug, PartialEq)]
pub struct Robot {
    /// Its name.
    pub name: Name,
    /// The radius of its body in metres.
    pub radius: f64,
    /// How it moves.
    pub drive: Drive,
    /// What happens when it touches a wall.
    pub contact: Contact,
    /// What it senses with.
    pub sensors: Table<Sensor>,
}

/// A drive with its limits and its noise (standard deviations, drawn once a tick).
#[derive(Clone, Debug, PartialEq)]
pub struct Drive {
    /// Which drive.
    pub kind: DriveKind,
    /// The greatest speed in m/s, in any direction.
    pub max_speed: f64,
    /// The greatest rate of turn in rad/s.
    pub max_turn: f64,
    /// Noise on the speed in m/s.
    pub speed_noise: f64,
    /// Noise on the rate of turn in rad/s.
    pub turn_noise: f64,
}

/// The two drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DriveKind {
    /// Unicycle kinematics: forwards, backwards, turning.
    Differential,
    /// Any direction of the plane, and turning.
    Holonomic,
}

/// What a blocked move does; both report contact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Contact {
    /// The move is dropped; the turn is kept.
    Stop,
    /// The part of the move along the wall is kept.
    Slide,
}

/// A sensor.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Its name.
    pub name: Name,
    /// What it is.
    pub kind: SensorKind,
    /// The standard deviation of its noise in metres; one draw a tick, shared by all that read it.
    pub noise: f64,
}

/// The sensors. Angles are relative to the heading; readings are from the robot's centre.
#[derive(Clone, Debug, PartialEq)]
pub enum SensorKind {
    /// The nearest echo within a sector: its distance and its bearing.
    Scanner {
        /// The right-hand end of the sector.
        from: f64,
        /// The left-hand end of the sector, `from` < `to` ≤ `from` + 2π.
        to: f64,
        /// The distance that it gives when nothing echoes.
        range: f64,
    },
    /// One ray.
    RangeFinder {
        /// Its bearing.
        at: f64,
        /// The distance that it gives when nothing echoes.
        range: f64,
    },
    /// Hears a beacon that stands at `target` when it is near, in line of sight, and the robot is within the sector
    /// that the beacon sends into.
    Beacon {
        /// Where the beacon stands.
        target: Point,
        /// How far it is heard.
        range: f64,
        /// The direction into which it sends.
        facing: f64,
        /// The full width of its sector.
        sector: f64,
    },
}
