//! What a robot did in an episode, and how its way is drawn.

use super::page::{self, Page};
use super::paint::HUES;
use super::view::View;
use crate::geometry::Point;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::program::Event;
use std::collections::BTreeMap;

/// Where a robot stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stand {
    /// Its centre in metres.
    pub position: Point,
    /// Its heading in radians.
    pub heading: f64,
}

/// A tick.
#[derive(Clone, Debug, PartialEq)]
pub struct TrackTick {
    /// The behaviour that drove the robot or, where none did, was ticked last.
    pub behavior: Option<Id<Behavior>>,
    /// Where the robot stood after it.
    pub stand: Stand,
    /// What happened in it.
    pub events: Vec<Id<Event>>,
}

/// An episode, or its beginning.
///
/// A behaviour has its colour by its place among the choices, an event its mark by its place in the program, so that all
/// pictures of a task have the same legend.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// The behaviours that there are to choose.
    pub choices: Vec<Id<Behavior>>,
    /// Where the robot stood before the first tick.
    pub start: Stand,
    /// The ticks.
    pub steps: Vec<TrackTick>,
    /// The ways of the other robots, in the order of their declaration.
    pub others: Vec<Vec<Stand>>,
}

/// Points nearer than this are drawn as one, in px.
const NEAR: f64 = 0.75;
/// From one arrowhead on the way to the next, in px.
const ARROWS: f64 = 110.0;

impl Track {
    /// The behaviours of the ticks with the numbers of their colours, in that order.
    pub(super) fn behaviors(&self) -> BTreeMap<usize, Id<Behavior>> {
        let behaviors = self.steps.iter().filter_map(|step| step.behavior);
        behaviors
            .map(|behavior| (self.color(behavior), behavior))
            .collect()
    }

    /// The number of a behaviour's colour.
    fn color(&self, behavior: Id<Behavior>) -> usize {
        let chosen = self.choices.iter().position(|choice| *choice == behavior);
        chosen.unwrap_or(self.choices.len() + behavior.index())
    }

    /// How often each event happened, of those that did, in the order of the program.
    pub(super) fn events(&self) -> BTreeMap<Id<Event>, usize> {
        let mut counts = BTreeMap::new();
        for event in self.steps.iter().flat_map(|step| &step.events) {
            *counts.entry(*event).or_default() += 1;
        }
        counts
    }

    /// Where the robot stood last.
    pub(super) fn end(&self) -> Stand {
        self.steps.last().map_or(self.start, |step| step.stand)
    }

    /// Draws the way: a line for each stretch under one behaviour, with arrowheads; a dot where the robot did not
    /// leave its place.
    pub(super) fn draw(&self, view: &View, page: &mut Page) {
        let mut from = self.start;
        let mut left = ARROWS / 2.0;
        for stretch in self.steps.chunk_by(|a, b| a.behavior == b.behavior) {
            let behavior = stretch.first().and_then(|step| step.behavior);
            let class = behavior.map_or("way".to_owned(), |behavior| {
                format!("way {}", hue(self.color(behavior)))
            });
            let stands = stretch.iter().map(|step| step.stand);
            let points = thinned(
                std::iter::once(from)
                    .chain(stands)
                    .map(|s| view.at(s.position)),
            );
            let arrows = arrowheads(&points, &mut left);
            page.path(&class, page::chain(points) + &arrows);
            from = stretch.last().map_or(from, |step| step.stand);
        }
    }
}

/// The way of another robot.
pub(super) fn draw_other(way: &[Stand], view: &View, page: &mut Page) {
    let points = thinned(way.iter().map(|stand| view.at(stand.position)));
    let arrows = arrowheads(&points, &mut (ARROWS / 2.0));
    page.path("way", page::chain(points) + &arrows);
}

/// Arrowheads along a line; `left` is how far it is to the next one.
fn arrowheads(points: &[Point], left: &mut f64) -> String {
    let mut d = String::new();
    for ([x0, y0], [x1, y1]) in points.iter().zip(points.iter().skip(1)) {
        let [dx, dy] = [x1 - x0, y1 - y0];
        let length = (dx * dx + dy * dy).sqrt();
        *left -= length;
        if *left > 0.0 || length == 0.0 {
            continue;
        }
        *left = ARROWS;
        let [dx, dy] = [dx / length, dy / length];
        let wing = |side: f64| [x1 - 5.0 * dx - side * dy, y1 - 5.0 * dy + side * dx];
        d += &page::chain([wing(3.5), [*x1, *y1], wing(-3.5)]);
    }
    d
}

/// The classes of the `i`-th colour; the colours come round again with dashes.
pub(super) fn hue(i: usize) -> String {
    let dashes = if (i / HUES).is_multiple_of(2) {
        ""
    } else {
        " dashed"
    };
    format!("line{}{dashes}", i % HUES)
}

/// The first point, the last, and those between that are not too near one another.
fn thinned(points: impl Iterator<Item = Point>) -> Vec<Point> {
    let mut kept: Vec<Point> = Vec::new();
    let mut last = None;
    for point in points {
        last = Some(point);
        let far = |[x, y]: &Point| (point[0] - x).abs().max((point[1] - y).abs()) >= NEAR;
        if kept.last().is_none_or(far) {
            kept.push(point);
        }
    }
    if kept.last() != last.as_ref() || kept.len() == 1 {
        kept.extend(last);
    }
    kept
}
