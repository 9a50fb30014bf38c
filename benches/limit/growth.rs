//! What a tick costs as a world grows: with 0 to 64 of each thing that a program can have more of.

use super::{median, program, speed, start};
use btc::ir::Program;
use btc::learn::episode::play;
use std::fmt::Write;

/// How many of them there are.
const COUNTS: [usize; 5] = [0, 1, 4, 16, 64];

/// A thing that a world can have more of: its name and the program with so many of it.
type Grown = (&'static str, fn(usize) -> String);

const GROWN: [Grown; 5] = [
    ("walls, none asked for", |n| {
        world(&walls(n), "", "", "roam")
    }),
    ("walls, with a range finder", |n| {
        let sensor = "sensor ahead = range_finder(at = 0 deg, range = 20 m)\n";
        world(
            &walls(n),
            sensor,
            "predicate near_0 = distance(ahead) < 50 cm\n",
            "roam",
        )
    }),
    ("range finders, each in a predicate", |n| {
        let (mut sensors, mut asked) = (String::new(), String::new());
        for i in 0..n {
            let turn = i as f64 * 360.0 / n as f64;
            writeln!(
                sensors,
                "sensor s{i} = range_finder(at = {turn:.1} deg, range = 20 m)"
            )
            .unwrap();
            writeln!(asked, "predicate near_{i} = distance(s{i}) < 50 cm").unwrap();
        }
        world(&walls(4), &sensors, &asked, "roam")
    }),
    ("predicates over the pose", |n| {
        let mut asked = String::new();
        for i in 0..n {
            let at = 0.2 * (i + 1) as f64;
            writeln!(asked, "predicate near_{i} = position.x < {at:.1} m").unwrap();
        }
        world("", "", &asked, "roam")
    }),
    ("behaviours, one of them ticked", |n| {
        let mut more = String::new();
        for i in 0..n {
            writeln!(
                more,
                "behavior more_{i} {{ control {{ drive(speed = {i} cm/s, turn = 0 rad/s) }} }}"
            )
            .unwrap();
        }
        world("", "", &more, "roam")
    }),
];

/// Walls of half a metre on a grid.
fn walls(n: usize) -> String {
    let mut text = String::new();
    for i in 0..n {
        let (x, y) = ((1 + 2 * (i % 8)) as f64, (1 + 2 * (i / 8)) as f64);
        writeln!(
            text,
            "wall w{i} = polyline(({x} m, {y} m), ({} m, {y} m))",
            x + 0.5
        )
        .unwrap();
    }
    text
}

/// A robot that drives about in a hall of 17 m by 17 m and turns back from what it touches.
fn world(walls: &str, sensors: &str, items: &str, tree: &str) -> String {
    let asked: Vec<_> = items
        .lines()
        .filter_map(|line| line.strip_prefix("predicate "))
        .filter_map(|line| line.split(' ').next())
        .collect();
    let more: String = items
        .lines()
        .filter_map(|line| line.strip_prefix("behavior "))
        .filter_map(|line| line.split(' ').next())
        .map(|name| format!(", {name}"))
        .collect();
    let asked = match asked.is_empty() {
        true => "blocked".to_owned(),
        false => format!("blocked, {}", asked.join(", ")),
    };
    format!(
        "use std
world hall {{
    tick = 100 ms
    arena = rect((0 m, 0 m), (17 m, 17 m))
    {walls}
    robot cart {{
        body = disc(17 cm)
        drive = differential(max_speed = 0.5 m/s, max_turn = 2 rad/s)
        contact = stop
        {sensors}
    }}
}}
behavior roam {{
    control {{ drive(speed = 0.5 m/s, turn = if touching {{ 2 rad/s }} else {{ 0.1 rad/s }}) }}
}}
event bumped = touching
predicate blocked = touching
{items}
task roaming {{
    observe {asked}
    choose roam{more}
    end after 5000 ticks
    reward {{ otherwise: 0 }}
}}
tree expert for roaming = {tree}
"
    )
}

/// The median time of a tick in nanoseconds.
fn cost(program: &Program, rounds: u64) -> f64 {
    let (simulator, tree) = super::world(program);
    let (mut simulation, mut controller) = (simulator.simulation(), tree);
    let mut round = |round: u64| {
        let episodes = round * 8..(round + 1) * 8;
        let played =
            episodes.map(|it| play(&mut simulation, &mut controller, start(it), None).ticks);
        played.sum::<u64>()
    };
    median((0..rounds).map(|at| 1e9 / speed(|| round(at))).collect())
}

/// Prints what a tick costs with so many of each thing.
pub fn tables(rounds: u64) {
    println!();
    print!("| ns a tick with so many");
    COUNTS.iter().for_each(|count| print!(" | {count}"));
    println!(" | for each |");
    println!("| --- {}| ---: |", "| ---: ".repeat(COUNTS.len()));
    for (name, text) in GROWN {
        let costs: Vec<f64> = COUNTS
            .iter()
            .map(|&count| cost(&program(&text(count)), rounds))
            .collect();
        print!("| {name}");
        costs.iter().for_each(|cost| print!(" | {cost:.0}"));
        let (first, last) = (costs[0], costs[costs.len() - 1]);
        let each = (last - first) / COUNTS[COUNTS.len() - 1] as f64;
        println!(" | {:.1} |", each.max(0.0));
    }
}
