//! The language server: what an editor asks of programs while they are written.
//!
//! [`serve`] answers the Language Server Protocol over a connection; [`Server`] is what answers, without one. Programs
//! are loaded as every command loads them, the open documents in place of the files; what a name stands for is what the
//! checker noted ([`crate::check::Meanings`]). A document is checked again when it is asked for, not at every keystroke
//! that came before.

mod actions;
mod analysis;
mod capabilities;
mod complete;
mod cursor;
mod diagnostics;
mod documents;
mod editor;
mod folding;
mod format;
mod hints;
mod hover;
mod lens;
mod navigate;
mod outline;
mod picture;
pub mod reference;
mod rename;
mod serve;
mod server;
mod signature;
mod symbols;
mod tokens;
mod uri;

pub use serve::serve;
pub use server::Server;

use crate::driver::load::Reader;

/// The files that open documents stand among.
pub trait Workspace {
    /// Reads what the program at a path uses.
    fn reader(&self, main: &str) -> Box<dyn Reader + '_>;

    /// The paths of the programs in a folder and in its folders.
    fn programs(&self, folder: &str) -> Vec<String>;

    /// The path of a file with the text of the standard library, for an editor to show.
    fn library(&self) -> Option<String>;
}
