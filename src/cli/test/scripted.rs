//! The tests that stand in programs.

use super::{Arguments, Count, Form};
use crate::cli::report::Reporter;
use crate::cli::{Failure, files};
use crate::diagnostic::render;
use crate::driver::learn::Learned;
use crate::driver::load::Loaded;
use crate::driver::test::{self, Due};

/// Runs tests of a program, some of them on what was learned now.
pub(super) fn run(
    arguments: &Arguments,
    path: &str,
    loaded: &Loaded,
    (due, learned): (&[Due], &[Learned]),
    count: &mut Count,
    say: &Reporter,
) -> Result<(), Failure> {
    if due.is_empty() {
        return Ok(());
    }
    let results = test::run(loaded, path, due, learned);
    let failed = results.tested.failed();
    count.failed += failed;
    count.passed += due.len() - failed;
    let (sources, failures) = (&loaded.sources, &results.failures);
    files::print(&match arguments.format {
        Form::Human => results.tested.human(),
        Form::Github => render::github(sources, failures) + &results.tested.github(),
        Form::Json => results.tested.json(),
        Form::Markdown => results.tested.markdown(),
    })?;
    if arguments.format == Form::Human {
        say.all(sources, failures);
    }
    Ok(())
}

/// Says which tests wait for a tree that is not learned.
pub(super) fn skip(
    arguments: &Arguments,
    path: &str,
    due: &[Due],
    count: &mut Count,
) -> Result<(), Failure> {
    count.skipped += due.len();
    if arguments.format == Form::Json {
        return Ok(());
    }
    due.iter().try_for_each(|due| {
        let (title, tree) = (&due.test.title, &due.test.tree);
        files::print(&format!(
            "{}: {}: skipped, for `{tree}` is not learned\n",
            render::on_one_line(path),
            render::on_one_line(title)
        ))
    })
}

/// A snapshot that is not there, as a JSON document.
pub(super) fn missing(snapshot: &str) -> String {
    let document = serde_json::json!({ "snapshot": snapshot, "outcome": "missing" });
    format!("{document:#}\n")
}
