//! The conflicts of a merge that nobody has resolved.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};
use std::ops::Range;

/// The bytes of a line, with its end.
type Line = Range<usize>;

/// Two sides of a text, of which one is to stay.
pub(super) struct Conflict {
    /// `<<<<<<<`, before the first side.
    opens: Line,
    /// What the first side ends with: `|||||||` before what both came from, or `=======`.
    ends: Line,
    /// `=======`, before the second side.
    parts: Line,
    /// `>>>>>>>`, behind it.
    closes: Line,
}

impl Conflict {
    /// What is not read, so that the first side stands alone.
    pub(super) fn left_out(&self) -> [Range<usize>; 2] {
        [self.opens.clone(), self.ends.start..self.closes.end]
    }

    /// What is said of it.
    pub(super) fn told(&self, file: FileId) -> Diagnostic {
        let mark = |line: &Line| Span::new(file, line.start, line.start + MARK);
        let message = "a conflict of a merge is not resolved";
        Diagnostic::new(Code::E0134, mark(&self.opens), message)
            .label("one side begins here")
            .also(mark(&self.parts), "and the other one here")
            .also(mark(&self.closes), "which ends here")
            .help("keep what is right of both sides, and delete the lines of the marks")
            .note("only the first side is checked")
    }
}

/// The length of a mark.
const MARK: usize = 7;

/// The conflicts of a text, in order; marks without the others are none.
pub(super) fn conflicts(text: &str) -> Vec<Conflict> {
    let mut found = Vec::new();
    // Most texts have none.
    if !text.starts_with("<<<<<<<") && !text.contains("\n<<<<<<<") {
        return found;
    }
    let (mut opens, mut base, mut parts) = (None, None, None);
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let place = start..start + line.len();
        start = place.end;
        if marked(line, '<') {
            (opens, base, parts) = (Some(place), None, None);
        } else if opens.is_some() && parts.is_none() && marked(line, '|') {
            base = Some(place);
        } else if opens.is_some() && parts.is_none() && marked(line, '=') {
            parts = Some(place);
        } else if marked(line, '>')
            && let (Some(opens), Some(parts)) = (opens.take(), parts.take())
        {
            found.push(Conflict {
                opens,
                ends: base.take().unwrap_or_else(|| parts.clone()),
                parts,
                closes: place,
            });
        }
    }
    found
}

/// Whether a line begins with seven of this character and nothing that would make it another text.
fn marked(line: &str, mark: char) -> bool {
    let rest = line.trim_start_matches(mark);
    line.len() - rest.len() == MARK && (rest.is_empty() || rest.starts_with([' ', '\r', '\n']))
}
