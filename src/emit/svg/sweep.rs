//! What a tree gains at each value of a number that may be tuned.

use super::chart::{self, LEFT, RIGHT};
use super::page::{self, Head, Page};
use super::paint::{Rule, rule};
use super::scale::Axis;

/// A value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// The value.
    pub value: f64,
    /// The gain there.
    pub mean: f64,
    /// An interval around it.
    pub interval: [f64; 2],
    /// Whether it is out of the question, whatever it gains.
    pub out: bool,
}

/// What is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep<'a> {
    /// The values, ascending.
    pub dots: Vec<Dot>,
    /// The unit of the values.
    pub unit: &'a str,
    /// The value in use.
    pub used: f64,
    /// The best value.
    pub best: f64,
    /// From one end of the flat part to the other.
    pub flat: Option<(f64, f64)>,
    /// What is tuned.
    pub caption: &'a str,
}

/// The picture in px, and where the axes lie.
const SIZE: [f64; 2] = [720.0, 320.0];
const TOP: f64 = 40.0;
const FOOT: f64 = 264.0;

const RULES: &[Rule] = &[
    chart::GRID,
    chart::AXIS,
    rule("flat", "fill:#009e73;fill-opacity:.14", ""),
    rule("band", "fill:#0072b2;fill-opacity:.16", "fill:#56b4e9"),
    rule(
        "mean",
        "fill:none;stroke:#0072b2;stroke-width:2;stroke-linejoin:round",
        "stroke:#56b4e9",
    ),
    rule("dot", "fill:#0072b2", "fill:#56b4e9"),
    rule("out", "fill:#d55e00", "fill:#e69f00"),
    rule(
        "used",
        "stroke:#5b6770;stroke-dasharray:4 3",
        "stroke:#9aa7b2",
    ),
    rule("best", "stroke:#009e73;stroke-width:2", ""),
];

/// The gain against the value. What is far below all else is cut off at the foot.
pub fn sweep(sweep: &Sweep) -> String {
    let mut page = Page::new(&Head {
        class: "btc-sweep",
        width: SIZE[0],
        height: SIZE[1],
        title: &format!("gain by value: {}", sweep.caption),
        description: &description(sweep),
        rules: RULES,
    });
    let dots = &sweep.dots;
    let values = dots.iter().map(|dot| dot.value);
    let values = values.filter(|value| value.is_finite());
    let values = chart::ends(values.map(|value| [value; 2])).unwrap_or([0.0, 1.0]);
    let x = Axis::new(values, [LEFT, RIGHT], 10.0).tight(values);
    let y = Axis::new(limits(dots), [FOOT, TOP], 6.0);
    let within = |gain: f64| y.at(gain).clamp(TOP, FOOT);
    if let Some((from, to)) = sweep.flat {
        // Half a value wide where there is but one.
        let half = 2.0;
        let (from, to) = (x.at(from) - half, x.at(to) + half);
        let corners = [[from, TOP], [to, TOP], [to, FOOT], [from, FOOT]];
        page.path("flat", page::chain(corners) + "Z");
    }
    chart::rows(&mut page, &y);
    chart::numbers(&mut page, &x, FOOT, sweep.unit);
    chart::axes(&mut page, [TOP, FOOT]);
    for (class, value) in [("used", sweep.used), ("best", sweep.best)] {
        page.line(class, [x.at(value), TOP], [x.at(value), FOOT]);
    }
    let upper = dots.iter().map(|d| [x.at(d.value), within(d.interval[1])]);
    let lower = dots.iter().map(|d| [x.at(d.value), within(d.interval[0])]);
    page.path("band", page::chain(upper.chain(lower.rev())) + "Z");
    let means = dots.iter().map(|d| [x.at(d.value), within(d.mean)]);
    page.path("mean", page::chain(means));
    for dot in dots {
        let class = if dot.out { "out" } else { "dot" };
        page.circle(class, [x.at(dot.value), within(dot.mean)], 2.5);
    }
    let legend = "gain of return over the value in use (dashed), 95 % interval; the best value, and the flat part";
    page.text("remark", LEFT, TOP - 16.0, legend);
    page.text("name end", RIGHT, TOP - 16.0, sweep.caption);
    page.finish()
}

/// The limits of the gain: losses are shown as far down as four times from the best to the median.
fn limits(dots: &[Dot]) -> [f64; 2] {
    let mut means: Vec<f64> = dots.iter().map(|dot| dot.mean).collect();
    means.retain(|mean| mean.is_finite());
    means.sort_by(f64::total_cmp);
    let median = means.get(means.len() / 2).copied().unwrap_or(0.0);
    let (low, high) = match (means.first(), means.last()) {
        (Some(low), Some(high)) => (*low, *high),
        _ => (0.0, 1.0),
    };
    let depth = 4.0 * (high - median).max((high - low) / 16.0);
    [low.max(high - depth).min(0.0), high.max(0.0)]
}

/// The picture in words.
fn description(sweep: &Sweep) -> String {
    let best = sweep.dots.iter().find(|dot| dot.value == sweep.best);
    let gain = best.map_or(0.0, |dot| dot.mean);
    let flat = match sweep.flat {
        Some((from, to)) => format!("; about as good from {from} to {to}"),
        None => String::new(),
    };
    format!(
        "In use is {}, the best value is {}, which gains {gain:.3}{flat} ({}).",
        sweep.used, sweep.best, sweep.unit
    )
}
