//! Trees of all nodes.

use super::author::Author;
use std::fmt::Write as _;

impl Author {
    /// Two trees of the task and a subtree with a parameter; the names of the two.
    pub(super) fn trees(&mut self, out: &mut String, atoms: &[String]) -> Vec<String> {
        let _ = writeln!(
            out,
            "tree errand(to: place, n: number = 2) = memory sequence {{ goto(to), retry(2) {{ approach(to) }} }}"
        );
        let names = vec!["hand".to_owned(), "other_hand".to_owned()];
        for name in &names {
            let node = self.node(atoms, 3);
            let _ = writeln!(out, "tree {name} for work = {node}");
        }
        out.push('\n');
        names
    }

    fn guard(&mut self, atoms: &[String], depth: usize) -> String {
        if depth == 0 || self.chance(50) {
            return self.pick(atoms);
        }
        let a = self.guard(atoms, depth - 1);
        let b = self.guard(atoms, depth - 1);
        match self.below(4) {
            0 => format!("not ({a})"),
            1 => format!("({a} or {b})"),
            2 => format!("({a} and not {b})"),
            _ => format!("({a} and {b})"),
        }
    }

    fn node(&mut self, atoms: &[String], depth: usize) -> String {
        if depth == 0 {
            return match self.below(8) {
                0 => self.guard(atoms, 1),
                1 => "errand(post)".to_owned(),
                _ => self.pick(&self.calls()),
            };
        }
        let depth = depth - 1;
        let children = |author: &mut Self| {
            let count = author.count(1, 3);
            let nodes: Vec<String> = (0..count)
                .map(|_| {
                    let node = author.node(atoms, depth);
                    match author.chance(40) && !node.contains("=>") {
                        true => format!("{} => {node}", author.guard(atoms, 2)),
                        false => node,
                    }
                })
                .collect();
            nodes.join(", ")
        };
        match self.below(12) {
            0 => format!("sequence {{ {} }}", children(self)),
            1 => format!("memory selector {{ {} }}", children(self)),
            2 => format!("memory sequence {{ {} }}", children(self)),
            3 => {
                let guard = self.guard(atoms, 2);
                let node = self.node(atoms, depth);
                format!("parallel({}) {{ {node}, {guard} }}", self.count(1, 2))
            }
            4 => format!("invert {{ {} }}", self.node(atoms, depth)),
            5 => format!(
                "{} {{ {} }}",
                self.pick(&["succeed", "fail"]),
                self.node(atoms, depth)
            ),
            6 => format!(
                "retry({}) {{ {} }}",
                self.count(1, 3),
                self.node(atoms, depth)
            ),
            7 => format!(
                "repeat({}) {{ {} }}",
                self.count(1, 3),
                self.node(atoms, depth)
            ),
            8 => format!("timeout(1500 ms) {{ {} }}", self.node(atoms, depth)),
            _ => format!("selector {{ {} }}", children(self)),
        }
    }
}
