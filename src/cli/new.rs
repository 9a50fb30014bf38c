//! `btc new`

use super::{Failure, files};
use crate::driver::new::{FILES, welcome};
use clap::Args;
use std::path::Path;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The name of the project, and of its folder.
    name: String,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let name = &arguments.name;
    let folder = Path::new(name);
    if folder.exists() {
        return Err(files::complain(&format!("{name}: this is there already")));
    }
    if let Err(failure) = fill(folder) {
        // Half a project would be in the way of a whole one; what cannot be taken away is in the way of that, too.
        let _ = std::fs::remove_dir_all(folder);
        return Err(failure);
    }
    files::print(&welcome(name))
}

/// Writes the files of a project.
fn fill(folder: &Path) -> Result<(), Failure> {
    for (path, text) in FILES {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            std::fs::create_dir_all(parent)
                .map_err(|error| files::complain(&format!("{}: {error}", parent.display())))?;
        }
        files::write(&path, text)?;
    }
    Ok(())
}
