//! Folders of results as they are read: whether they are still what was written, and where their programs are now.

use super::store::checkpoint;
use super::store::file::folder_of;
use super::store::manifest::{self, Manifest};
use crate::diagnostic::{Code, Diagnostic, render};
use crate::driver::digest::sha256;
use crate::driver::learn;
use crate::driver::load::{Reader, beside};
use crate::facade::disk::{Disk, TABLE, regular};
use crate::source::Span;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The result that a file belongs to, by the manifest beside it.
fn result_of(path: &str) -> Option<(&Path, Manifest)> {
    let path = Path::new(path);
    let folder = folder_of(path);
    let manifest = Manifest::of_folder(folder)?;
    let own = manifest.names(path.file_name()?.to_str()?);
    own.then_some((folder, manifest))
}

/// Why a file is not to be read: it belongs to a result whose files are not those of one run, or is called like one of a result
/// and nothing says that it is.
pub(super) fn torn(path: &str) -> Option<Diagnostic> {
    let path = Path::new(path);
    let folder = folder_of(path);
    let place = folder.to_string_lossy();
    let name = path.file_name()?.to_str()?;
    let is_called_so = learn::NAMES.contains(&name);
    let manifest = match manifest::read(folder) {
        Ok(manifest) => manifest?,
        Err(manifest::Damaged) if is_called_so => {
            let note = "`manifest.json` there is damaged, so that nothing says whether the files are those of one run";
            let help = format!("delete `{place}/manifest.json`, and learn again with `-o {place}`");
            return Some(not_one(&place, note.to_owned(), help));
        }
        Err(manifest::Damaged) => return None,
    };
    if !manifest.names(name) {
        let note =
            format!("its `manifest.json` does not name `{name}`, which comes from elsewhere");
        let help = format!("give `{name}` another name, or learn again with `-o {place}`");
        return (is_called_so && path.exists()).then(|| not_one(&place, note, help));
    }
    let changed = manifest.changed(folder);
    if manifest.whole && changed.is_empty() {
        return None;
    }
    let note = match (manifest.whole, changed.as_slice()) {
        (false, _) => "a run was stopped as it wrote there".to_owned(),
        (true, [one]) => format!(
            "`{one}` is not the file that was written: it was edited, or comes from another run"
        ),
        (true, several) => {
            let names: Vec<String> = several.iter().map(|name| format!("`{name}`")).collect();
            format!(
                "{} are not the files that were written: they were edited, or come from another run",
                names.join(", ")
            )
        }
    };
    let help = format!(
        "learn again with `-o {place}`; or, if the change is meant, delete `{place}/manifest.json`: then nothing is claimed of it"
    );
    Some(not_one(&place, note, help))
}

/// Whether a file of a result is missing where a run has kept its states and not yet ended.
pub(super) fn is_unfinished(path: &str) -> bool {
    let path = Path::new(path);
    let name = path.file_name().and_then(|name| name.to_str());
    name.is_some_and(|name| learn::NAMES.contains(&name))
        && folder_of(path).join(checkpoint::FOLDER).is_dir()
}

fn not_one(folder: &str, note: String, help: String) -> Diagnostic {
    let message = format!("`{folder}` is not one result");
    let mut torn = Diagnostic::new(Code::E0212, Span::default(), message)
        .note(note)
        .help(help);
    torn.labels.clear();
    torn
}

/// Folders that programs may use files of, besides their own and the current one.
static ROOTS: OnceLock<Vec<PathBuf>> = OnceLock::new();

/// Lets programs use files of these folders.
pub(super) fn allow(roots: &[PathBuf]) {
    let _ = ROOTS.set(roots.to_vec());
}

/// Reads the files of a program. If it is one that was learned, what it uses is also looked for beside its folder, where it
/// may have been moved together with it.
pub(super) struct Found {
    /// The name of the main file.
    main: String,
    /// Its folder, and what it was learned from.
    result: Option<(PathBuf, Manifest)>,
}

impl Found {
    /// For the program of this name.
    pub(super) fn of(name: &str) -> Self {
        let result = result_of(name);
        Self {
            main: name.to_owned(),
            result: result.map(|(folder, manifest)| (folder.to_owned(), manifest)),
        }
    }

    /// What to know of a program that was learned from other files than those that are there now.
    pub(super) fn changed(&self) -> Option<Diagnostic> {
        let (folder, manifest) = self.result.as_ref()?;
        let changed = |(path, hash): &(&String, &String)| {
            let now = regular(&folder.join(path), TABLE);
            now.is_ok_and(|bytes| sha256(&bytes) != **hash)
        };
        let mut changed = manifest.program.iter().filter(changed);
        let (path, _) = changed.next()?;
        let name = path.rsplit('/').next().unwrap_or(path);
        let message = format!("`{name}` has changed since this was learned from it");
        let mut warning = Diagnostic::new(Code::W0203, Span::default(), message)
            .note("what was proved holds for the transitions that were recorded then")
            .help("learn again to know what holds now");
        warning.labels.clear();
        Some(warning)
    }

    /// The file in another place than it was learned from.
    fn moved(&self, path: &str) -> Option<Vec<u8>> {
        let (folder, manifest) = self.result.as_ref()?;
        let here = |(listed, _): &(&String, &String)| beside(&self.main, listed) == path;
        let (listed, hash) = manifest.program.iter().find(here)?;
        // By way of a link, `..` may lead elsewhere than it seems to.
        let real = folder.canonicalize().ok()?;
        let name = Path::new(listed).file_name()?;
        let places = [
            real.join(listed),
            real.join(name),
            folder_of(&real).join(name),
        ];
        let mut read = places.iter().filter_map(|place| regular(place, TABLE).ok());
        read.find(|bytes| sha256(bytes) == *hash)
    }

    /// Whether a program may use the file at a path: one of its own folder, of the current one or of one that was named, or
    /// one that it was learned from.
    fn may_read(&self, path: &str) -> bool {
        let Ok(real) = Path::new(path).canonicalize() else {
            return true;
        };
        let own = folder_of(Path::new(&self.main));
        let named = ROOTS.get().into_iter().flatten().map(PathBuf::as_path);
        let mut roots = named.chain([own, Path::new(".")]);
        let within = |root: &Path| root.canonicalize().is_ok_and(|root| real.starts_with(root));
        let listed = || {
            let program = real.extension().is_some_and(|ending| ending == "bt");
            self.result.as_ref().is_some_and(|(_, manifest)| {
                let mut listed = manifest.program.keys();
                program && listed.any(|listed| beside(&self.main, listed) == path)
            })
        };
        roots.any(within) || listed()
    }
}

impl Reader for Found {
    fn has(&self, path: &str) -> bool {
        Path::new(path).exists()
    }

    fn roots(&self) -> Vec<String> {
        let roots = ROOTS.get().into_iter().flatten();
        roots
            .filter_map(|root| root.to_str().map(str::to_owned))
            .collect()
    }

    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        if !self.may_read(path) {
            let why = "it lies outside of the program's folder and of the current one: allow its folder with `--root DIR`";
            return Err(why.to_owned());
        }
        if let Some(torn) = torn(path) {
            let notes = [&torn.message].into_iter().chain(&torn.notes);
            let why: Vec<&str> = notes.map(String::as_str).collect();
            return Err(why.join(": "));
        }
        Disk.read(path).or_else(|why| {
            let moved = self.moved(path);
            moved.ok_or_else(|| match &self.result {
                None => why,
                Some((folder, _)) => {
                    let folder = folder.to_string_lossy();
                    let name = path.rsplit('/').next().unwrap_or(path);
                    let (folder, name) = (render::on_one_line(&folder), render::on_one_line(name));
                    format!("{why}; the `{name}` that was learned from belongs here, or beside `{folder}`")
                }
            })
        })
    }
}
