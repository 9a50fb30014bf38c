//! States and locals that are read just after they were reset: most often two statements stand in the wrong order.

use super::mentions::Mentions;
use super::overwritten::trigger;
use crate::check::Checker;
use crate::check::expr::plain_ref;
use crate::check::names::Decl;
use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{
    AssignOp, Behavior, BehaviorBody, Block, Branch, ClauseKind, Else, Expr, ExprKind, Item,
    ItemKind, Ref, Stmt, StmtKind,
};
use crate::syntax::print;
use std::collections::{BTreeMap, BTreeSet};

/// What has been reset and not been set since: by its name, where that stands.
type Resets<'a> = BTreeMap<&'a str, Span>;

impl<'a> Checker<'a> {
    /// Warns of what is read where it was reset just before, in the same block or in an effect of the same event before it.
    pub fn read_after_reset(&mut self, items: impl Iterator<Item = &'a Item>) {
        // By what an effect waits for: its place, and the resets that hold behind it.
        let mut known: BTreeMap<String, (usize, Resets<'a>)> = BTreeMap::new();
        // The last effect that sets a name.
        let mut set: BTreeMap<&str, usize> = BTreeMap::new();
        for (at, item) in items.enumerate() {
            match &item.kind {
                ItemKind::EachTick(block) => self.follow(block, &mut Resets::new()),
                ItemKind::On(on) => {
                    let key = trigger(on);
                    let (before, mut resets) = known.remove(&key).unwrap_or_default();
                    resets.retain(|name, _| set.get(name).is_none_or(|last| *last <= before));
                    self.follow(&on.block, &mut resets);
                    let mut mentions = Mentions::default();
                    mentions.block(&on.block);
                    set.extend(mentions.set.into_iter().map(|name| (name, at)));
                    known.insert(key, (at, resets));
                }
                ItemKind::Behavior(behavior) => self.follow_law(behavior),
                _ => {}
            }
        }
    }

    fn follow_law(&mut self, behavior: &'a Behavior) {
        let BehaviorBody::Clauses(clauses) = &behavior.body else {
            return;
        };
        for clause in clauses {
            if let ClauseKind::Control(block) = &clause.kind {
                self.follow(block, &mut Resets::new());
            }
        }
    }

    /// Goes through a block after these resets, which are then those that hold behind it.
    fn follow(&mut self, block: &'a Block, resets: &mut Resets<'a>) {
        for stmt in &block.stmts {
            match &stmt.kind {
                StmtKind::Let(binding) => {
                    self.looks_at(&binding.value, resets);
                    resets.remove(binding.name.name.as_str());
                }
                StmtKind::Call(call) => {
                    let mut mentions = Mentions::default();
                    mentions.reference(call);
                    self.looks_at_names(&mentions, call.span, resets);
                }
                StmtKind::Assign { target, op, value } => {
                    self.assigns_after(stmt, target, op.node, value, resets);
                }
                StmtKind::Branch(branch) => self.follow_branch(branch, resets),
                StmtKind::For { block, name, .. } => {
                    // What a turn sets, the next one reads.
                    lose_set(stmt, resets);
                    let mut within = resets.clone();
                    within.remove(name.name.as_str());
                    self.follow(block, &mut within);
                    resets.retain(|name, _| within.contains_key(name));
                }
                StmtKind::Error => resets.clear(),
            }
        }
    }

    fn assigns_after(
        &mut self,
        stmt: &'a Stmt,
        target: &'a Ref,
        op: AssignOp,
        value: &'a Expr,
        resets: &mut Resets<'a>,
    ) {
        let name = target.name.name.as_str();
        // What is built up from its reset is meant so.
        resets.remove(name);
        self.looks_at(value, resets);
        if op == AssignOp::Set && target.args.is_none() && self.is_reset(name, value) {
            resets.insert(name, stmt.span);
        }
    }

    /// Whether a value is what a name begins with, or nothing.
    fn is_reset(&self, name: &str, value: &Expr) -> bool {
        let declared = match self.names.value(name, false) {
            Some((Decl::State(state), _)) => Some(&state.value),
            _ => None,
        };
        let is_variant = plain_ref(value).is_some_and(|variant| {
            let decl = self.names.value(&variant.name.name, false);
            matches!(decl, Some((Decl::Variant(..), _)))
        });
        let first = || declared.is_some_and(|first| print::expr(first) == print::expr(value));
        is_variant || is_nothing(value) || matches!(value.kind, ExprKind::Number(_)) && first()
    }

    fn follow_branch(&mut self, branch: &'a Branch, resets: &mut Resets<'a>) {
        // A value that a branch may set is compared with what it was.
        let mut set = Mentions::default();
        set.branch(branch);
        let asked = resets.iter().filter(|(name, _)| !set.set.contains(*name));
        let mut asked: Resets<'a> = asked.map(|(name, at)| (*name, *at)).collect();
        self.looks_at(&branch.cond, &mut asked);
        resets.retain(|name, _| set.set.contains(name) || asked.contains_key(name));
        let mut then = resets.clone();
        self.follow(&branch.then, &mut then);
        let mut otherwise = resets.clone();
        match branch.otherwise.as_deref() {
            Some(Else::If(inner)) => self.follow_branch(inner, &mut otherwise),
            Some(Else::Block(block)) => self.follow(block, &mut otherwise),
            None => {}
        }
        resets.retain(|name, at| then.get(name) == Some(at) && otherwise.get(name) == Some(at));
    }

    fn looks_at(&mut self, value: &'a Expr, resets: &mut Resets<'a>) {
        let mut mentions = Mentions::default();
        mentions.expr(value);
        self.looks_at_names(&mentions, value.span, resets);
    }

    /// Warns of what stands here and reads one of these resets, each of which is told once.
    fn looks_at_names(&mut self, mentions: &Mentions, at: Span, resets: &mut Resets<'a>) {
        let read = mentions.read.iter().copied();
        let read: BTreeSet<&str> = read.filter(|name| resets.contains_key(name)).collect();
        for name in read {
            let Some(reset) = resets.remove(name) else {
                continue;
            };
            let message = format!("`{name}` is read after it was reset");
            self.warning(Code::W0312, at, message)
                .label("what it was before is gone")
                .also(reset, "reset here, just before")
                .help(format!("read `{name}` first, and reset it after that"));
        }
    }
}

/// Takes out what a statement may set.
fn lose_set(stmt: &Stmt, resets: &mut Resets) {
    let mut mentions = Mentions::default();
    mentions.statement(stmt);
    resets.retain(|name, _| !mentions.set.contains(name));
}

/// `0`, with or without a unit, and a truth value.
fn is_nothing(value: &Expr) -> bool {
    match &value.kind {
        ExprKind::Number(number) => number.value == 0.0,
        ExprKind::Bool(_) => true,
        _ => false,
    }
}
