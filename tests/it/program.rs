//! Programs as the driver loads them.

pub(crate) use crate::laws::check::{NoFiles, shown};
use btc::driver::load::{Loaded, Reader, beside, load};
use btc::ir::name::{Argument, Given, Name};
use std::path::Path;

/// The files of a folder; paths are relative to it.
struct Folder<'a>(&'a Path);

impl Reader for Folder<'_> {
    fn read(&mut self, path: &str) -> Result<Vec<u8>, String> {
        let folder = self.0.to_str().unwrap();
        let path = beside(&format!("{folder}/main.bt"), path);
        std::fs::read(path).map_err(|_| "there is no such file".to_owned())
    }
}

/// The program in a file, under a name that holds no place of this machine.
pub(crate) fn named(name: &str, path: &Path) -> Loaded {
    let bytes = std::fs::read(path).unwrap();
    load(name, bytes, &mut Folder(path.parent().unwrap()))
}

/// The program that a file would be with this text.
pub(crate) fn with_text(path: &Path, text: String) -> Loaded {
    let name = path.file_name().unwrap().to_str().unwrap();
    load(name, text.into(), &mut Folder(path.parent().unwrap()))
}

/// A name as the language writes it, its parameters numbered.
pub(crate) fn called(text: &str) -> Name {
    let quoted = text.strip_prefix('`').and_then(|t| t.strip_suffix('`'));
    if let Some(word) = quoted.filter(|word| !word.contains('`')) {
        return Name::word(word);
    }
    let call = text.strip_suffix(')').and_then(|t| t.split_once('('));
    let Some((family, list)) = call.filter(|(_, list)| !list.is_empty()) else {
        return Name::word(text);
    };
    let arguments = list.split(", ").enumerate().map(|(i, value)| Argument {
        parameter: format!("argument_{i}"),
        value: Some(Given::Name(called(value))),
    });
    Name::instance(family, arguments.collect())
}
