//! Tests that set predicates as no world has them.

use super::cases::of_guard;
use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::Id;
use crate::ir::program::Predicate;
use crate::ir::test::Test;
use crate::ir::tree::{Atom, Guard};
use crate::syntax::ast::{Item, ItemKind, TestLineKind};
use std::collections::BTreeMap;

/// The most predicates of a test that are held against each other.
const MOST: usize = 32;

impl<'a> Checker<'a> {
    /// Warns of lines of a test in which two predicates exclude each other.
    pub fn tests_of_nowhere(&mut self, items: impl Iterator<Item = &'a Item>) {
        let tests = items.filter_map(|item| match &item.kind {
            ItemKind::Test(test) => Some(test),
            _ => None,
        });
        let checked = self.program.tests.clone();
        let checked: BTreeMap<&str, &Test> = (checked.iter())
            .map(|test| (test.title.as_str(), test))
            .collect();
        for test in tests {
            let built = checked.get(test.title.name.as_str());
            let Some(built) = built.filter(|it| it.lines.len() == test.lines.len()) else {
                continue;
            };
            let mut holds: BTreeMap<Id<Predicate>, bool> = BTreeMap::new();
            for (line, written) in built.lines.iter().zip(&test.lines) {
                holds.extend(line.changes.iter().copied());
                let (TestLineKind::Given(changes) | TestLineKind::Tick { changes, .. }) =
                    &written.kind
                else {
                    continue;
                };
                let mut set = line.changes.iter().zip(changes);
                let found = set.find_map(|(change, at)| {
                    Some((at.span, *change, self.excluded_by(*change, &holds)?))
                });
                let Some((at, change, other)) = found else {
                    continue;
                };
                let said = |(id, holds): (Id<Predicate>, bool)| {
                    let name = &self.program.predicates[id].name;
                    match holds {
                        true => format!("`{name}`"),
                        false => format!("`not {name}`"),
                    }
                };
                let message = format!("{} and {} never hold at once", said(change), said(other));
                let before = !line.changes.contains(&other);
                let help = format!(
                    "what was set before holds on: set {} as well",
                    said((other.0, !other.1))
                );
                self.warning(Code::W0601, at, message)
                    .label("no world is ever so")
                    .help_if(before.then_some(help));
                break;
            }
        }
    }

    /// The first of these that a predicate with a value excludes.
    fn excluded_by(
        &self,
        (id, value): (Id<Predicate>, bool),
        holds: &BTreeMap<Id<Predicate>, bool>,
    ) -> Option<(Id<Predicate>, bool)> {
        let cases = |(id, value): (Id<Predicate>, bool)| {
            of_guard(&self.program, &Guard::Atom(Atom::Predicate(id)), value)
        };
        let own = cases((id, value));
        let mut others = holds.iter().map(|(id, value)| (*id, *value)).take(MOST);
        others.find(|other| {
            let theirs = cases(*other);
            other.0 != id && !own.is_never() && !theirs.is_never() && own.and(&theirs).is_never()
        })
    }
}
