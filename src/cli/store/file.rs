//! Single files, whole or not at all.

use super::disk::Disk;
use super::stale;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

/// Writes to a temporary name beside the file, synced and renamed. An existing file keeps its permissions, a link stays a
/// link.
///
/// # Errors
/// The system refuses; the file is then what it was.
pub fn write(disk: &dyn Disk, path: &Path, bytes: &[u8]) -> io::Result<()> {
    Draft::new(disk, path, bytes)?.publish()
}

/// Writes several files, each as [`write()`] does. All are on the disk before the first of them gets its name.
///
/// # Errors
/// The system refuses one of them, whose path is given; all are then what they were. A process that is killed between two
/// names leaves files of both ages, each of them whole.
pub fn write_all<'f>(
    disk: &dyn Disk,
    files: &[(&'f Path, &[u8])],
) -> Result<(), (&'f Path, io::Error)> {
    let mut drafts = Vec::new();
    for (path, bytes) in files {
        let draft = Draft::new(disk, path, bytes).map_err(|error| (*path, error))?;
        drafts.push((*path, fs::read(path).ok(), draft));
    }
    let mut published: Vec<(PathBuf, Option<Vec<u8>>)> = Vec::new();
    for (path, old, draft) in drafts {
        let target = draft.target.clone();
        if let Err(error) = draft.publish() {
            for (target, old) in &published {
                let _ = match old {
                    Some(old) => write(disk, target, old),
                    None => disk.remove_file(target),
                };
            }
            return Err((path, error));
        }
        published.push((target, old));
    }
    Ok(())
}

/// The new content of a file under a temporary name, which is removed again if it does not become the file.
struct Draft<'d> {
    disk: &'d dyn Disk,
    target: PathBuf,
    temporary: PathBuf,
    /// Locked, so that no other run takes the draft for stale.
    _held: File,
}

impl<'d> Draft<'d> {
    fn new(disk: &'d dyn Disk, path: &Path, bytes: &[u8]) -> io::Result<Self> {
        let target = path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let old = fs::metadata(&target).ok();
        let folder = folder_of(&target);
        stale::sweep(disk, folder);
        let (temporary, mut file) = stale::file(disk, folder)?;
        let written = disk
            .write(&mut file, bytes)
            .and_then(|()| match old {
                Some(old) => disk.permit(&temporary, old.permissions()),
                None => Ok(()),
            })
            .and_then(|()| disk.sync(&file));
        let draft = Self {
            disk,
            target,
            temporary,
            _held: file,
        };
        written.map(|()| draft)
    }

    /// Gives the content its name.
    fn publish(mut self) -> io::Result<()> {
        self.disk.rename(&self.temporary, &self.target)?;
        self.temporary = PathBuf::new();
        settle(self.disk, folder_of(&self.target));
        Ok(())
    }
}

impl Drop for Draft<'_> {
    fn drop(&mut self) {
        if !self.temporary.as_os_str().is_empty() {
            let _ = self.disk.remove_file(&self.temporary);
        }
    }
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
