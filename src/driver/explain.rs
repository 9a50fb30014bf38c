//! `btc explain`

use crate::diagnostic::{Code, suggest};

/// The explanation of a code.
///
/// # Errors
/// There is no such code: the one that was likely meant, if any is near.
pub fn explain(code: &str) -> Result<&'static str, Option<&'static str>> {
    match Code::parse(code) {
        Some(code) => Ok(code.explanation()),
        None => {
            let upper = code.to_uppercase();
            Err(suggest::nearest(
                &upper,
                Code::ALL.iter().map(|code| code.name()),
            ))
        }
    }
}
