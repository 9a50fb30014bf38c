//! Worlds.

use super::Builder;
use crate::syntax::ast::{
    Expr, Field, Ident, RobotEntry, RobotEntryKind, World, WorldEntry, WorldEntryKind,
};
use crate::syntax::grammar::{Node, Parts, Rule};

impl<'i> Builder<'i> {
    pub(super) fn world(&mut self, node: Node<'i>) -> World {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_world);
        let name = self.take_name(&mut parts);
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut entries = Vec::new();
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            let span = self.span(&part);
            let docs = self.docs(start);
            let kind = match part.as_rule() {
                Rule::stray_mark => {
                    self.stray_mark(&part);
                    continue;
                }
                Rule::close_brace | Rule::missing_close => {
                    self.close(Some(part), open);
                    continue;
                }
                Rule::bad_entry => {
                    self.bad(&part, Rule::strict_world_entry, previous);
                    WorldEntryKind::Error
                }
                Rule::place => self.place(part),
                Rule::wall => self.wall(part),
                Rule::robot => self.robot(part),
                _ => WorldEntryKind::Field(self.field(part)),
            };
            previous = Some(start);
            entries.push(WorldEntry { docs, kind, span });
        }
        World { name, entries }
    }

    fn place(&mut self, node: Node<'i>) -> WorldEntryKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_place);
        let (name, of_kind, shape) = self.shape(&mut parts);
        let facing = parts
            .has(Rule::kw_facing)
            .then(|| self.take_expr(&mut parts));
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
        let open = parts.maybe(Rule::open_brace).map(|node| self.span(&node));
        let mut entries = Vec::new();
        let mut previous = None;
        for part in parts {
            let start = part.as_span().start();
            let span = self.span(&part);
            let docs = self.docs(start);
            let kind = match part.as_rule() {
                Rule::stray_mark => {
                    self.stray_mark(&part);
                    continue;
                }
                Rule::close_brace | Rule::missing_close => {
                    self.close(Some(part), open);
                    continue;
                }
                Rule::bad_entry => {
                    self.bad(&part, Rule::strict_robot_entry, previous);
                    RobotEntryKind::Error
                }
                Rule::sensor => self.sensor(part),
                _ => RobotEntryKind::Field(self.field(part)),
            };
            previous = Some(start);
            entries.push(RobotEntry { docs, kind, span });
        }
        WorldEntryKind::Robot { name, entries }
    }

    fn sensor(&mut self, node: Node<'i>) -> RobotEntryKind {
        let mut parts = Parts::of(node);
        parts.has(Rule::kw_sensor);
        let name = self.take_name(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        RobotEntryKind::Sensor { name, value }
    }

    fn field(&mut self, node: Node<'i>) -> Field {
        let mut parts = Parts::of(node);
        let name = self.take_name(&mut parts);
        self.take_is(&mut parts);
        let value = self.take_expr(&mut parts);
        Field { name, value }
    }
}
