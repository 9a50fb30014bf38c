//! What was found, held against the values in use on seeds that nothing was chosen by.

use super::field::values;
use super::grid::Axis;
use super::{Options, Subject, never};
use crate::ir::Program;
use crate::ir::task::ClaimKind;
use crate::ir::tree::Node;
use crate::learn::episode::Episode;
use crate::learn::simulated::Purpose;
use crate::trial::Unplayable;
use crate::trial::claim::Tests;
use crate::trial::duel::{self, Duel, happened};

/// Some values against those in use.
#[derive(Clone, Debug)]
pub struct Confirmed {
    /// The values, in the units of the numbers.
    pub values: Vec<f64>,
    /// How they do.
    pub duel: Duel,
    /// The claims on the tree that do not hold under these values, and hold under those in use or fail more seldom, as they are
    /// written.
    pub refuted: Vec<String>,
}

impl Confirmed {
    /// Whether these values are better, and refute no claim that an event never happens.
    pub fn holds(&self) -> bool {
        self.duel.is_won() && self.refuted.is_empty()
    }
}

/// Lets the tree of a subject play fresh episodes under other values, and the tree of another under those in use.
///
/// # Errors
/// One of them cannot be played.
pub fn duel(
    subject: &Subject,
    program: &Program,
    before: (&Program, &Node),
    options: &Options,
) -> Result<Duel, Unplayable> {
    Ok(fought(subject, program, before, options)?.0)
}

fn fought(
    subject: &Subject,
    program: &Program,
    (used, root): (&Program, &Node),
    options: &Options,
) -> Result<(Duel, [Vec<Episode>; 2]), Unplayable> {
    let limit = program.tasks[subject.task].end_after;
    let start = Purpose::TuneConfirm.start(options.seed, limit);
    let both = [(used, root), (program, subject.root)];
    duel::duel(subject.task, both, start, options.episodes)
}

/// Plays fresh episodes under the values of a point and under those in use. `None` if the program has mistakes under
/// these values.
pub(super) fn confirm(
    subject: &Subject,
    axes: &[Axis],
    point: &[usize],
    options: &Options,
) -> Result<Option<Confirmed>, Unplayable> {
    let values = values(axes, point);
    let Some(program) = (subject.revalued)(&values) else {
        return Ok(None);
    };
    let (duel, [before, after]) =
        fought(subject, &program, (subject.program, subject.root), options)?;
    let never = never(subject);
    let mut refuted = Vec::new();
    let mut tests = Tests::new(&program);
    let mut used = Tests::new(subject.program);
    for claim in program.claims.iter().filter(|c| c.tree == subject.claimed) {
        let ClaimKind::Never(occurrence) = &claim.kind else {
            continue;
        };
        let tree = (subject.task, subject.root);
        let tested = tests.event(tree, occurrence, false)?;
        let event = occurrence.event.index();
        let [before, after] = [&before, &after].map(|played| happened(played, &[event]));
        let met = never.contains(&event) && after > 0;
        // A claim that fails in any case, and not more often, tells against neither.
        let fails = (tested.refuted() || met)
            && (after > before || !used.event(tree, occurrence, false)?.refuted());
        if fails {
            refuted.push(claim.text.clone());
        }
    }
    Ok(Some(Confirmed {
        values,
        duel,
        refuted,
    }))
}
