//! Parameters, and the arguments that references give them.

use crate::check::Checker;
use crate::check::context::{Binding, Context, Region};
use crate::check::expr::expect::{Role, is_literal};
use crate::check::names::Decl;
use crate::check::report::listed;
use crate::check::signature::{Signature, Takes};
use crate::check::types::{Type, Value};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::source::Span;
use crate::syntax::ast::{Arg, ArgKind, Expr, ExprKind, Param, Params, Ref};
use crate::syntax::print;
use std::collections::BTreeSet;

impl<'a> Checker<'a> {
    /// Parameters that are known by their type only.
    pub fn unknown_parameters(&mut self, params: Option<&'a Params>) -> Vec<Binding<'a>> {
        let mut bindings: Vec<Binding<'a>> = Vec::new();
        for param in params.map_or(&[][..], |params| &params.params) {
            let name = &param.name;
            let mut ty = self.type_expr(&param.ty);
            if let Some(default) = &param.default {
                let role = format!("`{}`", name.name);
                let region = std::mem::replace(&mut self.context.region, Region::Let);
                let value = self.expect(default, &ty, &role);
                self.context.region = region;
                // Which of the two is right nobody knows, unless it is only the unit that is missing.
                if value.ty == Type::Error && !is_literal(default) {
                    ty = Type::Error;
                    self.unsure.push(param.span);
                }
            }
            if let Some(first) = bindings.iter().find(|other| other.name.name == name.name) {
                self.error(
                    Code::E0201,
                    name.span,
                    format!("two parameters are called `{}`", name.name),
                )
                .label("declared again here")
                .also(first.name.span, "first declared here");
            }
            self.binds(name, "parameter");
            self.is_of_type(name, &ty);
            self.parameter_types.insert(name.span, param.ty.span);
            bindings.push(Binding::unknown(name, ty));
        }
        bindings
    }

    /// The parameters of a declaration with the values that a reference gives them, by position, by name or by
    /// default; `library` says whether the declaration is of the library. Every mistake is reported; `None` if there
    /// are any.
    pub fn bind_arguments(
        &mut self,
        params: Option<&'a Params>,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Vec<Binding<'a>>> {
        let params: &'a [Param] = params.map_or(&[], |params| &params.params);
        let name = &reference.name.name;
        let names: Vec<&str> = params
            .iter()
            .map(|param| param.name.name.as_str())
            .collect();
        if params.is_empty() && self.names.lacking.contains(name) {
            return None;
        }
        let signature = Signature {
            owner: &format!("`{name}`"),
            takes: Takes::Parameters {
                names: &names,
                words: &words(params),
            },
        };
        let args = reference.args.as_deref().unwrap_or_default();
        for arg in args {
            if let ArgKind::Named(given, _) = &arg.kind
                && let Some(param) = params.iter().find(|it| it.name.name == given.name)
            {
                self.stands_for(given, param.name.span);
            }
        }
        if self.point_in_two(params, library, args, name) {
            return None;
        }
        let told = self.diagnostics.len();
        let matched = self.matched(&signature, args);
        if !library && !matched.fine {
            self.hides_the_library(name, told);
        }
        let called = self.names.value(name, self.context.library);
        let makes_instance = !matches!(called, Some((Decl::Let(_), _)));
        let mut fine = matched.fine;
        let mut bindings: Vec<Binding<'a>> = Vec::new();
        for (param, given) in params.iter().zip(matched.values()) {
            let role = Role::Argument(&param.name.name, name);
            let ty = match self.unsure.contains(&param.span) {
                true => Type::Error,
                false => self.in_library(library, |checker| checker.type_expr(&param.ty)),
            };
            let again = |arg: &Arg| match &arg.kind {
                ArgKind::Named(name, value) => {
                    let other = given.is_some_and(|given| given.span != value.span);
                    name.name == param.name.name && other
                }
                _ => false,
            };
            let value = match (given, &param.default) {
                // That it is given twice has been told.
                (Some(_), _) if args.iter().any(again) => {
                    fine = false;
                    continue;
                }
                (Some(value), _) => {
                    let to = makes_instance.then_some((name.as_str(), param.name.name.as_str()));
                    let outer = std::mem::replace(&mut self.given, to);
                    let typed = self.expr_like(value, &ty);
                    if !library && !typed.ty.fits(&ty) {
                        self.clashes_with_parameter(&param.name, &ty, &typed);
                    }
                    let value = self.coerce(typed, value, &ty, role);
                    self.given = outer;
                    value
                }
                // A default of another type has been reported where it stands.
                (None, Some(_)) if ty == Type::Error => {
                    fine = false;
                    continue;
                }
                // So has a second parameter of one name.
                (None, None) if bindings.iter().any(|it| it.name.name == param.name.name) => {
                    fine = false;
                    continue;
                }
                (None, Some(default)) => {
                    let context = Context {
                        region: Region::Let,
                        library,
                        scope: bindings.clone(),
                        ended: BTreeSet::new(),
                        argument: None,
                        is_given: false,
                    };
                    let outer = std::mem::replace(&mut self.context, context);
                    let (value, _) =
                        self.captured(|checker| checker.expect(default, &ty, "a default"));
                    self.context = outer;
                    value
                }
                (None, None) => {
                    // If another argument is wrong, it may be the missing one.
                    let known = !param.ty.factors.is_empty();
                    if fine && known {
                        let help = self.one_or_all(name, &param.name.name, &ty, params);
                        self.error(
                            Code::E0305,
                            reference.span,
                            format!("`{name}` needs its argument `{}`", param.name.name),
                        )
                        .label(format!("{ty} is missing"))
                        .also(param.span, "it is declared here")
                        .help_if(help);
                    }
                    fine = false;
                    continue;
                }
            };
            let own = value.value == Value::Robot(self.subject);
            if own && library && makes_instance && self.reader_is_known() {
                let label = format!("the target of `{name}` is read");
                self.reads_itself(reference.span, &label);
                fine = false;
                continue;
            }
            fine &= value.ty != Type::Error;
            let ty = if ty == Type::Error { value.ty } else { ty };
            bindings.push(Binding {
                given: given.map(|given| self.argument(given, &ty, &value.value)),
                ..Binding::new(&param.name, ty, value.value)
            });
        }
        if !fine {
            self.swapped(params, library, args, told);
        }
        fine.then_some(bindings)
    }

    /// Reports `turn_to(4 m, 2 m)`: the coordinates of a point as two arguments.
    fn point_in_two(
        &mut self,
        params: &'a [Param],
        library: bool,
        args: &'a [Arg],
        owner: &str,
    ) -> bool {
        let number = |arg: &'a Arg| match &arg.kind {
            ArgKind::Positional(value) if is_number(value) => Some(value),
            _ => None,
        };
        let mut pairs = params.iter().zip(args.iter().zip(args.iter().skip(1)));
        let pair = pairs.find_map(|(param, (x, y))| {
            let ty = self.in_library(library, |checker| checker.type_expr(&param.ty));
            let (x, y) = (number(x)?, number(y)?);
            matches!(ty, Type::Target | Type::Point | Type::Place(_)).then_some((param, ty, x, y))
        });
        let Some((param, ty, x, y)) = pair else {
            return false;
        };
        let span = x.span.to(y.span);
        let message = format!(
            "`{}` of `{owner}` is {ty}, not two numbers",
            param.name.name
        );
        let draft = self.error(Code::E0302, span, message);
        match ty {
            Type::Place(_) => draft
                .label("a place has a name")
                .help(format!(
                    "give it one in the world: `place NAME = disc(({}, {}), 20 cm)`",
                    print::expr(x),
                    print::expr(y)
                ))
                .emit(),
            _ => draft
                .label("a point is written `(x, y)`")
                .fix(
                    format!("write `({}, {})`", print::expr(x), print::expr(y)),
                    span,
                    format!("({}, {})", print::expr(x), print::expr(y)),
                    Applicability::Unsafe,
                )
                .emit(),
        }
        true
    }

    /// How one member of a family is named, and all of them, for who has named the family alone.
    fn one_or_all(
        &mut self,
        family: &str,
        param: &str,
        ty: &Type,
        params: &[Param],
    ) -> Option<String> {
        let kind = match ty {
            Type::Place(Some(kind)) | Type::Wall(Some(kind)) | Type::Enum(kind) => kind,
            _ => return None,
        };
        if params.len() > 1 {
            return None;
        }
        let first = self.members(ty)?.into_iter().next()?;
        let first = self.name_of(ty, &first)?;
        Some(format!(
            "one of them is `{family}({first})`; where a list or a line may range over all, they are `{family}({param} in {kind})`"
        ))
    }

    /// Makes one mistake of two arguments of which each is of the type of the other's parameter. What has been told of
    /// the call begins at `told`.
    fn swapped(&mut self, params: &'a [Param], library: bool, args: &'a [Arg], told: usize) {
        let ([first, second], [one, other]) = (params, args) else {
            return;
        };
        let value = |arg: &'a Arg| match &arg.kind {
            ArgKind::Positional(value) => Some(value),
            ArgKind::Binder { member, .. } => Some(&**member),
            _ => None,
        };
        let (Some(a), Some(b)) = (value(one), value(other)) else {
            return;
        };
        let of_both = self.diagnostics.get(told..).is_some_and(|found| {
            let places: Vec<Span> = found.iter().map(Diagnostic::span).collect();
            places == [a.span, b.span]
        });
        if !of_both {
            return;
        }
        let mut fits = |value: &'a Expr, param: &'a Param| {
            let wanted = self.in_library(library, |checker| checker.type_expr(&param.ty));
            let (typed, _) = self.captured(|checker| checker.expr(value));
            typed.ty != Type::Error && typed.ty.fits(&wanted)
        };
        if fits(a, second) && fits(b, first) {
            self.diagnostics.truncate(told);
            let right = format!("{}, {}", print::argument(other), print::argument(one));
            self.stand_around(one.span.to(other.span), right);
        }
    }

    /// Reports two arguments that stand in each other's place.
    pub fn the_other_way_around(&mut self, first: &Expr, second: &Expr) {
        let right = format!("{}, {}", print::expr(second), print::expr(first));
        self.stand_around(first.span.to(second.span), right);
    }

    fn stand_around(&mut self, span: Span, right: String) {
        self.error(
            Code::E0305,
            span,
            "two arguments stand the other way around",
        )
        .write(span, right, Applicability::Unsafe);
    }

    /// Notes at the mistakes with the arguments of a name, told since so many diagnostics, that the library has it, too.
    fn hides_the_library(&mut self, name: &str, told: usize) {
        let Some((Decl::Behavior(behavior), true)) = self.names.value(name, true) else {
            return;
        };
        let params = behavior.params.as_ref();
        let params = params.map_or(&[][..], |params| params.params.as_slice());
        let names: Vec<&str> = params
            .iter()
            .map(|param| param.name.name.as_str())
            .collect();
        let takes = match names.is_empty() {
            true => "no arguments".to_owned(),
            false => listed(&names, "and"),
        };
        let note = format!(
            "the library's `{name}` takes {takes}, but here the one of this program counts"
        );
        let found = self.diagnostics.get_mut(told..).unwrap_or_default();
        for found in found {
            *found = found.clone().note(note.clone());
        }
    }

    fn in_library<T>(&mut self, library: bool, pass: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.context.library, library);
        let result = pass(self);
        self.context.library = outer;
        result
    }
}

/// Whether an expression is a number, perhaps signed.
fn is_number(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Number(_) => true,
        ExprKind::Unary { operand, .. } => is_number(operand),
        _ => false,
    }
}

/// How many arguments parameters take, in words.
fn words(params: &[Param]) -> String {
    let most = if params.iter().any(|param| param.default.is_some()) {
        "at most "
    } else {
        ""
    };
    match params.len() {
        0 => "no arguments".to_owned(),
        1 => format!("{most}one argument"),
        n => format!("{most}{n} arguments"),
    }
}
