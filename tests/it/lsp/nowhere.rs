//! A workspace without files. The bench of the editor works in it, too.

use btc::driver::load::Reader;
use btc::lsp::Workspace;

/// No files but the open ones.
pub(crate) struct Nowhere;

impl Reader for Nowhere {
    fn read(&mut self, _: &str) -> Result<Vec<u8>, String> {
        Err("there are no files here".to_owned())
    }
}

impl Workspace for Nowhere {
    fn reader(&self, _: &str) -> Box<dyn Reader + '_> {
        Box::new(Nowhere)
    }

    fn programs(&self, _: &str) -> Vec<String> {
        Vec::new()
    }

    fn library(&self) -> Option<String> {
        None
    }
}
