//! A new folder with folders in it: there as a whole, or not at all.

use super::disk::Disk;
use super::file::{folder_of, settle};
use super::folder::Folder;
use super::stale;
use std::io;
use std::path::Path;

/// Makes a folder that is not there yet, with these files: their paths in it, and their texts. It is made under a temporary
/// name beside its place, and then given its own.
///
/// # Errors
/// The system refuses; nothing is then left of the folder, nor of those around it that were missing.
pub fn make(disk: &dyn Disk, path: &Path, files: &[(&str, &str)]) -> io::Result<()> {
    let around = folder_of(path);
    let missing = Folder::new(around).missing();
    let mut outermost_first = missing.iter().rev();
    let made = outermost_first
        .try_for_each(|path| disk.make_folder(path))
        .and_then(|()| within(disk, around, path, files));
    if made.is_err() {
        Folder::unmake(disk, &missing);
    }
    made
}

fn within(disk: &dyn Disk, around: &Path, path: &Path, files: &[(&str, &str)]) -> io::Result<()> {
    stale::sweep(disk, around);
    let (draft, _held) = stale::draft(disk, around)?;
    let made = files
        .iter()
        .try_for_each(|(name, text)| put(disk, &draft, name, text))
        .and_then(|()| disk.rename(&draft, path));
    match made {
        Ok(()) => settle(disk, around),
        Err(_) => stale::discard(disk, &draft),
    }
    made
}

/// Writes one file, and makes the folders that it stands in.
fn put(disk: &dyn Disk, draft: &Path, name: &str, text: &str) -> io::Result<()> {
    let path = draft.join(name);
    let missing = Folder::new(folder_of(&path)).missing();
    missing
        .iter()
        .rev()
        .try_for_each(|folder| disk.make_folder(folder))?;
    let mut file = disk.create(&path)?;
    disk.write(&mut file, text.as_bytes())?;
    disk.sync(&file)
}
