//! The clauses of a behaviour: its partition and its control law.

use crate::check::Checker;
use crate::check::context::{Binding, Region};
use crate::check::lint::FailClause;
use crate::check::types::{Type, Value};
use crate::diagnostic::Code;
use crate::ir::Name;
use crate::ir::expr::{Expr, Local};
use crate::ir::law::{Block, Law};
use crate::ir::program::Stays;
use crate::ir::table::Table;
use crate::source::Span;
use crate::syntax::ast::{self, Clause, ClauseKind};

impl<'a> Checker<'a> {
    /// The clauses of a body as the partition and the control law, in the order that the language gives them; `locals`
    /// are those that hold its arguments.
    pub fn law(&mut self, clauses: &'a [Clause], mut locals: Table<Local>) -> Option<Law> {
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
        let mut fails = Vec::new();
        self.same_clauses(clauses);
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
                    Some(id) => {
                        fails.push((test.span, fail, id));
                        fail = self.program.pool.or(fail, id);
                    }
                    None => known = false,
                },
                ClauseKind::Control(block) => {
                    let here = keyword(clause);
                    if let Some((first, _)) = &control {
                        self.error(Code::E0503, here, "a behaviour has one control law")
                            .label("a second `control`")
                            .also(*first, "the first is here");
                        continue;
                    }
                    self.context.region = Region::Control;
                    let lowered = self.block(block);
                    self.drives_once(block, None);
                    control = Some((here, lowered));
                }
                ClauseKind::Error => known = false,
            }
        }
        self.context.scope.truncate(depth);
        let control = match control {
            Some((_, lowered)) => lowered?,
            None => Block::default(),
        };
        if known && !self.context.library {
            for (at, before, when) in fails {
                let clause = FailClause {
                    requires,
                    succeed,
                    before,
                    when,
                };
                self.fails.entry(at).or_default().push(clause);
            }
        }
        known.then_some(Law {
            locals,
            requires,
            succeed,
            fail,
            control,
        })
    }

    /// `local name = value`; whether its value is known.
    fn local(
        &mut self,
        name: &'a ast::Ident,
        ty: Option<&'a ast::TypeExpr>,
        value: &'a ast::Expr,
        locals: &mut Table<Local>,
    ) -> bool {
        let typed = self.declared_or_unsure(ty, value, &name.name);
        let holds = match &typed.ty {
            Type::Bool | Type::Quantity(_) | Type::Ratio | Type::Point | Type::Enum(_) => true,
            Type::Error => true,
            ty => ty.is_named_target(),
        };
        if !holds {
            let message = format!("a local cannot hold {}", typed.ty);
            self.error(Code::E0302, typed.span, message).label(
                "numbers, truth values, points, enums, places, walls, robots and sensors can be held",
            );
        }
        let mut ids = Vec::new();
        let mut leaves = Vec::new();
        for initial in self.held_parts(&typed.value) {
            let name = Name::word(&name.name);
            let id = locals.push(Local {
                name,
                initial,
                stays: Stays::ANY,
            });
            ids.push(id);
            leaves.push(self.program.pool.leaf(Expr::Local(id)));
        }
        let binding = Binding {
            name,
            value: match typed.value {
                Value::Unknown => Value::Unknown,
                _ => self.held(&typed.ty, &leaves),
            },
            ty: typed.ty,
            locals: Some(ids),
            given: None,
        };
        self.bind(binding, "local", 0);
        !leaves.is_empty()
    }
}

/// The word `control` of a clause.
fn keyword(clause: &Clause) -> Span {
    Span {
        end: clause.span.start + 7,
        ..clause.span
    }
}
