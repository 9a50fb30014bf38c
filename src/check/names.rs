//! Every declared name with what it names.
//!
//! Names live in three spaces: *values* (what an expression or a tree node can say), *types* (enums and kinds) and
//! *tasks*. The library is a layer of its own under the user's: the user's definitions win, but the library's own
//! bodies see the library's names first.

use super::Input;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::syntax::ast::{self, Ident, ItemKind, RobotEntryKind, WorldEntryKind};
use std::collections::BTreeMap;

/// What a name of the value space names.
#[derive(Clone, Copy, Debug)]
pub enum Decl<'a> {
    /// A variant of an enum, by its index.
    Variant(&'a ast::Enum, usize),
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
    /// What it is, with its article.
    pub fn what(self) -> &'static str {
        match self {
            Decl::Variant(..) => "a variant of an enum",
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

    /// Whether it may be called as what is built in: a tree asks it by name, and nothing else can mention it. What asks
    /// the history stays what it is.
    fn shadows(self, name: &str) -> bool {
        let only_declared = match self {
            Decl::Predicate(decl) => decl.value.is_none(),
            Decl::Behavior(decl) => matches!(decl.body, ast::BehaviorBody::Declared),
            _ => false,
        };
        only_declared && !matches!(name, "done" | "failed")
    }

    /// Where its name is declared.
    pub fn ident(self) -> Option<&'a Ident> {
        Some(match self {
            Decl::Variant(decl, index) => return decl.variants.get(index),
            Decl::State(decl) => &decl.name,
            Decl::Event(decl) => &decl.name,
            Decl::Let(decl) => &decl.name,
            Decl::Predicate(decl) => &decl.name,
            Decl::Behavior(decl) => &decl.name,
            Decl::Tree(decl) => &decl.name,
            Decl::Place(name, _) | Decl::Wall(name, _) | Decl::Robot(name) | Decl::Sensor(name) => {
                name
            }
        })
    }
}

/// What a name of the type space names.
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
    fn ident(self) -> &'a Ident {
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
}

/// The words that a `start` sets besides states.
pub const START_WORDS: [&str; 4] = ["pose", "position", "heading", "history"];

/// The name of what a learner learns.
pub fn learned_name(learn: &ast::Learn) -> &str {
    learn.name.as_ref().map_or("learned", |name| &name.name)
}

impl<'a> Names<'a> {
    /// Collects the names of all files; a name that is declared twice is reported once.
    pub fn collect(files: &[Input<'a>], diagnostics: &mut Vec<Diagnostic>) -> Self {
        let mut names = Self::default();
        for input in files {
            for item in &input.ast.items {
                names.item(&item.kind, input.library, diagnostics);
            }
        }
        names
    }

    /// The declaration of a value's name, as seen from the library or from the user's files.
    pub fn value(&self, name: &str, from_library: bool) -> Option<(Decl<'a>, bool)> {
        let user = self.user.get(name).map(|&decl| (decl, false));
        let library = self.library.get(name).map(|&decl| (decl, true));
        if from_library {
            library.or(user)
        } else {
            user.or(library)
        }
    }

    /// The names of the value space that `wanted` accepts, the user's first.
    pub fn values<'s>(
        &'s self,
        wanted: impl Fn(Decl<'a>) -> bool + 's,
    ) -> impl Iterator<Item = &'s str> {
        self.user
            .iter()
            .chain(&self.library)
            .filter(move |(_, decl)| wanted(**decl))
            .map(|(name, _)| *name)
    }

    fn item(&mut self, kind: &'a ItemKind, library: bool, diagnostics: &mut Vec<Diagnostic>) {
        let mut declare = |decl: Decl<'a>| {
            let layer = if library {
                &mut self.library
            } else {
                &mut self.user
            };
            if let Some(name) = decl.ident() {
                let starts =
                    matches!(decl, Decl::State(_)) && START_WORDS.contains(&name.name.as_str());
                if super::world::is_built_in(&name.name) && !decl.shadows(&name.name) || starts {
                    diagnostics.push(
                        Diagnostic::new(
                            Code::E0204,
                            name.span,
                            format!("`{}` is built in", name.name),
                        )
                        .label("choose another name"),
                    );
                }
                match layer.get(name.name.as_str()) {
                    // What was learned stands beside the accepted result that its source has.
                    Some(Decl::Tree(first))
                        if matches!(decl, Decl::Tree(_))
                            && first.name.span.file != name.span.file =>
                    {
                        layer.insert(&name.name, decl);
                    }
                    Some(first) => diagnostics.push(twice(name, first.ident(), first.what())),
                    None => {
                        layer.insert(&name.name, decl);
                    }
                }
            }
        };
        match kind {
            ItemKind::Enum(decl) => {
                for index in 0..decl.variants.len() {
                    declare(Decl::Variant(decl, index));
                }
                self.declare_type(TypeDecl::Enum(decl), diagnostics);
            }
            ItemKind::State(decl) => declare(Decl::State(decl)),
            ItemKind::Event(decl) => declare(Decl::Event(decl)),
            ItemKind::Let(decl) => declare(Decl::Let(decl)),
            ItemKind::Predicate(decl) => declare(Decl::Predicate(decl)),
            ItemKind::Behavior(decl) => declare(Decl::Behavior(decl)),
            ItemKind::Tree(decl) => declare(Decl::Tree(decl)),
            ItemKind::World(world) => {
                for entry in &world.entries {
                    match &entry.kind {
                        WorldEntryKind::Place { name, of_kind, .. } => {
                            declare(Decl::Place(name, of_kind.as_ref()));
                        }
                        WorldEntryKind::Wall { name, of_kind, .. } => {
                            declare(Decl::Wall(name, of_kind.as_ref()));
                        }
                        WorldEntryKind::Robot { name, entries } => {
                            declare(Decl::Robot(name));
                            // The sensors of the acting robot are in scope by name, those of others are not.
                            let runs = entries.iter().any(|entry| {
                                matches!(&entry.kind, RobotEntryKind::Field(field) if field.name.name == "runs")
                            });
                            for entry in entries.iter().filter(|_| !runs) {
                                if let RobotEntryKind::Sensor { name, .. } = &entry.kind {
                                    declare(Decl::Sensor(name));
                                }
                            }
                        }
                        WorldEntryKind::Field(_) | WorldEntryKind::Error => {}
                    }
                }
                for entry in &world.entries {
                    match &entry.kind {
                        WorldEntryKind::Place {
                            of_kind: Some(kind),
                            ..
                        } => self.declare_kind(TypeDecl::PlaceKind(kind), diagnostics),
                        WorldEntryKind::Wall {
                            of_kind: Some(kind),
                            ..
                        } => self.declare_kind(TypeDecl::WallKind(kind), diagnostics),
                        _ => {}
                    }
                }
            }
            ItemKind::Task(task) => {
                if let Some(first) = self.tasks.insert(&task.name.name, task) {
                    diagnostics.push(twice(&task.name, Some(&first.name), "a task"));
                }
            }
            ItemKind::Learn(learn) => {
                if let Some(first) = self.learners.insert(learned_name(learn), learn) {
                    let here = learn.name.as_ref().unwrap_or(&learn.task);
                    let there = first.name.as_ref().unwrap_or(&first.task);
                    diagnostics.push(
                        Diagnostic::new(
                            Code::E0201,
                            here.span,
                            format!("two learners learn `{}`", learned_name(learn)),
                        )
                        .label("learned a second time here")
                        .also(there.span, "first learned here")
                        .help("give one of them a name of its own: `learn NAME for TASK { … }`"),
                    );
                }
            }
            ItemKind::Use(_)
            | ItemKind::EachTick(_)
            | ItemKind::On(_)
            | ItemKind::Claim(_)
            | ItemKind::Error => {}
        }
    }

    fn declare_type(&mut self, decl: TypeDecl<'a>, diagnostics: &mut Vec<Diagnostic>) {
        let name = decl.ident();
        match self.types.get(name.name.as_str()) {
            Some(first) => diagnostics.push(twice(name, Some(first.ident()), "a type")),
            None => {
                self.types.insert(&name.name, decl);
            }
        }
    }

    /// A kind is declared by its first member; a place and a wall cannot be of one kind.
    fn declare_kind(&mut self, decl: TypeDecl<'a>, diagnostics: &mut Vec<Diagnostic>) {
        match (self.types.get(decl.ident().name.as_str()), decl) {
            (Some(TypeDecl::PlaceKind(_)), TypeDecl::PlaceKind(_))
            | (Some(TypeDecl::WallKind(_)), TypeDecl::WallKind(_)) => {}
            _ => self.declare_type(decl, diagnostics),
        }
    }
}

/// A name that is declared twice.
fn twice(name: &Ident, first: Option<&Ident>, what: &str) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::E0201,
        name.span,
        format!("`{}` is declared twice", name.name),
    )
    .label("declared again here");
    match first {
        Some(first) => diagnostic.also(first.span, format!("first declared here, as {what}")),
        None => diagnostic,
    }
}

/// An unknown name, with the likely one offered; `what` is what could stand there.
pub fn unknown<'n>(
    name: &Ident,
    what: &str,
    candidates: impl IntoIterator<Item = &'n str>,
) -> Diagnostic {
    let diagnostic = Diagnostic::new(
        Code::E0202,
        name.span,
        format!("`{}` is not declared", name.name),
    )
    .label(format!("no {what} has this name"));
    likely(diagnostic, name, candidates)
}

/// A name that `owner` does not have among its `known` ones, with the likely one offered or else all of them.
pub fn stranger(code: Code, name: &Ident, owner: &str, what: &str, known: &[&str]) -> Diagnostic {
    let label = match known {
        [] => "it has none".to_owned(),
        known => format!("it has {}", listed(known, "and")),
    };
    let message = format!("{owner} has no {what} `{}`", name.name);
    let diagnostic = Diagnostic::new(code, name.span, message).label(label);
    likely(diagnostic, name, known.iter().copied())
}

/// Offers the name that was likely meant.
fn likely<'n>(
    diagnostic: Diagnostic,
    name: &Ident,
    candidates: impl IntoIterator<Item = &'n str>,
) -> Diagnostic {
    match suggest::nearest(&name.name, candidates) {
        Some(likely) => {
            let question = format!("did you mean `{likely}`?");
            diagnostic.label(question.clone()).fix(
                question,
                name.span,
                likely.to_owned(),
                Applicability::Unsafe,
            )
        }
        None => diagnostic,
    }
}

/// Names in a sentence: `a`, `b` and `c`.
pub fn listed(names: &[&str], word: &str) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.as_slice() {
        [] => String::new(),
        [one] => one.clone(),
        [most @ .., last] => format!("{} {word} {last}", most.join(", ")),
    }
}
