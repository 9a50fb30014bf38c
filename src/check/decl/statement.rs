//! Statements of control laws and effects.

use crate::check::Checker;
use crate::check::argument::no_binder;
use crate::check::context::{Binding, Region};
use crate::check::names::{Decl, stranger, unknown};
use crate::check::types::units::Dim;
use crate::check::types::{Type, Typed, Value};
use crate::diagnostic::{Code, Diagnostic};
use crate::ir::expr::{Binary, Expr, ExprId, Local, Temp};
use crate::ir::law::{Block, Stmt};
use crate::ir::program::State;
use crate::ir::world::DriveKind;
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, ArgKind, AssignOp, Else, Ref, StmtKind};

/// Whose statements they are.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Home {
    /// An effect: sets states.
    Effect,
    /// A control law: sets its locals and drives.
    Control,
}

/// What an assignment can set.
enum Slot {
    State(Id<State>),
    Local(Id<Local>),
}

impl<'a> Checker<'a> {
    /// A block with a scope of its own; `None` if something in it is not known.
    pub fn block(&mut self, block: &'a ast::Block, home: &Home) -> Option<Block> {
        let depth = self.context.scope.len();
        let mut stmts = Some(Vec::new());
        for stmt in &block.stmts {
            let lowered = self.stmt(stmt, home, depth);
            match (lowered, &mut stmts) {
                (Some(lowered), Some(stmts)) => stmts.extend(lowered),
                _ => stmts = None,
            }
        }
        self.context.scope.truncate(depth);
        stmts.map(Block)
    }

    /// A statement of a block whose own names start at `depth` of the scope.
    fn stmt(&mut self, stmt: &'a ast::Stmt, home: &Home, depth: usize) -> Option<Vec<Stmt>> {
        match &stmt.kind {
            StmtKind::Let(binding) => self.let_stmt(binding, depth),
            StmtKind::For {
                name,
                domain,
                block,
            } => {
                let ty = self.named_type(domain);
                let known = ty != Type::Error && self.has_members(&ty, domain);
                self.context.scope.push(Binding {
                    name: name.name.clone(),
                    ty,
                    value: Value::Unknown,
                    locals: Vec::new(),
                    settable: false,
                    span: name.span,
                });
                self.block(block, home);
                self.context.scope.pop();
                if known {
                    self.not_yet(domain.span, "loops over kinds");
                }
                None
            }
            StmtKind::Branch(branch) => self.branch(branch, home).map(|stmt| vec![stmt]),
            StmtKind::Assign { target, op, value } => self.assign(target, *op, value),
            StmtKind::Call(call) => self.call_stmt(call, home).map(|stmt| vec![stmt]),
            StmtKind::Error => None,
        }
    }

    /// A `let` holds the value of its moment; a constant or a target needs no variable for that.
    fn let_stmt(&mut self, binding: &'a ast::Binding, depth: usize) -> Option<Vec<Stmt>> {
        let typed = self.binding_value(binding);
        let mut stmts = Vec::new();
        let mut hold = |checker: &mut Self, id: ExprId| {
            if checker.program.pool.constant(id).is_some() {
                return id;
            }
            let temp = checker.program.temps.push(Temp {
                name: Name::word(&binding.name.name),
            });
            stmts.push(Stmt::Let(temp, id));
            checker.program.pool.leaf(Expr::Temp(temp))
        };
        let known = typed.value != Value::Unknown;
        let value = match typed.value {
            Value::Scalar(id) => Value::Scalar(hold(self, id)),
            Value::Point(x, y) => {
                let x = hold(self, x);
                Value::Point(x, hold(self, y))
            }
            other => other,
        };
        self.binds_anew(&binding.name, "value", depth);
        self.context.scope.push(Binding {
            name: binding.name.name.clone(),
            ty: typed.ty,
            value,
            locals: Vec::new(),
            settable: false,
            span: binding.name.span,
        });
        known.then_some(stmts)
    }

    fn branch(&mut self, branch: &'a ast::Branch, home: &Home) -> Option<Stmt> {
        let condition = self.expect(&branch.cond, &Type::Bool, "a condition");
        let then = self.block(&branch.then, home);
        let otherwise = match branch.otherwise.as_deref() {
            None => Some(Block::default()),
            Some(Else::Block(block)) => self.block(block, home),
            Some(Else::If(inner)) => self.branch(inner, home).map(|stmt| Block(vec![stmt])),
        };
        Some(Stmt::If(condition.scalar()?, then?, otherwise?))
    }

    fn assign(
        &mut self,
        target: &'a Ref,
        op: ast::Spanned<AssignOp>,
        value: &'a ast::Expr,
    ) -> Option<Vec<Stmt>> {
        let found = self.assignable(target);
        let Some((ty, slots)) = found else {
            self.expr(value);
            return None;
        };
        let role = format!("`{}`", target.name.name);
        if op.node != AssignOp::Set && ty.dim().is_none() && ty != Type::Error {
            self.report(
                Diagnostic::new(
                    Code::E0302,
                    op.span,
                    format!("{role} is {ty}, which is no number"),
                )
                .label("only numbers are reckoned with; `=` sets it"),
            );
            self.expr(value);
            return None;
        }
        let value = match op.node {
            AssignOp::Set | AssignOp::Add | AssignOp::Sub => self.expect(value, &ty, &role),
            AssignOp::Mul | AssignOp::Div => {
                let typed = self.expr(value);
                match self.number(&typed) {
                    Some(Dim::NONE) => {}
                    Some(_) => {
                        self.report(
                            Diagnostic::new(
                                Code::E0301,
                                typed.span,
                                format!("{role} would change its unit, and it is {ty}"),
                            )
                            .label(format!("this is {}", typed.ty)),
                        );
                        return None;
                    }
                    None => return None,
                }
                typed
            }
        };
        let parts = match value.value {
            Value::Scalar(id) => vec![id],
            Value::Point(x, y) => vec![x, y],
            _ => return None,
        };
        let mut stmts = Vec::new();
        for (slot, part) in slots.into_iter().zip(parts) {
            let pool = &mut self.program.pool;
            let now = match slot {
                Slot::State(id) => pool.leaf(Expr::State(id)),
                Slot::Local(id) => pool.leaf(Expr::Local(id)),
            };
            let part = match op.node {
                AssignOp::Set => part,
                AssignOp::Add => pool.binary(Binary::Add, now, part),
                AssignOp::Sub => pool.binary(Binary::Sub, now, part),
                AssignOp::Mul => pool.binary(Binary::Mul, now, part),
                AssignOp::Div => pool.binary(Binary::Div, now, part),
            };
            stmts.push(match slot {
                Slot::State(id) => Stmt::SetState(id, part),
                Slot::Local(id) => Stmt::SetLocal(id, part),
            });
        }
        Some(stmts)
    }

    /// The variables behind the left side of an assignment.
    fn assignable(&mut self, target: &'a Ref) -> Option<(Type, Vec<Slot>)> {
        let name = target.name.name.as_str();
        let in_effect = matches!(self.context.region, Region::Effect | Region::EachTick);
        if target.args.is_none()
            && let Some(binding) = self.context.lookup(name)
        {
            let (ty, locals, at) = (binding.ty.clone(), binding.locals.clone(), binding.span);
            if !binding.settable {
                self.report(
                    Diagnostic::new(Code::E0310, target.span, format!("`{name}` cannot be set"))
                        .label("it keeps the value that it was given")
                        .also(at, "bound here")
                        .help("what changes is a `local` of the behaviour"),
                );
                return None;
            }
            return Some((ty, locals.into_iter().map(Slot::Local).collect()));
        }
        match self.names.value(name, self.context.library) {
            Some((Decl::State(state), _)) => {
                let typed = self.state_value(state, target);
                if typed.ty == Type::Error {
                    return None;
                }
                if !in_effect {
                    self.report(
                        Diagnostic::new(
                            Code::E0310,
                            target.span,
                            format!("the state `{name}` cannot be set by a behaviour"),
                        )
                        .label("a control law sets its locals, and drives")
                        .help("let it succeed, and set the state `on` that event"),
                    );
                    return None;
                }
                let ids = self.states.get(name).map(|slot| slot.ids.clone());
                let slots = ids.unwrap_or_default().into_iter().map(Slot::State);
                Some((typed.ty, slots.collect()))
            }
            Some((decl, _)) => {
                self.report(
                    Diagnostic::new(Code::E0310, target.span, format!("`{name}` cannot be set"))
                        .label(format!("this is {}", decl.what())),
                );
                None
            }
            None if crate::check::world::is_built_in(name) => {
                self.report(
                    Diagnostic::new(Code::E0310, target.span, format!("`{name}` cannot be set"))
                        .label("the world sets it"),
                );
                None
            }
            None => {
                let scope = self.context.scope.iter();
                let mut candidates: Vec<&str> = Vec::new();
                candidates.extend(
                    scope
                        .filter(|binding| binding.settable)
                        .map(|binding| binding.name.as_str()),
                );
                candidates.extend(self.names.values(|decl| matches!(decl, Decl::State(_))));
                let diagnostic = unknown(&target.name, "variable", candidates);
                self.report(diagnostic);
                None
            }
        }
    }

    fn call_stmt(&mut self, call: &'a Ref, home: &Home) -> Option<Stmt> {
        if call.name.name != "drive" {
            let diagnostic = match self.names.value(&call.name.name, self.context.library) {
                Some((decl, _)) => Diagnostic::new(
                    Code::E0203,
                    call.span,
                    format!("`{}` does nothing as a statement", call.name.name),
                )
                .label(format!("this is {}", decl.what())),
                None => unknown(&call.name, "statement", ["drive"]),
            };
            for arg in call.args.iter().flatten() {
                self.stray_argument(arg);
            }
            self.report(diagnostic);
            return None;
        }
        if *home == Home::Effect {
            self.report(
                Diagnostic::new(Code::E0307, call.name.span, "an effect does not drive")
                    .label("only a control law does"),
            );
            return None;
        }
        let holonomic = self
            .program
            .world
            .as_ref()
            .is_some_and(|world| world.robot.drive.kind == DriveKind::Holonomic);
        let speed = Type::Quantity(Dim::SPEED);
        let parts = [
            ("speed", speed.clone()),
            ("turn", Type::Quantity(Dim::TURN_RATE)),
            ("strafe", speed),
        ];
        let mut given: [Option<Typed>; 3] = [None, None, None];
        let mut position = 0;
        let mut fine = true;
        for arg in call.args.iter().flatten() {
            let (slot, value) = match &arg.kind {
                ArgKind::Positional(value) => {
                    position += 1;
                    (Some(position - 1), value)
                }
                ArgKind::Named(name, value) => {
                    let slot = parts.iter().position(|(known, _)| *known == name.name);
                    if slot.is_none() {
                        let known = ["speed", "turn", "strafe"];
                        self.report(stranger(Code::E0305, name, "`drive`", "parameter", &known));
                        fine = false;
                    }
                    (slot, value)
                }
                ArgKind::Binder { .. } => {
                    self.report(no_binder("drive", arg.span));
                    fine = false;
                    continue;
                }
            };
            let Some(slot) = slot else { continue };
            let (Some((name, ty)), Some(place)) = (parts.get(slot), given.get_mut(slot)) else {
                self.report(
                    Diagnostic::new(
                        Code::E0305,
                        arg.span,
                        "`drive` takes a speed and a turn rate",
                    )
                    .label("one too many"),
                );
                fine = false;
                continue;
            };
            if place.is_some() {
                self.report(
                    Diagnostic::new(Code::E0305, arg.span, format!("`{name}` is given twice"))
                        .label("given a second time"),
                );
                fine = false;
                continue;
            }
            if *name == "strafe" && !holonomic && self.has_world {
                self.report(
                    Diagnostic::new(
                        Code::E0305,
                        arg.span,
                        "a differential drive cannot move sideways",
                    )
                    .label("`strafe` needs `drive = holonomic(…)`"),
                );
                fine = false;
                continue;
            }
            *place = Some(self.expect(value, ty, &format!("`{name}`")));
        }
        let [speed, turn, strafe] = given;
        for (name, part, still) in [
            (
                "speed",
                &speed,
                "to turn on the spot, write `speed = 0 m/s`",
            ),
            ("turn", &turn, "to go straight on, write `turn = 0 rad/s`"),
        ] {
            if part.is_none() && fine {
                self.report(
                    Diagnostic::new(
                        Code::E0305,
                        call.name.span,
                        format!("`drive` needs its `{name}`"),
                    )
                    .label(format!("`{name}` is not given"))
                    .help(still),
                );
            }
        }
        let zero = self.program.pool.num(0.0);
        Some(Stmt::Drive {
            speed: speed?.scalar()?,
            turn: turn?.scalar()?,
            strafe: match strafe {
                Some(strafe) => strafe.scalar()?,
                None => zero,
            },
        })
    }

    /// Reports every `drive` that a path reaches after another; whether some path drives.
    pub fn drives_once(&mut self, block: &'a ast::Block, mut before: Option<Span>) -> Option<Span> {
        for stmt in &block.stmts {
            match &stmt.kind {
                StmtKind::Call(call) if call.name.name == "drive" => {
                    if let Some(first) = before {
                        self.report(
                            Diagnostic::new(Code::E0311, call.name.span, "this path drives twice")
                                .label("a second command in one tick")
                                .also(first, "the first is here"),
                        );
                    }
                    before = Some(call.name.span);
                }
                StmtKind::Branch(branch) => before = self.branch_drives(branch, before),
                StmtKind::For { block, .. } => before = self.drives_once(block, before),
                _ => {}
            }
        }
        before
    }

    fn branch_drives(&mut self, branch: &'a ast::Branch, before: Option<Span>) -> Option<Span> {
        let then = self.drives_once(&branch.then, before);
        let otherwise = match branch.otherwise.as_deref() {
            None => before,
            Some(Else::Block(block)) => self.drives_once(block, before),
            Some(Else::If(inner)) => self.branch_drives(inner, before),
        };
        then.or(otherwise)
    }
}
