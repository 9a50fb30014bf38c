//! Reporting: a mistake is reported where it is found, in one statement.

use super::Checker;
use super::types::Typed;
use crate::diagnostic::{Applicability, Code, Diagnostic, Label, suggest};
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{Expr, ExprKind, Ident};
use crate::syntax::print;
use std::collections::BTreeMap;
use std::fmt::Display;

/// A diagnostic under construction; it is reported when it is dropped.
pub struct Draft<'d> {
    diagnostic: Option<Diagnostic>,
    reported: &'d mut Vec<Diagnostic>,
}

impl Drop for Draft<'_> {
    fn drop(&mut self) {
        self.reported.extend(self.diagnostic.take());
    }
}

impl<'d> Draft<'d> {
    /// A diagnostic that goes to `reported`.
    pub fn new(
        reported: &'d mut Vec<Diagnostic>,
        code: Code,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Self {
            diagnostic: Some(Diagnostic::new(code, span, message)),
            reported,
        }
    }

    /// Nothing: whatever is added to it is dropped.
    pub fn silent(reported: &'d mut Vec<Diagnostic>) -> Self {
        Self {
            diagnostic: None,
            reported,
        }
    }

    fn with(mut self, add: impl FnOnce(Diagnostic) -> Diagnostic) -> Self {
        self.diagnostic = self.diagnostic.take().map(add);
        self
    }

    /// Says something at the primary place.
    pub fn label(self, message: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.label(message))
    }

    /// Labels the primary place with what is there.
    pub fn this_is(self, what: impl Display) -> Self {
        self.label(format!("this is {what}"))
    }

    /// Says something at a further place.
    pub fn also(self, span: Span, message: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.also(span, message))
    }

    /// Adds a note.
    pub fn note(self, note: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.note(note))
    }

    /// Adds a note where there is any.
    pub fn note_if(self, note: Option<String>) -> Self {
        match note {
            Some(note) => self.note(note),
            None => self,
        }
    }

    /// Adds advice.
    pub fn help(self, help: impl Into<String>) -> Self {
        self.with(|diagnostic| diagnostic.help(help))
    }

    /// Adds advice where there is any.
    pub fn help_if(self, help: Option<String>) -> Self {
        match help {
            Some(help) => self.help(help),
            None => self,
        }
    }

    /// Offers to replace the text of one span.
    pub fn fix(
        self,
        title: impl Into<String>,
        span: Span,
        replacement: impl Into<String>,
        applicability: Applicability,
    ) -> Self {
        self.with(|diagnostic| diagnostic.fix(title, span, replacement, applicability))
    }

    /// Offers the name that was likely meant, if there is one.
    pub fn likely(self, name: &Ident, likely: Option<&str>) -> Self {
        match likely {
            None => self,
            Some(likely) => {
                let question = format!("did you mean `{likely}`?");
                self.label(question.clone()).fix(
                    question,
                    name.span,
                    spelled(likely),
                    Applicability::Unsafe,
                )
            }
        }
    }

    /// Reports it.
    pub fn emit(self) {}

    /// Reports it, with nothing to return.
    pub fn none<T>(self) -> Option<T> {
        None
    }

    /// Reports it; the expression that it is about has no meaning.
    pub fn typed(self) -> Typed {
        Typed::error(
            self.diagnostic
                .as_ref()
                .map_or_else(Span::default, Diagnostic::span),
        )
    }
}

impl<'a> Checker<'a> {
    /// Reports an error at `span`, with what is added to it in the same statement.
    pub fn error(&mut self, code: Code, span: Span, message: impl Into<String>) -> Draft<'_> {
        Draft::new(&mut self.diagnostics, code, span, message)
    }

    /// Reports a warning at `span`: what differs from an error is its code.
    pub fn warning(&mut self, code: Code, span: Span, message: impl Into<String>) -> Draft<'_> {
        self.error(code, span, message)
    }

    /// Reports a name that `owner` does not have among its `known` ones.
    pub fn unknown_to(
        &mut self,
        owner: &str,
        code: Code,
        name: &Ident,
        what: &str,
        known: &[&str],
    ) -> Draft<'_> {
        let label = match known {
            [] => "it has none".to_owned(),
            known => format!("it has {}", listed(known, "and")),
        };
        let message = format!("{owner} has no {what} `{}`", name.name);
        let only = match known {
            [only] => Some(*only),
            _ => None,
        };
        let likely = suggest::nearest(&name.name, known.iter().copied()).or(only);
        // That one is not missing as well.
        if let Some(likely) = likely {
            self.names.lose(likely);
        }
        self.error(code, name.span, message)
            .label(label)
            .likely(name, likely)
    }

    /// Reports something that is given a second time.
    pub fn said_twice(&mut self, what: &str, here: Span, first: Span) {
        self.error(Code::E0503, here, format!("`{what}` is given twice"))
            .label("given again here")
            .also(first, "first given here");
    }

    /// Reports a part that `owner` lacks, unless it may stand in what was not understood.
    pub fn missing(&mut self, code: Code, span: Span, owner: &str, missing: &str, example: &str) {
        let word = missing.split(' ').next().unwrap_or(missing);
        if self.names.is_lost(word) {
            return;
        }
        self.error(code, span, format!("{owner} has no `{missing}`"))
            .label(format!("`{missing}` is missing"))
            .help(format!("for example: `{example}`"));
    }

    /// Reports a value that is none of the `choices`.
    pub fn choice_of(&mut self, value: &Expr, what: &str, choices: &[&str]) {
        let name = match &value.kind {
            ExprKind::Error => return,
            ExprKind::Ref(reference) => Some(&reference.name),
            _ => None,
        };
        let span = name.map_or(value.span, |name| name.span);
        let draft = self
            .error(
                Code::E0403,
                span,
                format!("{what} is {}", listed(choices, "or")),
            )
            .label("this is not");
        if let ([only], ExprKind::Number(_)) = (choices, &value.kind)
            && let Some((shape, _)) = only.split_once('(')
        {
            let right = format!("{shape}({})", print::expr(value));
            let title = format!("write `{right}`");
            draft.fix(title, span, right, Applicability::Unsafe);
            return;
        }
        if let Some(name) = name {
            let words = choices.iter().filter_map(|choice| choice.split('(').next());
            draft.likely(name, suggest::nearest(&name.name, words));
        }
    }

    /// Reports a number outside its range.
    pub fn out_of_range(&mut self, span: Span, why: impl Into<String>, label: &str) -> Draft<'_> {
        self.error(Code::E0309, span, why).label(label)
    }

    /// Reports that `what` needs a world in a program without one.
    pub fn no_world(&mut self, span: Span, what: &str, label: &str) -> Draft<'_> {
        let message = format!("{what} needs a world, and there is none");
        self.error(Code::E0407, span, message).label(label)
    }
}

/// How many further places of one mistake are shown.
const SHOWN: usize = 3;

/// Makes one diagnostic of those that say the same of one thing in several places: a name that nothing declares, a
/// sensor or a world that is missing, entries of one list that are of the wrong kind, a wall that is taken for a place.
/// `declared` says where the name at a place is declared.
pub fn merge(sorted: &mut Vec<Diagnostic>, declared: impl Fn(Span) -> Option<Span>) {
    let mut first: BTreeMap<(Code, String), usize> = BTreeMap::new();
    let mut merged: Vec<Diagnostic> = Vec::new();
    let mut further: BTreeMap<usize, Vec<Span>> = BTreeMap::new();
    for found in sorted.drain(..) {
        let about = match found.code {
            // The sensors that a robot lacks for one use are one mistake.
            Code::E0406
                if merged
                    .last()
                    .is_some_and(|last| last.code == found.code && last.span() == found.span()) =>
            {
                if let Some(last) = merged.last_mut() {
                    last.notes.push(format!("and {}", found.message));
                }
                continue;
            }
            // `x` and `y` of a start are one place.
            Code::E0202
                if found
                    .help
                    .iter()
                    .any(|help| help.contains("where it starts")) =>
            {
                String::new()
            }
            Code::E0202 | Code::E0406 | Code::W0603 => found.message.clone(),
            Code::E0305 if found.message.contains(" needs its argument ") => found.message.clone(),
            Code::E0407 | Code::W0301 => String::new(),
            // What the world, or the length of an episode or of a tick, makes of several things.
            Code::W0512 => String::new(),
            Code::E0309 if found.message.ends_with(" is at least one tick") => String::new(),
            Code::E0404 | Code::W0401 => match about_places(&found.message) {
                Some(about) => about,
                None => {
                    merged.push(found);
                    continue;
                }
            },
            // The same of what stands side by side: the coordinates of a point, the arguments of a call.
            Code::E0301 | Code::E0302 | Code::E0305 | Code::E0403 | Code::E0601
                if merged.last().is_some_and(|last| is_beside(last, &found)) =>
            {
                if let Some(last) = merged.last_mut() {
                    join(last, found);
                }
                continue;
            }
            // One name, taken again and again for what it is not.
            Code::E0302 if declared(found.span()).is_some() => {
                let wanted = found.message.rsplit(" is ").next().unwrap_or_default();
                format!("{:?} {wanted}", declared(found.span()))
            }
            Code::E0203
                if merged
                    .last()
                    .is_some_and(|last| last.message == found.message) =>
            {
                found.message.clone()
            }
            Code::E0203 => {
                // Only what stands side by side is of one list.
                let message = found.message.clone();
                first.insert((found.code, message), merged.len());
                merged.push(found);
                continue;
            }
            _ => {
                merged.push(found);
                continue;
            }
        };
        match first.get(&(found.code, about.clone())) {
            Some(at) => {
                if found.code == Code::W0301
                    && let Some(first) = merged.get_mut(*at)
                {
                    join_fixes(first, &found);
                }
                further.entry(*at).or_default().push(found.span());
            }
            None => {
                first.insert((found.code, about), merged.len());
                merged.push(found);
            }
        }
    }
    for (at, places) in further {
        let Some(found) = merged.get_mut(at) else {
            continue;
        };
        let labels = places.iter().take(SHOWN).map(|span| Label {
            span: *span,
            message: "and here".to_owned(),
        });
        found.labels.extend(labels);
        match places.len().saturating_sub(SHOWN) {
            0 => {}
            1 => found.notes.push("and in one more place".to_owned()),
            more => found.notes.push(format!("and in {more} more places")),
        }
    }
    *sorted = merged;
}

/// How far what stands side by side is apart, in bytes.
const BESIDE: u32 = 24;

/// Whether two diagnostics say the same of what stands side by side.
fn is_beside(last: &Diagnostic, found: &Diagnostic) -> bool {
    let end = last.labels.last().map_or(last.span(), |label| label.span);
    let start = found.span();
    let plain = found.labels.len() == 1;
    let alike = last.message == found.message
        || lack_units(last) && lack_units(found)
        || last.code == found.code
            && owner(&last.message).is_some_and(|it| owner(&found.message) == Some(it));
    alike
        && plain
        && end.file == start.file
        && start.start >= end.end
        && start.start - end.end <= BESIDE
}

/// Adds a place to a diagnostic that says the same of the one before it, with its fix.
fn join(last: &mut Diagnostic, found: Diagnostic) {
    last.labels.push(Label {
        span: found.span(),
        message: "and here".to_owned(),
    });
    join_fixes(last, &found);
}

/// Adds the changes that mend another mistake of the same kind; without them the mistake is not mended.
fn join_fixes(last: &mut Diagnostic, found: &Diagnostic) {
    let (units, percent) = (lack_units(found), found.code == Code::W0301);
    match (last.fixes.as_mut_slice(), found.fixes.as_slice()) {
        ([one], [other]) => {
            one.edits.extend(other.edits.iter().cloned());
            one.applicability = one.applicability.max(other.applicability);
            if one.title != other.title {
                one.title = match (units, percent) {
                    (true, _) => "give each its unit".to_owned(),
                    (_, true) => "write each with `%`".to_owned(),
                    _ => {
                        let words: Vec<&str> = one.edits.iter().map(|(_, it)| it.trim()).collect();
                        format!("write {}", listed(&words, "and"))
                    }
                };
            }
        }
        _ => last.fixes.clear(),
    }
}

/// Whether a number lacks its unit, as the fix says.
fn lack_units(found: &Diagnostic) -> bool {
    let mut fixes = found.fixes.iter();
    found.code == Code::E0301 && fixes.any(|fix| fix.title.starts_with("give "))
}

/// What has no setting, or no parameter, of a name.
fn owner(message: &str) -> Option<&str> {
    let parts = [" has no setting ", " has no parameter "];
    parts
        .iter()
        .find_map(|part| Some(message.split_once(part)?.0))
}

/// What is said of places, each for itself, where one wall or one robot is the reason.
fn about_places(message: &str) -> Option<String> {
    let of_wall = message.split_once(" lies in the wall ");
    let of_robot = [
        "no way leads to the place",
        "the robot does not fit into the place",
    ];
    let of_robot = of_robot.iter().find(|begin| message.starts_with(**begin));
    of_wall
        .map(|(_, wall)| wall.to_owned())
        .or_else(|| of_robot.map(|begin| (*begin).to_owned()))
}

/// Names in a sentence: `a`, `b` and `c`.
pub fn listed(names: &[&str], word: &str) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} {word} {last}", most.join(", ")),
    }
}
