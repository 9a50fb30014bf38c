//! Statements of control laws and effects.

use crate::check::Checker;
use crate::check::builtin::BuiltIn;
use crate::check::context::{Binding, Region};
use crate::check::lint::is_nameless;
use crate::check::names::{Decl, START_WORDS, is_built_in};
use crate::check::types::units::Dim;
use crate::check::types::{Type, Value};
use crate::diagnostic::{Applicability, Code, Diagnostic};
use crate::ir::Pool;
use crate::ir::expr::{Binary, Expr, ExprId, Local, Temp};
use crate::ir::law::{Block, Stmt};
use crate::ir::program::{State, Stays};
use crate::ir::{Id, Name};
use crate::source::Span;
use crate::syntax::ast::{self, AssignOp, Else, Ref, StmtKind};

/// What an assignment can set.
#[derive(Clone, Copy)]
enum Slot {
    State(Id<State>),
    Local(Id<Local>),
}

/// A type, the variables of this type that an assignment may mean with the condition that it does, and what is bound before.
type Assignable = (Type, Vec<(ExprId, Vec<Slot>)>, Vec<Stmt>);

impl<'a> Checker<'a> {
    /// A block with a scope of its own; `None` if something in it is not known.
    pub fn block(&mut self, block: &'a ast::Block) -> Option<Block> {
        let depth = self.context.scope.len();
        let mut stmts = Some(Vec::new());
        for stmt in &block.stmts {
            let lowered = self.stmt(stmt, depth);
            match (lowered, &mut stmts) {
                (Some(lowered), Some(stmts)) => stmts.extend(lowered),
                _ => stmts = None,
            }
        }
        let ended = self.context.scope.drain(depth..);
        let ended = ended.map(|binding| binding.name.name.as_str());
        self.context.ended.extend(ended);
        stmts.map(Block)
    }

    /// A statement of a block whose own names start at `depth` of the scope.
    fn stmt(&mut self, stmt: &'a ast::Stmt, depth: usize) -> Option<Vec<Stmt>> {
        match &stmt.kind {
            StmtKind::Let(binding) => self.let_stmt(binding, depth),
            StmtKind::For {
                name,
                domain,
                block,
            } => self.for_stmt(name, domain, block),
            StmtKind::Branch(branch) => self.branch(branch, &mut Vec::new()).map(|stmt| vec![stmt]),
            StmtKind::Assign { target, op, value } => self.assign(stmt.span, target, *op, value),
            StmtKind::Call(call) => self.call_stmt(call).map(|stmt| vec![stmt]),
            StmtKind::Error => None,
        }
    }

    /// `for b in bush { … }`: the block once for each member.
    fn for_stmt(
        &mut self,
        name: &'a ast::Ident,
        domain: &'a ast::Ident,
        block: &'a ast::Block,
    ) -> Option<Vec<Stmt>> {
        let ty = self.named_type(domain);
        self.binds(name, "member");
        self.binds_member(name, &ty);
        let members = self.members_of(&ty, domain.span, &domain.name);
        // Once for itself, so that a mistake is told once.
        self.context.scope.push(Binding::unknown(name, ty.clone()));
        let (_, found) = self.captured(|checker| checker.block(block));
        self.context.scope.pop();
        let wrong = found.iter().any(Diagnostic::is_error);
        self.diagnostics.extend(found);
        if wrong {
            return None;
        }
        let bound = |member| vec![Binding::new(name, ty.clone(), member)];
        let scopes = members?.into_iter().map(bound).collect();
        let blocks = self.for_each_member(scopes, |checker, _| checker.block(block));
        let blocks = blocks.into_iter().collect::<Option<Vec<_>>>()?;
        Some(blocks.into_iter().flat_map(|Block(stmts)| stmts).collect())
    }

    /// A `let` keeps the value it has when it is reached; a constant or a target needs no variable.
    fn let_stmt(&mut self, binding: &'a ast::Binding, depth: usize) -> Option<Vec<Stmt>> {
        let name = &binding.name;
        let typed = self.binding_value(binding);
        let mut stmts = Vec::new();
        let value = typed.value.map(|id| {
            if self.program.pool.constant(id).is_some() {
                return id;
            }
            let temp = self.program.temps.push(Temp {
                name: Name::word(&name.name),
                stays: Stays::ANY,
            });
            stmts.push(Stmt::Let(temp, id));
            self.lets.push((temp, id));
            self.program.pool.leaf(Expr::Temp(temp))
        });
        let known = value != Value::Unknown;
        self.bind(Binding::new(name, typed.ty, value), "value", depth);
        known.then_some(stmts)
    }

    /// A branch, and those after it; `before` holds what those before it ask.
    fn branch(
        &mut self,
        branch: &'a ast::Branch,
        before: &mut Vec<(Span, ExprId)>,
    ) -> Option<Stmt> {
        let condition = self.expect(&branch.cond, &Type::Bool, "a condition");
        self.branches_on(&branch.cond, condition.scalar());
        self.links(&branch.cond, condition.scalar(), before);
        if let Some(Else::Block(otherwise)) = branch.otherwise.as_deref() {
            self.same_blocks(&branch.then, otherwise);
        }
        let then = self.block(&branch.then);
        let otherwise = match branch.otherwise.as_deref() {
            None => Some(Block::default()),
            Some(Else::Block(block)) => {
                self.ends_chain(block.span, before);
                self.block(block)
            }
            Some(Else::If(inner)) => self.branch(inner, before).map(|stmt| Block(vec![stmt])),
        };
        Some(Stmt::If(condition.scalar()?, then?, otherwise?))
    }

    /// Whether a time is to grow by 1 in each tick.
    fn counts_ticks(&self, value: &ast::Expr, ty: &Type) -> bool {
        let in_ticks = matches!(self.context.region, Region::EachTick | Region::Control);
        let one = matches!(
            &value.kind,
            ast::ExprKind::Number(literal) if literal.unit.is_none() && literal.value == 1.0
        );
        in_ticks && one && *ty == Type::TIME
    }

    fn assign(
        &mut self,
        at: Span,
        target: &'a Ref,
        op: ast::Spanned<AssignOp>,
        value: &'a ast::Expr,
    ) -> Option<Vec<Stmt>> {
        let Some((ty, mut slots, mut stmts)) = self.assignable(target) else {
            self.expr(value);
            return None;
        };
        if op.node == AssignOp::Set {
            self.set_to_itself(target, value);
        }
        let role = format!("`{}`", target.name.name);
        let is_nameless = is_nameless(value);
        if op.node != AssignOp::Set && ty.dim().is_none() && ty != Type::Error {
            self.error(
                Code::E0302,
                op.span,
                format!("{role} is {ty}, which is not a number"),
            )
            .label("arithmetic needs a number; `=` sets it");
            let typed = self.expr(value);
            self.clashes_with(&target.name, op.span, &typed.ty);
            return None;
        }
        let value = match op.node {
            AssignOp::Add | AssignOp::Sub if self.counts_ticks(value, &ty) => {
                let message = format!("{role} is {ty}, not {}", Type::NUMBER);
                return self
                    .error(Code::E0301, value.span, message)
                    .this_is(&Type::NUMBER)
                    .fix(
                        "the time that passes in a tick is `tick`",
                        value.span,
                        "tick",
                        Applicability::Unsafe,
                    )
                    .none();
            }
            AssignOp::Set | AssignOp::Add | AssignOp::Sub => {
                self.set_to(&target.name, value, &ty, &role)
            }
            AssignOp::Mul | AssignOp::Div => {
                let typed = self.expr(value);
                if self.number(&typed)? != Dim::NONE {
                    return self
                        .error(
                            Code::E0301,
                            typed.span,
                            format!("{role} would change its unit, and it is {ty}"),
                        )
                        .this_is(&typed.ty)
                        .none();
                }
                if op.node == AssignOp::Div {
                    self.no_division_by_zero(&typed)?;
                }
                typed
            }
        };
        let parts = self.held_parts(&value.value);
        if parts.is_empty() || slots.is_empty() {
            return None;
        }
        if is_nameless {
            self.changes_by(at, op.node, &parts);
        }
        // What is set everywhere needs no branch.
        let everywhere = |pool: &Pool, is| pool.constant(is) == Some(1.0);
        if let [(is, slots)] = slots.as_slice()
            && everywhere(&self.program.pool, *is)
        {
            if let ([Slot::State(state)], [part], AssignOp::Set) =
                (slots.as_slice(), parts.as_slice(), op.node)
            {
                self.assigns(at, *state, *part);
            }
            stmts.extend(self.set(slots, op.node, &parts));
            return Some(stmts);
        }
        for (is, slots) in slots.drain(..) {
            let set = self.set(&slots, op.node, &parts);
            stmts.push(Stmt::If(is, Block(set), Block::default()));
        }
        Some(stmts)
    }

    /// The value of this moment, under a name of its own.
    fn kept(&mut self, name: &str, value: ExprId, stmts: &mut Vec<Stmt>) -> ExprId {
        let temp = self.program.temps.push(Temp {
            name: Name::word(name),
            stays: Stays::ANY,
        });
        stmts.push(Stmt::Let(temp, value));
        self.program.pool.leaf(Expr::Temp(temp))
    }

    /// The statements by which a start sets the one of these states that is meant to these numbers.
    pub fn set_meant(
        &mut self,
        name: &str,
        variables: Vec<(ExprId, Vec<Id<State>>)>,
        parts: &[ExprId],
    ) -> Block {
        let mut stmts = Vec::new();
        let mut branches = Vec::new();
        for (is, ids) in variables {
            let is = self.kept(name, is, &mut stmts);
            let slots: Vec<Slot> = ids.into_iter().map(Slot::State).collect();
            let set = self.set(&slots, AssignOp::Set, parts);
            branches.push(Stmt::If(is, Block(set), Block::default()));
        }
        stmts.extend(branches);
        Block(stmts)
    }

    /// The statements that set variables to these numbers. All numbers are read before the first variable is set.
    fn set(&mut self, slots: &[Slot], op: AssignOp, parts: &[ExprId]) -> Vec<Stmt> {
        let mut stmts = Vec::new();
        let now = |slot: &Slot| match *slot {
            Slot::State(id) => Expr::State(id),
            Slot::Local(id) => Expr::Local(id),
        };
        let held: Vec<Expr> = slots.iter().map(now).collect();
        let pool = &self.program.pool;
        let reads = |part: &ExprId| pool.any(*part, &mut |expr| held.contains(&expr));
        let parts = if slots.len() > 1 && parts.iter().any(reads) {
            let keep = |part: &ExprId| self.kept("value", *part, &mut stmts);
            parts.iter().map(keep).collect()
        } else {
            parts.to_vec()
        };
        for (slot, part) in slots.iter().zip(parts) {
            let pool = &mut self.program.pool;
            let now = pool.leaf(now(slot));
            let part = match op {
                AssignOp::Set => part,
                AssignOp::Add => pool.binary(Binary::Add, now, part),
                AssignOp::Sub => pool.binary(Binary::Sub, now, part),
                AssignOp::Mul => pool.binary(Binary::Mul, now, part),
                AssignOp::Div => pool.binary(Binary::Div, now, part),
            };
            stmts.push(match *slot {
                Slot::State(id) => Stmt::SetState(id, part),
                Slot::Local(id) => Stmt::SetLocal(id, part),
            });
        }
        stmts
    }

    /// The type of the left side of an assignment, the variables that it may mean, each with the condition that it does,
    /// and what has to be bound before they are set. No variables where an argument is known by its type only.
    fn assignable(&mut self, target: &'a Ref) -> Option<Assignable> {
        let name = target.name.name.as_str();
        let cannot = format!("`{name}` cannot be set");
        if target.args.is_none()
            && let Some(binding) = self.context.lookup(name).cloned()
        {
            self.stands_for(&target.name, binding.name.span);
            let Some(locals) = binding.locals else {
                let changes = match self.context.region {
                    Region::Control => "what changes is a `local` of the behaviour",
                    _ => "what changes is a `state`",
                };
                return self
                    .error(Code::E0310, target.span, cannot)
                    .label("it keeps the value that it was given")
                    .also(binding.name.span, "bound here")
                    .help(changes)
                    .none();
            };
            let always = self.program.pool.bool(true);
            let slots = locals.into_iter().map(Slot::Local).collect();
            return Some((binding.ty, vec![(always, slots)], Vec::new()));
        }
        match self.value_of(&target.name) {
            Some((Decl::State(state), _)) => {
                let (ty, variables) = self.state_variables(state, target)?;
                if !matches!(self.context.region, Region::Effect | Region::EachTick) {
                    return self
                        .error(
                            Code::E0310,
                            target.span,
                            format!("the state `{name}` cannot be set by a behaviour"),
                        )
                        .label("a control law sets its locals, and drives")
                        .help("let it succeed, and set the state `on` that event")
                        .none();
                }
                let slots = |ids: Vec<_>| ids.into_iter().map(Slot::State).collect();
                if let [_] = variables.as_slice() {
                    let variables = variables.into_iter();
                    let variables = variables.map(|(is, ids)| (is, slots(ids)));
                    return Some((ty, variables.collect(), Vec::new()));
                }
                // Which one is meant is decided before the first is set.
                let mut bound = Vec::new();
                let mut meant = Vec::new();
                for (is, ids) in variables {
                    let is = self.kept(name, is, &mut bound);
                    meant.push((is, slots(ids)));
                }
                Some((ty, meant, bound))
            }
            // Its declaration is told.
            Some((Decl::Input(_), _)) if self.has_world => None,
            Some((decl, _)) => {
                let depends = matches!(decl, Decl::Predicate(_) | Decl::Event(_) | Decl::Let(_));
                let help = match depends {
                    true => "it follows from what it reads: set a state",
                    false => "what an effect sets is a `state`, what a control law sets a `local`",
                };
                self.error(Code::E0310, target.span, cannot)
                    .this_is(decl.what())
                    .help(help)
                    .none()
            }
            // Its declaration is told.
            None if self.names.is_lost(name) => None,
            None if START_WORDS.contains(&name) => self
                .error(Code::E0310, target.span, cannot)
                .label("said where an episode starts, in `start { … }`")
                .help("what moves a robot meanwhile is its behaviour")
                .none(),
            None if BuiltIn::named(name).is_some_and(|it| !it.gives_way()) => self
                .error(Code::E0310, target.span, cannot)
                .label("this is a function of the language")
                .help("give the state another name: `state NAME: TYPE = VALUE`")
                .none(),
            None if is_built_in(name) => self
                .error(Code::E0310, target.span, cannot)
                .label("the world sets it")
                .none(),
            None => {
                let scope = self.context.scope.iter();
                let locals = scope.filter(|binding| binding.locals.is_some());
                let locals = locals.map(|binding| binding.name.name.as_str());
                let states = self.names.values(|decl| matches!(decl, Decl::State(_)));
                let likely = self.likely(name, locals.chain(states));
                self.undeclared(&target.name, "variable", likely).none()
            }
        }
    }

    fn call_stmt(&mut self, call: &'a Ref) -> Option<Stmt> {
        let name = &call.name;
        if name.name == "drive" {
            return self.drive_stmt(call);
        }
        match self.value_of(name) {
            Some((decl, _)) => {
                for arg in call.args.iter().flatten() {
                    self.stray_argument(arg);
                }
                let help = matches!(decl, Decl::Behavior(_))
                    .then(|| "a task chooses it, or a tree runs it".to_owned());
                self.error(
                    Code::E0203,
                    call.span,
                    format!("`{}` does nothing as a statement", name.name),
                )
                .this_is(decl.what())
                .help_if(help)
                .none()
            }
            None => {
                let likely = self.likely(&name.name, ["drive"].into_iter());
                self.undeclared(name, "statement", likely).none()
            }
        }
    }
}
