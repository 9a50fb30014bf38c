//! Sensors of a robot.

use crate::check::Checker;
use crate::check::types::{Type, Value};
use crate::diagnostic::Code;
use crate::geometry::Point;
use crate::ir::Name;
use crate::ir::world::{Sensor, SensorKind};
use crate::math::wrap;
use crate::source::Span;
use crate::syntax::ast::{self, Expr, ExprKind};
use std::f64::consts::{PI, TAU};

/// The kinds of sensors, as a message lists them.
const SENSORS: [&str; 3] = ["scanner(…)", "range_finder(…)", "beacon(…)"];

impl<'a> Checker<'a> {
    /// `sensor name = scanner(…)`, `range_finder(…)`, `beacon(…)`
    pub fn sensor(&mut self, name: &'a ast::Ident, value: &'a Expr) -> Option<Sensor> {
        let ExprKind::Ref(reference) = &value.kind else {
            self.choice_of(value, "a sensor", &SENSORS);
            return None;
        };
        let noise = ("noise", Type::LENGTH, Some(0.0));
        let (kind, noise) = match reference.name.name.as_str() {
            "scanner" => {
                let [(from, at), (to, _), (range, far), noise] = self.settings(
                    reference,
                    [
                        ("from", Type::ANGLE, None),
                        ("to", Type::ANGLE, None),
                        ("range", Type::LENGTH, None),
                        noise,
                    ],
                )?;
                if !(from < to && to - from <= TAU + 1e-9) {
                    return self
                        .out_of_range(
                            at,
                            "a sector goes counter-clockwise, at most once round",
                            "`to` lies above this, by 360 deg at most",
                        )
                        .none();
                }
                self.positive("a range", range, far)?;
                (SensorKind::Scanner { from, to, range }, noise)
            }
            "range_finder" => {
                let [(at, _), (range, far), noise] = self.settings(
                    reference,
                    [
                        ("at", Type::ANGLE, None),
                        ("range", Type::LENGTH, None),
                        noise,
                    ],
                )?;
                self.positive("a range", range, far)?;
                (SensorKind::RangeFinder { at, range }, noise)
            }
            "beacon" => {
                let (target, settings) = self.settings_after(
                    Some("target"),
                    reference,
                    [
                        ("range", Type::LENGTH, None),
                        ("sector", Type::ANGLE, Some(TAU)),
                        noise,
                    ],
                );
                // What has no name may be the target.
                if target.is_none() && settings.is_none() {
                    return None;
                }
                let (target, facing) = self.beacon_target(target, reference.name.span)?;
                let [(range, far), (sector, width), noise] = settings?;
                self.positive("a range", range, far)?;
                self.positive("a sector", sector, width)?;
                if sector > TAU + 1e-9 {
                    let message = "a sector is at most once round";
                    return self
                        .out_of_range(width, message, "this is more than 360 deg")
                        .none();
                }
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
            noise: self.noise(noise)?,
        })
    }

    /// Noise, which is a standard deviation.
    pub fn noise(&mut self, (noise, span): (f64, Span)) -> Option<f64> {
        if noise >= 0.0 {
            return Some(noise);
        }
        self.out_of_range(
            span,
            "noise is not below zero",
            "this is a standard deviation: how far the values scatter",
        )
        .none()
    }

    /// The `target` of a beacon: a place, whose `facing` is the way that it sends, against the robot that faces it.
    fn beacon_target(&mut self, target: Option<&'a Expr>, beacon: Span) -> Option<(Point, f64)> {
        let Some(target) = target else {
            let example = "beacon(target = C, …)";
            self.missing(Code::E0402, beacon, "`beacon(…)`", "target", example);
            return None;
        };
        let target = self.expect(target, &Type::Place(None), "the target of a beacon");
        let Value::Place(id) = target.value else {
            return None;
        };
        let place = &self.program.world.as_ref()?.places[id];
        let sends = place.facing.map_or(0.0, |facing| wrap(facing + PI));
        Some((place.shape.center(), sends))
    }

    fn positive(&mut self, what: &str, value: f64, span: Span) -> Option<()> {
        if value > 0.0 {
            return Some(());
        }
        let message = format!("{what} is above zero");
        self.out_of_range(span, message, "this would sense nothing")
            .none()
    }
}
