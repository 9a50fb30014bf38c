//! Worlds: walls, doors, places and robots, each in a cell of its own.

use super::author::{Author, Type};
use std::fmt::Write as _;

/// Cells of one metre.
const COLUMNS: usize = 6;
const ROWS: usize = 4;

impl Author {
    /// The world, and the conditions of its doors.
    pub(super) fn world(&mut self, out: &mut String) {
        let mut cells: Vec<(usize, usize)> = (0..COLUMNS)
            .flat_map(|x| (0..ROWS).map(move |y| (x, y)))
            .collect();
        for last in (1..cells.len()).rev() {
            let other = self.below(last + 1);
            cells.swap(last, other);
        }
        let mut cell = || cells.pop().unwrap();
        let tick = self.pick(&["50 ms", "100 ms", "200 ms"]);
        let _ = writeln!(out, "world place_of_work {{\n    tick = {tick}");
        let arena = self.pick(&[
            "rect((-0.5 m, -0.5 m), (6.5 m, 4.5 m))",
            "disc((3 m, 2 m), 4.2 m)",
            "polygon((-1 m, -0.5 m), (3 m, -1 m), (6.5 m, -0.5 m), (6.5 m, 4.5 m), (-1 m, 4.5 m))",
        ]);
        let _ = writeln!(out, "    arena = {arena}");
        for _ in 0..self.count(0, 3) {
            let (name, shape) = (self.name("wall"), self.shape(cell(), true));
            let _ = writeln!(out, "    wall {name} = {shape}");
            self.has.walls.push(name);
        }
        for _ in 0..self.below(3) {
            let (name, shape) = (self.name("gate"), self.shape(cell(), true));
            let _ = writeln!(
                out,
                "    wall {name}: door = {shape} when shut({name}) and not inside(post)"
            );
            self.has.walls.push(name.clone());
            self.has.doors.push(name);
        }
        let _ = writeln!(out, "    place post = {}", self.shape(cell(), false));
        self.has.places.push("post".to_owned());
        for kind in ["tree", "shop"] {
            let mut members = Vec::new();
            for _ in 0..self.count(1, 3) {
                let (name, shape) = (self.name(kind), self.shape(cell(), false));
                let facing = self.pick(&["", " facing 90 deg", " facing -45 deg"]);
                let _ = writeln!(out, "    place {name}: {kind}s = {shape}{facing}");
                if !facing.is_empty() {
                    self.has.facing.push(name.clone());
                }
                self.has.places.push(name.clone());
                members.push(name);
            }
            let kind = if kind == "tree" { "trees" } else { "shops" };
            self.has.kinds.push((kind, members));
        }
        self.robot(out, "worker", None);
        for _ in 0..self.below(3) {
            let name = self.name("other");
            let runs = self.pick(&["roam", "stalk", "attend(post)", "wander"]);
            self.robot(out, &name, Some(runs));
            self.has.robots.push(name);
            self.has.scripts.push(runs);
        }
        out.push_str("}\n\n");
    }

    /// A shape that stays in its cell.
    fn shape(&mut self, (column, row): (usize, usize), wall: bool) -> String {
        let (x, y) = (column as f64 + 0.5, row as f64 + 0.5);
        let p = |dx: f64, dy: f64| format!("({:.2} m, {:.2} m)", x + dx, y + dy);
        match self.below(if wall { 5 } else { 3 }) {
            0 => format!("disc({}, 20 cm)", p(0.0, 0.0)),
            1 => format!("rect({}, {})", p(-0.2, -0.15), p(0.2, 0.15)),
            2 => format!(
                "polygon({}, {}, {})",
                p(-0.25, -0.2),
                p(0.25, -0.1),
                p(0.0, 0.25)
            ),
            3 => format!("line({}, {})", p(-0.3, -0.1), p(0.25, 0.2)),
            _ => format!(
                "polyline({}, {}, {})",
                p(-0.3, -0.2),
                p(0.2, -0.2),
                p(0.2, 0.25)
            ),
        }
    }

    fn robot(&mut self, out: &mut String, name: &str, runs: Option<&str>) {
        let holonomic = self.chance(40);
        let drive = if holonomic {
            "holonomic"
        } else {
            "differential"
        };
        let noise = self.pick(&[
            "",
            ", speed_noise = 5 cm/s",
            ", turn_noise = 0.2 rad/s",
            ", speed_noise = 1 cm/s, turn_noise = 5 deg/s",
        ]);
        let speed = self.pick(&["0.3 m/s", "0.8 m/s", "3 m/s"]);
        let contact = self.pick(&["stop", "slide"]);
        let _ = writeln!(
            out,
            "    robot {name} {{\n        body = disc({} cm)",
            self.count(5, 20)
        );
        let _ = writeln!(
            out,
            "        drive = {drive}(max_speed = {speed}, max_turn = 2 rad/s{noise})"
        );
        let _ = writeln!(out, "        contact = {contact}");
        match runs {
            Some(runs) => {
                let _ = writeln!(out, "        runs = {runs}");
            }
            None => {
                self.has.holonomic = holonomic;
                for (name, sensor) in [
                    ("left", "scanner(from = 0 deg, to = 180 deg, range = 3 m"),
                    ("right", "scanner(from = -180 deg, to = 0 deg, range = 3 m"),
                    ("ahead", "range_finder(at = 10 deg, range = 2 m"),
                    (
                        "call",
                        "beacon(target = post, range = 3 m, sector = 120 deg",
                    ),
                ] {
                    let noise = self.pick(&["", ", noise = 2 cm"]);
                    let _ = writeln!(out, "        sensor {name} = {sensor}{noise})");
                    self.has.sensors.push(name.to_owned());
                }
            }
        }
        out.push_str("    }\n");
    }

    /// A constant of a type.
    pub(super) fn constant(&mut self, ty: &Type) -> String {
        let of: &[&str] = match ty {
            Type::Bool => &["true", "false"],
            Type::Number => &["0", "3", "-1.5"],
            Type::Ratio => &["100%", "0%"],
            Type::Length => &["1 m", "-20 cm"],
            Type::Time => &["0 s", "2 ticks"],
            Type::Angle => &["0 deg", "-1 rad"],
            Type::Speed => &["0.1 m/s"],
            Type::Turn => &["0.5 rad/s"],
            Type::Point => &["(1 m, 1 m)", "(50 cm, 2 m)"],
            _ => return self.pick(&self.members(ty)),
        };
        self.pick(of).to_owned()
    }
}
