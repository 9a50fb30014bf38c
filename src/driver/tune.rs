//! `btc tune`: better values for the numbers of a program that may be tuned.

use super::learn::{self, Learned};
use super::load::Loaded;
use super::refused::Refused;
use super::{target, world};
use crate::checkpoint::{Forgetful, Keeper, Under};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::task::{Task, TreeRef};
use crate::ir::tree::Node;
use crate::ir::{Id, Name, Program};
use crate::report::tuned::{Again, Edit, Report};
use crate::source::Span;
use crate::tune::confirm::duel;
use crate::tune::{self, Progress, Subject, Tuned};

/// What a user may set.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// The tree; what a learner learns if not said.
    pub tree: Option<&'o str>,
    /// The learner, if there are several.
    pub learner: Option<&'o str>,
    /// About how many ticks the search may take, with the fresh episodes.
    pub effort: u64,
    /// The most fresh episodes on which the values that were found are held against those in use.
    pub episodes: u64,
    /// The seed of all episodes.
    pub seed: u64,
    /// Where the run keeps its states.
    pub keeper: &'o dyn Keeper,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            tree: None,
            learner: None,
            effort: 40_000_000,
            episodes: 400,
            seed: 1,
            keeper: &Forgetful,
        }
    }
}

/// How far the command has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning the tree, or learning it again.
    Learning(learn::Stage),
    /// Searching for values.
    Tuning(Progress),
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The report for a person.
    pub human: String,
    /// The report as a JSON document.
    pub json: String,
    /// The curves as SVG, by the names of their files.
    pub pictures: Vec<(String, String)>,
    /// The files as they are with the proposed values, by name; none if nothing is proposed.
    pub fixed: Vec<(String, String)>,
    /// The tree as an item of the language, if it was learned: the better one under the proposed values.
    pub text: Option<String>,
}

/// Searches for better values of all numbers that may be tuned.
///
/// # Errors
/// There is nothing to tune, no such tree, nothing was learned, or the tree cannot be played.
pub fn tune(
    loaded: &Loaded,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Outcome, Refused> {
    something(loaded)?;
    let program = &loaded.program;
    let named = match options.tree {
        Some(name) => Some(target::tree(loaded, name)?),
        // Without a learner, the only tree is meant.
        None if program.learners.is_empty() && program.trees.len() == 1 => {
            program.trees.ids().next()
        }
        None => None,
    };
    match named {
        Some(id) => {
            let tree = &program.trees[id];
            let task = target::task_of(loaded, Some(id))?;
            let searched = Searched {
                loaded,
                options,
                task,
                name: &tree.name,
                root: &tree.root,
                claimed: TreeRef::Tree(id),
            };
            let tuned = searched.tune(progress)?;
            Ok(searched.outcome(&tuned, None, None))
        }
        None => {
            let id = target::learner(loaded, options.learner)?;
            let name = program.learners[id].name.to_string();
            let source = loaded.sources.get(loaded.main);
            let how = learn::Options {
                learner: Some(&name),
                source: source.map_or("program.bt", |source| &source.name),
                keeper: options.keeper,
                ..learn::Options::default()
            };
            let heard = |stage| progress(Stage::Learning(stage));
            let learned = learn::learn(loaded, &how, &heard)?;
            of_learned(loaded, &learned, &how, options, progress)
        }
    }
}

/// Whether there is something to tune.
///
/// # Errors
/// There is not.
pub fn something(loaded: &Loaded) -> Result<(), Refused> {
    if !loaded.program.tunables.is_empty() {
        return Ok(());
    }
    let at = target::end_of_file(loaded);
    let diagnostic = Diagnostic::new(Code::E0504, at, "the program has nothing to tune")
        .label("`tune(VALUE, LOW .. HIGH)` is missing")
        .help("for example: `predicate low = battery <= tune(25%, 5% .. 60%)`");
    Err(Refused::program(loaded, [diagnostic]))
}

/// Tunes a tree that was learned under the values in use. Under better values it is learned again in the same way, and
/// the better of both trees is taken.
///
/// # Errors
/// As [`tune()`].
pub fn of_learned(
    loaded: &Loaded,
    learned: &Learned,
    how: &learn::Options,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Outcome, Refused> {
    let id = learned.learner;
    let learner = &loaded.program.learners[id];
    let searched = Searched {
        loaded,
        options,
        task: learner.task,
        name: &learner.name,
        root: &learned.tree.root,
        claimed: TreeRef::Learned(id),
    };
    let mut tuned = searched.tune(progress)?;
    let better = tuned.better().map(|better| better.values.clone());
    let program = better.and_then(|values| loaded.revalued(&values));
    let Some(program) = program else {
        return Ok(searched.outcome(&tuned, None, None));
    };
    let changed = Loaded {
        program,
        ..loaded.clone()
    };
    let heard = |stage| progress(Stage::Learning(stage));
    // Its states are others than those of the values in use.
    let keeper = Under::new(options.keeper, "again");
    let how = learn::Options {
        keeper: &keeper,
        ..*how
    };
    let anew = learn::learn(&changed, &how, &heard)?;
    let subject = Subject {
        root: &anew.tree.root,
        ..searched.subject(&|_| None)
    };
    let before = (&changed.program, searched.root);
    let fresh = (options.seed, tuned.fresh);
    let duel = duel(&subject, &changed.program, before, fresh)
        .map_err(|why| world::unplayable(loaded, why))?;
    tuned.ticks += duel.ticks;
    let text = match duel.is_won() {
        true => anew.text,
        false => learned.text.clone(),
    };
    Ok(searched.outcome(&tuned, Some(Again { duel }), Some(text)))
}

/// A tree whose numbers are tuned.
struct Searched<'a> {
    loaded: &'a Loaded,
    options: &'a Options<'a>,
    task: Id<Task>,
    name: &'a Name,
    root: &'a Node,
    claimed: TreeRef,
}

impl Searched<'_> {
    fn search(&self) -> tune::Options {
        tune::Options {
            effort: self.options.effort,
            episodes: self.options.episodes,
            seed: self.options.seed,
        }
    }

    fn subject<'s>(
        &'s self,
        revalued: &'s (dyn Fn(&[f64]) -> Option<Program> + Sync),
    ) -> Subject<'s> {
        Subject {
            program: &self.loaded.program,
            task: self.task,
            root: self.root,
            claimed: self.claimed,
            revalued,
        }
    }

    fn tune(&self, progress: &(dyn Fn(Stage) + Sync)) -> Result<Tuned, Refused> {
        let revalued = |values: &[f64]| self.loaded.revalued(values);
        let heard = |heard| progress(Stage::Tuning(heard));
        let keeper = self.options.keeper;
        tune::tune(&self.subject(&revalued), &self.search(), keeper, &heard)
            .map_err(|why| world::unplayable(self.loaded, why))
    }

    fn outcome(&self, tuned: &Tuned, again: Option<Again>, text: Option<String>) -> Outcome {
        let changes = tuned.better().map_or(Vec::new(), |better| {
            changes(self.loaded, better.values.as_slice())
        });
        let report = Report {
            program: &self.loaded.program,
            task: self.task,
            tree: self.name,
            options: self.search(),
            tuned,
            again,
            edits: changes
                .iter()
                .map(|change| edit(self.loaded, change))
                .collect(),
        };
        Outcome {
            human: report.human(),
            json: report.json(),
            pictures: report.pictures(),
            fixed: fixed(self.loaded, &changes),
            text,
        }
    }
}

/// Where the values differ from those in use, with what is to stand there.
fn changes(loaded: &Loaded, values: &[f64]) -> Vec<(Span, String)> {
    let tunables = loaded.program.tunables.values().zip(values);
    let sites = tunables.zip(&loaded.tunes);
    let changed = sites.filter(|((tunable, value), _)| **value != tunable.value);
    let changes = changed.flat_map(|((tunable, value), sites)| {
        let text = tunable.written(*value);
        sites.iter().map(move |site| (*site, text.clone()))
    });
    changes.collect()
}

fn edit(loaded: &Loaded, (span, replacement): &(Span, String)) -> Edit {
    let source = loaded.sources.get(span.file);
    let (line, column) = source.map_or((0, 0), |source| source.position(span.start));
    Edit {
        file: source.map_or(String::new(), |source| source.name.clone()),
        line: line + 1,
        column: column + 1,
        bytes: [span.start, span.end],
        text: loaded.sources.text(*span).to_owned(),
        replacement: replacement.clone(),
    }
}

/// The files with their changes; nothing else in them is touched.
fn fixed(loaded: &Loaded, changes: &[(Span, String)]) -> Vec<(String, String)> {
    let texts = loaded.texts(changes).into_values();
    texts.map(|source| (source.name, source.text)).collect()
}
