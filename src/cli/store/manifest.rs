//! `manifest.json`: what a result consists of, so that a folder can be told from a mix of two.

use crate::driver::digest::sha256;
use crate::facade::disk::{TABLE, regular};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Its name.
pub const NAME: &str = "manifest.json";

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

/// Whether a folder has a manifest of btc that no longer says what it said. A file of that name that says nothing of btc is
/// somebody else's.
pub fn is_damaged(folder: &Path) -> bool {
    let Ok(text) = regular(&folder.join(NAME), TABLE) else {
        return false;
    };
    match serde_json::from_slice::<serde_json::Value>(&text) {
        Ok(found) => found.get("btc").is_some() && Manifest::deserialize(found).is_err(),
        Err(_) => true,
    }
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

    /// The manifest in a folder, if there is one. A result has no files elsewhere: what names some is none of btc's.
    pub fn of_folder(folder: &Path) -> Option<Self> {
        let text = regular(&folder.join(NAME), TABLE).ok()?;
        let manifest: Self = serde_json::from_slice(&text).ok()?;
        let is_here = |name: &String| Path::new(name).file_name() == Some(name.as_ref());
        manifest.files.keys().all(is_here).then_some(manifest)
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
