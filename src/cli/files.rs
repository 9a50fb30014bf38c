//! Reading programs, writing results.

use super::report::{Reporter, tell};
use super::{Failure, interrupt};
use crate::driver::Text;
use crate::driver::load::{self, Loaded};
use crate::facade::disk::Disk;
use std::io::{self, Read, Write};
use std::path::{Component, Path, PathBuf};

/// The name that stands for standard input.
pub(super) const STDIN: &str = "-";

/// A file, or standard input, as it was read.
pub(super) struct File {
    /// The name in diagnostics.
    pub(super) name: String,
    /// The bytes.
    pub(super) bytes: Vec<u8>,
}

impl File {
    /// The file as the driver takes it.
    pub(super) fn text(&self) -> Text<'_> {
        Text {
            name: &self.name,
            bytes: &self.bytes,
        }
    }
}

/// Reads a file, or standard input.
pub(super) fn read(path: &str) -> Result<File, Failure> {
    let bytes = bytes(path).map_err(|error| {
        let place = if path == STDIN {
            "standard input"
        } else {
            path
        };
        complain(&format!("{place}: {error}"))
    })?;
    let name = shown(path).to_owned();
    Ok(File { name, bytes })
}

/// What a file is called in diagnostics.
pub(super) fn shown(path: &str) -> &str {
    if path == STDIN { "<stdin>" } else { path }
}

/// The bytes of a file, or of standard input.
pub(super) fn bytes(path: &str) -> io::Result<Vec<u8>> {
    if path != STDIN {
        return std::fs::read(path);
    }
    let mut bytes = Vec::new();
    io::stdin().read_to_end(&mut bytes)?;
    Ok(bytes)
}

/// Reads a file, if one is named.
pub(super) fn read_optional(path: Option<&str>) -> Result<Option<File>, Failure> {
    path.map(read).transpose()
}

/// A mistake that has no place in a text.
pub(super) fn complain(message: &str) -> Failure {
    tell(&format!("error: {message}"));
    Failure::Input
}

/// Loads a program and writes its diagnostics; a program with errors is a failure.
pub(super) fn load(path: &str, say: &Reporter) -> Result<Loaded, Failure> {
    let file = read(path)?;
    let loaded = load::load(&file.name, file.bytes, &mut Disk);
    say.all(&loaded.sources, &loaded.diagnostics);
    if loaded.has_errors() {
        say.count(&loaded.diagnostics);
        return Err(Failure::Input);
    }
    Ok(loaded)
}

/// Writes a whole file or nothing: to a temporary name beside it, synced and renamed. An existing file keeps its
/// permissions, a link stays a link, and a device or a pipe is written to directly.
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
        // Only the owner may read a temporary file; anyone may read a result.
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

/// Makes a folder, with those that it stands in.
pub(super) fn make_folder(path: &Path) -> Result<(), Failure> {
    std::fs::create_dir_all(path).map_err(|error| complain(&format!("{}: {error}", path.display())))
}

/// Writes to a file, or to standard output.
pub(super) fn put(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path {
        Some(path) => write(path, text),
        None => print(text),
    }
}

/// Writes to standard output; a reader that has gone away is not an error.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(complain(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}

/// The path of a file from a folder, with `/` between its parts, after all links are followed.
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
