//! Diagnostics on standard error.

use super::Failure;
use crate::diagnostic::{Diagnostic, render};
use crate::driver::Refused;
use crate::source::Sources;
use clap::ValueEnum;
use std::io::{IsTerminal, Write};

/// When to colour.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    /// On a terminal.
    Auto,
    /// Always.
    Always,
    /// Never.
    Never,
}

/// How results are written.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum Format {
    /// For a person.
    Human,
    /// JSON.
    Json,
}

/// Writes a line to standard error. If nobody reads it, that is no failure: the result matters, not the report.
pub(super) fn tell(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{}", render::visible(line));
}

/// Writes diagnostics to standard error.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reporter {
    color: bool,
}

impl Reporter {
    /// A reporter that colours where `color` says so.
    pub(super) fn new(color: Color) -> Self {
        let color = match color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => {
                let set = |name| std::env::var_os(name).filter(|value| !value.is_empty());
                set("NO_COLOR").is_none()
                    && set("TERM").is_none_or(|term| term != "dumb")
                    && std::io::stderr().is_terminal()
            }
        };
        Self { color }
    }

    /// Every diagnostic, for a person.
    pub(super) fn all(&self, sources: &Sources, diagnostics: &[Diagnostic]) {
        let text = render::human(sources, diagnostics, self.color);
        let _ = write!(std::io::stderr().lock(), "{text}");
    }

    /// The mistakes that end a command.
    pub(super) fn refused(&self, refused: &Refused) -> Failure {
        self.all(&refused.sources, &refused.diagnostics);
        Failure::Input
    }

    /// The number of errors and warnings.
    pub(super) fn count<'d>(&self, diagnostics: impl IntoIterator<Item = &'d Diagnostic>) {
        let (mut errors, mut warnings) = (0, 0);
        for found in diagnostics {
            match found.is_error() {
                true => errors += 1,
                false => warnings += 1,
            }
        }
        let counted = |n: usize, what: &str| match n {
            0 => None,
            1 => Some(format!("1 {what}")),
            n => Some(format!("{n} {what}s")),
        };
        let parts: Vec<String> = [counted(errors, "error"), counted(warnings, "warning")]
            .into_iter()
            .flatten()
            .collect();
        if !parts.is_empty() {
            tell(&parts.join(", "));
        }
    }
}
