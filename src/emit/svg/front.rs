//! The front of trees: return against nodes.

use super::page::{self, Head, Page};
use super::paint::{Rule, rule};
use super::scale::Axis;

/// A tree of the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// Its nodes.
    pub nodes: usize,
    /// Its return.
    pub mean: f64,
    /// An interval around it.
    pub interval: [f64; 2],
    /// Whether it is the tree that was taken.
    pub taken: bool,
}

/// The picture in px, and where the axes lie.
const SIZE: [f64; 2] = [720.0, 320.0];
const LEFT: f64 = 64.0;
const RIGHT: f64 = 696.0;
const TOP: f64 = 40.0;
const FOOT: f64 = 264.0;

const RULES: &[Rule] = &[
    rule("grid", "stroke:#e3e8ec", "stroke:#222b34"),
    rule("axis", "fill:none;stroke:#8496a3", "stroke:#5f6f7b"),
    rule(
        "mean",
        "fill:none;stroke:#0072b2;stroke-width:1.5",
        "stroke:#56b4e9",
    ),
    rule(
        "whisker",
        "stroke:#0072b2;stroke-opacity:.5",
        "stroke:#56b4e9",
    ),
    rule("dot", "fill:#0072b2", "fill:#56b4e9"),
    rule("taken", "fill:#d55e00", "fill:#e69f00"),
];

/// The front, the smallest tree first. `caption` says what was learned.
pub fn front(dots: &[Dot], caption: &str) -> String {
    let finite =
        |dot: &&Dot| dot.mean.is_finite() && dot.interval.iter().all(|end| end.is_finite());
    let dots: Vec<&Dot> = dots.iter().filter(finite).collect();
    let mut page = Page::new(&Head {
        class: "btc-front",
        width: SIZE[0],
        height: SIZE[1],
        title: &format!("front of trees: {caption}"),
        description: &description(&dots),
        rules: RULES,
    });
    let ends = |of: &dyn Fn(&Dot) -> [f64; 2]| {
        let all = dots.iter().map(|dot| of(dot));
        all.reduce(|[low, high], [l, h]| [low.min(l), high.max(h)])
    };
    let nodes = ends(&|dot| [dot.nodes as f64, dot.nodes as f64]).unwrap_or([0.0, 1.0]);
    let returns = ends(&|dot| dot.interval).unwrap_or([0.0, 1.0]);
    let x = Axis::new([nodes[0] - 1.0, nodes[1] + 1.0], [LEFT, RIGHT], 10.0);
    let y = Axis::new(returns, [FOOT, TOP], 6.0);
    let crisp = |at: f64| at.floor() + 0.5;
    for (at, label) in y.marks() {
        page.line("grid", [LEFT, crisp(at)], [RIGHT, crisp(at)]);
        page.text("remark end", LEFT - 8.0, at + 4.0, &label);
    }
    for (at, label) in x.marks() {
        page.text("remark middle", at, FOOT + 18.0, &label);
    }
    page.text("remark middle", (LEFT + RIGHT) / 2.0, FOOT + 36.0, "nodes");
    let [left, foot] = [LEFT, FOOT].map(crisp);
    page.path(
        "axis",
        page::chain([[left, TOP], [left, foot], [RIGHT, foot]]),
    );
    let place = |dot: &Dot, value: f64| [x.at(dot.nodes as f64), y.at(value)];
    page.path(
        "mean",
        page::chain(dots.iter().map(|dot| place(dot, dot.mean))),
    );
    for dot in &dots {
        let [low, high] = dot.interval;
        page.line("whisker", place(dot, low), place(dot, high));
        let (class, size) = if dot.taken {
            ("taken", 4.5)
        } else {
            ("dot", 3.0)
        };
        page.circle(class, place(dot, dot.mean), size);
    }
    let legend = "return, 95 % interval, by nodes; the tree that was taken is larger";
    page.text("remark", LEFT, TOP - 16.0, legend);
    page.text("name end", RIGHT, TOP - 16.0, caption);
    page.finish()
}

/// The picture in words.
fn description(dots: &[&Dot]) -> String {
    let told = dots.iter().map(|dot| {
        let taken = if dot.taken { ", taken" } else { "" };
        format!("{} nodes return {:.3}{taken}", dot.nodes, dot.mean)
    });
    told.collect::<Vec<_>>().join("; ")
}
