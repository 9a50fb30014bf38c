//! Behaviours: bodies are checked for themselves, then once more for every set of arguments that is used.

use crate::check::Checker;
use crate::check::context::{Binding, Region};
use crate::check::decl::statement::Home;
use crate::check::types::{Type, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Expr, ExprId, Local};
use crate::ir::law::{Behavior, Block, Law};
use crate::ir::table::Table;
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, BehaviorBody, Clause, ClauseKind, Ref};

/// The id of a behaviour with its arguments.
pub type BehaviorId = Id<Behavior>;

impl<'a> Checker<'a> {
    /// Checks a behaviour for itself.
    pub fn behavior(&mut self, behavior: &'a ast::Behavior) {
        if self.clean_bodies.contains_key(&behavior.name.span) {
            return;
        }
        let scope = self.unknown_parameters(behavior.params.as_ref());
        self.body_for_itself(
            &behavior.name,
            Region::Clause,
            scope,
            |checker| match &behavior.body {
                BehaviorBody::Declared => {}
                BehaviorBody::Alias(target) => {
                    checker.context.region = Region::Tree;
                    checker.alias(target);
                }
                BehaviorBody::Clauses(clauses) => {
                    checker.law(clauses, Table::default());
                }
            },
        );
    }

    /// The behaviour with the given arguments: a known value, or an unknown one inside a body that is checked for
    /// itself. `None` if a mistake was reported.
    pub fn behavior_instance(
        &mut self,
        behavior: &'a ast::Behavior,
        library: bool,
        reference: &'a Ref,
    ) -> Option<Value> {
        if !library {
            self.behavior(behavior);
        }
        let params = behavior.params.as_ref();
        let mut scope = self.bind_arguments(params, library, reference, Region::Let)?;
        if scope.iter().any(|binding| binding.value == Value::Unknown) {
            return Some(Value::Unknown);
        }
        let name = self.instance_name(behavior.params.as_ref(), reference, &scope);
        if let Some(known) = self.behaviors.get(&name) {
            return known.map(Value::Behavior);
        }
        // Arguments that change are evaluated at the start and held.
        let mut locals = Table::default();
        for binding in &mut scope {
            self.hold(binding, &mut locals);
        }
        let body = behavior.name.span;
        let law =
            self.unrolled(
                body,
                reference,
                library,
                Region::Clause,
                scope,
                |checker| match &behavior.body {
                    BehaviorBody::Declared => Some(None),
                    BehaviorBody::Alias(target) => {
                        checker.context.region = Region::Tree;
                        let target = checker.alias(target)?;
                        Some(checker.program.behaviors[target].law.clone())
                    }
                    BehaviorBody::Clauses(clauses) => checker.law(clauses, locals).map(Some),
                },
            );
        let id = law.flatten().map(|law| {
            self.program.behaviors.push(Behavior {
                name: name.clone(),
                law,
            })
        });
        self.behaviors.insert(name, id);
        id.map(Value::Behavior)
    }

    fn alias(&mut self, target: &'a Ref) -> Option<BehaviorId> {
        let typed = self.reference(target);
        match (&typed.ty, typed.value) {
            (_, Value::Behavior(id)) => return Some(id),
            (Type::Behavior | Type::Error, _) => {}
            (other, _) => self.report(
                Diagnostic::new(Code::E0203, target.span, "an alias names a behaviour")
                    .label(format!("this is {other}")),
            ),
        }
        None
    }

    /// Makes a local of an argument that is not constant.
    fn hold(&mut self, binding: &mut Binding, locals: &mut Table<Local>) {
        let mut held = |id: ExprId| {
            if self.program.pool.constant(id).is_some() {
                return id;
            }
            let local = locals.push(Local {
                name: Name::word(&binding.name),
                initial: id,
            });
            self.program.pool.leaf(Expr::Local(local))
        };
        binding.value = match &binding.value {
            Value::Scalar(id) => Value::Scalar(held(*id)),
            Value::Point(x, y) => Value::Point(held(*x), held(*y)),
            other => other.clone(),
        };
    }

    /// The clauses of a body as the partition and the control law, in the order that the language gives them.
    fn law(&mut self, clauses: &'a [Clause], mut locals: Table<Local>) -> Option<Law> {
        let depth = self.context.scope.len();
        let mut known = true;
        self.context.region = Region::Local;
        for clause in clauses {
            if let ClauseKind::Local { name, ty, value } = &clause.kind {
                known &= self.local(name, ty.as_ref(), value, &mut locals);
            }
        }
        let pool = &mut self.program.pool;
        let (yes, no) = (pool.bool(true), pool.bool(false));
        let (mut requires, mut succeed, mut fail) = (yes, no, no);
        let mut control: Option<(Span, Option<Block>)> = None;
        for clause in clauses {
            self.context.region = Region::Clause;
            let mut region =
                |role: &str, test: &'a ast::Expr| self.expect(test, &Type::Bool, role).scalar();
            match &clause.kind {
                ClauseKind::Local { .. } => {}
                ClauseKind::Requires(test) => match region("`requires`", test) {
                    Some(id) => requires = self.program.pool.and(requires, id),
                    None => known = false,
                },
                ClauseKind::Succeed(test) => match region("`succeed when`", test) {
                    Some(id) => succeed = self.program.pool.or(succeed, id),
                    None => known = false,
                },
                ClauseKind::Fail(test) => match region("`fail when`", test) {
                    Some(id) => fail = self.program.pool.or(fail, id),
                    None => known = false,
                },
                ClauseKind::Control(block) => {
                    if let Some((first, _)) = &control {
                        self.report(
                            Diagnostic::new(
                                Code::E0503,
                                keyword(clause),
                                "a behaviour has one control law",
                            )
                            .label("a second `control`")
                            .also(*first, "the first is here"),
                        );
                        continue;
                    }
                    self.context.region = Region::Control;
                    let lowered = self.block(block, &Home::Control);
                    self.drives_once(block, None);
                    control = Some((keyword(clause), lowered));
                }
                ClauseKind::Error => known = false,
            }
        }
        self.context.scope.truncate(depth);
        let control = match control {
            Some((_, lowered)) => lowered?,
            None => Block::default(),
        };
        known.then_some(Law {
            locals,
            requires,
            succeed,
            fail,
            control,
        })
    }

    fn local(
        &mut self,
        name: &'a ast::Ident,
        ty: Option<&'a ast::TypeExpr>,
        value: &'a ast::Expr,
        locals: &mut Table<Local>,
    ) -> bool {
        let typed = self.declared(ty, value, &name.name);
        let parts = match typed.value {
            Value::Scalar(id) => vec![id],
            Value::Point(x, y) => vec![x, y],
            _ => Vec::new(),
        };
        let ids: Vec<Id<Local>> = parts
            .into_iter()
            .map(|initial| {
                locals.push(Local {
                    name: Name::word(&name.name),
                    initial,
                })
            })
            .collect();
        let mut leaves = ids
            .iter()
            .map(|id| self.program.pool.leaf(Expr::Local(*id)));
        let value = match (leaves.next(), leaves.next()) {
            (Some(x), Some(y)) => Value::Point(x, y),
            (Some(id), None) => Value::Scalar(id),
            _ => Value::Unknown,
        };
        let known = value != Value::Unknown;
        self.binds_anew(name, "local", 0);
        self.context.scope.push(Binding {
            name: name.name.clone(),
            ty: typed.ty,
            value,
            locals: ids,
            settable: true,
            span: name.span,
        });
        known
    }
}

/// The word `control` of a clause.
fn keyword(clause: &Clause) -> Span {
    Span {
        end: clause.span.start + 7,
        ..clause.span
    }
}
