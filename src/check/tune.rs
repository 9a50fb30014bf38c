//! The numbers that may be tuned, with the places where they stand.

use super::Checker;
use crate::diagnostic::Code;
use crate::ir::tunable::Tunable;
use crate::source::Span;
use crate::spelling::spelled;
use crate::syntax::ast::{Ident, Item, ItemKind};
use std::collections::BTreeMap;

/// How many numbers of a program may be tuned.
const MOST: usize = 16;

/// What makes a number the same number wherever it is met.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Key {
    /// Where its value stands.
    At(Span),
    /// It is an argument: of what, for which parameter, and how it is spelled. What is spelled alike is one instance.
    Argument(String, String, String),
}

/// A number that may be tuned.
#[derive(Clone, Debug)]
struct Tune {
    key: Key,
    /// Where its value stands.
    sites: Vec<Span>,
    tunable: Tunable,
}

/// The numbers that may be tuned, in the order in which they are first met.
#[derive(Clone, Debug, Default)]
pub struct Tunes {
    met: Vec<Tune>,
    /// Values other than those in the text, in their units, by where these stand.
    tuned: BTreeMap<Span, f64>,
}

impl Tunes {
    /// Takes these values instead of those in the text.
    pub fn set(&mut self, tuned: BTreeMap<Span, f64>) {
        self.tuned = tuned;
    }

    /// Notes a number, and gives the one that is to be taken instead of it, if any, in SI base units.
    pub fn meet(&mut self, key: Key, site: Span, tunable: Tunable) -> Option<f64> {
        let other = self.tuned.get(&site).map(|value| tunable.unit.si(*value));
        match self.met.iter_mut().find(|tune| tune.key == key) {
            Some(tune) if tune.sites.contains(&site) => {}
            Some(tune) => tune.sites.push(site),
            None => self.met.push(Tune {
                key,
                sites: vec![site],
                tunable,
            }),
        }
        other
    }

    /// The places of the values, a list for each number.
    pub fn sites(self) -> Vec<Vec<Span>> {
        self.met.into_iter().map(|tune| tune.sites).collect()
    }
}

impl<'a> Checker<'a> {
    /// Puts the numbers that were met into the program, in the order of the text, each with a name.
    pub fn tunables(&mut self, items: impl Iterator<Item = &'a Item> + Clone) {
        let met = &mut self.tunes.met;
        met.iter_mut().for_each(|tune| tune.sites.sort());
        met.sort_by(|a, b| a.sites.cmp(&b.sites));
        let mut names: Vec<String> = Vec::new();
        for tune in met.iter() {
            let name = match &tune.key {
                Key::Argument(of, parameter, _) => format!("{parameter} of {}", spelled(of)),
                Key::At(site) => {
                    let item = items.clone().find(|item| contains(item.span, *site));
                    let name = item.and_then(|item| named(&item.kind));
                    name.map_or("the program".to_owned(), |name| {
                        spelled(&name.name).into_owned()
                    })
                }
            };
            names.push(name);
        }
        for (at, (tune, name)) in met.iter().zip(&names).enumerate() {
            let same = |names: &[String]| names.iter().filter(|other| *other == name).count();
            let number = same(names.get(..=at).unwrap_or_default());
            let name = match same(&names) {
                1 => name.clone(),
                _ => format!("{name} ({number})"),
            };
            let tunable = Tunable {
                name,
                ..tune.tunable.clone()
            };
            self.program.tunables.push(tunable);
        }
        if let Some(tune) = met.get(MOST)
            && let Some(site) = tune.sites.first().copied()
        {
            let message = format!("a program has at most {MOST} numbers to tune");
            self.error(Code::E0309, site, message)
                .label("one too many")
                .help("let those be constants that matter least");
        }
    }
}

fn contains(item: Span, site: Span) -> bool {
    item.file == site.file && item.start <= site.start && site.end <= item.end
}

fn named(item: &ItemKind) -> Option<&Ident> {
    match item {
        ItemKind::Let(item) => Some(&item.name),
        ItemKind::Predicate(item) => Some(&item.name),
        ItemKind::Behavior(item) => Some(&item.name),
        ItemKind::Tree(item) => Some(&item.name),
        _ => None,
    }
}
