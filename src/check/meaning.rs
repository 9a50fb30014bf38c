//! What the names of a text stand for, as the checker found it: what an editor asks.

use super::Checker;
use super::types::Type;
use crate::ir::world::World;
use crate::source::{FileId, Span};
use crate::syntax::ast::Ident;
use std::collections::BTreeMap;

/// What is declared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Entity {
    /// A world.
    World,
    /// A place.
    Place,
    /// A wall.
    Wall,
    /// A kind of places or walls, by its first member.
    Kind,
    /// A robot.
    Robot,
    /// A sensor.
    Sensor,
    /// An enum.
    Enum,
    /// A variant of an enum.
    Variant,
    /// An input of a program without a world.
    Input,
    /// A state variable, or a family of them.
    State,
    /// An event, or a family of them.
    Event,
    /// A shared expression.
    Let,
    /// A predicate, or a family of them.
    Predicate,
    /// A behaviour.
    Behavior,
    /// A tree.
    Tree,
    /// A task.
    Task,
    /// A learner.
    Learner,
    /// A test, by what it says; no name stands for it.
    Test,
    /// A parameter.
    Parameter,
    /// A name that a body binds: a local, a `let`, a member that is ranged over.
    Local,
}

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// What is declared at this place, by the name that stands there.
    Declared(Span),
    /// What the language has built in.
    BuiltIn,
}

/// What the names of the user's files stand for, and what is declared in all files.
#[derive(Clone, Debug, Default)]
pub struct Meanings {
    /// What is declared, by the place of its name.
    declared: BTreeMap<Span, Entity>,
    /// What is used, by the place of its name.
    uses: BTreeMap<Span, Meaning>,
    /// The types of names where they are declared and where they are used.
    types: BTreeMap<Span, Type>,
    /// The declarations that names of the value space mean in the user's files.
    values: BTreeMap<String, Span>,
}

impl Meanings {
    /// What is declared, by the place of its name.
    pub fn declared(&self) -> impl Iterator<Item = (Span, Entity)> {
        self.declared.iter().map(|(span, entity)| (*span, *entity))
    }

    /// What is declared by the name at a place.
    pub fn entity(&self, declared: Span) -> Option<Entity> {
        self.declared.get(&declared).copied()
    }

    /// The name at a byte, with what it stands for; a name that declares stands for itself.
    pub fn at(&self, file: FileId, byte: u32) -> Option<(Span, Meaning)> {
        let from = Span {
            file,
            start: 0,
            end: 0,
        };
        let to = Span {
            file,
            start: byte,
            end: u32::MAX,
        };
        let near = |span: &Span| span.start <= byte && byte <= span.end;
        let used = self.uses.range(from..=to).next_back();
        let used = used
            .filter(|(span, _)| near(span))
            .map(|(span, meaning)| (*span, *meaning));
        let declared = self.declared.range(from..=to).next_back();
        let declared = declared.filter(|(span, _)| near(span));
        used.or(declared.map(|(span, _)| (*span, Meaning::Declared(*span))))
    }

    /// The places that use what is declared at a place.
    pub fn uses_of(&self, declared: Span) -> impl Iterator<Item = Span> {
        let uses = self.uses.iter();
        uses.filter(move |(_, meaning)| **meaning == Meaning::Declared(declared))
            .map(|(span, _)| *span)
    }

    /// Every name that is used, with what it stands for.
    pub fn uses(&self) -> impl Iterator<Item = (Span, Meaning)> {
        self.uses.iter().map(|(span, meaning)| (*span, *meaning))
    }

    /// The declaration of the name that is used at a place, if the user's files declare it.
    pub fn declaration(&self, used: Span) -> Option<Span> {
        match self.uses.get(&used)? {
            Meaning::Declared(span) => Some(*span),
            Meaning::BuiltIn => None,
        }
    }

    /// The type of the name at a place, as a person names it.
    pub fn type_of(&self, name: Span) -> Option<String> {
        self.known(name).map(Type::to_string)
    }

    /// The type of the name at a place, as the language writes it.
    pub fn written_type(&self, name: Span) -> Option<String> {
        self.known(name).and_then(Type::written)
    }

    /// The type of the name at a place, where it has one.
    pub fn known(&self, name: Span) -> Option<&Type> {
        self.types.get(&name).filter(|ty| **ty != Type::Error)
    }

    /// The declaration that a name of the value space means in the user's files.
    pub fn value(&self, name: &str) -> Option<Span> {
        self.values.get(name).copied()
    }

    /// The names of the value space, with their declarations.
    pub fn values(&self) -> impl Iterator<Item = (&str, Span)> {
        self.values
            .iter()
            .map(|(name, span)| (name.as_str(), *span))
    }

    /// Notes a declaration.
    pub fn declare(&mut self, name: &Ident, entity: Entity) {
        self.declared.insert(name.span, entity);
    }

    /// Notes the declaration that a name of the value space means.
    pub fn name_value(&mut self, name: &Ident) {
        self.values.insert(name.name.clone(), name.span);
    }

    /// Notes what a name stands for.
    pub fn mean(&mut self, name: &Ident, meaning: Meaning) {
        self.uses.insert(name.span, meaning);
    }

    /// Notes the type of a name; the first that is known stays.
    pub fn has_type(&mut self, name: &Ident, ty: &Type) {
        let known = self.types.entry(name.span).or_insert_with(|| ty.clone());
        if *known == Type::Error {
            *known = ty.clone();
        }
    }
}

impl Checker<'_> {
    /// Notes that a name of the user's text stands for what is declared at a place.
    pub fn stands_for(&mut self, name: &Ident, declared: Span) {
        if !self.context.library && name.span != declared {
            self.meanings.mean(name, Meaning::Declared(declared));
        }
    }

    /// Notes that a name of the user's text stands for what is built in.
    pub fn is_built_in(&mut self, name: &Ident) {
        if !self.context.library {
            self.meanings.mean(name, Meaning::BuiltIn);
        }
    }

    /// Notes a name that ranges over members of a type.
    pub fn binds_member(&mut self, name: &Ident, ty: &Type) {
        if !self.context.library {
            self.meanings.declare(name, Entity::Local);
            self.meanings.has_type(name, ty);
        }
    }

    /// Notes that a name stands for a sensor of the robot at hand, which is not the acting one, or of any other.
    pub fn stands_for_sensor(&mut self, name: &Ident) {
        let robot = (self.subject != World::acting()).then(|| self.subject_robot());
        let robot = robot.flatten().map(|robot| robot.name.clone());
        let mut others = self.names.other_sensors.iter();
        let found = others.find(|(owner, sensor)| {
            let owned = robot.as_ref().is_none_or(|robot| robot.is(&owner.name));
            owned && sensor.name == name.name
        });
        if let Some(declared) = found.map(|(_, sensor)| sensor.span) {
            self.stands_for(name, declared);
        }
    }

    /// Notes the type of a name of the user's text.
    pub fn is_of_type(&mut self, name: &Ident, ty: &Type) {
        if !self.context.library {
            self.meanings.has_type(name, ty);
        }
    }
}
