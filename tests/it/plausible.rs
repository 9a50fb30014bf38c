//! Programs as a person writes them, put together from parts that are sound with each other: nothing is said against them.

use crate::program::{NoFiles, shown};
use crate::robust::Dice;
use btc::driver::load::load;

/// How many programs are put together.
const PROGRAMS: usize = 300;

/// As many of a hundred may be warned of.
const WARNED: usize = 1;

/// The parts of a program so far.
#[derive(Default)]
struct Draft {
    world: String,
    robot: String,
    items: String,
    events: String,
    effects: String,
    predicates: String,
    behaviors: String,
    observed: Vec<String>,
    chosen: Vec<String>,
    starts: String,
    ends: String,
    rewards: String,
    /// The units of the tree, the most pressing first.
    units: Vec<String>,
}

/// Adds lines to a part.
macro_rules! add {
    ($part:expr, $($line:tt)*) => {{
        $part.push_str(&format!($($line)*));
        $part.push('\n');
    }};
}

impl Draft {
    /// What is carried from one place to another: every program has it.
    fn errand(&mut self, dice: &mut Dice) {
        let (from, to) = dice
            .pick(&["depot gate", "shelf desk", "sink table", "pit heap"])
            .split_once(' ')
            .unwrap();
        let (left, right) = (3 + dice.roll(8), 60 + dice.roll(8));
        add!(
            self.world,
            "    place {from} = disc(({}.{} m, 1.5 m), {} cm)",
            left / 10,
            left % 10 + 5,
            15 + dice.roll(20)
        );
        add!(
            self.world,
            "    place {to} = rect(({0}.{1} m, 3 m), ({0}.{2} m, 3.4 m))",
            right / 10,
            right % 10,
            right % 10 + 1
        );
        match dice.roll(2) {
            0 => {
                add!(self.items, "state loaded: bool = false");
                add!(
                    self.events,
                    "event picked = success(goto({from})) and not loaded"
                );
                add!(
                    self.events,
                    "event brought = success(goto({to})) and loaded"
                );
                add!(self.effects, "on picked {{ loaded = true }}");
                add!(self.effects, "on brought {{ loaded = false }}");
                add!(self.predicates, "predicate carrying = loaded");
                add!(
                    self.starts,
                    "        loaded = chance({}%)",
                    10 + dice.roll(80)
                );
            }
            _ => {
                let most = 2 + dice.roll(4);
                add!(self.items, "state pieces: number = 0");
                add!(
                    self.events,
                    "event picked = success(goto({from})) and pieces < {most}"
                );
                add!(
                    self.events,
                    "event brought = success(goto({to})) and pieces > 0"
                );
                add!(self.effects, "on picked {{ pieces += 1 }}");
                add!(self.effects, "on brought {{ pieces = 0 }}");
                add!(
                    self.predicates,
                    "predicate carrying = pieces >= {}",
                    1 + dice.roll(2)
                );
            }
        }
        self.observed.push("carrying".to_owned());
        self.chosen
            .extend([format!("goto({from})"), format!("goto({to})")]);
        add!(self.rewards, "        on brought: {}", 1 + dice.roll(9));
        add!(self.rewards, "        on picked: 0.{}", 1 + dice.roll(9));
        self.units
            .extend([format!("carrying => goto({to})"), format!("goto({from})")]);
    }

    fn battery(&mut self, dice: &mut Dice) {
        add!(
            self.world,
            "    place charger = disc((4 m, 0.5 m), 20 cm) facing {} deg",
            90 * dice.roll(4)
        );
        add!(self.items, "state battery: ratio = 100%");
        add!(self.events, "event charged = success(dock(charger))");
        add!(self.events, "event flat = battery <= 0%");
        match dice.roll(2) {
            0 => add!(
                self.effects,
                "each tick {{ battery -= 0.0{}% }}",
                1 + dice.roll(9)
            ),
            _ => add!(
                self.effects,
                "each tick {{\n    battery -= if running(goto(charger)) {{ 0.01% }} else {{ 0.0{}% }}\n}}",
                2 + dice.roll(7)
            ),
        }
        add!(self.effects, "on charged {{ battery = 100% }}");
        add!(
            self.predicates,
            "predicate low = battery < {}%",
            15 + dice.roll(25)
        );
        self.observed.push("low".to_owned());
        self.chosen
            .extend(["goto(charger)".to_owned(), "dock(charger)".to_owned()]);
        add!(
            self.starts,
            "        battery = uniform({}%, 100%)",
            20 + dice.roll(40)
        );
        add!(self.ends, "    end on flat");
        self.rewards
            .insert_str(0, &format!("        on flat: -{}\n", 3 + dice.roll(20)));
        self.units.insert(
            0,
            "low => memory sequence { goto(charger), dock(charger) }".to_owned(),
        );
    }

    fn sensor(&mut self, dice: &mut Dice) {
        let near = 40 + 10 * dice.roll(5);
        add!(
            self.robot,
            "        sensor bow = range_finder(at = 0 deg, range = {} m)",
            2 + dice.roll(3)
        );
        add!(
            self.predicates,
            "predicate blocked = distance(bow) < {near} cm"
        );
        self.observed.push("blocked".to_owned());
        add!(
            self.behaviors,
            "behavior turn_away(rate: turn_rate = {} deg/s) {{",
            40 + dice.roll(40)
        );
        add!(
            self.behaviors,
            "    requires blocked\n    fail when elapsed > {} s",
            3 + dice.roll(6)
        );
        add!(
            self.behaviors,
            "    control {{ drive(speed = 0 m/s, turn = rate) }}\n}}"
        );
        self.chosen.push("turn_away".to_owned());
        self.units.insert(0, "blocked => turn_away".to_owned());
    }

    fn weather(&mut self, dice: &mut Dice) {
        add!(self.items, "enum weather {{ fine, wet, stormy }}");
        add!(
            self.items,
            "state sky: weather = fine\nstate since: time = 0 s"
        );
        add!(
            self.events,
            "event turned = since > {} s",
            10 + dice.roll(60)
        );
        add!(self.effects, "each tick {{ since += tick }}");
        add!(
            self.effects,
            "on turned {{\n    sky = one_of(fine, wet, stormy)\n    since = 0 s\n}}"
        );
        add!(self.predicates, "predicate storm = sky == stormy");
        self.observed.push("storm".to_owned());
        add!(self.world, "    place shelter = disc((4 m, 3.4 m), 30 cm)");
        self.chosen.push("goto(shelter)".to_owned());
        add!(self.starts, "        sky = one_of(fine, wet)");
        add!(
            self.rewards,
            "        while storm, per 1 s: -0.{}",
            1 + dice.roll(5)
        );
        self.units.insert(0, "storm => goto(shelter)".to_owned());
    }

    fn beds(&mut self, dice: &mut Dice) {
        let beds = &["north", "south", "east"][..2 + dice.roll(2)];
        for (at, bed) in beds.iter().enumerate() {
            add!(
                self.world,
                "    place {bed}: bed = disc(({}.5 m, 2.5 m), 25 cm)",
                2 + 2 * at
            );
        }
        add!(self.items, "state dry(b: bed): ratio = {}%", dice.roll(40));
        add!(
            self.items,
            "let thirstiest = nearest(b in bed: dry(b) > 50%)"
        );
        add!(
            self.events,
            "event watered(b: bed) = success(tend) and inside(b)"
        );
        add!(
            self.effects,
            "each tick {{\n    for b in bed {{ dry(b) = min(dry(b) + 0.0{}%, 100%) }}\n}}",
            1 + dice.roll(9)
        );
        add!(self.effects, "on watered(b: bed) {{ dry(b) = 0% }}");
        add!(self.predicates, "predicate parched(b: bed) = dry(b) > 50%");
        add!(self.behaviors, "behavior tend = goto(thirstiest)");
        self.chosen.push("tend".to_owned());
        add!(self.starts, "        dry(b in bed) = uniform(0%, 80%)");
        add!(
            self.rewards,
            "        on watered(b in bed): {}",
            1 + dice.roll(3)
        );
        match dice.roll(2) {
            0 => {
                add!(
                    self.predicates,
                    "predicate any_parched = any(b in bed: parched(b))"
                );
                self.observed.push("any_parched".to_owned());
                self.units.insert(0, "any_parched => tend".to_owned());
            }
            _ => {
                self.observed.push("parched(b in bed)".to_owned());
                self.units
                    .insert(0, "parched(north) or parched(south) => tend".to_owned());
            }
        }
    }

    fn wandering(&mut self, dice: &mut Dice) {
        add!(
            self.behaviors,
            "/// A straight line for a while.\nbehavior ahead(pace: speed = {} cm/s, lasts: time = {} s) {{",
            10 + dice.roll(30),
            2 + dice.roll(6)
        );
        add!(
            self.behaviors,
            "    local sway: angle = uniform(-{0} deg, {0} deg)",
            5 + dice.roll(20)
        );
        add!(
            self.behaviors,
            "    requires not touching\n    succeed when elapsed >= lasts"
        );
        add!(
            self.behaviors,
            "    control {{\n        let bend = clamp(1 Hz * sway, max_turn)\n        drive(speed = min(pace, max_speed), turn = bend)\n    }}\n}}"
        );
        self.chosen.push("ahead".to_owned());
        self.units.push("ahead".to_owned());
    }

    /// The text of the program.
    fn text(&self, dice: &mut Dice) -> String {
        let mut text = String::from("use std\n\n");
        let tick = dice.pick(&["50 ms", "100 ms", "200 ms"]);
        add!(
            text,
            "world site {{\n    tick = {tick}\n    arena = rect((0 m, 0 m), (8 m, 4 m))\n{}",
            self.world
        );
        let drive = dice.pick(&["differential", "holonomic"]);
        add!(
            text,
            "    robot porter {{\n        body = disc({} cm)",
            12 + dice.roll(8)
        );
        add!(
            text,
            "        drive = {drive}(max_speed = 0.{} m/s, max_turn = {} rad/s)",
            4 + dice.roll(5),
            1 + dice.roll(4)
        );
        add!(text, "{}    }}\n}}\n", self.robot);
        for part in [
            &self.items,
            &self.events,
            &self.effects,
            &self.predicates,
            &self.behaviors,
        ] {
            add!(text, "{part}");
        }
        add!(
            text,
            "task serve {{\n    observe {}\n    choose {}",
            self.observed.join(", "),
            self.chosen.join(", ")
        );
        let history = dice.pick(&[
            "    history last 1 success\n",
            "    history last 2 success, failure\n",
            "",
        ]);
        add!(
            text,
            "{history}    start {{\n        pose = anywhere\n{}    }}\n{}    end after {} min",
            self.starts,
            self.ends,
            4 + dice.roll(6)
        );
        let time = dice.pick(&["per 1 s: -0.01", "per 1 min: -0.5", "per 10 s: -0.1"]);
        add!(
            text,
            "    reward {{\n{}        {time}\n    }}\n}}\n",
            self.rewards
        );
        let method = dice.pick(&["q_learning", "double_q", "model"]);
        add!(
            text,
            "learn serve {{\n    method = {method}\n    episodes = {}_000\n    explore = {}% -> 3%",
            1 + dice.roll(5),
            20 + dice.roll(40)
        );
        add!(
            text,
            "    discount = {}\n}}\n",
            dice.pick(&["0.95 per decision", "0.9 per 10 s", "0.98 per 1 s"])
        );
        add!(
            text,
            "tree hand for serve = selector {{\n    {},\n}}\n",
            self.units.join(",\n    ")
        );
        add!(
            text,
            "claim hand reaches brought with probability >= {}%",
            10 + dice.roll(60)
        );
        text
    }
}

fn program(seed: u64) -> String {
    let mut dice = Dice(0x9e37_79b9_7f4a_7c15 ^ (seed + 1).wrapping_mul(0x2545_f491_4f6c_dd1d));
    let mut draft = Draft::default();
    draft.errand(&mut dice);
    let parts: [fn(&mut Draft, &mut Dice); 5] = [
        Draft::wandering,
        Draft::weather,
        Draft::beds,
        Draft::sensor,
        Draft::battery,
    ];
    for part in parts {
        if dice.roll(2) == 0 {
            part(&mut draft, &mut dice);
        }
    }
    draft.text(&mut dice)
}

#[test]
fn sound_programs_are_hardly_ever_warned_of() {
    let mut warned = Vec::new();
    for seed in 0..PROGRAMS as u64 {
        let text = program(seed);
        let loaded = load("plausible.bt", text.clone().into(), &mut NoFiles);
        assert!(
            !loaded.has_errors(),
            "seed {seed}\n{text}\n{}",
            shown(&loaded)
        );
        if !loaded.diagnostics.is_empty() {
            warned.push(format!("seed {seed}\n{text}\n{}", shown(&loaded)));
        }
    }
    let first = warned
        .iter()
        .take(3)
        .map(String::as_str)
        .collect::<String>();
    assert!(
        100 * warned.len() <= WARNED * PROGRAMS,
        "{}: {first}",
        warned.len()
    );
}
