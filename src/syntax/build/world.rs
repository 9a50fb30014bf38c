//! Worlds.

use super::Builder;
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{
    Expr, Field, Ident, RobotEntry, RobotEntryKind, World, WorldEntry, WorldEntryKind,
};
use crate::syntax::grammar::{Node, Parts, Rule};

/// The words before the name of what an entry declares.
const DECLARING: [&str; 4] = ["place", "wall", "robot", "sensor"];

impl<'i> Builder<'i> {
    pub(super) fn world(&mut self, node: Node<'i>) -> World {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_world);
        let name = self.take_name(&mut parts);
        let mut entries = Vec::new();
        self.entries(parts, Rule::strict_world_entry, |builder, node, span| {
            let docs = builder.docs(span);
            let kind = node.map_or(WorldEntryKind::Error, |node| builder.world_entry(node));
            entries.push(WorldEntry { docs, kind, span });
        });
        World { name, entries }
    }

    fn world_entry(&mut self, node: Node<'i>) -> WorldEntryKind {
        match node.as_rule() {
            Rule::place => self.place(node),
            Rule::wall => self.wall(node),
            Rule::robot => self.robot(node),
            _ => WorldEntryKind::Field(self.field(node)),
        }
    }

    fn place(&mut self, node: Node<'i>) -> WorldEntryKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_place);
        let (name, of_kind, shape) = self.shape(&mut parts);
        let wrong = parts.maybe(Rule::wrong_facing);
        if let Some(wrong) = &wrong {
            let span = self.span(wrong);
            let comma = wrong.as_str().starts_with(',');
            let message = "`facing` follows the shape without `,` and `=`".to_owned();
            self.respell(
                Code::E0127,
                span,
                message,
                if comma { " facing" } else { "facing" },
            );
        }
        let facing =
            (parts.has(Rule::kw_facing) || wrong.is_some()).then(|| self.take_expr(&mut parts));
        WorldEntryKind::Place {
            name,
            of_kind,
            shape,
            facing,
        }
    }

    fn wall(&mut self, node: Node<'i>) -> WorldEntryKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_wall);
        let (name, of_kind, shape) = self.shape(&mut parts);
        let when = parts
            .has(Rule::kw_wall_when)
            .then(|| self.take_expr(&mut parts));
        WorldEntryKind::Wall {
            name,
            of_kind,
            shape,
            when,
        }
    }

    fn shape(&mut self, parts: &mut Parts<'i>) -> (Ident, Option<Ident>, Expr) {
        let name = self.take_name(parts);
        let of_kind = parts.maybe(Rule::of_kind).map(|node| {
            let mut parts = Parts::of(node);
            parts.has(Rule::colon);
            self.take_name(&mut parts)
        });
        self.take_is(parts);
        (name, of_kind, self.take_expr(parts))
    }

    fn robot(&mut self, node: Node<'i>) -> WorldEntryKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_robot);
        let name = self.take_name(&mut parts);
        let mut entries = Vec::new();
        self.entries(parts, Rule::strict_robot_entry, |builder, node, span| {
            let docs = builder.docs(span);
            let kind = node.map_or(RobotEntryKind::Error, |node| builder.robot_entry(node));
            entries.push(RobotEntry { docs, kind, span });
        });
        WorldEntryKind::Robot { name, entries }
    }

    fn robot_entry(&mut self, node: Node<'i>) -> RobotEntryKind {
        if node.as_rule() != Rule::sensor {
            return RobotEntryKind::Field(self.field(node));
        }
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_sensor);
        let Field { name, value } = self.definition(parts);
        RobotEntryKind::Sensor { name, value }
    }

    fn field(&mut self, node: Node<'i>) -> Field {
        self.definition(Parts::of(node))
    }

    /// `name = value`
    fn definition(&mut self, mut parts: Parts<'i>) -> Field {
        let name = self.take_name(&mut parts);
        match parts.maybe(Rule::wrong_is) {
            Some(mark) if DECLARING.contains(&name.name.as_str()) => {
                let diagnostic = Diagnostic::new(
                    Code::E0127,
                    self.span(&mark),
                    format!("`{}` is followed by its name", name.name),
                )
                .label("no mark stands here")
                .fix("drop the mark", self.span(&mark), "", Applicability::Unsafe);
                self.report(diagnostic);
            }
            Some(mark) => {
                let value = self.take_expr(&mut parts);
                let rest = self.text.get(value.span.range().end..).unwrap_or_default();
                let rest = rest.trim_start_matches(' ');
                let of_kind = rest.starts_with('=') && !rest.starts_with("==");
                match of_kind {
                    true => self.lacks_its_word(&name, self.span(&mark)),
                    false => self.wrong_is(&mark),
                }
                return Field { name, value };
            }
            None => {
                self.take_is(&mut parts);
            }
        }
        let value = self.take_expr(&mut parts);
        Field { name, value }
    }

    /// Reports `tomatoes: bed = disc(…)`, which lacks `place`.
    fn lacks_its_word(&mut self, name: &Ident, mark: Span) {
        let line = self.text.get(mark.range().end..).unwrap_or_default();
        let line = line.lines().next().unwrap_or_default();
        let shape = line.split('=').nth(1).unwrap_or_default().trim_start();
        let word = match shape.split('(').next() {
            Some("line" | "polyline" | "path" | "wall") => "wall",
            _ => "place",
        };
        let message = format!("`{}` is given a kind, and is no setting", name.name);
        let diagnostic = Diagnostic::new(Code::E0101, name.span, message)
            .label(format!("did you mean `{word} {}`?", name.name))
            .fix(
                format!("put `{word}` before it"),
                name.span.before(),
                format!("{word} "),
                Applicability::Unsafe,
            );
        self.report(diagnostic);
    }
}
