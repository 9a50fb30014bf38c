//! Values that are overwritten before anything reads them, and effects that stand twice.

use super::mentions::Mentions;
use super::same::{does_the_same, is_same};
use crate::check::Checker;
use crate::check::names::Decl;
use crate::diagnostic::Code;
use crate::source::Span;
use crate::syntax::ast::{
    AssignOp, Behavior, BehaviorBody, Block, Branch, ClauseKind, Else, Item, ItemKind, On, Ref,
    Stmt, StmtKind, Trigger,
};
use crate::syntax::print;
use std::collections::{BTreeMap, BTreeSet};

/// What has been set and not been read since.
type Unread<'a> = Vec<(&'a Ref, Span)>;

/// An effect, with what it leaves unread.
struct Effect<'a> {
    at: usize,
    on: &'a On,
    unread: Unread<'a>,
}

impl<'a> Checker<'a> {
    /// Warns of values in effects and control laws that nothing reads before they are overwritten, and of effects that are there
    /// already.
    pub fn values_overwritten(&mut self, items: impl Iterator<Item = &'a Item>) {
        let mut effects: BTreeMap<String, Effect<'a>> = BTreeMap::new();
        // The last effect that reads a name; names are read by way of other names, too.
        let mut read: BTreeMap<&str, usize> = BTreeMap::new();
        let mut all_read = 0;
        for (at, item) in (1..).zip(items) {
            let block = match &item.kind {
                ItemKind::EachTick(block) => block,
                ItemKind::On(on) => &on.block,
                ItemKind::Behavior(behavior) => {
                    self.overwritten_by(behavior);
                    continue;
                }
                _ => continue,
            };
            let unread = self.overwritten_in(block);
            if let ItemKind::On(on) = &item.kind {
                let key = trigger(on);
                if let Some(before) = effects.get(&key) {
                    let unread = before.unread.iter().filter(|(target, _)| {
                        let last = read.get(target.name.name.as_str());
                        all_read.max(last.copied().unwrap_or(0)) <= before.at
                    });
                    let unread: Unread = unread.copied().collect();
                    self.stands_again(before.on, on, unread);
                }
                effects.insert(key, Effect { at, on, unread });
            }
            // What the effect waits for is known before any effect.
            let mut mentions = Mentions::default();
            for stmt in &block.stmts {
                reads_of(stmt, &mut mentions);
            }
            if self.reads_by_name(&mentions.read) {
                all_read = at;
            }
            read.extend(mentions.read.into_iter().map(|name| (name, at)));
        }
    }

    fn overwritten_by(&mut self, behavior: &'a Behavior) {
        let BehaviorBody::Clauses(clauses) = &behavior.body else {
            return;
        };
        for clause in clauses {
            if let ClauseKind::Control(block) = &clause.kind {
                self.overwritten_in(block);
            }
        }
    }

    /// Warns of what a second effect of the same event does again, or overwrites.
    fn stands_again(&mut self, before: &'a On, on: &'a On, mut unread: Unread<'a>) {
        if does_the_same(&before.block, &on.block) && !on.block.stmts.is_empty() {
            self.warning(Code::W0303, head(on), "this effect is there already")
                .label("both happen")
                .also(head(before), "the first time");
            return;
        }
        for stmt in &on.block.stmts {
            self.goes_over(stmt, &mut unread);
        }
    }

    /// Warns of what is overwritten in a block; gives what is unread at its end.
    fn overwritten_in(&mut self, block: &'a Block) -> Unread<'a> {
        let mut unread = Vec::new();
        for stmt in &block.stmts {
            self.goes_over(stmt, &mut unread);
            match &stmt.kind {
                StmtKind::For { block, .. } => {
                    self.overwritten_in(block);
                }
                StmtKind::Branch(branch) => self.overwritten_in_branches(branch),
                StmtKind::Assign { target, .. } => unread.push((target, stmt.span)),
                _ => {}
            }
        }
        unread
    }

    fn overwritten_in_branches(&mut self, branch: &'a Branch) {
        self.overwritten_in(&branch.then);
        match branch.otherwise.as_deref() {
            Some(Else::If(inner)) => self.overwritten_in_branches(inner),
            Some(Else::Block(block)) => {
                self.overwritten_in(block);
            }
            None => {}
        }
    }

    /// Takes out what a statement reads, or may set; warns of what it overwrites.
    fn goes_over(&mut self, stmt: &'a Stmt, unread: &mut Unread<'a>) {
        if unread.is_empty() {
            return;
        }
        let mut mentions = Mentions::default();
        reads_of(stmt, &mut mentions);
        if self.reads_by_name(&mentions.read) {
            unread.clear();
        }
        let (set, op) = match &stmt.kind {
            StmtKind::Assign { target, op, .. } => (Some(target), op.node),
            _ => (None, AssignOp::Set),
        };
        if op != AssignOp::Set {
            mentions.read.extend(&mentions.set);
        }
        unread.retain(|(target, _)| !mentions.read.contains(target.name.name.as_str()));
        let Some(set) = set else {
            unread.retain(|(target, _)| !mentions.set.contains(target.name.name.as_str()));
            return;
        };
        let (same, rest) = unread
            .drain(..)
            .partition(|(target, _)| is_same(target, set));
        *unread = rest;
        let same: Unread = same;
        for (target, at) in same {
            let name = &target.name.name;
            let message = format!("`{name}` is overwritten before anything reads it");
            self.warning(Code::W0307, at, message)
                .label("this has no effect")
                .also(stmt.span, "overwritten here");
        }
    }

    /// Whether any of these names stands for an expression that may read states.
    fn reads_by_name(&self, read: &BTreeSet<&str>) -> bool {
        read.iter().any(|name| {
            let decl = self.names.value(name, false);
            matches!(
                decl,
                Some((Decl::Let(_) | Decl::Predicate(_) | Decl::Event(_), _))
            )
        })
    }
}

/// What a statement reads and sets. What is set by its own value reads that.
fn reads_of<'a>(stmt: &'a Stmt, mentions: &mut Mentions<'a>) {
    mentions.statement(stmt);
    if let StmtKind::Assign { value, .. } = &stmt.kind {
        mentions.expr(value);
    }
}

/// What an effect waits for, as it is written.
pub fn trigger(on: &On) -> String {
    match &on.trigger {
        Trigger::Expr(event) => print::expr(event),
        Trigger::Family { name, params } => {
            let params = params.params.iter();
            let params = params.map(|it| {
                let kinds = it.ty.factors.iter().map(|(kind, _)| kind.name.as_str());
                format!("{}: {}", it.name.name, kinds.collect::<String>())
            });
            format!("{}({})", name.name, params.collect::<Vec<_>>().join(", "))
        }
    }
}

/// What an effect waits for.
fn head(on: &On) -> Span {
    match &on.trigger {
        Trigger::Expr(event) => event.span,
        Trigger::Family { name, .. } => name.span,
    }
}
