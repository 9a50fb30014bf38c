//! A world to scale, with the way of its robot.

use super::legend::{self, Entry, Legend, Sign};
use super::page::{self, Attributes, Head, Page, number};
use super::paint::{LINES, Rule, rule};
use super::scale;
use super::track::{self, Stand, Track};
use super::view::{self, View};
use crate::geometry::{Point, Shape};
use crate::ir::Program;
use crate::ir::name;
use crate::ir::world::{Place, Robot, SensorKind, World};

/// Around everything.
const MARGIN: f64 = 20.0;
/// The arena is at most this wide and high.
const LARGEST: Point = [600.0, 480.0];
/// Between the arena and the legend.
const GUTTER: f64 = 26.0;
/// Below the arena: the scale and the caption.
const FOOT: f64 = 22.0;

const RULES: &[Rule] = &[
    rule(
        "arena",
        "fill:#f7f9fa;stroke:#37474f;stroke-width:2",
        "fill:#161c23;stroke:#9fb0bc",
    ),
    rule(
        "solid",
        "fill:#b4c0c8;stroke:#37474f",
        "fill:#45525d;stroke:#9fb0bc",
    ),
    rule(
        "wall",
        "fill:none;stroke:#37474f;stroke-width:3;stroke-linejoin:round;stroke-linecap:round",
        "stroke:#c3d0d9",
    ),
    rule(
        "place",
        "fill:#ffe8b8;stroke:#c98f1d",
        "fill:#40330f;stroke:#c98f1d",
    ),
    rule("thin", "fill:none;stroke-width:4;stroke-opacity:.6", ""),
    rule(
        "facing",
        "fill:none;stroke:#a06c00;stroke-width:1.5;stroke-linecap:round;stroke-linejoin:round",
        "stroke:#f0b74a",
    ),
    rule("label", "font-weight:600", ""),
    rule(
        "halo",
        "stroke:#ffffff;stroke-width:3;stroke-linejoin:round",
        "stroke:#0d1117",
    ),
    rule(
        "sector",
        "fill:#56b4e9;fill-opacity:.06;stroke:#56b4e9;stroke-opacity:.5;stroke-dasharray:3 3",
        "",
    ),
    rule(
        "way",
        "fill:none;stroke:#8a979f;stroke-width:1.5;stroke-linecap:round;stroke-linejoin:round;stroke-opacity:.85",
        "",
    ),
    rule(
        "swatch",
        "fill:none;stroke-width:3;stroke-linecap:round",
        "",
    ),
    rule("dashed", "stroke-dasharray:5 4", ""),
    rule(
        "start",
        "fill:#ffffff;fill-opacity:.4;stroke:#37474f;stroke-dasharray:3 2",
        "fill:#0d1117;stroke:#c3d0d9",
    ),
    rule(
        "last",
        "fill:#ffffff;fill-opacity:.4;stroke:#1f2933;stroke-width:1.5",
        "fill:#0d1117;stroke:#e6edf3",
    ),
    rule(
        "nose",
        "stroke:#1f2933;stroke-width:1.5;stroke-linecap:round",
        "stroke:#e6edf3",
    ),
    rule(
        "mark",
        "fill:#ffffff;stroke:#1f2933;stroke-linejoin:round",
        "fill:#0d1117;stroke:#e6edf3",
    ),
    rule("measure", "fill:none;stroke:#5b6770", "stroke:#9aa7b2"),
];

/// A world, and the way of its robot if one is given. The caption stands below; it says whose way that is.
pub fn world(program: &Program, world: &World, caption: &str, track: Option<&Track>) -> String {
    let view = View::new(&world.arena, [MARGIN, MARGIN], LARGEST);
    let legend = legend(program, world, track);
    let beside = match legend.width() {
        0.0 => 0.0,
        width => GUTTER + width,
    };
    let foot = Foot::new(&view, caption);
    let wide = (view.size[0] + beside).max(foot.right - MARGIN);
    let high = (view.size[1] + FOOT).max(legend.height());
    let rules: Vec<Rule> = RULES.iter().chain(&LINES).copied().collect();
    let mut page = Page::new(&Head {
        class: "btc-world",
        width: (2.0 * MARGIN + wide).ceil(),
        height: 2.0 * MARGIN + high,
        title: &format!("world {}", world.name),
        description: &description(program, world, caption, track),
        rules: &rules,
    });
    page.path("arena", view.outline(&world.arena));
    if let Some(track) = track {
        sensors(&world.robot, &track.start, &view, &mut page);
    }
    for place in world.places.values() {
        draw_place(place, &view, &mut page);
    }
    for wall in world.walls.values() {
        let thin = matches!(wall.shape, Shape::Polyline(_));
        let class = match (thin, wall.when.is_some()) {
            (true, false) => "wall",
            (true, true) => "wall dashed",
            (false, false) => "solid",
            (false, true) => "solid dashed",
        };
        let outline = view.outline(&wall.shape);
        titled(&mut page, &wall.name.to_string(), class, outline);
    }
    if let Some(track) = track {
        for (other, way) in world.others.values().zip(&track.others) {
            draw_other(&other.robot, way, &view, &mut page);
        }
        track.draw(&view, &mut page);
        let radius = world.robot.radius * view.scale;
        for (class, stand) in [("start", track.start), ("last", track.end())] {
            let ahead = view::along(stand.heading);
            legend::robot(class, view.at(stand.position), ahead, radius, &mut page);
        }
        for step in &track.steps {
            for event in &step.events {
                legend::mark(event.index(), view.at(step.stand.position), &mut page);
            }
        }
    }
    for place in world.places.values() {
        name_place(place, &view, wide + 2.0 * MARGIN, &mut page);
    }
    foot.draw(MARGIN + view.size[1] + 17.5, caption, &mut page);
    legend.draw([MARGIN + view.size[0] + GUTTER, MARGIN], &mut page);
    page.finish()
}

/// The picture in words.
fn description(program: &Program, world: &World, caption: &str, track: Option<&Track>) -> String {
    let places = name::list(world.places.values().map(|place| &place.name));
    let mut text = format!("{caption}. Places: {places}.");
    if let Some(track) = track {
        for (event, count) in track.events() {
            text.push_str(&format!(" {}: {count}.", program.events[event].name));
        }
    }
    text
}

fn legend(program: &Program, world: &World, track: Option<&Track>) -> Legend {
    let Some(track) = track else {
        return Legend(Vec::new());
    };
    let entry = |sign: Sign, name: String| Entry { sign, name };
    let behaviors = track.behaviors().into_iter();
    let events = track.events().into_iter();
    let sensors = name::list(world.robot.sensors.values().map(|sensor| &sensor.name));
    let mut robot = vec![
        entry(Sign::Robot("start"), "start".to_owned()),
        entry(Sign::Robot("last"), "end".to_owned()),
    ];
    if !sensors.is_empty() {
        robot.push(entry(Sign::Sector, sensors));
    }
    Legend(vec![
        (
            "behaviour",
            behaviors
                .map(|(i, id)| {
                    let name = program.behaviors[id].name.to_string();
                    entry(Sign::Line(track::hue(i)), name)
                })
                .collect(),
        ),
        (
            "event",
            events
                .map(|(id, count)| {
                    let name = &program.events[id].name;
                    entry(Sign::Mark(id.index()), format!("{name} × {count}"))
                })
                .collect(),
        ),
        ("robot", robot),
    ])
}

/// Another robot with its way, and its name where it stood last.
fn draw_other(robot: &Robot, way: &[Stand], view: &View, page: &mut Page) {
    track::draw_other(way, view, page);
    let Some(last) = way.last() else {
        return;
    };
    let (at, radius) = (view.at(last.position), robot.radius * view.scale);
    legend::robot("last", at, view::along(last.heading), radius, page);
    let name = robot.name.to_string();
    named(page, at[0], at[1] + radius + 13.0, &name);
}

/// A name with a halo under it, which parts it from what is drawn there; each is a text of its own, since not every renderer knows
/// an order of painting within one.
fn named(page: &mut Page, x: f64, y: f64, name: &str) {
    page.text("name label halo middle", x, y, name);
    page.text("name label middle", x, y, name);
}

/// A path that shows its name when it is pointed at.
fn titled(page: &mut Page, name: &str, class: &str, d: String) {
    page.open("g", &[]);
    page.note("title", name);
    page.path(class, d);
    page.close();
}

/// A place, and an arrow on its rim that points where a robot should look.
fn draw_place(place: &Place, view: &View, page: &mut Page) {
    let thin = matches!(place.shape, Shape::Polyline(_));
    let class = if thin { "place thin" } else { "place" };
    titled(
        page,
        &place.name.to_string(),
        class,
        view.outline(&place.shape),
    );
    let Some(facing) = place.facing else {
        return;
    };
    let [dx, dy] = view::along(facing);
    let reach = place.shape.reach(facing) * view.scale;
    let [x, y] = view.at(place.shape.center());
    let ahead = |far: f64, aside: f64| [x + far * dx - aside * dy, y + far * dy + aside * dx];
    let tip = reach + 7.0;
    let head = [
        ahead(tip - 4.0, -3.5),
        ahead(tip, 0.0),
        ahead(tip - 4.0, 3.5),
    ];
    let shaft = [ahead(reach - 3.0, 0.0), ahead(tip, 0.0)];
    page.path("facing", page::chain(shaft) + &page::chain(head));
}

/// The name of a place: in it where it is wide enough, else beside it, away from where a robot should look.
fn name_place(place: &Place, view: &View, wide: f64, page: &mut Page) {
    let name = place.name.to_string();
    let text = page::width(&name);
    let (low, high) = place.shape.bounds();
    let [[left, foot], [right, top]] = [view.at(low), view.at(high)];
    let [x, y] = view.at(place.shape.center());
    let down = place
        .facing
        .is_some_and(|facing| view::along(facing)[1] > 0.5);
    let baseline = if text + 4.0 <= right - left && foot - top >= 14.0 {
        y + 4.0
    } else if down {
        top - 6.0
    } else {
        foot + 15.0
    };
    let x = x.min(wide - text / 2.0 - 4.0).max(text / 2.0 + 4.0);
    named(page, x, baseline, &name);
}

/// What the sensors of a robot cover from where it stands, within the arena.
fn sensors(robot: &Robot, stand: &Stand, view: &View, page: &mut Page) {
    if robot.sensors.is_empty() {
        return;
    }
    let [width, height] = view.size;
    let part = [MARGIN, MARGIN, width, height].map(number).join(" ");
    let clip: Attributes = &[
        ("x", MARGIN.into()),
        ("y", MARGIN.into()),
        ("width", width.into()),
        ("height", height.into()),
        ("viewBox", part.into()),
    ];
    // A picture in the picture shows only what lies within it.
    page.open("svg", clip);
    let at = view.at(stand.position);
    for sensor in robot.sensors.values() {
        let area = match sensor.kind {
            SensorKind::Scanner { from, to, range } => {
                let [from, to] = [from, to].map(|bearing| stand.heading + bearing);
                view::sector(at, range * view.scale, from, to)
            }
            SensorKind::RangeFinder { at: bearing, range } => {
                let [dx, dy] = view::along(stand.heading + bearing);
                let far = range * view.scale;
                page::chain([at, [at[0] + far * dx, at[1] + far * dy]])
            }
            SensorKind::Beacon {
                target,
                range,
                facing,
                sector,
            } => {
                let [from, to] = [facing - sector / 2.0, facing + sector / 2.0];
                view::sector(view.at(target), range * view.scale, from, to)
            }
        };
        titled(page, &sensor.name.to_string(), "sector", area);
    }
    page.close();
}

/// What stands below the arena: the scale on the left, the caption up to the right.
struct Foot {
    /// The length of the scale in px.
    length: f64,
    /// What the scale measures.
    label: String,
    /// Where the caption ends.
    right: f64,
}

impl Foot {
    fn new(view: &View, caption: &str) -> Self {
        let (metres, places) = scale::round_up(60.0 / view.scale);
        let length = (metres * view.scale).round();
        let label = format!("{metres:.places$} m");
        let text = length + page::width(&label) + GUTTER + page::width(caption);
        Self {
            length,
            label,
            right: MARGIN + text.max(view.size[0]),
        }
    }

    fn draw(&self, y: f64, caption: &str, page: &mut Page) {
        let [left, right] = [MARGIN + 0.5, MARGIN + 0.5 + self.length];
        let ends = page::chain([[left, y - 4.0], [left, y + 4.0]])
            + &page::chain([[left, y], [right, y]])
            + &page::chain([[right, y - 4.0], [right, y + 4.0]]);
        page.path("measure", ends);
        page.text("remark", right + 7.0, y + 4.0, &self.label);
        page.text("remark end", self.right, y + 4.0, caption);
    }
}
