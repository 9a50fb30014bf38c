//! The robot in its world, as running code sees it.

use super::gaps::Gaps;
use super::pose::Pose;
use super::scene::Scene;
use super::sensing::Probe;
use super::sight::Sight;
#[cfg(doc)]
use crate::eval::Fixed;
use crate::eval::{Host, Reading};
use crate::geometry::{Circle, Point, Shape, dot, minus};
use crate::random::Random;

/// What is sensed.
#[derive(Clone, Debug)]
pub(super) struct Surroundings {
    /// The obstacles, every wall standing.
    pub(super) scene: Scene,
    pub(super) places: Vec<Shape>,
    /// How many sensors the numbers of echo sources leave room for.
    pub(super) sensors: usize,
    /// The first register of the lines of sight to fixed points.
    pub(super) sights: u16,
    /// How many such points there are.
    pub(super) points: usize,
}

/// The moving part.
#[derive(Clone, Debug)]
pub(super) struct Body<'a> {
    around: &'a Surroundings,
    probes: &'a [Probe],
    /// The obstacles as they stand now, in a world whose walls may open.
    now: Option<Box<Scene>>,
    /// The other robots, where they stand now.
    pub(super) bodies: Vec<Circle>,
    pub(super) pose: Pose,
    /// How far it has come since it was put somewhere, and how far the obstacles are.
    gaps: Gaps,
    /// What stands around the fixed points that were looked at.
    sights: Vec<Option<Sight>>,
    /// A distance from all walls that it keeps.
    kept: f64,
    /// The number of the obstacle that each sensor measured last.
    leads: Vec<usize>,
    /// The distance to the nearest wall, if it was measured here; 0 if not.
    pub(super) clear: f64,
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
    pub(super) fn new(
        around: &'a Surroundings,
        probes: &'a [Probe],
        radius: f64,
        events: usize,
    ) -> Self {
        let noisy = |probe: &Probe| probe.noise > 0.0;
        let steady = probes
            .iter()
            .zip(1..)
            .filter(|(probe, _)| noisy(probe))
            .fold(u128::MAX, |bits, (_, source)| bits & !bit(source));
        Self {
            around,
            probes,
            now: None,
            bodies: Vec::new(),
            pose: Pose::new([0.0; 2], 0.0),
            gaps: Gaps::new(around.scene.parts()),
            sights: vec![None; around.points],
            // Contact is found to a hair.
            kept: 0.5 * radius,
            leads: vec![0; probes.len()],
            clear: 0.0,
            random: Random::new(0, 0, 0),
            fresh: 0,
            steady,
            noise: vec![None; probes.len()],
            noisy: probes.iter().any(noisy),
            atoms: 0,
            fired: Vec::with_capacity(events),
        }
    }

    /// The obstacles as they stand now.
    #[inline(always)]
    pub(super) fn scene(&self) -> &Scene {
        match &self.now {
            None => &self.around.scene,
            Some(now) => now,
        }
    }

    /// The obstacles and the other robots, with what moves among them.
    #[inline(always)]
    pub(super) fn moving(&mut self) -> (&Scene, &[Circle], &mut Random, &mut Pose) {
        let scene = match &self.now {
            None => &self.around.scene,
            Some(now) => now,
        };
        (scene, &self.bodies, &mut self.random, &mut self.pose)
    }

    /// Obstacles have changed: these stand now, or those of the surroundings.
    pub(super) fn set_scene(&mut self, scene: Option<&Scene>) {
        self.now = scene.map(|scene| Box::new(scene.clone()));
        self.gaps = Gaps::new(self.scene().parts());
        self.sights.fill(None);
        self.moved();
    }

    /// The robot has moved: nothing that was read still holds.
    #[inline(always)]
    pub(super) fn moved(&mut self) {
        self.fresh = 0;
        self.clear = 0.0;
    }

    /// The robot has come here from another position.
    #[inline(always)]
    pub(super) fn came_from(&mut self, before: Point) {
        let gone = minus(self.pose.position, before);
        let square = dot(gone, gone);
        if square > 0.0 {
            self.gaps.go(square.sqrt());
        }
    }

    /// How far it has come since it was put somewhere: see [`Fixed::Path`].
    #[inline(always)]
    pub(super) fn path(&self) -> f64 {
        self.gaps.path()
    }

    /// It has been put somewhere, or what stands has changed.
    pub(super) fn was_put(&mut self) {
        self.gaps.forget();
    }

    /// Reads an echo source: the nearest wall, a sensor, or one of the walls.
    fn read(&mut self, source: u16) -> Reading {
        let of = |toward: [f64; 2], seen| Reading {
            distance: (toward[0] * toward[0] + toward[1] * toward[1]).sqrt(),
            toward,
            seen,
        };
        let Some(index) = usize::from(source).checked_sub(1) else {
            let nearest = of(self.scene().nearest(self.pose.position), true);
            self.clear = nearest.distance;
            return nearest;
        };
        let Some(probe) = self.probes.get(index) else {
            let wall = index.saturating_sub(self.around.sensors);
            let (toward, seen) = self.scene().nearest_of(wall, self.pose.position);
            return of(toward, seen);
        };
        let scene = match &self.now {
            None => &self.around.scene,
            Some(now) => now,
        };
        let (lead, none) = (self.leads.get_mut(index), &mut 0);
        let lead = lead.unwrap_or(none);
        let mut reading = probe.read(scene, &self.bodies, &self.pose, &mut self.gaps, lead);
        if probe.noise > 0.0
            && reading.seen
            && let Some(noise) = self.noise.get_mut(index)
        {
            let random = &mut self.random;
            let noise = *noise.get_or_insert_with(|| probe.noise * random.gaussian());
            reading.distance = (reading.distance + noise).max(0.0);
        }
        reading
    }

    /// A new tick: its noise is still to be drawn.
    #[inline(always)]
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
        self.scene().sees(self.pose.position, [x, y])
    }

    fn sight(&mut self, first: u16, x: f64, y: f64) -> (bool, f64) {
        let scene = match &self.now {
            None => &self.around.scene,
            Some(now) => now,
        };
        let (p, point) = (self.pose.position, [x, y]);
        let number = usize::from(first.saturating_sub(self.around.sights)) / 2;
        let Some(sight) = self.sights.get_mut(number) else {
            return (scene.sees(p, point), 0.0);
        };
        let sight = sight.get_or_insert_with(|| scene.sight(point, self.kept));
        let (seen, reach) = scene.sees_while(p, point, sight);
        (seen, self.gaps.after(reach))
    }

    #[inline]
    fn look(&mut self, source: u16, parts: &mut [f64; 4]) {
        let bit = bit(source);
        if self.fresh & bit == 0 {
            self.fresh |= bit;
            *parts = self.read(source).parts();
        }
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
    fn atoms(&mut self) -> &mut u128 {
        &mut self.atoms
    }
}
