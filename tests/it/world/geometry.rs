//! The geometry of the inner loop beside parry's, on random worlds.

use btc::geometry::{Point, Shape, crosses_itself, doubled_area};
use btc::ir::world::{Contact, Drive, DriveKind, Robot, Wall, World};
use btc::ir::{Name, Table};
use btc::random::Random;
use btc::world::Scene;
use parry2d_f64::math::{Pose, Rotation, Vector};
use parry2d_f64::query::{PointQuery, Ray, intersection_test};
use parry2d_f64::shape::{Ball, Capsule, ConvexPolygon, Polyline, Segment, SharedShape};
use parry2d_f64::utils::point_in_poly2d;
use proptest::prelude::*;
use std::f64::consts::{PI, TAU};

/// A random world and its obstacles as parry has them.
pub(crate) struct Twin {
    pub(crate) world: World,
    pub(crate) obstacles: Vec<SharedShape>,
}

pub(crate) fn vector(p: Point) -> Vector {
    Vector::new(p[0], p[1])
}

fn chain(points: &[Point], closed: bool) -> SharedShape {
    let mut points: Vec<_> = points.iter().map(|&p| vector(p)).collect();
    if closed {
        points.push(points[0]);
    }
    SharedShape::new(Polyline::new(points, None))
}

/// A regular polygon of n corners, dented if it is to be.
fn polygon(random: &mut Random, center: Point, radius: f64, n: u64, dented: bool) -> Vec<Point> {
    let turn = random.uniform(0.0, TAU);
    (0..n)
        .map(|i| {
            let (sin, cos) = btc::math::sin_cos(turn + TAU * i as f64 / n as f64);
            let r = if dented && i % 2 == 1 {
                0.6 * radius
            } else {
                radius
            };
            [center[0] + r * cos, center[1] + r * sin]
        })
        .collect()
}

pub(crate) fn twin(random: &mut Random, contact: Contact) -> Twin {
    let mut obstacles = Vec::new();
    let mut walls = Table::default();
    for _ in 0..random.below(5) {
        let c = [random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)];
        let size = random.uniform(0.1, 0.8);
        let shape = match random.below(4) {
            0 => Shape::Disc {
                center: c,
                radius: size,
            },
            1 => Shape::Rect {
                min: [c[0] - size, c[1] - 0.1],
                max: [c[0] + size, c[1] + 0.1],
            },
            2 => {
                let dented = random.chance(0.5);
                Shape::Polygon(polygon(random, c, size, 6, dented))
            }
            _ => Shape::Polyline(
                (0..3)
                    .map(|_| [random.uniform(-2.5, 2.5), random.uniform(-2.5, 2.5)])
                    .collect(),
            ),
        };
        obstacles.push(parry_of(&shape));
        walls.push(Wall {
            name: Name::default(),
            shape,
            when: None,
        });
    }
    let arena = match random.below(4) {
        0 => Shape::Disc {
            center: [0.1, 0.2],
            radius: 3.0,
        },
        1 => Shape::Rect {
            min: [-3.0, -2.0],
            max: [3.0, 2.5],
        },
        2 => Shape::Polygon(polygon(random, [0.0, 0.0], 3.5, 5, false)),
        _ => Shape::Polygon(polygon(random, [0.0, 0.0], 4.5, 8, true)),
    };
    if !matches!(arena, Shape::Disc { .. }) {
        obstacles.push(parry_of(&arena));
    }
    Twin {
        world: World {
            name: Name::default(),
            tick: 0.1,
            arena,
            walls,
            places: Table::default(),
            others: Table::default(),
            robot: Robot {
                name: Name::default(),
                radius: 0.15,
                drive: Drive {
                    kind: DriveKind::Holonomic,
                    max_speed: 100.0,
                    max_turn: 10.0,
                    speed_noise: 0.0,
                    turn_noise: 0.0,
                },
                contact,
                sensors: Table::default(),
            },
        },
        obstacles,
    }
}

/// A disc as parry's ball, the outline of any other shape.
fn parry_of(shape: &Shape) -> SharedShape {
    match shape {
        Shape::Disc { center, radius } => SharedShape::compound(vec![(
            Pose::from_translation(vector(*center)),
            SharedShape::new(Ball::new(*radius)),
        )]),
        Shape::Rect {
            min: [x0, y0],
            max: [x1, y1],
        } => chain(&[[*x0, *y0], [*x1, *y0], [*x1, *y1], [*x0, *y1]], true),
        Shape::Polygon(points) => chain(points, true),
        Shape::Polyline(points) => chain(points, false),
    }
}

impl Twin {
    /// The distance from a free point to the nearest obstacle.
    pub(crate) fn distance(&self, p: Point) -> f64 {
        let round = match self.world.arena {
            Shape::Disc { center, radius } => radius - vector(p).distance(vector(center)),
            _ => f64::INFINITY,
        };
        self.obstacles
            .iter()
            .map(|o| o.distance_to_local_point(vector(p), true))
            .fold(round, f64::min)
    }

    fn ray(&self, p: Point, u: Point) -> f64 {
        let round = match self.world.arena {
            // The far root, from inside.
            Shape::Disc { center, radius } => {
                let to = vector(p) - vector(center);
                let ahead = to.dot(vector(u));
                -ahead + (ahead * ahead + radius * radius - to.dot(to)).sqrt()
            }
            _ => f64::INFINITY,
        };
        self.obstacles
            .iter()
            .filter_map(|o| o.cast_local_ray(&Ray::new(vector(p), vector(u)), 1e3, true))
            .fold(round, f64::min)
    }

    /// Whether a disc that goes from one point to another hits a wall or the arena's boundary.
    pub(crate) fn hits(&self, p: Point, q: Point, radius: f64) -> bool {
        let path = Capsule::new(vector(p), vector(q), radius);
        let outside = match self.world.arena {
            Shape::Disc { center, radius: r } => vector(q).distance(vector(center)) > r - radius,
            _ => false,
        };
        outside
            || self.obstacles.iter().any(|o| {
                intersection_test(&Pose::IDENTITY, &path, &Pose::IDENTITY, o.as_ref())
                    .unwrap()
                    .intersecting
            })
    }
}

/// Free points of a world.
pub(crate) fn free(scene: &Scene, random: &mut Random, radius: f64) -> Option<Point> {
    (0..1000)
        .map(|_| [random.uniform(-4.5, 4.5), random.uniform(-4.5, 4.5)])
        .find(|&p| scene.is_free(p, radius))
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() < 1e-7 || a == b
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn nearest_walls_and_rays_are_parrys(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let twin = twin(random, Contact::Stop);
        let scene = Scene::new(&twin.world);
        for _ in 0..20 {
            let Some(p) = free(&scene, random, 0.01) else { break };
            let [x, y] = scene.nearest(p);
            let (ours, parrys) = (btc::math::hypot(x, y), twin.distance(p));
            prop_assert!(close(ours, parrys), "nearest of {p:?}: {ours} not {parrys}");

            let (sin, cos) = btc::math::sin_cos(random.uniform(-PI, PI));
            let (ours, parrys) = (scene.ray(p, [cos, sin]), twin.ray(p, [cos, sin]));
            prop_assert!(close(ours, parrys), "ray from {p:?}: {ours} not {parrys}");
        }
    }

    /// Sight ends at the first wall, at the boundary only where the arena is not convex.
    #[test]
    fn sight_is_a_ray_cast(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let twin = twin(random, Contact::Stop);
        let scene = Scene::new(&twin.world);
        for _ in 0..20 {
            let (Some(p), Some(q)) = (free(&scene, random, 0.01), free(&scene, random, 0.01)) else { break };
            let path = Segment::new(vector(p), vector(q));
            let hidden = twin.obstacles.iter().any(|o| {
                intersection_test(&Pose::IDENTITY, &path, &Pose::IDENTITY, o.as_ref()).unwrap().intersecting
            });
            prop_assert_eq!(scene.sees(p, q), !hidden, "from {:?} to {:?}", p, q);
        }
    }

    /// No ray in the sector meets anything nearer than what a scanner finds.
    #[test]
    fn a_scanner_reads_the_nearest_echo_of_its_sector(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let twin = twin(random, Contact::Stop);
        let scene = Scene::new(&twin.world);
        for _ in 0..4 {
            let Some(p) = free(&scene, random, 0.05) else { break };
            let heading = random.uniform(-PI, PI);
            let from = random.uniform(-PI, PI);
            let width = [PI, random.uniform(0.1, PI)][random.below(2) as usize];
            let unit = |angle: f64| {
                let (sin, cos) = btc::math::sin_cos(angle);
                [cos, sin]
            };
            let sector = [(unit(from), unit(from + width))];
            let range = 2.0;
            let found = scene.scan(p, unit(heading), &sector, range);
            let ours = found.map_or(range, |[x, y]| btc::math::hypot(x, y));
            let rays = 500;
            let least = (0..=rays)
                .map(|i| heading + from + width * f64::from(i) / f64::from(rays))
                .map(|angle| twin.ray(p, unit(angle)))
                .fold(range, f64::min);
            prop_assert!(ours <= least + 1e-7, "{ours} misses what a ray meets at {least}");
            // What it found is there, and in the sector.
            if let Some([x, y]) = found {
                let off = twin.distance([p[0] + x, p[1] + y]);
                prop_assert!(off.abs() < 1e-7, "nothing is at {x}, {y}: {off} beside");
                let middle = heading + from + 0.5 * width;
                let bearing = btc::math::wrap(btc::math::atan2(y, x) - middle);
                prop_assert!(bearing.abs() <= 0.5 * width + 1e-7);
            }
        }
    }

    /// A step is free where parry's capsule along it touches nothing.
    #[test]
    fn a_free_step_is_a_capsule_that_touches_nothing(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let twin = twin(random, Contact::Stop);
        let scene = Scene::new(&twin.world);
        let radius = 0.15;
        for _ in 0..20 {
            let Some(p) = free(&scene, random, radius) else { break };
            let step = [random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0)];
            let q = [p[0] + step[0], p[1] + step[1]];
            let free = scene.is_free_along(p, step, radius);
            // Parry's answer with a little less and a little more body: one of them has to agree.
            let (thin, thick) = (twin.hits(p, q, radius - 1e-6), twin.hits(p, q, radius + 1e-6));
            prop_assert!(free != thin || free != thick, "from {p:?} to {q:?}: free {free}, {thin}, {thick}");
        }
    }
}

proptest! {
    #[test]
    fn a_polygon_contains_what_parrys_contains(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let corners = polygon(random, [0.3, -0.2], 2.0, 8, true);
        let twin: Vec<Vector> = corners.iter().map(|&p| vector(p)).collect();
        let shape = Shape::Polygon(corners);
        for _ in 0..50 {
            let p = [random.uniform(-2.0, 2.5), random.uniform(-2.5, 2.0)];
            prop_assert_eq!(shape.contains(p), point_in_poly2d(vector(p), &twin), "{:?}", p);
        }
        prop_assert!(!shape.is_convex());
        let [x, y] = shape.center();
        prop_assert!(close(x, 0.3) && close(y, -0.2), "the centre is {x}, {y}");
    }

    /// A regular polygon crosses itself once two neighbours among its corners are exchanged.
    #[test]
    fn exchanged_corners_cross(seed: u64) {
        let random = &mut Random::new(seed, 0, 0);
        let n = 4 + random.below(6);
        let mut corners = polygon(random, [1.0, 1.0], 1.5, n, false);
        prop_assert!(!crosses_itself(&corners));
        prop_assert!(doubled_area(&corners) > 0.0);
        corners.swap(1, 2);
        prop_assert!(crosses_itself(&corners));
    }
}

#[test]
fn polygons_that_touch_themselves_cross() {
    let spike = [[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [1.0, 0.0], [0.0, 2.0]];
    assert!(crosses_itself(&spike));
    let twice = [
        [0.0, 0.0],
        [2.0, 0.0],
        [2.0, 1.0],
        [1.5, 0.0],
        [0.5, 0.0],
        [0.0, 1.0],
    ];
    assert!(crosses_itself(&twice));
}

#[test]
fn extents() {
    let rectangle = Shape::Rect {
        min: [1.0, 0.0],
        max: [3.0, 1.0],
    };
    assert_eq!(rectangle.bounds(), ([1.0, 0.0], [3.0, 1.0]));
    assert_eq!(rectangle.reach(PI), 1.0);
    assert!(close(rectangle.reach(PI / 4.0), 0.5f64.sqrt()));
    let disc = Shape::Disc {
        center: [1.0, 2.0],
        radius: 0.5,
    };
    assert_eq!(disc.bounds(), ([0.5, 1.5], [1.5, 2.5]));
    assert_eq!(disc.reach(2.0), 0.5);
    // The centroid is not the middle of the rectangle around it.
    let corner = Shape::Polygon(vec![[0.0, 0.0], [3.0, 0.0], [0.0, 3.0]]);
    assert_eq!(corner.center(), [1.0, 1.0]);
    assert_eq!(corner.reach(0.0), 2.0);
    // A line is as thin as it is.
    let line = Shape::Polyline(vec![[0.0, 1.0], [4.0, 1.0]]);
    assert_eq!(line.bounds(), ([0.0, 1.0], [4.0, 1.0]));
    assert_eq!((line.reach(0.0), line.reach(PI / 2.0)), (2.0, 0.0));
}

/// A rectangle turned by parry is the polygon of its corners.
#[test]
fn a_solid_rectangle_and_its_polygon_are_one() {
    let corners = [[1.0, 1.0], [2.0, 1.0], [2.0, 3.0], [1.0, 3.0]];
    let solid = ConvexPolygon::from_convex_polyline(corners.map(vector).to_vec()).unwrap();
    let random = &mut Random::new(1, 0, 0);
    let mut twin = twin(random, Contact::Stop);
    twin.world.arena = Shape::Rect {
        min: [-9.0, -9.0],
        max: [9.0, 9.0],
    };
    twin.world.walls = [Wall {
        name: Name::default(),
        shape: Shape::Rect {
            min: [1.0, 1.0],
            max: [2.0, 3.0],
        },
        when: None,
    }]
    .into_iter()
    .collect();
    let scene = Scene::new(&twin.world);
    let pose = Pose::from_parts(Vector::ZERO, Rotation::IDENTITY);
    for _ in 0..1000 {
        let p = [random.uniform(-4.0, 4.0), random.uniform(-4.0, 4.0)];
        let inside = solid.contains_point(&pose, vector(p));
        assert_eq!(scene.is_free(p, 0.0), !inside, "{p:?}");
    }
}
