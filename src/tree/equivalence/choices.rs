//! What a table decides, looked up by minterm or cube.

use super::environment::TableCube;
use crate::ir::Id;
use crate::ir::law::Behavior;
use crate::policy::Policy;
use rustc_hash::FxHashMap;
use std::collections::BTreeMap;

/// The rows of a table by their free atoms: rows with the same free atoms differ in the others.
pub(super) struct Choices<'a> {
    rows: BTreeMap<&'a [u64], FxHashMap<&'a [u64], Id<Behavior>>>,
}

impl<'a> Choices<'a> {
    pub(super) fn new(policy: &'a Policy) -> Self {
        let mut rows: BTreeMap<&[u64], FxHashMap<&[u64], Id<Behavior>>> = BTreeMap::new();
        for row in &policy.rows {
            let free = row.free.as_ref().map_or(&[][..], |free| free.words());
            let alike = rows.entry(free).or_default();
            alike.insert(row.minterm.words(), row.behavior);
        }
        Self { rows }
    }

    /// What a row decides that holds wherever the minterm or cube does.
    pub(super) fn choice(&self, cube: &TableCube) -> Option<Id<Behavior>> {
        let free = cube.free.map_or(&[][..], |free| free.words());
        let words = cube.minterm.words();
        let covers = |wider: &&[u64]| {
            let mut pairs = free.iter().enumerate();
            pairs.all(|(i, free)| free & !wider.get(i).copied().unwrap_or(0) == 0)
        };
        let rows = self.rows.iter().filter(|(wider, _)| covers(wider));
        rows.filter_map(|(wider, rows)| match wider.is_empty() {
            true => rows.get(words),
            false => {
                let kept = words.iter().zip(*wider).map(|(word, free)| word & !free);
                rows.get(&*kept.collect::<Vec<u64>>())
            }
        })
        .next()
        .copied()
    }
}
