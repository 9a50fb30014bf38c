//! A PLA with smaller covers of its outputs.

use super::{Conflict, Kind, Line, Pla};
use crate::logic::{Columns, Cube, Effort, Order, Solution, list, minimise_with};
use rayon::prelude::*;
use std::collections::BTreeMap;

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

impl Pla {
    /// A smallest cover of each output that is found, cubes that outputs share once; with the number of outputs whose
    /// cover is proved smallest. `limit` is the most cubes of a complement.
    ///
    /// # Errors
    /// Rows contradict each other, or the complement of an output is too large.
    pub fn covers(&self, limit: usize) -> Result<(Vec<Line>, usize), Uncovered> {
        let columns = self.columns();
        let one = |output| self.cover(&columns, output, limit);
        let solutions: Vec<Result<Solution, Uncovered>> =
            (0..self.outputs).into_par_iter().map(one).collect();
        let mut lines: Vec<Line> = Vec::new();
        let mut known: BTreeMap<Cube, usize> = BTreeMap::new();
        let mut proved = 0;
        for (output, solution) in solutions.into_iter().enumerate() {
            let solution = solution?;
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
        Ok((lines, proved))
    }

    fn cover(&self, columns: &Columns, output: usize, limit: usize) -> Result<Solution, Uncovered> {
        if let Some(conflict) = self.contradiction(columns, output) {
            return Err(Uncovered::Conflict(conflict));
        }
        let function = self
            .function(columns, output, limit)
            .map_err(|_| Uncovered::TooLarge(output))?;
        Ok(minimise_with(
            &function.columns,
            &function.on,
            &function.off,
            &Effort::default(),
        ))
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
