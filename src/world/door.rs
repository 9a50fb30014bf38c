//! Walls that stand under a condition.
//!
//! Their conditions are asked once a tick, after effects and before predicates. One that does no longer hold opens its wall
//! at once. One that holds closes it as soon as no robot is in the way, so that none is ever caught.

use super::scene::Scene;
use crate::eval::{Compiler, TooLarge};
use crate::geometry::Point;
use crate::ir::ExprId;
use crate::ir::world::World;

/// A wall that stands under a condition.
#[derive(Clone, Copy, Debug)]
pub(super) struct Door {
    /// The number of the wall.
    wall: usize,
    /// When it is to stand.
    pub(super) when: ExprId,
}

/// The most doors of a world: a bit each.
pub(super) const MOST: usize = 128;

impl Door {
    /// The doors of a world.
    pub(super) fn all(world: &World) -> Vec<Self> {
        let walls = world.walls.values().enumerate();
        let doors = walls.filter_map(|(wall, it)| it.when.map(|when| Self { wall, when }));
        doors.collect()
    }

    /// Reports which doors are to stand, a bit each.
    pub(super) fn read(
        doors: impl Iterator<Item = ExprId>,
        compiler: &mut Compiler<'_>,
    ) -> Result<(), TooLarge> {
        doors
            .zip(0..)
            .try_for_each(|(when, bit)| compiler.atom(bit, when))
    }

    /// Lets doors stand or not as the bits of `wanted` say; those that robots, each a position and a radius, are in the way
    /// of stay open. Whether anything changed.
    pub(super) fn swing(
        doors: &[Self],
        wanted: u128,
        scene: &mut Scene,
        robots: &[(Point, f64)],
    ) -> bool {
        let mut changes = Vec::new();
        for (door, bit) in doors.iter().zip(0..) {
            let wanted = wanted >> bit & 1 == 1;
            let clear =
                |&(position, radius): &(Point, f64)| scene.is_clear_of(door.wall, position, radius);
            if wanted != scene.stands(door.wall) && (!wanted || robots.iter().all(clear)) {
                changes.push((door.wall, wanted));
            }
        }
        if changes.is_empty() {
            return false;
        }
        scene.set(|wall| {
            let change = changes.iter().find(|(changed, _)| *changed == wall);
            change.map(|(_, stands)| *stands)
        });
        true
    }
}
