//! Planted lists with groups in groups that return to a behaviour: trees are no larger than what was planted.

use super::falls::Falls;
use super::scale::{searched, table};
use crate::laws::random::Random;
use btc::logic::Order;
use btc::policy::{Minterm, Policy};
use btc::tree::decanonicalise::Options;

/// A selector: of the units whose predicates fall so the first decides, else the behaviour that stands last.
struct Group {
    units: Vec<(Vec<(usize, bool)>, Body)>,
    last: usize,
}

/// What stands in a unit.
enum Body {
    Behavior(usize),
    Group(Group),
}

impl Group {
    fn drawn(
        random: &mut Random,
        atoms: usize,
        depth: usize,
        units: usize,
        above: &mut Vec<usize>,
    ) -> Self {
        let mut unit = |at: usize, random: &mut Random| {
            let nested = depth > 0 && random.chance(50);
            let literals = 1 + usize::from(!nested && at < 2) + random.below(2);
            let mut cube: Vec<(usize, bool)> = Vec::new();
            while cube.len() < literals {
                let atom = random.below(atoms);
                let known = cube.iter().any(|(known, _)| *known == atom);
                if !known && !above.contains(&atom) {
                    cube.push((atom, random.chance(50)));
                }
            }
            if !nested {
                return (cube, Body::Behavior(random.below(3)));
            }
            let length = above.len();
            above.extend(cube.iter().map(|(atom, _)| *atom));
            let units = 2 + random.below(2);
            let group = Self::drawn(random, atoms, depth - 1, units, above);
            above.truncate(length);
            (cube, Body::Group(group))
        };
        let units = (0..units).map(|at| unit(at, random)).collect();
        let last = random.below(3);
        Self { units, last }
    }

    fn decides(&self, values: &[bool]) -> usize {
        let holds =
            |cube: &[(usize, bool)]| cube.iter().all(|(atom, value)| values[*atom] == *value);
        match self.units.iter().find(|(cube, _)| holds(cube)) {
            Some((_, Body::Behavior(behavior))) => *behavior,
            Some((_, Body::Group(group))) => group.decides(values),
            None => self.last,
        }
    }

    fn nodes(&self) -> usize {
        let units = self.units.iter().map(|(cube, body)| {
            let body = match body {
                Body::Behavior(_) => 1,
                Body::Group(group) => group.nodes(),
            };
            1 + cube.len() + body
        });
        2 + units.sum::<usize>()
    }
}

/// The table of a number, with the nodes that were planted in it, and what it is like.
fn planted(number: u64) -> (Policy, usize, String) {
    let of = |choices: [usize; 3], by: u64| choices[(number / by) as usize % 3];
    let (atoms, rows) = (of([24, 64, 128], 1), of([300, 1000, 10_000], 3));
    let units = of([3, 4, 5], 9);
    let falls = [Falls::Evenly, Falls::Skewed, Falls::Together][(number / 27) as usize % 3];
    let depth = 1 + (number as usize / 2) % 2;
    let random = &mut Random::new(number + 7_000_000);
    let group = Group::drawn(random, atoms, depth, units, &mut Vec::new());
    let all = falls.rows(random, atoms, rows).into_iter().map(|values| {
        let does = group.decides(&values);
        (Minterm::new(values), does)
    });
    let policy = table(atoms, 3, all);
    let name = format!("{number}: {atoms} × {rows}, {units} units, {depth} deep, {falls:?}");
    (policy, group.nodes(), name)
}

/// The tables with these numbers whose trees are larger than what was planted in them.
fn larger(numbers: impl Iterator<Item = u64>) -> Vec<String> {
    let told = numbers.filter_map(|number| {
        let (policy, planted, name) = planted(number);
        let nodes = searched(&policy, Order::Learned, Options::default().effort)
            .size
            .nodes;
        println!("{name}: {nodes} nodes, {planted} planted");
        (nodes > planted).then(|| format!("{name}: {nodes} nodes, {planted} planted"))
    });
    told.collect()
}

#[test]
fn groups_in_groups_are_found() {
    let larger = larger([13, 16, 22, 26].into_iter());
    assert!(larger.is_empty(), "{larger:?}");
}

/// `cargo test --release --test it -- --ignored --nocapture two_hundred_groups`
#[test]
#[ignore = "minutes"]
fn two_hundred_groups_in_groups() {
    let larger = larger(0..200);
    println!(
        "{} of 200 are larger than planted: {larger:#?}",
        larger.len()
    );
    assert!(larger.len() <= 4);
}
