//! Which behaviours memory nodes join: configurations of subunits, each proved.

use super::minimiser::Minimiser;
use super::pairs::{Pair, followers};
use super::subunit::{Subunit, behaviors, canonical, replace};
use crate::ir::tree::Node;

/// Configurations that are kept.
const CONFIGURATIONS: usize = 12;
/// Memory nodes whose proof is tried.
const ATTEMPTS: usize = 400;

type Form = fn(&Pair, &Minimiser, &[Subunit]) -> Option<Subunit>;

/// The behaviours alone, and configurations in which memory nodes join pairs of subunits, each proved.
///
/// First chains are grown to their full length, in either form. Then every configuration on the way there is joined
/// further in other ways.
pub(super) fn configurations(minimiser: &Minimiser) -> Vec<Vec<Subunit>> {
    let alone = behaviors(minimiser.problem);
    let mut joins = Joins {
        minimiser,
        tried: Vec::new(),
    };
    if minimiser.problem.wide {
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

/// The joins that were tried.
struct Joins<'a, 'p> {
    minimiser: &'a Minimiser<'p>,
    tried: Vec<Vec<Node>>,
}

impl Joins<'_, '_> {
    /// The first join of two subunits that is new and proved.
    fn next(&mut self, subunits: &[Subunit], forms: &[Form]) -> Option<Vec<Subunit>> {
        let problem = self.minimiser.problem;
        for pair in followers(problem, subunits) {
            if !pair.entered_properly(problem, subunits) {
                continue;
            }
            for form in forms {
                let Some(subunit) = form(&pair, self.minimiser, subunits) else {
                    continue;
                };
                let joined = replace(subunits, pair.first, pair.second, subunit);
                let bodies: Vec<Node> = joined.iter().map(|s| s.body.clone()).collect();
                if self.tried.len() >= ATTEMPTS || self.tried.contains(&bodies) {
                    continue;
                }
                self.tried.push(bodies);
                let root = canonical(self.minimiser, &joined)?;
                if self.minimiser.proves(&root) {
                    return Some(joined);
                }
            }
        }
        None
    }
}
