//! What expressions read, by themselves and through what they name.

use super::mentions::Mentions;
use crate::check::Checker;
use crate::check::names::Decl;
use crate::syntax::ast::{Expr, LetBody, Ref};
use std::collections::BTreeSet;

impl<'a> Checker<'a> {
    /// The states and places that an expression reads.
    pub fn read_by(&self, value: &'a Expr) -> BTreeSet<&'a str> {
        let mut mentions = Mentions::default();
        mentions.expr(value);
        self.reached(mentions)
    }

    /// The states and places that a reference and what it names read.
    pub fn read_of(&self, reference: &'a Ref) -> BTreeSet<&'a str> {
        let mut mentions = Mentions::default();
        mentions.reference(reference);
        self.reached(mentions)
    }

    fn reached(&self, mut mentions: Mentions<'a>) -> BTreeSet<&'a str> {
        let mut read = BTreeSet::new();
        let mut open: Vec<&'a str> = mentions.read.iter().copied().collect();
        while let Some(name) = open.pop() {
            let mut within = Mentions::default();
            match self.names.value(name, false) {
                Some((Decl::State(_) | Decl::Place(..), _)) => {
                    read.insert(name);
                }
                Some((Decl::Predicate(predicate), _)) => {
                    predicate.value.iter().for_each(|when| within.expr(when));
                }
                Some((Decl::Let(shared), _)) => match &shared.body {
                    LetBody::Expr(value) => within.expr(value),
                    LetBody::Yield(body) => within.yielded(body),
                },
                _ => {}
            }
            let further = within.read.into_iter();
            open.extend(further.filter(|name| mentions.read.insert(name)));
            mentions.ranged.extend(within.ranged);
        }
        // What goes through a kind reads each of its places.
        if !mentions.ranged.is_empty() {
            let goes_through = |kind: &str| mentions.ranged.contains(kind);
            read.extend(self.names.values(|decl| match decl {
                Decl::Place(_, kind) => {
                    goes_through("place") || kind.is_some_and(|kind| goes_through(&kind.name))
                }
                _ => false,
            }));
        }
        read
    }
}
