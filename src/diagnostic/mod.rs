//! What a diagnostic is: a coded, located message with labels, notes and fixes.

pub mod codes;
pub mod render;
pub mod suggest;

pub use codes::Code;

use crate::source::Span;
use serde::Serialize;

/// How grave a diagnostic is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// The program has a meaning, though perhaps not the one that was meant.
    Warning,
    /// The program has no meaning.
    Error,
}

/// A place in the text with what is to be said of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Label {
    /// The place.
    pub span: Span,
    /// What is said there; may be empty.
    pub message: String,
}

/// Whether a fix may be applied without a look.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Applicability {
    /// The fix keeps or restores what was meant.
    Safe,
    /// The fix is a likely guess.
    Unsafe,
}

/// A change to the text that mends the mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fix {
    /// What the fix does, in the imperative.
    pub title: String,
    /// The spans to replace and their new texts; they do not overlap.
    pub edits: Vec<(Span, String)>,
    /// Whether it may be applied unseen.
    pub applicability: Applicability,
}

/// One mistake, or one warning.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Diagnostic {
    /// Its code, which `btc explain` explains.
    pub code: Code,
    /// Error or warning.
    pub severity: Severity,
    /// What is wrong, in one line without a full stop.
    pub message: String,
    /// The places; the first is the primary one.
    pub labels: Vec<Label>,
    /// Facts that help to see why.
    pub notes: Vec<String>,
    /// What to do about it.
    pub help: Vec<String>,
    /// Changes that mend it.
    pub fixes: Vec<Fix>,
}

/// How many further places of one mistake are shown.
const SHOWN: usize = 3;

impl Diagnostic {
    /// A diagnostic of `code` at `span`; its severity is the code's.
    pub fn new(code: Code, span: Span, message: impl Into<String>) -> Self {
        Self {
            code,
            severity: code.severity(),
            message: message.into(),
            labels: vec![Label {
                span,
                message: String::new(),
            }],
            notes: Vec::new(),
            help: Vec::new(),
            fixes: Vec::new(),
        }
    }

    /// Says something at the primary place.
    #[must_use]
    pub fn label(mut self, message: impl Into<String>) -> Self {
        if let Some(primary) = self.labels.first_mut() {
            primary.message = message.into();
        }
        self
    }

    /// Says something at a further place.
    #[must_use]
    pub fn also(mut self, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(Label {
            span,
            message: message.into(),
        });
        self
    }

    /// Shows further places of one mistake, the first of them, and says how many more there are.
    #[must_use]
    pub fn and_at(mut self, places: &[Span], message: &str) -> Self {
        for place in places.iter().take(SHOWN) {
            self = self.also(*place, message);
        }
        match places.len().saturating_sub(SHOWN) {
            0 => self,
            1 => self.note("and in one more place"),
            more => self.note(format!("and in {more} more places")),
        }
    }

    /// Adds a note.
    #[must_use]
    pub fn note(mut self, note: impl Into<String>) -> Self {
        self.notes.push(note.into());
        self
    }

    /// Adds advice.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help.push(help.into());
        self
    }

    /// Says at the primary place what is to be written, and offers to write it over a span.
    #[must_use]
    pub fn write(self, span: Span, right: impl Into<String>, applicability: Applicability) -> Self {
        let right = right.into();
        let title = format!("write `{right}`");
        self.label(title.clone())
            .fix(title, span, right, applicability)
    }

    /// Offers to replace the text of one span.
    #[must_use]
    pub fn fix(
        mut self,
        title: impl Into<String>,
        span: Span,
        replacement: impl Into<String>,
        applicability: Applicability,
    ) -> Self {
        self.fixes.push(Fix {
            title: title.into(),
            edits: vec![(span, replacement.into())],
            applicability,
        });
        self
    }

    /// The primary place.
    pub fn span(&self) -> Span {
        self.labels
            .first()
            .map(|label| label.span)
            .unwrap_or_default()
    }

    /// Whether this is an error.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error
    }
}

/// Puts diagnostics into the order in which a reader meets them, each once.
pub fn sort(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(|a, b| (a.span(), a.code, &a.message).cmp(&(b.span(), b.code, &b.message)));
    diagnostics.dedup();
}
