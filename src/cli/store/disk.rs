//! The calls by which anything is written.

use std::fs::{self, File, Permissions};
use std::io::{self, Write};
use std::path::Path;

/// The calls by which anything is written.
pub trait Disk: Sync {
    /// Makes a file that is not there yet, locked.
    ///
    /// # Errors
    /// There is one, or the system refuses.
    fn create(&self, path: &Path) -> io::Result<File>;

    /// Writes the whole of a new file.
    ///
    /// # Errors
    /// The system refuses.
    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()>;

    /// Waits until a file, or the names in a folder, are on the disk.
    ///
    /// # Errors
    /// The system refuses.
    fn sync(&self, file: &File) -> io::Result<()>;

    /// Gives a file or a folder another name. A file that has the name is replaced.
    ///
    /// # Errors
    /// The system refuses.
    fn rename(&self, from: &Path, to: &Path) -> io::Result<()>;

    /// Exchanges two folders in one step.
    ///
    /// # Errors
    /// The system refuses, or cannot do so.
    fn exchange(&self, one: &Path, other: &Path) -> io::Result<()>;

    /// Gives a file a second name.
    ///
    /// # Errors
    /// The system refuses.
    fn link(&self, from: &Path, to: &Path) -> io::Result<()>;

    /// Makes a folder that is not there yet.
    ///
    /// # Errors
    /// There is one, or the system refuses.
    fn make_folder(&self, path: &Path) -> io::Result<()>;

    /// Sets who may read and write what.
    ///
    /// # Errors
    /// The system refuses.
    fn permit(&self, path: &Path, permissions: Permissions) -> io::Result<()>;

    /// Removes a file.
    ///
    /// # Errors
    /// The system refuses.
    fn remove_file(&self, path: &Path) -> io::Result<()>;

    /// Removes an empty folder.
    ///
    /// # Errors
    /// The system refuses.
    fn remove_folder(&self, path: &Path) -> io::Result<()>;
}

/// The disk of the system.
#[derive(Clone, Copy, Debug)]
pub struct System;

impl Disk for System {
    fn create(&self, path: &Path) -> io::Result<File> {
        let file = File::create_new(path)?;
        hold(&file, path)?;
        Ok(file)
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()> {
        file.write_all(bytes)
    }

    fn sync(&self, file: &File) -> io::Result<()> {
        file.sync_all()
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::rename(from, to)
    }

    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    fn exchange(&self, one: &Path, other: &Path) -> io::Result<()> {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        Ok(renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE)?)
    }

    #[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
    fn exchange(&self, _: &Path, _: &Path) -> io::Result<()> {
        Err(io::ErrorKind::Unsupported.into())
    }

    fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        fs::hard_link(from, to)
    }

    fn make_folder(&self, path: &Path) -> io::Result<()> {
        fs::create_dir(path)
    }

    fn permit(&self, path: &Path, permissions: Permissions) -> io::Result<()> {
        fs::set_permissions(path, permissions)
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        fs::remove_file(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        fs::remove_dir(path)
    }
}

/// Locks what was just made, which tells other runs that its maker lives. One that found it before the lock has removed it.
///
/// # Errors
/// It is gone again, as [`io::ErrorKind::AlreadyExists`], for another name will do.
pub(super) fn hold(file: &File, path: &Path) -> io::Result<()> {
    // Where there are no locks, nothing takes what is being made for stale either.
    let _ = file.lock();
    match fs::symlink_metadata(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            Err(io::ErrorKind::AlreadyExists.into())
        }
        _ => Ok(()),
    }
}
