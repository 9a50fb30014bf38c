//! Writes the parser to `src/`, from where editors take it.

use std::fs;
use tree_sitter_behaviortree_check::generated;

fn main() -> std::io::Result<()> {
    for (from, to) in generated() {
        if let Some(folder) = to.parent() {
            fs::create_dir_all(folder)?;
        }
        fs::copy(from, to)?;
    }
    Ok(())
}
