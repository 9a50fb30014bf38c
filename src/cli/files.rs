//! Reading programs, writing results.

use super::report::{Reporter, tell};
use super::{Failure, interrupt};
use crate::driver::load::{self, Loaded, Reader};
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};

/// The name that stands for standard input.
pub(super) const STDIN: &str = "-";

/// Files as the system has them.
pub(super) struct Disk;

impl Reader for Disk {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        std::fs::read(path).map_err(|error| error.to_string())
    }
}

/// The bytes of a file, or of standard input, with the name by which diagnostics call it.
pub(super) fn read(path: &str) -> Result<(String, Vec<u8>), Failure> {
    if path == STDIN {
        let mut bytes = Vec::new();
        return match io::stdin().read_to_end(&mut bytes) {
            Ok(_) => Ok(("<stdin>".to_owned(), bytes)),
            Err(error) => Err(complain(&format!("standard input: {error}"))),
        };
    }
    match std::fs::read(path) {
        Ok(bytes) => Ok((path.to_owned(), bytes)),
        Err(error) => Err(complain(&format!("{path}: {error}"))),
    }
}

/// A mistake that has no place in a text.
pub(super) fn complain(message: &str) -> Failure {
    tell(&format!("error: {message}"));
    Failure::Input
}

/// Loads a program and reports what there is to report; a program with errors is a failure.
pub(super) fn load(path: &str, say: &Reporter) -> Result<Loaded, Failure> {
    let (name, bytes) = read(path)?;
    let loaded = load::load(&name, bytes, &mut Disk);
    say.all(&loaded.sources, &loaded.diagnostics);
    if loaded.has_errors() {
        say.count(&loaded.diagnostics);
        return Err(Failure::Input);
    }
    Ok(loaded)
}

/// Writes a whole file or nothing: to a temporary name beside it, synced and renamed. A file that was there keeps its
/// permissions, a link goes on to lead to it, and what is no file (a device, a pipe) is written to as it is.
pub(super) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let attempt = || -> io::Result<()> {
        let path = &path.canonicalize().unwrap_or_else(|_| path.to_owned());
        let old = std::fs::metadata(path).ok();
        if old.as_ref().is_some_and(|old| !old.is_file()) {
            return std::fs::write(path, text);
        }
        let folder = path
            .parent()
            .filter(|parent| !parent.as_os_str().is_empty());
        let folder = folder.unwrap_or_else(|| Path::new("."));
        let mut builder = tempfile::Builder::new();
        builder.prefix(".btc-");
        // A temporary file is its owner's alone; a result is anybody's to read.
        #[cfg(unix)]
        builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o644));
        let mut file = interrupt::begin(|| builder.tempfile_in(folder))?;
        file.write_all(text.as_bytes())?;
        if let Some(old) = old {
            file.as_file().set_permissions(old.permissions())?;
        }
        file.as_file().sync_all()?;
        interrupt::end(file, path)
    };
    attempt().map_err(|error| complain(&format!("{}: {error}", path.display())))
}

/// Writes to a file, or to standard output.
pub(super) fn put(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path {
        Some(path) => write(path, text),
        None => print(text),
    }
}

/// Writes to standard output; a reader that has gone away is no mistake.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(complain(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// The path of a file from a folder, with `/` between its parts. Both are looked at as they are on disk.
pub(super) fn from_folder(folder: &Path, file: &Path) -> Result<String, Failure> {
    let whole = |path: &Path| {
        path.canonicalize()
            .map_err(|error| complain(&format!("{}: {error}", path.display())))
    };
    let (folder, file) = (whole(folder)?, whole(file)?);
    let parts = |path: &PathBuf| -> Vec<String> {
        path.components()
            .filter(|part| !matches!(part, Component::RootDir))
            .map(|part| part.as_os_str().to_string_lossy().into_owned())
            .collect()
    };
    let (folder, file) = (parts(&folder), parts(&file));
    let shared = folder.iter().zip(&file).take_while(|(a, b)| a == b).count();
    let up = folder.iter().skip(shared).map(|_| "..".to_owned());
    let down = file.iter().skip(shared).cloned();
    Ok(up.chain(down).collect::<Vec<_>>().join("/"))
}
