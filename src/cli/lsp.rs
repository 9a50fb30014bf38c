//! `btc lsp`

use super::check::programs;
use super::results::Found;
use super::{Failure, files};
use crate::driver::load::{LIBRARY, Reader};
use crate::lsp::{Workspace, serve};
use clap::Args;
use lsp_server::Connection;
use std::cell::OnceCell;
use std::path::Path;
use tempfile::TempDir;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// Speak over standard input and output, as it does anyway: many editors give this.
    #[arg(long, hide = true)]
    stdio: bool,
}

/// The files of the system, as the command line reads them.
#[derive(Default)]
struct Files {
    /// Holds the text of the library while the server runs, once it was asked for.
    library: OnceCell<Option<TempDir>>,
}

impl Workspace for Files {
    fn reader(&self, main: &str) -> Box<dyn Reader + '_> {
        Box::new(Found::of(main))
    }

    fn programs(&self, folder: &str) -> Vec<String> {
        match Path::new(folder).is_dir() {
            true => programs(folder).unwrap_or_default(),
            false => Vec::new(),
        }
    }

    fn library(&self) -> Option<String> {
        let folder = self.library.get_or_init(|| {
            let folder = tempfile::Builder::new().prefix("btc-").tempdir().ok()?;
            std::fs::write(folder.path().join("std.bt"), LIBRARY).ok()?;
            Some(folder)
        });
        let path = folder.as_ref()?.path().join("std.bt");
        Some(path.to_str()?.to_owned())
    }
}

pub(super) fn run(_: &Arguments) -> Result<(), Failure> {
    let (connection, threads) = Connection::stdio();
    let served = serve(&connection, &Files::default());
    // The threads end when nothing more is to be sent.
    drop(connection);
    let told = |why: String| files::complain(&format!("the editor: {why}"));
    served.map_err(|why| told(why.to_string()))?;
    threads.join().map_err(|why| told(why.to_string()))
}
