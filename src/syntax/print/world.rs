//! Worlds.

use super::Printer;
use super::columns::Align;
use super::doc::{Break, Doc, Entry, row};
use super::names::ident;
use crate::source::Span;
use crate::syntax::ast::{
    Arg, ArgKind, Expr, ExprKind, Field, Ident, RobotEntry, RobotEntryKind, World, WorldEntry,
    WorldEntryKind,
};

impl Printer<'_> {
    pub(super) fn world<'a>(&self, world: &'a World, span: Span) -> Doc<'a> {
        let entries = world
            .entries
            .iter()
            .map(|entry| self.world_entry(entry).documented(&entry.docs))
            .collect();
        let braces = self.braces(world.name.span.range().end, span, entries);
        row!["world ", ident(&world.name), " ", braces]
    }

    fn world_entry<'a>(&self, entry: &'a WorldEntry) -> Entry<'a> {
        let (align, doc) = match &entry.kind {
            WorldEntryKind::Place {
                name,
                of_kind,
                shape,
                facing,
            } => {
                let head = row!["place ", ident(name), kind(of_kind.as_ref())];
                let doc = self.shape(head, shape, " facing ", facing.as_ref());
                (Align::Of("place"), doc)
            }
            WorldEntryKind::Wall {
                name,
                of_kind,
                shape,
                when,
            } => {
                let head = row!["wall ", ident(name), kind(of_kind.as_ref())];
                let doc = self.shape(head, shape, " when ", when.as_ref());
                (Align::Of("wall"), doc)
            }
            WorldEntryKind::Robot { name, entries } => {
                let entries = entries
                    .iter()
                    .map(|entry| self.robot_entry(entry).documented(&entry.docs))
                    .collect();
                let braces = self.braces(name.span.range().end, entry.span, entries);
                (Align::None, row!["robot ", ident(name), " ", braces])
            }
            WorldEntryKind::Field(field) => (Align::Of("field"), self.field(field)),
            WorldEntryKind::Error => (Align::None, Doc::nothing()),
        };
        Entry::aligned(entry.span, align, doc)
    }

    fn shape<'a>(
        &self,
        head: Doc<'a>,
        shape: &'a Expr,
        word: &'static str,
        last: Option<&'a Expr>,
    ) -> Doc<'a> {
        let last = last.map_or(Doc::nothing(), |last| row![word, self.expr(last)]);
        let shape = self.expr(shape).room(last.width);
        row![head, Doc::column(), "= ", shape, last]
    }

    fn robot_entry<'a>(&self, entry: &'a RobotEntry) -> Entry<'a> {
        let (align, doc) = match &entry.kind {
            RobotEntryKind::Sensor { name, value } => self.sensor(name, value),
            RobotEntryKind::Field(field) => (Align::Of("field"), self.field(field)),
            RobotEntryKind::Error => (Align::None, Doc::nothing()),
        };
        Entry::aligned(entry.span, align, doc)
    }

    /// A sensor; adjacent ones with the same named arguments have these in columns.
    fn sensor<'a>(&self, name: &'a Ident, value: &'a Expr) -> (Align, Doc<'a>) {
        let (shape, doc) = match &value.kind {
            ExprKind::Ref(call) => {
                let args = call.args.as_deref().unwrap_or_default();
                (shape_of(&call.name, args), self.call_in_columns(call))
            }
            _ => (String::new(), self.expr(value)),
        };
        let doc = doc
            .grouped(value.span, Break::TooLong)
            .settled(value.span.range().end);
        let head = row!["sensor ", ident(name), Doc::column(), "= "];
        (Align::Shaped("sensor", shape), row![head, doc])
    }

    fn field<'a>(&self, field: &'a Field) -> Doc<'a> {
        self.definition(ident(&field.name), &field.value)
    }
}

fn kind(kind: Option<&Ident>) -> Doc<'_> {
    kind.map_or(Doc::nothing(), |kind| row![": ", ident(kind)])
}

/// What the calls of sensors whose arguments share columns have in common: the name, and those of the arguments.
fn shape_of(call: &Ident, args: &[Arg]) -> String {
    if args.is_empty() {
        return String::new();
    }
    let mut shape = call.name.clone();
    for arg in args {
        if let ArgKind::Named(name, _) = &arg.kind {
            shape.push(' ');
            shape.push_str(&name.name);
        }
    }
    shape
}
