//! The writer of PLAs.

use super::Pla;
use crate::logic::Cube;
use std::fmt::Write;

/// A row to write: a cube, and the outputs that are 1 on it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Line {
    /// The cube.
    pub cube: Cube,
    /// The outputs, ascending.
    pub outputs: Vec<usize>,
}

/// A PLA of these rows, with the inputs and outputs of another, under comments.
pub fn write(pla: &Pla, comments: &[&str], lines: &[Line]) -> String {
    let mut text = String::new();
    for comment in comments {
        // Writing to a string does not fail.
        let _ = writeln!(text, "# {comment}");
    }
    let _ = writeln!(text, ".i {}\n.o {}", pla.inputs, pla.outputs);
    for (keyword, names) in [(".ilb", &pla.input_names), (".ob", &pla.output_names)] {
        if !names.is_empty() {
            let _ = writeln!(text, "{keyword} {}", names.join(" "));
        }
    }
    let _ = writeln!(text, ".p {}", lines.len());
    for line in lines {
        let mut inputs = vec!['-'; pla.inputs];
        for literal in line.cube.literals() {
            if let Some(input) = inputs.get_mut(literal.atom) {
                *input = if literal.positive { '1' } else { '0' };
            }
        }
        let outputs = (0..pla.outputs).map(|output| match line.outputs.contains(&output) {
            true => '1',
            false => '0',
        });
        text.extend(inputs);
        text.push(' ');
        text.extend(outputs);
        text.push('\n');
    }
    text.push_str(".e\n");
    text
}
