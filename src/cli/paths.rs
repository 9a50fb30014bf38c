//! Paths as programs name them: relative, with `/` between their parts.

use super::files::DASH;
use super::store::file::folder_of;
use super::{Failure, files};
use crate::driver::digest::sha256;
use crate::driver::load::Loaded;
use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

/// How a program that is written to `output`, or printed, names the program in a file; `None` for standard input.
///
/// # Errors
/// As [`used_from`].
pub(super) fn used_by(output: Option<&Path>, file: &str) -> Result<Option<String>, Failure> {
    match output {
        _ if file == DASH => Ok(None),
        None => Ok(Some(file.to_owned())),
        Some(output) => used_from(folder_of(output), Path::new(file)).map(Some),
    }
}

/// The path of a file from a folder as a `use` names it, after all links are followed.
///
/// # Errors
/// It cannot be found, or a `use` cannot name it.
pub(super) fn used_from(folder: &Path, file: &Path) -> Result<String, Failure> {
    let path = from_folder(folder, file)?;
    let why = if path.contains('"') {
        "a quotation mark"
    } else if path.contains('\n') {
        "a line break"
    } else if path.ends_with(".csv") {
        "the ending of a table"
    } else {
        return Ok(path);
    };
    let message =
        format!("`{path}` has {why}, so that no `use` can name it as a program: rename it");
    Err(files::complain(&message))
}

/// The path of a file from a folder, after all links are followed.
fn from_folder(folder: &Path, file: &Path) -> Result<String, Failure> {
    let whole = |path: &Path| {
        path.canonicalize()
            .map_err(|error| files::complain(&format!("{}: {error}", path.display())))
    };
    // A folder that is made later is given as it will be.
    let folder = folder.canonicalize().unwrap_or_else(|_| folder.to_owned());
    let file = whole(file)?;
    let parts = |path: &PathBuf| -> Vec<PathBuf> {
        let parts = path.components();
        let parts = parts.filter(|part| !matches!(part, Component::RootDir));
        parts.map(|part| PathBuf::from(part.as_os_str())).collect()
    };
    let (from, to) = (parts(&folder), parts(&file));
    let shared = from.iter().zip(&to).take_while(|(a, b)| a == b).count();
    let mut path = vec![".."; from.len() - shared];
    for part in to.iter().skip(shared) {
        let Some(part) = part.to_str() else {
            let message = "is not UTF-8, so that no `use` can name it: rename it";
            return Err(files::complain(&format!(
                "{}: the path {message}",
                file.display()
            )));
        };
        path.push(part);
    }
    Ok(path.join("/"))
}

/// The hash of each file of a program, by the name that it was given.
pub(super) fn program_by_name(loaded: &Loaded) -> BTreeMap<String, String> {
    let files = loaded.files.iter().filter_map(|id| loaded.sources.get(*id));
    files
        .map(|source| (source.name.clone(), sha256(source.text.as_bytes())))
        .collect()
}

/// The hash of each file of a program, by its path from a folder.
///
/// # Errors
/// A file is gone.
pub(super) fn program_of(
    loaded: &Loaded,
    folder: &Path,
) -> Result<BTreeMap<String, String>, Failure> {
    let files = loaded.files.iter().filter_map(|id| loaded.sources.get(*id));
    files
        .map(|source| {
            let path = from_folder(folder, Path::new(&source.name))?;
            Ok((path, sha256(source.text.as_bytes())))
        })
        .collect()
}
