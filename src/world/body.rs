//! The robot in its world, as running code sees it.

use super::pose::Pose;
use super::scene::Scene;
use super::sensing::Probe;
use crate::eval::{Host, Reading};
use crate::geometry::Shape;
use crate::random::Random;

/// What senses and is sensed.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    pub(super) scene: Scene,
    pub(super) probes: Vec<Probe>,
    pub(super) places: Vec<Shape>,
}

/// The moving part.
#[derive(Clone, Debug)]
pub(super) struct Body<'a> {
    around: &'a Surroundings,
    pub(super) pose: Pose,
    pub(super) random: Random,
    /// The echo sources whose readings still hold, one bit each.
    fresh: u128,
    /// The echo sources whose readings hold until the robot moves: those without noise.
    steady: u128,
    /// This tick's noise of each sensor, for those that have been read in it.
    noise: Vec<Option<f64>>,
    noisy: bool,
    pub(super) atoms: u128,
    pub(super) fired: Vec<u16>,
}

impl<'a> Body<'a> {
    pub(super) fn new(around: &'a Surroundings, events: usize) -> Self {
        let noisy = |probe: &Probe| probe.noise > 0.0;
        let steady = around
            .probes
            .iter()
            .zip(1..)
            .filter(|(probe, _)| noisy(probe))
            .fold(u128::MAX, |bits, (_, source)| bits & !bit(source));
        Self {
            around,
            pose: Pose::new([0.0; 2], 0.0),
            random: Random::new(0, 0, 0),
            fresh: 0,
            steady,
            noise: vec![None; around.probes.len()],
            noisy: around.probes.iter().any(noisy),
            atoms: 0,
            fired: Vec::with_capacity(events),
        }
    }

    /// The robot has moved: nothing that was read still holds.
    pub(super) fn moved(&mut self) {
        self.fresh = 0;
    }

    /// A new tick: its noise is still to be drawn.
    pub(super) fn tick(&mut self) {
        if self.noisy {
            self.fresh &= self.steady;
            self.noise.fill(None);
        }
    }
}

/// The bit of an echo source; none past 127, whose readings are never kept.
fn bit(source: u16) -> u128 {
    1u128.checked_shl(u32::from(source)).unwrap_or(0)
}

impl Host for Body<'_> {
    #[inline]
    fn visible(&mut self, x: f64, y: f64) -> bool {
        self.around.scene.sees(self.pose.position, [x, y])
    }

    #[inline]
    fn look(&mut self, source: u16) -> Option<Reading> {
        let bit = bit(source);
        if self.fresh & bit != 0 {
            return None;
        }
        self.fresh |= bit;
        let distance = |v: [f64; 2]| (v[0] * v[0] + v[1] * v[1]).sqrt();
        if source == 0 {
            let toward = self.around.scene.nearest(self.pose.position);
            return Some(Reading {
                distance: distance(toward),
                toward,
                seen: true,
            });
        }
        let index = usize::from(source) - 1;
        let Some(probe) = self.around.probes.get(index) else {
            let wall = index - self.around.probes.len();
            let (toward, seen) = self.around.scene.nearest_of(wall, self.pose.position);
            return Some(Reading {
                distance: distance(toward),
                toward,
                seen,
            });
        };
        let mut reading = probe.read(&self.around.scene, &self.pose);
        if probe.noise > 0.0
            && reading.seen
            && let Some(noise) = self.noise.get_mut(index)
        {
            let random = &mut self.random;
            let noise = *noise.get_or_insert_with(|| probe.noise * random.gaussian());
            reading.distance = (reading.distance + noise).max(0.0);
        }
        Some(reading)
    }

    fn inside(&mut self, place: u16) -> bool {
        self.around
            .places
            .get(usize::from(place))
            .is_some_and(|place| place.contains(self.pose.position))
    }

    #[inline]
    fn random(&mut self) -> &mut Random {
        &mut self.random
    }

    fn fire(&mut self, event: u16) {
        self.fired.push(event);
    }

    #[inline]
    fn atom(&mut self, bit: u16, holds: bool) {
        self.atoms |= u128::from(holds) << (bit & 127);
    }
}
