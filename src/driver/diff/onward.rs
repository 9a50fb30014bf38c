//! Two trees that choose the same first in every tick: how they go on within it.

use crate::ir::law::Behavior;
use crate::ir::task::History;
use crate::ir::tree::{Exclusion, Node, Status};
use crate::ir::{Id, Program};
use crate::report::difference::Outcome;
use crate::report::verdict;
use crate::tree::change;
use crate::tree::equivalence::{Environment, Onward, Side, Verdict, compare};

/// What became of them, and whether that is so because of what the predicates compare. They were `found` to choose the same
/// where this environment lets them go.
pub(super) fn outcome(
    program: &Program,
    ((old, new), names): ((&Node, &Node), &[String; 2]),
    (history, met): (History, Environment),
    (how, onward): (String, &Onward),
) -> (Outcome, bool) {
    let excluded = match met {
        Environment::Possible(_, excluded) => excluded,
        _ => &[],
    };
    let parted = match onward {
        Onward::Alike => return (Outcome::Equal(how), !excluded.is_empty()),
        Onward::Undecided => {
            let text = format!("they choose the same first, {how}; {}", verdict::UNEXPLORED);
            return (Outcome::Undecided(text), !excluded.is_empty());
        }
        Onward::Differ(parted) => parted,
    };
    let may_end = |behavior: Id<Behavior>, status: Status| program.may_end(behavior, status);
    let changes =
        |excluded: &[Exclusion]| change::onward((old, new), (history, excluded), &may_end);
    let Some(found) = changes(excluded) else {
        let [old, new] = names;
        let way = verdict::parting(program, (old, new), parted);
        let way: Vec<&str> = way.lines().map(str::trim_start).collect();
        return (
            Outcome::Onward(Vec::new(), way.join("\n")),
            !excluded.is_empty(),
        );
    };
    let alike = || {
        let found = compare(Side::Tree(old), Side::Tree(new), Environment::Any(history));
        matches!(found, Ok(Verdict::Equal(_)))
    };
    let by_predicates = !excluded.is_empty() && (changes(&[]).as_ref() != Some(&found) || !alike());
    (Outcome::Onward(found, String::new()), by_predicates)
}
