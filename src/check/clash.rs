//! States that are declared with one type and used with another: one mistake, told once.

use super::Checker;
use super::expr::plain_ref;
use super::meaning::Meaning;
use super::names::Decl;
use super::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code, Diagnostic, Fix};
use crate::source::Span;
use crate::syntax::ast::{Expr, ExprKind, Ident, State};
use crate::syntax::print;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// A use of a state that does not agree with its type, as it was reported.
#[derive(Clone, Debug)]
pub struct Clash<'a> {
    /// Where it was reported.
    at: Span,
    state: &'a State,
    /// The type that the use would agree with.
    used_as: Type,
}

impl<'a> Checker<'a> {
    /// Notes that what an expression names was taken for something of another type, which was reported at `at`.
    pub fn clashes(&mut self, expr: &Expr, at: Span, used_as: &Type) {
        if let Some(reference) = plain_ref(expr) {
            self.clashes_with(&reference.name, at, used_as);
        }
    }

    /// Notes that the state of this name was taken for something of another type, which was reported at `at`.
    pub fn clashes_with(&mut self, name: &Ident, at: Span, used_as: &Type) {
        if self.context.lookup(&name.name).is_none()
            && let Some((Decl::State(state), false)) =
                self.names.value(&name.name, self.context.library)
            && *used_as != Type::Error
        {
            self.clashes.push(Clash {
                at,
                state,
                used_as: used_as.clone(),
            });
        }
    }

    /// Checks the value that a name is set to.
    pub fn set_to(&mut self, name: &Ident, value: &'a Expr, ty: &Type, role: &str) -> Typed {
        let typed = self.expr_like(value, ty);
        if !typed.ty.fits(ty) {
            self.clashes_with(name, typed.span, &typed.ty);
        }
        self.percent_of(name, ty, value);
        self.coerce(typed, value, ty, role)
    }

    /// Makes one mistake of the uses of a state that all disagree with its type in the same way: of the declaration,
    /// where most uses do.
    pub fn settle_clashes(&mut self) {
        let mut states: BTreeMap<Span, BTreeMap<Span, Clash<'a>>> = BTreeMap::new();
        for clash in std::mem::take(&mut self.clashes) {
            let of_state = states.entry(clash.state.name.span).or_default();
            of_state.entry(clash.at).or_insert(clash);
        }
        let mut states: Vec<_> = states.into_values().collect();
        states.sort_by_key(|clashes| std::cmp::Reverse(clashes.len()));
        let is_told = |found: &&Diagnostic| matches!(found.code, Code::E0301 | Code::E0302);
        let told = self.diagnostics.iter().filter(is_told);
        let mut told: FxHashSet<Span> = told.map(Diagnostic::span).collect();
        let mut uses: FxHashMap<Span, usize> = FxHashMap::default();
        for (_, meaning) in self.meanings.uses() {
            if let Meaning::Declared(at) = meaning {
                *uses.entry(at).or_default() += 1;
            }
        }
        let (mut follow, mut misdeclared) = (FxHashSet::default(), Vec::new());
        for clashes in states {
            let clashes = clashes.into_values();
            let clashes: Vec<_> = clashes.filter(|clash| told.contains(&clash.at)).collect();
            let [first, .., _] = clashes.as_slice() else {
                continue;
            };
            if clashes.iter().any(|other| other.used_as != first.used_as) {
                continue;
            }
            let uses = uses.get(&first.state.name.span).copied();
            if 2 * clashes.len() < uses.unwrap_or_default() {
                continue;
            }
            misdeclared.push(self.misdeclared(first, &clashes));
            let value = first.state.value.span;
            for at in clashes.iter().map(|clash| clash.at).chain([value]) {
                told.remove(&at);
                follow.insert(at);
            }
        }
        self.diagnostics
            .retain(|found| !is_told(&found) || !follow.contains(&found.span()));
        self.diagnostics.extend(misdeclared);
    }

    /// The message for a state whose uses disagree with its declaration.
    fn misdeclared(&self, first: &Clash, clashes: &[Clash]) -> Diagnostic {
        let state = first.state;
        let name = &state.name.name;
        let used_as = &first.used_as;
        let is = self.states.get(name.as_str()).map(|slot| &slot.ty);
        let is = is.map_or("something else".to_owned(), Type::to_string);
        let code = match (used_as.dim(), self.states.get(name.as_str())) {
            (Some(_), Some(slot)) if slot.ty.dim().is_some() => Code::E0301,
            _ => Code::E0302,
        };
        let span = state.ty.as_ref().map_or(state.value.span, |ty| ty.span);
        let message = format!("`{name}` is declared as {is}, and used as {used_as}");
        let places: Vec<Span> = clashes.iter().map(|clash| clash.at).collect();
        let mut found = Diagnostic::new(code, span, message)
            .label(format!("this is {is}"))
            .and_at(&places, &format!("used as {used_as}"));
        let (Some(ty), Some(value)) = (used_as.written(), initial(used_as, &state.value)) else {
            return found;
        };
        let mut edits = Vec::new();
        if value != print::expr(&state.value) {
            edits.push((state.value.span, value));
        }
        edits.extend(state.ty.as_ref().map(|written| (written.span, ty.clone())));
        edits.sort_by_key(|(span, _)| *span);
        found.fixes.push(Fix {
            title: format!("declare it as `{ty}`"),
            edits,
            applicability: Applicability::Unsafe,
        });
        found
    }
}

/// The value with which a state of another type would begin.
fn initial(ty: &Type, value: &Expr) -> Option<String> {
    let digits = match &value.kind {
        ExprKind::Number(literal) => literal.digits.as_str(),
        _ => "0",
    };
    match ty {
        Type::Bool => Some("false".to_owned()),
        Type::Ratio => match &value.kind {
            ExprKind::Number(literal) if literal.unit.is_some() => Some(print::expr(value)),
            _ => Some(digits.to_owned()),
        },
        _ => {
            let dim = ty.dim()?;
            Some(match dim.unit() {
                Some(unit) => format!("{digits} {unit}"),
                None => digits.to_owned(),
            })
        }
    }
}
