//! The conflicts of a merge that nobody has resolved, or not wholly.

use crate::diagnostic::{Code, Diagnostic};
use crate::source::{FileId, Span};
use std::ops::Range;

/// The bytes of a line, with its end.
type Line = Range<usize>;

/// What a merge has left in a text.
pub(super) enum Conflict {
    /// Two sides, of which one is to stay.
    Sides(Sides),
    /// A mark without the others.
    Mark(Line),
}

/// Two sides of a text.
pub(super) struct Sides {
    /// `<<<<<<<`, before the first side.
    opens: Line,
    /// `|||||||`, before what both came from.
    base: Option<Line>,
    /// `=======`, before the second side.
    parts: Line,
    /// `>>>>>>>`, behind it.
    closes: Line,
}

impl Conflict {
    /// What is not read, so that the first side stands alone.
    pub(super) fn left_out(&self) -> Vec<Range<usize>> {
        match self {
            Self::Sides(sides) => {
                let first = sides.base.as_ref().unwrap_or(&sides.parts);
                vec![sides.opens.clone(), first.start..sides.closes.end]
            }
            Self::Mark(line) => vec![line.clone()],
        }
    }

    /// What is said of it.
    pub(super) fn told(&self, file: FileId) -> Diagnostic {
        let mark = |line: &Line| Span::new(file, line.start, line.start + MARK);
        match self {
            Self::Sides(sides) => {
                let message = "a conflict of a merge is not resolved";
                Diagnostic::new(Code::E0134, mark(&sides.opens), message)
                    .label("one side begins here")
                    .also(mark(&sides.parts), "and the other one here")
                    .also(mark(&sides.closes), "which ends here")
                    .help("keep what is right of both sides, and delete the lines of the marks")
                    .note("only the first side is checked")
            }
            Self::Mark(line) => {
                let message = "a mark of a merge was left behind";
                Diagnostic::new(Code::E0134, mark(line), message)
                    .label("the other marks of its conflict are gone")
                    .help("delete this line")
            }
        }
    }

    fn start(&self) -> usize {
        match self {
            Self::Sides(sides) => sides.opens.start,
            Self::Mark(line) => line.start,
        }
    }
}

/// The length of a mark, and what marks are of.
const MARK: usize = 7;
const MARKS: [char; 4] = ['<', '|', '=', '>'];

/// The marks of a conflict that has not ended.
struct Open {
    opens: Line,
    base: Option<Line>,
    parts: Option<Line>,
}

impl Open {
    fn marks(self) -> impl Iterator<Item = Conflict> {
        let marks = [Some(self.opens), self.base, self.parts];
        marks.into_iter().flatten().map(Conflict::Mark)
    }
}

/// What merges have left in a text, in order.
pub(super) fn conflicts(text: &str) -> Vec<Conflict> {
    let mut found = Vec::new();
    // Most texts have none.
    let marks = MARKS.map(|mark| format!("\n{}", mark.to_string().repeat(MARK)));
    if !text.starts_with(MARKS) && !marks.iter().any(|mark| text.contains(mark.as_str())) {
        return found;
    }
    let mut open: Option<Open> = None;
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let place = start..start + line.len();
        start = place.end;
        let Some(mark) = MARKS.into_iter().find(|mark| marked(line, *mark)) else {
            continue;
        };
        match (mark, &mut open) {
            ('<', _) => {
                found.extend(open.take().into_iter().flat_map(Open::marks));
                open = Some(Open {
                    opens: place,
                    base: None,
                    parts: None,
                });
            }
            ('|', Some(of)) if of.base.is_none() && of.parts.is_none() => of.base = Some(place),
            ('=', Some(of)) if of.parts.is_none() => of.parts = Some(place),
            ('>', Some(Open { parts: Some(_), .. })) => {
                found.extend(open.take().and_then(|of| {
                    Some(Conflict::Sides(Sides {
                        opens: of.opens,
                        base: of.base,
                        parts: of.parts?,
                        closes: place,
                    }))
                }));
            }
            _ => found.push(Conflict::Mark(place)),
        }
    }
    found.extend(open.into_iter().flat_map(Open::marks));
    found.sort_by_key(Conflict::start);
    found
}

/// Whether a line begins with seven of this character and nothing that would make it another text.
fn marked(line: &str, mark: char) -> bool {
    let rest = line.trim_start_matches(mark);
    line.len() - rest.len() == MARK && (rest.is_empty() || rest.starts_with([' ', '\r', '\n']))
}
