//! A learning curve: the return against ticks, and below it the minterms seen.

use super::chart::{self, LEFT, RIGHT, crisp};
use super::page::{self, Head, Page};
use super::paint::{Rule, rule};
use super::scale::Axis;

/// A point of the curve.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Ticks simulated so far.
    pub ticks: u64,
    /// The return.
    pub mean: f64,
    /// An interval around it.
    pub interval: [f64; 2],
    /// Minterms seen so far.
    pub minterms: usize,
}

/// The picture in px.
const SIZE: [f64; 2] = [720.0, 420.0];
/// From the top to the foot of the two panels.
const RETURN: [f64; 2] = [40.0, 264.0];
const MINTERMS: [f64; 2] = [304.0, 370.0];

const RULES: &[Rule] = &[
    chart::GRID,
    chart::AXIS,
    rule("band", "fill:#0072b2;fill-opacity:.16", "fill:#56b4e9"),
    rule(
        "mean",
        "fill:none;stroke:#0072b2;stroke-width:2;stroke-linejoin:round;stroke-linecap:round",
        "stroke:#56b4e9",
    ),
    rule("dot", "fill:#0072b2", "fill:#56b4e9"),
    rule(
        "seen",
        "fill:none;stroke:#d55e00;stroke-width:1.5;stroke-linejoin:round;stroke-linecap:round",
        "stroke:#e69f00",
    ),
];

/// The curve of a learner. Points whose return is not finite are left out.
///
/// `caption` says what was learned; `interval` what the band is, such as `95 % interval`.
pub fn curve(points: &[Point], caption: &str, interval: &str) -> String {
    let finite =
        |point: &&Point| point.mean.is_finite() && point.interval.iter().all(|end| end.is_finite());
    let points: Vec<&Point> = points.iter().filter(finite).collect();
    let mut page = Page::new(&Head {
        class: "btc-curve",
        width: SIZE[0],
        height: SIZE[1],
        title: &format!("learning curve: {caption}"),
        description: &description(&points, interval),
        rules: RULES,
    });
    let all = |value: fn(&Point) -> [f64; 2]| chart::ends(points.iter().map(|point| value(point)));
    let ticks = all(|point| [0.0, point.ticks as f64]).unwrap_or([0.0, 1.0]);
    let returns = all(|p| [p.interval[0].min(p.mean), p.interval[1].max(p.mean)]);
    let minterms = all(|point| [0.0, point.minterms as f64]).unwrap_or([0.0, 1.0]);
    let x = Axis::new(ticks, [LEFT, RIGHT], 8.0).tight(ticks);
    let [top, foot] = RETURN;
    let y = Axis::new(returns.unwrap_or([0.0, 1.0]), [foot, top], 6.0);
    panel(&x, &y, RETURN, &mut page);
    let at = |value: fn(&Point) -> f64| {
        let place = move |point: &&Point| (point.ticks as f64, value(point));
        points
            .iter()
            .map(place)
            .map(|(ticks, value)| [x.at(ticks), y.at(value)])
    };
    let band = at(|point| point.interval[1]).chain(at(|point| point.interval[0]).rev());
    if !points.is_empty() {
        page.path("band", page::chain(band) + "Z");
    }
    page.path("mean", page::chain(at(|point| point.mean)));
    for point in at(|point| point.mean) {
        page.circle("dot", point, 2.5);
    }
    page.path("band", swatch(top - 20.0, 5.0) + "Z");
    page.path("mean", swatch(top - 20.0, 0.0));
    page.text(
        "remark",
        LEFT + 26.0,
        top - 16.0,
        &format!("return, {interval}"),
    );
    page.text("remark end", RIGHT, top - 16.0, caption);

    let [top, foot] = MINTERMS;
    let y = Axis::new(minterms, [foot, top], 2.0);
    panel(&x, &y, MINTERMS, &mut page);
    let seen = points
        .iter()
        .map(|point| [x.at(point.ticks as f64), y.at(point.minterms as f64)]);
    page.path("seen", page::chain(seen));
    page.path("seen", swatch(top - 16.0, 0.0));
    page.text("remark", LEFT + 26.0, top - 12.0, "minterms seen");
    chart::numbers(&mut page, &x, foot, "ticks");
    page.finish()
}

/// A piece of a line or of a band, in front of its name.
fn swatch(y: f64, half: f64) -> String {
    let [left, right] = [LEFT, LEFT + 18.0];
    if half == 0.0 {
        return page::chain([[left, y], [right, y]]);
    }
    let [top, foot] = [y - half, y + half];
    page::chain([[left, top], [right, top], [right, foot], [left, foot]])
}

/// The picture in words: where the curve begins and where it ends.
fn description(points: &[&Point], interval: &str) -> String {
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return "no points".to_owned();
    };
    let [low, high] = last.interval;
    format!(
        "The return goes from {:.3} after {} ticks to {:.3} ({interval} {low:.3} to {high:.3}) after {} ticks; {} \
         minterms were seen.",
        first.mean, first.ticks, last.mean, last.ticks, last.minterms
    )
}

/// Grid and axes of a panel, with the numbers on the left.
fn panel(x: &Axis, y: &Axis, [top, foot]: [f64; 2], page: &mut Page) {
    for (at, _) in x.marks() {
        page.line("grid", [crisp(at), top], [crisp(at), foot]);
    }
    chart::rows(page, y);
    chart::axes(page, [top, foot]);
}
