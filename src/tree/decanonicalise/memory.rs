//! Which behaviours stand in memory nodes: configurations of subunits, each proved.

use super::covers::Covers;
use super::pairs::{Pair, followers};
use super::subunit::{Subunit, behaviors, canonical, replace};
use crate::ir::tree::Node;

/// Configurations that are kept.
const CONFIGURATIONS: usize = 12;
/// Memory nodes that are put to the proof.
const ATTEMPTS: usize = 400;

type Form = fn(&Pair, &Covers, &[Subunit]) -> Option<Subunit>;

/// The behaviours alone, and what comes of joining pairs of subunits by memory nodes, as far as each is proved.
///
/// Chains are grown to their full length first, in either form; then every step on the way there and aside is tried.
pub(super) fn configurations(covers: &Covers) -> Vec<Vec<Subunit>> {
    let alone = behaviors(covers.problem);
    let mut joins = Joins {
        covers,
        tried: Vec::new(),
    };
    if covers.problem.wide {
        return vec![alone];
    }
    let mut found = vec![alone.clone()];
    for forms in [
        [Pair::joined as Form, Pair::inner, Pair::y],
        [Pair::y, Pair::inner, Pair::joined],
    ] {
        let mut longest = alone.clone();
        let mut stages = Vec::new();
        while let Some(next) = joins.next(&longest, &forms) {
            stages.push(next.clone());
            longest = next;
        }
        found.extend(stages.into_iter().rev());
    }
    let mut at = 0;
    while let Some(subunits) = found.get(at).cloned() {
        let forms = [Pair::joined as Form, Pair::inner, Pair::y];
        while found.len() < CONFIGURATIONS
            && let Some(next) = joins.next(&subunits, &forms)
        {
            found.push(next);
        }
        at += 1;
    }
    found.truncate(CONFIGURATIONS);
    found
}

/// What was tried so far.
struct Joins<'a, 'p> {
    covers: &'a Covers<'p>,
    tried: Vec<Vec<Node>>,
}

impl Joins<'_, '_> {
    /// The first join of two subunits that is new and proved.
    fn next(&mut self, subunits: &[Subunit], forms: &[Form]) -> Option<Vec<Subunit>> {
        let problem = self.covers.problem;
        for pair in followers(problem, subunits) {
            if !pair.entered_properly(problem, subunits) {
                continue;
            }
            for form in forms {
                let Some(subunit) = form(&pair, self.covers, subunits) else {
                    continue;
                };
                let joined = replace(subunits, pair.first, pair.second, subunit);
                let bodies: Vec<Node> = joined.iter().map(|s| s.body.clone()).collect();
                if self.tried.len() >= ATTEMPTS || self.tried.contains(&bodies) {
                    continue;
                }
                self.tried.push(bodies);
                if problem.proves(&canonical(self.covers, &joined)) {
                    return Some(joined);
                }
            }
        }
        None
    }
}
