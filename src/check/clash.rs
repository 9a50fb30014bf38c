//! States, parameters and constants that are declared with one type and used with another: one mistake, told once.

use super::Checker;
use super::expr::expect::is_literal;
use super::expr::plain_ref;
use super::meaning::Meaning;
use super::names::Decl;
use super::types::{Type, Typed};
use crate::diagnostic::{Applicability, Code, Diagnostic, Fix};
use crate::source::Span;
use crate::syntax::ast::{BinaryOp, Expr, ExprKind, Ident, LetBody, Ref};
use crate::syntax::print;
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::BTreeMap;

/// A use that does not agree with the type of what is declared, as it was reported.
#[derive(Clone, Debug)]
pub struct Clash<'a> {
    /// Where it was reported.
    at: Span,
    of: Declared<'a>,
    /// The type that the use would agree with.
    used_as: Type,
}

/// What is declared with a type.
#[derive(Clone, Debug)]
struct Declared<'a> {
    name: &'a Ident,
    /// The type that it is of.
    is: Type,
    /// Where its type is written, if it is.
    written: Option<Span>,
    /// What it is at first, or always.
    value: Option<&'a Expr>,
}

impl<'a> Checker<'a> {
    /// Notes that what an expression names was taken for something of another type, which was reported at `at`.
    pub fn clashes(&mut self, expr: &Expr, at: Span, used_as: &Type) {
        if let Some(reference) = scaled(expr) {
            self.clashes_with(&reference.name, at, used_as);
        }
    }

    /// Notes that a parameter of this type was given something of another one, which is reported.
    pub fn clashes_with_parameter(&mut self, name: &'a Ident, is: &Type, given: &Typed) {
        if *is != Type::Error && given.ty != Type::Error && !self.context.library {
            self.clashes.push(Clash {
                at: given.span,
                of: Declared {
                    name,
                    is: is.clone(),
                    written: self.parameter_types.get(&name.span).copied(),
                    value: None,
                },
                used_as: given.ty.clone(),
            });
        }
    }

    /// What a name of the user stands for that is declared with a type.
    fn typed_declaration(&self, name: &Ident) -> Option<Declared<'a>> {
        if self.context.library {
            return None;
        }
        if let Some(bound) = self.context.lookup(&name.name) {
            let written = self.parameter_types.get(&bound.name.span).copied()?;
            return Some(Declared {
                name: bound.name,
                is: bound.ty.clone(),
                written: Some(written),
                value: None,
            });
        }
        match self.names.value(&name.name, false)? {
            (Decl::State(state), false) => Some(Declared {
                name: &state.name,
                is: self.states.get(name.name.as_str())?.ty.clone(),
                written: state.ty.as_ref().map(|ty| ty.span),
                value: Some(&state.value),
            }),
            (Decl::Let(shared), false) if shared.params.is_none() => Some(Declared {
                name: &shared.name,
                is: self.meanings.known(name.span)?.clone(),
                written: shared.ty.as_ref().map(|ty| ty.span),
                value: match &shared.body {
                    LetBody::Expr(value) => Some(value),
                    LetBody::Yield(_) => return None,
                },
            }),
            _ => None,
        }
    }

    /// Notes that what has this name was taken for something of another type, which was reported at `at`.
    pub fn clashes_with(&mut self, name: &Ident, at: Span, used_as: &Type) {
        if *used_as != Type::Error
            && let Some(of) = self.typed_declaration(name)
        {
            self.clashes.push(Clash {
                at,
                of,
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

    /// Makes one mistake of the uses that all disagree with the type of what is declared in the same way: of the declaration,
    /// where most uses do.
    pub fn settle_clashes(&mut self) {
        let mut states: BTreeMap<Span, BTreeMap<Span, Clash<'a>>> = BTreeMap::new();
        for clash in std::mem::take(&mut self.clashes) {
            let of_state = states.entry(clash.of.name.span).or_default();
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
            let uses = uses.get(&first.of.name.span).copied();
            if 2 * clashes.len() < uses.unwrap_or_default() {
                continue;
            }
            misdeclared.push(self.misdeclared(first, &clashes));
            let value = first.of.value.map(|value| value.span);
            for at in clashes.iter().map(|clash| clash.at).chain(value) {
                told.remove(&at);
                follow.insert(at);
            }
        }
        self.diagnostics
            .retain(|found| !is_told(&found) || !follow.contains(&found.span()));
        self.diagnostics.extend(misdeclared);
    }

    /// The message for what is declared with a type that its uses disagree with.
    fn misdeclared(&self, first: &Clash, clashes: &[Clash]) -> Diagnostic {
        let Declared {
            name,
            is,
            written,
            value,
        } = &first.of;
        let name = &name.name;
        let used_as = &first.used_as;
        let code = match (used_as.dim(), is.dim()) {
            (Some(_), Some(_)) => Code::E0301,
            _ => Code::E0302,
        };
        let span = written.or(value.map(|value| value.span));
        let span = span.unwrap_or(first.of.name.span);
        let message = format!("`{name}` is declared as {is}, and used as {used_as}");
        let places: Vec<Span> = clashes.iter().map(|clash| clash.at).collect();
        let mut found = Diagnostic::new(code, span, message)
            .label(format!("this is {is}"))
            .and_at(&places, &format!("used as {used_as}"));
        let Some(ty) = used_as.written() else {
            return found;
        };
        let mut edits = Vec::new();
        if let Some(value) = value {
            // What begins otherwise is a state; a constant is what its value is.
            let is_state = matches!(self.names.value(name, false), Some((Decl::State(_), _)));
            let Some(right) = initial(used_as, value).filter(|_| is_state) else {
                return found;
            };
            if right != print::expr(value) {
                edits.push((value.span, right));
            }
        }
        edits.extend(written.map(|written| (written, ty.clone())));
        edits.sort_by_key(|(span, _)| *span);
        found.fixes.push(Fix {
            title: format!("declare it as `{ty}`"),
            edits,
            applicability: Applicability::Unsafe,
        });
        found
    }
}

/// What an expression names, alone or times a plain number.
fn scaled(expr: &Expr) -> Option<&Ref> {
    match &expr.kind {
        ExprKind::Paren(inner) => scaled(inner),
        ExprKind::Binary { op, left, right } => match op.node {
            BinaryOp::Mul if is_literal(left) => scaled(right),
            BinaryOp::Mul | BinaryOp::Div if is_literal(right) => scaled(left),
            _ => None,
        },
        _ => plain_ref(expr),
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
