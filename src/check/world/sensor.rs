//! Sensors of a robot.

use crate::check::Checker;
use crate::check::types::units::Dim;
use crate::check::types::{Type, Value};
use crate::ir::Name;
use crate::ir::world::{Point, Sensor, SensorKind};
use crate::syntax::ast::{self, ArgKind, Expr, ExprKind, Ref};
use std::f64::consts::TAU;

/// What a sensor can be, as it is offered.
const SENSORS: [&str; 3] = ["scanner(…)", "range_finder(…)", "beacon(…)"];

impl<'a> Checker<'a> {
    /// `sensor name = scanner(…)`, `range_finder(…)`, `beacon(…)`
    pub fn sensor(&mut self, name: &'a ast::Ident, value: &'a Expr) -> Option<Sensor> {
        let ExprKind::Ref(reference) = &value.kind else {
            self.choice_of(value, "a sensor", &SENSORS);
            return None;
        };
        let angle = Type::Quantity(Dim::ANGLE);
        let length = Type::Quantity(Dim::LENGTH);
        let noise = ("noise", length.clone(), Some(0.0));
        let (kind, noise) = match reference.name.name.as_str() {
            "scanner" => {
                let set = self.settings(
                    reference,
                    &[
                        ("from", angle.clone(), None),
                        ("to", angle, None),
                        ("range", length, None),
                        noise,
                    ],
                )?;
                let [(from, at), (to, _), (range, far), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                if !(from < to && to - from <= TAU + 1e-9) {
                    self.out_of_range(
                        at,
                        "a sector goes counter-clockwise, at most once round",
                        "`to` lies above this, by 360 deg at most",
                    );
                    return None;
                }
                self.positive(range, far)?;
                (SensorKind::Scanner { from, to, range }, noise)
            }
            "range_finder" => {
                let set = self.settings(
                    reference,
                    &[("at", angle, None), ("range", length, None), noise],
                )?;
                let [(at, _), (range, far), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                self.positive(range, far)?;
                (SensorKind::RangeFinder { at, range }, noise)
            }
            "beacon" => {
                let (target, facing) = self.beacon_target(reference)?;
                let set = self.settings(
                    reference,
                    &[("range", length, None), ("sector", angle, Some(TAU)), noise],
                )?;
                let [(range, far), (sector, _), (noise, _)] = *set.as_slice() else {
                    return None;
                };
                self.positive(range, far)?;
                let kind = SensorKind::Beacon {
                    target,
                    range,
                    facing,
                    sector,
                };
                (kind, noise)
            }
            _ => {
                self.choice_of(value, "a sensor", &SENSORS);
                return None;
            }
        };
        Some(Sensor {
            name: Name::word(&name.name),
            kind,
            noise,
        })
    }

    /// The `target` of a beacon: a place, whose `facing` is the way that it sends, against the robot that faces it.
    fn beacon_target(&mut self, reference: &'a Ref) -> Option<(Point, f64)> {
        let named = reference
            .args
            .iter()
            .flatten()
            .find_map(|arg| match &arg.kind {
                ArgKind::Named(name, value) if name.name == "target" => Some(value),
                _ => None,
            });
        let Some(value) = named else {
            self.missing(
                reference.name.span,
                "`beacon(…)`",
                "target",
                "beacon(target = C, …)",
            );
            return None;
        };
        let target = self.expect(value, &Type::Place(None), "the target of a beacon");
        let Value::Place(id) = target.value else {
            return None;
        };
        let place = &self.program.world.as_ref()?.places[id];
        let sends = place.facing.map_or(0.0, |facing| {
            crate::math::wrap(facing + std::f64::consts::PI)
        });
        Some((place.shape.center(), sends))
    }
}
