//! Why there is no result.

use crate::diagnostic::{Diagnostic, render};
use crate::driver::Refused;
use crate::driver::environment::Untaught;
use std::fmt;
use std::path::{Path, PathBuf};

/// Why there is no result.
#[derive(Debug)]
pub enum Error {
    /// A file cannot be read.
    File {
        /// Its path.
        path: PathBuf,
        /// Why, in the words of the system.
        source: std::io::Error,
    },
    /// The input has mistakes. [`fmt::Display`] shows each with the lines that it is about.
    Mistakes(Refused),
    /// Nothing can be learned in an environment.
    Untaught(Untaught),
}

impl Error {
    /// The mistakes, sorted by place; none if a file cannot be read.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        match self {
            Self::File { .. } | Self::Untaught(_) => &[],
            Self::Mistakes(refused) => &refused.diagnostics,
        }
    }

    pub(super) fn file(path: &Path, source: std::io::Error) -> Self {
        let path = path.to_owned();
        Self::File { path, source }
    }
}

impl fmt::Display for Error {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { path, source } => write!(f, "{}: {source}", path.display()),
            Self::Mistakes(Refused {
                sources,
                diagnostics,
            }) => f.write_str(render::human(sources, diagnostics, false).trim_end()),
            Self::Untaught(why) => why.fmt(f),
        }
    }
}

impl std::error::Error for Error {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        match self {
            Self::File { source, .. } => Some(source),
            Self::Mistakes(_) => None,
            Self::Untaught(why) => Some(why),
        }
    }
}

impl From<Untaught> for Error {
    fn from(why: Untaught) -> Self {
        Self::Untaught(why)
    }
}

impl From<Refused> for Error {
    fn from(refused: Refused) -> Self {
        Self::Mistakes(refused)
    }
}
