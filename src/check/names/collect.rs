//! Collecting the declared names of all files.

use super::{Decl, Names, START_WORDS, TypeDecl, is_built_in, learned_name};
use crate::check::Input;
use crate::check::meaning::{Entity, Meaning, Meanings};
use crate::check::report::Draft;
use crate::diagnostic::{Code, Diagnostic};
use crate::syntax::ast::{Ident, Item, ItemKind, RobotEntryKind, World, WorldEntryKind};
use std::collections::BTreeSet;

impl<'a> Names<'a> {
    /// Collects the names of all files; a name that is declared twice is reported once.
    pub fn collect(
        files: &[Input<'a>],
        meanings: &mut Meanings,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Self {
        let mut names = Self::default();
        for input in files {
            let mut collector = Collector {
                names: &mut names,
                library: input.library,
                meanings,
                diagnostics,
            };
            for item in &input.ast.items {
                collector.item(item);
            }
            if !input.library {
                names.items.extend(&input.ast.items);
            }
            let lost = &input.ast.lost;
            names.lost.extend(lost.names.iter().cloned());
            names.lost_world |= lost.world;
            let top = input.ast.items.first();
            names.top = top
                .filter(|item| item.docs.is_empty())
                .map(|item| item.span.before());
        }
        for decl in names.library.values().chain(names.user.values()) {
            meanings.name_value(decl.ident());
        }
        names
    }
}

/// Declares the names of one file.
struct Collector<'c, 'a> {
    names: &'c mut Names<'a>,
    library: bool,
    meanings: &'c mut Meanings,
    diagnostics: &'c mut Vec<Diagnostic>,
}

impl<'a> Collector<'_, 'a> {
    fn item(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Enum(decl) => {
                // An enum that is declared twice is told as a whole.
                let first = match self.names.types.get(decl.name.name.as_str()) {
                    Some(TypeDecl::Enum(first)) => first.variants.as_slice(),
                    _ => &[],
                };
                let known: BTreeSet<&str> = first.iter().map(|it| it.name.as_str()).collect();
                for (index, name) in decl.variants.iter().enumerate() {
                    if !known.contains(name.name.as_str()) {
                        self.value(Decl::Variant(name, decl, index));
                    }
                }
                self.type_name(TypeDecl::Enum(decl));
            }
            ItemKind::Input(decl) => self.value(Decl::Input(decl)),
            ItemKind::State(decl) => self.value(Decl::State(decl)),
            ItemKind::Event(decl) => self.value(Decl::Event(decl)),
            ItemKind::Let(decl) => self.value(Decl::Let(decl)),
            ItemKind::Predicate(decl) => self.value(Decl::Predicate(decl)),
            ItemKind::Behavior(decl) => self.value(Decl::Behavior(decl)),
            ItemKind::Tree(decl) => self.value(Decl::Tree(decl)),
            ItemKind::World(world) => self.world(world),
            ItemKind::Task(task) => {
                self.meanings.declare(&task.name, Entity::Task);
                let first = *self.names.tasks.entry(&task.name.name).or_insert(task);
                if !std::ptr::eq(first, task) {
                    self.twice(&task.name, &first.name, "a task");
                }
            }
            ItemKind::Learn(learn) => {
                if let Some(name) = &learn.name {
                    self.meanings.declare(name, Entity::Learner);
                }
                let name = learned_name(learn);
                let first = *self.names.learners.entry(name).or_insert(learn);
                if !std::ptr::eq(first, learn) {
                    let here = learn.name.as_ref().unwrap_or(&learn.task);
                    let there = first.name.as_ref().unwrap_or(&first.task);
                    self.error(Code::E0201, here, format!("two learners learn `{name}`"))
                        .label("learned a second time here")
                        .also(there.span, "first learned here")
                        .help("give one of them a name of its own: `learn NAME for TASK { … }`");
                }
            }
            ItemKind::Test(test) => {
                let title = &test.title;
                let first = *self.names.tests.entry(&title.name).or_insert(title);
                if first.span != title.span {
                    let message = format!("two tests are called \"{}\"", title.name);
                    self.error(Code::E0201, title, message)
                        .label("called so again here")
                        .also(first.span, "first called so here");
                }
            }
            ItemKind::Use(_)
            | ItemKind::EachTick(_)
            | ItemKind::On(_)
            | ItemKind::Claim(_)
            | ItemKind::Error => {}
        }
    }

    fn world(&mut self, world: &'a World) {
        self.meanings.declare(&world.name, Entity::World);
        for entry in &world.entries {
            match &entry.kind {
                WorldEntryKind::Place { name, of_kind, .. } => {
                    self.value(Decl::Place(name, of_kind.as_ref()));
                    if let Some(kind) = of_kind {
                        self.kind(TypeDecl::PlaceKind(kind));
                    }
                }
                WorldEntryKind::Wall { name, of_kind, .. } => {
                    self.value(Decl::Wall(name, of_kind.as_ref()));
                    if let Some(kind) = of_kind {
                        self.kind(TypeDecl::WallKind(kind));
                    }
                }
                WorldEntryKind::Robot {
                    name: robot,
                    entries,
                } => {
                    self.value(Decl::Robot(robot));
                    // Only the sensors of the acting robot are in scope by name.
                    let runs = entries.iter().any(|entry| {
                        matches!(&entry.kind, RobotEntryKind::Field(field) if field.name.name == "runs")
                    });
                    for entry in entries {
                        if let RobotEntryKind::Sensor { name, .. } = &entry.kind {
                            match runs {
                                true => {
                                    self.meanings.declare(name, Entity::Sensor);
                                    self.names.other_sensors.push((robot, name));
                                }
                                false => self.value(Decl::Sensor(name)),
                            }
                        }
                    }
                }
                WorldEntryKind::Field(_) | WorldEntryKind::Error => {}
            }
        }
    }

    fn value(&mut self, decl: Decl<'a>) {
        let name = decl.ident();
        self.meanings.declare(name, decl.entity());
        let starts = matches!(decl, Decl::State(_)) && START_WORDS.contains(&name.name.as_str());
        if starts || is_built_in(&name.name) && !decl.shadows(&name.name) {
            self.error(Code::E0204, name, format!("`{}` is built in", name.name))
                .label("choose another name");
            self.names.lose(&name.name);
        }
        let layer = if self.library {
            &mut self.names.library
        } else {
            &mut self.names.user
        };
        match layer.get(name.name.as_str()).copied() {
            Some(first) if !stands_beside(decl, first) => {
                self.twice(name, first.ident(), first.what());
                // Which of two different things a use means nobody knows.
                if first.what() != decl.what() {
                    self.names.lose(&name.name);
                }
            }
            _ => {
                layer.insert(&name.name, decl);
            }
        }
    }

    fn type_name(&mut self, decl: TypeDecl<'a>) {
        let name = decl.ident();
        let entity = match decl {
            TypeDecl::Enum(_) => Entity::Enum,
            TypeDecl::PlaceKind(_) | TypeDecl::WallKind(_) => Entity::Kind,
        };
        self.meanings.declare(name, entity);
        match self.names.types.get(name.name.as_str()).copied() {
            Some(first) => self.twice(name, first.ident(), "a type"),
            None => {
                self.names.types.insert(&name.name, decl);
            }
        }
    }

    /// A kind is declared by its first member; a place and a wall cannot be of one kind.
    fn kind(&mut self, decl: TypeDecl<'a>) {
        match (self.names.types.get(decl.ident().name.as_str()), decl) {
            (Some(TypeDecl::PlaceKind(first)), TypeDecl::PlaceKind(name))
            | (Some(TypeDecl::WallKind(first)), TypeDecl::WallKind(name)) => {
                self.meanings.mean(name, Meaning::Declared(first.span));
            }
            (Some(first), _) => {
                let (first, what) = (first.ident().span, first.what());
                let name = decl.ident();
                let message = format!("`{}` is {what}, not {}", name.name, decl.what());
                self.meanings.declare(name, Entity::Kind);
                self.error(Code::E0201, name, message)
                    .label("a kind is of places, or of walls, and is no enum")
                    .also(first, format!("{what}, from here on"))
                    .help("give one of them a kind of its own");
                self.names.lose(&name.name);
            }
            (None, _) => self.type_name(decl),
        }
    }

    fn twice(&mut self, name: &Ident, first: &Ident, what: &str) {
        self.error(
            Code::E0201,
            name,
            format!("`{}` is declared twice", name.name),
        )
        .label("declared again here")
        .also(first.span, format!("first declared here, as {what}"));
    }

    fn error(&mut self, code: Code, name: &Ident, message: String) -> Draft<'_> {
        Draft::new(self.diagnostics, code, name.span, message)
    }
}

/// Whether two declarations may have one name: a learned tree stands beside the accepted tree of its source.
fn stands_beside(decl: Decl, first: Decl) -> bool {
    matches!((decl, first), (Decl::Tree(_), Decl::Tree(_)))
        && decl.ident().span.file != first.ident().span.file
}
