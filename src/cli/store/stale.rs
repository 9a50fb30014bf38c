//! What dead runs have left: temporary files and folders that no run holds.

use super::disk::{self, Disk};
use super::manifest::{self, Manifest};
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// What the names of temporary files begin with.
const FILE: &str = ".btc-file-";

/// What the names of folders begin with in which a result is made.
const STAGE: &str = ".btc-stage-";

/// What the names of folders begin with that are made before they take their place, and have nothing of anyone else in them.
const DRAFT: &str = ".btc-draft-";

/// What is added to the name of a file that is kept while another takes its place.
pub(super) const BACKUP: &str = ".btc-old";

/// The most names that are tried.
const NAMES: u32 = 10_000;

/// Makes a temporary file in a folder.
pub(super) fn file(disk: &dyn Disk, folder: &Path) -> io::Result<(PathBuf, File)> {
    fresh(folder, FILE, |path| disk.create(path))
}

/// Makes a folder for a result within another folder, locked where folders can be.
pub(super) fn stage(disk: &dyn Disk, folder: &Path) -> io::Result<(PathBuf, Option<File>)> {
    fresh(folder, STAGE, |path| held_folder(disk, path))
}

/// Makes a folder within another folder that is to take another place as a whole, locked where folders can be.
pub(super) fn draft(disk: &dyn Disk, folder: &Path) -> io::Result<(PathBuf, Option<File>)> {
    fresh(folder, DRAFT, |path| held_folder(disk, path))
}

fn held_folder(disk: &dyn Disk, path: &Path) -> io::Result<Option<File>> {
    disk.make_folder(path)?;
    let held = File::open(path).ok();
    if let Some(held) = &held {
        disk::hold(held, path)?;
    }
    Ok(held)
}

/// Makes something under a name that nothing has.
fn fresh<T>(
    folder: &Path,
    begin: &str,
    make: impl Fn(&Path) -> io::Result<T>,
) -> io::Result<(PathBuf, T)> {
    let process = std::process::id();
    for number in 0..NAMES {
        let path = folder.join(format!("{begin}{process}-{number}"));
        match make(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            made => return Ok((path, made?)),
        }
    }
    Err(io::ErrorKind::AlreadyExists.into())
}

/// Removes what dead runs have left in a folder. What cannot be removed stays.
pub(super) fn sweep(disk: &dyn Disk, folder: &Path) {
    let Ok(entries) = fs::read_dir(folder) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let is = |begin: &str| is_named(&path, begin);
        let Ok(found) = fs::symlink_metadata(&path) else {
            continue;
        };
        let (file, stage) = (found.is_file() && is(FILE), found.is_dir() && is(STAGE));
        let draft = found.is_dir() && is(DRAFT);
        if !file && !stage && !draft {
            continue;
        }
        // The lock is kept until the name is gone, so that who waits for it sees that.
        let Ok(held) = File::open(&path) else {
            continue;
        };
        if held.try_lock().is_err() {
            continue;
        }
        if file {
            let _ = disk.remove_file(&path);
        } else if draft {
            discard(disk, &path);
        } else {
            clear(disk, &path);
        }
    }
}

/// Removes a draft with all that is in it.
pub(super) fn discard(disk: &dyn Disk, draft: &Path) {
    for path in fs::read_dir(draft).into_iter().flatten().flatten() {
        let path = path.path();
        match fs::symlink_metadata(&path).is_ok_and(|found| found.is_dir()) {
            true => discard(disk, &path),
            false => drop(disk.remove_file(&path)),
        }
    }
    let _ = disk.remove_folder(draft);
}

/// Whether a name is one of those that [`fresh`] makes.
fn is_named(path: &Path, begin: &str) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    let rest = name.and_then(|name| name.strip_prefix(begin));
    rest.is_some_and(|rest| rest.chars().all(|c| c.is_ascii_digit() || c == '-'))
}

/// Removes a stage with all that is ours in it, and second names of files. Anything else stays, with the stage.
pub(super) fn clear(disk: &dyn Disk, stage: &Path) {
    let manifest = Manifest::of_folder(stage);
    // A stage within the folder that it is for may have given its manifest away.
    let manifest = manifest.or_else(|| Manifest::of_folder(stage.parent()?));
    let manifest = manifest.unwrap_or_default();
    let Ok(entries) = fs::read_dir(stage) else {
        return;
    };
    for path in entries.flatten().map(|entry| entry.path()) {
        let name = path.file_name().and_then(|name| name.to_str());
        let Ok(found) = fs::symlink_metadata(&path) else {
            continue;
        };
        if found.is_dir() {
            if name == Some(super::checkpoint::FOLDER) {
                empty(disk, &path);
                let _ = disk.remove_folder(&path);
            } else if is_named(&path, STAGE) {
                clear(disk, &path);
            }
            continue;
        }
        let ours = name.is_some_and(|name| {
            let marks = name.ends_with(BACKUP) || name.starts_with(manifest::NAME);
            marks || manifest.names(name) || is_named(&path, FILE)
        });
        if name != Some(manifest::NAME) && (ours || has_other_names(&found)) {
            let _ = disk.remove_file(&path);
        }
    }
    // The manifest, which says what is ours, goes last.
    let left = fs::read_dir(stage).into_iter().flatten().flatten();
    if left
        .into_iter()
        .all(|entry| entry.file_name() == manifest::NAME)
    {
        let _ = disk.remove_file(&stage.join(manifest::NAME));
        let _ = disk.remove_folder(stage);
    }
}

/// Removes what a run has kept in a folder. Where that is a link to another folder, nothing there is ours.
pub(super) fn empty(disk: &dyn Disk, folder: &Path) {
    if folder.is_symlink() {
        return;
    }
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        let name = path.file_name().and_then(|name| name.to_str());
        if name.is_some_and(super::checkpoint::keeps) || is_named(&path, FILE) {
            let _ = disk.remove_file(&path);
        }
    }
}

/// Whether a file has another name somewhere else.
#[cfg(unix)]
fn has_other_names(found: &fs::Metadata) -> bool {
    std::os::unix::fs::MetadataExt::nlink(found) > 1
}

#[cfg(not(unix))]
fn has_other_names(_: &fs::Metadata) -> bool {
    false
}
