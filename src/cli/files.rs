//! Reading programs, writing results.

use super::report::{Reporter, tell};
use super::results::Found;
use super::store::{Folder, System, file};
use super::{Failure, interrupt, results};
use crate::diagnostic::{Diagnostic, render};
use crate::driver::Text;
use crate::driver::load::{self, Loaded};
use crate::facade::disk::{TABLE, bounded};
use crate::source::Sources;
use std::collections::BTreeMap;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

/// The name that stands for standard input, and for standard output.
pub(super) const DASH: &str = "-";

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

/// Reads a table, or standard input. A file of a result that is not whole is refused.
pub(super) fn read(path: &str) -> Result<File, Failure> {
    match results::torn(path) {
        Some(torn) => Err(refuse(&torn)),
        None => read_alone(path, TABLE),
    }
}

/// Reads a file, or standard input, for itself: of more than `most` bytes, one more.
pub(super) fn read_alone(path: &str, most: u64) -> Result<File, Failure> {
    let bytes = bytes(path, most).map_err(|error| {
        let place = if path == DASH { "standard input" } else { path };
        let advice = match error.kind() == io::ErrorKind::NotFound && results::is_unfinished(path) {
            true => {
                ": the run that keeps its states there has not ended; `--resume` goes on with it"
            }
            false => "",
        };
        complain(&format!("{place}: {error}{advice}"))
    })?;
    let name = shown(path).to_owned();
    Ok(File { name, bytes })
}

/// What a file is called in diagnostics.
pub(super) fn shown(path: &str) -> &str {
    if path == DASH { "<stdin>" } else { path }
}

/// The bytes of a file, or of standard input.
pub(super) fn bytes(path: &str, most: u64) -> io::Result<Vec<u8>> {
    if path == DASH {
        return bounded(io::stdin().lock(), most);
    }
    let file = std::fs::File::open(path)?;
    // A device may give bytes without end.
    let most = match is_device(file.metadata()?.file_type()) {
        true => most.min(load::MOST as u64),
        false => most,
    };
    bounded(file, most)
}

#[cfg(unix)]
fn is_device(kind: std::fs::FileType) -> bool {
    use std::os::unix::fs::FileTypeExt;
    kind.is_char_device() || kind.is_block_device()
}

#[cfg(not(unix))]
fn is_device(_: std::fs::FileType) -> bool {
    false
}

/// Reads a file, if one is named.
pub(super) fn read_optional(path: Option<&str>) -> Result<Option<File>, Failure> {
    path.map(read).transpose()
}

/// A mistake with a code that has no place in a text.
pub(super) fn refuse(mistake: &Diagnostic) -> Failure {
    let text = render::human(&Sources::default(), std::slice::from_ref(mistake), false);
    tell(text.trim_end());
    Failure::Input
}

/// A mistake that has no place in a text.
pub(super) fn complain(message: &str) -> Failure {
    tell(&format!("error: {}", render::on_one_line(message)));
    Failure::Input
}

/// Loads a program and writes its diagnostics; a program with errors is a failure.
pub(super) fn load(path: &str, say: &Reporter) -> Result<Loaded, Failure> {
    if let Some(torn) = results::torn(path) {
        return Err(refuse(&torn));
    }
    let file = read_alone(path, load::MOST as u64)?;
    let mut found = Found::of(&file.name);
    let mut loaded = load::load(&file.name, file.bytes, &mut found);
    loaded.diagnostics.extend(found.changed());
    say.all(&loaded.sources, &loaded.diagnostics);
    if loaded.has_errors() {
        say.count(&loaded.diagnostics);
        return Err(Failure::Input);
    }
    Ok(loaded)
}

/// Writes new texts over files of a program, without a stop between them. What somebody has written there since the program
/// was read is kept: then none is written.
pub(super) fn rewrite(loaded: &Loaded, texts: &[(String, String)]) -> Result<(), Failure> {
    let read = |name: &str| {
        loaded
            .sources
            .iter()
            .find(|(_, source)| source.name == name)
    };
    let is_as_read = |name: &str| {
        let now = std::fs::read(name).ok();
        read(name).is_some_and(|(_, source)| now.as_deref() == Some(source.text.as_bytes()))
    };
    interrupt::uninterrupted(|| {
        if let Some((name, _)) = texts.iter().find(|(name, _)| !is_as_read(name)) {
            return Err(complain(&format!(
                "{name}: it has changed since this command read it, and is left as it is: run the command again"
            )));
        }
        let files = texts
            .iter()
            .map(|(name, text)| (Path::new(name), text.as_bytes()));
        put_all(&files.collect::<Vec<_>>())
    })
}

/// Writes files, all of them or none, without a stop between them.
pub(super) fn write_each(files: &[(PathBuf, Vec<u8>)]) -> Result<(), Failure> {
    let files = files
        .iter()
        .map(|(path, bytes)| (path.as_path(), bytes.as_slice()));
    interrupt::uninterrupted(|| put_all(&files.collect::<Vec<_>>()))
}

fn put_all(files: &[(&Path, &[u8])]) -> Result<(), Failure> {
    file::write_all(&System, files)
        .map_err(|(path, error)| complain(&format!("{}: {error}", path.display())))
}

/// Writes a whole file or nothing. A device or a pipe is written to directly.
pub(super) fn write(path: &Path, text: &str) -> Result<(), Failure> {
    let irregular = std::fs::metadata(path).is_ok_and(|found| !found.is_file());
    let written = match irregular {
        true => std::fs::write(path, text),
        false => interrupt::uninterrupted(|| file::write(&System, path, text.as_bytes())),
    };
    written.map_err(|error| complain(&format!("{}: {error}", path.display())))
}

/// Writes files to a folder as one result, of a program whose files have these hashes.
pub(super) fn write_all(
    folder: &Folder,
    files: &[(String, String)],
    program: BTreeMap<String, String>,
) -> Result<(), Failure> {
    placed(interrupt::uninterrupted(|| {
        folder.replace(&System, files, program)
    }))
}

/// Tells of the files that a result did not overwrite.
pub(super) fn placed(kept: io::Result<Vec<[String; 2]>>) -> Result<(), Failure> {
    for [name, kept] in kept.map_err(|error| complain(&error.to_string()))? {
        tell(&format!(
            "note: `{name}` there was not as btc writes it, and is kept as `{kept}`"
        ));
    }
    Ok(())
}

/// Whether what is written goes to files of its own: not to one that the command reads, nor two outputs to one.
///
/// # Errors
/// It does not.
pub(super) fn apart(outputs: &[Option<&Path>], inputs: &[Option<&str>]) -> Result<(), Failure> {
    let real = |path: &Path| path.canonicalize().ok();
    let mut taken: Vec<(PathBuf, &str)> = Vec::new();
    let inputs = inputs.iter().flatten().filter(|path| **path != DASH);
    let inputs = inputs.filter_map(|path| real(Path::new(path)));
    taken.extend(inputs.map(|path| (path, "what this command reads")));
    let outputs = outputs.iter().flatten();
    for output in outputs.filter(|path| **path != Path::new(DASH)) {
        // What is not there yet is the same if it has the same name.
        let is_file = std::fs::metadata(output).map_or(true, |found| found.is_file());
        let own = real(output).unwrap_or_else(|| output.to_path_buf());
        let same = taken.iter().find(|(path, _)| is_file && *path == own);
        if let Some((_, what)) = same {
            let output = render::visible(&output.to_string_lossy()).into_owned();
            tell(&format!(
                "error: `{output}` would overwrite {what}: name another file"
            ));
            return Err(Failure::Usage);
        }
        taken.push((own, "another output of this command"));
    }
    Ok(())
}

/// Writes to a file, or to standard output.
pub(super) fn put(path: Option<&Path>, text: &str) -> Result<(), Failure> {
    match path.filter(|path| *path != Path::new(DASH)) {
        Some(path) => write(path, text),
        None => print(text),
    }
}

/// Writes to standard output; a reader that has gone away is not an error. What would change what a terminal shows is written
/// out there; a file or a pipe gets the bytes as they are.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    let text = match out.is_terminal() {
        true => render::visible(text),
        false => text.into(),
    };
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => {
            Err(complain(&format!("standard output: {error}")))
        }
        _ => Ok(()),
    }
}
