//! The files of the system.

use crate::driver::load::{MOST, Reader};
use std::fs::File;
use std::io::{self, Read};
use std::path::Path;

/// The most bytes of a table.
pub(crate) const TABLE: u64 = 1 << 30;

/// Reads the files that a program uses from disk.
pub(crate) struct Disk;

impl Reader for Disk {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let most = match path.ends_with(".csv") {
            true => TABLE,
            false => MOST as u64,
        };
        regular(Path::new(path), most).map_err(|error| error.to_string())
    }
}

/// The bytes of a file that is neither a device nor a pipe, see [`bounded`].
///
/// # Errors
/// It is no file, or as [`bounded`].
pub(crate) fn regular(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    // Whoever opens a pipe waits for its other end.
    if !std::fs::metadata(path)?.is_file() {
        return Err(io::Error::other("this is no file"));
    }
    bounded(File::open(path)?, most)
}

/// The bytes of a file. Of one that has more than `most`, one more is read, by which that is seen.
///
/// # Errors
/// The system refuses, or a table has more.
pub(crate) fn bounded(file: impl Read, most: u64) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(most.saturating_add(1)).read_to_end(&mut bytes)?;
    if most >= TABLE && bytes.len() as u64 > most {
        let message = format!("a table has at most {} GB", TABLE >> 30);
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, message));
    }
    Ok(bytes)
}
