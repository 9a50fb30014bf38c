//! Diagnostics on standard error.

use super::Failure;
use crate::diagnostic::{Diagnostic, render};
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

/// Writes a line to standard error. Nobody may be left to read it: the result matters, not the report.
pub(super) fn tell(line: &str) {
    let _ = writeln!(std::io::stderr().lock(), "{line}");
}

/// Says what there is to say.
#[derive(Clone, Copy, Debug)]
pub(super) struct Reporter {
    color: bool,
}

impl Reporter {
    /// One that colours as it is told.
    pub(super) fn new(color: Color) -> Self {
        let color = match color {
            Color::Always => true,
            Color::Never => false,
            Color::Auto => {
                std::env::var_os("NO_COLOR").is_none() && std::io::stderr().is_terminal()
            }
        };
        Self { color }
    }

    /// Every diagnostic, for a person.
    pub(super) fn all(&self, sources: &Sources, diagnostics: &[Diagnostic]) {
        let text = render::human(sources, diagnostics, self.color);
        let _ = write!(std::io::stderr().lock(), "{text}");
    }

    /// One diagnostic that ends the command.
    pub(super) fn one(&self, sources: &Sources, diagnostic: Diagnostic) -> Failure {
        self.several(sources, &[diagnostic])
    }

    /// Diagnostics that end the command.
    pub(super) fn several(&self, sources: &Sources, diagnostics: &[Diagnostic]) -> Failure {
        self.all(sources, diagnostics);
        Failure::Input
    }

    /// How many there were.
    pub(super) fn count(&self, diagnostics: &[Diagnostic]) {
        let errors = diagnostics.iter().filter(|d| d.is_error()).count();
        let warnings = diagnostics.len() - errors;
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
