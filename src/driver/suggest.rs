//! `btc suggest`: what else a task could observe.

mod conditions;
mod readings;
mod search;

use super::learn::{self, found};
use super::load::Loaded;
use super::refused::Refused;
use super::{target, world};
use crate::ir::program::Predicate;
use crate::ir::task::Task;
use crate::ir::tree::Atom;
use crate::ir::{Id, Program};
use crate::learn::experiment::Experiment;
use crate::learn::simulated::Purpose;
use crate::report::suggested::{Report, Tried};
use crate::tree::Size;
use crate::tree::atoms::atoms;
use crate::trial::duel::duel;
use conditions::{Condition, conditions, observing, values_of_states};
use readings::readings;
use search::{Known, Search};

/// What a user may set.
#[derive(Clone, Copy, Debug)]
pub struct Options<'o> {
    /// The learner, if there are several.
    pub learner: Option<&'o str>,
    /// About how many ticks the search for one tree may take.
    pub effort: u64,
    /// The most conditions that are learned with.
    pub tries: usize,
    /// The number of fresh episodes on which the trees are held against each other.
    pub episodes: u64,
    /// The seed of everything.
    pub seed: u64,
}

impl Default for Options<'_> {
    fn default() -> Self {
        Self {
            learner: None,
            effort: 30_000_000,
            tries: 4,
            episodes: 400,
            seed: 1,
        }
    }
}

/// How far the command has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// Learning as the program stands, or with a condition more.
    Learning(learn::Stage),
    /// Asking what conditions are worth.
    Probing,
}

/// What came of it.
#[derive(Clone, Debug)]
pub struct Outcome {
    /// The report for a person.
    pub human: String,
    /// The report as a JSON document.
    pub json: String,
}

/// Looks for a condition that a learner's task could observe and that lets it learn a better tree.
///
/// # Errors
/// There is no learner, the world cannot be built, or nothing was learned.
pub fn suggest(
    loaded: &Loaded,
    options: &Options,
    progress: &(dyn Fn(Stage) + Sync),
) -> Result<Outcome, Refused> {
    let program = &loaded.program;
    let id = target::learner(loaded, options.learner)?;
    let (seed, task) = (options.seed, program.learners[id].task);
    let how = learn::Options {
        seed: Some(seed),
        effort: options.effort,
        ..learn::Options::default()
    };
    let heard = |stage| progress(Stage::Learning(stage));
    let unbuilt = |why| world::unplayable(loaded, why);
    let experiment = Experiment::new(program, id, None, how.evidence).map_err(unbuilt)?;
    let results = found(loaded, &experiment, &how, &heard)?;
    let root = results.root();

    progress(Stage::Probing);
    let readings = readings(loaded);
    let values = values_of_states(&experiment, root, seed);
    let conditions = conditions(loaded, task, &readings, &values);
    let extended = with_all(loaded, task, &conditions);
    let search = Search {
        loaded,
        learner: id,
        evidence: how.evidence,
        seed,
        program: extended,
        root,
    };
    let known: Vec<Known> = conditions
        .into_iter()
        .filter_map(|condition| {
            let named = |predicate: &Predicate| predicate.name.to_string() == condition.name;
            let id = search.program.predicates.find(named)?;
            Some((condition, id))
        })
        .collect();
    let (promising, played) = search.promising(&known, options.effort)?;

    let mut tried = Vec::new();
    for (at, promised) in promising.into_iter().take(options.tries) {
        let Some((condition, id)) = known.get(at).cloned() else {
            continue;
        };
        let changed = observing(&search.program, task, &[id]);
        let anew = Experiment::new(&changed, search.learner, None, how.evidence);
        let anew = anew.map_err(unbuilt)?;
        let with = found(loaded, &anew, &how, &heard)?;
        let start = Purpose::Suggest.start(seed, program.tasks[task].end_after);
        let both = [(program, root), (&changed, with.root())];
        let (duel, _) = duel(task, both, start, options.episodes)
            .map_err(|why| world::unplayable(loaded, why))?;
        tried.push(Tried {
            item: condition.item(),
            name: condition.name,
            condition: condition.text,
            promised,
            asked: atoms(with.root()).contains(&Atom::Predicate(id)),
            nodes: [root, with.root()].map(|root| Size::of(root).nodes),
            duel,
        });
    }
    let report = Report {
        program,
        task,
        seed,
        readings: readings.len(),
        conditions: known.len(),
        played,
        tried,
    };
    Ok(Outcome {
        human: report.human(),
        json: report.json(),
    })
}

/// The program with a predicate for each condition. A predicate that nothing uses would be left out, so a tree asks them all;
/// it goes no further.
fn with_all(loaded: &Loaded, task: Id<Task>, conditions: &[Condition]) -> Program {
    let program = &loaded.program;
    let items = conditions.iter().filter_map(Condition::item);
    let mut text: String = items.collect();
    let leaf = program.tasks[task].choose.first();
    let leaf = leaf.map(|id| program.behaviors[*id].name.to_string());
    if let Some(leaf) = leaf {
        let units = conditions.iter();
        let units = units.map(|condition| format!("{} => {leaf},", condition.name));
        let units: String = units.collect();
        text.push_str(&format!(
            "tree btc_asks_all for {} = selector {{ {units} {leaf} }}\n",
            program.tasks[task].name
        ));
    }
    let (mut extended, mistakes) = loaded.extended(&text);
    extended.trees = program.trees.clone();
    match mistakes.is_empty() {
        true => extended,
        // A program at one of its limits has no room for them.
        false => program.clone(),
    }
}
