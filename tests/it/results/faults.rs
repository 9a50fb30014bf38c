//! A disk of which the n-th call fails, or on which everything fails from the n-th call on, as if the process had been
//! killed: for every n, a folder has the old result or the new one, or says that it has neither.

use super::{files, leftovers};
use btc::cli::store::manifest::Manifest;
use btc::cli::store::{Disk, Folder, System, file, project};
use std::collections::BTreeMap;
use std::fs::{self, File, Permissions};
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

/// How a disk fails.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Failing {
    /// One call fails.
    Once,
    /// The process is killed: no call after it does anything.
    Forever,
}

struct Faulty {
    calls: AtomicUsize,
    at: usize,
    how: Failing,
    /// Whether folders can be exchanged.
    exchanges: bool,
}

impl Faulty {
    fn new(at: usize, how: Failing, exchanges: bool) -> Self {
        Self {
            calls: AtomicUsize::new(0),
            at,
            how,
            exchanges,
        }
    }

    /// A disk on which no call fails.
    fn sound() -> Self {
        Self::new(usize::MAX, Failing::Once, true)
    }

    fn call(&self) -> io::Result<()> {
        let call = self.calls.fetch_add(1, Ordering::Relaxed);
        match call == self.at || self.how == Failing::Forever && call > self.at {
            true => Err(io::Error::other("the disk has failed")),
            false => Ok(()),
        }
    }

    fn was_met(&self) -> bool {
        self.calls.load(Ordering::Relaxed) > self.at
    }
}

impl Disk for Faulty {
    fn create(&self, path: &Path) -> io::Result<File> {
        self.call()?;
        System.create(path)
    }

    fn write(&self, file: &mut File, bytes: &[u8]) -> io::Result<()> {
        let failed = self.call();
        if failed.is_err() && self.calls.load(Ordering::Relaxed) == self.at + 1 {
            System.write(file, &bytes[..bytes.len() / 2])?;
        }
        failed?;
        System.write(file, bytes)
    }

    /// Nothing here loses power, so nothing waits until the disk has it.
    fn sync(&self, _: &File) -> io::Result<()> {
        self.call()
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.call()?;
        System.rename(from, to)
    }

    fn exchange(&self, one: &Path, other: &Path) -> io::Result<()> {
        self.call()?;
        match self.exchanges {
            true => System.exchange(one, other),
            false => Err(io::ErrorKind::Unsupported.into()),
        }
    }

    fn link(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.call()?;
        System.link(from, to)
    }

    fn make_folder(&self, path: &Path) -> io::Result<()> {
        self.call()?;
        System.make_folder(path)
    }

    fn permit(&self, path: &Path, permissions: Permissions) -> io::Result<()> {
        self.call()?;
        System.permit(path, permissions)
    }

    fn remove_file(&self, path: &Path) -> io::Result<()> {
        self.call()?;
        System.remove_file(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        self.call()?;
        System.remove_folder(path)
    }
}

/// A result of these files and `more`, all of the same age.
fn result(names: &[&str], more: usize, age: &str) -> Vec<(String, String)> {
    let names = names.iter().map(|name| (*name).to_owned());
    let more = (0..more).map(|number| format!("table{number}"));
    let texts = names
        .chain(more)
        .map(|name| (name.clone(), format!("{name} is {age}\n")));
    texts.collect()
}

/// The result that comes.
fn new(more: usize) -> Vec<(String, String)> {
    result(&["a", "b", "c"], more, "new")
}

fn put(disk: &dyn Disk, folder: &Path, files: &[(String, String)]) -> io::Result<()> {
    let folder = Folder::new(folder);
    folder.replace(disk, files, BTreeMap::new()).map(drop)
}

/// What a folder has before the new result comes.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Before {
    /// It is not there.
    Nothing,
    /// An old result.
    Old,
    /// An old result and files of a user.
    Own,
    /// An old result and a folder of a user, which cannot be linked.
    OwnFolder,
    /// An old result with a file that somebody has edited since.
    Edited,
}

fn prepare(place: &Path, before: Before, more: usize) {
    if before != Before::Nothing {
        put(
            &Faulty::sound(),
            place,
            &result(&["a", "b", "dropped"], more, "old"),
        )
        .unwrap();
    }
    if matches!(before, Before::Own | Before::OwnFolder) {
        fs::write(place.join("notes"), "mine").unwrap();
    }
    if before == Before::Edited {
        fs::write(place.join("b"), "mine").unwrap();
    }
    if before == Before::OwnFolder {
        fs::create_dir(place.join("more")).unwrap();
        fs::write(place.join("more/notes"), "mine").unwrap();
    }
}

/// Lets each call fail in turn, and gives the number of calls that there are.
fn fails_everywhere(before: Before, how: Failing, exchanges: bool, more: usize) -> usize {
    let expected = |replaced: bool| {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("results");
        prepare(&place, before, more);
        if replaced {
            put(&Faulty::sound(), &place, &new(more)).unwrap();
        }
        files(&place)
    };
    let (old, expected) = (expected(false), expected(true));
    assert!(!expected.contains_key("dropped"));
    let edited = expected.get("b.edited").map(Vec::as_slice);
    assert_eq!(
        edited,
        (before == Before::Edited).then_some(b"mine".as_slice())
    );
    for at in 0.. {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().join("results");
        prepare(&place, before, more);
        let disk = Faulty::new(at, how, exchanges);
        let done = put(&disk, &place, &new(more));
        if !disk.was_met() {
            assert_eq!(files(&place), expected);
            return at;
        }
        let found = files(&place);
        let case = format!("{before:?}, {how:?}, call {at}");
        // A second name of what was edited may be there already.
        let mut as_before = found.clone();
        if as_before.get("b.edited") == old.get("b") {
            as_before.remove("b.edited");
        }
        if done.is_ok() {
            assert_eq!(found, expected, "{case}");
        } else if as_before != old && found != expected {
            // File by file, a kill leaves a mix that says so.
            assert_eq!(how, Failing::Forever, "{case}");
            assert!(before == Before::OwnFolder || !exchanges, "{case}");
            let manifest = Manifest::of_folder(&place);
            assert!(manifest.is_none_or(|manifest| !manifest.whole), "{case}");
        }
        if matches!(before, Before::Own | Before::OwnFolder) {
            assert_eq!(fs::read(place.join("notes")).unwrap(), b"mine", "{case}");
        }
        if before == Before::Edited {
            let kept = ["b", "b.edited"].map(|name| fs::read(place.join(name)).ok());
            assert!(kept.contains(&Some(b"mine".to_vec())), "{case}");
        }
        // The next run succeeds, and cleans up. A process that another test starts holds all locks for a moment.
        let left = || leftovers(&place).len() + leftovers(folder.path()).len();
        for _ in 0..100 {
            put(&Faulty::sound(), &place, &new(more)).unwrap();
            assert_eq!(files(&place), expected, "{case}");
            if left() == 0 {
                break;
            }
            std::thread::sleep(std::time::Duration::from_millis(5));
        }
        assert_eq!(left(), 0, "{case}: {:?}", leftovers(folder.path()));
    }
    unreachable!()
}

#[test]
fn a_folder_has_the_old_result_or_the_new() {
    let mut faults = 0;
    let befores = [
        Before::Nothing,
        Before::Old,
        Before::Own,
        Before::OwnFolder,
        Before::Edited,
    ];
    for before in befores {
        for how in [Failing::Once, Failing::Forever] {
            for exchanges in [true, false] {
                for more in [0, 5] {
                    faults += fails_everywhere(before, how, exchanges, more);
                }
            }
        }
    }
    assert!(faults > 1000, "{faults}");
}

#[test]
fn a_file_is_the_old_or_the_new() {
    for how in [Failing::Once, Failing::Forever] {
        for at in 0.. {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("file");
            fs::write(&path, "old").unwrap();
            let disk = Faulty::new(at, how, true);
            let done = file::write(&disk, &path, b"new");
            let found = fs::read_to_string(&path).unwrap();
            assert!(done.is_ok() || found == "old", "call {at}");
            assert!(done.is_err() || found == "new", "call {at}");
            for _ in 0..100 {
                file::write(&System, &path, b"new").unwrap();
                if leftovers(folder.path()).is_empty() {
                    break;
                }
                std::thread::sleep(std::time::Duration::from_millis(5));
            }
            assert!(leftovers(folder.path()).is_empty());
            if !disk.was_met() {
                break;
            }
        }
    }
}

#[test]
fn files_are_all_old_or_all_new() {
    let mut faults = 0;
    for how in [Failing::Once, Failing::Forever] {
        for at in 0.. {
            let folder = tempfile::tempdir().unwrap();
            let paths = ["a", "b", "c"].map(|name| folder.path().join(name));
            fs::write(&paths[0], "old").unwrap();
            fs::write(&paths[1], "old").unwrap();
            let disk = Faulty::new(at, how, true);
            let files: Vec<(&Path, &[u8])> =
                paths.iter().map(|it| (it.as_path(), &b"new"[..])).collect();
            let done = file::write_all(&disk, &files);
            let found = paths.each_ref().map(|path| fs::read_to_string(path).ok());
            let found = found.each_ref().map(Option::as_deref);
            match done {
                Ok(()) => assert_eq!(found, [Some("new"); 3], "{how:?}, call {at}"),
                Err(_) if how == Failing::Once => {
                    assert_eq!(found, [Some("old"), Some("old"), None], "call {at}");
                }
                Err(_) => {
                    let whole = |text: &Option<&str>| matches!(text, None | Some("old" | "new"));
                    assert!(found.iter().all(whole), "call {at}: {found:?}");
                }
            }
            if !disk.was_met() {
                break;
            }
            faults += 1;
        }
    }
    assert!(faults > 20, "{faults}");
}

#[test]
fn a_project_is_there_as_a_whole_or_not_at_all() {
    let texts = [("a.bt", "a"), ("deep/down/b.yml", "b"), (".hidden", "c")];
    let is_whole = |place: &Path| {
        let read = |(name, text): &(&str, &str)| {
            fs::read_to_string(place.join(name)).is_ok_and(|found| found == *text)
        };
        texts.iter().all(read)
    };
    let mut faults = 0;
    for how in [Failing::Once, Failing::Forever] {
        for at in 0.. {
            let folder = tempfile::tempdir().unwrap();
            let around = folder.path().join("around");
            let place = around.join("project");
            let disk = Faulty::new(at, how, true);
            let done = project::make(&disk, &place, &texts);
            assert_eq!(done.is_ok(), is_whole(&place), "{how:?}, call {at}");
            assert_eq!(done.is_ok(), place.exists(), "{how:?}, call {at}");
            // A process that another test starts holds all locks for a moment.
            for _ in 0..100 {
                let _ = fs::remove_dir_all(&place);
                project::make(&System, &place, &texts).unwrap();
                assert!(is_whole(&place));
                if leftovers(&around).is_empty() {
                    break;
                }
                std::thread::sleep(std::time::Duration::from_millis(5));
            }
            assert!(leftovers(&around).is_empty(), "{how:?}, call {at}");
            if !disk.was_met() {
                break;
            }
            faults += 1;
        }
    }
    assert!(faults > 20, "{faults}");
}

/// A file that somebody is writing is not taken for stale.
#[test]
fn what_is_held_is_left_alone() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join(".btc-file-1-0");
    let held = System.create(&path).unwrap();
    file::write(&System, &folder.path().join("other"), b"text").unwrap();
    assert!(path.exists());
    drop(held);
    while path.exists() {
        file::write(&System, &folder.path().join("other"), b"text").unwrap();
    }
}
