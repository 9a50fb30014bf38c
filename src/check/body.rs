//! Bodies: checked once for themselves, and once more wherever they are used.

use super::Checker;
use super::context::{Binding, Context, Region};
use crate::diagnostic::{Code, Diagnostic, Label};
use crate::source::Span;
use crate::syntax::ast::{Ident, Ref};
use std::collections::{BTreeMap, BTreeSet};

/// How many bodies may be checked within one another.
const DEEP: usize = 48;

/// How many bodies a program may unroll altogether.
const MANY: usize = 200_000;

/// The bodies that have been checked or are being checked.
#[derive(Debug, Default)]
pub struct Bodies<'a> {
    /// Whether the body that starts at this place was free of mistakes when it was checked for itself.
    pub clean: BTreeMap<Span, bool>,
    /// The bodies that are being checked within one another, to find circles.
    pub open: Vec<Open<'a>>,
    /// Whether the tree at hand is run by the robot that learns, and by no other.
    pub of_the_acting: bool,
    /// How many bodies have been unrolled so far.
    unrolled: usize,
    /// Whether it was reported that definitions grow too large.
    gave_up: bool,
}

impl<'a> Bodies<'a> {
    /// Whether the body that starts at this place is being checked.
    pub fn is_open(&self, at: Span) -> bool {
        self.open.iter().any(|open| open.at == at)
    }

    /// The bodies from the one that starts at this place to the one at hand, each of which uses the next.
    fn circle(&self, at: Span) -> Vec<Open<'a>> {
        let mut circle: Vec<Open<'a>> = Vec::new();
        for open in self.open.iter().skip_while(|open| open.at != at) {
            if circle.iter().all(|other| other.at != open.at) {
                circle.push(*open);
            }
        }
        circle
    }

    /// Whether the body at hand is checked for itself.
    pub fn for_itself(&self) -> bool {
        self.open.last().is_some_and(|open| !open.unrolls)
    }

    /// Whether it is left open which robot reads what is at hand: it is checked for itself, or for a body that is.
    pub fn of_any_robot(&self) -> bool {
        let known = |open: &Open| open.unrolls || open.of_tree && self.of_the_acting;
        !self.open.iter().all(known)
    }

    /// Whether what is at hand belongs to an expression or a behaviour that is checked for itself.
    pub fn of_any_reader(&self) -> bool {
        self.open.iter().any(|open| !open.unrolls && !open.of_tree)
    }

    /// Whether the body at hand is checked under arguments.
    pub fn is_unrolling(&self) -> bool {
        self.open.last().is_some_and(|open| open.unrolls)
    }
}

/// A body that is being checked.
#[derive(Clone, Copy, Debug)]
pub struct Open<'a> {
    /// Where its name is declared.
    pub at: Span,
    /// The name, as it is used.
    pub name: &'a str,
    /// Whether it is of the library.
    pub library: bool,
    /// Whether it is checked under arguments, not for itself.
    pub unrolls: bool,
    /// Whether it is of a tree.
    pub of_tree: bool,
}

impl<'a> Checker<'a> {
    /// Checks a body with its parameters known by type only, and remembers whether it is free of mistakes.
    pub fn body_for_itself(
        &mut self,
        body: &'a Ident,
        region: Region,
        scope: Vec<Binding<'a>>,
        pass: impl FnOnce(&mut Self),
    ) {
        // A deeper body is reported where it is unrolled.
        if self.bodies.open.len() > DEEP {
            return;
        }
        self.bodies.clean.insert(body.span, true);
        let context = Context {
            region,
            library: false,
            scope,
            ended: BTreeSet::new(),
            argument: None,
            is_given: false,
        };
        let open = Open {
            at: body.span,
            name: &body.name,
            library: false,
            unrolls: false,
            of_tree: region == Region::Tree,
        };
        let ((), found) = self.within(open, context, pass);
        let clean = !found.iter().any(Diagnostic::is_error);
        self.bodies.clean.insert(body.span, clean);
        self.diagnostics.extend(found);
    }

    /// Checks a body again under arguments. Mistakes that only these make are reported where they are given; `None`
    /// where there were any.
    pub fn unrolled<T>(
        &mut self,
        body: Span,
        reference: &'a Ref,
        library: bool,
        region: Region,
        scope: Vec<Binding<'a>>,
        pass: impl FnOnce(&mut Self) -> T,
    ) -> Option<T> {
        let name = reference.name.name.as_str();
        if self.bodies.is_open(body) {
            return self.closes_a_circle(body, reference);
        }
        if self.bodies.clean.get(&body) == Some(&false) {
            return None;
        }
        self.bodies.unrolled += 1;
        if self.bodies.open.len() > DEEP || self.bodies.unrolled > MANY {
            self.too_much(reference.name.span, "this use goes too far");
            return None;
        }
        let context = Context {
            region,
            library,
            scope,
            ended: BTreeSet::new(),
            argument: None,
            is_given: self.given.is_some() || self.context.is_given,
        };
        let open = Open {
            at: body,
            name,
            library,
            unrolls: true,
            of_tree: region == Region::Tree,
        };
        let (result, found) = self.within(open, context, pass);
        let mut seen: Vec<(Code, String)> = Vec::new();
        for inner in found.into_iter().filter(Diagnostic::is_error) {
            let what = (inner.code, inner.message.clone());
            if !seen.contains(&what) {
                seen.push(what);
                self.diagnostics.push(used_so(inner, reference, library));
            }
        }
        seen.is_empty().then_some(result)
    }

    /// Reports a use that closes a circle of definitions, with all of them.
    pub fn closes_a_circle<T>(&mut self, body: Span, reference: &Ref) -> Option<T> {
        let name = reference.name.name.as_str();
        let at = reference.name.span;
        let circle = self.bodies.circle(body);
        let mut draft = self.error(Code::E0205, at, circular(name, &circle));
        draft = match circle.as_slice() {
            [_, _, ..] => draft.label(format!("uses `{name}`, which closes the circle")),
            _ => draft.label("this use closes the circle"),
        };
        if circle.len() < 2 {
            return draft.also(body, "its definition starts here").none();
        }
        for (open, next) in circle.iter().zip(circle.iter().skip(1)) {
            if !open.library {
                draft = draft.also(open.at, format!("uses `{}`", next.name));
            }
        }
        draft.none()
    }

    /// Runs a pass over a body in its own context. What it reports is handed back.
    fn within<T>(
        &mut self,
        open: Open<'a>,
        context: Context<'a>,
        pass: impl FnOnce(&mut Self) -> T,
    ) -> (T, Vec<Diagnostic>) {
        let outer = std::mem::replace(&mut self.context, context);
        let given = self.given.take();
        self.bodies.open.push(open);
        let result = self.captured(pass);
        self.bodies.open.pop();
        self.given = given;
        self.context = outer;
        result
    }

    /// Runs a pass. What it reports is handed back.
    pub fn captured<T>(&mut self, pass: impl FnOnce(&mut Self) -> T) -> (T, Vec<Diagnostic>) {
        let before = std::mem::take(&mut self.diagnostics);
        let result = pass(self);
        (result, std::mem::replace(&mut self.diagnostics, before))
    }

    /// Reports, once, that definitions nest without end.
    pub fn too_much(&mut self, span: Span, label: &str) {
        if std::mem::replace(&mut self.bodies.gave_up, true) {
            return;
        }
        self.error(
            Code::E0209,
            span,
            "the definitions within definitions grow too large",
        )
        .label(label)
        .note(format!(
            "at most {DEEP} may stand within one another, and {MANY} uses in all"
        ));
    }
}

/// How many definitions of a circle are named from its beginning, and how many from its end.
const NAMED: usize = 6;

/// Says that a name is defined by itself, and through what.
fn circular(name: &str, circle: &[Open]) -> String {
    let said = format!("`{name}` is defined by itself");
    let (first, rest) = circle.split_at(circle.len().min(NAMED));
    let last = rest.get(rest.len().saturating_sub(NAMED)..);
    let last = last.unwrap_or_default();
    let left_out = rest.len() > last.len();
    let names = first.iter().map(|open| open.name);
    let names = names.chain(left_out.then_some("…"));
    let names = names.chain(last.iter().map(|open| open.name));
    match circle.len() {
        0 | 1 => said,
        _ => {
            let names: Vec<&str> = names.chain([name]).collect();
            format!("{said}: {}", names.join(" → "))
        }
    }
}

/// A mistake that a body makes under the arguments of a use, with the way to it.
fn used_so(mut inner: Diagnostic, reference: &Ref, library: bool) -> Diagnostic {
    let name = &reference.name.name;
    match inner.code {
        // These are mistakes of the body itself, whoever uses it.
        Code::E0205 | Code::E0209 if !library => inner,
        _ => {
            let label = Label {
                span: reference.span,
                message: format!("in this use of `{name}`"),
            };
            inner.labels.insert(0, label);
            inner.fixes.clear();
            inner
        }
    }
}
