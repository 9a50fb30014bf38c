//! The world: geometry in metres, angles in radians, counter-clockwise from the x axis.

use super::name::Name;
use super::table::Table;

/// A point of the plane, in metres.
pub type Point = [f64; 2];

/// A world with one acting robot.
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
}

/// A shape of the plane.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// A disc.
    Disc {
        /// The centre.
        center: Point,
        /// The radius.
        radius: f64,
    },
    /// An axis-parallel rectangle.
    Rect {
        /// The corner of the least coordinates.
        min: Point,
        /// The corner of the greatest coordinates.
        max: Point,
    },
    /// A simple polygon, counter-clockwise.
    Polygon(Vec<Point>),
    /// A chain of thin segments; a line is a chain of one.
    Polyline(Vec<Point>),
}

impl Shape {
    /// The point that `distance` and `direction` of a place measure to: the centre of a disc or a rectangle, the
    /// centroid of a polygon (by area), the middle of a polyline (by length).
    pub fn center(&self) -> Point {
        match self {
            Shape::Disc { center, .. } => *center,
            Shape::Rect {
                min: [x0, y0],
                max: [x1, y1],
            } => [(x0 + x1) / 2.0, (y0 + y1) / 2.0],
            Shape::Polygon(points) => centroid(points),
            Shape::Polyline(points) => middle(points),
        }
    }
}

/// Centroid by area (the shoelace sums); the mean of the corners where the area vanishes.
fn centroid(points: &[Point]) -> Point {
    let next = points.iter().cycle().skip(1);
    let (mut area, mut cx, mut cy) = (0.0, 0.0, 0.0);
    for (&[x0, y0], &[x1, y1]) in points.iter().zip(next) {
        let cross = x0 * y1 - x1 * y0;
        area += cross;
        cx += (x0 + x1) * cross;
        cy += (y0 + y1) * cross;
    }
    if area == 0.0 {
        let n = points.len().max(1) as f64;
        let (x, y) = points
            .iter()
            .fold((0.0, 0.0), |(x, y), p| (x + p[0], y + p[1]));
        return [x / n, y / n];
    }
    [cx / (3.0 * area), cy / (3.0 * area)]
}

/// The point halfway along a chain.
fn middle(points: &[Point]) -> Point {
    let segments = || points.iter().zip(points.iter().skip(1));
    let length = |a: &Point, b: &Point| crate::math::hypot(b[0] - a[0], b[1] - a[1]);
    let mut left = segments().map(|(a, b)| length(a, b)).sum::<f64>() / 2.0;
    for (a, b) in segments() {
        let l = length(a, b);
        if left <= l && l > 0.0 {
            let t = left / l;
            return [a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])];
        }
        left -= l;
    }
    points.first().copied().unwrap_or_default()
}

/// A wall or an obstacle. A polyline is thin, every other shape is solid.
#[derive(Clone, Debug, PartialEq)]
pub struct Wall {
    /// Its name.
    pub name: Name,
    /// Its shape.
    pub shape: Shape,
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
