//! The files of the system.

use crate::driver::load::Reader;

/// Reads the files that a program uses from disk.
pub(crate) struct Disk;

impl Reader for Disk {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        std::fs::read(path).map_err(|error| error.to_string())
    }
}
