//! PLAs, minimised.

use super::load::decode;
use crate::diagnostic::{Code, Diagnostic};
pub use crate::logic::Order;
use crate::logic::pla::{self, Conflict, Cost, Kind, Line, Part, Pla, PlaError, PlaErrorKind};
use crate::logic::{Columns, Cube, Effort, Solution, list, minimise_with};
use crate::source::{FileId, Sources, Span};
use rayon::prelude::*;
use std::collections::BTreeMap;

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Make the outputs a decision list, in this order; else each is minimised by itself.
    pub order: Option<Order>,
    /// The most cubes of a complement.
    pub limit: usize,
}

/// A minimised PLA.
#[derive(Clone, Debug)]
pub struct Minimized {
    /// The PLA.
    pub text: String,
    /// Sizes before and after, a line each, as Espresso prints them.
    pub statistics: String,
}

/// The PLA in a file, with the smallest covers that are found for its outputs.
///
/// # Errors
/// What is wrong with the file, with its place, and its text.
pub fn minimize(
    name: &str,
    bytes: Vec<u8>,
    options: &Options,
) -> Result<Minimized, (Sources, Vec<Diagnostic>)> {
    let mut sources = Sources::default();
    let (file, mistake) = decode(&mut sources, name, bytes);
    if let Some(mistake) = mistake {
        return Err((sources, vec![mistake]));
    }
    let text = sources.get(file).map_or("", |source| &source.text);
    let found = match pla::read(text) {
        Ok(pla) => {
            let found = match options.order {
                Some(order) => decision_list(&pla, order),
                None => covers(&pla, options.limit),
            };
            found.map_err(|trouble| vec![trouble.located(file, &pla, text)])
        }
        Err(mistakes) => Err(mistakes.iter().map(|m| located(file, m)).collect()),
    };
    found.map_err(|diagnostics| (sources, diagnostics))
}

/// Why a PLA has no covers.
#[derive(Clone, Copy, Debug)]
enum Trouble {
    /// Rows that contradict each other, in an output if it is one.
    Conflict(Conflict),
    /// The complement of an output is too large.
    TooLarge(usize),
    /// No decision list: the type is not `fr`.
    Kind,
    /// No decision list: not exactly one output is 1 in this row.
    Outputs(usize),
}

/// A smallest cover of each output; cubes that outputs share stand once.
fn covers(pla: &Pla, limit: usize) -> Result<Minimized, Trouble> {
    let columns = pla.columns();
    let one = |output| cover(pla, &columns, output, limit);
    let solutions: Vec<Result<Solution, Trouble>> =
        (0..pla.outputs).into_par_iter().map(one).collect();
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
    let note = format!("# proved smallest: {proved} of {} outputs\n", pla.outputs);
    Ok(Minimized {
        statistics: statistics(pla, &lines) + &note,
        text: pla::write(pla, &[], &lines),
    })
}

fn cover(pla: &Pla, columns: &Columns, output: usize, limit: usize) -> Result<Solution, Trouble> {
    if let Some(conflict) = pla.contradiction(columns, output) {
        return Err(Trouble::Conflict(conflict));
    }
    let function = pla.function(columns, output, limit);
    let function = function.map_err(|_| Trouble::TooLarge(output))?;
    let effort = Effort::default();
    Ok(minimise_with(
        &function.columns,
        &function.on,
        &function.off,
        &effort,
    ))
}

/// The outputs as a decision list: the first row that holds decides.
fn decision_list(pla: &Pla, order: Order) -> Result<Minimized, Trouble> {
    if pla.kind != Kind::Fr {
        return Err(Trouble::Kind);
    }
    let classes = pla.classes().map_err(Trouble::Outputs)?;
    let columns = pla.columns();
    if let Some(conflict) = pla.class_conflict(&columns) {
        return Err(Trouble::Conflict(conflict));
    }
    let list = list(&columns, &classes, order, &Effort::default());
    let lines = list.iter().flat_map(|(output, cover)| {
        let line = |cube: &Cube| Line {
            cube: cube.clone(),
            outputs: vec![*output],
        };
        cover.cubes().iter().map(line)
    });
    let lines: Vec<Line> = lines.collect();
    let comment = "a decision list: the first row that holds decides, and only its output is 1";
    Ok(Minimized {
        statistics: statistics(pla, &lines),
        text: pla::write(pla, &[comment], &lines),
    })
}

fn statistics(pla: &Pla, lines: &[Line]) -> String {
    let set = |part| Cost::of(pla, part);
    format!(
        "# ON-set cost is  {}\n# OFF-set cost is {}\n# DC-set cost is  {}\n# result cost is  {}\n",
        set(Part::On),
        set(Part::Off),
        set(Part::Free),
        Cost::of_lines(lines),
    )
}

impl Trouble {
    fn located(self, file: FileId, pla: &Pla, text: &str) -> Diagnostic {
        let row = |row: usize| {
            let start = pla.start(row);
            let rest = text.get(start..).unwrap_or_default();
            let said = rest.lines().next().and_then(|line| line.split('#').next());
            let length = said.map_or(0, |said| said.trim_end().len());
            Span::new(file, start, start + length)
        };
        match self {
            Self::Conflict(conflict) => Diagnostic::new(
                Code::E0805,
                row(conflict.second),
                "this row contradicts an earlier one",
            )
            .also(row(conflict.first), "this row says otherwise")
            .note("both hold on some minterm"),
            Self::TooLarge(output) => Diagnostic::new(
                Code::E0806,
                row(0),
                format!("the complement of {} has too many cubes", name(pla, output)),
            )
            .help("say where it is 0, in a PLA of type `fr`; or allow more cubes with `--limit`"),
            Self::Kind => Diagnostic::new(
                Code::E0807,
                row(0),
                "a decision list is made of a PLA of type `fr`",
            )
            .help("add `.type fr` if the rows are all that matters"),
            Self::Outputs(at) => Diagnostic::new(
                Code::E0807,
                row(at),
                "in a decision list exactly one output of a row is 1",
            ),
        }
    }
}

fn name(pla: &Pla, output: usize) -> String {
    match pla.output_names.get(output) {
        Some(name) => format!("`{name}`"),
        None => format!("output {output}"),
    }
}

fn located(file: FileId, error: &PlaError) -> Diagnostic {
    let span = Span::new(file, error.span.start, error.span.end);
    let code = match error.kind {
        PlaErrorKind::Width { .. } => Code::E0802,
        PlaErrorKind::Character(_) => Code::E0803,
        PlaErrorKind::Size => Code::E0804,
        _ => Code::E0801,
    };
    let diagnostic = Diagnostic::new(code, span, error.kind.to_string());
    match &error.kind {
        PlaErrorKind::Keyword(_) => {
            diagnostic.help("`.i`, `.o`, `.ilb`, `.ob`, `.p`, `.type`, `.e` and `.end` are known")
        }
        PlaErrorKind::Type(_) => diagnostic.help("the types are `f`, `fd`, `fr` and `fdr`"),
        PlaErrorKind::Size => diagnostic.help("begin with `.i` and `.o`"),
        _ => diagnostic,
    }
}
