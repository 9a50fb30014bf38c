//! Trees of few predicates against the smallest there are, which dynamic programs over all sets of rows find.
//!
//! The class: selectors of units, `guard => body`, where a guard is any formula of `and`, `or` and negated or plain predicates, and
//! a body is a behaviour or a selector again. A selector in a unit may leave rows to what follows the unit (`falls`), or not.

use super::scale::{searched, table};
use crate::laws::random::Random;
use btc::logic::Order;
use btc::policy::Minterm;
use rayon::prelude::*;
use std::collections::BTreeSet;

const NEVER: u8 = 100;

/// A row for each minterm that a table has.
pub(super) struct Rows {
    minterms: Vec<usize>,
    atoms: usize,
    /// The nodes of the smallest guard under a sequence for each division of the rows, in base 3: 0 where it does not hold, 1 where
    /// it does, 2 where it may. A guard that holds everywhere is none.
    guards: Vec<u8>,
    ternary: Vec<usize>,
}

impl Rows {
    pub(super) fn new(minterms: Vec<usize>, atoms: usize) -> Self {
        let count = minterms.len();
        let columns: Vec<usize> = (0..atoms)
            .map(|atom| {
                let holds = |row: &usize| minterms[*row] >> atom & 1 == 1;
                (0..count).filter(holds).map(|row| 1 << row).sum()
            })
            .collect();
        let formulas = formulas(count, &columns);
        let mut guards = vec![NEVER; 3_usize.pow(count as u32)];
        let mut digits = vec![0_u8; count];
        for at in 0..guards.len() {
            guards[at] = match digits.iter().position(|digit| *digit == 2) {
                Some(row) => {
                    let power = 3_usize.pow(row as u32);
                    guards[at - power].min(guards[at - 2 * power])
                }
                None => {
                    formulas[(0..count)
                        .map(|row| usize::from(digits[row]) << row)
                        .sum::<usize>()]
                }
            };
            for digit in &mut digits {
                *digit = (*digit + 1) % 3;
                if *digit > 0 {
                    break;
                }
            }
        }
        let power = |set: usize| -> usize {
            let rows = (0..count).filter(|row| set >> row & 1 == 1);
            rows.map(|row| 3_usize.pow(row as u32)).sum()
        };
        Self {
            ternary: (0..1 << count).map(power).collect(),
            minterms,
            atoms,
            guards,
        }
    }

    fn all(&self) -> usize {
        self.ternary.len() - 1
    }

    /// The smallest guard that holds on a part of a set.
    fn guard(&self, set: usize, part: usize) -> u8 {
        if part == set {
            return 0;
        }
        self.guards[2 * (self.ternary[self.all()] - self.ternary[set]) + self.ternary[part]]
    }

    /// The nodes of the smallest tree for a class of each row.
    fn smallest(&self, classes: &[usize], falls: bool) -> usize {
        let alike = |set: usize| {
            let mut own = (0..classes.len())
                .filter(|row| set >> row & 1 == 1)
                .map(|row| classes[row]);
            let first = own.next();
            own.all(|class| Some(class) == first)
        };
        let alike: Vec<bool> = (0..=self.all()).map(alike).collect();
        // The children of a list for a set that decides some of it and leaves the others, in base 3: 1 decided, 2 left.
        let at = |decided: usize, left: usize| self.ternary[decided] + 2 * self.ternary[left];
        let mut lists = vec![NEVER; if falls { self.guards.len() } else { 0 }];
        // The same for lists that leave nothing.
        let mut whole = vec![0_u8; self.all() + 1];
        for set in 1..=self.all() {
            for left in subsets(set).filter(|left| *left != set && (falls || *left == 0)) {
                let decided = set - left;
                let mut best = if left == 0 && alike[set] { 1 } else { NEVER };
                for part in subsets(if best > 1 { decided } else { 0 }).filter(|part| *part > 0) {
                    let rest = match (left, part == decided) {
                        (_, true) => 0,
                        (0, false) => whole[decided - part],
                        (_, false) => lists[at(decided - part, left)],
                    };
                    for inner in subsets(if falls { set - part } else { 0 }) {
                        let guard = self.guard(set, part | inner);
                        let body = match (inner, part | inner == set) {
                            (0, _) if alike[part] => 1,
                            (_, true) => continue,
                            (0, false) => 1 + whole[part],
                            (_, false) => 1 + lists[at(part, inner)],
                        };
                        let unit = if guard == 0 { body } else { 1 + guard + body };
                        best = best.min(unit + rest);
                    }
                }
                if left == 0 {
                    whole[set] = best;
                }
                if falls {
                    lists[at(decided, left)] = best;
                }
            }
        }
        usize::from(whole[self.all()]) + usize::from(!alike[self.all()])
    }

    /// The nodes of the tree that is found.
    pub(super) fn found(&self, classes: &[usize], effort: u64) -> usize {
        let rows = self.minterms.iter().zip(classes).map(|(minterm, class)| {
            let values = (0..self.atoms).map(|atom| minterm >> atom & 1 == 1);
            (Minterm::new(values), *class)
        });
        let behaviors = 1 + classes.iter().max().unwrap();
        let policy = table(self.atoms, behaviors, rows);
        searched(&policy, Order::Learned, effort).size.nodes
    }
}

/// All subsets, the whole set first and the empty one last.
fn subsets(set: usize) -> impl Iterator<Item = usize> {
    std::iter::successors(Some(set), move |part| (*part > 0).then(|| (part - 1) & set))
}

/// The nodes of the smallest formula of each set of rows as a child of a sequence. A disjunction is a selector; as a child of one it
/// costs what its negation costs as a child of a sequence.
fn formulas(rows: usize, columns: &[usize]) -> Vec<u8> {
    let all = (1 << rows) - 1;
    let mut nodes = vec![NEVER; all + 1];
    let mut levels: Vec<Vec<usize>> = vec![Vec::new()];
    for size in 1..NEVER {
        let literals = columns.iter().flat_map(|column| [*column, all - column]);
        let mut sets: Vec<usize> = literals.filter(|_| size == 1).collect();
        sets.extend(levels[usize::from(size) - 1].iter().map(|set| all - set));
        for fewer in 1..=usize::from(size) / 2 {
            for a in &levels[fewer] {
                let others = levels[usize::from(size) - fewer].iter();
                sets.extend(others.map(|b| a & b).filter(|set| nodes[*set] > size));
            }
            sets.sort_unstable();
            sets.dedup();
        }
        sets.retain(|set| *set > 0 && *set < all && nodes[*set] == NEVER);
        sets.sort_unstable();
        sets.dedup();
        sets.iter().for_each(|set| nodes[*set] = size);
        levels.push(sets);
        if levels.iter().rev().take(3).all(Vec::is_empty) || levels.concat().len() == all - 1 {
            break;
        }
    }
    nodes
}

/// The policies of three predicates with this many open rows and two to four behaviours; of those that are one but for the names
/// and signs of predicates and the names of behaviours, the first. `None` is an open row.
pub(super) fn policies(open: usize) -> BTreeSet<[Option<usize>; 8]> {
    let mut found = BTreeSet::new();
    drawn(&mut [None; 8], 0, open, 0, &mut found);
    found
}

fn drawn(
    policy: &mut [Option<usize>; 8],
    at: usize,
    open: usize,
    behaviors: usize,
    found: &mut BTreeSet<[Option<usize>; 8]>,
) {
    if at == 8 {
        if open == 0 && behaviors > 1 {
            found.insert(first_alike(policy));
        }
        return;
    }
    for behavior in 0..=behaviors.min(3) {
        policy[at] = Some(behavior);
        drawn(policy, at + 1, open, behaviors.max(behavior + 1), found);
    }
    if open > 0 {
        policy[at] = None;
        drawn(policy, at + 1, open - 1, behaviors, found);
    }
}

fn first_alike(policy: &[Option<usize>; 8]) -> [Option<usize>; 8] {
    let orders = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    let alike = orders.iter().flat_map(|order| {
        (0..8_usize).map(|negated| {
            let mut names: Vec<usize> = Vec::new();
            std::array::from_fn(|minterm| {
                let bits = (0..3).map(|atom| (minterm >> atom & 1) << order[atom]);
                let behavior = policy[bits.sum::<usize>() ^ negated]?;
                names.iter().position(|name| *name == behavior).or_else(|| {
                    names.push(behavior);
                    Some(names.len() - 1)
                })
            })
        })
    });
    alike.min().unwrap()
}

/// The rows of a policy, and their classes.
pub(super) fn closed(policy: &[Option<usize>; 8]) -> (Rows, Vec<usize>) {
    let minterms = (0..8).filter(|minterm| policy[*minterm].is_some());
    (
        Rows::new(minterms.collect(), 3),
        policy.iter().flatten().copied().collect(),
    )
}

/// All policies of three predicates with at most two open rows; parity is among them.
#[test]
fn policies_of_three_predicates_have_the_smallest_tree() {
    let all: Vec<_> = [0, 1, 2].into_iter().flat_map(policies).collect();
    all.par_iter().for_each(|policy| {
        let (rows, classes) = closed(policy);
        let (found, least) = (rows.found(&classes, 1), rows.smallest(&classes, true));
        assert_eq!(found, least, "{policy:?}");
    });
}

/// Few rows over many predicates, drawn at random.
#[test]
fn tables_of_ten_rows_have_the_smallest_tree() {
    (0..24_u64).into_par_iter().for_each(|seed| {
        let random = &mut Random::new(seed + 50_000);
        let atoms = 5 + random.below(5);
        let mut minterms: Vec<usize> = (0..1 << atoms).collect();
        while minterms.len() > 10 {
            minterms.swap_remove(random.below(minterms.len()));
        }
        let classes: Vec<usize> = (0..10).map(|_| random.below(4)).collect();
        let rows = Rows::new(minterms, atoms);
        let (found, least) = (rows.found(&classes, 1), rows.smallest(&classes, false));
        assert!(
            found <= least,
            "seed {seed}: {found} nodes, {least} are enough"
        );
    });
}

/// Tables of `rows` rows over four predicates, drawn at random: how much larger the trees are than the smallest.
fn excess(rows: usize, falls: bool, seeds: u64) -> Vec<usize> {
    let complete = (rows == 16).then(|| Rows::new((0..16).collect(), 4));
    let excess = (0..seeds).map(|seed| {
        let random = &mut Random::new(seed + 40_000);
        let mut minterms: Vec<usize> = (0..16).collect();
        while minterms.len() > rows {
            minterms.remove(random.below(minterms.len()));
        }
        let behaviors = 2 + seed as usize % 3;
        let classes: Vec<usize> = (0..rows).map(|_| random.below(behaviors)).collect();
        let own = (rows < 16).then(|| Rows::new(minterms, 4));
        let table = complete.as_ref().or(own.as_ref()).unwrap();
        let (found, least) = (table.found(&classes, 20), table.smallest(&classes, falls));
        println!(
            "{rows} rows, {behaviors} behaviours, seed {seed}: {found} nodes, {least} are enough"
        );
        found - least
    });
    excess.collect()
}

/// `cargo test --release --test it -- --ignored --nocapture policies_of_four`
#[test]
#[ignore = "minutes"]
fn policies_of_four_predicates_have_the_smallest_tree() {
    for (rows, falls, seeds) in [(16, false, 30), (12, false, 90), (12, true, 6)] {
        let excess = excess(rows, falls, seeds);
        let larger = excess.iter().filter(|nodes| **nodes > 0).count();
        println!(
            "{rows} rows: {larger} of {seeds} are larger, worst {:?}",
            excess.iter().max()
        );
        assert_eq!(larger, 0);
    }
}
