//! Algorithm 1, made definite.

use super::minimiser::Minimiser;
use super::pairs::{Pair, pairs};
use super::subunit::{Subunit, behaviors, canonical, replace};
use crate::ir::tree::Node;
use crate::logic::{Bits, Cover, Cube, Literal};
use crate::tree::Size;
use crate::tree::guard::literal;
use crate::tree::unit::{guarded, selector};
use std::rc::Rc;

/// The most rounds of ordering and minimising.
const ROUNDS: usize = 32;

/// The tree that Algorithm 1 finds.
///
/// If the finished tree is refuted, memory nodes are given up, the latest first. Without any, its guards make it right.
/// `None` if the account is spent.
pub(super) fn tree(minimiser: &Minimiser) -> Option<Node> {
    let mut refused: Vec<(Bits, Bits)> = Vec::new();
    loop {
        let mut joined = Vec::new();
        let subunits = rewrite(minimiser, &refused, &mut joined)?;
        let root = place(minimiser, &subunits)?;
        match joined.pop() {
            Some(last) if !minimiser.proves(&root) => refused.push(last),
            _ => return Some(root),
        }
    }
}

/// Lines 2–15: X, Y and Z while there are any.
fn rewrite(
    minimiser: &Minimiser,
    refused: &[(Bits, Bits)],
    joined: &mut Vec<(Bits, Bits)>,
) -> Option<Vec<Subunit>> {
    let mut subunits = behaviors(minimiser.problem);
    if minimiser.problem.wide {
        // A row that leaves a literal free stands on both of its sides.
        return Some(subunits);
    }
    loop {
        let copied = subunits.len() as u64 * minimiser.words();
        minimiser.account.spend(copied);
        if minimiser.account.is_spent() {
            return None;
        }
        let next = memory(minimiser, &subunits, refused, joined, Pair::x)
            .or_else(|| memory(minimiser, &subunits, refused, joined, Pair::y))
            .or_else(|| z(minimiser, &subunits));
        match next {
            Some(next) => subunits = next,
            None if minimiser.account.is_spent() => return None,
            None => return Some(subunits),
        }
    }
}

/// The first X or Y that is proved.
fn memory(
    minimiser: &Minimiser,
    subunits: &[Subunit],
    refused: &[(Bits, Bits)],
    joined: &mut Vec<(Bits, Bits)>,
    form: impl Fn(&Pair, &Minimiser, &[Subunit]) -> Option<Subunit>,
) -> Option<Vec<Subunit>> {
    for pair in pairs(minimiser.problem, subunits) {
        let (first, second) = pair.of(subunits)?;
        let key = (first.rows.clone(), second.rows.clone());
        if refused.contains(&key) || !pair.entered_properly(minimiser.problem, subunits) {
            continue;
        }
        let Some(subunit) = form(&pair, minimiser, subunits) else {
            continue;
        };
        let next = replace(subunits, pair.first, pair.second, subunit);
        if minimiser.proves(&canonical(minimiser, &next)?) {
            joined.push(key);
            return Some(next);
        }
    }
    None
}

/// Z: `selector { c => B_j, B_i }` for the first literal that discriminates two subunits.
fn z(minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Vec<Subunit>> {
    let columns = minimiser.problem.columns();
    for (i, first) in subunits.iter().enumerate() {
        // The literals that no row of the first has.
        let own = columns.iter().filter(|(_, c)| first.rows.is_disjoint(c));
        let own: Vec<(usize, &Bits)> = own.collect();
        minimiser.account.spend(columns.atoms() as u64);
        if minimiser.account.is_spent() {
            return None;
        }
        for (j, second) in subunits.iter().enumerate() {
            if i == j {
                continue;
            }
            let mut columns = own.iter();
            let Some((atom, _)) = columns.find(|(_, column)| second.rows.is_subset(column)) else {
                minimiser.account.spend(own.len() as u64);
                continue;
            };
            let c = Literal {
                atom: *atom,
                positive: true,
            };
            let guard = literal(c, &minimiser.problem.policy.atoms);
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
fn place(minimiser: &Minimiser, subunits: &[Subunit]) -> Option<Node> {
    let against = |subunit: &Subunit, off: &Bits| match subunit.guards_itself {
        true => Some(Rc::new(Cover::new([Cube::default()]))),
        false => minimiser.cover(&subunit.rows, off),
    };
    let all = minimiser.problem.all();
    let exact = |subunit| Some((against(subunit, &all.minus(&subunit.rows))?, subunit));
    let units: Option<Vec<(Rc<Cover>, &Subunit)>> = subunits.iter().map(exact).collect();
    let mut units = units?;
    for _ in 0..ROUNDS {
        let before: Vec<Rc<Cover>> = units.iter().map(|(guard, _)| guard.clone()).collect();
        units.sort_by_key(|(guard, subunit)| match subunit.guards_itself {
            true => Size::of(&subunit.body).literals,
            false => guard.literals(),
        });
        let mut left = all.clone();
        for (guard, subunit) in &mut units {
            left = left.minus(&subunit.rows);
            *guard = against(subunit, &left)?;
        }
        if units.iter().map(|(guard, _)| guard).eq(&before) {
            break;
        }
    }
    let units = units.iter();
    let units = units.map(|(guard, subunit)| subunit.under(minimiser.problem, guard));
    Some(selector(units))
}
