//! The states of a run in the folder of its results, in `.btc-checkpoint`: a file for each part, written whole.

use super::super::report::tell;
use super::disk::Disk;
use super::{file, stale};
use crate::checkpoint::Keeper;
use crate::driver::digest::sha256;
use std::collections::BTreeMap;
use std::fmt;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// The name of the folder.
pub const FOLDER: &str = ".btc-checkpoint";

/// The file that says of which run the states are.
const RUN: &str = "run.json";

/// The end of the names of states.
const STATE: &str = ".state";

/// How often, and how long, a run waits for another one to go.
const WAITS: u32 = 20;
const WAIT: Duration = Duration::from_millis(100);

/// The files that are of use by themselves.
const PUBLISHED: [&str; 3] = ["policy.csv", "q.csv", "transitions.csv"];

/// Whether a run keeps files of this name.
pub fn keeps(name: &str) -> bool {
    name == RUN || name.ends_with(STATE) || PUBLISHED.contains(&name)
}

/// What a run is of: the program, the options. Two runs that agree in all of this come to the same end.
pub type Run = BTreeMap<String, String>;

/// The states of a run.
pub struct Checkpoint<'d> {
    disk: &'d dyn Disk,
    folder: PathBuf,
    run: Run,
    /// The least time between two states of a part; nothing is kept without it.
    every: Option<Duration>,
    resumed: bool,
    /// Called around what must not be stopped half-way.
    guard: fn(&mut dyn FnMut()),
    kept: Mutex<Kept>,
}

struct Kept {
    start: Instant,
    /// When a state of each part was kept.
    parts: BTreeMap<String, Instant>,
    /// Whether the folder is ready to be written to.
    ready: bool,
    /// The file that says of which run the states are, locked.
    held: Option<File>,
    /// Whether it was told that a state could not be kept, or could not be read.
    told: bool,
    /// Whether the last state could not be kept.
    lost: bool,
}

/// Why a run cannot be resumed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unlike {
    /// There are states of another run, which differs in this: what it is about, there and here.
    Other(Vec<[String; 3]>),
    /// What says of which run the states are cannot be read.
    Damaged,
    /// A run that is not over keeps its states there.
    Busy,
    /// There are no states.
    Nothing,
}

impl<'d> Checkpoint<'d> {
    /// The states of a run whose results go to `folder`.
    pub fn new(
        disk: &'d dyn Disk,
        folder: &Path,
        run: Run,
        every: Option<Duration>,
        guard: fn(&mut dyn FnMut()),
    ) -> Self {
        Self {
            disk,
            folder: folder.join(FOLDER),
            run,
            every,
            resumed: false,
            guard,
            kept: Mutex::new(Kept {
                start: Instant::now(),
                parts: BTreeMap::new(),
                ready: false,
                held: None,
                told: false,
                lost: false,
            }),
        }
    }

    /// Whether there are states of this very run.
    ///
    /// # Errors
    /// There are none, or those of another run.
    pub fn found(&self) -> Result<(), Unlike> {
        if self.folder.is_symlink() {
            return Err(Unlike::Nothing);
        }
        // A run that was killed a moment ago may not be gone yet.
        let mut waits = (0..WAITS).map(|_| std::thread::sleep(WAIT));
        while self.free().is_err() {
            waits.next().ok_or(Unlike::Busy)?;
        }
        let bytes = fs::read(self.folder.join(RUN)).map_err(|_| Unlike::Nothing)?;
        let other: Run = serde_json::from_slice(&bytes).map_err(|_| Unlike::Damaged)?;
        let names = self.run.keys().chain(other.keys());
        let mut names: Vec<&String> = names.collect();
        names.sort();
        names.dedup();
        let of = |run: &Run, name: &String| run.get(name).cloned().unwrap_or_default();
        let differences: Vec<[String; 3]> = names
            .into_iter()
            .map(|name| [name.clone(), of(&other, name), of(&self.run, name)])
            .filter(|[_, there, here]| there != here)
            .collect();
        match differences.is_empty() {
            true => Ok(()),
            false => Err(Unlike::Other(differences)),
        }
    }

    /// Whether the last state of this very run is kept.
    pub fn is_up_to_date(&self) -> bool {
        self.found().is_ok() && !self.lock().lost
    }

    /// Goes on from the states that were found.
    pub fn resume(&mut self) {
        self.resumed = true;
        let mut kept = self.lock();
        kept.held = self.hold();
        kept.ready = true;
    }

    /// Removes all states of this run, which has ended. Where it kept none there may be those of another.
    pub fn remove(&self) {
        self.release();
        if self.lock().ready && self.free().is_ok() {
            stale::empty(self.disk, &self.folder);
            let _ = self.disk.remove_folder(&self.folder);
        }
    }

    /// Lets other runs have the folder.
    pub fn release(&self) {
        self.lock().held = None;
    }

    /// Whether no other run keeps its states in the folder.
    ///
    /// # Errors
    /// One does.
    fn free(&self) -> io::Result<()> {
        let run = File::open(self.folder.join(RUN)).ok();
        match run.map(|run| run.try_lock()) {
            Some(Err(TryLockError::WouldBlock)) => {
                let why = format!("another run keeps its own in `{}`", self.folder.display());
                Err(io::Error::other(why))
            }
            _ => Ok(()),
        }
    }

    /// Locks what says of which run the states are, as long as the file is open.
    fn hold(&self) -> Option<File> {
        let run = File::open(self.folder.join(RUN)).ok()?;
        run.try_lock().ok()?;
        Some(run)
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Kept> {
        self.kept.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The first line of a state: what it is of, and which part. The second is the hash of what follows.
    fn seal(&self, part: &str) -> String {
        let run = serde_json::to_string(&self.run).unwrap_or_default();
        format!(
            "btc {} {} {part}",
            env!("CARGO_PKG_VERSION"),
            sha256(run.as_bytes())
        )
    }

    /// What a state holds, if it is one of this run and whole.
    fn opened<'b>(&self, part: &str, bytes: &'b [u8]) -> Option<&'b [u8]> {
        let (seal, rest) = split_line(bytes)?;
        let (hash, state) = split_line(rest)?;
        let whole = seal == self.seal(part).as_bytes() && hash == sha256(state).as_bytes();
        whole.then_some(state)
    }

    /// Makes the folder, without what another run has left there.
    fn prepare(&self) -> io::Result<()> {
        match self.disk.make_folder(&self.folder) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                fs::create_dir_all(&self.folder)?;
            }
            made => made?,
        }
        if self.folder.is_symlink() {
            let why = format!("`{FOLDER}` is a link, and what it leads to may be of somebody else");
            return Err(io::Error::other(why));
        }
        self.free()?;
        stale::empty(self.disk, &self.folder);
        let run = serde_json::to_string_pretty(&self.run).unwrap_or_default();
        file::write(self.disk, &self.folder.join(RUN), run.as_bytes())
    }

    /// Writes a file of the folder. That it cannot be written is told once: the run itself goes on, and the next state is tried
    /// again.
    fn put(&self, name: &str, bytes: &[u8]) {
        let mut kept = self.lock();
        let mut done = Ok(());
        (self.guard)(&mut || {
            if !kept.ready {
                kept.held = None;
                done = self.prepare();
                kept.ready = done.is_ok();
                kept.held = done.as_ref().ok().and_then(|()| self.hold());
            }
            if done.is_ok() {
                done = file::write(self.disk, &self.folder.join(name), bytes);
                // Somebody may have removed the folder.
                kept.ready = self.folder.is_dir();
            }
        });
        kept.lost = done.is_err();
        if let Err(why) = done {
            kept.tell(&format!("warning: no checkpoint could be kept: {why}"));
        }
        kept.parts.insert(name.to_owned(), Instant::now());
    }
}

impl Kept {
    /// Tells something once.
    fn tell(&mut self, line: &str) {
        if !self.told {
            tell(line);
        }
        self.told = true;
    }
}

impl fmt::Debug for Checkpoint<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Checkpoint({})", self.folder.display())
    }
}

impl Keeper for Checkpoint<'_> {
    fn load(&self, part: &str) -> Option<Vec<u8>> {
        if !self.resumed {
            return None;
        }
        let bytes = fs::read(self.folder.join(format!("{part}{STATE}"))).ok()?;
        let state = self.opened(part, &bytes).map(<[u8]>::to_vec);
        if state.is_none() {
            let why = "a part of the checkpoint is damaged, and is computed anew";
            self.lock().tell(&format!("note: {why}"));
        }
        state
    }

    fn keeps(&self) -> bool {
        self.every.is_some()
    }

    fn is_due(&self, part: &str) -> bool {
        let Some(every) = self.every else {
            return false;
        };
        let kept = self.lock();
        let last = kept.parts.get(&format!("{part}{STATE}"));
        last.unwrap_or(&kept.start).elapsed() >= every
    }

    fn save(&self, part: &str, state: &[u8]) {
        if self.every.is_some() {
            let head = format!("{}\n{}\n", self.seal(part), sha256(state));
            let bytes = [head.as_bytes(), state].concat();
            self.put(&format!("{part}{STATE}"), &bytes);
        }
    }

    fn publish(&self, name: &str, text: &str) {
        if self.every.is_some() && keeps(name) {
            self.put(name, text.as_bytes());
        }
    }
}

/// The first line, and what follows it.
fn split_line(bytes: &[u8]) -> Option<(&[u8], &[u8])> {
    let end = bytes.iter().position(|byte| *byte == b'\n')?;
    Some((bytes.get(..end)?, bytes.get(end + 1..)?))
}
