//! The parser that `build.rs` has made of `grammar.js`.

use std::path::{Path, PathBuf};
use tree_sitter::{Language, Parser, Tree};
use tree_sitter_language::LanguageFn;

unsafe extern "C" {
    fn tree_sitter_behaviortree() -> *const ();
}

/// The language.
pub fn language() -> Language {
    // SAFETY: the function is in the parser that was generated.
    unsafe { LanguageFn::from_raw(tree_sitter_behaviortree) }.into()
}

/// The tree of a text.
pub fn parsed(text: &str) -> Tree {
    let mut parser = Parser::new();
    parser.set_language(&language()).expect("the versions fit");
    parser.parse(text, None).expect("nothing stops it")
}

/// The files of the parser, as they were generated, each with its path in the folder of the grammar.
pub fn generated() -> [(PathBuf, PathBuf); 4] {
    let files = [
        "parser.c",
        "tree_sitter/parser.h",
        "tree_sitter/alloc.h",
        "tree_sitter/array.h",
    ];
    files.map(|file| {
        (
            Path::new(env!("OUT_DIR")).join(file),
            folder().join("src").join(file),
        )
    })
}

/// The folder of the grammar.
pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}
