//! `any`, `all`, `count` and `nearest` over the members of a kind.

use crate::check::Checker;
use crate::check::builtin::Function;
use crate::check::context::Binding;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Echo, ExprId};
use crate::source::Span;
use crate::syntax::ast::{ArgKind, Expr, ExprKind, Ref};

impl<'a> Checker<'a> {
    /// The right form of `nearest(bush)` and of `any(b in bush, …)`.
    fn meant_to_range(&self, reference: &Ref) -> Option<(String, Span, String)> {
        match reference.args.as_deref()? {
            [arg] => match &arg.kind {
                ArgKind::Positional(Expr {
                    kind:
                        ExprKind::Ref(Ref {
                            name, args: None, ..
                        }),
                    ..
                }) if matches!(reference.name.name.as_str(), "nearest" | "count")
                    && (self.names.types.contains_key(name.name.as_str())
                        || matches!(name.name.as_str(), "robot" | "place" | "wall")) =>
                {
                    let right = format!("x in {}", name.name);
                    Some((format!("write `{right}`"), arg.span, right))
                }
                _ => None,
            },
            [binder, body] => match (&binder.kind, &body.kind) {
                (ArgKind::Binder { body: None, .. }, ArgKind::Positional(_)) => {
                    let gap = Span {
                        end: body.span.start,
                        ..binder.span.after()
                    };
                    Some(("put a `:` for the comma".to_owned(), gap, ": ".to_owned()))
                }
                _ => None,
            },
            _ => None,
        }
    }

    /// `any(b in bush: …)` and its relatives.
    pub fn quantified(&mut self, function: Function, reference: &'a Ref) -> Option<Typed> {
        let span = reference.span;
        let binder = match reference.args.as_deref() {
            Some([arg]) => match &arg.kind {
                ArgKind::Binder {
                    name, domain, body, ..
                } => Some((name, domain, body)),
                _ => None,
            },
            _ => None,
        };
        let Some((name, domain, body)) = binder else {
            let right = self.meant_to_range(reference);
            return self
                .error(
                    Code::E0305,
                    span,
                    format!("`{}` ranges over a kind", reference.name.name),
                )
                .label(format!("write `{}(x in KIND: …)`", reference.name.name))
                .fix_if(right)
                .none();
        };
        let of = self.named_type(domain);
        if body.is_some() {
            self.binds(name, "member");
        }
        self.binds_member(name, &of);
        let members = self.members_of(&of, domain.span, &domain.name)?;
        if function == Function::Nearest {
            if !of.is_target() {
                let message = format!("nothing is near to {of}");
                return self
                    .error(Code::E0302, domain.span, message)
                    .label("a kind of places or walls, or `robot`, is needed")
                    .none();
            }
            if !self.has_world {
                let label = "read by a robot in its world";
                return self
                    .no_world(reference.name.span, "`nearest`", label)
                    .none();
            }
        }
        if body.is_none() && matches!(function, Function::Any | Function::All) {
            return self
                .error(
                    Code::E0305,
                    domain.span,
                    format!("`{}` says nothing of its members", reference.name.name),
                )
                .label("a condition is missing after this: `: condition`")
                .none();
        }
        let ty = match function {
            Function::Count => Type::NUMBER,
            Function::Nearest => of.clone(),
            _ => Type::Bool,
        };
        let role = format!("what `{}` says of each", reference.name.name);
        // Once for itself, so that a mistake is told once.
        let unknown = Binding::unknown(name, of.clone());
        let (_, found) = self.captured(|checker| checker.says(unknown, body.as_ref(), &role));
        let wrong = found.iter().any(Diagnostic::is_error);
        self.diagnostics.extend(found);
        if wrong {
            return Some(Typed::unknown(ty, span));
        }
        let bound = |member: &Value| vec![Binding::new(name, of.clone(), member.clone())];
        let bindings = members.iter().map(bound).collect();
        let says = self.for_each_member(bindings, |checker, _| match body {
            Some(body) => checker.expect(body, &Type::Bool, &role).scalar(),
            None => Some(checker.program.pool.bool(true)),
        });
        let Some(says) = says.into_iter().collect::<Option<Vec<ExprId>>>() else {
            return Some(Typed::unknown(ty, span));
        };
        if let (Function::Count | Function::Nearest, Some(body)) = (function, body) {
            self.picks_by(body, &says);
        }
        let pool = &mut self.program.pool;
        let value = match function {
            Function::Any => {
                let no = pool.bool(false);
                let any = says
                    .into_iter()
                    .rev()
                    .fold(no, |any, one| pool.or(one, any));
                Some(Value::Scalar(any))
            }
            Function::All => {
                let yes = pool.bool(true);
                let all = says
                    .into_iter()
                    .rev()
                    .fold(yes, |all, one| pool.and(one, all));
                Some(Value::Scalar(all))
            }
            Function::Count => {
                let (zero, one) = (pool.num(0.0), pool.num(1.0));
                let sum = says.into_iter().fold(zero, |sum, says| {
                    let counts = pool.select(says, one, zero);
                    match pool.constant(sum) {
                        Some(0.0) => counts,
                        _ => pool.binary(Binary::Add, sum, counts),
                    }
                });
                Some(Value::Scalar(sum))
            }
            _ => self.nearest(&members, &says),
        };
        Some(Typed::new(ty, value, span))
    }

    /// What is said of a member, checked with the member bound.
    fn says(&mut self, member: Binding<'a>, body: Option<&'a Expr>, role: &str) {
        self.context.scope.push(member);
        if let Some(body) = body {
            self.expect(body, &Type::Bool, role);
        }
        self.context.scope.pop();
    }

    /// The nearest of the members for which something holds; `nowhere` if it holds for none.
    fn nearest(&mut self, members: &[Value], says: &[ExprId]) -> Option<Value> {
        let far = self.program.pool.num(f64::INFINITY);
        let (mut nearest, mut least) = (Value::Nowhere, far);
        for (member, &says) in members.iter().zip(says) {
            let distance = self.echo(member, Echo::Distance)?;
            let pool = &mut self.program.pool;
            let distance = pool.select(says, distance, far);
            let closer = match least == far {
                true => says,
                false => pool.binary(Binary::Lt, distance, least),
            };
            least = pool.select(closer, distance, least);
            nearest = self.either(closer, member, &nearest)?;
        }
        Some(nearest)
    }
}
