//! Long lines, cut to what stands around the places that a diagnostic is about.

use crate::diagnostic::Diagnostic;
use crate::source::{FileId, Source, Sources, Span};

/// The bytes of a line above which it is cut.
const LONG: usize = 400;

/// The bytes that are kept before a place, and the most that are kept from there on.
const BEFORE: usize = 60;
const FROM: usize = 140;

/// What stands for what was cut.
const MARK: &str = "…";

/// A line of which a part is kept.
struct Cut {
    file: FileId,
    line: usize,
    /// Where the line begins and ends, without its break.
    start: usize,
    end: usize,
    /// The part that is kept.
    kept: std::ops::Range<usize>,
}

/// A diagnostic with the texts as they are shown.
pub(super) struct Excerpt {
    pub(super) sources: Sources,
    pub(super) diagnostic: Diagnostic,
    cuts: Vec<Cut>,
}

impl Excerpt {
    /// The diagnostic with its long lines cut; `None` if none is long.
    pub(super) fn of(sources: &Sources, diagnostic: &Diagnostic) -> Option<Self> {
        let mut cuts: Vec<Cut> = Vec::new();
        for label in &diagnostic.labels {
            let source = sources.get(label.span.file)?;
            let cut = Cut::around(label.span, source);
            let known = |cut: &Cut| {
                cuts.iter()
                    .any(|other| (other.file, other.line) == (cut.file, cut.line))
            };
            if let Some(cut) = cut.filter(|cut| !known(cut)) {
                cuts.push(cut);
            }
        }
        if cuts.is_empty() {
            return None;
        }
        cuts.sort_by_key(|cut| (cut.file, cut.start));
        let mut shown = Sources::default();
        for (id, source) in sources.iter() {
            let mut text = source.text.clone();
            for cut in cuts.iter().rev().filter(|cut| cut.file == id) {
                if cut.kept.end < cut.end {
                    text.replace_range(cut.kept.end..cut.end, MARK);
                }
                if cut.start < cut.kept.start {
                    text.replace_range(cut.start..cut.kept.start, MARK);
                }
            }
            shown.add(Source::new(source.name.clone(), text));
        }
        let mut diagnostic = diagnostic.clone();
        for label in &mut diagnostic.labels {
            let moved = |at: usize| moved(&cuts, label.span.file, at);
            let range = label.span.range();
            label.span = Span::new(label.span.file, moved(range.start), moved(range.end));
        }
        Some(Self {
            sources: shown,
            diagnostic,
            cuts,
        })
    }

    /// How many characters are missing at the beginning of a line, and stand for them.
    pub(super) fn missing(&self, original: &Sources, file: usize, line: usize) -> usize {
        let cut = self
            .cuts
            .iter()
            .find(|cut| cut.file.0 as usize == file && cut.line == line);
        let missing = cut
            .filter(|cut| cut.start < cut.kept.start)
            .and_then(|cut| {
                let text = &original.get(cut.file)?.text;
                Some(text.get(cut.start..cut.kept.start)?.chars().count() - MARK.chars().count())
            });
        missing.unwrap_or(0)
    }
}

impl Cut {
    /// The cut of the line in which a place begins, if it is long.
    fn around(place: Span, source: &Source) -> Option<Self> {
        let range = place.range();
        let at = u32::try_from(range.start).ok()?;
        let line = source.line(at).0;
        let start = source.line_start(line)? as usize;
        let end = source
            .line_start(line + 1)
            .map_or(source.text.len(), |next| next as usize);
        let text = source.text.get(start..end)?;
        let end = start + text.trim_end_matches(['\n', '\r']).len();
        if end - start <= LONG {
            return None;
        }
        let letter = |at: usize| {
            let mut before = (0..=at.min(source.text.len())).rev();
            before
                .find(|at| source.text.is_char_boundary(*at))
                .unwrap_or(0)
        };
        let from = letter(range.start.saturating_sub(BEFORE)).max(start);
        let to = letter(range.start + FROM).clamp(from, end);
        Some(Self {
            file: place.file,
            line,
            start,
            end,
            kept: from..to,
        })
    }
}

/// Where a byte of a file has gone.
fn moved(cuts: &[Cut], file: FileId, at: usize) -> usize {
    let mut gone = 0;
    let mut added = 0;
    for cut in cuts
        .iter()
        .filter(|cut| cut.file == file && cut.start <= at)
    {
        let at = at.clamp(cut.start, cut.end);
        if cut.start < cut.kept.start {
            gone += cut.kept.start.min(at) - cut.start;
            added += MARK.len();
        }
        if cut.kept.end < cut.end && cut.kept.end < at {
            gone += at - cut.kept.end;
            added += if at == cut.end { MARK.len() } else { 0 };
        }
    }
    at + added - gone
}
