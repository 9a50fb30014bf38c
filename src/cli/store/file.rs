//! A single file, whole or not at all.

use super::disk::Disk;
use super::stale;
use std::fs::{self, File};
use std::io;
use std::path::Path;

/// Writes to a temporary name beside the file, synced and renamed. An existing file keeps its permissions, a link stays a
/// link.
///
/// # Errors
/// The system refuses; the file is then what it was.
pub fn write(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> io::Result<()> {
    let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
    let old = fs::metadata(path).ok();
    let folder = folder_of(path);
    stale::sweep(disk, folder);
    let (temporary, mut file) = stale::file(disk, folder)?;
    let written = || -> io::Result<()> {
        disk.write(&mut file, bytes)?;
        if let Some(old) = old {
            disk.permit(&temporary, old.permissions())?;
        }
        disk.sync(&file)?;
        disk.rename(&temporary, path)
    };
    let done = written();
    match done {
        Ok(()) => settle(disk, folder),
        Err(_) => {
            let _ = disk.remove_file(&temporary);
        }
    }
    done
}

/// Waits until the names in a folder are on the disk, as far as the system can.
pub(super) fn settle(disk: &dyn Disk, folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = disk.sync(&folder);
    }
}

/// The folder that a file or a folder stands in.
pub fn folder_of(path: &Path) -> &Path {
    let parent = path.parent();
    let parent = parent.filter(|parent| !parent.as_os_str().is_empty());
    parent.unwrap_or_else(|| Path::new("."))
}
