//! Fields and settings of the world: each by its name, each once, constants all.

use crate::check::Checker;
use crate::check::names::{listed, stranger};
use crate::check::types::Type;
use crate::diagnostic::{Applicability, Code, Diagnostic, suggest};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Expr, ExprKind, Field, Ident, Ref};

impl<'a> Checker<'a> {
    /// Constant settings by name; those without a default have to be there. Values with their places, in the order of
    /// `wanted`.
    pub fn settings(
        &mut self,
        reference: &'a Ref,
        wanted: &[(&str, Type, Option<f64>)],
    ) -> Option<Vec<(f64, Span)>> {
        let args: &'a [Arg] = reference.args.as_deref().unwrap_or_default();
        let fine = self.settings_by_name(reference, args, wanted);
        let mut values = Vec::new();
        for (name, ty, default) in wanted {
            let given = args.iter().find_map(|arg| match &arg.kind {
                ArgKind::Named(known, value) if known.name == *name => Some(value),
                _ => None,
            });
            let value = match (given, default) {
                (Some(value), _) => self
                    .constant(value, ty, &format!("`{name}`"))
                    .map(|number| (number, value.span)),
                (None, Some(default)) => Some((*default, reference.span)),
                (None, None) if fine => {
                    let owner = format!("`{}(…)`", reference.name.name);
                    self.missing(reference.name.span, &owner, name, example(name));
                    None
                }
                (None, None) => None,
            };
            values.push(value);
        }
        let values: Option<Vec<_>> = values.into_iter().collect();
        values.filter(|_| fine)
    }

    /// Whether every setting is a known one, said by its name and once; what is not is reported.
    fn settings_by_name(
        &mut self,
        reference: &Ref,
        args: &'a [Arg],
        wanted: &[(&str, Type, Option<f64>)],
    ) -> bool {
        let owner = format!("`{}(…)`", reference.name.name);
        let mut known: Vec<&str> = wanted.iter().map(|(name, ..)| *name).collect();
        if reference.name.name == "beacon" {
            known.insert(0, "target");
        }
        let mut said: Vec<&Ident> = Vec::new();
        let mut fine = true;
        for arg in args {
            match &arg.kind {
                ArgKind::Named(name, _) => {
                    if let Some(first) = said.iter().find(|first| first.name == name.name) {
                        self.report(said_twice(name, first.span));
                        fine = false;
                    } else if !known.contains(&name.name.as_str()) {
                        self.report(stranger(Code::E0403, name, &owner, "setting", &known));
                        fine = false;
                    }
                    said.push(name);
                }
                ArgKind::Positional(_) | ArgKind::Binder { .. } => {
                    // One message is enough to say that all of them need their names.
                    if fine {
                        self.report(
                            Diagnostic::new(
                                Code::E0305,
                                arg.span,
                                format!("{owner} takes its settings by name"),
                            )
                            .label("which setting is this?")
                            .help(format!("it has {}", listed(&known, "and"))),
                        );
                    }
                    fine = false;
                }
            }
        }
        fine
    }

    /// Reports fields that are unknown or there twice.
    pub fn fields(&mut self, fields: &[&'a Field], known: &[&str], what: &str) {
        for (i, field) in fields.iter().enumerate() {
            let name = &field.name;
            let before = fields
                .iter()
                .take(i)
                .find(|other| other.name.name == name.name);
            if let Some(first) = before {
                self.report(said_twice(name, first.name.span));
            } else if !known.contains(&name.name.as_str()) {
                self.report(stranger(Code::E0403, name, what, "field", known));
            }
        }
    }

    pub fn missing(&mut self, span: Span, owner: &str, missing: &str, example: &str) {
        self.report(
            Diagnostic::new(
                Code::E0402,
                span,
                format!("{owner} does not say its `{missing}`"),
            )
            .label(format!("`{missing}` is missing"))
            .help(format!("for example: `{example}`")),
        );
    }

    /// Reports a value that is none of the words that can stand there.
    pub fn choice_of(&mut self, value: &Expr, what: &str, choices: &[&str]) {
        let name = match &value.kind {
            ExprKind::Error => return,
            ExprKind::Ref(reference) => Some(&reference.name),
            _ => None,
        };
        let span = name.map_or(value.span, |name| name.span);
        let mut diagnostic = Diagnostic::new(
            Code::E0403,
            span,
            format!("{what} is {}", listed(choices, "or")),
        )
        .label("this is not");
        let words = choices
            .iter()
            .filter_map(|choice| choice.split('(').next().filter(|word| !word.is_empty()));
        if let Some(likely) = name.and_then(|name| suggest::nearest(&name.name, words)) {
            let question = format!("did you mean `{likely}`?");
            diagnostic = diagnostic.label(question.clone()).fix(
                question,
                span,
                likely,
                Applicability::Unsafe,
            );
        }
        self.report(diagnostic);
    }

    pub fn positive(&mut self, value: f64, span: Span) -> Option<()> {
        if value > 0.0 {
            return Some(());
        }
        self.out_of_range(span, "a range is above zero", "this would sense nothing");
        None
    }

    /// A number that makes no sense where it stands.
    pub fn out_of_range(&mut self, span: Span, why: &str, label: &str) {
        self.report(Diagnostic::new(Code::E0309, span, why).label(label));
    }
}

/// A field or a setting that is there a second time.
pub fn said_twice(name: &Ident, first: Span) -> Diagnostic {
    Diagnostic::new(
        Code::E0503,
        name.span,
        format!("`{}` is there twice", name.name),
    )
    .label("said again here")
    .also(first, "first said here")
}

/// How a setting could look.
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
