//! `btc explain`

use super::report::tell;
use super::{Failure, files};
use crate::diagnostic::Code;
use crate::driver::explain;
use clap::Args;

#[derive(Debug, Args)]
pub(super) struct Arguments {
    /// The code, such as E0301; without it, all codes are listed.
    code: Option<String>,
}

pub(super) fn run(arguments: &Arguments) -> Result<(), Failure> {
    let Some(code) = &arguments.code else {
        let lines = Code::ALL
            .iter()
            .map(|code| format!("{code}  {}\n", code.title()));
        return files::print(&lines.collect::<String>());
    };
    match explain::explain(code) {
        Ok(text) => files::print(text),
        Err(likely) => {
            let hint = likely.map_or(String::new(), |likely| format!("; did you mean {likely}?"));
            tell(&format!("error: there is no code `{code}`{hint}"));
            Err(Failure::Usage)
        }
    }
}
