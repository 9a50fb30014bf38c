//! `btc new`

use super::report::tell;
use super::store::{System, project};
use super::{Failure, files, interrupt};
use crate::diagnostic::render;
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
    if name.is_empty() {
        tell("error: a project needs a name");
        return Err(Failure::Usage);
    }
    if folder.exists() {
        return Err(files::complain(&format!("{name}: this is there already")));
    }
    interrupt::uninterrupted(|| project::make(&System, folder, &FILES))
        .map_err(|error| files::complain(&format!("{name}: {error}")))?;
    files::print(&welcome(&render::visible(name)))
}
