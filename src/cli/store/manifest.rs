//! `manifest.json`: what a result consists of, so that a folder can be told from a mix of two.

use crate::driver::digest::sha256;
use crate::facade::disk::{TABLE, regular};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Its name.
pub const NAME: &str = "manifest.json";

/// What it has to say.
const FIELDS: [&str; 4] = ["btc", "whole", "program", "files"];

/// What a result consists of.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Manifest {
    /// The version of btc that wrote it.
    pub btc: String,
    /// Whether all files are in their places. Where a folder cannot be exchanged for another, it is written to file by
    /// file, and for that time this is false.
    pub whole: bool,
    /// The SHA-256 of each file of the program that the result is of, by its path from the folder.
    pub program: BTreeMap<String, String>,
    /// The SHA-256 of each file of the result, by its name.
    pub files: BTreeMap<String, String>,
}

/// Whether a folder has a manifest of btc that no longer says what it said. A file of that name that says other things is somebody
/// else's.
pub fn is_damaged(folder: &Path) -> bool {
    let path = folder.join(NAME);
    let Ok(text) = regular(&path, TABLE) else {
        // Something else that can be there: a folder, a pipe, a link to nowhere.
        return path.symlink_metadata().is_ok();
    };
    let (_, damaged) = read(&text);
    damaged
}

/// What a manifest says, if it is one of btc, and whether it is one that was damaged.
fn read(text: &[u8]) -> (Option<Manifest>, bool) {
    // A result has no files elsewhere: what names some is none that btc wrote.
    let is_here = |name: &String| Path::new(name).file_name() == Some(name.as_ref());
    if let Ok(manifest) = serde_json::from_slice::<Manifest>(text) {
        return (
            manifest.files.keys().all(is_here).then_some(manifest),
            false,
        );
    }
    let damaged = match serde_json::from_slice::<serde_json::Value>(text) {
        Ok(serde_json::Value::Object(found)) => {
            found.contains_key("btc") || found.keys().all(|key| FIELDS.contains(&key.as_str()))
        }
        Ok(_) | Err(_) => true,
    };
    (None, damaged)
}

impl Manifest {
    /// The manifest of these files, by name.
    pub fn of(files: &[(String, String)], program: BTreeMap<String, String>) -> Self {
        let hashes = files
            .iter()
            .map(|(name, text)| (name.clone(), sha256(text.as_bytes())));
        Self {
            btc: env!("CARGO_PKG_VERSION").to_owned(),
            whole: true,
            program,
            files: hashes.collect(),
        }
    }

    /// The manifest in a folder, if there is one.
    pub fn of_folder(folder: &Path) -> Option<Self> {
        let text = regular(&folder.join(NAME), TABLE).ok()?;
        read(&text).0
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        // Maps of strings are always documents.
        let text = serde_json::to_string_pretty(self).unwrap_or_default();
        text + "\n"
    }

    /// Whether a file is one of the result.
    pub fn names(&self, name: &str) -> bool {
        self.files.contains_key(name)
    }

    /// The files of the folder that are not those of the result. One that is gone is missed where it is used.
    pub fn changed(&self, folder: &Path) -> Vec<&str> {
        let changed = |name: &&String| match regular(&folder.join(name), TABLE) {
            Ok(bytes) => self.files.get(*name) != Some(&sha256(&bytes)),
            Err(error) => error.kind() != io::ErrorKind::NotFound,
        };
        self.files
            .keys()
            .filter(changed)
            .map(String::as_str)
            .collect()
    }
}
