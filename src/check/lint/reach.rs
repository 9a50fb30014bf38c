//! Stations that are so large that who arrives there is not near enough to dock.

use crate::check::Checker;
use crate::diagnostic::Code;
use crate::ir::expr::{Binary, Expr, ExprId};
use crate::ir::law::Behavior;
use crate::ir::world::{Place, World};
use crate::source::Span;
use crate::syntax::ast::Ident;

/// What a length may be off.
const SLACK: f64 = 1e-9;

/// Behaviours that bring a robot no nearer to a place than its rim, or not to it at all.
const NOT_NEARER: [&str; 4] = ["goto", "dock", "turn_to", "flee"];

impl<'a> Checker<'a> {
    /// Warns of places at which the robot docks, and farther from whose centre it stops.
    pub fn stations_out_of_reach<'w>(
        &mut self,
        places: impl Iterator<Item = (&'a Ident, Span, &'w Place)>,
        world: &World,
    ) {
        let drive = &world.robot.drive;
        let step = (drive.max_speed + 4.0 * drive.speed_noise) * world.tick;
        for (name, span, place) in places {
            let here: Vec<&Behavior> = self.brought_to(place).collect();
            let arrives = here.iter().find(|it| it.name.family == "goto");
            let Some(radius) = arrives.and_then(|it| self.ends_within(it)) else {
                continue;
            };
            let nearer = |it: &&Behavior| !NOT_NEARER.contains(&it.name.family.as_str());
            let reach = here.iter().filter(|it| it.name.family == "dock");
            let reach = reach.filter_map(|it| self.reach_of(it)).reduce(f64::max);
            let Some(reach) = reach.filter(|reach| radius - step > reach + SLACK) else {
                continue;
            };
            if here.iter().any(nearer) {
                continue;
            }
            let called = &name.name;
            let (radius, nearest, reach) = (
                centimetres(radius),
                centimetres(radius - step),
                centimetres(reach),
            );
            self.warning(
                Code::W0402,
                span,
                format!("`dock({called})` fails where `goto({called})` ends"),
            )
            .label(format!(
                "who comes in stops at {nearest} cm or more from the centre, and docks within {reach} cm"
            ))
            .help(format!(
                "let its radius be {reach} cm, or write `dock({called}, reach = {radius} cm)`"
            ));
        }
    }

    /// The behaviours of the robot that learns that are given a place first.
    fn brought_to(&self, place: &Place) -> impl Iterator<Item = &Behavior> {
        let called = place.name.to_string();
        self.program.behaviors.values().filter(move |behavior| {
            let first = behavior.name.given().next();
            let first = first.map(|(_, given)| given.to_string());
            behavior.name.robot().is_none() && first.as_ref() == Some(&called)
        })
    }

    /// Within which distance a behaviour can be, if that is all that it requires.
    pub fn reach_of(&self, behavior: &Behavior) -> Option<f64> {
        self.at_most(behavior.law.as_ref()?.requires)
    }

    /// Within which distance a behaviour succeeds, if that is all that it asks.
    fn ends_within(&self, behavior: &Behavior) -> Option<f64> {
        self.at_most(behavior.law.as_ref()?.succeed)
    }

    /// The constant that a distance is at most.
    fn at_most(&self, asked: ExprId) -> Option<f64> {
        let pool = &self.program.pool;
        match pool.get(asked) {
            Expr::Binary(Binary::Le, distance, most) => {
                let is_distance = matches!(pool.get(distance), Expr::Binary(Binary::Hypot, ..));
                pool.constant(most).filter(|_| is_distance)
            }
            _ => None,
        }
    }
}

/// A length in centimetres, as it is told.
fn centimetres(length: f64) -> f64 {
    (length * 1000.0).round() / 10.0
}
