//! The names that a program mentions, wherever they mean something: a name that means two things counts for both.

use crate::syntax::ast::{
    Arg, ArgKind, AspectKind, AssignOp, Behavior, BehaviorBody, Binding, Block, Branch, Choice,
    ClaimWhat, ClauseKind, Else, Expr, ExprKind, Ident, Item, ItemKind, LearnEntry, LetBody, Node,
    NodeKind, Otherwise, Paid, Params, Ref, RobotEntryKind, Start, Stmt, StmtKind, Task, Trigger,
    TypeExpr, World, WorldEntryKind, Yield,
};
use std::collections::BTreeSet;

/// The names that are mentioned.
#[derive(Debug, Default)]
pub struct Mentions<'a> {
    /// Those that something reads, runs or asks.
    pub read: BTreeSet<&'a str>,
    /// Those that something sets.
    pub set: BTreeSet<&'a str>,
    /// Those of kinds and enums whose members something goes through, or takes any of.
    pub ranged: BTreeSet<&'a str>,
}

impl<'a> Mentions<'a> {
    /// Takes in what an item mentions.
    pub fn item(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Use(_) | ItemKind::Enum(_) | ItemKind::Error => {}
            ItemKind::World(world) => self.world(world),
            ItemKind::Input(_) => {}
            ItemKind::State(state) => {
                self.params(state.params.as_ref());
                self.ty(state.ty.as_ref());
                self.expr(&state.value);
            }
            ItemKind::Event(event) => {
                self.params(event.params.as_ref());
                self.expr(&event.value);
            }
            ItemKind::EachTick(block) => self.block(block),
            ItemKind::On(on) => {
                match &on.trigger {
                    Trigger::Expr(event) => self.expr(event),
                    Trigger::Family { name, params } => {
                        self.read.insert(&name.name);
                        self.params(Some(params));
                    }
                }
                self.block(&on.block);
            }
            ItemKind::Let(item) => {
                self.params(item.params.as_ref());
                self.ty(item.ty.as_ref());
                match &item.body {
                    LetBody::Expr(value) => self.expr(value),
                    LetBody::Yield(body) => self.yielded(body),
                }
            }
            ItemKind::Predicate(predicate) => {
                self.params(predicate.params.as_ref());
                self.exprs(&predicate.value);
            }
            ItemKind::Behavior(behavior) => self.behavior(behavior),
            ItemKind::Task(task) => self.task(task),
            ItemKind::Learn(learn) => {
                for entry in &learn.entries {
                    match entry {
                        LearnEntry::Start(start) => self.start(start),
                        LearnEntry::Setting(setting) => {
                            self.expr(&setting.value);
                            self.exprs(setting.tail.as_ref().map(|(_, tail)| tail));
                        }
                        LearnEntry::Error(_) => {}
                    }
                }
            }
            ItemKind::Tree(tree) => {
                self.params(tree.params.as_ref());
                self.node(&tree.root);
            }
            ItemKind::Claim(claim) => {
                self.read.insert(&claim.tree.name);
                match &claim.what {
                    ClaimWhat::Equals(other) => {
                        self.read.insert(&other.name);
                    }
                    ClaimWhat::Never(event) | ClaimWhat::Reaches(event) => self.expr(event),
                }
            }
            // What a tree does not ask and does not run is not of use because a test names it.
            ItemKind::Test(test) => self.reference(&test.tree),
        }
    }

    fn world(&mut self, world: &'a World) {
        for entry in &world.entries {
            match &entry.kind {
                WorldEntryKind::Place { shape, facing, .. } => {
                    self.expr(shape);
                    self.exprs(facing);
                }
                WorldEntryKind::Wall { shape, when, .. } => {
                    self.expr(shape);
                    self.exprs(when);
                }
                WorldEntryKind::Robot { entries, .. } => {
                    for entry in entries {
                        match &entry.kind {
                            RobotEntryKind::Sensor { value, .. } => self.expr(value),
                            RobotEntryKind::Field(field) => self.expr(&field.value),
                            RobotEntryKind::Error => {}
                        }
                    }
                }
                WorldEntryKind::Field(field) => self.expr(&field.value),
                WorldEntryKind::Error => {}
            }
        }
    }

    fn behavior(&mut self, behavior: &'a Behavior) {
        self.params(behavior.params.as_ref());
        match &behavior.body {
            BehaviorBody::Declared => {}
            BehaviorBody::Alias(of) => self.reference(of),
            BehaviorBody::Clauses(clauses) => {
                for clause in clauses {
                    match &clause.kind {
                        ClauseKind::Local { ty, value, .. } => {
                            self.ty(ty.as_ref());
                            self.expr(value);
                        }
                        ClauseKind::Requires(test)
                        | ClauseKind::Succeed(test)
                        | ClauseKind::Fail(test) => self.expr(test),
                        ClauseKind::Control(block) => self.block(block),
                        ClauseKind::Error => {}
                    }
                }
            }
        }
    }

    /// Takes in what an item mentions besides behaviours to choose from, in tasks and in trees.
    pub fn beside_choices(&mut self, item: &'a Item) {
        match &item.kind {
            ItemKind::Task(task) => self.aspects(task),
            ItemKind::Tree(_) | ItemKind::Claim(_) | ItemKind::Test(_) => {}
            _ => self.item(item),
        }
    }

    fn task(&mut self, task: &'a Task) {
        for aspect in &task.aspects {
            if let AspectKind::Observe(list) | AspectKind::Choose(list) = &aspect.kind {
                self.exprs(list);
            }
        }
        self.aspects(task);
    }

    fn aspects(&mut self, task: &'a Task) {
        for aspect in &task.aspects {
            match &aspect.kind {
                AspectKind::Observe(_) | AspectKind::Choose(_) => {}
                AspectKind::History { window: value, .. }
                | AspectKind::Patience(value)
                | AspectKind::EndOn(value)
                | AspectKind::EndAfter(value) => self.expr(value),
                AspectKind::Start(start) => self.start(start),
                AspectKind::Reward { lines, otherwise } => {
                    for line in lines {
                        match &line.paid {
                            Paid::On(event) => self.expr(event),
                            Paid::Per { during, time } => {
                                self.exprs(during);
                                self.expr(time);
                            }
                        }
                        self.expr(&line.value);
                    }
                    self.exprs(otherwise);
                }
                AspectKind::Error => {}
            }
        }
    }

    fn start(&mut self, start: &'a Start) {
        for line in &start.lines {
            self.set.insert(&line.target.name.name);
            self.expr(&line.value);
        }
    }

    fn node(&mut self, node: &'a Node) {
        match &node.kind {
            NodeKind::Composite { args, children, .. } => {
                self.args(args.as_deref().unwrap_or_default());
                children.iter().for_each(|child| self.node(child));
            }
            NodeKind::Guarded { guard, node } => {
                self.expr(guard);
                self.node(node);
            }
            NodeKind::Leaf(expr) => self.expr(expr),
            NodeKind::Error => {}
        }
    }

    /// Takes in what a block mentions.
    pub fn block(&mut self, block: &'a Block) {
        block.stmts.iter().for_each(|stmt| self.statement(stmt));
    }

    /// Takes in what a statement mentions.
    pub fn statement(&mut self, stmt: &'a Stmt) {
        match &stmt.kind {
            StmtKind::Let(binding) => self.binding(binding),
            StmtKind::For { domain, block, .. } => {
                self.goes_through(domain);
                self.block(block);
            }
            StmtKind::Branch(branch) => self.branch(branch),
            StmtKind::Assign { target, op, value } => {
                self.set.insert(&target.name.name);
                self.args(target.args.as_deref().unwrap_or_default());
                // `x = x + 1` reads `x` for nothing but itself, as `x += 1` does.
                let had = self.read.contains(target.name.name.as_str());
                self.expr(value);
                if !had && op.node == AssignOp::Set {
                    self.read.remove(target.name.name.as_str());
                }
            }
            StmtKind::Call(call) => self.reference(call),
            StmtKind::Error => {}
        }
    }

    /// Takes in what a branch mentions.
    pub fn branch(&mut self, branch: &'a Branch) {
        self.expr(&branch.cond);
        self.block(&branch.then);
        match branch.otherwise.as_deref() {
            Some(Else::If(branch)) => self.branch(branch),
            Some(Else::Block(block)) => self.block(block),
            None => {}
        }
    }

    fn binding(&mut self, binding: &'a Binding) {
        self.ty(binding.ty.as_ref());
        self.expr(&binding.value);
    }

    pub fn yielded(&mut self, body: &'a Yield) {
        for binding in &body.bindings {
            self.binding(binding);
        }
        self.expr(&body.value);
    }

    fn exprs(&mut self, exprs: impl IntoIterator<Item = &'a Expr>) {
        exprs.into_iter().for_each(|expr| self.expr(expr));
    }

    /// Takes in what an expression mentions.
    pub fn expr(&mut self, expr: &'a Expr) {
        match &expr.kind {
            ExprKind::Number(_) | ExprKind::Bool(_) | ExprKind::Error => {}
            ExprKind::Ref(reference) => self.reference(reference),
            ExprKind::If(choice) => self.choice(choice),
            ExprKind::Point(a, b)
            | ExprKind::Binary {
                left: a, right: b, ..
            } => {
                self.expr(a);
                self.expr(b);
            }
            ExprKind::Paren(inner)
            | ExprKind::Coordinate(inner, _)
            | ExprKind::Unary { operand: inner, .. } => self.expr(inner),
        }
    }

    fn choice(&mut self, choice: &'a Choice) {
        self.expr(&choice.cond);
        self.yielded(&choice.then);
        match &choice.otherwise {
            Otherwise::If(choice, _) => self.choice(choice),
            Otherwise::Yield(body) => self.yielded(body),
        }
    }

    pub fn reference(&mut self, reference: &'a Ref) {
        self.read.insert(&reference.name.name);
        self.args(reference.args.as_deref().unwrap_or_default());
    }

    fn args(&mut self, args: &'a [Arg]) {
        for arg in args {
            match &arg.kind {
                ArgKind::Positional(value) | ArgKind::Named(_, value) => self.expr(value),
                ArgKind::Range(low, high) => {
                    self.expr(low);
                    self.expr(high);
                }
                ArgKind::Binder { domain, body, .. } => {
                    self.goes_through(domain);
                    self.exprs(body);
                }
            }
        }
    }

    fn params(&mut self, params: Option<&'a Params>) {
        for param in params.iter().flat_map(|params| &params.params) {
            self.ty(Some(&param.ty));
            let factors = param.ty.factors.iter();
            self.ranged
                .extend(factors.map(|(name, _)| name.name.as_str()));
            self.exprs(&param.default);
        }
    }

    fn goes_through(&mut self, domain: &'a Ident) {
        self.read.insert(&domain.name);
        self.ranged.insert(&domain.name);
    }

    fn ty(&mut self, ty: Option<&'a TypeExpr>) {
        for (name, _) in ty.iter().flat_map(|ty| &ty.factors) {
            self.read.insert(&name.name);
        }
    }
}
