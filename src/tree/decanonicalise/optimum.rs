//! The smallest tree without memory for a table of few rows.

mod division;
mod formulas;

use super::problem::Problem;
use crate::ir::tree::Node;
use crate::logic::Account;
use crate::tree::unit::selector;
pub(super) use division::Division;

/// The most rows of a table over any atoms, of those that are always tried, and of a table over few atoms.
const ROWS: usize = 12;
const FEW: usize = 10;
const ALL_ROWS: usize = 16;
/// The atoms that have so many minterms.
const ATOMS: usize = 4;

/// A tree of fewest nodes among those in which each group decides all rows that reach it; `None` where there are too many rows,
/// or the account does not go so far.
pub(super) fn optimum(problem: &Problem, account: &Account) -> Option<Node> {
    let rows = problem.policy.rows.len();
    let atoms = problem.columns().atoms();
    let most = if atoms > ATOMS { ROWS } else { ALL_ROWS };
    if atoms == 0 || rows > most || problem.wide || rows == 0 {
        return None;
    }
    let work = Division::work(rows);
    if rows > FEW && !account.affords(work.saturating_mul(2)) {
        return None;
    }
    account.spend(work);
    let set = |rows: &crate::logic::Bits| rows.iter().fold(0, |all, row| all | 1 << row);
    let columns = problem.columns().iter();
    let columns = columns.map(|(_, column)| set(column)).collect();
    let bodies = problem.on.iter();
    let bodies = bodies.map(|(behavior, rows)| (Node::Behavior(*behavior), set(rows)));
    let division = Division::new(rows, columns, bodies.collect());
    Some(selector(division.children(&problem.policy.atoms)))
}
