//! Lines, and the columns into which adjacent ones are brought.

/// The kind of the lines of a reward, whose first cell may be a long condition.
pub(super) const KEYS: &str = "reward";

/// The widest cell that moves the column after it; a wider one stands alone, or else all the others would stand far off
/// from what belongs to them.
const WIDEST: usize = 40;

/// How a line is aligned with those next to it: adjacent lines of one kind share their columns.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Align {
    /// Not aligned.
    None,
    /// A comment on a line of its own: it does not part the lines around it.
    Comment,
    /// One-line entries of one kind.
    Of(&'static str),
    /// One-line entries of one kind, whose first column is aligned, and further ones among those of one shape.
    Shaped(&'static str, String),
}

impl Align {
    fn kind(&self) -> Option<&'static str> {
        match self {
            Self::None | Self::Comment => None,
            Self::Of(kind) | Self::Shaped(kind, _) => Some(kind),
        }
    }
}

/// A comment at the end of a line.
#[derive(Clone, Debug)]
pub(super) struct Trailing {
    /// With its slashes.
    pub(super) text: String,
    /// The column at which it was written, as [`width`] counts it.
    pub(super) column: usize,
}

/// A line, cut into columns.
#[derive(Clone, Debug)]
pub(super) struct Line {
    pub(super) indent: usize,
    pub(super) cells: Vec<String>,
    pub(super) align: Align,
    pub(super) blank_before: bool,
    pub(super) comment: Option<Trailing>,
}

/// How many columns a text takes; a tab, which a path may hold, takes four.
pub(super) fn width(text: &str) -> usize {
    text.chars()
        .map(|letter| if letter == '\t' { 4 } else { 1 })
        .sum()
}

/// The text of the lines, in columns.
pub(super) fn text(lines: &[Line]) -> String {
    let mut code: Vec<String> = lines.iter().map(unaligned).collect();
    for run in runs(lines) {
        align(lines, &run, &mut code);
    }
    trailing(lines, &mut code);
    let mut text = String::new();
    for (line, code) in lines.iter().zip(&code) {
        if line.blank_before && !text.is_empty() {
            text.push('\n');
        }
        text.push_str(code.trim_end());
        text.push('\n');
    }
    text
}

fn unaligned(line: &Line) -> String {
    let cells: Vec<&str> = line
        .cells
        .iter()
        .map(String::as_str)
        .filter(|cell| !cell.is_empty())
        .collect();
    format!("{}{}", " ".repeat(4 * line.indent), cells.join(" "))
}

/// The runs of adjacent lines of one kind.
fn runs(lines: &[Line]) -> Vec<Vec<usize>> {
    let mut runs: Vec<Vec<usize>> = Vec::new();
    let mut open: Option<(&'static str, usize)> = None;
    for (index, line) in lines.iter().enumerate() {
        if line.align == Align::Comment && !line.blank_before {
            continue;
        }
        let key = line.align.kind().map(|kind| (kind, line.indent));
        match (key, runs.last_mut()) {
            (Some(key), Some(run)) if open == Some(key) && !line.blank_before => run.push(index),
            (Some(_), _) => runs.push(vec![index]),
            (None, _) => {}
        }
        open = key;
    }
    runs
}

fn align(lines: &[Line], run: &[usize], code: &mut [String]) {
    let run: Vec<(usize, &Line)> = run
        .iter()
        .filter_map(|&index| Some((index, lines.get(index)?)))
        .collect();
    let same_shape = run
        .windows(2)
        .all(|pair| matches!(pair, [(_, a), (_, b)] if a.align == b.align && a.cells.len() == b.cells.len()));
    let shaped = run
        .iter()
        .any(|(_, line)| matches!(line.align, Align::Shaped(..)));
    let columns = if shaped && !same_shape { 1 } else { usize::MAX };
    let keys = run.iter().any(|(_, line)| line.align == Align::Of(KEYS));
    let widths: Vec<usize> = (0..)
        .map_while(|column| {
            let cells = run.iter().filter_map(|(_, line)| line.cells.get(column));
            let widths = cells.map(|cell| cell.chars().count());
            let widest = widths.clone().max()?;
            let narrow = widths.filter(|width| !keys || *width <= WIDEST).max();
            Some(narrow.unwrap_or(widest))
        })
        .collect();
    for (index, line) in run {
        let mut text = " ".repeat(4 * line.indent);
        let last = line.cells.len().saturating_sub(1);
        for (column, (cell, &width)) in line.cells.iter().zip(&widths).enumerate() {
            let padded = column < last && column < columns;
            let wanted = if padded { width } else { cell.chars().count() };
            text.push_str(cell);
            text.push_str(&" ".repeat(wanted.saturating_sub(cell.chars().count())));
            // A column that is empty all the way down takes no room.
            if column < last && (!padded || width > 0) {
                text.push(' ');
            }
        }
        if let Some(code) = code.get_mut(index) {
            *code = text.trim_end().to_owned();
        }
    }
}

/// Puts the comments behind their lines: at the column at which they were written if the code leaves room for it,
/// and at one column for adjacent lines.
fn trailing(lines: &[Line], code: &mut [String]) {
    let mut rest = code;
    let joined = |above: &Line, line: &Line| {
        above.comment.is_some() && line.comment.is_some() && !line.blank_before
    };
    for lines in lines.chunk_by(joined) {
        let (code, after) = std::mem::take(&mut rest).split_at_mut(lines.len());
        rest = after;
        let columns = lines.iter().zip(code.iter()).map(|(line, code)| {
            let written = line.comment.as_ref().map_or(0, |comment| comment.column);
            written.max(width(code) + 1)
        });
        let column = columns.max().unwrap_or(0);
        for (line, code) in lines.iter().zip(code) {
            if let Some(comment) = &line.comment {
                let blanks = column.saturating_sub(width(code));
                code.push_str(&" ".repeat(blanks));
                code.push_str(&comment.text);
            }
        }
    }
}
