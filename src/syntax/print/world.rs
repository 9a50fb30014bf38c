//! Worlds.

use super::columns::Group;
use super::{Printer, flat};
use crate::source::Span;
use crate::syntax::ast::{
    ArgKind, Expr, ExprKind, Ident, RobotEntry, RobotEntryKind, World, WorldEntry, WorldEntryKind,
};

impl Printer<'_> {
    pub(super) fn world(&mut self, world: &World, span: Span) {
        self.write(&format!("world {} ", flat::ident(&world.name)));
        self.begin_braces(world.name.span.range().end);
        for entry in &world.entries {
            self.entry(entry.span, |printer| {
                printer.docs(&entry.docs);
                printer.world_entry(entry);
            });
        }
        self.end_braces(span.range().end, world.entries.is_empty());
    }

    fn world_entry(&mut self, entry: &WorldEntry) {
        match &entry.kind {
            WorldEntryKind::Place {
                name,
                of_kind,
                shape,
                facing,
            } => {
                let head = format!("place {}{}", flat::ident(name), kind(of_kind.as_ref()));
                self.shape("place", &head, shape, " facing ", facing.as_ref());
            }
            WorldEntryKind::Wall {
                name,
                of_kind,
                shape,
                when,
            } => {
                let head = format!("wall {}{}", flat::ident(name), kind(of_kind.as_ref()));
                self.shape("wall", &head, shape, " when ", when.as_ref());
            }
            WorldEntryKind::Robot { name, entries } => {
                self.write(&format!("robot {} ", flat::ident(name)));
                self.begin_braces(name.span.range().end);
                for entry in entries {
                    self.entry(entry.span, |printer| {
                        printer.docs(&entry.docs);
                        printer.robot_entry(entry);
                    });
                }
                self.end_braces(entry.span.range().end, entries.is_empty());
            }
            WorldEntryKind::Field(field) => {
                self.definition("field", &flat::ident(&field.name), &field.value)
            }
            WorldEntryKind::Error => self.end_line(Group::None),
        }
    }

    fn shape(
        &mut self,
        kind: &'static str,
        head: &str,
        shape: &Expr,
        word: &str,
        last: Option<&Expr>,
    ) {
        let before = self.ended;
        let tail = last.map_or(String::new(), |last| format!("{word}{}", flat::expr(last)));
        self.write(head);
        self.cell("= ");
        self.expr(shape, tail.chars().count());
        if let Some(last) = last {
            self.write(word);
            self.expr(last, 0);
        }
        self.end_entry(kind, before);
    }

    fn robot_entry(&mut self, entry: &RobotEntry) {
        match &entry.kind {
            RobotEntryKind::Sensor { name, value } => self.sensor(name, value),
            RobotEntryKind::Field(field) => {
                self.definition("field", &flat::ident(&field.name), &field.value)
            }
            RobotEntryKind::Error => self.end_line(Group::None),
        }
    }

    /// A sensor; adjacent ones with the same named arguments have these in columns.
    fn sensor(&mut self, name: &Ident, value: &Expr) {
        let head = format!("sensor {}", flat::ident(name));
        self.write(&head);
        self.cell("= ");
        self.settle(value);
        let text = flat::expr(value);
        if !self.fits(&text, value.span, 0) {
            let before = self.ended;
            self.expr(value, 0);
            self.end_entry("sensor", before);
            return;
        }
        let mut shape = String::new();
        match &value.kind {
            ExprKind::Ref(call) if call.args.as_ref().is_some_and(|args| !args.is_empty()) => {
                shape.push_str(&call.name.name);
                self.write(&format!("{}(", flat::ident(&call.name)));
                let args = call.args.as_deref().unwrap_or_default();
                for (index, arg) in args.iter().enumerate() {
                    if let ArgKind::Named(name, _) = &arg.kind {
                        shape.push_str(&format!(" {}", name.name));
                    }
                    let end = if index + 1 == args.len() { ")" } else { "," };
                    let text = format!("{}{end}", flat::arg(arg));
                    if index == 0 {
                        self.write(&text);
                    } else {
                        self.cell(&text);
                    }
                }
            }
            _ => self.write(&text),
        }
        self.end_line(Group::Shaped("sensor", shape));
    }
}

fn kind(kind: Option<&Ident>) -> String {
    kind.map_or(String::new(), |kind| format!(": {}", flat::ident(kind)))
}
