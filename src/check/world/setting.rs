//! Fields and settings of the world: given by name, at most once, constant.

use crate::check::Checker;
use crate::check::signature::{Signature, Takes};
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code, suggest};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, Field, Ref};
use crate::syntax::words::{SHAPES, home};

/// The values of settings, each with its place.
type Values<const N: usize> = [(f64, Span); N];

/// A setting: its name, its type and its default.
pub type Setting = (&'static str, Type, Option<f64>);

impl<'a> Checker<'a> {
    /// Constant settings by name; those without a default have to be there. Values with their places, in the order of
    /// `wanted`.
    pub fn settings<const N: usize>(
        &mut self,
        reference: &'a Ref,
        wanted: [Setting; N],
    ) -> Option<Values<N>> {
        self.settings_after(None, reference, wanted).1
    }

    /// Settings of which the `first` is not a constant: what it is given, and the values of the others.
    pub fn settings_after<const N: usize>(
        &mut self,
        first: Option<&'static str>,
        reference: &'a Ref,
        wanted: [Setting; N],
    ) -> (Option<&'a Expr>, Option<Values<N>>) {
        let names = wanted.iter().map(|(name, ..)| *name);
        let names: Vec<&str> = first.into_iter().chain(names).collect();
        let owner = format!("`{}(…)`", reference.name.name);
        let signature = Signature {
            owner: &owner,
            takes: Takes::Settings { names: &names },
        };
        let matched = self.matched(&signature, reference.args.as_deref().unwrap_or_default());
        let mut given = matched.values();
        let first = first.and_then(|_| given.next().flatten());
        let mut values = Vec::new();
        let mut missed = false;
        for ((name, ty, default), given) in wanted.iter().zip(given) {
            let value = match (given, default) {
                (Some(value), _) => self
                    .constant(value, ty, &format!("`{name}`"))
                    .map(|number| (number, value.span)),
                (None, Some(default)) => Some((*default, reference.span)),
                (None, None) => {
                    if matched.fine && !missed {
                        let span = reference.name.span;
                        self.missing(Code::E0402, span, &owner, name, example(name));
                        // Of one without any settings it is enough to show one.
                        missed = reference.args.as_ref().is_none_or(Vec::is_empty);
                    }
                    None
                }
            };
            values.extend(value);
        }
        let values = values.try_into().ok().filter(|_| matched.fine);
        (first, values)
    }

    /// The fields of that name, in the order of `known`; what is unknown or there twice is reported.
    pub fn fields<const N: usize>(
        &mut self,
        fields: impl Iterator<Item = &'a Field>,
        known: [&str; N],
        owner: &str,
    ) -> [Option<&'a Field>; N] {
        let mut found = [None; N];
        let mut unknown: Vec<&str> = Vec::new();
        for field in fields {
            let name = &field.name;
            let at = known.iter().position(|known| *known == name.name);
            match at.and_then(|at| found.get_mut(at)) {
                None => {
                    let value = match &field.value.kind {
                        ExprKind::Ref(reference) => reference.name.name.as_str(),
                        _ => "",
                    };
                    let called = &name.name;
                    let likely = suggest::nearest(called, known);
                    let form = match (called.as_str(), value) {
                        _ if likely.is_some() => None,
                        (word, _)
                            if home(word).is_some_and(|(whole, _)| !owner.contains(whole))
                                && !matches!(word, "wall" | "place" | "robot" | "sensor") =>
                        {
                            home(word).map(|(whole, example)| {
                                format!("this stands in {whole}: `{example}`")
                            })
                        }
                        ("wall" | "place" | "robot" | "sensor", _) => {
                            Some(format!("it needs a name: `{called} NAME = …`"))
                        }
                        (_, "scanner" | "range_finder" | "beacon") => {
                            Some(format!("a sensor is declared by `sensor {called} = …`"))
                        }
                        (_, shape) if SHAPES.contains(&shape) => Some(format!(
                            "a place is declared by `place {called} = …`, a wall by `wall {called} = …`"
                        )),
                        _ => None,
                    };
                    self.names.lose(called);
                    // `wall … when = not open`, `place … facing = 90 deg`
                    if let Some(behind) = behind_a_shape(called)
                        && !known.contains(&called.as_str())
                    {
                        let sign = name.span.after().to(field.value.span.before());
                        self.error(
                            Code::E0403,
                            name.span,
                            format!("{owner} has no field `{called}`"),
                        )
                        .label(behind)
                        .fix("drop `=`", sign, " ", Applicability::Unsafe);
                        continue;
                    }
                    // What it was to be called, nobody knows.
                    self.names.lost_values |=
                        matches!(called.as_str(), "wall" | "place" | "robot" | "sensor");
                    self.unknown_to(owner, Code::E0403, name, "field", &known)
                        .help_if(form);
                }
                Some(free @ None) => *free = Some(field),
                Some(Some(first)) => self.said_twice(&name.name, name.span, first.name.span),
            }
            // What is missing was likely meant by what is unknown.
            if at.is_none() {
                for (known, found) in known.iter().zip(&found) {
                    if found.is_none() {
                        unknown.push(*known);
                    }
                }
            }
        }
        for (known, found) in known.iter().zip(&found) {
            if found.is_none() && unknown.contains(known) {
                self.names.lose(known);
            }
        }
        found
    }
}

/// What a word says that stands behind the shape of a wall or a place, without `=`.
fn behind_a_shape(word: &str) -> Option<&'static str> {
    match word {
        "when" => Some("when a wall is shut is said behind its shape, without `=`"),
        "facing" => Some("which way a place faces is said behind its shape, without `=`"),
        _ => None,
    }
}

/// An example of a setting.
fn example(setting: &str) -> &'static str {
    match setting {
        "max_speed" => "max_speed = 0.4 m/s",
        "max_turn" => "max_turn = 2 rad/s",
        "from" => "from = -90 deg",
        "to" => "to = 90 deg",
        "at" => "at = 0 deg",
        _ => "range = 3 m",
    }
}
