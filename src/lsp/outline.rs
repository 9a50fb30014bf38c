//! What a file declares, with its documentation and its parts.

use crate::check::Entity;
use crate::source::Span;
use crate::syntax::ast::{
    BehaviorBody, Clause, ClauseKind, File, Ident, Item, ItemKind, Params, RobotEntryKind, Tree,
    WorldEntryKind,
};

/// Something that has a name.
#[derive(Clone)]
pub(super) struct Outlined<'a> {
    /// The name where it is declared.
    pub(super) name: &'a Ident,
    /// What is declared.
    pub(super) entity: Entity,
    /// The `///` lines before it.
    pub(super) docs: &'a [String],
    /// All of it, without its documentation.
    pub(super) span: Span,
    /// Its parameters.
    pub(super) params: Option<&'a Params>,
    /// The clauses of a behaviour.
    pub(super) clauses: &'a [Clause],
    /// What is declared within it.
    pub(super) inner: Vec<Outlined<'a>>,
}

impl<'a> Outlined<'a> {
    fn new(name: &'a Ident, entity: Entity, docs: &'a [String], span: Span) -> Self {
        Self {
            name,
            entity,
            docs,
            span,
            params: None,
            clauses: &[],
            inner: Vec::new(),
        }
    }

    fn with(mut self, params: Option<&'a Params>) -> Self {
        self.params = params;
        self
    }

    /// What is declared by the name at a place, within this or as this.
    pub(super) fn find(&self, name: Span) -> Option<&Outlined<'a>> {
        match self.name.span == name {
            true => Some(self),
            false => self.inner.iter().find_map(|inner| inner.find(name)),
        }
    }

    /// Where the text of a behaviour's regions stands.
    pub(super) fn regions(&self) -> impl Iterator<Item = Span> {
        let regions = self.clauses.iter().filter(|clause| {
            matches!(
                clause.kind,
                ClauseKind::Requires(_) | ClauseKind::Succeed(_) | ClauseKind::Fail(_)
            )
        });
        regions.map(|clause| clause.span)
    }
}

/// What a file declares, in the order of the text.
pub(super) fn outline(file: &File) -> Vec<Outlined<'_>> {
    file.items.iter().filter_map(item).collect()
}

/// The tree of an item, unless it is the subtree of others, with parameters.
pub(super) fn whole_tree(item: &Item) -> Option<&Tree> {
    match &item.kind {
        ItemKind::Tree(tree) if tree.params.is_none() => Some(tree),
        _ => None,
    }
}

fn item(item: &Item) -> Option<Outlined<'_>> {
    let new = |name, entity| Outlined::new(name, entity, &item.docs, item.span);
    Some(match &item.kind {
        ItemKind::World(world) => {
            let mut outlined = new(&world.name, Entity::World);
            outlined.inner = (world.entries.iter())
                .filter_map(|entry| self::entry(&entry.kind, &entry.docs, entry.span))
                .collect();
            outlined
        }
        ItemKind::Enum(decl) => {
            let mut outlined = new(&decl.name, Entity::Enum);
            let variants = decl.variants.iter();
            outlined.inner = variants
                .map(|name| Outlined::new(name, Entity::Variant, &[], name.span))
                .collect();
            outlined
        }
        ItemKind::Input(decl) => new(&decl.name, Entity::Input),
        ItemKind::State(decl) => new(&decl.name, Entity::State).with(decl.params.as_ref()),
        ItemKind::Event(decl) => new(&decl.name, Entity::Event).with(decl.params.as_ref()),
        ItemKind::Let(decl) => new(&decl.name, Entity::Let).with(decl.params.as_ref()),
        ItemKind::Predicate(decl) => new(&decl.name, Entity::Predicate).with(decl.params.as_ref()),
        ItemKind::Tree(decl) => new(&decl.name, Entity::Tree).with(decl.params.as_ref()),
        ItemKind::Behavior(decl) => {
            let mut outlined = new(&decl.name, Entity::Behavior).with(decl.params.as_ref());
            if let BehaviorBody::Clauses(clauses) = &decl.body {
                outlined.clauses = clauses;
            }
            outlined
        }
        ItemKind::Task(task) => new(&task.name, Entity::Task),
        ItemKind::Learn(learn) => new(learn.name.as_ref()?, Entity::Learner),
        ItemKind::Test(test) => new(&test.title, Entity::Test),
        ItemKind::Use(_)
        | ItemKind::EachTick(_)
        | ItemKind::On(_)
        | ItemKind::Claim(_)
        | ItemKind::Error => return None,
    })
}

fn entry<'a>(kind: &'a WorldEntryKind, docs: &'a [String], span: Span) -> Option<Outlined<'a>> {
    Some(match kind {
        WorldEntryKind::Place { name, .. } => Outlined::new(name, Entity::Place, docs, span),
        WorldEntryKind::Wall { name, .. } => Outlined::new(name, Entity::Wall, docs, span),
        WorldEntryKind::Robot { name, entries } => {
            let mut outlined = Outlined::new(name, Entity::Robot, docs, span);
            let sensors = entries.iter().filter_map(|entry| match &entry.kind {
                RobotEntryKind::Sensor { name, .. } => {
                    Some(Outlined::new(name, Entity::Sensor, &entry.docs, entry.span))
                }
                _ => None,
            });
            outlined.inner = sensors.collect();
            outlined
        }
        WorldEntryKind::Field(_) | WorldEntryKind::Error => return None,
    })
}
