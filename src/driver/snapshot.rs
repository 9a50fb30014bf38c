//! `btc test`: learned trees against their snapshots.

use super::diff::{self, Side};
use super::learn::{Learned, Options, Shape, Stage, learn};
use super::load::Loaded;
use super::refused::Refused;
use crate::report::difference::Difference;
use crate::source::{Source, Sources};
use crate::syntax::ast::{Item, ItemKind};
use crate::syntax::parse;

/// The learners that the main file of a program declares, by the names of their trees.
pub fn learners(loaded: &Loaded) -> Vec<String> {
    let learns = loaded.ast.items.iter().filter_map(|item| match &item.kind {
        ItemKind::Learn(learn) => Some(learn.name.as_ref().map(|name| name.name.as_str())),
        _ => None,
    });
    learns
        .map(|name| name.unwrap_or("learned").to_owned())
        .collect()
}

/// What a learner learns with its own seed.
///
/// # Errors
/// As [`learn`].
pub fn learned(
    loaded: &Loaded,
    learner: &str,
    source: &str,
    shape: Shape,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Learned, Refused> {
    let options = Options {
        learner: Some(learner),
        source,
        shape,
        ..Options::default()
    };
    learn(loaded, &options, progress)
}

/// What a snapshot begins with.
const HEAD: &str =
    "//! The tree that `btc test` expects. Accept a new one with `btc test --accept`.";

/// Whether a file may be overwritten by a snapshot: it is one, or has at most what one has, or nothing.
pub fn is_one(text: &str) -> bool {
    let parsed = || {
        let file = Sources::default().add(Source::new("", text));
        let (ast, mistakes) = parse(file, text);
        let of_snapshots = |item: &Item| matches!(item.kind, ItemKind::Use(_) | ItemKind::Tree(_));
        mistakes.is_empty() && ast.items.iter().all(of_snapshots)
    };
    text.starts_with(HEAD) || parsed()
}

/// The snapshot of a learned tree: a program that uses its source, which stands beside it.
pub fn text(learned: &Learned, source: &str) -> String {
    format!("{HEAD}\nuse \"{source}\"\n\n{}", learned.text)
}

/// The snapshot against what was learned now; both play `episodes` in the world of the program.
///
/// # Errors
/// The snapshot has no tree.
pub fn compared(
    loaded: &Loaded,
    learned: &Learned,
    snapshot: &Loaded,
    episodes: u64,
    seed: u64,
) -> Result<Difference, Refused> {
    diff::diff(
        Side::Program(snapshot, None),
        Side::Tree(loaded, &learned.tree),
        episodes,
        seed,
    )
}
