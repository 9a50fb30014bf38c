//! Trees for Graphviz.
//!
//! → is a sequence, ? a selector, a star means memory, ⇉ is `parallel`; conditions are ovals, behaviours boxes,
//! decorators diamonds (the paper's Figure 1). Children stand from the left as in the text.

use crate::ir::Program;
use crate::ir::tree::{Composite, Decorator, Tree};
use crate::tree::drawing::{Drawing, Shape};
use std::fmt::Write;

const HEAD: &str = r##"    graph [ordering=out, ranksep=0.4, nodesep=0.25, splines=line, bgcolor=transparent]
    node [fontname="Helvetica,Arial,sans-serif", fontsize=12, penwidth=1.2, color="#37474f", fontcolor="#1c272c", style=filled]
    edge [arrowhead=none, penwidth=1.2, color="#78909c"]
"##;

/// A tree as a `digraph` of its name.
pub fn tree(program: &Program, tree: &Tree) -> String {
    let mut out = format!("digraph {} {{\n{HEAD}\n", quoted(&tree.name.to_string()));
    let mut count = 0;
    draw(&Drawing::of(&tree.root), program, &mut out, &mut count);
    out.push_str("}\n");
    out
}

/// Draws a node and what stands under it; gives its number.
fn draw(drawing: &Drawing, program: &Program, out: &mut String, count: &mut usize) -> usize {
    let number = *count;
    *count += 1;
    // Writing to a string does not fail.
    let _ = writeln!(out, "    n{number} [{}]", look(drawing.shape, program));
    for child in &drawing.children {
        let child = draw(child, program, out, count);
        let _ = writeln!(out, "    n{number} -> n{child}");
    }
    number
}

/// The attributes of a node.
fn look(shape: Shape, program: &Program) -> String {
    let control = |symbol: &str| {
        format!(
            r##"shape=square, width=0.42, fixedsize=true, fontsize=16, fillcolor="#eceff1", label="{symbol}""##
        )
    };
    let oval = |label: &str| {
        format!(
            r##"shape=ellipse, height=0.4, fillcolor="#fff3d6", label={}"##,
            quoted(label)
        )
    };
    match shape {
        Shape::Composite(kind, memory) => control(match (kind, memory) {
            (Composite::Sequence, false) => "→",
            (Composite::Sequence, true) => "→*",
            (Composite::Selector, false) => "?",
            (Composite::Selector, true) => "?*",
        }),
        Shape::Parallel(successes) => control(&format!("⇉{successes}")),
        Shape::Decorator(kind) => {
            let label = match kind {
                Decorator::Timeout(ticks) => format!("{}\n{ticks} ticks", kind.word()),
                _ => kind.to_string(),
            };
            format!(
                r##"shape=diamond, margin="0.02,0.02", fillcolor="#ede7f6", label={}"##,
                quoted(&label)
            )
        }
        Shape::Behavior(id) => format!(
            r##"shape=box, height=0.4, fillcolor="#d7ecd9", label={}"##,
            quoted(&program.behaviors[id].name.to_string())
        ),
        Shape::Literal(atom, true) => oval(&program.atom_name(atom).to_string()),
        Shape::Literal(atom, false) => oval(&format!("not {}", program.atom_name(atom))),
        Shape::Const(value) => oval(if value { "true" } else { "false" }),
    }
}

/// A string of the DOT language.
fn quoted(text: &str) -> String {
    let escaped = text
        .replace('\\', "\\\\")
        .replace('"', "\\\"")
        .replace('\n', "\\n");
    format!("\"{escaped}\"")
}
