//! A PLA with smaller covers of its outputs.

use super::joint::{finished, is_cheaper, joint};
use super::products::Problem;
use super::{Conflict, Function, Kind, Line, Pla};
use crate::logic::{Columns, Cover, Cube, Effort, Order, Solution, list, minimise_with};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// The work of the steps on cubes.
const WORK: u64 = 1 << 26;

/// Above so many rows, covers of cubes are made by the steps on cubes alone.
const LARGE: usize = 512;

/// The most ON cubes, and the most products, that the steps on cubes begin with: they look at pairs of them.
const CUBES: usize = 16_384;
const PRODUCTS: usize = 4_096;

/// Why a PLA has no covers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Uncovered {
    /// Rows contradict each other, in an output or as rows of a decision list.
    Conflict(Conflict),
    /// The complement of this output is too large.
    TooLarge(usize),
    /// No decision list: the type is not `fr`.
    Kind,
    /// No decision list: not exactly one output is 1 in this row.
    Outputs(usize),
}

/// How covers were found.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Found {
    /// Each output by itself.
    Each {
        /// The number of outputs whose cover is proved smallest.
        proved: usize,
    },
    /// All outputs together, with fewer cubes or literals than each by itself.
    Together,
}

impl Pla {
    /// Covers of all outputs with as few different cubes as are found, those that outputs share once. The outputs are
    /// minimised each by itself, with the number of those whose cover is proved smallest, and, unless they are to be
    /// `separate`, together. `limit` is the most cubes of a complement.
    ///
    /// # Errors
    /// Rows contradict each other, or the complement of an output is too large.
    pub fn covers(&self, limit: usize, separate: bool) -> Result<(Vec<Line>, Found), Uncovered> {
        let columns = self.columns();
        let functions = (0..self.outputs).into_par_iter();
        let functions = functions.map(|output| self.sound(&columns, output, limit));
        let functions = functions
            .collect::<Vec<_>>()
            .into_iter()
            .collect::<Result<Vec<Function>, Uncovered>>()?;
        let one = |function| minimised(self.inputs, function);
        let (lines, proved) = shared(functions.par_iter().map(one).collect());
        let together = match separate || self.outputs < 2 {
            true => None,
            false => together(self.inputs, &functions, &lines),
        };
        Ok(match together {
            Some(together) => (together, Found::Together),
            None => (lines, Found::Each { proved }),
        })
    }

    /// An output whose rows do not contradict each other.
    fn sound<'a>(
        &self,
        columns: &'a Columns,
        output: usize,
        limit: usize,
    ) -> Result<Function<'a>, Uncovered> {
        match self.contradiction(columns, output) {
            Some(conflict) => Err(Uncovered::Conflict(conflict)),
            None => self
                .function(columns, output, limit)
                .map_err(|_| Uncovered::TooLarge(output)),
        }
    }

    /// The outputs as a decision list: the first row that holds decides.
    ///
    /// # Errors
    /// The type is not `fr`, a row has not exactly one output that is 1, or rows contradict each other.
    pub fn decision_list(&self, order: Order) -> Result<Vec<Line>, Uncovered> {
        if self.kind != Kind::Fr {
            return Err(Uncovered::Kind);
        }
        let classes = self.classes().map_err(Uncovered::Outputs)?;
        let columns = self.columns();
        if let Some(conflict) = self.class_conflict(&columns) {
            return Err(Uncovered::Conflict(conflict));
        }
        let list = list(&columns, &classes, order, &Effort::default());
        let lines = list.iter().flat_map(|(output, cover)| {
            let line = |cube: &Cube| Line {
                cube: cube.clone(),
                outputs: vec![*output],
            };
            cover.cubes().iter().map(line)
        });
        Ok(lines.collect())
    }
}

/// The smallest cover of an output that is found.
fn minimised(inputs: usize, function: &Function) -> Solution {
    let Function { columns, on, off } = function;
    let all = Effort::default();
    let is_large = on.count() + off.count() > LARGE;
    // What rows as wholes are good for in large tables of cubes, a first cover of them shows as well.
    let effort = match is_large && !columns.are_minterms() {
        true => all.quick(),
        false => all,
    };
    let solution = minimise_with(columns, on, off, &effort);
    if solution.proved || columns.are_minterms() {
        return solution;
    }
    let (lines, _) = shared(vec![solution.clone()]);
    match reduced(inputs, std::slice::from_ref(function), &lines) {
        Some(lines) => Solution {
            cover: Cover::new(lines.into_iter().map(|line| line.cube)),
            proved: false,
        },
        None => solution,
    }
}

/// Products of all outputs that cost less than these, if any are found.
fn together(inputs: usize, functions: &[Function], lines: &[Line]) -> Option<Vec<Line>> {
    let reduced = reduced(inputs, functions, lines);
    let best = reduced.as_deref().unwrap_or(lines);
    // Tables of cubes have more rows than steps on cubes have products.
    if !functions
        .iter()
        .all(|function| function.columns.are_minterms())
    {
        return reduced;
    }
    let joint = joint(inputs, functions, best.len());
    let joint = joint.and_then(|joint| finished(inputs, functions, joint));
    joint.filter(|joint| is_cheaper(joint, best)).or(reduced)
}

/// Products that the steps on cubes make of these, or of the file's own, if they cost less than these.
fn reduced(inputs: usize, functions: &[Function], lines: &[Line]) -> Option<Vec<Line>> {
    let of = |start: &[Line]| {
        let reduced = Problem::new(inputs, functions, WORK).reduced(start);
        finished(inputs, functions, reduced)
    };
    let ons = functions.iter().map(|function| function.on.count());
    if ons.sum::<usize>() > CUBES {
        return None;
    }
    let given = Problem::new(inputs, functions, 0).given();
    let starts = [lines, &given].into_iter();
    let starts = starts.filter(|start| start.len() <= PRODUCTS);
    let found = starts.filter_map(of);
    let best = found.reduce(|best, next| if is_cheaper(&next, &best) { next } else { best });
    best.filter(|best| is_cheaper(best, lines))
}

/// The cubes of all outputs, each once, and the number of outputs whose cover is proved smallest.
fn shared(solutions: Vec<Solution>) -> (Vec<Line>, usize) {
    let mut lines: Vec<Line> = Vec::new();
    let mut known: BTreeMap<Cube, usize> = BTreeMap::new();
    let mut proved = 0;
    for (output, solution) in solutions.into_iter().enumerate() {
        proved += usize::from(solution.proved);
        for cube in solution.cover.cubes() {
            let at = *known.entry(cube.clone()).or_insert(lines.len());
            match lines.get_mut(at) {
                Some(line) => line.outputs.push(output),
                None => lines.push(Line {
                    cube: cube.clone(),
                    outputs: vec![output],
                }),
            }
        }
    }
    (lines, proved)
}
