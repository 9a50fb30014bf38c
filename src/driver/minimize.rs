//! `btc minimize`: a PLA with smaller covers.

use super::refused::Refused;
use super::text::Text;
use crate::diagnostic::{Code, Diagnostic};
pub use crate::logic::Order;
use crate::logic::pla::{self, Cost, Found, Line, Part, Pla, PlaError, PlaErrorKind, Uncovered};
use crate::source::{FileId, Span};

/// What a user may set.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// The order of a decision list of the outputs; `None` to minimise each output by itself.
    pub order: Option<Order>,
    /// The most cubes of a complement.
    pub limit: usize,
    /// Whether each output is minimised by itself, although they could share cubes.
    pub separate: bool,
}

/// A minimised PLA.
#[derive(Clone, Debug)]
pub struct Minimized {
    /// The PLA.
    pub text: String,
    /// Sizes before and after, a line each, as Espresso prints them.
    pub statistics: String,
}

/// The PLA in a text, with the smallest covers that are found for its outputs.
///
/// # Errors
/// The mistakes of the text.
pub fn minimize(text: Text, options: &Options) -> Result<Minimized, Refused> {
    let read = std::str::from_utf8(text.bytes);
    let read = read.map_err(|_| Refused::text(text, |_| Vec::new()))?;
    let pla = pla::read(read).map_err(|mistakes| {
        let located = |file| mistakes.iter().map(|m| located(file, m)).collect();
        Refused::text(text, located)
    })?;
    minimized(&pla, options)
        .map_err(|why| Refused::text(text, |file| vec![uncovered(why, file, &pla, read)]))
}

fn minimized(pla: &Pla, options: &Options) -> Result<Minimized, Uncovered> {
    let (lines, comments, note) = match options.order {
        Some(order) => (pla.decision_list(order)?, &[LIST][..], String::new()),
        None => {
            let (lines, found) = pla.covers(options.limit, options.separate)?;
            let note = match found {
                Found::Each { proved } => {
                    format!("# proved smallest: {proved} of {} outputs\n", pla.outputs)
                }
                Found::Together => "# outputs share cubes: minimised together\n".to_owned(),
            };
            (lines, &[][..], note)
        }
    };
    Ok(Minimized {
        statistics: statistics(pla, &lines) + &note,
        text: pla::write(pla, comments, &lines),
    })
}

/// The comment on a decision list.
const LIST: &str = "a decision list: the first row that holds decides, and only its output is 1";

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

fn uncovered(why: Uncovered, file: FileId, pla: &Pla, text: &str) -> Diagnostic {
    let row = |row: usize| {
        let start = pla.start(row);
        let rest = text.get(start..).unwrap_or_default();
        let said = rest.lines().next().and_then(|line| line.split('#').next());
        let length = said.map_or(0, |said| said.trim_end().len());
        Span::new(file, start, start + length)
    };
    match why {
        Uncovered::Conflict(conflict) => Diagnostic::new(
            Code::E0805,
            row(conflict.second),
            "this row contradicts an earlier one",
        )
        .also(row(conflict.first), "this row differs")
        .note("both hold on some minterm"),
        Uncovered::TooLarge(output) => Diagnostic::new(
            Code::E0806,
            row(0),
            format!("the complement of {} has too many cubes", name(pla, output)),
        )
        .help("say where it is 0, in a PLA of type `fr`; or allow more cubes with `--limit`"),
        Uncovered::Kind => Diagnostic::new(
            Code::E0807,
            row(0),
            "a decision list is made of a PLA of type `fr`",
        )
        .help("add `.type fr` if the rows are all that matters"),
        Uncovered::Outputs(at) => Diagnostic::new(
            Code::E0807,
            row(at),
            "in a decision list exactly one output of a row is 1",
        ),
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
            let known =
                "`.i`, `.o`, `.ilb`, `.ob`, `.p`, `.type`, `.phase`, `.e` and `.end` are known";
            diagnostic.help(known)
        }
        PlaErrorKind::Phase => diagnostic
            .help("to complement an output, exchange 0 and 1 in its column of an `fr` file"),
        PlaErrorKind::Valued(_) => {
            diagnostic.help("write an input of several values as one input for each value")
        }
        PlaErrorKind::Type(_) => diagnostic.help("the types are `f`, `fd`, `fr` and `fdr`"),
        PlaErrorKind::Size => diagnostic.help("begin with `.i` and `.o`"),
        _ => diagnostic,
    }
}
