//! The pages of the book, and the blocks in them.

use std::fs;
use std::path::{Path, PathBuf};

/// A page.
pub(crate) struct Page {
    /// Its path below `docs/book/src`, with `/` between its parts.
    pub(crate) name: String,
    pub(crate) text: String,
}

/// A block between fences.
pub(crate) struct Block<'a> {
    /// The line of the page that it begins after.
    pub(crate) line: usize,
    /// The words behind the fence.
    pub(crate) info: &'a str,
    /// What stands between the fences.
    pub(crate) text: &'a str,
    /// Where that begins in the page.
    pub(crate) at: usize,
}

/// A file of the repository.
pub(crate) fn root(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// The files of a folder that end so, with those of its folders, in order.
pub(crate) fn files(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() {
            if !["target", "node_modules"].contains(&name) && !name.starts_with('.') {
                found.extend(files(&path, ending));
            }
        } else if name.ends_with(ending) {
            found.push(path);
        }
    }
    found.sort();
    found
}

/// All pages, in the order of their names.
pub(crate) fn pages() -> Vec<Page> {
    let src = root("docs/book/src");
    let page = |path: PathBuf| Page {
        name: (path.strip_prefix(&src).unwrap().to_str().unwrap()).replace('\\', "/"),
        text: fs::read_to_string(&path).unwrap(),
    };
    let mut pages: Vec<Page> = files(&src, ".md").into_iter().map(page).collect();
    pages.sort_by(|a, b| a.name.cmp(&b.name));
    pages
}

/// The blocks of a page, in order.
pub(crate) fn blocks(text: &str) -> Vec<Block<'_>> {
    let mut blocks = Vec::new();
    let mut open: Option<(usize, &str, &str, usize)> = None;
    let mut at = 0;
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let mark = line.trim_start();
        let fence = &mark[..mark.len() - mark.trim_start_matches('`').len()];
        match open {
            None if fence.len() >= 3 => {
                let info = mark[fence.len()..].trim();
                open = Some((number + 1, fence, info, at + line.len()));
            }
            Some((line, opened, info, begin)) if mark.trim_end() == opened => {
                let text = &text[begin..at];
                blocks.push(Block {
                    line,
                    info,
                    text,
                    at: begin,
                });
                open = None;
            }
            _ => {}
        }
        at += line.len();
    }
    assert!(open.is_none(), "a fence is not closed");
    blocks
}

/// Holds a file of the book against what it should be, or writes it if that is asked for.
pub(crate) fn hold(path: &str, text: &str) {
    let file = root(path);
    if fs::read_to_string(&file).ok().as_deref() == Some(text) {
        return;
    }
    assert!(
        std::env::var_os("UPDATE_BOOK").is_some(),
        "{path} is out of date; tests/it/book.rs says how it is written anew"
    );
    fs::write(&file, text).unwrap();
}
