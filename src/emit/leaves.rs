//! What a tree asks of a robot and has it do, as other languages call it: `goto(A)` is `goto` with an argument.
//!
//! Conditions and actions share one space of identifiers. Every name of the program has its own, whichever tree is
//! written, so that a robot needs each of them once.

mod call;

pub(super) use call::unquoted;

use crate::ir::law::Behavior;
use crate::ir::tree::{Atom, Node};
use crate::ir::{Id, Program};
use call::{Argument, Call, argument};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};

/// What a leaf asks or does.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Subject {
    /// Asks whether an atom holds.
    Condition(Atom),
    /// Does a behaviour.
    Action(Id<Behavior>),
}

impl Subject {
    /// As the language writes it.
    pub fn name(self, program: &Program) -> String {
        match self {
            Subject::Condition(atom) => program.atom_name(atom),
            Subject::Action(id) => program.behaviors[id].name.clone(),
        }
    }

    /// The name of its family, as the language writes it.
    pub fn family(self, program: &Program) -> String {
        self.call(program).family
    }

    /// What is called, with which arguments.
    fn call(self, program: &Program) -> Call {
        let history = |family: &str, id: Id<Behavior>| Call {
            family: family.to_owned(),
            arguments: vec![Argument {
                parameter: Some("behavior".to_owned()),
                value: argument(&program.behaviors[id].name).to_owned(),
            }],
        };
        match self {
            Subject::Condition(Atom::Done(id)) => history(HISTORY[0], id),
            Subject::Condition(Atom::Failed(id)) => history(HISTORY[1], id),
            Subject::Condition(Atom::Predicate(id)) => Call::of(&program.predicates[id].name),
            Subject::Action(id) => Call::of(&program.behaviors[id].name),
        }
    }
}

/// The conditions that ask the history window.
const HISTORY: [&str; 2] = ["done", "failed"];

/// A family of conditions or of actions: what a robot has to provide once.
#[derive(Clone, Debug)]
pub(super) struct Family {
    /// Its identifier.
    pub id: String,
    /// Whether the identifier is its name in the language.
    pub same: bool,
    /// Its parameters.
    pub parameters: Vec<Parameter>,
    /// The leaves of the tree that are of it, in order.
    pub subjects: Vec<Subject>,
}

/// A parameter of a family.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    /// Its identifier.
    pub id: String,
    /// As the language calls it.
    name: String,
    /// Whether some leaf of the tree leaves it out.
    pub optional: bool,
}

/// The leaves of a tree.
#[derive(Clone, Debug)]
pub(super) struct Leaves {
    /// The families in the order of the program: predicates, `done`, `failed`, behaviours.
    pub families: Vec<Family>,
    /// Each leaf with its family and the values of the family's parameters.
    calls: BTreeMap<Subject, (usize, Vec<Option<String>>)>,
}

impl Leaves {
    /// The leaves of a tree, in identifiers of `words`.
    pub fn of(root: &Node, program: &Program, words: &mut Words) -> Self {
        let mut subjects = BTreeSet::new();
        root.visit_atoms(&mut |atom| {
            subjects.insert(Subject::Condition(atom));
        });
        root.visit_behaviors(&mut |id| {
            subjects.insert(Subject::Action(id));
        });
        let ids = words.of_program(program);
        let mut families: Vec<Family> = Vec::new();
        let mut known: BTreeMap<Key, usize> = BTreeMap::new();
        let mut placed = Vec::new();
        for subject in subjects {
            let mut call = subject.call(program);
            call.complete(program.parameters.get(&call.family));
            let key = Key::new(subject, &call);
            let at = *known.entry(key.clone()).or_insert_with(|| {
                let id = ids.get(&key).cloned().unwrap_or_default();
                families.push(Family {
                    same: id == call.family,
                    id,
                    parameters: Vec::new(),
                    subjects: Vec::new(),
                });
                families.len() - 1
            });
            if let Some(family) = families.get_mut(at) {
                family.subjects.push(subject);
                family.takes(&call, words, program.parameters.get(&call.family));
            }
            placed.push((subject, at, call));
        }
        let mut calls = BTreeMap::new();
        for (subject, at, call) in placed {
            let Some(family) = families.get_mut(at) else {
                continue;
            };
            let mut values = Vec::new();
            for parameter in &mut family.parameters {
                let value = call.value(&parameter.name).map(str::to_owned);
                parameter.optional |= value.is_none();
                values.push(value);
            }
            calls.insert(subject, (at, values));
        }
        Self { families, calls }
    }

    /// The family of a leaf with the parameters that it gives and their values.
    pub fn call(&self, subject: Subject) -> Option<(&Family, Vec<(&Parameter, &str)>)> {
        let (at, values) = self.calls.get(&subject)?;
        let family = self.families.get(*at)?;
        let given = family.parameters.iter().zip(values);
        let given = given.filter_map(|(parameter, value)| Some((parameter, value.as_deref()?)));
        Some((family, given.collect()))
    }
}

impl Family {
    /// Adds the parameters that a call gives, in the order in which they are declared.
    fn takes(&mut self, call: &Call, words: &Words, declared: Option<&Vec<String>>) {
        for name in call.arguments.iter().filter_map(|a| a.parameter.as_ref()) {
            if self.parameters.iter().any(|known| known.name == *name) {
                continue;
            }
            let mut taken = self.parameters.iter().map(|p| p.id.clone()).collect();
            self.parameters.push(Parameter {
                id: words.free(name, &mut taken),
                name: name.clone(),
                optional: false,
            });
        }
        let place = |parameter: &Parameter| {
            declared.and_then(|names| names.iter().position(|name| *name == parameter.name))
        };
        self.parameters.sort_by_key(place);
    }
}

/// A condition or an action, by the name of its family.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key(bool, String);

impl Key {
    fn new(subject: Subject, call: &Call) -> Self {
        Self(matches!(subject, Subject::Action(_)), call.family.clone())
    }
}

/// The identifiers of a language: a letter of ASCII, then letters, digits and `_`, less its own words.
#[derive(Clone, Debug)]
pub(super) struct Words {
    /// The language's own.
    reserved: &'static [&'static str],
    taken: BTreeSet<String>,
}

impl Words {
    /// Identifiers of a language that keeps these words to itself.
    pub fn new(reserved: &'static [&'static str]) -> Self {
        Self {
            reserved,
            taken: BTreeSet::new(),
        }
    }

    /// An identifier that nothing else has.
    pub fn new_id(&mut self, name: &str) -> String {
        let mut taken = std::mem::take(&mut self.taken);
        let id = self.free(name, &mut taken);
        self.taken = taken;
        id
    }

    /// An identifier for every family of the program. Names that are identifiers keep themselves, so they come first.
    fn of_program(&mut self, program: &Program) -> BTreeMap<Key, String> {
        let history = HISTORY.map(|family| Key(false, family.to_owned()));
        let predicates = program.predicates.values();
        let predicates = predicates.map(|predicate| Key(false, Call::of(&predicate.name).family));
        let behaviors = program.behaviors.values();
        let behaviors = behaviors.map(|behavior| Key(true, Call::of(&behavior.name).family));
        let keys: Vec<Key> = history
            .into_iter()
            .chain(predicates)
            .chain(behaviors)
            .collect();
        let (legal, others): (Vec<Key>, Vec<Key>) =
            keys.into_iter().partition(|key| self.legal(&key.1));
        let mut ids = BTreeMap::new();
        for key in legal.into_iter().chain(others) {
            if let Entry::Vacant(place) = ids.entry(key) {
                let id = self.new_id(&place.key().1);
                place.insert(id);
            }
        }
        ids
    }

    /// An identifier near to `name` that is not among `taken`, and joins them.
    fn free(&self, name: &str, taken: &mut BTreeSet<String>) -> String {
        let text = unquoted(name);
        let parts = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
        let parts: Vec<&str> = parts.filter(|part| !part.is_empty()).collect();
        let mut id = parts.join("_").trim_start_matches('_').to_owned();
        if !id.starts_with(|c: char| c.is_ascii_alphabetic()) {
            id.insert(0, 'x');
        }
        if self.is_reserved(&id) {
            id.push('_');
        }
        let mut free = id.clone();
        let mut number = 2;
        while !taken.insert(free.clone()) {
            free = format!("{id}_{number}");
            number += 1;
        }
        free
    }

    fn legal(&self, name: &str) -> bool {
        name.starts_with(|c: char| c.is_ascii_alphabetic())
            && name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
            && !self.is_reserved(name)
    }

    fn is_reserved(&self, name: &str) -> bool {
        self.reserved.contains(&name)
    }
}
