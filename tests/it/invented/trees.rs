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
            self.has.selected.clear();
            let node = self.node(atoms, 3);
            let _ = writeln!(out, "tree {name} for work = {node}");
            self.test(out, name, atoms);
        }
        out.push('\n');
        names
    }

    /// A test of a tree, which may well fail.
    fn test(&mut self, out: &mut String, tree: &str, atoms: &[String]) {
        let asked = |atom: &&String| !atom.starts_with("done(") && !atom.starts_with("failed(");
        let given: Vec<String> = atoms.iter().filter(asked).cloned().collect();
        let _ = writeln!(out, "test \"{tree} goes on\" of {tree} {{");
        let changes = |author: &mut Self| {
            let change = author.pick(&given);
            let not = author.pick(&["", "not "]);
            format!("{not}{change}")
        };
        let _ = writeln!(out, "given {}", changes(self));
        for _ in 0..self.count(1, 3) {
            let change = changes(self);
            let lasting = self.pick(&["", " for 3 ticks", " for 1 s"]);
            let selected = self.has.selected.clone();
            let expected = match selected.is_empty() {
                true => format!("{tree} fails"),
                false => {
                    let choice = self.pick(&selected);
                    let answer = match (choice.succeeds, choice.fails) {
                        (true, _) => " succeeds",
                        (_, true) => " fails",
                        _ => "",
                    };
                    format!("{}{answer}, {tree} runs", choice.call)
                }
            };
            let _ = writeln!(out, "tick {change}{lasting} => {expected}");
        }
        out.push_str("}\n");
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
                2 => "errand(n = 1, to = post)".to_owned(),
                _ => {
                    let choice = self.pick(&self.has.choices.clone());
                    self.has.selected.push(choice.clone());
                    choice.call
                }
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
            8 => format!(
                "timeout({}) {{ {} }}",
                self.pick(&["1500 ms", "tune(1 s, 500 ms .. 3 s)"]),
                self.node(atoms, depth)
            ),
            _ => format!("selector {{ {} }}", children(self)),
        }
    }
}
