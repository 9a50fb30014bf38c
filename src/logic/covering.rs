//! Sequential covering: the cheapest rule next, whatever its class (CN2: Clark and Niblett 1989; RIPPER: Cohen 1995).
//!
//! A rule is a cube with a class. It may stand next in a list if every row left that it meets is of its class. Of all such
//! rules that a search finds, the one that decides most rows for its price is taken, until the rows left are of one class.
//! Unlike a list of classes ([`list`](mod@super::list)), such a list may return to a class.

mod rebuild;
mod tidy;

pub use rebuild::lists;

use super::account::Account;
use super::bits::Bits;
use super::columns::Columns;
use super::cube::{Cube, Literal};

/// A class behind a cube.
#[derive(Clone, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Rule {
    /// The class.
    pub class: usize,
    /// Where it is taken, if no rule before holds.
    pub cube: Cube,
}

/// Rules from the left, and the class of what they leave.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct List {
    /// The first that holds decides.
    pub rules: Vec<Rule>,
    /// The class where none holds.
    pub last: usize,
}

impl List {
    /// The nodes of the list as a tree: a sequence, a leaf and the literals for each rule, a leaf and a selector.
    pub fn nodes(&self) -> usize {
        let rules = self.rules.iter();
        2 + rules
            .map(|rule| 2 + rule.cube.literals().len())
            .sum::<usize>()
    }
}

/// What makes a rule worth taking next: the rows that it decides, by the weight of its class, for its nodes.
#[derive(Clone, Debug)]
pub struct Worth {
    /// The weight of each class.
    weights: Vec<u32>,
    /// Whether its nodes count twice, so that short rules come first.
    squared: bool,
    /// The words that may be read in the search for one rule of one class.
    reach: u64,
}

/// The usual weight of a class.
const WEIGHT: u32 = 256;

impl Worth {
    /// All classes alike.
    pub fn plain(classes: usize, reach: u64) -> Self {
        Self {
            weights: vec![WEIGHT; classes],
            squared: false,
            reach,
        }
    }

    fn of(&self, weight: u32, decided: usize, literals: usize) -> u64 {
        let price = 2 + literals as u64;
        let decided = decided as u64 * u64::from(weight) * (1 << 12);
        match self.squared {
            true => decided / (price * price),
            false => decided / price,
        }
    }
}

/// A list of rules for these classes among the rows `among`; a row may be of several classes, each of which is right.
/// `None` if the account is spent before there is a list, or the list has more than `limit` nodes.
pub fn covering(
    columns: &Columns,
    classes: &[Bits],
    among: &Bits,
    worth: &Worth,
    limit: usize,
    account: &Account,
) -> Option<List> {
    let mut table = Table::of(columns, classes, among, account);
    let mut left = Bits::full(table.columns.rows());
    let mut list = List::default();
    loop {
        let mut classes = table.classes.iter();
        if let Some((class, _)) = classes.find(|(_, own)| left.is_subset(own)) {
            list.last = *class;
            return Some(list);
        }
        if account.is_spent() || list.nodes() > limit {
            return None;
        }
        // What is left of the rows alone is read faster.
        if 2 * left.count() < table.columns.rows() {
            table = table.among(&left, account);
            left = Bits::full(table.columns.rows());
        }
        let rule = table.best(&left, worth, account)?;
        let decided = table.columns.cube_rows(&rule.cube, &left);
        left.subtract(&decided);
        list.rules.push(rule);
    }
}

/// Some rows alone.
struct Table {
    columns: Columns,
    /// The classes that have rows here, with these.
    classes: Vec<(usize, Bits)>,
}

impl Table {
    fn of(columns: &Columns, classes: &[Bits], among: &Bits, account: &Account) -> Self {
        let classes = classes.iter().enumerate();
        Self::picked(columns, classes, among, account)
    }

    fn among(&self, among: &Bits, account: &Account) -> Self {
        let classes = self.classes.iter().map(|(number, own)| (*number, own));
        Self::picked(&self.columns, classes, among, account)
    }

    fn picked<'c>(
        columns: &Columns,
        classes: impl Iterator<Item = (usize, &'c Bits)>,
        among: &Bits,
        account: &Account,
    ) -> Self {
        let rows: Vec<usize> = among.iter().collect();
        let own = |members: &Bits| {
            let own = rows.iter().enumerate();
            let own = own.filter(|(_, row)| members.contains(**row));
            Bits::collect(rows.len(), own.map(|(at, _)| at))
        };
        let classes = classes.filter(|(_, members)| !members.is_disjoint(among));
        let classes: Vec<(usize, Bits)> = classes
            .map(|(number, members)| (number, own(members)))
            .collect();
        account.spend(((4 + columns.atoms() + classes.len()) * rows.len()) as u64);
        Self {
            columns: columns.pick(&rows),
            classes,
        }
    }

    /// The rule that is worth most among the rows left. Classes of no weight have none, unless they are all that is left.
    fn best(&self, left: &Bits, worth: &Worth, account: &Account) -> Option<Rule> {
        let weight = |class: usize| worth.weights.get(class).copied().unwrap_or(WEIGHT);
        let weighed = self.by_weight(left, worth, weight, account);
        weighed.or_else(|| self.by_weight(left, worth, |_| WEIGHT, account))
    }

    fn by_weight(
        &self,
        left: &Bits,
        worth: &Worth,
        weight: impl Fn(usize) -> u32,
        account: &Account,
    ) -> Option<Rule> {
        let mut best: Option<(u64, Rule)> = None;
        let open = self.literals();
        for (class, own) in &self.classes {
            let on = own.and(left);
            if weight(*class) == 0 || on.is_empty() {
                continue;
            }
            let off = left.minus(own);
            let mut search = Search {
                table: self,
                worth,
                weight: weight(*class),
                chosen: Vec::new(),
                best: best.as_ref().map_or(0, |(worth, _)| *worth),
                found: None,
                left: worth.reach,
            };
            search.dive(&on, &off, &open);
            search.extend(&on, &off, &open);
            account.spend(worth.reach - search.left);
            if let Some(literals) = search.found {
                let rule = Rule {
                    class: *class,
                    cube: Cube::new(literals),
                };
                best = Some((search.best, rule));
            }
        }
        best.map(|(_, rule)| rule)
    }

    fn literals(&self) -> Vec<Literal> {
        let atoms = 0..self.columns.atoms();
        atoms
            .flat_map(|atom| [true, false].map(|positive| Literal { atom, positive }))
            .collect()
    }

    fn inside(&self, rows: &Bits, literal: Literal) -> Bits {
        let mut rows = rows.clone();
        self.columns.restrict(&mut rows, literal);
        rows
    }

    fn meeting(&self, rows: &Bits, literal: Literal) -> Bits {
        let mut rows = rows.clone();
        if let (Some(column), inside) = self.columns.meeting(literal) {
            rows.keep(column, inside);
        }
        rows
    }

    /// How many of these rows lie in the literal, and how many of those meet it.
    fn counts(&self, on: &Bits, off: &Bits, literal: Literal) -> (usize, usize) {
        let count = |rows: &Bits, (column, inside): (Option<&Bits>, bool)| {
            let both = column.map_or(0, |column| rows.count_both(column));
            match inside {
                true => both,
                false => rows.count() - both,
            }
        };
        let inside = self.columns.inside(literal);
        (count(on, inside), count(off, self.columns.meeting(literal)))
    }
}

/// A literal that may be added to a cube: the rows of the class that stay in it, and others that it still meets.
#[derive(Clone, Copy)]
struct Step {
    literal: Literal,
    kept: usize,
    met: usize,
}

/// The search for the best rule of one class, by branch and bound.
struct Search<'a> {
    table: &'a Table,
    worth: &'a Worth,
    weight: u32,
    chosen: Vec<Literal>,
    /// The worth of the best rule so far, of any class.
    best: u64,
    found: Option<Vec<Literal>>,
    left: u64,
}

impl Search<'_> {
    fn worth(&self, decided: usize, literals: usize) -> u64 {
        self.worth.of(self.weight, decided, literals)
    }

    /// What the literals of `open` come to that exclude something and keep something.
    fn steps(&mut self, on: &Bits, off: &Bits, open: &[Literal]) -> Vec<Step> {
        let words = 16 + 2 * on.bound().div_ceil(64) as u64;
        self.left = self.left.saturating_sub(open.len() as u64 * words);
        let others = off.count();
        let step = |literal: &Literal| {
            let (kept, met) = self.table.counts(on, off, *literal);
            (kept > 0 && met < others).then_some(Step {
                literal: *literal,
                kept,
                met,
            })
        };
        open.iter().filter_map(step).collect()
    }

    fn complete(&mut self, step: Step) {
        let worth = self.worth(step.kept, self.chosen.len() + 1);
        if worth > self.best {
            self.best = worth;
            let chosen = self.chosen.iter().copied().chain([step.literal]);
            self.found = Some(chosen.collect());
        }
    }

    /// Greedy choice, a first rule to beat.
    fn dive(&mut self, on: &Bits, off: &Bits, open: &[Literal]) {
        let (mut on, mut off, mut open) = (on.clone(), off.clone(), open.to_vec());
        loop {
            let steps = self.steps(&on, &off, &open);
            let pure = steps.iter().filter(|step| step.met == 0);
            if let Some(step) = pure.copied().max_by_key(|step| step.kept) {
                self.complete(step);
                break;
            }
            let (rows, others) = (on.count(), off.count());
            let gain = |step: &&Step| (others - step.met) * (1 << 16) / (1 + rows - step.kept);
            let Some(step) = steps.iter().max_by_key(gain).copied() else {
                break;
            };
            on = self.table.inside(&on, step.literal);
            off = self.table.meeting(&off, step.literal);
            self.chosen.push(step.literal);
            open = steps.iter().map(|step| step.literal).collect();
        }
        self.chosen.clear();
    }

    /// Every rule that may be worth more than the best, within the work.
    fn extend(&mut self, on: &Bits, off: &Bits, open: &[Literal]) {
        let mut steps = self.steps(on, off, open);
        for step in &steps {
            if step.met == 0 {
                self.complete(*step);
            }
        }
        let others = off.count();
        // Those that keep most for what they leave are tried first, and none before it is tried with it again.
        steps.retain(|step| step.met > 0);
        let excludes = steps.iter().map(|step| others - step.met).max();
        let excludes = excludes.unwrap_or(0).max(1);
        let literals = self.chosen.len() + 1;
        steps.retain(|step| {
            self.worth(step.kept, literals + step.met.div_ceil(excludes)) > self.best
        });
        steps.sort_by_cached_key(|step| {
            let ratio = (step.kept << 16) / (1 + step.met);
            (std::cmp::Reverse(ratio), step.literal)
        });
        for at in 0..steps.len() {
            let Some(step) = steps.get(at).copied() else {
                return;
            };
            let more = step.met.div_ceil(excludes);
            if self.left == 0 {
                return;
            }
            if self.worth(step.kept, literals + more) <= self.best {
                continue;
            }
            let rest = steps.iter().skip(at + 1).map(|step| step.literal);
            let rest: Vec<Literal> = rest.collect();
            let on = self.table.inside(on, step.literal);
            let off = self.table.meeting(off, step.literal);
            self.chosen.push(step.literal);
            self.extend(&on, &off, &rest);
            self.chosen.pop();
        }
    }
}
