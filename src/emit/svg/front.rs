//! The front of trees: return against nodes.

use super::chart::{self, LEFT, RIGHT};
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
const TOP: f64 = 40.0;
const FOOT: f64 = 264.0;

const RULES: &[Rule] = &[
    chart::GRID,
    chart::AXIS,
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

/// The front, the smallest tree first. `caption` says what was learned, `proved` whether the tree that was taken is proved.
pub fn front(dots: &[Dot], caption: &str, proved: bool) -> String {
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
    let nodes = chart::ends(dots.iter().map(|dot| [dot.nodes as f64; 2])).unwrap_or([0.0, 1.0]);
    let returns = chart::ends(dots.iter().map(|dot| dot.interval)).unwrap_or([0.0, 1.0]);
    let [fewest, most] = [nodes[0] - 1.0, nodes[1] + 1.0];
    // No marks between whole numbers of nodes.
    let x = Axis::new([fewest, most], [LEFT, RIGHT], (most - fewest).min(10.0));
    let y = Axis::new(returns, [FOOT, TOP], 6.0);
    chart::rows(&mut page, &y);
    chart::numbers(&mut page, &x, FOOT, "nodes");
    chart::axes(&mut page, [TOP, FOOT]);
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
    let taken = match proved {
        true => "the large dot is the proved tree, taken",
        false => "the large dot is the tree that was taken",
    };
    let legend = format!("return, 95 % interval, by nodes; {taken}");
    page.text("remark", LEFT, TOP - 16.0, &legend);
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
