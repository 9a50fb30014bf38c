//! What the sensors read.

use super::gaps::Gaps;
use super::pose::{Pose, rotor};
use super::scene::{Scene, Sector};
use crate::eval::Reading;
use crate::geometry::{Circle, Point, along, dot, minus, turned};
use crate::ir::world::{Sensor, SensorKind};
use crate::math;
use std::f64::consts::PI;

/// A sensor, ready to be read.
#[derive(Clone, Debug)]
pub(super) struct Probe {
    kind: Kind,
    range: f64,
    pub(super) noise: f64,
}

#[derive(Clone, Debug)]
enum Kind {
    Scanner {
        sector: Sector,
        middle: Point,
    },
    RangeFinder {
        at: Point,
    },
    Beacon {
        target: Point,
        facing: Point,
        /// The cosine of half the sector.
        least: f64,
    },
}

impl Probe {
    pub(super) fn new(sensor: &Sensor) -> Self {
        let (kind, range) = match sensor.kind {
            SensorKind::Scanner { from, to, range } => {
                let middle = rotor(0.5 * (from + to));
                let sector = if to - from > PI {
                    vec![(rotor(from), middle), (middle, rotor(to))]
                } else if to - from == PI {
                    let right = rotor(from);
                    vec![(right, [-right[0], -right[1]])]
                } else {
                    vec![(rotor(from), rotor(to))]
                };
                (Kind::Scanner { sector, middle }, range)
            }
            SensorKind::RangeFinder { at, range } => (Kind::RangeFinder { at: rotor(at) }, range),
            SensorKind::Beacon {
                target,
                range,
                facing,
                sector,
            } => {
                let least = math::cos((0.5 * sector).min(PI));
                let facing = rotor(facing);
                (
                    Kind::Beacon {
                        target,
                        facing,
                        least,
                    },
                    range,
                )
            }
        };
        Self {
            kind,
            range,
            noise: sensor.noise,
        }
    }

    /// The reading without noise; `bodies` are other robots, which echo as walls do. Where nothing echoes the distance is the range, towards the middle of the sector.
    ///
    /// `gaps` and `lead` are what is remembered of the scene and of the last reading: they change nothing but the time.
    #[inline]
    pub(super) fn read(
        &self,
        scene: &Scene,
        bodies: &[Circle],
        pose: &Pose,
        gaps: &mut Gaps,
        lead: &mut usize,
    ) -> Reading {
        let p = pose.position;
        let (echo, otherwise) = match &self.kind {
            Kind::Scanner { sector, middle } => {
                let mut echo = scene.scan_with(p, pose.ahead, sector, self.range, gaps, lead);
                for (body, &(right, left)) in bodies
                    .iter()
                    .flat_map(|body| sector.iter().map(move |part| (body, part)))
                {
                    let (right, left) = (turned(pose.ahead, right), turned(pose.ahead, left));
                    let least = echo.map_or(self.range * self.range, |echo| dot(echo, echo));
                    let nearer = body.nearest_within(p, right, left);
                    echo = nearer.filter(|v| dot(*v, *v) < least).or(echo);
                }
                (echo, *middle)
            }
            Kind::RangeFinder { at } => {
                let u = turned(pose.ahead, *at);
                let met = bodies.iter().map(|body| body.ray(p, u));
                let s = met.fold(scene.ray_within(p, u, self.range), f64::min);
                ((s < self.range).then(|| along([0.0; 2], s, u)), *at)
            }
            Kind::Beacon {
                target,
                facing,
                least,
            } => {
                let to = minus(*target, p);
                let distance = dot(to, to).sqrt();
                let heard = distance <= self.range
                    && -dot(to, *facing) >= distance * least
                    && scene.sees(p, *target);
                (heard.then_some(to), [1.0, 0.0])
            }
        };
        match echo {
            Some(vector) => Reading {
                distance: dot(vector, vector).sqrt(),
                toward: vector,
                seen: true,
            },
            None => Reading {
                distance: self.range,
                toward: turned(pose.ahead, otherwise),
                seen: false,
            },
        }
    }
}
