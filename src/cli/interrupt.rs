//! An interrupt leaves nothing half-written: the temporary file is removed as the process ends.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

/// The exit code of a process that an interrupt ended: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// The temporary file that exists now, if any. It is made, renamed and removed under this lock.
static PENDING: Mutex<Option<PathBuf>> = Mutex::new(None);

/// Watches for Ctrl-C.
pub(super) fn watch() {
    // Without a handler the process still ends, but leaves its temporary file.
    let _ = ctrlc::set_handler(|| {
        let pending = PENDING.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(path) = &*pending {
            let _ = std::fs::remove_file(path);
        }
        std::process::exit(INTERRUPTED);
    });
}

/// Makes a temporary file, which an interrupt from here on removes.
pub(super) fn begin(make: impl FnOnce() -> io::Result<NamedTempFile>) -> io::Result<NamedTempFile> {
    let mut pending = PENDING.lock().unwrap_or_else(PoisonError::into_inner);
    let file = make()?;
    *pending = Some(file.path().to_owned());
    Ok(file)
}

/// Gives a temporary file its name; a file that has the name is replaced.
pub(super) fn end(file: NamedTempFile, path: &Path) -> io::Result<()> {
    let mut pending = PENDING.lock().unwrap_or_else(PoisonError::into_inner);
    *pending = None;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}
