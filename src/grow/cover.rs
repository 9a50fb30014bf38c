//! Trees that decide as another does where it matters: in the minterms that cost most where a smaller tree decides
//! otherwise, found by playing that smaller tree.

use super::field::Field;
use super::ground::Ground;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::ir::tree::Node;
use crate::learn::process::{Key, World};
use crate::policy::{Minterm, Policy, Row};
use crate::tree::decanonicalise::{Options, Order, allowing, decanonicalise};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// The effort of the search for one of many trees.
const EFFORT: u64 = 1;

/// The orders of units: in the others a tree is larger, but goes on otherwise where nothing was decided.
const ORDERS: [Order; 3] = [Order::Learned, Order::Rarest, Order::Given];

/// Trees for these decisions alone, the smallest that is found first; none without any. Their rules stand one after another
/// where they can, so that a change in one of them does not reach the others.
pub fn trees<W: World>(ground: &Ground<W>, kept: &FxHashMap<Key, usize>) -> Vec<Node> {
    let rows = kept.iter();
    let rows = rows.filter_map(|(key, choice)| row(ground, *key, *choice));
    let mut rows: Vec<Row> = rows.collect();
    rows.sort_by(|a, b| a.minterm.cmp(&b.minterm));
    let policy = policy(ground, rows);
    let in_order = |order: Order| {
        let options = Options {
            effort: EFFORT,
            order,
            tight: false,
            ..Options::default()
        };
        let found = decanonicalise(&policy, &options).ok()?;
        Some(found.root)
    };
    ORDERS.into_par_iter().filter_map(in_order).collect()
}

/// A tree that decides in every minterm as `wanted` does, or otherwise where that costs at most `slack` an episode, as far as the
/// counts tell.
pub fn permitting<W: World>(
    ground: &Ground<W>,
    field: &Field,
    wanted: &Node,
    slack: f64,
) -> Option<Node> {
    let mut rows: Vec<(Row, Vec<Id<Behavior>>)> = Vec::new();
    for (spot, drive) in field.spots.iter().zip(field.drives(wanted)?) {
        let choices = spot.permitted(drive, slack);
        let own = drive.choice.filter(|own| choices.contains(own));
        let Some(own) = own.or(choices.first().copied()) else {
            continue;
        };
        if let Some(row) = row(ground, spot.key, own)
            && choices.len() < ground.choices.len()
        {
            let choices = choices.iter();
            let choices = choices.filter_map(|choice| ground.choices.get(*choice).copied());
            rows.push((row, choices.collect()));
        }
    }
    rows.sort_by(|a, b| a.0.minterm.cmp(&b.0.minterm));
    let (rows, allowed): (Vec<Row>, Vec<_>) = rows.into_iter().unzip();
    let options = Options {
        effort: EFFORT,
        tight: false,
        ..Options::default()
    };
    let (_, found) = allowing(&policy(ground, rows), &allowed, &options).ok()?;
    Some(found.root)
}

fn row<W: World>(ground: &Ground<W>, key: Key, choice: usize) -> Option<Row> {
    Some(Row {
        minterm: Minterm::of_key(key, ground.observed),
        free: None,
        behavior: *ground.choices.get(choice)?,
        visits: 1,
        values: vec![None; ground.choices.len()],
    })
}

fn policy<W: World>(ground: &Ground<W>, rows: Vec<Row>) -> Policy {
    Policy {
        atoms: ground.atoms().to_vec(),
        behaviors: ground.choices.to_vec(),
        history: ground.history,
        rows,
        ..Policy::default()
    }
}

/// The decisions of `wanted` that are worth most against what a tree does, at most so many: by key, with the choice.
pub fn missed(field: &Field, tree: &Node, wanted: &Node, most: usize) -> Vec<(Key, usize)> {
    let (Some(drives), Some(aims)) = (field.drives(tree), field.drives(wanted)) else {
        return Vec::new();
    };
    let spots = field.spots.iter().zip(drives.iter().zip(&aims));
    let mut missed: Vec<(Key, usize, f64)> = spots
        .filter_map(|(spot, (drive, aim))| {
            let choice = aim.choice?;
            let loss = spot.weight * (spot.worth(*aim) - spot.worth(*drive));
            (drive.choice != aim.choice && loss > 0.0).then_some((spot.key, choice, loss))
        })
        .collect();
    missed.sort_by(|a, b| b.2.total_cmp(&a.2).then(a.0.cmp(&b.0)));
    missed.truncate(most);
    let missed = missed.into_iter();
    missed.map(|(key, choice, _)| (key, choice)).collect()
}
