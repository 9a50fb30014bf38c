//! PLAs in the format of Berkeley Espresso: what is read, what is made of it, what is written.

mod conflict;
mod error;
mod functions;
mod joint;
mod minimised;
mod products;
mod read;
mod rest;
mod write;

pub use conflict::Conflict;
pub use error::{PlaError, PlaErrorKind};
pub use functions::{Function, TooLarge};
pub use minimised::{Found, Uncovered};
pub use read::read;
pub use write::{Line, write};

use super::packed::Packed;

/// What the output part of a row says.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Kind {
    /// `f`: where the function is 1; it is 0 everywhere else.
    F,
    /// `fd`: where it is 1, and where it does not matter; it is 0 everywhere else.
    #[default]
    Fd,
    /// `fr`: where it is 1, and where it is 0; it does not matter anywhere else.
    Fr,
    /// `fdr`: all three; where nothing is said, it does not matter.
    Fdr,
}

impl Kind {
    /// The type of that name.
    pub fn parse(name: &str) -> Option<Self> {
        match name {
            "f" => Some(Self::F),
            "fd" => Some(Self::Fd),
            "fr" => Some(Self::Fr),
            "fdr" => Some(Self::Fdr),
            _ => None,
        }
    }
}

/// What a row says of an output.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// It is 1.
    On,
    /// It is 0.
    Off,
    /// It does not matter.
    Free,
    /// Nothing.
    Silent,
}

/// A PLA.
#[derive(Clone, Debug, Default)]
pub struct Pla {
    /// The number of inputs.
    pub inputs: usize,
    /// The number of outputs.
    pub outputs: usize,
    /// What the output parts mean.
    pub kind: Kind,
    /// The names of the inputs, if the file has any.
    pub input_names: Vec<String>,
    /// The names of the outputs, if the file has any.
    pub output_names: Vec<String>,
    /// The values of all rows, in machine words row by row; free inputs are 0.
    values: Vec<u64>,
    /// The free inputs of all rows in the same way; empty where no row has any.
    free: Vec<u64>,
    /// The output parts of all rows.
    parts: Vec<Part>,
    /// Where each row starts in the text.
    starts: Vec<u32>,
}

impl Pla {
    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len()
    }

    /// Whether no row has a free input.
    pub fn are_minterms(&self) -> bool {
        self.free.is_empty()
    }

    /// What a row says of an output, as the type of the PLA has it.
    pub fn part(&self, row: usize, output: usize) -> Part {
        let part = self.parts.get(row * self.outputs + output);
        match (part.copied().unwrap_or(Part::Silent), self.kind) {
            (Part::Off, Kind::F | Kind::Fd) | (Part::Free, Kind::F | Kind::Fr) => Part::Silent,
            (part, _) => part,
        }
    }

    /// The input part of a row.
    pub fn cube(&self, row: usize) -> Packed {
        Packed::new(
            self.inputs,
            self.row(&self.values, row),
            self.row(&self.free, row),
        )
    }

    /// Where a row starts in the text, in bytes.
    pub fn start(&self, row: usize) -> usize {
        self.starts.get(row).map_or(0, |start| *start as usize)
    }

    /// The number of machine words of a row.
    fn words(&self) -> usize {
        self.inputs.div_ceil(64).max(1)
    }

    fn row<'a>(&self, words: &'a [u64], row: usize) -> &'a [u64] {
        let from = row * self.words();
        words.get(from..from + self.words()).unwrap_or_default()
    }

    /// The rows as values and, where any row has some, free inputs.
    fn table(&self) -> impl ExactSizeIterator<Item = (&[u64], Option<&[u64]>)> + Clone {
        (0..self.rows()).map(|row| {
            let free = (!self.free.is_empty()).then(|| self.row(&self.free, row));
            (self.row(&self.values, row), free)
        })
    }
}

/// The size of a cover as Espresso counts it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Cubes.
    pub cubes: usize,
    /// Literals in their input parts.
    pub inputs: usize,
    /// Outputs in their output parts.
    pub outputs: usize,
}

impl Cost {
    /// The size of the rows that say `part` of some output.
    pub fn of(pla: &Pla, part: Part) -> Self {
        let mut cost = Self::default();
        for row in 0..pla.rows() {
            let outputs = (0..pla.outputs).filter(|output| pla.part(row, *output) == part);
            cost.add(outputs.count(), || pla.cube(row).literals());
        }
        cost
    }

    /// The size of lines.
    pub fn of_lines(lines: &[Line]) -> Self {
        let mut cost = Self::default();
        for line in lines {
            cost.add(line.outputs.len(), || line.cube.literals().len());
        }
        cost
    }

    fn add(&mut self, outputs: usize, literals: impl Fn() -> usize) {
        if outputs > 0 {
            self.cubes += 1;
            self.inputs += literals();
            self.outputs += outputs;
        }
    }
}

impl std::fmt::Display for Cost {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let total = self.inputs + self.outputs;
        let (cubes, inputs, outputs) = (self.cubes, self.inputs, self.outputs);
        write!(f, "c={cubes} in={inputs} out={outputs} tot={total}")
    }
}
