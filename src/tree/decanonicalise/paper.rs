//! Algorithm 1, made definite.

use super::problem::Problem;
use super::subunit::{Pair, Subunit, behaviors, canonical, pairs, replace};
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover, Cube, Literal};
use crate::tree::Size;
use crate::tree::formula::{guarded, literal, selector};

/// Rounds of ordering and minimising after which the last is taken.
const ROUNDS: usize = 32;

/// The tree that Algorithm 1 finds.
///
/// Memory nodes that are refuted once all parts are in their places are given up, the latest first; without any, the
/// tree is right by its guards.
pub(super) fn tree(problem: &Problem) -> Node {
    let mut refused: Vec<(Bits, Bits)> = Vec::new();
    loop {
        let mut joined = Vec::new();
        let subunits = rewrite(problem, &refused, &mut joined);
        let root = place(problem, &subunits);
        match joined.pop() {
            Some(last) if !problem.proves(&root) => refused.push(last),
            _ => return root,
        }
    }
}

/// Lines 2–15: X, Y and Z while there are any.
fn rewrite(
    problem: &Problem,
    refused: &[(Bits, Bits)],
    joined: &mut Vec<(Bits, Bits)>,
) -> Vec<Subunit> {
    let mut subunits = behaviors(problem);
    loop {
        let next = memory(problem, &subunits, refused, joined, Pair::x)
            .or_else(|| memory(problem, &subunits, refused, joined, Pair::y))
            .or_else(|| z(problem, &subunits));
        match next {
            Some(next) => subunits = next,
            None => return subunits,
        }
    }
}

/// The first X or Y that is proved.
fn memory(
    problem: &Problem,
    subunits: &[Subunit],
    refused: &[(Bits, Bits)],
    joined: &mut Vec<(Bits, Bits)>,
    form: impl Fn(&Pair, &Problem, &[Subunit]) -> Option<Subunit>,
) -> Option<Vec<Subunit>> {
    for pair in pairs(problem, subunits) {
        let (first, second) = pair.of(subunits)?;
        let key = (first.rows.clone(), second.rows.clone());
        if refused.contains(&key) || !pair.entered_properly(problem, subunits) {
            continue;
        }
        let Some(subunit) = form(&pair, problem, subunits) else {
            continue;
        };
        let next = replace(subunits, pair.first, pair.second, subunit);
        if problem.proves(&canonical(problem, &next)) {
            joined.push(key);
            return Some(next);
        }
    }
    None
}

/// Z: `selector { c => B_j, B_i }` for the first literal that tells two subunits apart.
fn z(problem: &Problem, subunits: &[Subunit]) -> Option<Vec<Subunit>> {
    for (i, first) in subunits.iter().enumerate() {
        for (j, second) in subunits.iter().enumerate() {
            if i == j {
                continue;
            }
            let apart =
                |column: &Bits| first.rows.is_disjoint(column) && second.rows.is_subset(column);
            let Some((atom, _)) = problem.columns.iter().find(|(_, c)| apart(c)) else {
                continue;
            };
            let c = Literal {
                atom,
                positive: true,
            };
            let guard = literal(c, &problem.policy.atoms);
            let subunit = Subunit {
                body: selector(vec![
                    guarded(guard, second.body.clone()),
                    first.body.clone(),
                ]),
                rows: first.rows.or(&second.rows),
                last: None,
                guards_itself: false,
            };
            return Some(replace(subunits, i, j, subunit));
        }
    }
    None
}

/// Lines 16–22: orders the subunits by the length of their guards and minimises them from the left, where what is
/// already decided is free, until nothing changes.
fn place(problem: &Problem, subunits: &[Subunit]) -> Node {
    let against = |subunit: &Subunit, off: &Bits| match subunit.guards_itself {
        true => Cover::new([Cube::default()]),
        false => problem.cover(&subunit.rows, off),
    };
    let mut units: Vec<(Cover, &Subunit)> = subunits
        .iter()
        .map(|s| (against(s, &problem.all().minus(&s.rows)), s))
        .collect();
    for _ in 0..ROUNDS {
        let before: Vec<Cover> = units.iter().map(|(guard, _)| guard.clone()).collect();
        units.sort_by_key(|(guard, subunit)| match subunit.guards_itself {
            true => Size::of(&subunit.body).literals,
            false => guard.literals(),
        });
        let mut left = problem.all();
        for (guard, subunit) in &mut units {
            left = left.minus(&subunit.rows);
            *guard = against(subunit, &left);
        }
        if units.iter().map(|(guard, _)| guard).eq(&before) {
            break;
        }
    }
    selector(
        units
            .iter()
            .map(|(guard, subunit)| subunit.under(problem, guard))
            .collect(),
    )
}
