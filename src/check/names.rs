//! The declared names.
//!
//! Names live in three spaces: *values* (what an expression or a tree node can say), *types* (enums and kinds) and
//! *tasks*. The library is a layer of its own under the user's: the user's definitions win, but the library's own
//! bodies see the library's names first.

mod collect;
mod lookup;

use super::builtin;
use super::lint::Mentions;
use super::meaning::Entity;
use crate::source::Span;
use crate::syntax::ast::{self, Ident};
use std::cell::OnceCell;
use std::collections::{BTreeMap, BTreeSet};

/// A declaration in the value space.
#[derive(Clone, Copy, Debug)]
pub enum Decl<'a> {
    /// A variant of an enum, by its index.
    Variant(&'a Ident, &'a ast::Enum, usize),
    /// An input.
    Input(&'a ast::Input),
    /// A state variable, or a family of them.
    State(&'a ast::State),
    /// An event, or a family of them.
    Event(&'a ast::Event),
    /// A shared expression.
    Let(&'a ast::Let),
    /// A predicate, or a family of them.
    Predicate(&'a ast::Predicate),
    /// A behaviour.
    Behavior(&'a ast::Behavior),
    /// A tree.
    Tree(&'a ast::Tree),
    /// A place, with its kind.
    Place(&'a Ident, Option<&'a Ident>),
    /// A wall, with its kind.
    Wall(&'a Ident, Option<&'a Ident>),
    /// A robot.
    Robot(&'a Ident),
    /// A sensor.
    Sensor(&'a Ident),
}

impl<'a> Decl<'a> {
    /// Where the body of something with parameters stands.
    pub fn body(self) -> Option<Span> {
        match self {
            Decl::Predicate(it) => it.value.as_ref().map(|value| value.span),
            Decl::Event(it) => Some(it.value.span),
            Decl::Let(it) => Some(match &it.body {
                ast::LetBody::Expr(value) => value.span,
                ast::LetBody::Yield(body) => body.value.span,
            }),
            Decl::Behavior(it) => match &it.body {
                ast::BehaviorBody::Clauses(clauses) => {
                    let (first, last) = (clauses.first()?, clauses.last()?);
                    Some(first.span.to(last.span))
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// The kind of declaration, with its article.
    pub fn what(self) -> &'static str {
        match self {
            Decl::Variant(..) => "a variant of an enum",
            Decl::Input(_) => "an input",
            Decl::State(_) => "a state variable",
            Decl::Event(_) => "an event",
            Decl::Let(_) => "a shared expression",
            Decl::Predicate(_) => "a predicate",
            Decl::Behavior(_) => "a behaviour",
            Decl::Tree(_) => "a tree",
            Decl::Place(..) => "a place",
            Decl::Wall(..) => "a wall",
            Decl::Robot(_) => "a robot",
            Decl::Sensor(_) => "a sensor",
        }
    }

    /// What is declared.
    pub fn entity(self) -> Entity {
        match self {
            Decl::Variant(..) => Entity::Variant,
            Decl::Input(_) => Entity::Input,
            Decl::State(_) => Entity::State,
            Decl::Event(_) => Entity::Event,
            Decl::Let(_) => Entity::Let,
            Decl::Predicate(_) => Entity::Predicate,
            Decl::Behavior(_) => Entity::Behavior,
            Decl::Tree(_) => Entity::Tree,
            Decl::Place(..) => Entity::Place,
            Decl::Wall(..) => Entity::Wall,
            Decl::Robot(_) => Entity::Robot,
            Decl::Sensor(_) => Entity::Sensor,
        }
    }

    /// Whether it may be called as what is built in: a tree asks it by name, and nothing else can mention it. What asks
    /// the history stays what it is.
    fn shadows(self, name: &str) -> bool {
        let only_declared = match self {
            Decl::Predicate(decl) => decl.value.is_none(),
            Decl::Behavior(decl) => matches!(decl.body, ast::BehaviorBody::Declared),
            // Where there are inputs there is no world to ask.
            Decl::Input(_) => true,
            _ => false,
        };
        only_declared && !matches!(name, "done" | "failed")
    }

    /// Where its name is declared.
    pub fn ident(self) -> &'a Ident {
        match self {
            Decl::Input(decl) => &decl.name,
            Decl::State(decl) => &decl.name,
            Decl::Event(decl) => &decl.name,
            Decl::Let(decl) => &decl.name,
            Decl::Predicate(decl) => &decl.name,
            Decl::Behavior(decl) => &decl.name,
            Decl::Tree(decl) => &decl.name,
            Decl::Variant(name, ..)
            | Decl::Place(name, _)
            | Decl::Wall(name, _)
            | Decl::Robot(name)
            | Decl::Sensor(name) => name,
        }
    }
}

/// A declaration in the type space.
#[derive(Clone, Copy, Debug)]
pub enum TypeDecl<'a> {
    /// An enum.
    Enum(&'a ast::Enum),
    /// A kind of places.
    PlaceKind(&'a Ident),
    /// A kind of walls.
    WallKind(&'a Ident),
}

impl<'a> TypeDecl<'a> {
    /// What it is, with its article.
    pub fn what(self) -> &'static str {
        match self {
            TypeDecl::Enum(_) => "an enum",
            TypeDecl::PlaceKind(_) => "a kind of places",
            TypeDecl::WallKind(_) => "a kind of walls",
        }
    }

    /// Where its name first occurs.
    pub fn ident(self) -> &'a Ident {
        match self {
            TypeDecl::Enum(decl) => &decl.name,
            TypeDecl::PlaceKind(name) | TypeDecl::WallKind(name) => name,
        }
    }
}

/// Every declared name.
#[derive(Debug, Default)]
pub struct Names<'a> {
    user: BTreeMap<&'a str, Decl<'a>>,
    library: BTreeMap<&'a str, Decl<'a>>,
    /// The type space.
    pub types: BTreeMap<&'a str, TypeDecl<'a>>,
    /// The tasks.
    pub tasks: BTreeMap<&'a str, &'a ast::Task>,
    /// The learners, by the name of what they learn.
    pub learners: BTreeMap<&'a str, &'a ast::Learn>,
    /// The tests, by what they say.
    pub tests: BTreeMap<&'a str, &'a Ident>,
    /// The sensors of robots that run a tree of their own, each with its robot.
    pub other_sensors: Vec<(&'a Ident, &'a Ident)>,
    /// The names of declarations that were not understood.
    lost: BTreeSet<String>,
    /// The declarations without parameters whose bodies seem to need one: what gives them arguments is not to blame.
    pub lacking: BTreeSet<String>,
    /// Whether the variants of an enum are missing, so that any name may be one of them.
    pub lost_values: bool,
    /// Whether a type is not declared: what nothing is called, nor nearly, may be one of its variants.
    pub lost_type: bool,
    /// Whether a world was not understood.
    pub lost_world: bool,
    /// Where a `use` could be put into the main file.
    pub top: Option<Span>,
    /// The items of the user's files.
    items: Vec<&'a ast::Item>,
    /// What these mention, once it is asked for.
    mentions: OnceCell<Mentions<'a>>,
}

/// The words besides states that a `start` sets.
pub const START_WORDS: [&str; 4] = ["pose", "position", "heading", "history"];

/// What a tree that was learned is called where its learner has no name.
pub const LEARNED: &str = "learned";

/// The name of what a learner learns.
pub fn learned_name(learn: &ast::Learn) -> &str {
    learn.name.as_ref().map_or(LEARNED, |name| &name.name)
}

impl<'a> Names<'a> {
    /// The declaration of a value's name, as seen from the library or from the user's files; none where it may not be
    /// understood.
    pub fn value(&self, name: &str, from_library: bool) -> Option<(Decl<'a>, bool)> {
        if self.is_lost(name) {
            return None;
        }
        let user = self.user.get(name).map(|&decl| (decl, false));
        let library = self.library.get(name).map(|&decl| (decl, true));
        if from_library {
            library.or(user)
        } else {
            user.or(library)
        }
    }

    /// Whether a declaration of this name was not understood: what uses it is not to blame.
    pub fn is_lost(&self, name: &str) -> bool {
        self.lost.contains(name)
    }

    /// Whether the user declares a value of this name and mentions it nowhere.
    pub fn is_unused(&self, name: &str) -> bool {
        let mentions = self.mentions.get_or_init(|| {
            let mut mentions = Mentions::default();
            self.items.iter().for_each(|item| mentions.item(item));
            mentions
        });
        let mentioned = mentions.read.contains(name) || mentions.set.contains(name);
        self.user.contains_key(name) && !mentioned
    }

    /// Notes that what is called so, or was to be, was not understood.
    pub fn lose(&mut self, name: &str) {
        self.lost.insert(name.to_owned());
    }

    /// The names of the declarations that were not understood.
    pub fn all_lost(&self) -> impl Iterator<Item = &str> {
        self.lost.iter().map(String::as_str)
    }

    /// Whether this is the declaration of its name that counts: the first one.
    pub fn counts(&self, name: &Ident) -> bool {
        let first = self.user.get(name.name.as_str());
        first.is_none_or(|first| first.ident().span == name.span)
    }

    /// The names of the value space that `wanted` accepts, the user's first.
    pub fn values(&self, wanted: impl Fn(Decl<'a>) -> bool) -> impl Iterator<Item = &'a str> {
        let all = self.user.iter().chain(&self.library);
        all.filter(move |(_, decl)| wanted(**decl))
            .map(|(&name, _)| name)
    }
}

/// Whether a name is one that the compiler knows.
pub fn is_built_in(name: &str) -> bool {
    if builtin::BuiltIn::named(name).is_some_and(builtin::BuiltIn::gives_way) {
        return false;
    }
    builtin::names().any(|known| known == name)
}
