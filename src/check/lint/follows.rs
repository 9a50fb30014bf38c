//! Warnings that follow from a slip of the pen: what reads `a - a` is constant, and that is told of `a - a` alone.

use super::conditions::Places;
use super::mentions::Mentions;
use crate::check::Checker;
use crate::diagnostic::{Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Item, ItemKind};
use std::collections::{BTreeMap, BTreeSet};

impl<'a> Checker<'a> {
    /// Takes back the warnings of conditions and states that hang on something with a slip in it.
    pub fn without_what_follows(&mut self, items: impl Iterator<Item = &'a Item>) {
        let is_slip =
            |found: &&Diagnostic| matches!(found.code, Code::W0102 | Code::W0303 | Code::W0308);
        let mut slips = Places::default();
        let found = self.diagnostics.iter().filter(is_slip);
        found.for_each(|slip| slips.add(slip.span()));
        if slips.is_empty() {
            return;
        }
        let items = items.filter(|item| {
            !matches!(
                item.kind,
                ItemKind::World(_) | ItemKind::Task(_) | ItemKind::Tree(_)
            )
        });
        let mut all: Vec<(Span, BTreeSet<&str>)> = Vec::new();
        let mut readers: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
        let mut open: Vec<&str> = Vec::new();
        for item in items {
            let mut mentions = Mentions::default();
            mentions.item(item);
            mentions.set.extend(own_name(item));
            if slips.overlap(item.span) {
                open.extend(&mentions.set);
            }
            // That a state never changes is told of its declaration.
            if let ItemKind::State(state) = &item.kind {
                mentions.read.insert(&state.name.name);
            }
            for name in mentions.read {
                readers.entry(name).or_default().push(all.len());
            }
            all.push((item.span, mentions.set));
        }
        let mut follow = Places::default();
        while let Some(name) = open.pop() {
            for at in readers.remove(name).unwrap_or_default() {
                if let Some((span, set)) = all.get(at) {
                    follow.add(*span);
                    open.extend(set);
                }
            }
        }
        self.diagnostics.retain(|found| {
            let derived = matches!(found.code, Code::W0205 | Code::W0601);
            !derived || !follow.overlap(found.span())
        });
    }
}

/// The name that an item gives to a value.
fn own_name(item: &Item) -> Option<&str> {
    match &item.kind {
        ItemKind::State(it) => Some(&it.name.name),
        ItemKind::Event(it) => Some(&it.name.name),
        ItemKind::Let(it) => Some(&it.name.name),
        ItemKind::Predicate(it) => Some(&it.name.name),
        ItemKind::Behavior(it) => Some(&it.name.name),
        _ => None,
    }
}
