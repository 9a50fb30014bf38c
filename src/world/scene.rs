//! Everything that stands in the way: the walls and the arena's boundary, as segments and circles.

use super::gaps::Gaps;
use super::sight::Sight;
use crate::geometry::{Circle, Point, Segment, Shape, along, cross, dot, limit, minus, turned};
use crate::ir::world::World;

/// A world's obstacles, for a robot that is inside the arena and outside the walls.
#[derive(Clone, Debug)]
pub struct Scene {
    arena: Arena,
    /// The arena's shape, for what is asked rarely.
    shape: Shape,
    /// The arena's boundary, where it is straight.
    boundary: Vec<Segment>,
    /// The walls' outlines.
    segments: Vec<Segment>,
    /// The round walls.
    circles: Vec<Circle>,
    /// The walls that have an inside.
    solids: Vec<Shape>,
    /// The parts of each wall, whether it stands or not.
    walls: Vec<Parts>,
    /// Whether the arena's boundary never comes between two points of the arena.
    convex: bool,
}

/// The parts of a wall.
#[derive(Clone, Debug)]
struct Parts {
    segments: Vec<Segment>,
    circle: Option<Circle>,
    solid: Option<Shape>,
    /// Whether it stands now.
    stands: bool,
}

impl Parts {
    fn new(shape: &Shape) -> Self {
        Self {
            segments: shape.outline(),
            circle: shape.rim(),
            solid: Some(shape.clone()).filter(|shape| !matches!(shape, Shape::Polyline(_))),
            stands: true,
        }
    }

    /// The vector from `p` to its nearest point.
    fn nearest(&self, p: Point) -> Point {
        let mut best = Best::default();
        for segment in &self.segments {
            best.offer(segment.nearest(p));
        }
        if let Some(circle) = &self.circle {
            best.offer(circle.nearest(p));
        }
        best.vector
    }
}

/// The arena as the inner loop tests it.
#[derive(Clone, Copy, Debug)]
enum Arena {
    Rect(Point, Point),
    Disc(Circle),
    /// Anything else: by its boundary.
    Polygon,
}

/// The sector of a scanner: one or two parts of at most half a turn, each from a direction on the right to one on the
/// left, as unit vectors relative to the heading.
pub(super) type Sector = Vec<(Point, Point)>;

impl Scene {
    /// The obstacles of a world.
    pub fn new(world: &World) -> Self {
        let walls = world.walls.values();
        let mut scene = Self {
            arena: match world.arena {
                Shape::Rect { min, max } => Arena::Rect(min, max),
                Shape::Disc { center, radius } => Arena::Disc(Circle { center, radius }),
                _ => Arena::Polygon,
            },
            shape: world.arena.clone(),
            boundary: world.arena.outline(),
            segments: Vec::new(),
            circles: Vec::new(),
            solids: Vec::new(),
            walls: walls.map(|wall| Parts::new(&wall.shape)).collect(),
            convex: world.arena.is_convex(),
        };
        scene.erect();
        scene
    }

    /// Collects what stands.
    fn erect(&mut self) {
        let standing = || self.walls.iter().filter(|wall| wall.stands);
        let segments = standing().flat_map(|wall| &wall.segments).copied();
        let circles = standing().filter_map(|wall| wall.circle);
        let solids = standing().filter_map(|wall| wall.solid.clone());
        let (segments, circles) = (segments.collect(), circles.collect());
        let solids = solids.collect();
        (self.segments, self.circles, self.solids) = (segments, circles, solids);
    }

    /// Lets walls stand or not, as `stands` says of each by its number.
    pub(super) fn set(&mut self, stands: impl Fn(usize) -> Option<bool>) {
        for (number, wall) in self.walls.iter_mut().enumerate() {
            wall.stands = stands(number).unwrap_or(wall.stands);
        }
        self.erect();
    }

    /// Whether a wall stands.
    pub(super) fn stands(&self, wall: usize) -> bool {
        self.walls.get(wall).is_some_and(|wall| wall.stands)
    }

    /// Whether a disc of this radius at `p` is clear of a wall, which may stand or not.
    pub(super) fn is_clear_of(&self, wall: usize, p: Point, radius: f64) -> bool {
        self.walls.get(wall).is_none_or(|wall| {
            let nearest = wall.nearest(p);
            dot(nearest, nearest) >= radius * radius
                && !wall.solid.as_ref().is_some_and(|solid| solid.contains(p))
        })
    }

    /// Whether every point of the arena sees every other: nothing can come between them.
    pub fn is_open(&self) -> bool {
        self.convex && self.segments.is_empty() && self.circles.is_empty()
    }

    /// Whether no wall meets the segment between two points of the arena.
    #[inline]
    pub fn sees(&self, p: Point, q: Point) -> bool {
        !self.segments.iter().any(|segment| segment.meets(p, q))
            && !self.circles.iter().any(|circle| circle.meets(p, q))
            && (self.convex || !self.boundary.iter().any(|segment| segment.meets(p, q)))
    }

    /// The sight of a fixed point, for a robot whose centre is never nearer than `kept` to what stands.
    pub(super) fn sight(&self, point: Point, kept: f64) -> Sight {
        let boundary = match self.convex {
            true => &[],
            false => self.boundary.as_slice(),
        };
        let (min, max) = self.bounds();
        let [width, height] = minus(max, min);
        let size = width + height;
        Sight::new(point, self.segments.iter().chain(boundary), kept, size)
    }

    /// Whether no wall stands between `p` and the point of a sight, as [`Scene::sees`] says, and how far `p` may go in any
    /// direction before that can change.
    pub(super) fn sees_while(&self, p: Point, point: Point, sight: &Sight) -> (bool, f64) {
        let (mut seen, mut reach) = sight.look(p);
        for circle in &self.circles {
            let (meets, while_here) = circle.meets_while(p, point);
            (seen, reach) = match (seen, meets) {
                (true, true) => (false, while_here),
                (true, false) => (true, reach.min(while_here)),
                (false, true) => (false, reach.max(while_here)),
                (false, false) => (false, reach),
            };
        }
        (seen, reach.max(0.0))
    }

    /// The vector from `p` to the nearest point of a wall or of the arena's boundary.
    #[inline]
    pub fn nearest(&self, p: Point) -> Point {
        let mut best = Best::default();
        match self.arena {
            Arena::Rect(min, max) => {
                let x = nearer(min[0] - p[0], max[0] - p[0]);
                let y = nearer(min[1] - p[1], max[1] - p[1]);
                best.offer(if y.abs() < x.abs() {
                    [0.0, y]
                } else {
                    [x, 0.0]
                });
            }
            Arena::Disc(circle) => best.offer(circle.nearest(p)),
            Arena::Polygon => {
                for segment in &self.boundary {
                    best.offer(segment.nearest(p));
                }
            }
        }
        for segment in &self.segments {
            best.offer(segment.nearest(p));
        }
        for circle in &self.circles {
            best.offer(circle.nearest(p));
        }
        best.vector
    }

    /// The vector from `p` to the nearest point of one wall, and whether it stands and no other wall comes between.
    pub fn nearest_of(&self, wall: usize, p: Point) -> (Point, bool) {
        let Some(one) = self.walls.get(wall) else {
            return (Best::default().vector, false);
        };
        let nearest = one.nearest(p);
        let q = along(p, 1.0, nearest);
        let others = self.walls.iter().enumerate();
        let mut others = others.filter(|&(i, other)| i != wall && other.stands);
        let hidden = others.any(|(_, other)| {
            other.segments.iter().any(|segment| segment.meets(p, q))
                || other.circle.is_some_and(|circle| circle.meets(p, q))
        });
        let outside = !self.convex && self.boundary.iter().any(|segment| segment.meets(p, q));
        (nearest, one.stands && !hidden && !outside)
    }

    /// The straight parts of what stands, the boundary's first.
    #[inline(always)]
    fn straight(&self) -> impl Iterator<Item = &Segment> {
        self.boundary.iter().chain(&self.segments)
    }

    /// The round parts of what stands, the boundary first.
    #[inline(always)]
    fn round(&self) -> impl Iterator<Item = &Circle> {
        let arena = match &self.arena {
            Arena::Disc(circle) => Some(circle),
            _ => None,
        };
        arena.into_iter().chain(&self.circles)
    }

    /// How many parts there are, the straight ones counted first.
    pub(super) fn parts(&self) -> usize {
        self.straight().count() + self.round().count()
    }

    /// A straight part by its number.
    fn part(&self, number: usize) -> Option<&Segment> {
        match number.checked_sub(self.boundary.len()) {
            None => self.boundary.get(number),
            Some(number) => self.segments.get(number),
        }
    }

    /// The vector from `p` to the nearest point of a wall or of the arena's boundary within a sector relative to the
    /// heading, whose cosine and sine are given, and nearer than `range`.
    pub fn scan(
        &self,
        p: Point,
        heading: Point,
        sector: &[(Point, Point)],
        range: f64,
    ) -> Option<Point> {
        let (gaps, lead) = (&mut Gaps::default(), &mut 0);
        self.scan_with(p, heading, sector, range, gaps, lead)
    }

    /// As [`Scene::scan`], without those parts that `gaps` knows to be too far. `lead` is the number of the part that was nearest
    /// before: with it as the first, most others are. Neither changes the result, which is the first of the shortest vectors.
    #[inline]
    pub(super) fn scan_with(
        &self,
        p: Point,
        heading: Point,
        sector: &[(Point, Point)],
        range: f64,
        gaps: &mut Gaps,
        lead: &mut usize,
    ) -> Option<Point> {
        let mut best = Best::within(range);
        let count = self.boundary.len() + self.segments.len();
        for (round, &(right, left)) in sector.iter().enumerate() {
            let right = turned(heading, right);
            let left = turned(heading, left);
            let within = |segment: &Segment, whole: Point| {
                if cross(right, whole) >= 0.0 && cross(whole, left) >= 0.0 {
                    Some(whole)
                } else {
                    segment.nearest_within(p, right, left)
                }
            };
            // Of equal ones the first counts.
            let first = round * (count + 1 + self.circles.len());
            let before = *lead;
            if let Some(segment) = self.part(before) {
                let found = within(segment, segment.nearest(p));
                best.offer_numbered(first + before, found);
            }
            for (number, segment) in self.straight().enumerate() {
                if number == before || gaps.is_beyond(number, best.square) {
                    continue;
                }
                // Few segments are clipped: most are too far, or their nearest point is in the sector.
                let whole = segment.nearest(p);
                if !gaps.finds_beyond(number, dot(whole, whole), best.square) {
                    best.offer_numbered(first + number, within(segment, whole));
                }
            }
            for (number, circle) in (count..).zip(self.round()) {
                if gaps.is_beyond(number, best.square) {
                    continue;
                }
                let whole = circle.nearest(p);
                if !gaps.finds_beyond(number, dot(whole, whole), best.square) {
                    let found = circle.nearest_within(p, right, left);
                    best.offer_numbered(first + number, found);
                }
            }
            if best.square < range * range && best.number >= first {
                *lead = best.number - first;
            }
        }
        (best.square < range * range).then_some(best.vector)
    }

    /// How far a ray from `p` in the direction of the unit vector `u` goes before it meets a wall or the arena's
    /// boundary.
    pub fn ray(&self, p: Point, u: Point) -> f64 {
        self.ray_within(p, u, f64::INFINITY)
    }

    /// As [`Scene::ray`], where that is less than `range`; `range` where it is not.
    #[inline]
    pub(super) fn ray_within(&self, p: Point, u: Point, range: f64) -> f64 {
        let mut best = range;
        for segment in self.straight() {
            let s = segment.ray(p, u);
            best = if s < best { s } else { best };
        }
        for circle in self.round() {
            let s = circle.ray(p, u);
            best = if s < best { s } else { best };
        }
        best
    }

    /// Whether a disc of this radius can go from `p` to `p + step` without touching anything, `p` being free.
    pub fn is_free_along(&self, p: Point, step: Point, radius: f64) -> bool {
        let q = along(p, 1.0, step);
        let square = radius * radius;
        // What is farther from `p` than the way and the radius together cannot be met; a hair is added for rounding.
        let reach = (radius + dot(step, step).sqrt()) * (1.0 + 1e-9);
        let apart = |segment: &Segment| {
            let nearest = segment.nearest(p);
            dot(nearest, nearest) > reach * reach || segment.gap_square(p, step) >= square
        };
        let arena = match self.arena {
            // A convex arena: it is enough that the end is free.
            Arena::Rect(min, max) => (0..2).all(|i| match (q.get(i), min.get(i), max.get(i)) {
                (Some(q), Some(min), Some(max)) => *q >= min + radius && *q <= max - radius,
                _ => false,
            }),
            Arena::Disc(circle) => {
                let from = minus(q, circle.center);
                let reach = circle.radius - radius;
                reach >= 0.0 && dot(from, from) <= reach * reach
            }
            Arena::Polygon => self.boundary.iter().all(apart),
        };
        arena
            && self.segments.iter().all(apart)
            && self.circles.iter().all(|circle| {
                let reach = circle.radius + radius;
                circle.center_gap_square(p, step) >= reach * reach
            })
    }

    /// Whether a disc of this radius at `p` is inside the arena and touches nothing.
    pub fn is_free(&self, p: Point, radius: f64) -> bool {
        p.iter().all(|c| c.is_finite())
            && self.shape.contains(p)
            && !self.solids.iter().any(|solid| solid.contains(p))
            && self.is_free_along(p, [0.0; 2], radius)
    }

    /// The corners of a rectangle around the arena.
    pub fn bounds(&self) -> (Point, Point) {
        self.shape.bounds()
    }

    /// `p` pulled back into a round arena, so that a disc of this radius touches its boundary from inside; `p` where
    /// the arena is not round.
    pub(super) fn pulled_in(&self, p: Point, radius: f64) -> Point {
        match self.arena {
            Arena::Disc(circle) => {
                let from = minus(p, circle.center);
                let reach = (circle.radius - radius) * (1.0 - 1e-12);
                let scale = limit(reach / dot(from, from).sqrt(), 0.0, 1.0);
                along(circle.center, scale, from)
            }
            _ => p,
        }
    }
}

/// The one of less magnitude.
#[inline(always)]
fn nearer(a: f64, b: f64) -> f64 {
    if b.abs() < a.abs() { b } else { a }
}

/// The shortest of several vectors.
#[derive(Clone, Copy, Debug)]
struct Best {
    square: f64,
    vector: Point,
    /// The number of what it leads to, where those are counted.
    number: usize,
}

impl Default for Best {
    fn default() -> Self {
        Self {
            square: f64::INFINITY,
            vector: [f64::INFINITY, 0.0],
            number: 0,
        }
    }
}

impl Best {
    fn within(range: f64) -> Self {
        Self {
            square: range * range,
            ..Self::default()
        }
    }

    #[inline(always)]
    fn offer(&mut self, vector: Point) {
        let square = dot(vector, vector);
        if square < self.square {
            (self.square, self.vector) = (square, vector);
        }
    }

    /// Takes a vector that is shorter, or as short and of a lower number.
    #[inline(always)]
    fn offer_numbered(&mut self, number: usize, vector: Option<Point>) {
        let Some(vector) = vector else {
            return;
        };
        let square = dot(vector, vector);
        if square < self.square || square == self.square && number < self.number {
            *self = Self {
                square,
                vector,
                number,
            };
        }
    }
}
