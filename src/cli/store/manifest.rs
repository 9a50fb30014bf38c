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

/// A manifest of btc that no longer says what it said.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged;

/// The manifest in a folder; `None` if there is none, or one of somebody else, which says other things.
///
/// # Errors
/// It is one of btc that was damaged, or no file.
pub fn read(folder: &Path) -> Result<Option<Manifest>, Damaged> {
    let path = folder.join(NAME);
    let Ok(text) = regular(&path, TABLE) else {
        // Something else may be there: a folder, a pipe, a link to nowhere.
        return match path.symlink_metadata() {
            Ok(_) => Err(Damaged),
            Err(_) => Ok(None),
        };
    };
    // A result has no files elsewhere: what names some is none that btc wrote.
    let is_here = |name: &String| Path::new(name).file_name() == Some(name.as_ref());
    if let Ok(manifest) = serde_json::from_slice::<Manifest>(&text) {
        return Ok(Some(manifest).filter(|found| found.files.keys().all(is_here)));
    }
    let foreign = match serde_json::from_slice::<serde_json::Value>(&text) {
        Ok(serde_json::Value::Object(found)) => {
            let is_field = |key: &String| FIELDS.contains(&key.as_str());
            !found.contains_key("btc") && !found.keys().all(is_field)
        }
        Ok(_) | Err(_) => false,
    };
    if foreign { Ok(None) } else { Err(Damaged) }
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

    /// The manifest in a folder, if there is one that says what it has to.
    pub fn of_folder(folder: &Path) -> Option<Self> {
        read(folder).ok().flatten()
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
