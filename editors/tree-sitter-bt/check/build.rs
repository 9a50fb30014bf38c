//! Makes the parser of `grammar.js` and compiles it.

use std::path::Path;

/// The version of the parsers' interface that editors have had since 2023.
const ABI: usize = 14;

fn main() {
    println!("cargo:rerun-if-changed=../grammar.js");
    println!("cargo:rerun-if-changed=../src/scanner.c");
    let out = std::env::var("OUT_DIR").expect("cargo names it");
    let (repository, grammar) = (Path::new(".."), Some("../grammar.js"));
    tree_sitter_generate::generate_parser_in_directory(
        repository,
        Some(&out),
        grammar,
        ABI,
        None,
        None,
    )
    .unwrap_or_else(|why| panic!("{why}"));
    let mut build = cc::Build::new();
    build.std("c11").include(&out).warnings(false);
    build
        .file(Path::new(&out).join("parser.c"))
        .file("../src/scanner.c");
    build.compile("tree-sitter-behaviortree");
}
