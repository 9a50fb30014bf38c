//! What a tree asks of a robot and has it do, as other languages call it: `goto(A)` is `goto` with an argument.
//!
//! Conditions and actions share one space of identifiers. Every name of the program has its own, whichever tree is
//! written, so that a robot needs each of them once.

use crate::ir::law::Behavior;
use crate::ir::name::{Given, Name};
use crate::ir::tree::{Atom, Node, Tree};
use crate::ir::{Id, Program};
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
    /// Whether it names a behaviour, and the number of the predicate or behaviour that it names.
    fn named(self) -> (bool, usize) {
        match self {
            Subject::Condition(Atom::Predicate(id)) => (false, id.index()),
            Subject::Condition(Atom::Done(id) | Atom::Failed(id)) | Subject::Action(id) => {
                (true, id.index())
            }
        }
    }

    /// Predicates come first, then `done`, `failed`, and actions.
    fn kind(self) -> u8 {
        match self {
            Subject::Condition(Atom::Predicate(_)) => 0,
            Subject::Condition(Atom::Done(_)) => 1,
            Subject::Condition(Atom::Failed(_)) => 2,
            Subject::Action(_) => 3,
        }
    }

    /// Whether it asks the history.
    pub fn asks_history(self) -> bool {
        matches!(self, Subject::Condition(atom) if atom.termination().is_some())
    }

    /// Its name.
    pub fn name(self, program: &Program) -> Name {
        match self {
            Subject::Condition(atom) => program.atom_name(atom),
            Subject::Action(id) => program.behaviors[id].name.clone(),
        }
    }
}

/// The conditions that ask the history window.
const HISTORY: [&str; 2] = [Atom::DONE, Atom::FAILED];

/// A family of conditions or of actions: what a robot has to provide once.
#[derive(Clone, Debug)]
pub(super) struct Family {
    /// Its identifier.
    pub id: String,
    /// Its name in the language, without backquotes.
    pub name: String,
    /// The parameters that some leaf of the tree gives a value, as declared.
    pub parameters: Vec<Parameter>,
    /// The leaves of the tree that are of it, in order.
    pub subjects: Vec<Subject>,
}

impl Family {
    /// Whether it is one of behaviours.
    pub fn is_action(&self) -> bool {
        matches!(self.subjects.first(), Some(Subject::Action(_)))
    }

    /// Whether it asks the history.
    pub fn is_history(&self) -> bool {
        self.subjects
            .first()
            .is_some_and(|subject| subject.asks_history())
    }
}

/// A parameter of a family.
#[derive(Clone, Debug)]
pub(super) struct Parameter {
    /// Its identifier.
    pub id: String,
    /// Whether some leaf of the tree leaves it out.
    pub optional: bool,
}

/// The leaves of a tree.
#[derive(Clone, Debug)]
pub(super) struct Leaves {
    /// The families: predicates, `done`, `failed`, behaviours, each in the order of the program, or of a tree that is for
    /// no task.
    pub families: Vec<Family>,
    /// Whether the tree asks the history.
    pub ask_history: bool,
    /// Each leaf with its family and the values of the family's parameters.
    calls: BTreeMap<Subject, (usize, Vec<Option<String>>)>,
}

impl Leaves {
    /// The leaves of a tree of a program that is [`called`](super::calls::called), in identifiers of `words`.
    pub fn of(tree: &Tree, program: &Program, words: &mut Words) -> Self {
        let mut subjects = Vec::new();
        mentions(&tree.root, &mut subjects);
        let mut places = BTreeMap::new();
        for (at, subject) in subjects.iter().enumerate() {
            let (behavior, number) = subject.named();
            let place = if tree.task.is_some() { number } else { at };
            places.entry((behavior, number)).or_insert(place);
        }
        subjects.sort_by_key(|subject| (subject.kind(), places.get(&subject.named())));
        subjects.dedup();
        let ask_history = subjects.iter().any(|subject| subject.asks_history());
        let mut grouped: Vec<(Key, Vec<Subject>)> = Vec::new();
        for subject in subjects {
            let key = Key::new(subject, program);
            match grouped.iter_mut().find(|(known, _)| *known == key) {
                Some((_, of_family)) => of_family.push(subject),
                None => grouped.push((key, vec![subject])),
            }
        }
        let ids = words.of_program(program);
        let mut leaves = Self {
            families: Vec::new(),
            ask_history,
            calls: BTreeMap::new(),
        };
        for (key, subjects) in grouped {
            let id = ids.get(&key).cloned().unwrap_or_default();
            leaves.family(id, key.1, subjects, program, words);
        }
        leaves
    }

    /// Adds a family with its leaves.
    fn family(
        &mut self,
        id: String,
        name: String,
        subjects: Vec<Subject>,
        program: &Program,
        words: &Words,
    ) {
        let names: Vec<Name> = subjects.iter().map(|s| s.name(program)).collect();
        let declared = names.iter().map(|name| name.arguments.len()).max();
        let given: Vec<usize> = (0..declared.unwrap_or(0))
            .filter(|at| names.iter().any(|name| value(name, *at).is_some()))
            .collect();
        let mut taken = BTreeSet::new();
        let parameters = given.iter().filter_map(|at| {
            let declared = names.iter().find_map(|name| name.arguments.get(*at))?;
            Some(Parameter {
                id: words.free(&declared.parameter, &mut taken),
                optional: names.iter().any(|name| value(name, *at).is_none()),
            })
        });
        let parameters = parameters.collect();
        for (subject, name) in subjects.iter().zip(&names) {
            let values = given.iter().map(|at| value(name, *at).map(argument));
            let values = values.collect();
            self.calls.insert(*subject, (self.families.len(), values));
        }
        self.families.push(Family {
            id,
            name,
            parameters,
            subjects,
        });
    }

    /// The families of behaviours.
    pub fn actions(&self) -> impl Iterator<Item = &Family> {
        self.families.iter().filter(|family| family.is_action())
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

/// What `done` and `failed` call a behaviour: the argument that they are given.
pub(super) fn known_as(behavior: &Name) -> String {
    argument(&Given::Name(behavior.clone()))
}

/// The leaves of a tree, from the left, with their repetitions.
fn mentions(node: &Node, all: &mut Vec<Subject>) {
    match node {
        Node::Condition(guard) => guard.visit_atoms(&mut |atom| all.push(Subject::Condition(atom))),
        Node::Behavior(id) => all.push(Subject::Action(*id)),
        _ => node
            .children()
            .iter()
            .for_each(|child| mentions(child, all)),
    }
}

/// What a name gives the parameter at a position.
fn value(name: &Name, at: usize) -> Option<&Given> {
    name.arguments.get(at)?.value.as_ref()
}

/// A value as an argument: a word without its backquotes, unless it would look like a call, or like an entry of the
/// blackboard of BehaviorTree.CPP.
fn argument(value: &Given) -> String {
    let word = match value {
        Given::Name(name) => name.as_word(),
        Given::Tuned { value, .. } => return value.clone(),
        Given::Text(_) => None,
    };
    match word.filter(|word| !word.contains(['(', '{'])) {
        Some(word) => word.to_owned(),
        None => value.to_string(),
    }
}

/// A condition or an action, by the name of its family.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Key(bool, String);

impl Key {
    fn new(subject: Subject, program: &Program) -> Self {
        let is_action = matches!(subject, Subject::Action(_));
        Self(is_action, subject.name(program).family)
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
        let predicates = predicates.map(|predicate| Key(false, predicate.name.family.clone()));
        let behaviors = program.behaviors.values();
        let behaviors = behaviors.map(|behavior| Key(true, behavior.name.family.clone()));
        let keys = history.into_iter().chain(predicates).chain(behaviors);
        let (legal, others): (Vec<Key>, Vec<Key>) = keys.partition(|key| self.legal(&key.1));
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
        let parts = name.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
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
