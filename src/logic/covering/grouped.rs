//! Lists of rules in which some rules stand together behind a cube.
//!
//! Where a list has exceptions within exceptions, its rules repeat the literals of what they stand in, and a flat list of them is long
//! and hard to find. Here a list is divided: a few of its rules stay in front, then a cube that several of its rules share lets rows
//! into a list of their own, and another list decides the rest. Both are sought anew, among fewer rows, and divided in their turn.

use super::rebuild::{Known, lists};
use super::tidy::tidy;
use super::{List, Rule};
use crate::logic::account::Account;
use crate::logic::bits::Bits;
use crate::logic::columns::Columns;
use crate::logic::cube::{Cube, Literal};
use crate::logic::random::Random;
use std::collections::BTreeMap;

/// A list some of whose parts are lists behind a cube.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Grouped {
    /// The first that holds decides.
    pub parts: Vec<Part>,
    /// The class where none holds.
    pub last: usize,
}

/// A part of such a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Part {
    /// A class behind a cube.
    Rule(Rule),
    /// A list behind a cube.
    Group(Cube, Grouped),
}

impl Part {
    /// Where it decides.
    pub fn cube(&self) -> &Cube {
        match self {
            Self::Rule(rule) => &rule.cube,
            Self::Group(cube, _) => cube,
        }
    }
}

impl Grouped {
    /// The nodes as a tree, as those of [`List::nodes`].
    pub fn nodes(&self) -> usize {
        let parts = self.parts.iter().map(|part| match part {
            Part::Rule(rule) => 2 + rule.cube.literals().len(),
            Part::Group(cube, inner) => 1 + cube.literals().len() + inner.nodes(),
        });
        2 + parts.sum::<usize>()
    }

    /// The cubes of all rules and groups.
    pub fn cubes(&self) -> Vec<&Cube> {
        let parts = self.parts.iter().flat_map(|part| match part {
            Part::Rule(rule) => vec![&rule.cube],
            Part::Group(cube, inner) => {
                let mut cubes = inner.cubes();
                cubes.push(cube);
                cubes
            }
        });
        parts.collect()
    }
}

impl Grouped {
    /// The same without groups: each rule asks what its groups do.
    pub(super) fn flat(&self) -> List {
        let mut rules = Vec::new();
        self.flatten(&Cube::default(), &mut rules);
        List {
            rules,
            last: self.last,
        }
    }

    fn flatten(&self, above: &Cube, rules: &mut Vec<Rule>) {
        for part in &self.parts {
            let literals = above.literals().iter().chain(part.cube().literals());
            let cube = Cube::new(literals.copied());
            match part {
                Part::Rule(rule) => rules.push(Rule {
                    class: rule.class,
                    cube,
                }),
                Part::Group(_, inner) => {
                    inner.flatten(&cube, rules);
                    let class = inner.last;
                    rules.push(Rule { class, cube });
                }
            }
        }
    }
}

impl From<List> for Grouped {
    fn from(list: List) -> Self {
        Self {
            parts: list.rules.into_iter().map(Part::Rule).collect(),
            last: list.last,
        }
    }
}

/// Groups within groups.
pub(super) const DEPTH: usize = 4;
/// Cubes that are tried for a group, and divisions for which lists are sought.
const CUBES: usize = 12;
const SOUGHT: usize = 3;
/// Attempts at a smaller list for a part.
const PATIENCE: usize = 24;
/// Of a hundred divisions so many are passed over.
const PASSED: usize = 40;
/// A division may begin so many nodes above the list that it divides.
const SLACK: usize = 4;
/// Attempts without a smaller list after which the search ends.
const VAIN: usize = 12;

/// The smallest grouped list that is found from these lists, which decide every row rightly, within the account. Rows are minterms.
pub fn grouped(
    columns: &Columns,
    classes: &[Bits],
    flat: &[List],
    reach: u64,
    known: &mut Known,
    account: &Account,
) -> Option<Grouped> {
    let bounds = Bounds {
        reach,
        patience: PATIENCE,
        sought: SOUGHT,
        passes: false,
    };
    let mut search = Search::new(columns, classes, known, account, 0, bounds);
    let all = Bits::full(columns.rows());
    let mut best: Option<Grouped> = None;
    let mut vain = 0;
    for attempt in 0.. {
        let Some(list) = flat.iter().rev().nth(attempt % flat.len().max(1)) else {
            break;
        };
        if account.is_spent() || vain > VAIN {
            break;
        }
        search.bounds.passes = attempt > 0;
        let found = search.divided(&all, list.clone(), DEPTH);
        vain += 1;
        if best
            .as_ref()
            .is_none_or(|best| found.nodes() < best.nodes())
        {
            best = Some(found);
            vain = 0;
        }
    }
    best
}

/// What a search looks at.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    /// The words that may be read in the search for one rule of one class.
    pub(super) reach: u64,
    /// Attempts at a smaller list for a part.
    pub(super) patience: usize,
    /// Divisions for which lists are sought.
    pub(super) sought: usize,
    /// Whether some divisions are passed over at random.
    pub(super) passes: bool,
}

pub(super) struct Search<'a> {
    columns: &'a Columns,
    classes: &'a [Bits],
    known: &'a mut Known,
    account: &'a Account,
    random: Random,
    bounds: Bounds,
}

/// A list divided by a cube.
struct Division {
    /// The rules that stay in front.
    front: Vec<Rule>,
    cube: Cube,
    /// The rows of the group with their list, and what is left.
    inside: (Bits, List),
    outside: (Bits, List),
}

impl Division {
    fn nodes(&self) -> usize {
        let front = self.front.iter().map(|rule| 2 + rule.cube.literals().len());
        let group = 1 + self.cube.literals().len() + self.inside.1.nodes();
        front.sum::<usize>() + group + self.outside.1.nodes()
    }
}

impl<'a> Search<'a> {
    pub(super) fn new(
        columns: &'a Columns,
        classes: &'a [Bits],
        known: &'a mut Known,
        account: &'a Account,
        seed: u64,
        bounds: Bounds,
    ) -> Self {
        Self {
            columns,
            classes,
            known,
            account,
            random: Random::new(seed),
            bounds,
        }
    }

    /// A grouped list for these rows, all of which the list decides rightly.
    pub(super) fn divided(&mut self, rows: &Bits, list: List, depth: usize) -> Grouped {
        let flat = list.nodes();
        if depth == 0 || list.rules.len() < 3 || self.account.is_spent() {
            return list.into();
        }
        let mut divisions = self.divisions(rows, &list);
        divisions.sort_by_key(Division::nodes);
        divisions.dedup_by(|a, b| a.cube == b.cube && a.front == b.front);
        if self.bounds.passes {
            let random = &mut self.random;
            divisions.retain(|_| random.below(100) >= PASSED);
        }
        divisions.truncate(self.bounds.sought);
        for division in &mut divisions {
            self.sought(&mut division.inside);
            self.sought(&mut division.outside);
        }
        let best = divisions.into_iter().min_by_key(Division::nodes);
        let Some(best) = best.filter(|best| best.nodes() <= flat + SLACK) else {
            return list.into();
        };
        let inner = self.divided(&best.inside.0, best.inside.1, depth - 1);
        let outer = self.divided(&best.outside.0, best.outside.1, depth);
        let mut parts: Vec<Part> = best.front.into_iter().map(Part::Rule).collect();
        parts.push(Part::Group(best.cube, inner));
        parts.extend(outer.parts);
        let last = outer.last;
        let divided = Grouped { parts, last };
        match divided.nodes() < flat {
            true => divided,
            false => list.into(),
        }
    }

    /// The list divided by cubes that several of its rules share.
    fn divisions(&self, rows: &Bits, list: &List) -> Vec<Division> {
        let mut found = Vec::new();
        for cube in shared(list) {
            let has = |rule: &Rule| within(&cube, &rule.cube);
            let first = list.rules.iter().position(has).unwrap_or(0);
            let last = list.rules.iter().rposition(has).unwrap_or(0);
            let mut ends = vec![0, first, last];
            ends.dedup();
            for end in ends {
                found.extend(self.division(rows, list, &cube, end));
            }
        }
        found
    }

    /// The list with those of its first rules in front that do not have the cube and still decide rightly, and then divided by it.
    fn division(&self, rows: &Bits, list: &List, cube: &Cube, end: usize) -> Option<Division> {
        let words = 8 + self.columns.rows().div_ceil(64);
        self.account.spend((4 * (end + 2) * words) as u64);
        let mut left = rows.clone();
        let mut front = Vec::new();
        for rule in list.rules.iter().take(end) {
            let decided = self.columns.cube_rows(&rule.cube, &left);
            let own = self.classes.get(rule.class)?;
            if !within(cube, &rule.cube) && !decided.is_empty() && decided.is_subset(own) {
                left.subtract(&decided);
                front.push(rule.clone());
            }
        }
        let inside = self.columns.cube_rows(cube, &left);
        let outside = left.minus(&inside);
        let mixed = |rows: &Bits| !self.classes.iter().any(|own| rows.is_subset(own));
        if outside.is_empty() || !mixed(&inside) {
            return None;
        }
        // What decides more rows rightly decides these.
        let tidied = |rows: Bits| {
            let mut list = list.clone();
            tidy(self.columns, self.classes, &rows, &mut list, self.account);
            (rows, list)
        };
        Some(Division {
            front,
            cube: cube.clone(),
            inside: tidied(inside),
            outside: tidied(outside),
        })
    }

    /// Looks for a smaller list for these rows.
    pub(super) fn sought(&mut self, (rows, list): &mut (Bits, List)) {
        if list.rules.len() < 2 || self.account.is_spent() {
            return;
        }
        let (columns, classes) = picked(self.columns, self.classes, rows, self.account);
        self.known.list = Some(list.clone());
        let found = lists(
            &columns,
            &classes,
            self.bounds.reach,
            self.bounds.patience,
            self.known,
            self.account,
        );
        let found = found.into_iter().last();
        if let Some(found) = found.filter(|found| found.nodes() < list.nodes()) {
            *list = found;
        }
    }
}

/// Some rows alone, and those of them that each class has.
pub fn picked(
    columns: &Columns,
    classes: &[Bits],
    rows: &Bits,
    account: &Account,
) -> (Columns, Vec<Bits>) {
    let rows: Vec<usize> = rows.iter().collect();
    account.spend(((columns.atoms() + classes.len()) * rows.len()) as u64);
    let own = |own: &Bits| {
        let own = rows
            .iter()
            .enumerate()
            .filter(|(_, row)| own.contains(**row));
        Bits::collect(rows.len(), own.map(|(at, _)| at))
    };
    let classes = classes.iter().map(own).collect();
    (columns.pick(&rows), classes)
}

/// Whether all literals of a cube are in another.
fn within(cube: &Cube, other: &Cube) -> bool {
    let mut literals = cube.literals().iter();
    literals.all(|literal| other.literals().contains(literal))
}

/// Literals, and pairs of them, that several rules of a list have: first those that save most if they are asked once.
fn shared(list: &List) -> Vec<Cube> {
    let mut counts: BTreeMap<Vec<Literal>, usize> = BTreeMap::new();
    for rule in &list.rules {
        let literals = rule.cube.literals();
        for (at, one) in literals.iter().enumerate() {
            *counts.entry(vec![*one]).or_default() += 1;
            for other in literals.iter().skip(at + 1) {
                *counts.entry(vec![*one, *other]).or_default() += 1;
            }
        }
    }
    let mut counts: Vec<(usize, Vec<Literal>)> = counts
        .into_iter()
        .filter(|(_, count)| *count > 1)
        .map(|(literals, count)| ((count - 1) * literals.len(), literals))
        .collect();
    counts.sort_by_key(|(saved, _)| std::cmp::Reverse(*saved));
    let best = counts.into_iter().take(CUBES);
    best.map(|(_, literals)| Cube::new(literals)).collect()
}
