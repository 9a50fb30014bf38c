//! Behaviours in a row, for where nothing is earned.
//!
//! Where no episode returns more than another, counts and races of single changes have nothing to go by: what pays takes
//! several behaviours in their order. Rows of behaviours that are drawn at random come upon that order at times, and a tree that
//! earns something at times is one that changes improve.

use super::Grower;
use crate::ir::tree::{Composite, Node};
use crate::learn::process::World;
use crate::tree::unit::memory;

/// How many rows are drawn of each length, and how long they are.
const OF_EACH: usize = 24;
const LONG: [usize; 4] = [2, 3, 4, 5];

impl<W: World> Grower<'_, '_, '_, W> {
    /// Memory sequences of behaviours drawn at random, none of which stands twice side by side.
    pub(super) fn rows(&mut self) -> Vec<Node> {
        let choices = self.ground.choices;
        let mut rows: Vec<Node> = Vec::new();
        for length in LONG {
            for _ in 0..OF_EACH {
                let mut children: Vec<Node> = Vec::new();
                for _ in 0..length {
                    let at = self.random.below(choices.len() as u64) as usize;
                    let drawn = choices.get(at).map(|id| Node::Behavior(*id));
                    children.extend(drawn.filter(|it| children.last() != Some(it)));
                }
                let row = memory(Composite::Sequence, children);
                if row.children().len() > 1 && !rows.contains(&row) {
                    rows.push(row);
                }
            }
        }
        rows
    }
}
