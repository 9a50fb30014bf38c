//! A folder of results as one: all of the old result or all of the new, whatever happens on the way.
//!
//! A result is made in a folder of its own, a *stage*, beside the folder that it is for, and takes that folder's place in one
//! step; a user's own files in the folder are linked into the stage before. Where that cannot be (a subfolder, a mount
//! point, the current folder, a file system that cannot exchange folders) the files are renamed one by one while the manifest
//! says that the folder is not whole, and renamed back where one cannot be.

use super::checkpoint;
use super::disk::Disk;
use super::file::{folder_of, settle};
use super::manifest::{self, Manifest};
use super::stale::{self, BACKUP};
use crate::driver::digest::sha256;
use crate::facade::disk::{TABLE, regular};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A folder of results.
#[derive(Clone, Debug)]
pub struct Folder {
    path: PathBuf,
}

impl Folder {
    /// The folder at a path, which need not be there yet.
    pub fn new(path: &Path) -> Self {
        Self {
            path: path.to_owned(),
        }
    }

    /// The path as it was given.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The folders of the path that are not there.
    pub fn missing(&self) -> Vec<PathBuf> {
        let missing = self.path.ancestors();
        let missing = missing.take_while(|path| !path.as_os_str().is_empty() && !path.exists());
        missing.map(Path::to_owned).collect()
    }

    /// Removes these folders again, as far as they are empty.
    pub fn unmake(disk: &dyn Disk, missing: &[PathBuf]) {
        for path in missing {
            let _ = disk.remove_folder(path);
        }
    }

    /// Tries whether files of these names can be written, and gives the path of the folder with all links followed.
    /// What had to be made for that is removed again.
    ///
    /// # Errors
    /// They cannot, and why.
    pub fn probe(&self, disk: &dyn Disk, names: &[&str]) -> io::Result<PathBuf> {
        let missing = self.missing();
        let mut made = missing.iter().rev();
        let made =
            made.try_for_each(|path| disk.make_folder(path).map_err(|error| at(path, error)));
        let tried = made.and_then(|()| self.try_writing(disk, names));
        Self::unmake(disk, &missing);
        tried
    }

    fn try_writing(&self, disk: &dyn Disk, names: &[&str]) -> io::Result<PathBuf> {
        let here = |error| at(&self.path, error);
        let whole = self.path.canonicalize().map_err(here)?;
        if !whole.is_dir() {
            return Err(here(io::ErrorKind::NotADirectory.into()));
        }
        for name in names.iter().chain([&manifest::NAME]) {
            let path = self.path.join(name);
            if path.is_dir() {
                return Err(at(&path, io::ErrorKind::IsADirectory.into()));
            }
        }
        let manifest = self.path.join(manifest::NAME);
        let message = match manifest::read(&self.path) {
            Err(manifest::Damaged) => {
                Some("is damaged, so that nothing says which files here btc wrote; delete it")
            }
            Ok(None) => Some("is not a manifest of btc, and would be overwritten"),
            Ok(Some(_)) => None,
        };
        if let Some(message) = message.filter(|_| manifest.exists()) {
            return Err(io::Error::other(format!(
                "{}: {message}",
                manifest.display()
            )));
        }
        stale::sweep(disk, &whole);
        // It has no name, so that nothing is left of it.
        let mut file = tempfile::tempfile_in(&whole).map_err(here)?;
        let written = disk.write(&mut file, b"btc");
        written.and_then(|()| disk.sync(&file)).map_err(here)?;
        Ok(whole)
    }

    /// Puts a result in the place of what btc wrote into the folder before. Other files stay. One that has the name of a new
    /// one gets another: both are given.
    ///
    /// # Errors
    /// The system refuses; the folder then has what it had, or says in its manifest that it is not whole.
    pub fn replace(
        &self,
        disk: &dyn Disk,
        files: &[(String, String)],
        program: BTreeMap<String, String>,
    ) -> io::Result<Vec<[String; 2]>> {
        let parent = folder_of(&self.path);
        fs::create_dir_all(parent).map_err(|error| at(parent, error))?;
        let target = match self.path.canonicalize() {
            Ok(target) => target,
            Err(_) => {
                let parent = parent.canonicalize().map_err(|error| at(parent, error))?;
                parent.join(self.path.file_name().unwrap_or_default())
            }
        };
        stale::sweep(disk, folder_of(&target));
        stale::sweep(disk, &target);
        let mut change = Change {
            disk,
            files,
            manifest: Manifest::of(files, program),
            before: Manifest::of_folder(&target).unwrap_or_default(),
            edited: Vec::new(),
            target: &target,
        };
        change.edited = change.edited();
        // A stage that cannot be made beside the folder may still be made in it.
        if change.swap().is_err() {
            change.in_place().map_err(|error| at(&self.path, error))?;
        }
        Ok(change.edited)
    }
}

impl Folder {
    /// Adds files to a result, in the place of those that have their names.
    ///
    /// # Errors
    /// As [`Folder::replace`].
    pub fn add(&self, disk: &dyn Disk, files: &[(String, String)]) -> io::Result<Vec<[String; 2]>> {
        let before = Manifest::of_folder(&self.path).unwrap_or_default();
        let changed = before.changed(&self.path);
        let kept = before.files.keys().filter(|name| {
            !changed.contains(&name.as_str()) && files.iter().all(|(other, _)| other != *name)
        });
        let mut all: Vec<(String, String)> = kept
            .filter_map(|name| {
                let text = fs::read_to_string(self.path.join(name)).ok()?;
                Some((name.clone(), text))
            })
            .collect();
        all.extend_from_slice(files);
        self.replace(disk, &all, before.program.clone())
    }
}

/// An error with the path that it is about.
fn at(path: &Path, error: io::Error) -> io::Error {
    io::Error::new(error.kind(), format!("{}: {error}", path.display()))
}

/// A result on its way to its folder.
struct Change<'c> {
    disk: &'c dyn Disk,
    files: &'c [(String, String)],
    manifest: Manifest,
    /// What the folder says that it has.
    before: Manifest,
    /// The files of a user that have names of new ones, and the names that they get.
    edited: Vec<[String; 2]>,
    target: &'c Path,
}

impl Change<'_> {
    /// Makes the result in a stage beside the folder, and exchanges the two.
    fn swap(&self) -> io::Result<()> {
        let parent = folder_of(self.target);
        let there = self.target.exists();
        let own = match there {
            true => self.own_files()?,
            false => Vec::new(),
        };
        let (stage, _held) = stale::stage(self.disk, parent)?;
        let swapped = self.fill(&stage).and_then(|()| {
            for path in &own {
                let name = path.file_name().unwrap_or_default();
                self.disk.link(path, &stage.join(name))?;
            }
            for [name, kept] in &self.edited {
                let to = stage.join(kept);
                if !to.exists() {
                    self.disk.link(&self.target.join(name), &to)?;
                }
            }
            if there {
                self.resemble(&stage)?;
            }
            settle(self.disk, &stage);
            match there {
                true => self.disk.exchange(&stage, self.target),
                false => self.disk.rename(&stage, self.target),
            }
        });
        if swapped.is_ok() {
            settle(self.disk, parent);
        }
        if swapped.is_ok() && there {
            for (name, _) in self.files {
                let _ = self.disk.remove_file(&stage.join(name));
            }
            self.keep_late_files(&stage);
        }
        if swapped.is_err() || there {
            stale::clear(self.disk, &stage);
        }
        swapped
    }

    /// The files in the folder that are a user's own.
    ///
    /// # Errors
    /// Something there cannot have a second name, or the folder cannot be moved.
    fn own_files(&self) -> io::Result<Vec<PathBuf>> {
        let cannot = || io::Error::from(io::ErrorKind::Unsupported);
        let here = std::env::current_dir().and_then(|here| here.canonicalize());
        if here.is_ok_and(|here| here == self.target) {
            return Err(cannot());
        }
        let mut own = Vec::new();
        let dropped = self.dropped();
        for entry in fs::read_dir(self.target)? {
            let entry = entry?;
            let name = entry.file_name();
            let is = |other: &str| name.to_str() == Some(other);
            let replaced = self.files.iter().any(|(other, _)| is(other));
            let ours = is(manifest::NAME) || is(checkpoint::FOLDER);
            if replaced || ours || dropped.iter().any(|other| is(other)) {
                continue;
            }
            if !entry.file_type()?.is_file() {
                return Err(cannot());
            }
            own.push(entry.path());
        }
        Ok(own)
    }

    /// The files that have names of new ones, and are none of the result before: somebody has edited or made them. What a run
    /// that was stopped has left may be of either result.
    fn edited(&self) -> Vec<[String; 2]> {
        let edited = self.files.iter().filter(|(name, text)| {
            let path = self.target.join(name);
            let ours = |bytes: &[u8]| {
                let known = self.before.files.get(name);
                bytes == text.as_bytes() || known.is_some_and(|hash| *hash == sha256(bytes))
            };
            let stopped = self.before.names(name) && !self.before.whole;
            let there = fs::symlink_metadata(&path).is_ok();
            there && !stopped && !regular(&path, TABLE).is_ok_and(|bytes| ours(&bytes))
        });
        // A run that was stopped may have kept it already.
        let is_free = |name: &str, kept: &str| {
            let [name, kept] = [name, kept].map(|name| self.target.join(name));
            let same = || Some(regular(&kept, TABLE).ok()? == regular(&name, TABLE).ok()?);
            fs::symlink_metadata(&kept).is_err() || same() == Some(true)
        };
        let kept = |name: &str| {
            let mut names = (1..).map(|n| match n {
                1 => format!("{name}.edited"),
                n => format!("{name}.edited-{n}"),
            });
            names.find(|kept| is_free(name, kept))
        };
        edited
            .filter_map(|(name, _)| Some([name.clone(), kept(name)?]))
            .collect()
    }

    /// The files of the result before that the new one has not. One that was edited is a user's own.
    fn dropped(&self) -> Vec<&str> {
        let changed = self.before.changed(self.target);
        let names = self.before.files.keys().map(String::as_str);
        names
            .filter(|name| {
                let ours = !self.before.whole || !changed.contains(name);
                // A run that was stopped may have removed it already.
                let there = self.target.join(name).exists();
                ours && there && !self.manifest.names(name)
            })
            .collect()
    }

    /// Writes the manifest, and then all files.
    fn fill(&self, stage: &Path) -> io::Result<()> {
        let text = self.manifest.text();
        let files = self.files.iter().map(|(name, text)| (name.as_str(), text));
        for (name, text) in [(manifest::NAME, &text)].into_iter().chain(files) {
            self.put(&stage.join(name), text)?;
        }
        Ok(())
    }

    fn put(&self, path: &Path, text: &str) -> io::Result<()> {
        let mut file = self.disk.create(path)?;
        self.disk.write(&mut file, text.as_bytes())?;
        self.disk.sync(&file)
    }

    /// Gives the stage the permissions of the folder.
    ///
    /// # Errors
    /// The folder belongs to somebody else.
    fn resemble(&self, stage: &Path) -> io::Result<()> {
        let (old, new) = (fs::metadata(self.target)?, fs::metadata(stage)?);
        #[cfg(unix)]
        {
            use std::os::unix::fs::MetadataExt;
            if (old.uid(), old.gid(), old.dev()) != (new.uid(), new.gid(), new.dev()) {
                return Err(io::ErrorKind::Unsupported.into());
            }
        }
        match old.permissions() == new.permissions() {
            true => Ok(()),
            false => self.disk.permit(stage, old.permissions()),
        }
    }

    /// Brings files back that came into the folder while it was exchanged.
    fn keep_late_files(&self, stage: &Path) {
        for path in fs::read_dir(stage).into_iter().flatten().flatten() {
            let name = path.file_name();
            let to = self.target.join(&name);
            let ours = name.to_str().is_some_and(|name| {
                name == manifest::NAME || name == checkpoint::FOLDER || self.before.names(name)
            });
            if !ours && !to.exists() {
                let _ = self.disk.rename(&path.path(), &to);
            }
        }
    }

    /// Renames one file after another, with the manifest saying so, and back where one cannot be.
    fn in_place(&self) -> io::Result<()> {
        if !self.target.exists() {
            self.disk.make_folder(self.target)?;
        }
        let (stage, _held) = stale::stage(self.disk, self.target)?;
        let dropped = self.dropped();
        let names = self.files.iter().map(|(name, _)| name.as_str());
        let names: Vec<&str> = names.chain(dropped.iter().copied()).collect();
        let kept = self.edited.iter().map(|[_, kept]| self.target.join(kept));
        let kept: Vec<PathBuf> = kept.filter(|path| !path.exists()).collect();
        let unkeep = || {
            for path in &kept {
                let _ = self.disk.remove_file(path);
            }
        };
        let ready = self.fill(&stage).and_then(|()| {
            for [name, kept] in &self.edited {
                self.second(&self.target.join(name), &self.target.join(kept))?;
            }
            let manifest = [manifest::NAME];
            for name in names.iter().chain(&manifest) {
                self.back_up(&stage, name)?;
            }
            let mut unfinished = Manifest {
                whole: false,
                ..self.manifest.clone()
            };
            // What is still to go is of the result, too.
            let gone = self.before.files.iter();
            let gone = gone.filter(|(name, _)| dropped.contains(&name.as_str()));
            let gone = gone.map(|(name, hash)| (name.clone(), hash.clone()));
            unfinished.files.extend(gone);
            let mark = stage.join(format!("{}.new", manifest::NAME));
            self.put(&mark, &unfinished.text())?;
            self.disk.rename(&mark, &self.target.join(manifest::NAME))
        });
        if ready.is_err() {
            let _ = self
                .disk
                .remove_file(&stage.join(format!("{}.new", manifest::NAME)));
            stale::clear(self.disk, &stage);
            unkeep();
            return ready;
        }
        settle(self.disk, self.target);
        let moved = self.move_in(&stage, &dropped);
        if moved.is_err() {
            self.move_back(&stage, &names);
            unkeep();
        } else {
            settle(self.disk, self.target);
            let kept = self.target.join(checkpoint::FOLDER);
            stale::empty(self.disk, &kept);
            let _ = self.disk.remove_folder(&kept);
        }
        stale::clear(self.disk, &stage);
        moved
    }

    /// Gives the file of the folder, if there is one, a second name in the stage.
    fn back_up(&self, stage: &Path, name: &str) -> io::Result<()> {
        let to = stage.join(format!("{name}{BACKUP}"));
        self.second(&self.target.join(name), &to)
    }

    /// Gives a file, if there is one, a second name, or makes a second file where there can be no second name.
    fn second(&self, from: &Path, to: &Path) -> io::Result<()> {
        if !from.exists() || to.exists() || self.disk.link(from, to).is_ok() {
            return Ok(());
        }
        let mut file = self.disk.create(to)?;
        self.disk.write(&mut file, &fs::read(from)?)?;
        self.disk.sync(&file)
    }

    fn move_in(&self, stage: &Path, dropped: &[&str]) -> io::Result<()> {
        for (name, _) in self.files {
            self.disk
                .rename(&stage.join(name), &self.target.join(name))?;
        }
        for name in dropped {
            self.disk.remove_file(&self.target.join(name))?;
        }
        let manifest = manifest::NAME;
        self.disk
            .rename(&stage.join(manifest), &self.target.join(manifest))
    }

    /// Gives the folder its files back; the manifest last, and only if nothing is missing.
    fn move_back(&self, stage: &Path, names: &[&str]) {
        let back = |name: &str| {
            let (from, to) = (
                stage.join(format!("{name}{BACKUP}")),
                self.target.join(name),
            );
            match from.exists() {
                true => self.disk.rename(&from, &to),
                false if to.exists() => self.disk.remove_file(&to),
                false => Ok(()),
            }
        };
        if names.iter().all(|name| back(name).is_ok()) {
            let _ = back(manifest::NAME);
        }
    }
}
